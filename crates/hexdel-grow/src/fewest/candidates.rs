//! Places for a Steiner point that may mend a bad triangle.

use hexdel_geom::DVec2;
use hexdel_optimize::edit::{Cavity, NONE};

use crate::refiner::place::{Outline, TURNED};
use crate::refiner::search::DEPTH;
use crate::refiner::{Candidate, Refiner};

/// Cavities looked at.
const NODES: usize = 20;

/// Cavities with a place that are offered.
const STARS: usize = 4;

/// Two lines that meet at less than about this angle, radians, are parallel.
const PARALLEL: f64 = 1e-9;

/// The shortest part of an edge that is cut off it.
const SHORTEST: f64 = 1e-4;

/// What could be inserted.
pub(super) struct Offer {
    /// How many bad triangles it adds, less the Steiner points that go with its cavity.
    pub(super) bad_more: i32,
    pub(super) candidate: Candidate,
}

impl Refiner<'_> {
    /// All that could be inserted at a bad triangle.
    pub(super) fn offers(&mut self, t: u32, out: &mut Vec<Offer>) {
        self.segments_met.clear();
        for x in places_in(self.mesh.corners(t)) {
            match self.find_cavity(x, t) {
                Ok(Some(cavity)) => self.offer(&cavity, x, out),
                Ok(None) => {}
                Err(c) => self.meet(c),
            }
        }
        self.offer_stars(t, out);
        let mut segments: Vec<u32> = (3 * t..3 * t + 3).filter(|&c| self.mesh.segment(c).is_some()).collect();
        segments.extend(self.segments_met.iter().filter(|c| *c / 3 != t));
        for c in segments {
            self.offer_on_segment(c, out);
        }
    }

    /// Division of the edge opposite a corner, at feet of altitudes and the like, and where no triangle would be bad.
    fn offer_on_segment(&mut self, c: u32, out: &mut Vec<Offer>) {
        let Some(edge) = self.divisible(c) else { return };
        let twin = self.mesh.twin[c as usize];
        let feet = [c, twin].into_iter().filter(|&c| c != NONE).map(|c| self.foot(&edge, c));
        let feet = feet.filter(|s| (SHORTEST..=1.0 - SHORTEST).contains(s));
        for s in feet.chain(self.places(&edge).iter().map(|place| place.s)) {
            if let Some((candidate, more)) = self.division(&edge, s) {
                out.push(Offer { bad_more: more as i32, candidate });
            }
        }
        let other = (twin != NONE).then(|| self.mesh.cavity_on(twin));
        if let Some(candidate) = self.on_edge(&self.mesh.cavity_on(c), other.as_ref()) {
            let cavities = std::iter::once(&candidate.cavity).chain(&candidate.other);
            let before: usize = cavities.map(|cavity| self.cavity_bad(cavity)).sum();
            out.push(Offer { bad_more: -(before as i32), candidate });
        }
    }

    fn offer(&self, cavity: &Cavity, x: DVec2, out: &mut Vec<Offer>) {
        let after = self.fan_bad(cavity, x);
        if after < TURNED {
            let before = self.cavity_bad(cavity) + cavity.enclosed().len();
            let bad_more = after as i32 - before as i32;
            out.push(Offer { bad_more, candidate: Candidate::new(cavity, x) });
        }
    }

    /// Cavities grown from a triangle in which one Steiner point leaves no bad triangle.
    fn offer_stars(&mut self, t: u32, out: &mut Vec<Offer>) {
        let mut cavities = std::mem::take(&mut self.cavities);
        cavities.clear();
        cavities.push(self.mesh.cavity_of(t));
        let (mut i, mut found) = (0, 0);
        while i < cavities.len().min(NODES) && found < STARS {
            let cavity = cavities[i];
            i += 1;
            match self.outline(&cavity) {
                Outline::Fits if cavity.len() >= 4 && cavity.len() <= self.limits.most_around => {
                    let place = self.place(&cavity, self.middle(&cavity));
                    if let Some(x) = place.or_else(|| self.square_place(&cavity)) {
                        self.offer(&cavity, x, out);
                        found += 1;
                    }
                    for edge in 0..cavity.len() {
                        self.grow(&mut cavities, &cavity, edge);
                    }
                }
                Outline::Corner(j) if cavity.triangles().len() < DEPTH => {
                    self.grow(&mut cavities, &cavity, j);
                    self.grow(&mut cavities, &cavity, cavity.before(j));
                }
                _ => {}
            }
        }
        self.cavities = cavities;
    }

    /// A place in a cavity where lines meet that are at right angles to its edges, at their ends: one that is good with no room to
    /// either side, as among right angles.
    fn square_place(&self, cavity: &Cavity) -> Option<DVec2> {
        let at: Vec<DVec2> = cavity.ring().iter().map(|&v| self.mesh.at(v)).collect();
        let lines: Vec<[DVec2; 2]> = (0..at.len())
            .flat_map(|i| {
                let (p, q) = (at[i], at[cavity.after(i)]);
                let normal = (q - p).perp();
                [[p, normal], [q, normal]]
            })
            .collect();
        let pairs = (0..lines.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.filter_map(|(i, j)| meeting(lines[i], lines[j])).find(|&x| self.fan_bad(cavity, x) == 0)
    }
}

/// Where two lines meet, each a point and a direction.
fn meeting([p, d]: [DVec2; 2], [q, e]: [DVec2; 2]) -> Option<DVec2> {
    let cross = d.perp_dot(e);
    let is_parallel = cross.abs() <= PARALLEL * d.length() * e.length();
    (!is_parallel).then(|| p + d * ((q - p).perp_dot(e) / cross))
}

/// Feet of the altitudes, the circumcentre and the middle of a triangle.
fn places_in(p: [DVec2; 3]) -> impl Iterator<Item = DVec2> {
    let foot = move |k: usize| {
        let (a, b, c) = (p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
        let s = (a - b).dot(c - b) / (c - b).length_squared();
        (s > 0.0 && s < 1.0).then(|| b + s * (c - b))
    };
    let (ab, ac) = (p[1] - p[0], p[2] - p[0]);
    let double_area = ab.perp_dot(ac);
    let circumcentre = (double_area > 0.0).then(|| {
        p[0] + (ab.perp() * ac.length_squared() - ac.perp() * ab.length_squared()) / (2.0 * double_area)
    });
    (0..3).filter_map(foot).chain(circumcentre).chain([(p[0] + p[1] + p[2]) / 3.0])
}
