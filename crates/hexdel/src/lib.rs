//! Triangle meshes with every angle between 43.89 and 90 degrees, certified.
//!
//! hexdel turns a set of points into a Delaunay mesh in which every point is a
//! vertex and no angle is smaller than 43.89 or larger than 90 degrees, for
//! any input: hexagonal Delaunay triangulation (Sussner and Greiner, 2009).
//!
//! ```
//! use hexdel::DVec2;
//!
//! let points = [DVec2::new(0.0, 0.0), DVec2::new(1.0, 0.2), DVec2::new(0.3, 0.7)];
//! let made = hexdel::triangulate(&points)?;
//!
//! assert!(made.certificate.holds());
//! assert!(made.certificate.max_angle_deg <= 90.0 + 1e-9);
//! for (point, vertex) in points.iter().zip(&made.vertex_of_input) {
//!     assert_eq!(made.mesh.vertices[vertex.index()], *point);
//! }
//! # Ok::<(), hexdel::Error>(())
//! ```
//!
//! [`triangulate_pslg`] meshes PSLGs of points and segments, with holes and
//! regions, at 30 to 90 degrees along the segments.
//!
//! [`Mesher`] has the options. This crate is a facade: it gathers the crates below under one name, with test points
//! ([`generate`]). It has the types of their signatures, and the modules
//!
//! | module | what |
//! |---|---|
//! | [`mesher`], [`size`], [`triangulation`], [`error`] | options, sizes, results, errors |
//! | [`session`] | meshes that points are put into and taken out of |
//! | [`geom`] | points, meshes, exact predicates, the certificate |
//! | [`pslg`] | segments, holes, regions and polygons |
//! | [`io`] | formats of points and meshes, with the feature `io` |
//! | [`plot`] | pictures of meshes, with the feature `plot` |
//!
//! The crates below can be used on their own:
//!
//! | crate | what |
//! |---|---|
//! | [`hexdel_mesher`] | points and PSLGs to meshes: options, sizes, errors |
//! | [`hexdel_session`] | sessions |
//! | [`hexdel_grid`] | the adaptive hexagon grid |
//! | [`hexdel_classify`] | classes of hexagons, templates, the dual mesh |
//! | [`hexdel_refine`] | the rules engine |
//! | [`hexdel_grow`] | meshes that grow out of the Delaunay triangulation |
//! | [`hexdel_optimize`] | local optimisation to angle bounds |
//!
//! | feature | what | on by default |
//! |---|---|---|
//! | `io` | [`io`]: formats | yes |
//! | `plot` | [`plot`] and [`picture`]: pictures in SVG | yes |
//! | `png` | pictures in PNG | yes |
//! | `rayon` | work on all threads; without it on one, with the same result | yes |
//! | `serde` | sessions as text; reports, certificates, PSLGs and sizes for serde | yes |
//! | `spade` | conversions to and from the triangulations of the crate spade | |
//! | `geo-types` | [`Pslg`] from the shapes of the crate geo-types | |
//!
//! Without features this is a mesher alone, and compiles for `wasm32-unknown-unknown`.

/// The examples of the README, so that they stay true.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

/// The examples of the guide.
#[cfg(all(doctest, feature = "plot", feature = "io"))]
#[doc = include_str!("../../../docs/guide.md")]
struct Guide;

pub mod generate;
#[cfg(feature = "spade")]
pub mod spade;

pub use hexdel_geom as geom;
#[cfg(feature = "io")]
pub use hexdel_io as io;
#[cfg(feature = "plot")]
pub use hexdel_plot as plot;
pub use hexdel_pslg as pslg;

#[doc(inline)]
#[cfg(feature = "plot")]
pub use hexdel_mesher::picture;
#[doc(inline)]
pub use hexdel_mesher::{
    Corner, Domain, Error, ExceptionEntry, Fault, MOST_DUAL_EDGE, Mesher, Method, Overlaps, Patch,
    PreparedPslg, PslgReport, PslgTriangulation, RepairEntry, Report, Seconds, Size, SizeError, Start,
    Triangulation, Warning, WarningEntry, WaveRule, error, mesher, size, triangulate, triangulate_pslg,
    triangulation,
};
#[doc(inline)]
pub use hexdel_session as session;
#[doc(inline)]
pub use hexdel_session::{
    AnySession, Outcome, PointId, Session, SessionCheck, SessionError, SessionMesh, TemplateSession,
};

pub use hexdel_classify::hexagons::Hexagon;
pub use hexdel_classify::{Class, DualError};
pub use hexdel_geom::{
    AngleBounds, Certificate, DVec2, Monitor, Phase, Pslg, Raster, TriMesh, TriangleId, Unwatched, VertexId,
};
pub use hexdel_grid::{Address, Hex};
pub use hexdel_optimize::live::{Delta, LiveError, StateError};
pub use hexdel_optimize::{Effort, OptimizeError, SIZE_TOLERANCE, Sizing, triangle_fits};
pub use hexdel_pslg::SegmentMethod;
pub use hexdel_refine::RefineError;
