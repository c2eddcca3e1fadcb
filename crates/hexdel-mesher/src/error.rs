//! Why points or a PSLG could not be meshed.

use crate::dual_edges::MOST_DUAL_EDGE;
use crate::size::SizeError;
use crate::workers::MAX_THREADS;
use hexdel_classify::DualError;
use hexdel_geom::certificate::{DualCheck, max_angle_of_ratio};
use hexdel_geom::{AngleBounds, Cancelled, Certificate, DVec2, DelaunayError, PointsError, TriMesh};
use hexdel_optimize::OptimizeError;
use hexdel_pslg::{PslgError, ValidateError};
use hexdel_refine::RefineError;
use thiserror::Error;

/// Why points or a PSLG could not be meshed. Points and segments are counted
/// from 0, as given.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The points are no input: none at all, or one is not finite.
    #[error(transparent)]
    Points(#[from] PointsError),
    /// A coordinate is so large that its square leaves the range of numbers.
    #[error("point {index} at ({:?}, {:?}) is out of range: coordinates may be up to {limit:e}", point.x, point.y)]
    OutOfRange {
        /// Index of the point.
        index: usize,
        /// The point.
        point: DVec2,
        /// The largest coordinate supported.
        limit: f64,
    },
    /// Two points are closer than their coordinates can resolve: vertices
    /// between them would be rounded by more than angles bear.
    #[error(
        "points {a} at ({:?}, {:?}) and {b} at ({:?}, {:?}) are {distance:e} apart, closer than the {least:e} \
         that coordinates of this size resolve",
        points[0].x, points[0].y, points[1].x, points[1].y
    )]
    TooClose {
        /// Index of one point.
        a: usize,
        /// Index of the other.
        b: usize,
        /// Both points.
        points: [DVec2; 2],
        /// Their distance.
        distance: f64,
        /// The smallest distance that would do.
        least: f64,
    },
    /// The domain asked for leaves too little room around the points.
    #[error("a domain of radius {radius:?} is too small: these points need about {least:?}")]
    DomainTooSmall {
        /// The radius asked for.
        radius: f64,
        /// A radius that would do on the grid that the one asked for gave. The
        /// grid follows the radius, so that a second, larger one may be named.
        least: f64,
    },
    /// The domain asked for is so much larger than the distance of the closest
    /// points that the levels run out.
    #[error("a domain of radius {radius:?} is too large: points this close allow at most {most:?}")]
    DomainTooLarge {
        /// The radius asked for.
        radius: f64,
        /// A radius that would do.
        most: f64,
    },
    /// The domain asked for is not a positive number.
    #[error("the radius of the domain must be positive and finite, got {radius:?}")]
    InvalidRadius {
        /// The radius asked for.
        radius: f64,
    },
    /// The method does not keep the bounds asked for.
    #[error(
        "the method cannot keep angles between {} and {} degrees, only {} to {}",
        asked.min_deg(), asked.max_deg(), kept.min_deg(), kept.max_deg()
    )]
    BoundsBeyondMethod {
        /// The bounds asked for.
        asked: AngleBounds,
        /// The bounds the method keeps for every input.
        kept: AngleBounds,
    },
    /// Within the bounds asked for no mesh can be finer in one place than in another, as
    /// points in general position need it: see [`AngleBounds::allow_grading`].
    #[error(
        "no graded mesh has all angles between {} and {} degrees: the lower bound may be at most {:.1}, \
         the upper bound at least {}",
        asked.min_deg(), asked.max_deg(), AngleBounds::MOST_GRADED_MIN_DEG, AngleBounds::LEAST_GRADED_MAX_DEG
    )]
    NoGrading {
        /// The bounds asked for.
        asked: AngleBounds,
    },
    /// Dual edges cannot be that long in a graded mesh, or the ratio is no positive number: see
    /// [`Mesher::min_dual_edge`](crate::Mesher::min_dual_edge).
    #[error(
        "the ratio of dual edges to edges must be positive and at most {MOST_DUAL_EDGE}, got {ratio:?}{}",
        angle_of(*ratio)
    )]
    NoDualEdge {
        /// The ratio asked for.
        ratio: f64,
    },
    /// The segments of a PSLG cross or overlap, or its arrays do not fit
    /// together.
    #[error(transparent)]
    Segments(ValidateError),
    /// A PSLG could not be meshed.
    #[error(transparent)]
    Pslg(PslgError),
    /// Two polygons overlap, which was to be an error.
    #[error(
        "polygons {} (attribute {}) and {} (attribute {}) overlap at ({}, {}), area {area}",
        polygons[0], attributes[0], polygons[1], attributes[1], at.x, at.y
    )]
    Overlap {
        /// Their indices.
        polygons: [u32; 2],
        /// Their attributes.
        attributes: [f64; 2],
        /// A point in the largest part.
        at: DVec2,
        /// The area of all parts, square input units.
        area: f64,
    },
    /// A tolerance of repair is not a number, or negative.
    #[error("the tolerance must be finite and not negative, got {tolerance:?}")]
    InvalidTolerance {
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// An option that points have no use for; as a PSLG without segments they
    /// may.
    #[error("{option} applies to PSLGs, not to points")]
    NotForPoints {
        /// The option.
        option: &'static str,
    },
    /// An option that PSLGs have no use for.
    #[error("{option} applies to points, not to PSLGs")]
    NotForGraphs {
        /// The option.
        option: &'static str,
    },
    /// The mesh would be too large for 32-bit indices.
    #[error("the mesh would have {count} vertices, more than an index can hold")]
    TooManyVertices {
        /// How many it would have.
        count: u64,
    },
    /// The size wanted is none, or cannot be had.
    #[error(transparent)]
    Size(crate::size::SizeError),
    /// Rounding took an edge from Delaunay and no small move brings it back:
    /// the coordinates are exhausted there.
    #[error(transparent)]
    Delaunay(#[from] DelaunayError),
    /// The threads asked for could not be started, or are more than there may be.
    #[error("cannot start {threads} threads: at most {MAX_THREADS} are allowed")]
    Threads {
        /// How many were asked for.
        threads: usize,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// Optimisation ended, or its time did, before every angle was inside the
    /// bounds asked for. It always gets there where the bounds are no tighter
    /// than those of the templates; the mesh is the best one found.
    #[error(
        "optimisation did not reach angles between {} and {} degrees: {} of {} triangles are out of bounds",
        certificate.bounds.min_deg(), certificate.bounds.max_deg(),
        certificate.out_of_bounds, certificate.triangles
    )]
    Unreached {
        /// The mesh.
        mesh: Box<TriMesh>,
        /// Its certificate for the bounds asked for, which does not hold.
        certificate: Box<Certificate>,
    },
    /// Hexagons cannot be refined as the points ask for. The closest pair having been
    /// found to be resolved, this is a defect of the library.
    #[error(transparent)]
    Refine(RefineError),
    /// The mesh cannot be made of the hexagons. This is a defect of the library.
    #[error(transparent)]
    Dual(DualError),
    /// The mesh made to start optimisation with is none that it takes. This is
    /// a defect of the library.
    #[error(transparent)]
    Optimize(OptimizeError),
    /// The finished mesh does not keep what was promised. This is a defect of
    /// the library; the mesh is handed over with what is wrong with it.
    #[error(
        "the mesh fails its certificate: {} of {} triangles are out of bounds",
        certificate.out_of_bounds, certificate.triangles
    )]
    NotCertified {
        /// The mesh.
        mesh: Box<TriMesh>,
        /// Its certificate, which does not hold.
        certificate: Box<Certificate>,
    },
    /// The angles are within the bounds, but dual edges are shorter than the angles allow: one
    /// of the two measures is wrong. This is a defect of the library.
    #[error("{} of {} dual edges are shorter than {} of their edges", check.below, check.edges, check.min_ratio)]
    DualEdges {
        /// The mesh.
        mesh: Box<TriMesh>,
        /// What was found.
        check: Box<DualCheck>,
    },
}

/// Why a ratio is too large.
fn angle_of(ratio: f64) -> String {
    let most = AngleBounds::LEAST_GRADED_MAX_DEG;
    if ratio > MOST_DUAL_EDGE {
        let angle = max_angle_of_ratio(ratio);
        format!(
            ": angles would have to be at most {angle:.1} degrees, and no graded mesh has all below {most}"
        )
    } else {
        String::new()
    }
}

impl From<DualError> for Error {
    fn from(error: DualError) -> Self {
        match error {
            DualError::TooManyVertices { count } => Self::TooManyVertices { count },
            DualError::Cancelled(c) => Self::Cancelled(c),
            other => Self::Dual(other),
        }
    }
}

impl From<RefineError> for Error {
    fn from(error: RefineError) -> Self {
        match error {
            RefineError::Cancelled(c) => Self::Cancelled(c),
            other => Self::Refine(other),
        }
    }
}

impl From<ValidateError> for Error {
    fn from(error: ValidateError) -> Self {
        match error {
            ValidateError::Points(error) => Self::Points(error),
            ValidateError::OutOfRange { index, point, limit } => Self::OutOfRange { index, point, limit },
            other => Self::Segments(other),
        }
    }
}

impl From<PslgError> for Error {
    fn from(error: PslgError) -> Self {
        match error {
            PslgError::Cancelled(c) => Self::Cancelled(c),
            PslgError::InvalidSize { at, length } => {
                let what = format!("the place ({:?}, {:?})", at.x, at.y);
                Self::Size(SizeError::NotPositive { what, size: length })
            }
            other => Self::Pslg(other),
        }
    }
}

impl Error {
    /// Triangles outside the bounds of the mesh it carries; errors that carry
    /// none are worst.
    pub(crate) fn outside(&self) -> usize {
        match self {
            Self::Unreached { certificate, .. } | Self::NotCertified { certificate, .. } => {
                certificate.out_of_bounds
            }
            _ => usize::MAX,
        }
    }
}
