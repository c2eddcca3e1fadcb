//! Why a mesh did not grow.

use hexdel_geom::{Cancelled, DVec2};
use thiserror::Error;

/// Why there is no mesh. All but the last two are about the input.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GrowError {
    /// No mesh grows to such a bound.
    #[error("the lower bound must be between {} and {} degrees, got {asked}", kept[0], kept[1])]
    Bound {
        /// The lower bound asked for, degrees.
        asked: f64,
        /// The least and the largest one, degrees.
        kept: [f64; 2],
    },
    /// A segment ends at a point that there is not.
    #[error("segment {segment} ends at point {point}, but there are {points} points, numbered from 0")]
    NoSuchPoint {
        /// Index of the segment.
        segment: usize,
        /// Index of the point.
        point: usize,
        /// How many points there are.
        points: usize,
    },
    /// A coordinate is too large or too small for the first triangulation, or not a number.
    #[error("point {index} at ({:?}, {:?}) cannot be triangulated: coordinates must be 0 or between 1e-42 and 1e60", point.x, point.y)]
    OutOfRange {
        /// Index of the point.
        index: usize,
        /// The point.
        point: DVec2,
    },
    /// Two points are the same, so that segments and results have no certain vertex.
    #[error("points must be different, got {same} that are as others before them")]
    SamePoints {
        /// How many.
        same: usize,
    },
    /// A segment is not an edge of the first triangulation: it crosses another or has a point on it.
    #[error("segment {segment} crosses another segment or passes a point; divide it there first")]
    NotAnEdge {
        /// Index of the segment.
        segment: usize,
    },
    /// Nothing is left after holes and the outside have been taken away.
    #[error("the segments enclose nothing but holes")]
    NothingEnclosed,
    /// The deadline passed.
    #[error("time was up before the mesh had grown")]
    OutOfTime,
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
