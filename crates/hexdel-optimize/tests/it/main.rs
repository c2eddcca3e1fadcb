//! All tests of the optimiser in one program: it links once.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[path = "../../examples/support/mod.rs"]
mod support;

mod constrained;
mod live;
mod optimize;
