//! Division of segments that are in the way.

use hexdel_geom::DVec2;
use hexdel_optimize::edit::{Kind, NONE, next, prev};

use super::place::TURNED;
use super::{Candidate, Refiner};

/// How much worse than a shell, in bad triangles, another place is on an edge at an input point, and on any other.
const SHELL_WORTH: [f64; 2] = [2.0, 0.1];

/// Parts of an edge between which a shell of powers of two lies.
const SHELL: [f64; 2] = [0.25, 0.75];

/// Parts between which the place of the nearest vertex of a neighbouring segment is of use.
const MATCHED: [f64; 2] = [0.2, 0.8];

/// Places that are looked at.
const MOST_PLACES: usize = 12;

/// A place on an edge, as a part of it, and whether it is on a shell around the input point at one end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) s: f64,
    is_shell: bool,
}

/// An edge that is to be divided.
pub(crate) struct Edge {
    corner: u32,
    segment: u32,
    from: DVec2,
    along: DVec2,
    /// Whether the one end or the other, but not both, is an input point.
    start_is_input: bool,
    end_is_input: bool,
}

impl Edge {
    fn has_shells(&self) -> bool {
        self.start_is_input != self.end_is_input
    }
}

/// The largest power of two that is not larger. Exact.
pub(crate) fn power_of_two(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
}

impl Refiner<'_> {
    /// Divides the edge opposite a corner, where that leaves the fewest bad triangles: at a power of two from an
    /// input point at one end, as far as a vertex on a neighbouring segment, at the feet of the altitudes, about the middle.
    pub(super) fn split(&mut self, c: u32) -> bool {
        let Some(edge) = self.divisible(c) else { return false };
        let mut best: Option<(f64, Candidate, bool)> = None;
        for (j, place) in self.places(&edge).into_iter().enumerate() {
            let Some((candidate, gain)) = self.division(&edge, place.s) else { continue };
            let worth = SHELL_WORTH[usize::from(!edge.has_shells())];
            let key = gain + if place.is_shell { 0.0 } else { worth } + 1e-3 * j as f64;
            if best.as_ref().is_none_or(|best| key < best.0) {
                best = Some((key, candidate, place.is_shell));
            }
        }
        let Some((_, candidate, is_shell)) = best else { return false };
        let v = self.commit(&candidate);
        self.stats.splits += 1;
        if is_shell && (edge.start_is_input || edge.end_is_input) {
            self.mesh.kind[v as usize] = Kind::Held;
        }
        true
    }

    /// Divides the edge opposite a corner at this part of it.
    pub(super) fn split_at(&mut self, c: u32, s: f64) -> bool {
        let Some((candidate, _)) = self.divisible(c).and_then(|edge| self.division(&edge, s)) else {
            return false;
        };
        self.commit(&candidate);
        self.stats.splits += 1;
        true
    }

    /// The edge opposite a corner, if it is on a segment and may be divided.
    pub(crate) fn divisible(&self, c: u32) -> Option<Edge> {
        let segment = self.mesh.segment(c).filter(|_| !self.mesh.is_locked(c))?;
        let [a, b] = self.mesh.edge(c);
        let is_input = |v: u32| self.mesh.kind[v as usize] == Kind::Fixed;
        Some(Edge {
            corner: c,
            segment,
            from: self.mesh.at(a),
            along: self.mesh.at(b) - self.mesh.at(a),
            start_is_input: is_input(a),
            end_is_input: is_input(b),
        })
    }

    /// A vertex on an edge with the Delaunay cavities on both sides, and how many bad triangles it brings.
    pub(crate) fn division(&self, edge: &Edge, s: f64) -> Option<(Candidate, f64)> {
        let at = self.on_segment(edge.segment, edge.from + s * edge.along);
        let cavity = self.delaunay_half(at, edge.corner);
        let twin = self.mesh.twin[edge.corner as usize];
        let other = (twin != NONE).then(|| self.delaunay_half(at, twin));
        if other.as_ref().is_some_and(|other| cavity.touches(other)) {
            return None;
        }
        let after = self.fan_bad(&cavity, at) + other.as_ref().map_or(0, |c| self.fan_bad(c, at));
        if after >= TURNED {
            return None;
        }
        let before = self.cavity_bad(&cavity) + other.as_ref().map_or(0, |c| self.cavity_bad(c));
        Some((Candidate { cavity, other, at }, after as f64 - before as f64))
    }

    /// The foot of the altitude from a corner, as a part of an edge.
    pub(crate) fn foot(&self, edge: &Edge, c: u32) -> f64 {
        (self.mesh.at(self.mesh.v(c)) - edge.from).dot(edge.along) / edge.along.length_squared()
    }

    /// Places to divide an edge at, the preferred one first.
    pub(crate) fn places(&self, edge: &Edge) -> Vec<Place> {
        let length = edge.along.length();
        let mut places = Vec::with_capacity(MOST_PLACES);
        places.push(Place { s: shell(edge, length), is_shell: true });
        let mut add = |s: f64| places.push(Place { s, is_shell: false });
        let twin = self.mesh.twin[edge.corner as usize];
        let foot = |c: u32| self.foot(edge, c).clamp(0.25, 0.75);
        add(foot(edge.corner));
        [0.5, 0.4, 0.6].into_iter().for_each(&mut add);
        if twin != NONE {
            add(foot(twin));
        }
        if edge.has_shells() {
            self.match_shells(edge, length, &mut places);
        }
        places
    }

    /// As far out as the next vertices on other segments at the input point.
    fn match_shells(&self, edge: &Edge, length: f64, places: &mut Vec<Place>) {
        let [a, b] = self.mesh.edge(edge.corner);
        let v = if edge.start_is_input { a } else { b };
        for c in self.mesh.star(v) {
            for (side, end) in [(prev(c), next(c)), (next(c), prev(c))] {
                if !self.mesh.is_marked(side) || places.len() == MOST_PLACES {
                    continue;
                }
                let part = self.mesh.at(self.mesh.v(end)).distance(self.mesh.at(v)) / length;
                if part > MATCHED[0] && part < MATCHED[1] {
                    let s = if edge.start_is_input { part } else { 1.0 - part };
                    places.push(Place { s, is_shell: true });
                }
            }
        }
    }
}

/// The place of a power of two from the input point at one end; the middle if there is none or two.
fn shell(edge: &Edge, length: f64) -> f64 {
    if !edge.has_shells() {
        return 0.5;
    }
    let part = power_of_two(0.5 * length / SHELL[1]) / length;
    let part = if part > SHELL[1] {
        0.5 * part
    } else if part < SHELL[0] {
        2.0 * part
    } else {
        part
    };
    if edge.start_is_input { part } else { 1.0 - part }
}
