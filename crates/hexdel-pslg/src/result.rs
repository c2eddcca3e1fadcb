//! The mesh and what is known about it.

use crate::options::SegmentMethod;
use hexdel_geom::{Certificate, DVec2, TriMesh, TriangleId, VertexId};

/// A mesh of a planar straight-line graph.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct PslgMesh {
    /// Vertices and counter-clockwise triangles.
    pub mesh: TriMesh,
    /// The vertex of each input point; duplicates share one. `None` for a point
    /// in a hole or outside of the extent.
    pub vertex_of_point: Vec<Option<VertexId>>,
    /// For each vertex the first input point it is, if any.
    pub point_of_vertex: Vec<Option<u32>>,
    /// A marker of each vertex: that of its point, or else of a segment it
    /// lies on, or else 1 on the boundary and 0 inside.
    pub vertex_markers: Vec<i32>,
    /// The edges that segments and the boundary consist of.
    pub edges: Vec<SegmentEdge>,
    /// For each triangle the index of its region, if it lies in one.
    pub region_of_triangle: Vec<Option<u32>>,
    /// For each segment the number of edges it has been divided into; 0 if it
    /// lies in a hole or outside of the extent.
    pub edges_of_segment: Vec<u32>,
    /// Triangles that keep their bounds but for the angle between two segments
    /// that meet in an input point.
    pub exempt: Vec<Exception>,
    /// Triangles that do not keep their bounds, or are larger or longer than
    /// allowed.
    pub failed: Vec<Exception>,
    /// What the mesh keeps, held against the bounds near segments. Exempt and
    /// failed triangles are counted as out of bounds in it.
    pub certificate: Certificate,
    /// How segments were treated.
    pub method: SegmentMethod,
    /// How often the mesh was made anew.
    pub retries: u32,
    /// Whether the budget ended the work before its end.
    pub budget_spent: bool,
}

/// An edge on a segment or on the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SegmentEdge {
    /// Its ends, in the direction of the segment; along the boundary with the
    /// mesh on the left, if it is on no segment.
    pub ends: [VertexId; 2],
    /// The input segment it is a part of.
    pub segment: Option<u32>,
    /// The segment's marker, or else 1 on the boundary and 0 inside.
    pub marker: i32,
    /// Whether only one triangle has it.
    pub boundary: bool,
}

/// A triangle that does not keep its bounds, is too large or too long, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exception {
    /// The triangle.
    pub triangle: TriangleId,
    /// Its centroid.
    pub at: DVec2,
    /// Its smallest and largest angle, degrees.
    pub angles_deg: [f64; 2],
    /// Why.
    pub reason: Reason,
}

/// Why a triangle does not keep its bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// Two segments meet in a corner at less than the bound.
    Sector {
        /// The input point of the corner.
        point: u32,
        /// The angle between the segments, degrees.
        angle_deg: f64,
    },
    /// Near a corner where two segments meet at less than the bound: what
    /// surrounds it has no room to keep the bounds everywhere.
    NearSector {
        /// The input point of the nearest such corner.
        point: u32,
        /// The angle between the segments, degrees.
        angle_deg: f64,
        /// Distance from the corner to the triangle's centroid, input units.
        distance: f64,
    },
    /// The optimiser found no way.
    Unsolved,
    /// Its angles are within the bounds, but it is larger than allowed.
    TooLarge {
        /// Its area, square input units.
        area: f64,
        /// The largest area allowed where its centroid lies.
        limit: f64,
    },
    /// Its angles are within the bounds, but an edge of it is longer than allowed.
    TooLong {
        /// The edge's length, input units.
        length: f64,
        /// The longest allowed at its ends and its middle.
        limit: f64,
    },
    /// Near a segment or a point on one, where the paper's templates promise no
    /// bounds.
    Template,
}

impl PslgMesh {
    /// Whether every triangle keeps its bounds, up to exempt corners, and
    /// everything else that was asked for is so.
    ///
    /// The paper's method promises bounds away from segments only: triangles
    /// that failed for [`Reason::Template`] do not count, nor does the Delaunay
    /// property. All else does.
    pub fn holds(&self) -> bool {
        holds(self.method, &self.certificate, &self.failed)
    }
}

/// As [`PslgMesh::holds`], of a mesh by parts.
pub fn holds(method: SegmentMethod, c: &Certificate, failed: &[Exception]) -> bool {
    let promised = match method {
        SegmentMethod::Conform => failed.is_empty() && c.delaunay,
        SegmentMethod::Paper => failed.iter().all(|f| f.reason == Reason::Template),
    };
    let broken = c.not_counter_clockwise + c.malformed + c.not_finite + c.repeated_edges + c.unused_vertices;
    promised && broken == 0 && c.inputs_kept == c.inputs
}
