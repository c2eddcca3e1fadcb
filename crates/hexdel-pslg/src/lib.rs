//! Triangle meshes of planar straight-line graphs.
//!
//! Section 7 of the paper puts segments into the grid by templates, and loses
//! its bounds there; that is [`SegmentMethod::Paper`]. By default the grid is
//! only made fine enough for the segments; they are embedded into its dual
//! mesh, and an optimiser brings the angles around them between 30 and 90
//! degrees. Two edges away from points and segments the bounds of the plain
//! mesh hold, 43.89 to 90 degrees. No angle is obtuse, so that segments are edges
//! of the Delaunay triangulation of the vertices, not only of a constrained one.
//!
//! [`validate`] says whether a PSLG is planar, [`repair`] makes it so, [`mesh`]
//! meshes it. Success of the optimiser is not proved: what does not keep its
//! bounds is listed in [`PslgMesh::failed`]. Where segments meet at less than
//! the lower bound, that one angle is exempt; below 7 degrees (with bounds above
//! 30 degrees up to 20) a fan of triangles around the point is, at the point.
//!
//! | module | what |
//! |---|---|
//! | `validate` | is it planar? |
//! | `pairs`, `repair` | what touches, and what to do about it |
//! | `repeated` | segments that are superfluous |
//! | `interpolate` | values between points |
//! | `sizing` | how fine the grid must be |
//! | `estimate` | what would be too large is refused before the work |
//! | `limits` | limits on the area of triangles and the length of edges |
//! | `faces` | polygons become holes and regions |
//! | `hull` | the convex hull as a boundary |
//! | `net` | a triangulation that can be changed |
//! | `field` | the size of a mesh at every place |
//! | `fans` | triangles around the narrowest corners |
//! | `embed` | points and segments go into the mesh |
//! | `carve` | holes and the outside go |
//! | `seeds` | holes and regions that change nothing |
//! | `sectors` | corners that are narrower than the bound |
//! | `rings` | how many edges each vertex is away from points and segments |
//! | `judge` | which triangles keep their bounds |
//! | `compact` | the optimiser brings angles within their bounds, and takes vertices out |
//! | `mesher` | the order of things |
//! | `paper` | the paper's own way with segments, to compare with |
//! | `output` | the result |
//!
//! Left to others: reading and writing (`hexdel-io`), and how meshes are optimised
//! (`hexdel-optimize`).

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod carve;
mod compact;
mod embed;
mod error;
mod estimate;
mod faces;
mod fans;
mod field;
mod geometry;
mod grown;
mod hull;
mod interpolate;
mod judge;
mod limits;
mod locator;
mod mesher;
mod net;
mod options;
mod output;
mod pairs;
mod paper;
mod repair;
mod repeated;
mod result;
mod rings;
mod sectors;
mod seeds;
mod sizing;
mod validate;
pub use carve::Carved;
pub use error::{Feature, LooseEnd, Near, PslgError, ValidateError};
pub use faces::{Cover, Overlap, StrayRing};
pub use fans::fan_points;
pub use hexdel_optimize::Effort;
pub use mesher::{mesh, mesh_sized};
pub use options::{Extent, Options, SegmentMethod};
pub use output::vertex_markers;
pub use repair::{NEARLY_ON_DEG, Repair, RepairReport, repair, repair_nearly_on};
pub use repeated::drop_repeated;
pub use result::{Exception, PslgMesh, Reason, SegmentEdge, holds};
pub use sectors::{NarrowCorner, hopeless_pairs, narrow_corners};
pub use seeds::{Areas, Seed, Unused, UnusedSeed};
pub use validate::{Divided, Validated, validate, violations};
