//! What can go wrong when a mesh is drawn.

use hexdel_geom::DVec2;
use std::io;
use thiserror::Error;

/// Why a mesh was not drawn.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlotError {
    /// The system refused, or what was written to.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// A coordinate is infinite or not a number.
    #[error("{item} {index} at ({x}, {y}) is not finite")]
    NonFinite {
        /// "vertex" or "polygon".
        item: &'static str,
        /// Its index.
        index: usize,
        /// Its coordinates.
        x: f64,
        /// Its coordinates.
        y: f64,
    },
    /// A triangle, edge or polygon refers to something that is not there.
    #[error("{item} {index} refers to number {target} of {count}")]
    IndexOutOfRange {
        /// "triangle", "edge" or "polygon".
        item: &'static str,
        /// Its index.
        index: usize,
        /// The vertex or class it names.
        target: usize,
        /// How many vertices or classes there are.
        count: usize,
    },
    /// An array has neither one entry per item nor none.
    #[error("{found} {array} instead of {expected}")]
    Length {
        /// What the array holds.
        array: &'static str,
        /// The length that would fit.
        expected: usize,
        /// The length it has.
        found: usize,
    },
    /// The bounds of a picture must be bounds of angles.
    #[error("bounds of angles must be 0 to 60 and 60 to 180 degrees, got {low} and {high}")]
    Bounds {
        /// The smaller bound, degrees.
        low: f64,
        /// The larger bound, degrees.
        high: f64,
    },
    /// The box that a picture is to show is empty, not finite, or beside the mesh.
    #[error("the box from ({}, {}) to ({}, {}) {fault}", min.x, min.y, max.x, max.y)]
    Zoom {
        /// The smaller coordinates.
        min: DVec2,
        /// The larger coordinates.
        max: DVec2,
        /// What is wrong with it.
        fault: &'static str,
    },
    /// A picture is to be coloured by regions, of which the mesh has none.
    #[error("the mesh has no regions to colour triangles by")]
    NoRegions,
}
