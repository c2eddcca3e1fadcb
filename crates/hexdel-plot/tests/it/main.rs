//! All tests of pictures in one program: it links once.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

#[path = "../support/mod.rs"]
mod support;

mod picture;
mod svg;
