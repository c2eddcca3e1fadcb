//! What a session answers.

use hexdel_geom::{TriMesh, VertexId};
use hexdel_optimize::live::Delta;

/// A point of a session: they are counted from 0 as they come, and no number
/// is used twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PointId(pub u64);

/// What a call did.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Outcome {
    /// The points put in, in the order given.
    pub points: Vec<PointId>,
    /// What became of the mesh.
    pub delta: Delta,
    /// Whether the whole was meshed anew.
    pub remeshed: bool,
}

/// A mesh as it stands.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct SessionMesh {
    /// Vertices and counter-clockwise triangles.
    pub mesh: TriMesh,
    /// The serial number of each vertex.
    pub vertex_serials: Vec<u64>,
    /// The serial number of each triangle.
    pub triangle_serials: Vec<u64>,
    /// The points and their vertices.
    pub points: Vec<(PointId, VertexId)>,
}
