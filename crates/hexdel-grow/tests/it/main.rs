//! All tests of growth in one program: it links once.

#![allow(clippy::unwrap_used, reason = "a panic is how a test fails")]

mod fewest;
mod grow;
mod size;
