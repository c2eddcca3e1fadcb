//! Triangles at occupied hexagons: a bound over every place of the point.
//!
//! The six neighbours stand still (class `Occupied1`) or are shifted together
//! (`Occupied2`); the point `p` ranges over convex polygons with rational
//! corners. For a triangle `(p, a, b)` the conditions are
//!
//! | at | condition | as a function of `p` | decided at |
//! |---|---|---|---|
//! | `a`, `b` | `X > 0`, `9 X >= 5 D`, `D >= 0` | affine | the polygon's corners |
//! | `p` | `9 X >= 5 D` | `5 D - 9 X` is convex | the polygon's corners |
//! | `p` | `D >= 0` | convex | its least value, on an edge or inside |
//!
//! with `X` and `D` as in [`hexdel_classify::exact`]. A convex function has its
//! greatest value over a polygon at a corner, and on an edge it is a quadratic
//! with rational coefficients, whose least value is rational. Nothing is
//! rounded and nothing sampled.

use hexdel_classify::relocate::{ring_may_stay, ring_shift};
use hexdel_classify::{ExactBounds, Offset};
use hexdel_grid::{Direction, Hex, Located};

/// Lattice vectors are counted here in units of `1 / (7 UNIT)` of a step: the
/// regions have corners at 2/7 of a step.
const SEVENTH: i64 = 7;

/// The shortest edge that there is, as a fraction of the spacing of the finest level: that
/// from a point at 2/7 of a step on an axis to the neighbour on it.
pub(crate) const SHORTEST: [i64; 2] = [5, 7];

/// The extreme angles of one sort of triangle, and where they are attained.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extreme {
    /// Degrees.
    pub(crate) angle_deg: f64,
    /// The triangle, in units of a lattice step.
    pub(crate) corners: [[f64; 2]; 3],
    /// Which corner has the angle.
    pub(crate) corner: usize,
}

/// What was found for one sort of triangle.
#[derive(Clone, Debug)]
pub(crate) struct Region {
    /// What it is.
    pub(crate) name: &'static str,
    /// Pairs of a polygon and a triangle, or fixed triangles.
    pub(crate) cases: u64,
    /// Whether all keep the bounds.
    pub(crate) holds: bool,
    /// The shortest edge, in steps, no less than [`SHORTEST`].
    pub(crate) shortest: f64,
    /// The smallest angle.
    pub(crate) least: Extreme,
    /// The largest angle.
    pub(crate) greatest: Extreme,
}

/// All triangles with a corner that an input point touches.
pub(crate) fn all() -> Vec<Region> {
    vec![occupied1(), occupied2(), shifted_ring()]
}

/// The dodecagon in which the ring may stay, counter-clockwise: corners at 2/7
/// of a step on the axes and at the corners of the half-size hexagon.
fn dodecagon() -> Vec<Offset> {
    Direction::ALL.into_iter().flat_map(|d| [axis(d, 2, 7), towards_corner(d, 1, 6)]).collect()
}

/// The part of the cell outside of the dodecagon and nearest to the corner just
/// counter-clockwise of `d`, as two convex polygons.
fn kites(d: Direction) -> [Vec<Offset>; 2] {
    let next = d.turned(1);
    let (inner, corner) = (towards_corner(d, 1, 6), towards_corner(d, 1, 3));
    [
        vec![axis(d, 2, 7), axis(d, 1, 2), corner, inner],
        vec![inner, corner, axis(next, 1, 2), axis(next, 2, 7)],
    ]
}

/// Both regions, drawn (paper, Fig. 8).
pub(crate) fn figure() -> String {
    let corner = Direction::ALL[0];
    let all = |polygon: Vec<Offset>| polygon.into_iter().map(cartesian).collect::<Vec<_>>();
    let shift = shift_for(&kites(corner)[0], corner).cartesian();
    super::figures::regions(&all(dodecagon()), &kites(corner).map(all), [shift.x, shift.y])
}

fn axis(d: Direction, numerator: i64, denominator: i64) -> Offset {
    Offset::fraction(d.step() * SEVENTH, numerator, denominator)
}

fn towards_corner(d: Direction, numerator: i64, denominator: i64) -> Offset {
    Offset::fraction((d.step() + d.turned(1).step()) * SEVENTH, numerator, denominator)
}

fn neighbour(d: Direction, shift: Offset) -> Offset {
    Offset::of(d.step() * SEVENTH) + shift
}

fn occupied1() -> Region {
    let mut tally = Tally::default();
    for d in Direction::ALL {
        tally.region(&dodecagon(), neighbour(d, Offset::ZERO), neighbour(d.turned(1), Offset::ZERO));
    }
    tally.done("Occupied1: the point and its ring")
}

fn occupied2() -> Region {
    let mut tally = Tally::default();
    for corner in Direction::ALL {
        for kite in kites(corner) {
            let shift = scaled(shift_for(&kite, corner));
            for d in Direction::ALL {
                tally.region(&kite, neighbour(d, shift), neighbour(d.turned(1), shift));
            }
        }
    }
    tally.done("Occupied2: the point and its shifted ring")
}

/// The product's shift for a polygon, asked at its centre of mass.
fn shift_for(kite: &[Offset], corner: Direction) -> Offset {
    let mean =
        kite.iter().fold(Offset::ZERO, |a, &b| a + b).cartesian() / (kite.len() as f64 * SEVENTH as f64);
    let at = Located { hex: Hex::ORIGIN, offset: mean };
    debug_assert!(!ring_may_stay(&at), "{corner:?}");
    ring_shift(&at)
}

fn scaled(o: Offset) -> Offset {
    Offset { q: o.q * SEVENTH, r: o.r * SEVENTH }
}

/// The triangles with a shifted corner and without the point.
fn shifted_ring() -> Region {
    let mut tally = Tally::default();
    for corner in Direction::ALL {
        let shift = scaled(shift_for(&kites(corner)[0], corner));
        let place = |at: Hex| {
            let shifted = at.norm() == 1;
            Offset::of(at * SEVENTH) + if shifted { shift } else { Offset::ZERO }
        };
        for h in Hex::ORIGIN.disc(2) {
            for (second, third) in [(0, 1), (1, 2)] {
                let t = [h, h.neighbour(Direction::new(second)), h.neighbour(Direction::new(third))];
                let norms = t.map(Hex::norm);
                if norms.contains(&1) && !norms.contains(&0) {
                    tally.fixed(t.map(place));
                }
            }
        }
    }
    tally.done("Occupied2: the shifted ring and the 2-ring")
}

#[derive(Default)]
struct Tally {
    cases: u64,
    broken: bool,
    shortest: Option<f64>,
    least: Option<Extreme>,
    greatest: Option<Extreme>,
}

impl Tally {
    fn done(self, name: &'static str) -> Region {
        let none = Extreme { angle_deg: f64::NAN, corners: [[0.0; 2]; 3], corner: 0 };
        Region {
            name,
            cases: self.cases,
            holds: !self.broken,
            shortest: self.shortest.unwrap_or(f64::NAN),
            least: self.least.unwrap_or(none),
            greatest: self.greatest.unwrap_or(none),
        }
    }

    fn fixed(&mut self, t: [Offset; 3]) {
        self.cases += 1;
        self.broken |= !ExactBounds::EXTENDED.hold(t);
        self.note(t.map(cartesian));
        for i in 0..3 {
            self.length(&Edge::new(t[i], t[i], t[(i + 1) % 3], t[(i + 1) % 3]));
        }
    }

    /// A triangle `(p, a, b)`, counter-clockwise, for all `p` of a polygon.
    fn region(&mut self, polygon: &[Offset], a: Offset, b: Offset) {
        self.cases += 1;
        // At the corners: everything affine, and the convex lower bound at p.
        for &p in polygon {
            self.broken |= !ExactBounds::EXTENDED.hold([p, a, b]);
            self.note([p, a, b].map(cartesian));
        }
        // Within: D >= 0 at p.
        for i in 0..polygon.len() {
            let (u, v) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            let edge = Edge::new(u, v, a, b);
            self.broken |= !edge.acute();
            // A point is nearest to a corner outside of the polygon on one of its edges.
            for corner in [a, b] {
                self.broken |= contains(polygon, corner);
                self.length(&Edge::new(u, v, corner, corner));
            }
            if let Some(t) = edge.lowest() {
                let (u, v) = (cartesian(u), cartesian(v));
                let p = [u[0] + t * (v[0] - u[0]), u[1] + t * (v[1] - u[1])];
                self.note([p, cartesian(a), cartesian(b)]);
            }
        }
        // The least value over the whole plane is at the middle of a and b: in
        // none of the polygons.
        let twice = |o: Offset| o + o;
        self.broken |= contains(&polygon.iter().map(|&o| twice(o)).collect::<Vec<_>>(), a + b);
    }

    /// Notes the least distance of a corner to an edge of the polygon.
    fn length(&mut self, edge: &Edge) {
        let (twice, denominator) = edge.least();
        let step = i128::from(SEVENTH * Offset::UNIT);
        let [p, q] = SHORTEST.map(i128::from);
        self.broken |= q * q * twice < 2 * p * p * step * step * denominator;
        let length = (twice as f64 / (2.0 * denominator as f64)).sqrt() / step as f64;
        self.shortest = Some(self.shortest.map_or(length, |least| least.min(length)));
    }

    fn note(&mut self, t: [[f64; 2]; 3]) {
        for (corner, angle_deg) in angles_deg(t).into_iter().enumerate() {
            let new = Extreme { angle_deg, corners: t, corner };
            if self.least.is_none_or(|e| angle_deg < e.angle_deg - 1e-9) {
                self.least = Some(new);
            }
            if self.greatest.is_none_or(|e| angle_deg > e.angle_deg + 1e-9) {
                self.greatest = Some(new);
            }
        }
    }
}

/// `D` at `p = u + t (v - u)` between `a` and `b`: `square t^2 + linear t +
/// constant`.
struct Edge {
    square: i128,
    linear: i128,
    constant: i128,
}

impl Edge {
    fn new(u: Offset, v: Offset, a: Offset, b: Offset) -> Self {
        let (along, to_a, to_b) = (v - u, a - u, b - u);
        let d = |x: Offset, y: Offset| i128::from(x.dot2(y));
        Self { square: d(along, along), linear: -d(along, to_a) - d(along, to_b), constant: d(to_a, to_b) }
    }

    /// Whether the least value lies within the edge.
    fn is_inside(&self) -> bool {
        self.linear <= 0 && -self.linear <= 2 * self.square
    }

    /// The least value on the edge, as a fraction.
    fn least(&self) -> (i128, i128) {
        if self.square > 0 && self.is_inside() {
            return (4 * self.square * self.constant - self.linear * self.linear, 4 * self.square);
        }
        (self.constant.min(self.square + self.linear + self.constant), 1)
    }

    /// Whether `D >= 0` all along the edge, given that it is at its ends.
    fn acute(&self) -> bool {
        !self.is_inside() || 4 * self.square * self.constant >= self.linear * self.linear
    }

    /// Where the least value is, if within.
    fn lowest(&self) -> Option<f64> {
        self.is_inside().then(|| -self.linear as f64 / (2 * self.square) as f64)
    }
}

/// Whether a convex polygon, counter-clockwise, holds a point.
fn contains(polygon: &[Offset], p: Offset) -> bool {
    (0..polygon.len()).all(|i| (polygon[(i + 1) % polygon.len()] - polygon[i]).det(p - polygon[i]) >= 0)
}

fn cartesian(o: Offset) -> [f64; 2] {
    let v = o.cartesian() / SEVENTH as f64;
    [v.x, v.y]
}

fn angles_deg(t: [[f64; 2]; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let [p, a, b] = [t[i], t[(i + 1) % 3], t[(i + 2) % 3]];
        let (u, w) = ([a[0] - p[0], a[1] - p[1]], [b[0] - p[0], b[1] - p[1]]);
        (u[0] * w[1] - u[1] * w[0]).atan2(u[0] * w[0] + u[1] * w[1]).to_degrees()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::DVec2;

    fn located(o: Offset, scale: f64) -> Located {
        Located { hex: Hex::ORIGIN, offset: o.cartesian() * (scale / SEVENTH as f64) }
    }

    /// `7 |D| + 3 |X| <= 4` in steps, for the three axes: the product's
    /// condition, in integers.
    fn inside_exactly(p: Offset) -> bool {
        let step = Offset::UNIT * SEVENTH;
        Direction::ALL[..3].iter().all(|d| {
            let u = Offset { q: d.step().q, r: d.step().r };
            7 * u.dot2(p).abs() + 3 * u.det(p).abs() <= 4 * step
        })
    }

    #[test]
    fn the_regions_are_convex_and_those_of_the_product() {
        for polygon in std::iter::once(dodecagon()).chain(Direction::ALL.into_iter().flat_map(kites)) {
            let n = polygon.len();
            for i in 0..n {
                let [a, b, c] = [0, 1, 2].map(|k| polygon[(i + k) % n]);
                assert!((b - a).det(c - b) > 0, "{polygon:?}");
            }
        }
        for p in dodecagon() {
            assert!(inside_exactly(p));
            assert!(ring_may_stay(&located(p, 1.0 - 1e-12)) && !ring_may_stay(&located(p, 1.0 + 1e-12)));
        }
        // Dodecagon and kites fill the cell.
        let area = |p: &[Offset]| (0..p.len()).map(|i| p[i].det(p[(i + 1) % p.len()])).sum::<i64>();
        let kites: i64 = Direction::ALL.into_iter().flat_map(kites).map(|k| area(&k)).sum();
        let step = Offset::UNIT * SEVENTH;
        assert_eq!(area(&dodecagon()) + kites, 2 * step * step);
    }

    #[test]
    fn the_product_puts_points_into_these_regions() {
        let mut seen = [0; 2];
        for i in 0..200_i32 {
            for j in 0..200_i32 {
                let p = DVec2::new(f64::from(i) / 200.0 - 0.4987, f64::from(j) / 170.0 - 0.5877);
                let at = Located { hex: Hex::ORIGIN, offset: p };
                let unit = (Offset::UNIT * SEVENTH) as f64;
                let r = p.y / 0.866_025_403_784_438_6;
                let o = Offset { q: ((p.x - r / 2.0) * unit) as i64, r: (r * unit) as i64 };
                let near = |polygon: &[Offset]| {
                    [(0, 0), (2, 0), (-2, 0), (0, 2), (0, -2)]
                        .into_iter()
                        .any(|(q, r)| contains(polygon, o + Offset { q, r }))
                };
                let corners: Vec<_> =
                    Direction::ALL.into_iter().filter(|&d| kites(d).iter().any(|k| near(k))).collect();
                match (near(&dodecagon()), corners.as_slice()) {
                    (true, []) => {
                        assert!(ring_may_stay(&at));
                        seen[0] += 1;
                    }
                    (false, [d]) => {
                        assert!(!ring_may_stay(&at));
                        assert_eq!(scaled(ring_shift(&at)), towards_corner(*d, 1, 6));
                        seen[1] += 1;
                    }
                    // Outside of the cell, or on a border between two.
                    _ => {}
                }
            }
        }
        assert!(seen[0] > 1000 && seen[1] > 1000);
    }

    #[test]
    fn occupied_hexagons_keep_the_bounds_and_reach_them() {
        for region in all() {
            assert!(region.holds, "{}", region.name);
        }
        assert!((occupied1().least.angle_deg - 43.897_886_248_013_98).abs() < 1e-12);
    }

    #[test]
    fn a_larger_region_is_refused() {
        let mut tally = Tally::default();
        let larger: Vec<_> =
            dodecagon().into_iter().map(|p| Offset { q: p.q + p.q / 1000, r: p.r + p.r / 1000 }).collect();
        for d in Direction::ALL {
            tally.region(&larger, neighbour(d, Offset::ZERO), neighbour(d.turned(1), Offset::ZERO));
        }
        assert!(tally.broken);
    }
}
