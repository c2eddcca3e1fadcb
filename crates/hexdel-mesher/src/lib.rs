//! Points and planar straight-line graphs to certified triangle meshes.
//!
//! [`Mesher`] has the options. [`Mesher::triangulate`] meshes points, with every angle between
//! 43.89 and 90 degrees; [`Mesher::triangulate_pslg`] meshes points and segments with holes and
//! regions, at 30 to 90 degrees along the segments. Every mesh comes with its certificate.
//!
//! | module | what |
//! |---|---|
//! | [`mesher`] | [`Mesher`], and how points become a mesh |
//! | `placement` | where the lattice lies, how fine it may get |
//! | `start` | the meshes to begin with |
//! | `compact` | optimisation of them, in the time there is |
//! | `dual_edges`, `shortest` | bounds on edges of the Voronoi dual, and on edges |
//! | [`size`] | [`Size`]: how long edges may be |
//! | `sized` | grids as fine as a size asks for |
//! | `graph` | options of PSLGs; repair, attributes, reports, checks |
//! | [`triangulation`] | the result |
//! | [`error`], `fault` | why there is none, for people and for programs |
//! | `workers` | the threads that work |
//! | `picture` | the hexagons behind a mesh in pictures, with the feature `plot` |
//!
//! Left to others: the algorithms (`hexdel-grid`, `hexdel-classify`, `hexdel-refine`, `hexdel-grow`,
//! `hexdel-pslg`, `hexdel-optimize`), and meshes that change (`hexdel-session`). The crate `hexdel` has all of it
//! under one name.

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod compact;
mod dual_edges;
pub mod error;
mod fault;
#[doc(hidden)]
pub mod for_sessions;
mod graph;
pub mod mesher;
#[cfg(feature = "plot")]
pub mod picture;
mod placement;
mod shortest;
pub mod size;
mod sized;
mod start;
pub mod triangulation;
mod workers;

pub use dual_edges::MOST_DUAL_EDGE;
pub use error::Error;
pub use fault::Fault;
pub use graph::prepare::PreparedPslg;
pub use graph::report::{Corner, ExceptionEntry, PslgReport, RepairEntry, WarningEntry};
pub use graph::result::PslgTriangulation;
pub use graph::warning::Warning;
pub use graph::{Domain, Overlaps, triangulate_pslg};
pub use mesher::{Mesher, Method, Start, triangulate};
pub use size::{Size, SizeError, WaveRule};
pub use triangulation::{Patch, Report, Seconds, Triangulation};
