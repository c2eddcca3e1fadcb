//! All tests of the formats but the one with readers of Python, in one program: it links once.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[path = "../support/mod.rs"]
mod support;

mod dual;
mod fixtures;
mod formats;
mod malformed;
mod malformed_meshes;
mod mutation;
mod round_trip;
mod write;
