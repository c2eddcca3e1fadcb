//! How long each phase takes, told by the calls to the monitor.

use crate::triangulation::Seconds;
use hexdel_geom::{Monitor, Phase};
use std::sync::Mutex;
use web_time::Instant;

/// Passes everything on to a monitor. The time since the call before is that of
/// the phase that makes progress.
pub(super) struct Stopwatch<'a> {
    monitor: &'a dyn Monitor,
    times: Mutex<(Instant, Seconds)>,
}

impl<'a> Stopwatch<'a> {
    pub(super) fn new(monitor: &'a dyn Monitor) -> Self {
        Self { monitor, times: Mutex::new((Instant::now(), Seconds::default())) }
    }

    pub(super) fn seconds(&self) -> Seconds {
        self.times.lock().map(|times| times.1).unwrap_or_default()
    }
}

impl Monitor for Stopwatch<'_> {
    fn progress(&self, phase: Phase, done: u64, total: u64) {
        if let Ok(mut times) = self.times.lock() {
            let now = Instant::now();
            let passed = (now - times.0).as_secs_f64();
            times.0 = now;
            let seconds = &mut times.1;
            match phase {
                Phase::Refine => seconds.refine += passed,
                Phase::Extract | Phase::Optimize => seconds.extract += passed,
                _ => seconds.certify += passed,
            }
            seconds.total += passed;
        }
        self.monitor.progress(phase, done, total);
    }

    fn cancelled(&self) -> bool {
        self.monitor.cancelled()
    }
}
