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

impl Monitor for Progress {
    fn progress(&self, phase: Phase, done: u64, total: u64) {
        if self.bar.is_hidden() || self.start.elapsed() < PATIENCE {
            return;
        }
        let (message, template) = match phase {
            // How much refinement there will be is known when it is over.
            Phase::Refine => ("refining", "{spinner} {msg}  {pos} hexagons looked at  {elapsed}"),
            Phase::Extract => ("meshing", "{spinner} {msg}  [{bar:30}] {percent}%  {elapsed}"),
            // Optimisation mostly ends before the most rounds it may take.
            Phase::Optimize => ("optimising", "{spinner} {msg}  round {pos}  {elapsed}"),
            Phase::Certify => ("certifying", "{spinner} {msg}  [{bar:30}] {percent}%  {elapsed}"),
            _ => ("working", "{spinner} {msg}  {pos}  {elapsed}"),
        };
        if self.bar.message() != message {
            if let Ok(style) = ProgressStyle::with_template(template) {
                self.bar.set_style(style);
            }
            self.bar.set_message(message);
            self.bar.enable_steady_tick(Duration::from_millis(100));
        }
        self.bar.set_length(total);
        self.bar.set_position(done);
    }
}
