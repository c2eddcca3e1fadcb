//! Points, meshes, robust predicates and the certificate.
//!
//! The bottom layer of the workspace. It knows planar geometry and triangle
//! meshes and nothing of hexagons: how a mesh was made is no business of the
//! checks in here.
//!
//! | module | what |
//! |---|---|
//! | [`bounds`] | the angle interval a mesh promises |
//! | [`mesh`] | [`TriMesh`]: vertices and counter-clockwise triangles; [`MarkedEdge`] |
//! | [`monitor`] | progress and cancellation of long work |
//! | [`points`] | [`PointSet`]: finite points, duplicates merged into sites |
//! | [`circle`] | the smallest circle around a set of points |
//! | [`mod@closest_pair`] | the closest two points of a set |
//! | [`predicates`] | orientation and in-circle tests with exact signs |
//! | [`quality`] | angles and aspect ratio of one triangle |
//! | [`raster`] | [`Raster`]: square cells with a number each |
//! | [`certificate`] | [`certify`]: what a finished mesh keeps, checked from scratch |
//! | [`delaunay`] | [`restore_delaunay`]: repairs edges that rounding took from Delaunay |
//! | [`segment`] | points of a segment, rounded once |
//! | [`rounding`] | [`settle_rounding`]: moves by units in the last place where rounding spoilt an angle |
//! | [`voronoi`] | [`Voronoi`]: circumcentres, cells, control volumes and cotangent weights |
//! | [`segments`] | [`check_segments`]: whether segments are unions of edges |
//! | [`pslg`] | [`Pslg`]: points, segments, holes and regions as read |
//! | [`builder`] | [`PslgBuilder`]: PSLGs of points, lines and polygons by their coordinates |
//! | `geo` | [`Pslg`] from shapes of the crate `geo-types`, with the feature of that name |

pub mod bounds;
pub mod builder;
pub mod certificate;
pub mod circle;
pub mod closest_pair;
pub mod delaunay;
#[cfg(feature = "geo-types")]
pub mod geo;
pub mod mesh;
pub mod monitor;
#[doc(hidden)]
pub mod par;
pub mod points;
pub mod predicates;
pub mod pslg;
pub mod quality;
pub mod raster;
pub mod rounding;
pub mod segment;
pub mod segments;
pub mod voronoi;

pub mod double_double;
mod incidence;
mod scale;

pub use bounds::{AngleBounds, BoundsError};
pub use builder::PslgBuilder;
pub use certificate::{
    ANGLE_TOLERANCE_DEG, Certificate, CertifyOptions, LENGTH_TOLERANCE, Violation, certify, keeps_bounds,
    keeps_bounds_at,
};
pub use circle::{Circle, smallest_enclosing_circle};
pub use closest_pair::{ClosestPair, closest_pair};
pub use delaunay::{DelaunayError, FlipReport, restore_delaunay};
pub use glam::DVec2;
pub use mesh::{MarkedEdge, TriMesh, TriangleId, VertexId};
pub use monitor::{Cancelled, Monitor, Phase, Unwatched};
pub use points::{PointSet, PointsError};
pub use predicates::{incircle, orient2d};
pub use pslg::{Polygon, Pslg, PslgLayoutError, Region};
pub use raster::Raster;
pub use rounding::settle_rounding;
pub use segment::point_on_segment;
pub use segments::{MissingSegment, SegmentCheck, check_segments};
pub use voronoi::{Voronoi, VoronoiEdge, VoronoiError, VoronoiSummary};
