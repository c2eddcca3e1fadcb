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
//! | [`monitor`] | progress and cancellation of long work |

pub mod bounds;
pub mod mesh;
pub mod monitor;

pub use bounds::{AngleBounds, BoundsError};
pub use glam::DVec2;
pub use mesh::{TriMesh, TriangleId, VertexId};
pub use monitor::{Cancelled, Monitor, Phase, Unwatched};
