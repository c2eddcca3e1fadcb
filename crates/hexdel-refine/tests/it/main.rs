//! All tests of refinement in one program: it links once.

mod engine;
mod live;
mod rules;
