//! Where the lattice of a session is laid: as a mesh made at once would lay it, as far as
//! the domain allows, and again when so many points have come or gone that the price is in
//! proportion.

use super::{STEPS, TemplateSession};
use hexdel_geom::{DVec2, closest_pair};
use hexdel_grid::Lattice;
use hexdel_mesher::Method;
use hexdel_mesher::for_sessions::{ALIKE, excess, most_steps, steps_for};

/// One of so many points goes, and all are put in anew: over more than a few hexagons
/// they may hold each other down. When as many have come or gone, the lattice may be laid
/// anew.
const SHARE: usize = 16;

/// One of so many points comes or goes, and the closest pair is asked for: that takes a
/// ten-thousandth of a millisecond for each point.
const LOOK_SHARE: usize = 1024;

/// Points that have come or gone since something was done about all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Since {
    /// Those gone since all others were put in anew.
    pub(super) gone: usize,
    /// Those come and gone since the closest pair was asked for.
    pub(super) seen: usize,
    /// Those come and gone, up to as many as there are, but for a sixteenth of the points for
    /// each time that the lattice was laid anew because of them.
    pub(super) laid: usize,
}

impl Since {
    /// After so many points have come, and there are so many then.
    pub(super) fn and_come(self, points: usize, present: usize) -> Self {
        Self { seen: self.seen + points, laid: (self.laid + points).min(present), ..self }
    }

    /// After so many points have gone, of so many.
    pub(super) fn and_gone(self, points: usize, present: usize) -> Self {
        Self { gone: self.gone + points, ..self.and_come(points, present) }
    }

    /// After the lattice was laid anew for so many points.
    pub(super) fn and_laid(self, points: usize) -> Self {
        Self { laid: self.laid.saturating_sub(points.div_ceil(SHARE)), seen: 0, gone: 0 }
    }

    /// After all points were put in anew.
    pub(super) fn and_lifted(self) -> Self {
        Self { seen: 0, gone: 0, ..self }
    }

    /// Whether so many points are to be put in anew.
    pub(super) fn is_lift_due(self, points: usize) -> bool {
        self.gone * SHARE >= points
    }

    /// Whether another lattice may be laid for so many points, and it is time to find out
    /// whether one is better.
    pub(super) fn is_look_due(self, points: usize) -> bool {
        self.seen * LOOK_SHARE >= points && self.laid * SHARE >= points
    }
}

impl TemplateSession {
    /// The lattice for points in the domain, and its steps: the one there is with the longest
    /// edges along the rim, if no other suits them better.
    pub(super) fn best_lattice(&self, points: &[DVec2]) -> (Lattice, u32) {
        let now = self.coarsest();
        match self.better_lattice(points) {
            None if now.1 <= most_steps(Method::Templates, points.len()) => now,
            None => fitting(self.domain(), points),
            Some(better) => better,
        }
    }

    /// The lattice for points in the domain, and its steps, if that suits them better than the
    /// one there is.
    pub(super) fn better_lattice(&self, points: &[DVec2]) -> Option<(Lattice, u32)> {
        let pair = closest_pair(points)?.distance;
        let best = fitting_pair(self.domain(), points.len(), pair);
        let [one, other] = [&best.0, &self.grown.lattice()].map(|l| excess(l.spacing(0), pair));
        (other > ALIKE * one).then_some(best)
    }

    /// The lattice with the longest edges along the rim, and its steps.
    pub(super) fn coarsest(&self) -> (Lattice, u32) {
        let (mut lattice, mut steps) = (self.grown.lattice(), self.grown.steps());
        while steps.is_multiple_of(2) && steps > STEPS {
            lattice = Lattice::new(lattice.origin(), 2.0 * lattice.spacing(0));
            steps /= 2;
        }
        (lattice, steps)
    }
}

/// The lattice that suits points best in a domain, and its steps to the corners.
pub(super) fn fitting(domain: (DVec2, f64), points: &[DVec2]) -> (Lattice, u32) {
    let pair = closest_pair(points).map_or(f64::INFINITY, |pair| pair.distance);
    fitting_pair(domain, points.len(), pair)
}

fn fitting_pair((centre, radius): (DVec2, f64), points: usize, pair: f64) -> (Lattice, u32) {
    let steps = if pair < f64::INFINITY {
        steps_for(radius, pair, most_steps(Method::Templates, points))
    } else {
        STEPS
    };
    (Lattice::new(centre, radius / f64::from(steps)), steps)
}
