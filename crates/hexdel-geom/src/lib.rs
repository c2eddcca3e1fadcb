//! Points, meshes, robust predicates and the certificate.
//!
//! The bottom layer of the workspace. It knows planar geometry and triangle
//! meshes and nothing of hexagons: how a mesh was made is no business of the
//! checks in here.
//!
//! | module | what |
//! |---|---|
//! | [`bounds`] | the angle interval a mesh promises |
//! | [`mesh`] | [`TriMesh`]: vertices and counter-clockwise triangles |
//! | [`pslg`] | [`Pslg`]: points, segments, holes and regions as read |

pub mod bounds;
pub mod mesh;
pub mod pslg;

pub use bounds::{AngleBounds, BoundsError};
pub use glam::DVec2;
pub use mesh::{TriMesh, TriangleId, VertexId};
pub use pslg::{Pslg, PslgLayoutError, Region};
