//! An indexed triangle mesh.

use glam::DVec2;

/// Index of a vertex in [`TriMesh::vertices`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct VertexId(u32);

/// Index of a triangle in [`TriMesh::triangles`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct TriangleId(u32);

macro_rules! id {
    ($id:ident, $what:literal) => {
        impl $id {
            #[doc = concat!("The id of the ", $what, " at `index`.")]
            ///
            /// # Panics
            ///
            /// In debug builds, if `index` exceeds `u32::MAX`.
            #[inline]
            pub const fn new(index: usize) -> Self {
                debug_assert!(index <= u32::MAX as usize);
                Self(index as u32)
            }

            /// The position in the mesh's array.
            #[inline]
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}
id!(VertexId, "vertex");
id!(TriangleId, "triangle");

/// A triangle mesh: vertex positions and index triples.
///
/// The container promises nothing about the triangles; whoever needs a
/// promise computes a certificate. Corners are listed counter-clockwise by
/// everything in this workspace that makes a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TriMesh {
    /// Positions, in the units of the input.
    pub vertices: Vec<DVec2>,
    /// The three corners of each triangle, counter-clockwise.
    pub triangles: Vec<[VertexId; 3]>,
}

impl TriMesh {
    /// The three corner positions of triangle `t`.
    ///
    /// # Panics
    ///
    /// If `t` or one of its corners is not of this mesh.
    #[inline]
    pub fn corners(&self, t: TriangleId) -> [DVec2; 3] {
        let [a, b, c] = self.triangles[t.index()];
        [self.vertices[a.index()], self.vertices[b.index()], self.vertices[c.index()]]
    }
}

/// An edge of a mesh that has a marker: on an input segment or on the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MarkedEdge {
    /// Its ends, in the direction of the segment.
    pub ends: [VertexId; 2],
    /// Its marker, in Triangle's sense.
    pub marker: i32,
}
