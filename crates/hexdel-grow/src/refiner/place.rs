//! A place for one vertex in a cavity: projections onto the bounds of the fan's corners.

use hexdel_geom::DVec2;
use hexdel_optimize::edit::{Cavity, Kind, MOST_EDGES};

use super::Refiner;
use crate::limits::surely_turns_left;

/// Sweeps over all corners of the fan.
const SWEEPS: usize = 15;

/// A corner is pushed by this much of what takes it onto its bound.
const RELAXATION: f64 = 1.6;

/// Sweeps go on as long as three move the vertex by less than this much of the three before, squared.
const PROGRESS: f64 = 0.7;

/// Keeps the step finite where an apex is in the middle of its edge.
const REGULAR: f64 = 1e-3;

/// Count of bad triangles of a fan with one that is not surely counter-clockwise.
pub(crate) const TURNED: usize = 1000;

/// What forbids a vertex in a cavity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outline {
    /// Nothing.
    Fits,
    /// This corner, the worst one.
    Corner(usize),
    /// A corner on the segment, for whatever cavity.
    Never,
}

impl Refiner<'_> {
    /// Moves a vertex of a triangle to where all triangles around it are within the bounds.
    pub(crate) fn move_one(&mut self, t: u32) -> bool {
        for v in self.mesh.vertices(t) {
            if self.mesh.kind[v as usize] != Kind::Free {
                continue;
            }
            let Some(star) = self.mesh.cavity_around(v) else { continue };
            if star.len() > self.limits.most_around || self.outline(&star) != Outline::Fits {
                continue;
            }
            if let Some(p) = self.place(&star, self.mesh.at(v)) {
                self.stats.moves += 1;
                self.mesh.move_to(v, p);
                return true;
            }
        }
        false
    }

    /// The corner of a cavity's outline that forbids a vertex inside: each is divided in two there, or stays
    /// whole on a segment.
    pub(crate) fn outline(&self, cavity: &Cavity) -> Outline {
        let ring = cavity.ring();
        let n = ring.len();
        let (mut worst, mut found) = (0.0, Outline::Fits);
        let (mut before, mut here) = (self.mesh.at(ring[n - 1]), self.mesh.at(ring[0]));
        for j in 0..n {
            let after = self.mesh.at(ring[cavity.after(j)]);
            let (u, w) = (after - here, before - here);
            let (dot, cross) = (u.dot(w), u.perp_dot(w));
            let lack = if cavity.on_segment && j < 2 {
                if dot < -1e-12 * cross.abs() || cross <= 0.0 {
                    return Outline::Never;
                }
                let side = if j == 0 { n - 1 } else { 1 };
                let exempt = || {
                    self.mesh.kind[ring[j] as usize] == Kind::Fixed
                        && self.mesh.segment(cavity.inner(side)).is_some()
                };
                if self.limits.too_narrow(dot, cross) && !exempt() { dot / cross } else { 0.0 }
            } else if cross < 0.0 {
                1e9 - cross / (dot.abs() + f64::MIN_POSITIVE)
            } else if self.limits.too_narrow_for_two(dot, cross) {
                dot / (cross + f64::MIN_POSITIVE) + 10.0
            } else {
                0.0
            };
            if lack > worst {
                (worst, found) = (lack, Outline::Corner(j));
            }
            (before, here) = (here, after);
        }
        found
    }

    /// A place in a cavity, from `start`, with every triangle of the fan within the bounds.
    pub(crate) fn place(&self, cavity: &Cavity, start: DVec2) -> Option<DVec2> {
        let ring = cavity.ring();
        let n = ring.len();
        let mut at = [DVec2::ZERO; MOST_EDGES];
        let mut sides = [(DVec2::ZERO, 0.0, 0.0); MOST_EDGES];
        for (p, &v) in at.iter_mut().zip(ring) {
            *p = self.mesh.at(v);
        }
        for i in 0..n {
            let e = at[cavity.after(i)] - at[i];
            let length_sq = e.length_squared();
            sides[i] = (e, length_sq, 1.0 / length_sq);
        }
        let mut x = start;
        let mut last = f64::MAX;
        for sweep in 0..SWEEPS {
            let (out, moved) = self.sweep(&at[..n], &sides[..n], &mut x);
            if !out && (moved == 0.0 || self.fan_bad(cavity, x) == 0) {
                break;
            }
            if sweep == 1 || sweep >= 3 && sweep % 3 == 0 {
                if sweep > 1 && moved > PROGRESS * last {
                    break;
                }
                last = moved;
            }
        }
        (self.fan_bad(cavity, x) == 0).then_some(x)
    }

    /// Pushes all corners of a fan once: whether one was out of the bounds, and how far the vertex went, in squares of
    /// edges.
    #[inline]
    fn sweep(&self, at: &[DVec2], sides: &[(DVec2, f64, f64)], x: &mut DVec2) -> (bool, f64) {
        let (mut out, mut moved) = (false, 0.0);
        for (&p, &(e, length_sq, inverse)) in at.iter().zip(sides) {
            let normal = e.perp();
            for corner in 0..3 {
                let d = *x - p;
                let (along, cross) = (e.dot(d), e.perp_dot(d));
                // The dot product at this corner, and how it changes.
                let (dot, by) = match corner {
                    0 => (along, e),
                    1 => (length_sq - along, -e),
                    _ => (d.length_squared() - along, 2.0 * d - e),
                };
                let Some(push) = self.limits.push(dot, cross) else { continue };
                let gradient = push.by_dot * by + push.by_cross * normal;
                let regular = if corner == 2 { REGULAR * length_sq } else { 0.0 };
                let step = gradient * (-RELAXATION * push.g / (gradient.length_squared() + regular));
                *x += step;
                moved += step.length_squared() * inverse;
                out |= push.is_out;
            }
        }
        (out, moved)
    }

    /// How many triangles of a fan are out of the bounds, or too large where vertices go for it; [`TURNED`] if one is
    /// not surely counter-clockwise.
    pub(crate) fn fan_bad(&self, cavity: &Cavity, x: DVec2) -> usize {
        let ring = cavity.ring();
        let n = ring.len();
        let first = usize::from(cavity.on_segment);
        let mut bad = 0;
        let mut p = self.mesh.at(ring[first]);
        for i in first..n {
            let to = cavity.after(i);
            let r = self.mesh.at(ring[to]);
            let (e, d) = (r - p, x - p);
            if !surely_turns_left(e, d) {
                return TURNED;
            }
            let (along, cross) = (e.dot(d), e.perp_dot(d));
            let dots = [along, e.length_squared() - along, d.length_squared() - along];
            let (high, low) = (self.limits.hi * cross, self.limits.lo * cross);
            if dots.iter().any(|&dot| dot < high) {
                bad += 1;
            } else if dots.iter().any(|&dot| dot > low) {
                let exempt = |at: usize, side: usize| {
                    self.mesh.kind[ring[at] as usize] == Kind::Fixed
                        && self.mesh.segment(cavity.inner(side)).is_some()
                };
                let at_first = cavity.on_segment && i == 1 && exempt(1, 1);
                let at_last = cavity.on_segment && i + 1 == n && exempt(0, n - 1);
                let is_bad = (dots[0] > low && !at_first) || (dots[1] > low && !at_last) || dots[2] > low;
                bad += usize::from(is_bad);
            }
            p = r;
        }
        bad + usize::from(self.loses_size(cavity, x))
    }

    /// How many triangles of a cavity are out of the bounds.
    pub(crate) fn cavity_bad(&self, cavity: &Cavity) -> usize {
        cavity.triangles().iter().filter(|&&t| self.is_bad(t)).count()
    }

    /// The mean of a cavity's vertices.
    pub(crate) fn middle(&self, cavity: &Cavity) -> DVec2 {
        let sum: DVec2 = cavity.ring().iter().map(|&v| self.mesh.at(v)).sum();
        sum / cavity.len() as f64
    }
}
