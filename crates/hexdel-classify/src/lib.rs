//! Classes of hexagons, their relocation, and the dual mesh (paper, sections
//! 4.2, 5.1 and 5.4).
//!
//! A full hexagon that is not subdivided is a vertex of the dual. Where finer
//! hexagons touch it, or an input point lies in or near it, that vertex is
//! moved by one of a small set of templates so that every angle comes to lie
//! between 43.89 and 90 degrees. All templates are rational on the lattice, so
//! whether a triangle keeps the bounds is decided in integers.
//!
//! | module | what |
//! |---|---|
//! | [`class`] | the table of classes, sixty-four hexagons at a time |
//! | [`relocate`] | the templates: where a vertex of each class goes |
//! | [`exact`] | angle bounds in integer arithmetic |
//! | [`hexagons`] | the hexagons behind a mesh, for pictures |
//! | [`dual`] | the mesh: vertices, triangles and stars of three-finned hexagons |

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod class;
pub mod dual;

pub mod exact;
pub mod hexagons;
pub mod relocate;

pub use class::{Class, Classes, View};

pub use dual::{Domain, Dual, DualError, KeptDual, Layout, Occupant, Relocation, Touched, extract};
pub use exact::{ExactBounds, Offset};
