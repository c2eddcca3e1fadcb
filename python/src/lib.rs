//! The Python package's compiled half: arrays in, arrays out.
//!
//! What users see is in `hexdel/*.py`. Here is what needs Rust: conversion without
//! copies, work without the GIL, exceptions from errors. No algorithm but the sampling
//! of sizes by functions (`sampled.rs`).

mod check;
mod convert;
mod errors;
mod files;
mod mesh;
mod options;
mod sampled;
mod session;
mod watch;

use pyo3::prelude::*;

/// The compiled half of the package hexdel.
#[pymodule]
mod _hexdel {
    #[pymodule_export]
    use crate::check::{check, dual};
    #[pymodule_export]
    use crate::files::{
        formats, generate_points, holds_mesh, picture, read_graph, read_mesh, write_dual, write_graph,
        write_mesh,
    };
    #[pymodule_export]
    use crate::mesh::{mesh_graph, mesh_points, mesh_text};
    #[pymodule_export]
    use crate::session::RawSession;
}
