//! Progress and cancellation of long work.

use thiserror::Error;

/// A part of the work, in the order they come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Phase {
    /// Subdividing hexagons until no rule asks for more.
    Refine,
    /// Making vertices and triangles.
    Extract,
    /// Local optimisation of the mesh.
    Optimize,
    /// Checking the finished mesh.
    Certify,
}

/// Watches long work and may stop it.
///
/// The calls come from the thread that started the work, often enough to draw
/// a bar or to stop within a fraction of a second, seldom enough to cost
/// nothing.
pub trait Monitor: Sync {
    /// `done` of about `total` units of a phase are finished; `total` may grow.
    fn progress(&self, phase: Phase, done: u64, total: u64) {
        let _ = (phase, done, total);
    }

    /// Whether to give up.
    fn cancelled(&self) -> bool {
        false
    }
}

/// Watches nothing and never stops the work.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Monitor for Unwatched {}

/// The work was given up because its [`Monitor`] asked for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("cancelled")]
pub struct Cancelled;

/// [`Cancelled`] if the monitor asks to give up.
///
/// # Errors
///
/// [`Cancelled`], then.
pub fn check(monitor: &dyn Monitor) -> Result<(), Cancelled> {
    if monitor.cancelled() { Err(Cancelled) } else { Ok(()) }
}
