//! What the caller says and gets.

use std::fmt;

use web_time::Instant;

use hexdel_geom::{DVec2, TriMesh, VertexId};
use hexdel_optimize::edit::Kind;

/// What a segment is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Role {
    /// It is divided where that helps, and parts of the plane end at it.
    #[default]
    Border,
    /// It stays one edge, and parts of the plane end at it.
    Whole,
    /// It stays one edge, and no part of the plane ends at it.
    Inner,
}

/// How large triangles may be, place by place. Growth aims at it and does not promise it: triangles that are too large
/// are left where nothing makes them smaller.
pub trait Size: fmt::Debug {
    /// The length of edges to aim at around a place, infinity where any will do.
    fn aim(&self, at: DVec2) -> f64;

    /// How many times as large as allowed a triangle is, as a length: its longest edge over the length allowed, or the
    /// root of its area over the area allowed. More than 1 is too large.
    fn excess(&self, corners: [DVec2; 3]) -> f64;
}

/// What a mesh grows out of.
#[derive(Clone, Copy, Debug, Default)]
pub struct Input<'a> {
    /// Different points, each a vertex bit for bit. The mesh covers their convex hull.
    pub points: &'a [DVec2],
    /// Ends of segments, as indices of points. None crosses another or passes a point.
    pub segments: &'a [[u32; 2]],
    /// One for each segment; borders, those beyond the end.
    pub roles: &'a [Role],
    /// One point in each part of the plane that is left empty; none if it is on the border of two.
    pub holes: &'a [DVec2],
    /// Whether what segments do not enclose is left empty, too.
    pub inside: bool,
    /// How large triangles may be.
    pub size: Option<&'a dyn Size>,
}

impl Input<'_> {
    /// What segment `i` is for.
    pub(crate) fn role(&self, i: usize) -> Role {
        self.roles.get(i).copied().unwrap_or_default()
    }
}

/// What to aim at.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The lower bound, degrees, from 1 to 43.6. The upper one is a right angle. Growth does not end at much more than 43.
    pub min_deg: f64,
    /// When to give up, with [`OutOfTime`](crate::GrowError::OutOfTime).
    pub deadline: Option<Instant>,
    /// Vertices made for size, at most.
    pub most_for_size: u64,
    /// Steps of [`fewest`](crate::fewest) in a round, for each point.
    pub steps: u64,
}

/// Steps for each point, by default.
const STEPS: u64 = 100;

impl Options {
    /// A lower bound, degrees, and no deadline.
    pub fn new(min_deg: f64) -> Self {
        Self { min_deg, deadline: None, most_for_size: u64::MAX, steps: STEPS }
    }

    /// The same with a time to give up at.
    #[must_use]
    pub fn with_deadline(self, deadline: Option<Instant>) -> Self {
        Self { deadline, ..self }
    }
}

/// A mesh that has grown.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Grown {
    /// Vertices that are input points first, in the order of the points, then all others along a curve. Triangles along a curve.
    pub mesh: TriMesh,
    /// By vertex.
    pub kinds: Vec<Kind>,
    /// For each vertex the point that it is, if any. A point where holes touch is several vertices.
    pub point_of_vertex: Vec<Option<u32>>,
    /// The edges on segments, each once, with the segment.
    pub edges: Vec<([VertexId; 2], u32)>,
    /// Triangles with an angle out of the bounds. The lower one is not asked of a corner between two segments at a point.
    pub left: Vec<u32>,
    /// What it took.
    pub stats: Stats,
}

/// Counts of work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Stats {
    /// Triangles taken from the queue.
    pub visits: u64,
    /// Edges flipped.
    pub flips: u64,
    /// Single vertices moved, along segments too.
    pub moves: u64,
    /// Patches moved.
    pub patches: u64,
    /// Vertices inserted that leave all triangles around them within the bounds,
    pub good: u64,
    /// and others.
    pub others: u64,
    /// Edges of segments divided.
    pub splits: u64,
    /// Vertices inserted where triangles were too large.
    pub for_size: u64,
    /// Narrow corners whose tips are kept as they are.
    pub tips: u64,
}
