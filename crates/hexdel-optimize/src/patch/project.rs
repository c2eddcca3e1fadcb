//! Projection sweeps: each corner that is outside is pushed onto its bound, by
//! the smallest motion of its triangle's vertices that does it to first
//! order, one corner after the other.
//!
//! This is the relaxation method for inequalities (Motzkin & Schoenberg, "The
//! relaxation method for linear inequalities", 1954) on the functions
//! `|u||w| sin(angle - min)` and `|u||w| sin(max - angle)`, which are
//! quadratic polynomials of the coordinates. Steps beyond the bound by half
//! make it end after finitely many on most patches that have a solution.

use hexdel_geom::DVec2;

use super::Patch;
use crate::angles::{Limits, Measure};
use crate::constraints::Rules;

/// Each push goes this many times as far as to the bound. Between 1 and 2 the
/// method converges; measured best on removals.
const OVER: f64 = 1.6;

/// Sweeps between two looks at the progress.
pub(crate) const WINDOW: usize = 4;

/// A push changes the sine of an angle by no more than twice this: beyond, the
/// first order means nothing.
const CAP: f64 = 0.15;

/// A push whose motions are turned by sliding vertices until no more than this
/// share of their squares is left does not help: it would have to go
/// thousands of times as far.
const STUCK: f64 = 1e-6;

/// How long to sweep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sweeps {
    /// Most sweeps.
    pub(crate) most: usize,
    /// Stop when the energy is not below this share of what it was
    /// `WINDOW` sweeps before.
    pub(crate) stall: f64,
    /// Give up when a sweep but the first finds more energy than this.
    pub(crate) hope: f64,
}

/// How sweeps end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Swept {
    /// Nothing is outside the target.
    Settled,
    /// They got slow, or were too many.
    Stalled,
    /// Too much is outside for more of them to help.
    Hopeless,
}

impl Patch {
    /// Sweeps over the patch until a sweep finds nothing outside the target.
    ///
    /// # Complexity
    ///
    /// A sweep is linear in the patch's triangles.
    pub(crate) fn project(&mut self, rules: &Rules<'_>, sweeps: Sweeps) -> Swept {
        let mut before = f64::INFINITY;
        for sweep in 1..=sweeps.most {
            let energy = self.sweep(rules);
            if energy == 0.0 {
                return Swept::Settled;
            }
            if sweep > 1 && energy > sweeps.hope {
                return Swept::Hopeless;
            }
            if sweep % WINDOW == 0 {
                // A triangle none of whose corners can move makes it infinite.
                if energy > sweeps.stall * before || energy == f64::INFINITY {
                    break;
                }
                before = energy;
            }
        }
        Swept::Stalled
    }

    /// One sweep; returns the sum of squared motions in units of the shortest
    /// edges.
    fn sweep(&mut self, rules: &Rules<'_>) -> f64 {
        let mut energy = 0.0;
        self.visits += self.tris.len() as u64;
        for i in 0..self.tris.len() {
            let t = self.tris[i].map(|v| v as usize);
            let [a, b, c] = t.map(|v| self.pos[v]);
            let place = self.places[i];
            let limits = rules.limits(place);
            let m = Measure::of(a, b, c);
            if limits.on_target(&m) {
                continue;
            }
            let m = place.view(m, limits);
            let Some(pushes) = Push::inside(m, limits) else { return f64::INFINITY };
            for push in pushes.into_iter().flatten() {
                energy += self.push(t, push);
            }
        }
        energy
    }

    #[inline]
    fn push(&mut self, t: [usize; 3], push: Push) -> f64 {
        let v = push.order(t);
        let along = self.slides.then(|| v.map(|v| self.along[v]));
        let motion = push.motion(v.map(|v| self.pos[v]), v.map(|v| self.weight[v]), along);
        let Some((by, energy)) = motion else { return f64::INFINITY };
        for i in 0..3 {
            self.pos[v[i]] += by[i];
        }
        energy
    }
}

/// What brings one corner of a triangle to its bound.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Push {
    corner: usize,
    /// `cross * turn.x + dot * turn.y` at that corner, negative.
    excess: f64,
    turn: DVec2,
}

impl Push {
    /// The pushes for the corners farthest below and above the target, or none at all
    /// where a triangle is collapsed, or lost beyond all numbers.
    #[inline]
    pub(crate) fn inside(m: Measure, limits: &Limits) -> Option<[Option<Self>; 2]> {
        let (low, high) = limits.outside(&m);
        if low.is_none() && (m.cross <= 0.0 || m.cross.is_nan()) {
            return None;
        }
        let push = |turn| move |(corner, excess)| Self { corner, excess, turn };
        Some([low.map(push(limits.lower_turn())), high.map(push(limits.upper_turn()))])
    }

    /// The corners of the triangle, that to be pushed first.
    #[inline]
    pub(crate) fn order<T: Copy>(&self, t: [T; 3]) -> [T; 3] {
        match self.corner {
            0 => t,
            1 => [t[1], t[2], t[0]],
            _ => [t[2], t[0], t[1]],
        }
    }

    /// How corners at such positions move, by weights that are the squares of units of
    /// length, and the square of the motion in these units; none where all are stuck.
    /// `along` are directions of corners that slide, zero for the others.
    #[inline]
    pub(crate) fn motion(
        &self,
        [a, b, c]: [DVec2; 3],
        weight: [f64; 3],
        along: Option<[DVec2; 3]>,
    ) -> Option<([DVec2; 3], f64)> {
        let (g, turn) = (self.excess, self.turn);
        let (u, w) = (b - a, c - a);
        let at_c = turn.x * u.perp() + turn.y * u;
        let at_b = turn.y * w - turn.x * w.perp();
        let mut d = [-(at_b + at_c), at_b, at_c];
        let mut least = 0.0;
        if let Some(along) = along {
            least = STUCK * norm(d, weight);
            for i in 0..3 {
                if along[i] != DVec2::ZERO {
                    d[i] = along[i] * along[i].dot(d[i]);
                }
            }
        }
        let norm = norm(d, weight);
        if norm <= least {
            return None;
        }
        let cap = CAP * (u.length_squared() + w.length_squared());
        let inverse = 1.0 / norm;
        let step = OVER * (-g).min(cap) * inverse;
        Some((std::array::from_fn(|i| d[i] * (weight[i] * step)), g * g * inverse))
    }
}

/// The weighted squares of three motions.
#[inline]
fn norm(d: [DVec2; 3], weight: [f64; 3]) -> f64 {
    weight[0] * d[0].length_squared() + weight[1] * d[1].length_squared() + weight[2] * d[2].length_squared()
}
