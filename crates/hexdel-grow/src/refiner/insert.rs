//! Off-centres: a vertex that sees the shortest edge of a bad triangle under a little more than the bound.

use hexdel_geom::DVec2;

use super::place::{Outline, TURNED};
use super::{Candidate, Refiner, Trial};

/// Degrees that the angle is above the lower bound.
const SLACK_DEG: f64 = 3.0;

impl Refiner<'_> {
    /// Tries the off-centre of a triangle, or a place near it: whether all triangles around it are within the bounds then.
    /// Else it is what could be inserted all the same, if anything, or a segment is in the way.
    pub(super) fn off_centre(&mut self, t: u32, trial: &mut Trial) -> bool {
        let (x, shortest_sq) = self.off_centre_of(t);
        let cavity = match self.find_cavity(x, t) {
            Ok(Some(cavity)) => cavity,
            Ok(None) => return false,
            Err(c) => {
                self.meet(c);
                trial.hit = c;
                return false;
            }
        };
        let near = |&v: &u32| self.mesh.at(v).distance_squared(x) < self.near_sq * shortest_sq;
        if cavity.ring().iter().any(near) {
            return false;
        }
        let bad = self.fan_bad(&cavity, x);
        let mut at = (bad == 0).then_some(x);
        if bad > 0 && cavity.len() <= self.limits.most_around && self.outline(&cavity) == Outline::Fits {
            at = self.place(&cavity, x);
        }
        let cures = bad < TURNED && cavity.triangles().contains(&t);
        if at.is_some() || cures {
            trial.candidate = Some(Candidate::new(&cavity, at.unwrap_or(x)));
        }
        at.is_some()
    }

    /// The place, and the squared length of the shortest edge: on its bisector, or the circumcentre if that is nearer.
    fn off_centre_of(&self, t: u32) -> (DVec2, f64) {
        let p = self.mesh.corners(t);
        let length = |i: usize| p[i].distance_squared(p[(i + 1) % 3]);
        let k = (0..3).fold(0, |k, i| if length(i) < length(k) { i } else { k });
        let (a, b, c) = (p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
        let (ab, ac) = (b - a, c - a);
        // Heights over the edge, in edge lengths: with c at (x, y) the circumcentre is (y^2 + x^2 - x) / 2y high.
        let double_area = ab.perp_dot(ac);
        let circum = if double_area > 0.0 { 0.5 * ac.dot(c - b) / double_area } else { f64::MAX };
        (a + 0.5 * ab + self.off_height().min(circum) * ab.perp(), ab.length_squared())
    }

    /// How high the off-centre is over its edge, in lengths of the edge.
    pub(super) fn off_height(&self) -> f64 {
        0.5 / libm::tan(0.5 * (self.limits.lo_deg + SLACK_DEG).to_radians())
    }

    /// Notes a segment that is in the way, by a corner opposite its edge.
    pub(crate) fn meet(&mut self, c: u32) {
        if self.segments_met.len() < 8 && !self.segments_met.contains(&c) {
            self.segments_met.push(c);
        }
    }
}
