//! Why a mesh cannot be optimised.

use hexdel_geom::{Cancelled, DVec2, VertexId};
use thiserror::Error;

use crate::options::Optimized;

/// What [`optimize`](crate::optimize) answers when it has no mesh to return.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum OptimizeError {
    /// There is not one kind for each vertex.
    #[error("{kinds} kinds for {vertices} vertices")]
    KindCount {
        /// Vertices of the mesh.
        vertices: usize,
        /// Kinds given.
        kinds: usize,
    },
    /// A coordinate is not a finite number.
    #[error("vertex {} has coordinates {at}", vertex.index())]
    NotFinite {
        /// The vertex.
        vertex: VertexId,
        /// Its coordinates.
        at: DVec2,
    },
    /// A triangle names a vertex that is not there.
    #[error("triangle {triangle} has corner {corner}, the mesh {vertices} vertices")]
    NoSuchVertex {
        /// Index of the triangle.
        triangle: usize,
        /// The corner's vertex index.
        corner: usize,
        /// Vertices of the mesh.
        vertices: usize,
    },
    /// A triangle has the same vertex twice.
    #[error("triangle {triangle} has vertex {} twice", vertex.index())]
    RepeatedCorner {
        /// Index of the triangle.
        triangle: usize,
        /// The vertex.
        vertex: VertexId,
    },
    /// Two triangles have the same side in the same direction: more than two
    /// meet at it, or their orientations differ.
    #[error("two triangles lie on the same side of the edge from vertex {} to {}", from.index(), to.index())]
    SharedSide {
        /// Start of the side.
        from: VertexId,
        /// Its end.
        to: VertexId,
    },
    /// The triangles at a vertex do not form one fan.
    #[error("the triangles at vertex {} at {at} do not form one fan", vertex.index())]
    NotOneFan {
        /// The vertex.
        vertex: VertexId,
        /// Its coordinates.
        at: DVec2,
    },
    /// A vertex is in no triangle.
    #[error("vertex {} at {at} is in no triangle", vertex.index())]
    Isolated {
        /// The vertex.
        vertex: VertexId,
        /// Its coordinates.
        at: DVec2,
    },
    /// An edge that must stay is not there.
    #[error("no edge joins vertices {} and {}", edge[0].index(), edge[1].index())]
    NoSuchEdge {
        /// Its ends.
        edge: [VertexId; 2],
    },
    /// A segment or vertex that constraints name is not there.
    #[error("the constraints name {what} {index} of {count}")]
    NoSuchItem {
        /// "vertex" or "segment".
        what: &'static str,
        /// Its index.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A vertex on the rim is free, one inside slides, or one slides along a
    /// direction that is no unit vector along both of its rim sides; or a
    /// vertex on a segment is not between two edges of it that stay.
    #[error("the kind of vertex {} at {at} does not fit its place in the mesh", vertex.index())]
    Misplaced {
        /// The vertex.
        vertex: VertexId,
        /// Its coordinates.
        at: DVec2,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The work ended, or its budget did, with angles outside the bounds.
    #[error("{bad} of {} triangles are outside the bounds, the first with corners {corners:?}", best.mesh.triangles.len())]
    Unreached {
        /// How many triangles are outside.
        bad: usize,
        /// Corners of the first of them.
        corners: [DVec2; 3],
        /// The best mesh found; everything but the bounds holds for it.
        best: Box<Optimized>,
    },
}
