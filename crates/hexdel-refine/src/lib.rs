//! The rules engine (paper, sections 4.1 and 5.2).
//!
//! A [`Rule`] says which hexagons must be subdivided, as a question about one
//! tile and its margin. The [`Refiner`] asks every rule again wherever
//! something changed, finest level first, until none asks for more.
//!
//! | module | what |
//! |---|---|
//! | [`rule`] | what a rule is, and the two sets of rules |
//! | [`simple`] | rules for 30 to 120 degrees, section 4.1 |
//! | [`extended`] | rules for 43.89 to 90 degrees, section 5.2 |
//! | [`triangle`] | the rule that section 5.2 lacks |
//! | [`coarse`] | rules for coarse starts of an optimiser |
//! | [`sites`] | input points and the hexagons they occupy |
//! | [`engine`] | what is asked when |
//! | `queue` | tiles that wait for their turn |
//! | `coarsen` | local coarsening, section 5.3 |

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod coarse;
mod coarsen;
pub mod engine;
pub mod extended;
mod queue;
pub mod rule;
pub mod simple;
pub mod sites;
pub mod triangle;

pub use coarse::Start;
pub use engine::{Changes, RefineError, Refiner, RestoreError};
pub use rule::{Rule, RuleSet, Situation};
