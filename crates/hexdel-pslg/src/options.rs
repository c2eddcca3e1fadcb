//! What to make of a PSLG.

use hexdel_geom::{AngleBounds, Monitor, Phase};
use hexdel_optimize::Effort;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;
use web_time::Instant;

/// What part of the plane a mesh covers. Holes are left out of each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Extent {
    /// A regular hexagon around the input.
    #[default]
    Hexagon,
    /// The convex hull of the points. Its edges become segments.
    Hull,
    /// What is enclosed by segments.
    Inside,
}

/// How segments come into the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum SegmentMethod {
    /// They are embedded, and an optimiser brings the angles around them within
    /// bounds.
    #[default]
    Conform,
    /// By the templates of the paper's section 7, which keep no bounds near
    /// segments. For comparison.
    Paper,
}

/// How a PSLG is meshed.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// What is covered.
    pub extent: Extent,
    /// How segments come into the mesh.
    pub method: SegmentMethod,
    /// Bounds of triangles that have a vertex at most one edge away from a
    /// point or segment of the input.
    pub near: AngleBounds,
    /// Bounds of all others.
    pub far: AngleBounds,
    /// The largest area of a triangle whose centroid lies in the smallest circle
    /// around the input, in square units of the input. Regions may have limits
    /// of their own, and keep both.
    pub max_area: Option<f64>,
    /// How hard to look for vertices that the mesh can do without; none are
    /// removed if `None`.
    pub compact: Option<Effort>,
    /// The most triangles that may come to be.
    pub max_triangles: usize,
    /// How often the mesh is made anew with smaller triangles where bounds
    /// were not met. It ends before with the first time that is no better, and where too
    /// much is left beside narrow corners for one mesh to settle all of it.
    pub retries: u32,
    /// Wall-clock limit, kept within a tenth of it or a second. What makes the mesh
    /// better ends with it; where half of it is over before there is a mesh, the input's
    /// own constrained Delaunay triangulation takes its place, whose triangles are as they are. Without
    /// one the result depends on the input alone; with one, also on the speed of
    /// the machine.
    pub budget: Option<Duration>,
}

impl Default for Options {
    /// A hexagon, 30 to 90 degrees near segments, 43.89 to 90 elsewhere, no
    /// limit on areas, standard effort to remove vertices, 50 million triangles, four retries.
    fn default() -> Self {
        Self {
            extent: Extent::Hexagon,
            method: SegmentMethod::Conform,
            near: AngleBounds::new(30.0, 90.0).unwrap_or(AngleBounds::SIMPLE),
            far: AngleBounds::EXTENDED,
            max_area: None,
            compact: Some(Effort::Standard),
            max_triangles: 50_000_000,
            retries: 4,
            budget: None,
        }
    }
}

impl Options {
    /// The default options.
    pub fn new() -> Self {
        Self::default()
    }

    /// With this part of the plane covered.
    #[must_use]
    pub fn extent(mut self, extent: Extent) -> Self {
        self.extent = extent;
        self
    }

    /// With segments treated in this way.
    #[must_use]
    pub fn method(mut self, method: SegmentMethod) -> Self {
        self.method = method;
        self
    }

    /// With these bounds near points and segments.
    #[must_use]
    pub fn near(mut self, near: AngleBounds) -> Self {
        self.near = near;
        self
    }

    /// With a limit on the area of triangles.
    #[must_use]
    pub fn max_area(mut self, area: f64) -> Self {
        self.max_area = Some(area);
        self
    }

    /// With so much effort to remove vertices, or all of them kept.
    #[must_use]
    pub fn compact(mut self, effort: Option<Effort>) -> Self {
        self.compact = effort;
        self
    }

    /// With at most so many attempts after the first.
    #[must_use]
    pub fn retries(mut self, retries: u32) -> Self {
        self.retries = retries;
        self
    }

    /// With so much time.
    #[must_use]
    pub fn budget(mut self, budget: Option<Duration>) -> Self {
        self.budget = budget;
        self
    }

    /// With at most so many triangles.
    #[must_use]
    pub fn max_triangles(mut self, limit: usize) -> Self {
        self.max_triangles = limit;
        self
    }
}

/// What a budget may be exceeded by: this part of it, or a second if that is more.
const GRACE: f64 = 0.1;

/// The part of the time, with the grace, in which the first mesh must be there. What
/// follows, to the last check, takes no longer than making it.
const FIRST_MESH: f64 = 0.5;

/// When the time is up, if ever, and whether that has stopped any work.
#[derive(Debug)]
pub(crate) struct Deadline {
    start: Instant,
    budget: Option<Duration>,
    /// What finishing takes, as far as that is known, nanoseconds.
    reserve: AtomicU64,
    spent: AtomicBool,
}

impl Deadline {
    /// So long from now.
    pub(crate) fn after(budget: Option<Duration>) -> Self {
        let start = Instant::now();
        Self { start, budget, reserve: AtomicU64::new(0), spent: AtomicBool::new(false) }
    }

    /// The budget with what it may be exceeded by.
    fn with_grace(budget: Duration) -> Duration {
        budget.saturating_add(budget.mul_f64(GRACE).max(Duration::from_secs(1)))
    }

    /// When work that makes a mesh better must end, after the start.
    fn end(&self) -> Option<Duration> {
        let reserve = Duration::from_nanos(self.reserve.load(Ordering::Relaxed));
        self.budget.map(|budget| budget.min(Self::with_grace(budget).saturating_sub(reserve)))
    }

    /// Whether there is no time for what comes next, which is then left undone.
    pub(crate) fn is_over(&self) -> bool {
        let over = self.end().is_some_and(|end| self.start.elapsed() >= end);
        if over {
            self.spend();
        }
        over
    }

    /// The time that is left.
    pub(crate) fn left(&self) -> Option<Duration> {
        self.end().map(|end| end.saturating_sub(self.start.elapsed()))
    }

    /// When a part of the time that is left is over.
    pub(crate) fn share(&self, part: f64) -> Option<Instant> {
        self.left().and_then(|left| Instant::now().checked_add(left.mul_f64(part)))
    }

    /// Whether the first mesh takes too long: there would be no time to finish it.
    fn is_late(&self) -> bool {
        let most = |budget| Self::with_grace(budget).mul_f64(FIRST_MESH);
        self.budget.is_some_and(|budget| self.start.elapsed() >= most(budget))
    }

    /// The first mesh is there: finishing takes about as long as it took.
    pub(crate) fn note_first_mesh(&self) {
        self.reserve.store(self.start.elapsed().as_nanos() as u64, Ordering::Relaxed);
    }

    /// Work has been left undone.
    pub(crate) fn spend(&self) {
        self.spent.store(true, Ordering::Relaxed);
    }

    pub(crate) fn is_spent(&self) -> bool {
        self.spent.load(Ordering::Relaxed)
    }
}

/// A monitor that stops work when the time is up, too.
pub(crate) struct Timed<'a> {
    monitor: &'a dyn Monitor,
    deadline: &'a Deadline,
    /// Whether there is a mesh already: then this is work to make it better.
    again: bool,
    /// Whether it was time that stopped the work.
    stopped: AtomicBool,
}

impl<'a> Timed<'a> {
    pub(crate) fn new(monitor: &'a dyn Monitor, deadline: &'a Deadline, again: bool) -> Self {
        Self { monitor, deadline, again, stopped: AtomicBool::new(false) }
    }

    /// Whether time has stopped the work, and nobody else.
    pub(crate) fn has_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

impl Monitor for Timed<'_> {
    fn progress(&self, phase: Phase, done: u64, total: u64) {
        self.monitor.progress(phase, done, total);
    }

    fn cancelled(&self) -> bool {
        if self.monitor.cancelled() {
            return true;
        }
        let over = if self.again { self.deadline.is_over() } else { self.deadline.is_late() };
        if over {
            self.deadline.spend();
            self.stopped.store(true, Ordering::Relaxed);
        }
        over
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::Unwatched;

    #[test]
    fn a_spent_budget_leaves_grace_for_the_first_mesh_and_none_for_more() {
        let deadline = Deadline::after(Some(Duration::ZERO));
        assert!(!Timed::new(&Unwatched, &deadline, false).cancelled() && !deadline.is_spent());
        let again = Timed::new(&Unwatched, &deadline, true);
        assert!(again.cancelled() && again.has_stopped() && deadline.is_spent());
        assert_eq!(deadline.left(), Some(Duration::ZERO));
    }

    #[test]
    fn without_a_budget_time_is_never_up() {
        for deadline in [Deadline::after(None), Deadline::after(Some(Duration::MAX))] {
            deadline.note_first_mesh();
            let timed = [false, true].map(|again| Timed::new(&Unwatched, &deadline, again).cancelled());
            assert!(timed == [false; 2] && !deadline.is_over() && !deadline.is_spent());
        }
        assert_eq!(Deadline::after(None).left(), None);
    }

    #[test]
    fn what_finishing_takes_is_kept_free() {
        let deadline = Deadline::after(Some(Duration::from_secs(100)));
        deadline.reserve.store(60_000_000_000, Ordering::Relaxed);
        let left = deadline.left().unwrap();
        assert!(left <= Duration::from_secs(50), "{left:?}");
    }
}
