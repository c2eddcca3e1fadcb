//! The figures of the paper that are drawings rather than meshes, redrawn from the product:
//! 1 to 3 from the grid, 8 from the templates' regions, 11 to 13 from their formulas.

use crate::drawing::Picture;
use hexdel_geom::DVec2;
use hexdel_grid::{Address, Direction, Grid, Hex, HexKind, Lattice, Neighbour};
use std::collections::{BTreeMap, BTreeSet};

const HEXAGON: &str = "fill=\"#ffffff\" stroke=\"#64748b\" stroke-width=\"1.2\"";
const SEMI: &str = "fill=\"#e2e8f0\" stroke=\"#94a3b8\" stroke-width=\"1\"";
const OCCUPIED: &str = "fill=\"#bbf7d0\" stroke=\"#15803d\" stroke-width=\"1.4\"";
const TOUCHED: &str = "fill=\"#fde68a\" stroke=\"#b45309\" stroke-width=\"1.4\"";
const SEGMENT: &str = "stroke=\"#1d4ed8\" stroke-width=\"2.2\"";
const AXIS: &str = "stroke=\"#94a3b8\" stroke-width=\"1\" stroke-dasharray=\"4 3\"";
const TRIANGLE: &str = "fill=\"#fed7aa\" stroke=\"#c2410c\" stroke-width=\"1.6\"";
const CIRCLE: &str = "fill=\"none\" stroke=\"#475569\" stroke-width=\"1.2\"";

/// All of them, by name.
pub(super) fn all() -> Vec<(String, Vec<u8>)> {
    let drawn = [
        ("fig-01-split-counter.svg", split_counter()),
        ("fig-02-balance.svg", balance()),
        ("fig-03-rules.svg", rules()),
        ("fig-11-aspect-ratio.svg", aspect_ratio()),
        ("fig-12-assignment.svg", assignment()),
        ("fig-13-axes.svg", axes()),
    ];
    drawn.into_iter().map(|(name, svg)| (name.to_owned(), svg.into_bytes())).collect()
}

fn plain_grid() -> Grid {
    Grid::new(Lattice::new(DVec2::ZERO, 1.0))
}

/// Fig. 1: subdividing counts up, joining begins at 0.
fn split_counter() -> String {
    let mut picture = Picture::new();
    let east = Direction::new(0).step();
    let patch = [Hex::ORIGIN, east];
    let steps: [&[Hex]; 3] = [&[], &[Hex::ORIGIN], &[Hex::ORIGIN, east]];
    for (i, subdivided) in steps.into_iter().enumerate() {
        let mut grid = plain_grid();
        for &hex in subdivided {
            grid.subdivide(Address::new(0, hex));
        }
        picture.move_to([2.6 * i as f64, 0.0]);
        draw(&mut picture, &grid, &patch, &BTreeSet::new(), Some(Grid::split_counter));
    }
    picture.finish()
}

/// Fig. 2: one hexagon subdivided three times, with the levels that balance makes.
fn balance() -> String {
    let mut picture = Picture::new();
    let mut grid = plain_grid();
    grid.subdivide(Address::new(2, Hex::ORIGIN));
    let patch: Vec<Hex> = Hex::ORIGIN.disc(3).collect();
    draw(&mut picture, &grid, &patch, &BTreeSet::new(), Some(|at: Address| at.level));
    picture.finish()
}

/// Draws what stands on a patch of level 0: leaves, with a number if wanted, and
/// semi-hexagons.
fn draw(
    picture: &mut Picture,
    grid: &Grid,
    patch: &[Hex],
    marked: &BTreeSet<Address>,
    number: Option<fn(Address) -> u8>,
) {
    let mut waiting: Vec<Address> = patch.iter().map(|&hex| Address::new(0, hex)).collect();
    let mut seen = BTreeSet::new();
    let mut leaves = Vec::new();
    while let Some(at) = waiting.pop() {
        if !seen.insert(at) {
            continue;
        }
        match grid.kind(at) {
            HexKind::Subdivided => {
                waiting.extend(at.hex.scaled().disc(1).map(|h| Address::new(at.level + 1, h)));
            }
            HexKind::Leaf => leaves.push(at),
            HexKind::Semi { of } => semi(picture, grid, at, of),
            HexKind::Absent => {}
        }
    }
    for at in leaves {
        let (centre, spacing) = (grid.lattice().position(at), grid.lattice().spacing(at.level));
        let style = if marked.contains(&at) { OCCUPIED } else { HEXAGON };
        picture.hexagon([centre.x, centre.y], spacing, style);
        if let Some(number) = number {
            picture.text([centre.x, centre.y], 0.36 * spacing, &number(at).to_string());
        }
    }
}

/// A semi-hexagon: the half of it that is not a fin of `of`'s own.
fn semi(picture: &mut Picture, grid: &Grid, at: Address, of: Hex) {
    let (centre, spacing) = (grid.lattice().position(at), grid.lattice().spacing(at.level));
    let towards = grid.lattice().position(Address::new(at.level - 1, of)) - centre;
    let corners = (0..6).map(|i| {
        let angle = DVec2::from_angle((30.0 + 60.0 * f64::from(i)).to_radians());
        centre + angle * (spacing / 3.0_f64.sqrt())
    });
    let mut half: Vec<DVec2> = corners.filter(|&p| (p - centre).dot(towards) < 1e-9).collect();
    let middle = half.iter().sum::<DVec2>() / half.len() as f64;
    half.sort_by(|p, q| (*p - middle).to_angle().total_cmp(&(*q - middle).to_angle()));
    let half: Vec<[f64; 2]> = half.into_iter().map(|p| [p.x, p.y]).collect();
    picture.polygon(&half, SEMI);
}

/// The rules of section 4.1, one hexagon at a time.
struct Sequence {
    grid: Grid,
    points: Vec<DVec2>,
}

impl Sequence {
    /// The leaves that hold points.
    fn occupied(&self) -> BTreeMap<Address, usize> {
        let mut counts = BTreeMap::new();
        for &p in &self.points {
            let (level, at, kind) = self.grid.locate(p);
            if kind == HexKind::Leaf {
                *counts.entry(Address::new(level, at.hex)).or_insert(0) += 1;
            }
        }
        counts
    }

    /// The first rule that asks for something, and the hexagon that it asks for.
    fn next(&self) -> Option<(u8, Address)> {
        let occupied = self.occupied();
        let several = occupied.iter().find(|(_, count)| **count > 1).map(|(&at, _)| (1, at));
        let in_semi = || {
            self.points.iter().find_map(|&p| match self.grid.locate(p) {
                (level, _, HexKind::Semi { of }) => Some((2, Address::new(level - 1, of))),
                _ => None,
            })
        };
        let beside = |rule: u8| {
            let sides =
                occupied.keys().flat_map(|&at| Direction::ALL.map(|d| (at, self.grid.neighbour(at, d))));
            sides.into_iter().find_map(|(at, neighbour)| match (rule, neighbour?) {
                (3, Neighbour::Same(other)) if occupied.contains_key(&other) => Some((rule, at)),
                (4, Neighbour::Coarser(other)) => Some((rule, other)),
                (5, Neighbour::Finer(_)) => Some((rule, at)),
                _ => None,
            })
        };
        several.or_else(in_semi).or_else(|| [3, 4, 5].into_iter().find_map(beside))
    }
}

/// Fig. 3: points in a bounding hexagon, and the first time that each rule asks.
fn rules() -> String {
    let points = [(-0.31, 0.12), (0.22, 0.31), (0.28, 0.2), (0.05, -0.36), (0.4, -0.12)];
    let points = points.map(|(x, y)| DVec2::new(x, y)).to_vec();
    let mut sequence = Sequence { grid: plain_grid(), points };
    let patch: Vec<Hex> = Hex::ORIGIN.disc(1).collect();
    let mut picture = Picture::new();
    let mut shown = BTreeSet::new();
    let mut panel = |sequence: &Sequence, i: usize, label: &str| {
        picture.move_to([3.4 * (i % 3) as f64, -3.4 * (i / 3) as f64]);
        draw(&mut picture, &sequence.grid, &patch, &sequence.occupied().into_keys().collect(), None);
        for p in &sequence.points {
            picture.dot([p.x, p.y]);
        }
        picture.text([0.0, -1.75], 0.22, label);
    };
    panel(&sequence, 0, "the points");
    while let Some((rule, at)) = sequence.next() {
        sequence.grid.subdivide(at);
        if shown.insert(rule) {
            panel(&sequence, shown.len(), &format!("rule {rule}"));
        }
    }
    panel(&sequence, shown.len() + 1, "no rule asks");
    picture.finish()
}

/// Fig. 11: the worst triangle with its circles, and two triangles at an edge.
fn aspect_ratio() -> String {
    let mut picture = Picture::new();
    let (a, b) = (3.0_f64.sqrt() * 3.0 / 2.0, 2.5);
    picture.polygon(&[[0.0, 0.0], [a, 0.0], [0.0, b]], TRIANGLE);
    let hypotenuse = a.hypot(b);
    picture.circle([a / 2.0, b / 2.0], hypotenuse / 2.0, CIRCLE);
    let inradius = (a + b - hypotenuse) / 2.0;
    picture.circle([inradius, inradius], inradius, CIRCLE);
    picture.text([0.3, 0.25], 0.3, "90°");
    picture.text([a - 0.75, 0.25], 0.3, "43.9°");
    picture.text([0.35, b - 0.75], 0.3, "46.1°");
    picture.text([a / 2.0, -1.2], 0.3, "R / (2 ρ) = 1.20787");
    picture.move_to([5.2, 0.6]);
    let [low, east, high, west] = [[0.0, -1.2], [1.35, 0.1], [0.0, 1.2], [-1.25, 0.0]];
    picture.polygon(&[low, east, high], TRIANGLE);
    picture.polygon(&[low, high, west], HEXAGON);
    picture.text([0.9, 0.08], 0.3, "γ₁");
    picture.text([-0.8, 0.0], 0.3, "γ₂");
    picture.text([0.18, -1.4], 0.3, "A");
    picture.text([0.18, 1.4], 0.3, "B");
    picture.text([0.0, -1.8], 0.3, "γ₁ + γ₂ ≤ 180°");
    picture.finish()
}

/// The hexagons of level 0 that a segment meets: every place of it is in one.
fn met(from: DVec2, to: DVec2) -> BTreeSet<Hex> {
    let grid = plain_grid();
    let places = (0..=1000).map(|i| from.lerp(to, f64::from(i) / 1000.0));
    places.map(|p| grid.lattice().locate(0, p).hex).collect()
}

/// Fig. 12: which segments are assigned to which hexagons; one with three must be
/// subdivided.
fn assignment() -> String {
    let mut picture = Picture::new();
    let corner = DVec2::new(0.1, 0.05);
    let ends = [DVec2::new(-1.9, -0.6), DVec2::new(1.8, 0.7), DVec2::new(0.3, 1.9)];
    for (i, count) in [2, 3].into_iter().enumerate() {
        picture.move_to([5.6 * i as f64, 0.0]);
        let all: Vec<BTreeSet<Hex>> = ends[..count].iter().map(|&end| met(corner, end)).collect();
        for at in Hex::ORIGIN.disc(2) {
            let several = all.iter().filter(|set| set.contains(&at)).count();
            let style = match several {
                0 => HEXAGON,
                1 | 2 => TOUCHED,
                _ => TRIANGLE,
            };
            let centre = plain_grid().lattice().position(Address::new(0, at));
            picture.hexagon([centre.x, centre.y], 1.0, style);
        }
        for end in &ends[..count] {
            picture.line(&[[corner.x, corner.y], [end.x, end.y]], SEGMENT);
        }
        picture.dot([corner.x, corner.y]);
        let label = if count == 2 { "two consecutive segments" } else { "three: subdivided" };
        picture.text([0.0, -2.6], 0.28, label);
    }
    picture.finish()
}

/// Fig. 13: the axis at the largest angle to a segment, and where it meets it: within the
/// hexagon or beyond it.
fn axes() -> String {
    let mut picture = Picture::new();
    let cases =
        [(DVec2::new(-0.9, 0.1), DVec2::new(0.9, 0.35)), (DVec2::new(-0.9, 0.55), DVec2::new(0.9, 0.62))];
    for (i, (from, to)) in cases.into_iter().enumerate() {
        picture.move_to([2.6 * i as f64, 0.0]);
        picture.hexagon([0.0; 2], 1.0, TOUCHED);
        let axes =
            Direction::ALL[..3].iter().map(|d| plain_grid().lattice().position(Address::new(0, d.step())));
        let along = (to - from).normalize();
        let mut axes: Vec<DVec2> = axes.collect();
        for axis in &axes {
            let [a, b] = [-0.62, 0.62].map(|t| [axis.x * t, axis.y * t]);
            picture.line(&[a, b], AXIS);
        }
        axes.sort_by(|a, b| a.perp_dot(along).abs().total_cmp(&b.perp_dot(along).abs()));
        let axis = axes[2];
        picture.line(&[[from.x, from.y], [to.x, to.y]], SEGMENT);
        // s axis = from + t (to - from).
        let s = from.perp_dot(along) / axis.perp_dot(along);
        picture.dot([axis.x * s, axis.y * s]);
        let label = if s.abs() <= 0.5 { "within: the centre moves" } else { "beyond: it stays" };
        picture.text([0.0, -0.85], 0.17, label);
    }
    picture.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rule_asks_on_the_way_and_none_in_the_end() {
        let svg = rules();
        for label in ["rule 1", "rule 2", "rule 4", "no rule asks"] {
            assert!(svg.contains(label), "{label}");
        }
    }
}
