//! Centres go onto segments; hexagons that two segments pass are split (paper,
//! sections 7.3 and 7.4).
//!
//! A centre is moved only if all triangles around it stay counter-clockwise.
//! Where a second segment cuts the same hexagon, its centre is split in two, and
//! the gap between them filled with two triangles:
//!
//! ```text
//!      e---d                e-----d
//!     / \ / \              / \ __/ \        c has moved to the first segment,
//!    f---c---b    --->    f---c'----b       c' lies on the second. They share
//!     \ / \ /              \  | \  /        the corners f and b.
//!      g---h                g-c---h
//! ```
//!
//! Which two corners they share the paper shows in its Fig. 14 for one case. Here
//! all pairs are looked at, and of those that leave all triangles
//! counter-clockwise, with corners on a segment at that segment's vertex, the one
//! with the largest smallest angle is taken.

use super::project::Record;
use super::rules::{Passed, Scene};
use crate::net::{Kind, NONE, Net};
use hexdel_geom::{DVec2, orient2d, quality};
use hexdel_grid::Lattice;

/// Times the records are gone through: one that is in another's way may have
/// room when that one has moved.
const ROUNDS: usize = 4;

/// Moves and splits centres; `vertices` are those of the hexagons. Returns how
/// many records found no room.
pub(super) fn place(net: &mut Net, scene: &Scene<'_>, records: &[Record], vertices: &[Option<u32>]) -> usize {
    let copies = vertices.iter().map(|v| v.iter().copied().collect()).collect();
    let mut placer = Placer { net, scene, copies };
    let mut open: Vec<&Record> = records.iter().collect();
    for step in [Placer::move_centre, Placer::split_centre] {
        for _ in 0..ROUNDS {
            let before = open.len();
            open.retain(|record| !step(&mut placer, record));
            if open.len() == before {
                break;
            }
        }
    }
    open.len()
}

/// Hexagons that segments pass without moving them "will not be relocated"
/// (section 7.3): not even with the ring of an input point, if that leaves a
/// larger angle around them.
pub(super) fn settle(net: &mut Net, lattice: &Lattice, passed: &[Passed], vertices: &[Option<u32>]) {
    for (p, &vertex) in passed.iter().zip(vertices) {
        let Some(v) = vertex.filter(|&v| net.vertex(v).kind == Kind::Free) else { continue };
        let own = lattice.position(p.at);
        let (here, there) = (largest_angle(net, v, net.at(v)), largest_angle(net, v, own));
        if there.is_some_and(|there| here.is_none_or(|here| there < here)) {
            net.move_to(v, own, Kind::Free);
        }
    }
}

/// The largest angle of the triangles around a vertex if it were elsewhere,
/// degrees; `None` if one of them would not be counter-clockwise.
fn largest_angle(net: &Net, v: u32, at: DVec2) -> Option<f64> {
    let mut star = Vec::with_capacity(8);
    net.star(v, &mut star);
    star.iter().try_fold(0.0, |most: f64, &t| {
        let [a, b, c] = net.tri(t).v.map(|w| if w == v { at } else { net.at(w) });
        let angles = || quality::angles_deg([a, b, c]).into_iter().fold(most, f64::max);
        (orient2d(a, b, c) > 0.0).then(angles)
    })
}

struct Placer<'a> {
    net: &'a mut Net,
    scene: &'a Scene<'a>,
    /// By hexagon: its vertices, one more for each split.
    copies: Vec<Vec<u32>>,
}

/// A way to split a vertex: it keeps the corners of its star from one index to
/// another, its twin gets the others; both are shared.
#[derive(Clone, Copy)]
struct Split {
    vertex: u32,
    from: usize,
    to: usize,
}

impl Placer<'_> {
    /// Moves a centre that nothing has moved yet.
    fn move_centre(&mut self, record: &Record) -> bool {
        let Some(&v) = self.copies[record.hexagon as usize].first() else { return false };
        if self.net.vertex(v).kind != Kind::Free {
            return false;
        }
        let fits = largest_angle(self.net, v, record.at).is_some();
        if fits {
            self.net.move_to(v, record.at, Kind::Along { piece: record.piece, t: record.t });
        }
        fits
    }

    /// Splits a centre that has been moved onto another piece.
    fn split_centre(&mut self, record: &Record) -> bool {
        let mut best: Option<((usize, f64), Split)> = None;
        for &vertex in &self.copies[record.hexagon as usize] {
            let Kind::Along { piece, .. } = self.net.vertex(vertex).kind else { continue };
            if piece == record.piece {
                return false;
            }
            let ring = self.ring(vertex);
            for from in 0..ring.len() {
                for to in (0..ring.len()).filter(|&to| to != from) {
                    let split = Split { vertex, from, to };
                    let Some(angle) = self.smallest_angle(split, &ring, record.at) else { continue };
                    let score = (self.misplaced(split, &ring, record.piece), angle);
                    let better = |b: &(usize, f64)| score.0 < b.0 || (score.0 == b.0 && score.1 > b.1);
                    if best.as_ref().is_none_or(|(b, _)| better(b)) {
                        best = Some((score, split));
                    }
                }
            }
        }
        let Some((_, split)) = best else { return false };
        let twin = self.split(split, record);
        self.copies[record.hexagon as usize].push(twin);
        true
    }

    /// The corners around a vertex.
    fn ring(&self, v: u32) -> Vec<u32> {
        let mut star = Vec::with_capacity(8);
        self.net.star(v, &mut star);
        let corner = |&t: &u32| self.net.tri(t).corner(v).map(|i| self.net.tri(t).edge(i)[0]);
        star.iter().filter_map(corner).collect()
    }

    /// The smallest angle after a split, or `None` if a triangle would not be
    /// counter-clockwise.
    fn smallest_angle(&self, split: Split, ring: &[u32], twin: DVec2) -> Option<f64> {
        let at = |place: Place| match place {
            Place::Vertex(v) => self.net.at(v),
            Place::Twin => twin,
        };
        triangles(split, ring).into_iter().try_fold(180.0, |least: f64, corners| {
            let [a, b, c] = corners.map(at);
            let angles = || quality::angles_deg([a, b, c]).into_iter().fold(least, f64::min);
            (orient2d(a, b, c) > 0.0).then(angles)
        })
    }

    /// How many corners on one of the two pieces would be at the vertex of the
    /// other.
    fn misplaced(&self, split: Split, ring: &[u32], other: u32) -> usize {
        let Kind::Along { piece, .. } = self.net.vertex(split.vertex).kind else { return 0 };
        let inner = |from: usize, to: usize| {
            let count = (to + ring.len() - from) % ring.len();
            (1..count).map(move |k| ring[(from + k) % ring.len()])
        };
        let wrong = |v: u32, own: u32, foreign: u32| self.is_on(v, foreign) && !self.is_on(v, own);
        inner(split.from, split.to).filter(|&v| wrong(v, piece, other)).count()
            + inner(split.to, split.from).filter(|&v| wrong(v, other, piece)).count()
    }

    fn is_on(&self, v: u32, piece: u32) -> bool {
        match self.net.vertex(v).kind {
            Kind::Along { piece: own, .. } => own == piece,
            Kind::Site(site) => self.scene.pieces[piece as usize].ends.contains(&site),
            _ => false,
        }
    }

    fn split(&mut self, split: Split, record: &Record) -> u32 {
        let ring = self.ring(split.vertex);
        let mut star = Vec::with_capacity(8);
        self.net.star(split.vertex, &mut star);
        let kind = Kind::Along { piece: record.piece, t: record.t };
        let twin = self.net.add_vertex(record.at, kind);
        let number = |place: Place| match place {
            Place::Vertex(v) => v,
            Place::Twin => twin,
        };
        let new: Vec<[u32; 3]> =
            triangles(split, &ring).into_iter().map(|corners| corners.map(number)).collect();
        self.net.replace(&star, &new, |_, _| NONE);
        twin
    }
}

/// A corner of a triangle while a vertex is being split.
#[derive(Clone, Copy)]
enum Place {
    Vertex(u32),
    /// The vertex that is not there yet.
    Twin,
}

/// The triangles around a vertex and its twin.
fn triangles(split: Split, ring: &[u32]) -> Vec<[Place; 3]> {
    let n = ring.len();
    let corner = |i: usize| Place::Vertex(ring[i % n]);
    let own = Place::Vertex(split.vertex);
    let kept = (split.to + n - split.from) % n;
    let fan = |centre: Place, from: usize, count: usize| {
        (from..from + count).map(move |i| [centre, corner(i), corner(i + 1)])
    };
    let gap = [[own, corner(split.to), Place::Twin], [own, Place::Twin, corner(split.from)]];
    fan(own, split.from, kept).chain(fan(Place::Twin, split.to, n - kept)).chain(gap).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::validate::Piece;
    use hexdel_geom::{TriMesh, VertexId};
    use hexdel_grid::{Address, Hex};

    /// A hexagon around the origin, its neighbours at distance 1, and two
    /// pieces through it that meet in neighbour 3, at (-1, 0).
    fn star() -> (Net, Vec<DVec2>, Vec<Piece>) {
        let mut vertices = vec![DVec2::ZERO];
        vertices.extend((0..6).map(|i| DVec2::from_angle((60.0 * f64::from(i)).to_radians())));
        let id = VertexId::new;
        let triangles = (0..6).map(|i| [id(0), id(1 + i), id(1 + (i + 1) % 6)]).collect();
        let mut net = Net::of(&TriMesh { vertices: vertices.clone(), triangles });
        let sites = vec![vertices[4], DVec2::new(1.0, 0.6), DVec2::new(1.0, -0.6)];
        net.lines = vec![[sites[0], sites[1]], [sites[0], sites[2]]];
        net.move_to(4, sites[0], Kind::Site(0));
        let pieces = vec![Piece { ends: [0, 1], segment: 0 }, Piece { ends: [0, 2], segment: 1 }];
        (net, sites, pieces)
    }

    fn record(net: &Net, piece: u32) -> Record {
        Record { hexagon: 0, piece, t: 0.5, at: net.along(piece, 0.5) }
    }

    fn scene<'a>(sites: &'a [DVec2], pieces: &'a [Piece]) -> Scene<'a> {
        Scene { sites, pieces, input_of_site: &[0, 1, 2], max_triangles: 100 }
    }

    #[test]
    fn a_hexagon_of_two_segments_is_split() {
        let (mut net, sites, pieces) = star();
        let records = [record(&net, 0), record(&net, 1)];
        assert_eq!(place(&mut net, &scene(&sites, &pieces), &records, &[Some(0)]), 0);
        assert_eq!(net.violation(), None);
        assert_eq!(net.alive().count(), 8);
        assert_eq!((net.at(0), net.at(7)), (records[0].at, records[1].at));
        // Both are neighbours of where the segments meet, and of each other;
        // each keeps the neighbours on its side.
        for (a, b) in [(0, 4), (7, 4), (0, 7), (0, 2), (0, 3), (7, 5), (7, 6)] {
            assert!(net.find_either(a, b).is_some(), "{a} {b}");
        }
        assert!(net.find_either(0, 5).is_none() && net.find_either(7, 3).is_none());
    }

    #[test]
    fn what_would_turn_over_is_left_out() {
        let (mut net, sites, pieces) = star();
        net.lines[1] = [sites[0], DVec2::new(1.0, -3.0)];
        // Beyond the side between two neighbours.
        let records = [Record { at: DVec2::new(0.0, -0.9), ..record(&net, 1) }];
        assert_eq!(place(&mut net, &scene(&sites, &pieces), &records, &[Some(0)]), 1);
        assert_eq!((net.at(0), net.violation()), (DVec2::ZERO, None));
        // Behind the other segment's vertex no split helps.
        let outside = Record { at: DVec2::new(-2.0, 0.0), ..record(&net, 1) };
        let records = [record(&net, 0), outside];
        assert_eq!(place(&mut net, &scene(&sites, &pieces), &records, &[Some(0)]), 1);
        assert_eq!((net.alive().count(), net.violation()), (6, None));
    }

    #[test]
    fn centres_that_nothing_projects_go_home_if_that_is_better() {
        let lattice = Lattice::new(DVec2::ZERO, 1.0);
        let passed = [Passed { at: Address::new(0, Hex::ORIGIN), pieces: vec![0] }];
        for (shift, home) in [(DVec2::new(0.3, 0.2), true), (DVec2::ZERO, false)] {
            let (mut net, ..) = star();
            net.move_to(0, shift, Kind::Free);
            settle(&mut net, &lattice, &passed, &[Some(0)]);
            assert_eq!(net.at(0) != shift, home);
            assert_eq!(net.at(0), DVec2::ZERO);
        }
        let (mut net, ..) = star();
        let along = Kind::Along { piece: 0, t: 0.5 };
        net.move_to(0, DVec2::new(0.0, 0.3), along);
        settle(&mut net, &lattice, &passed, &[Some(0)]);
        assert_eq!(net.at(0), DVec2::new(0.0, 0.3));
    }
}
