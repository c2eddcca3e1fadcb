//! Local optimisation of triangle meshes to hard angle bounds.

mod angles;
mod change;
mod decimate;
mod flip;
mod mesh;
mod options;
mod random;
mod refill;
mod repair;
mod shake;
mod skyline;
mod solve;
mod work;

pub use options::{Effort, Hook, Optimized, Options, Phase, Progress, Stats, VertexKind};

pub mod lab;
