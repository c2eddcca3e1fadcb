//! What a session answers.

use hexdel_geom::{DVec2, TriMesh, VertexId};
use hexdel_optimize::live::Delta;
use hexdel_pslg::SegmentEdge;

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
    /// Centre and circumradius of the domain, if the call has changed it.
    pub domain: Option<(DVec2, f64)>,
}

impl Outcome {
    /// All of a session that has just begun with points.
    pub(super) fn of_beginning(made: &SessionMesh, domain: (DVec2, f64)) -> Self {
        let serial = |v: VertexId| made.vertex_serials[v.index()];
        let triangles = made.triangle_serials.iter().zip(&made.mesh.triangles);
        let mut delta = Delta::default();
        delta.triangles_added = triangles.map(|(&t, corners)| (t, corners.map(serial))).collect();
        let vertices = made.mesh.vertices.iter().copied();
        delta.vertices_added = made.vertex_serials.iter().copied().zip(vertices).collect();
        let points = made.points.iter().map(|p| p.0).collect();
        Self { points, delta, remeshed: false, domain: Some(domain) }
    }
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
    /// Of a PSLG: the edges that segments, and the sides of a domain that is no
    /// hexagon, consist of, in a row along each.
    pub edges: Vec<SegmentEdge>,
    /// Of a PSLG: a marker of each vertex.
    pub vertex_markers: Vec<i32>,
    /// Of a PSLG: the region of each triangle, if it lies in one.
    pub region_of_triangle: Vec<Option<u32>>,
}
