//! All tests of growth in one program: it links once.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod grow;
mod size;
