//! Why a session did not do what was asked.

use super::PointId;
use hexdel_geom::{Certificate, DVec2};
use hexdel_mesher::Error;
use hexdel_mesher::Mesher;
use hexdel_mesher::SizeError;
use hexdel_mesher::for_sessions::MAX_COORDINATE;
use hexdel_optimize::live::{LiveError, StateError};
use thiserror::Error as ThisError;

/// Why a session did not do what was asked. The session is as it was.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum SessionError {
    /// A coordinate is not a finite number.
    #[error("the coordinates of a point must be finite, got ({}, {})", at.x, at.y)]
    NotFinite {
        /// The point.
        at: DVec2,
    },
    /// A point is not inside the domain.
    #[error("({:?}, {:?}) lies outside the domain of radius {radius:?}, which does not grow by itself: `grow` doubles it", at.x, at.y)]
    Outside {
        /// The point.
        at: DVec2,
        /// Circumradius of the domain.
        radius: f64,
    },
    /// A point is not in what the segments of a PSLG enclose.
    #[error("({:?}, {:?}) lies outside the domain", at.x, at.y)]
    NotCovered {
        /// The point.
        at: DVec2,
    },
    /// There is no room for a point, or the place of one, within the bounds.
    #[error("there is no room at ({:?}, {:?}): no change nearby keeps the bounds", at.x, at.y)]
    NoRoom {
        /// The point.
        at: DVec2,
    },
    /// A point that segments end at stays.
    #[error("point {} is an end of a segment", id.0)]
    SegmentEnd {
        /// The point.
        id: PointId,
    },
    /// An option that sessions do not keep.
    #[error("sessions do not support {option}")]
    NotForSessions {
        /// The option.
        option: &'static str,
    },
    /// Segments were given to a session of templates.
    #[error("sessions of templates do not support segments")]
    NoSegments,
    /// There is the same point already.
    #[error("point {} is already at ({:?}, {:?})", of.0, at.x, at.y)]
    Duplicate {
        /// The point.
        at: DVec2,
        /// Which one it is.
        of: PointId,
    },
    /// A point is so close to the rim that hexagons along it would have to be
    /// smaller than they may.
    #[error("({:?}, {:?}) is too close to the rim at {radius:?}: there is no room for templates between them", at.x, at.y)]
    AtRim {
        /// The point, or the one closest to the rim.
        at: DVec2,
        /// Circumradius of the domain.
        radius: f64,
    },
    /// A point is closer to another than coordinates resolve.
    #[error("({:?}, {:?}) is {distance:e} from ({:?}, {:?}), closer than the {least:e} that coordinates resolve",
        at.x, at.y, to.x, to.y)]
    TooClose {
        /// The point.
        at: DVec2,
        /// The point it is too close to.
        to: DVec2,
        /// Their distance.
        distance: f64,
        /// The smallest distance that would do.
        least: f64,
    },
    /// There is no such point, or it is named twice.
    #[error("there is no point {}", id.0)]
    UnknownPoint {
        /// The point.
        id: PointId,
    },
    /// No more calls can be undone.
    #[error("there is nothing to undo")]
    NothingToUndo,
    /// A radius is not positive, or coordinates do not resolve it.
    #[error(
        "the radius of a domain must be positive, resolved by its coordinates and within {MAX_COORDINATE:e}, got \
         {radius:?} around ({:?}, {:?})",
        centre.x, centre.y
    )]
    InvalidDomain {
        /// The centre of the domain.
        centre: DVec2,
        /// The radius.
        radius: f64,
    },
    /// A size is none, or cannot be had.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The whole was meshed anew, and that failed.
    #[error(transparent)]
    Mesh(#[from] Error),
    /// A change of the mesh was not made.
    #[error(transparent)]
    Live(LiveError),
    /// Sizes by a function cannot be saved.
    #[error("a size given by a function cannot be saved")]
    CannotSave,
    /// What was read is not a saved session.
    #[error("not a saved session: {message}")]
    Unreadable {
        /// What the parser says.
        message: String,
    },
    /// What was read is a session whose mesh is none.
    #[error("not a saved session: {0}")]
    State(#[from] StateError),
    /// What was read is a session whose points are not vertices of its mesh.
    #[error("not a saved session: point {} must be a vertex of its own", id.0)]
    Points {
        /// The first such point.
        id: PointId,
    },
    /// What was read is a session whose mesh does not hold.
    #[error("not a valid session: {} triangles of its mesh are out of bounds", certificate.out_of_bounds)]
    NotCertified {
        /// What its certificate says.
        certificate: Box<Certificate>,
    },
}

/// A bound on dual edges is certified on whole meshes alone.
pub(super) fn refuse_dual_edges(mesher: &Mesher) -> Result<(), SessionError> {
    match mesher.asked().min_dual_edge {
        Some(_) => Err(SessionError::NotForSessions { option: "a bound on dual edges" }),
        None => Ok(()),
    }
}
