//! What the caller says and gets.

use std::time::Duration;

use hexdel_geom::{AngleBounds, DVec2, TriMesh, VertexId};

/// How a vertex may move.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum VertexKind {
    /// Not at all: input points and corners of the domain. Its coordinates
    /// come back bit for bit.
    Fixed,
    /// Along a straight side of the domain, whose unit direction this is. It
    /// may be removed.
    Sliding(DVec2),
    /// Along a segment of the [`Constraints`](crate::Constraints), by index: to
    /// the doubles nearest to its points. It may be removed.
    OnSegment(usize),
    /// Anywhere. It may be removed.
    Free,
}

/// How long to work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Effort {
    /// Only brings angles inside the bounds; vertices go where that helps.
    Repair,
    /// Repair, and the cheapest pass of removals: three times the triangles of
    /// standard in a fifth of the time.
    Fast,
    /// The passes of removals that pay.
    #[default]
    Standard,
    /// All passes, then random changes that make more removals possible:
    /// a tenth fewer triangles than standard in a dozen times the time.
    Best,
    /// As few vertices as can be found. That is for those who mesh points and PSLGs: in a mesh that is given it is
    /// the same as [`Effort::Best`].
    Fewest,
}

/// What to do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The bounds every angle must keep.
    pub bounds: AngleBounds,
    /// How long to work.
    pub effort: Effort,
    /// Wall-clock limit. Without one the result depends on the input alone;
    /// with one, also on the speed of the machine.
    pub budget: Option<Duration>,
    /// Seed of the random choices.
    pub seed: u64,
    /// Whether a mesh with segments is returned as it is when angles are left outside
    /// the bounds before removals. By default vertices are removed all the same.
    pub bounds_first: bool,
    /// A pass of removals that takes less than one triangle of so many is the last; 0 is for all passes.
    pub worth: usize,
}

impl Options {
    /// Options without a budget.
    pub fn new(bounds: AngleBounds, effort: Effort) -> Self {
        Self { bounds, effort, ..Self::default() }
    }

    /// The same with a wall-clock limit.
    #[must_use]
    pub fn with_budget(self, budget: Duration) -> Self {
        Self { budget: Some(budget), ..self }
    }

    /// The same, but no vertex is removed of a mesh with segments that repair has not
    /// brought inside the bounds.
    #[must_use]
    pub fn with_bounds_first(self) -> Self {
        Self { bounds_first: true, ..self }
    }

    /// The same with another seed.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }
}

/// A mesh and where its vertices come from.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Optimized {
    /// The mesh. Vertices that were there before keep their order; new ones
    /// follow.
    pub mesh: TriMesh,
    /// For each vertex of the mesh given, which one it is now; none for
    /// removed ones. Fixed vertices are never removed.
    pub vertices: Vec<Option<VertexId>>,
    /// Kinds of the vertices of `mesh`.
    pub kinds: Vec<VertexKind>,
    /// What has become of the edges that must stay, each once.
    pub edges: Vec<[VertexId; 2]>,
    /// What it took.
    pub stats: Stats,
    /// False when the budget stopped the work before its end.
    pub finished: bool,
}

/// Counts of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Stats {
    /// Rounds of all phases.
    pub rounds: usize,
    /// Patches solved to bring angles inside, and how many of them succeeded.
    pub repairs: [u64; 2],
    /// Removals tried and done.
    pub removals: [u64; 2],
    /// Shakes tried and kept.
    pub shakes: [u64; 2],
    /// Levenberg-Marquardt steps.
    pub steps: u64,
}

impl Stats {
    pub(crate) fn add(&mut self, o: &Self) {
        self.rounds += o.rounds;
        for i in 0..2 {
            self.repairs[i] += o.repairs[i];
            self.removals[i] += o.removals[i];
            self.shakes[i] += o.shakes[i];
        }
        self.steps += o.steps;
    }
}
