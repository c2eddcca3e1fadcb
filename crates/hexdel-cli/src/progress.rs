//! A bar on the terminal while long work goes on.

use hexdel::{Monitor, Phase};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::time::{Duration, Instant};

/// Work shorter than this shows no bar.
const PATIENCE: Duration = Duration::from_millis(400);

/// Shows how far the work is, if standard error is a terminal.
pub(crate) struct Progress {
    start: Instant,
    bar: ProgressBar,
}

impl Progress {
    /// A bar, hidden until the work has taken a while, or for good if `quiet`.
    pub(crate) fn new(quiet: bool) -> Self {
        // The target hides itself where standard error is no terminal.
        let target = if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(None, target);
        Self { start: Instant::now(), bar }
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// What a phase is called, and how the bar looks in it.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Look {
    name: &'static str,
    template: &'static str,
}

/// How much there will be is known when it is over.
const UNKNOWN: &str = "{spinner} {msg}  {pos} hexagons, {per_sec}  {elapsed}";
const KNOWN: &str = "{spinner} {msg}  [{bar:30}] {percent}%  {per_sec}  {eta} left";
/// Optimisation mostly ends before the most rounds it may take.
const ROUNDS: &str = "{spinner} {msg}  round {pos} of {len} at most  {elapsed}, {eta} left at most";
const WAITING: &str = "{spinner} {msg}  {elapsed}";

/// The look of a phase of which `done` of `total` is finished. After the last of
/// making and of optimising comes work that tells nothing of itself.
fn look(phase: Phase, done: u64, total: u64) -> Look {
    let (name, template) = match phase {
        Phase::Refine => ("refining", UNKNOWN),
        Phase::Extract if done < total => ("meshing", KNOWN),
        Phase::Optimize if done < total => ("optimising", ROUNDS),
        Phase::Extract | Phase::Optimize => ("settling and checking", WAITING),
        Phase::Certify => ("certified", WAITING),
        _ => ("working", WAITING),
    };
    Look { name, template }
}

impl Monitor for Progress {
    fn progress(&self, phase: Phase, done: u64, total: u64) {
        if self.bar.is_hidden() || self.start.elapsed() < PATIENCE {
            return;
        }
        let look = look(phase, done, total);
        self.bar.set_length(total);
        if self.bar.message() != look.name {
            if let Ok(style) = ProgressStyle::with_template(look.template) {
                self.bar.set_style(style);
            }
            self.bar.set_message(look.name);
            // Rate and time left are those of the phase alone.
            self.bar.set_position(done);
            self.bar.reset_eta();
            self.bar.enable_steady_tick(Duration::from_millis(100));
        }
        self.bar.set_position(done);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_template_is_one() {
        for template in [UNKNOWN, KNOWN, ROUNDS, WAITING] {
            assert!(ProgressStyle::with_template(template).is_ok(), "{template}");
        }
    }

    #[test]
    fn a_finished_phase_leaves_no_bar_at_half() {
        assert!(look(Phase::Extract, 1, 2).template == KNOWN);
        for phase in [Phase::Extract, Phase::Optimize] {
            assert!(look(phase, 2, 2) == Look { name: "settling and checking", template: WAITING });
        }
    }
}
