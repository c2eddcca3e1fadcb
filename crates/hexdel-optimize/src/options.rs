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
    /// Anywhere. It may be removed.
    Free,
}

/// How long to work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Effort {
    /// Stop as soon as all angles hold.
    Fast,
    /// Then remove vertices for as long as single removals succeed.
    #[default]
    Standard,
    /// Then shake the mesh to make more removals possible.
    Best,
}

/// Where the work is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is being done.
    pub phase: Phase,
    /// Rounds of this phase that are over.
    pub round: usize,
    /// Triangles now.
    pub triangles: usize,
    /// Triangles outside the bounds now.
    pub bad: usize,
}

/// The phases of the work, in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Phase {
    /// Bringing all angles inside the bounds.
    Repair,
    /// Removing vertices.
    Decimate,
    /// Random changes that let more vertices go.
    Shake,
}

/// Asked between rounds; `false` stops the work.
pub type Hook<'a> = &'a (dyn Fn(Progress) -> bool + Sync);

/// What to do.
#[derive(Clone, Copy, Default)]
#[non_exhaustive]
pub struct Options<'a> {
    /// The bounds every angle must keep.
    pub bounds: AngleBounds,
    /// How long to work.
    pub effort: Effort,
    /// Wall-clock limit. Without one the result depends on the input alone;
    /// with one, also on the speed of the machine.
    pub budget: Option<Duration>,
    /// Seed of the random choices.
    pub seed: u64,
    /// Asked between rounds whether to go on.
    pub hook: Option<Hook<'a>>,
}

impl<'a> Options<'a> {
    /// Options without budget and hook.
    pub fn new(bounds: AngleBounds, effort: Effort) -> Self {
        Self {
            bounds,
            effort,
            ..Self::default()
        }
    }

    /// The same with a wall-clock limit.
    #[must_use]
    pub fn with_budget(self, budget: Duration) -> Self {
        Self {
            budget: Some(budget),
            ..self
        }
    }

    /// The same with another seed.
    #[must_use]
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// The same with a hook.
    #[must_use]
    pub fn with_hook(self, hook: Hook<'a>) -> Self {
        Self {
            hook: Some(hook),
            ..self
        }
    }
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Options")
            .field("bounds", &self.bounds)
            .field("effort", &self.effort)
            .field("budget", &self.budget)
            .field("seed", &self.seed)
            .field("hook", &self.hook.is_some())
            .finish()
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
    /// What it took.
    pub stats: Stats,
    /// False when the hook or the budget stopped the work before its end. The
    /// mesh keeps the bounds all the same.
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
