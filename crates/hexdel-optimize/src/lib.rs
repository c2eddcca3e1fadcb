//! Local optimisation of triangle meshes to hard angle bounds.
//!
//! Given a mesh, what each vertex may do, and an interval of angles, this
//! crate moves free vertices, flips edges and changes the topology until every
//! angle is inside, then removes as many vertices as it can without leaving
//! the interval. It knows meshes and bounds and nothing of hexagons; how the
//! start mesh was made is no business of its own.
//!
//! | module | what |
//! |---|---|
//! | `options`, `constraints`, `error` | what the caller says and gets |
//! | `outline` | [`kinds_of`]: what vertices may do, from the outline |
//! | `schedule` | [`optimize`]: rounds of work over all parts of the mesh |
//! | `partition` | cuts the mesh into parts, the same for any number of threads |
//! | `repair` | brings all angles inside |
//! | `rescue` | refines where repair gives up |
//! | `decimate` | removes vertices |
//! | `area` | divides what is larger or longer than allowed |
//! | `sizing` | [`Sizing`]: how long edges may be |
//! | `shake` | random changes that let more vertices go |
//! | `change`, `refill`, `segment` | candidate changes of topology and their ranking |
//! | `work` | a mesh under work: patch, flips, commit, rollback |
//! | `patch` | moves the vertices of a patch until its angles hold |
//! | `flip` | Lawson flips in a patch |
//! | [`live`] | a mesh that fixed vertices come to and go from |
//! | `mesh` | the editable mesh with its journal |
//! | `edit` | the editable mesh without one, to take the place of the others |
//! | `angles` | bounds as polynomial tests |
//!
//! Every change is kept only where all angles it touches hold (in repair:
//! where the distance outside falls; where there are segments, a round that
//! leaves more triangles outside is taken back), so work can be stopped at any
//! time.
//! `docs/compact.md` describes the method, `docs/notes.md` what was tried.

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod angles;
mod area;
mod change;
mod constraints;
mod decimate;
#[doc(hidden)]
pub mod edit;
mod error;
mod flip;
mod import;
pub mod live;
mod mesh;
mod options;
mod outline;
mod partition;
mod patch;
mod random;
mod refill;
mod repair;
mod rescue;
mod schedule;
mod segment;
mod shake;
mod sizing;
mod spread;
mod work;

pub use constraints::{AreaLimit, Constraints, Hopeless};
pub use error::OptimizeError;
pub use options::{Effort, Optimized, Options, Stats, VertexKind};
pub use outline::kinds_of;
pub use schedule::{optimize, optimize_constrained, optimize_sized};
pub use sizing::{SIZE_TOLERANCE, Sizing, edge_fits, triangle_fits};
