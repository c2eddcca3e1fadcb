//! The compact method: a first mesh, grown or of the grid, goes through the optimiser.
//!
//! What vertices may do follows from where they lie: input points and the
//! corners of the domain stay, vertices on its sides slide, all others are
//! free. The optimiser itself is left to `hexdel-optimize`.

use crate::error::Error;
use crate::size::Size;
use crate::start::{Begun, Start};
use hexdel_geom::{AngleBounds, Monitor, Phase, VertexId};
use hexdel_optimize::{Effort, OptimizeError, Optimized, Options, kinds_of, optimize, optimize_sized};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use web_time::Instant;

/// The time that all there is to do may take; what must be done is done without it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Time {
    began: Instant,
    budget: Option<Duration>,
}

impl Time {
    /// So long from now.
    pub(crate) fn new(budget: Option<Duration>) -> Self {
        Self { began: Instant::now(), budget }
    }

    fn left(&self) -> Option<Duration> {
        self.budget.map(|budget| budget.saturating_sub(self.began.elapsed()))
    }

    /// The share of the time left that work may take.
    fn share(&self, share: u32) -> Option<Duration> {
        self.left().map(|left| left / share)
    }

    /// When half of it is over.
    pub(crate) fn deadline(&self) -> Option<Instant> {
        self.budget.and_then(|budget| self.began.checked_add(budget / 2))
    }

    /// Whether there is none left.
    pub(crate) fn is_over(&self) -> bool {
        self.left().is_some_and(|left| left.is_zero())
    }
}

/// More runs, at the least effort that removes vertices, for the few triangles that are left of a mesh that has grown.
const AGAIN: u64 = 3;

/// How optimisation ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ended {
    /// Whether every angle is within the bounds, leaving aside rounding.
    pub(crate) reached: bool,
    /// Whether the budget ended it.
    pub(crate) spent: bool,
}

/// What is asked of the optimiser.
pub(crate) struct Work<'a> {
    pub(crate) bounds: AngleBounds,
    pub(crate) effort: Effort,
    pub(crate) size: Option<&'a Size>,
    pub(crate) monitor: &'a dyn Monitor,
}

impl Work<'_> {
    /// Optimises a mesh in place.
    ///
    /// Where time is limited, a start of the grid that must be repaired is brought within the bounds first, in half of
    /// it, so that the other half is left for a start that needs no repair.
    pub(crate) fn optimize(&self, begun: &mut Begun, start: Start, time: &Time) -> Result<Ended, Error> {
        if start == Start::Grown {
            return self.optimize_grown(begun, time);
        }
        if start == Start::Coarse && time.budget.is_some() {
            let first = self.effort.min(Effort::Fast);
            let ended = self.run(begun, (first, 0), time.share(2))?;
            if !ended.reached || first == self.effort {
                return Ok(ended);
            }
        }
        self.run(begun, (self.effort, 0), time.share(1))
    }

    /// Brings a mesh that has grown within the bounds, then removes vertices, which makes room for what is still out of
    /// bounds.
    fn optimize_grown(&self, begun: &mut Begun, time: &Time) -> Result<Ended, Error> {
        let mut ended = self.run(begun, (Effort::Repair, 0), time.share(2))?;
        if ended.spent && !ended.reached || self.effort == Effort::Repair {
            return Ok(ended);
        }
        ended = self.run(begun, (self.effort, 0), time.share(if ended.reached { 1 } else { 2 }))?;
        for seed in 1..=AGAIN {
            if ended.reached || ended.spent {
                break;
            }
            ended = self.run(begun, (Effort::Fast, seed), time.share(2))?;
        }
        Ok(ended)
    }

    /// One run at an effort, with a seed.
    fn run(
        &self,
        begun: &mut Begun,
        (effort, seed): (Effort, u64),
        budget: Option<Duration>,
    ) -> Result<Ended, Error> {
        let options = Options::new(self.bounds, effort).with_seed(seed);
        let options = budget.map_or(options, |budget| options.with_budget(budget));
        optimize_begun(begun, &options, self.size, self.monitor)
    }
}

fn optimize_begun(
    begun: &mut Begun,
    options: &Options,
    size: Option<&Size>,
    monitor: &dyn Monitor,
) -> Result<Ended, Error> {
    let fixed = begun.fixed();
    let kinds = kinds_of(&begun.mesh, |v: VertexId| fixed[v.index()]);
    let mesh = std::mem::take(&mut begun.mesh);
    let done = match size {
        None => optimize(mesh, &kinds, options, monitor),
        Some(size) => optimize_sized(mesh, &kinds, options, size, monitor),
    };
    let (optimized, reached) = match done {
        Ok(optimized) => (optimized, true),
        Err(OptimizeError::Unreached { best, .. }) => (*best, false),
        Err(OptimizeError::Cancelled(c)) => return Err(Error::Cancelled(c)),
        Err(error) => return Err(Error::Optimize(error)),
    };
    let Optimized { mesh, vertices, finished, .. } = optimized;
    begun.mesh = mesh;
    for v in &mut begun.vertex_of_site {
        *v = vertices[v.index()].expect("fixed vertices are never removed");
    }
    Ok(Ended { reached, spent: !finished })
}

/// A monitor to whom work that starts anew looks like more of the same phase.
pub(crate) struct Again<'a> {
    monitor: &'a dyn Monitor,
    /// Units of optimisation that earlier starts took.
    before: u64,
    /// Units of optimisation so far, all starts together.
    done: AtomicU64,
}

impl<'a> Again<'a> {
    pub(crate) fn new(monitor: &'a dyn Monitor) -> Self {
        Self { monitor, before: 0, done: AtomicU64::new(0) }
    }

    /// Work starts anew.
    pub(crate) fn restart(&mut self) {
        self.before = *self.done.get_mut() + 1;
    }
}

impl Monitor for Again<'_> {
    fn progress(&self, phase: Phase, done: u64, total: u64) {
        if phase == Phase::Optimize {
            self.done.store(self.before + done, Ordering::Relaxed);
            self.monitor.progress(phase, self.before + done, self.before + total);
        } else if phase > Phase::Optimize || self.before == 0 {
            self.monitor.progress(phase, done, total);
        }
    }

    fn cancelled(&self) -> bool {
        self.monitor.cancelled()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesher::{Mesher, Method};
    use crate::placement::Placement;
    use crate::start::Input;
    use hexdel::generate::{Kind, generate};
    use hexdel_geom::{PointSet, Unwatched};

    /// Tighter bounds than the method promises, so that few points suffice for repair alone to fail.
    #[test]
    fn removals_settle_what_repair_leaves_of_a_grown_mesh() {
        let points = generate(Kind::Uniform, 40, 10);
        let set = PointSet::new(&points).unwrap();
        let placement = Placement::around(&set, None, None, Method::Compact).unwrap();
        let input = Input { points: &points, set: &set, placement: &placement };
        let (bounds, time) = (AngleBounds::new(46.0, 90.0).unwrap(), Time::new(None));
        let reached = [Effort::Repair, Effort::Fast].map(|effort| {
            let begun = Mesher::new().begin(Start::Grown, &input, bounds, &time, &Unwatched).unwrap();
            let work = Work { bounds, effort, size: None, monitor: &Unwatched };
            work.optimize(&mut begun.expect("it grows"), Start::Grown, &time).unwrap().reached
        });
        assert_eq!(reached, [false, true]);
    }
}
