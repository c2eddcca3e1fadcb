//! What to make of a graph.

use hexdel_geom::AngleBounds;
use hexdel_optimize::Effort;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

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

/// How a graph is meshed.
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
    /// Wall-clock limit of what makes a mesh better once there is one. Without
    /// one the result depends on the input alone; with one, also on the speed of
    /// the machine.
    pub budget: Option<Duration>,
}

impl Default for Options {
    /// A hexagon, 30 to 90 degrees near segments, 43.9 to 90 elsewhere, no
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

/// When the time is up, if ever, and whether that has stopped any work.
#[derive(Debug)]
pub(crate) struct Deadline {
    end: Option<Instant>,
    spent: AtomicBool,
}

impl Deadline {
    /// So long from now.
    pub(crate) fn after(budget: Option<Duration>) -> Self {
        // What no clock can tell never comes.
        let end = budget.and_then(|budget| Instant::now().checked_add(budget));
        Self { end, spent: AtomicBool::new(false) }
    }

    /// Whether there is no time for what comes next, which is then left undone.
    pub(crate) fn is_over(&self) -> bool {
        let over = self.end.is_some_and(|end| Instant::now() >= end);
        if over {
            self.spend();
        }
        over
    }

    /// The time that is left.
    pub(crate) fn left(&self) -> Option<Duration> {
        self.end.map(|end| end.saturating_duration_since(Instant::now()))
    }

    /// Work has been left undone.
    pub(crate) fn spend(&self) {
        self.spent.store(true, Ordering::Relaxed);
    }

    pub(crate) fn is_spent(&self) -> bool {
        self.spent.load(Ordering::Relaxed)
    }
}
