//! Local optimisation of triangle meshes to hard angle bounds.

mod angles;
mod decimate;
mod flip;
mod mesh;
mod options;
mod random;
mod refill;
mod repair;
mod skyline;
mod solve;
mod work;

pub use options::{Effort, Hook, Optimized, Options, Phase, Progress, Stats, VertexKind};

pub mod lab;
