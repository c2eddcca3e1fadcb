//! What errors of sessions are about, for programs.

use crate::{PointId, SessionError};
use hexdel_mesher::Fault;

impl SessionError {
    /// What the error is about, for programs. Points are counted as in the session.
    pub fn fault(&self) -> Fault {
        let of = |kind, id: &PointId| Fault::new(kind).of("point", [id.0 as usize]);
        match self {
            Self::Mesh(error) => error.fault(),
            Self::Size(error) => error.fault(),
            Self::NotFinite { at } => Fault::new("not_finite").at(*at),
            Self::Outside { at, .. } | Self::NotCovered { at } | Self::AtRim { at, .. } => {
                Fault::new("outside").at(*at)
            }
            Self::NoRoom { at } => Fault::new("no_room").at(*at),
            Self::SegmentEnd { id } => of("segment_end", id),
            Self::UnknownPoint { id } => of("unknown_point", id),
            Self::Duplicate { at, of: id } => of("duplicate", id).at(*at),
            Self::TooClose { at, least, .. } => Fault::new("too_close").at(*at).least(*least),
            Self::NothingToUndo => Fault::new("nothing_to_undo"),
            Self::InvalidDomain { centre, .. } => Fault::new("domain").at(*centre),
            Self::NotForSessions { .. } | Self::NoSegments | Self::CannotSave => Fault::new("option"),
            Self::Unreadable { .. } | Self::State(_) | Self::Points { .. } | Self::NotCertified { .. } => {
                Fault::new("file")
            }
            Self::Live(_) => Fault::new("session"),
        }
    }
}
