//! Sessions as text (RON), to be continued.

use super::{AnySession, Frame, PointId, Session, SessionError, TemplateSession};
use hexdel_geom::DVec2;
use hexdel_mesher::Error;
use hexdel_mesher::Mesher;
use hexdel_mesher::for_sessions::finest_spacing;
use hexdel_mesher::for_sessions::worst_edge;
use hexdel_mesher::for_sessions::{Asked, check_threads};
use hexdel_mesher::{Size, SizeError};
use hexdel_optimize::live::{LiveMesh, LiveState};
use hexdel_optimize::{Effort, SIZE_TOLERANCE, Sizing};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::time::Duration;

/// The version of the format.
const VERSION: u32 = 1;

#[derive(Serialize, Deserialize)]
struct Document {
    version: u32,
    effort: u8,
    centre: DVec2,
    radius: f64,
    size: Option<Size>,
    /// The slot of each point, none for removed ones.
    points: Vec<Option<u32>>,
    mesh: LiveState,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    frame: Option<Frame>,
    /// Points that have come or gone since the mesh was compared with one made at once.
    #[serde(default)]
    changed: usize,
    #[serde(default)]
    grows: bool,
    #[serde(default)]
    options: SavedOptions,
}

/// Options that a session goes on with.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct SavedOptions {
    budget: Option<Duration>,
    threads: Option<usize>,
    without_coarsening: bool,
}

impl SavedOptions {
    pub(super) fn of(mesher: &Mesher) -> Self {
        let Asked { budget, threads, without_coarsening, .. } = mesher.asked();
        Self { budget, threads, without_coarsening }
    }

    pub(super) fn restored(self, effort: Effort) -> Result<Mesher, Error> {
        self.threads.map_or(Ok(()), check_threads)?;
        let mesher = Mesher::new().effort(effort).coarsening(!self.without_coarsening);
        let mesher = self.budget.into_iter().fold(mesher, Mesher::budget);
        Ok(self.threads.into_iter().fold(mesher, Mesher::threads))
    }
}

impl Session {
    /// The session as text. What is read back from it goes on as this one would,
    /// except that the calls so far cannot be undone.
    ///
    /// # Errors
    ///
    /// [`SessionError::CannotSave`] if the size is given by a function.
    pub fn to_ron(&self) -> Result<String, SessionError> {
        if !self.size.as_ref().is_none_or(Size::can_be_saved) {
            return Err(SessionError::CannotSave);
        }
        let document = Document {
            version: VERSION,
            effort: match self.options.asked().effort {
                Effort::Fast => 0,
                Effort::Best => 2,
                Effort::Fewest => 3,
                _ => 1,
            },
            centre: self.centre,
            radius: self.radius,
            size: self.size.clone(),
            points: self.points.clone(),
            mesh: self.live.state(),
            frame: self.frame.as_deref().cloned(),
            changed: self.changed,
            grows: self.grows,
            options: SavedOptions::of(&self.options),
        };
        ron::to_string(&document).map_err(|e| SessionError::Unreadable { message: e.to_string() })
    }

    /// Reads what [`to_ron`](Self::to_ron) wrote. The mesh is certified anew, but for its
    /// shortest edge.
    ///
    /// # Errors
    ///
    /// [`SessionError`] for what is no such text, or of a mesh that does not
    /// hold.
    pub fn from_ron(text: &str) -> Result<Self, SessionError> {
        let unreadable = |message: String| SessionError::Unreadable { message };
        let document: Document = ron::from_str(text).map_err(|e| unreadable(e.to_string()))?;
        if document.version != VERSION {
            return Err(unreadable(format!("version {}, not {VERSION}", document.version)));
        }
        let (centre, radius) = (document.centre, document.radius);
        if !(centre.is_finite() && radius.is_finite() && radius > 0.0) {
            return Err(SessionError::InvalidDomain { centre, radius });
        }
        let size = document.size.map(Size::checked).transpose()?;
        let mut live = LiveMesh::restore(document.mesh)?;
        let mut of_slot = BTreeMap::new();
        for (i, slot) in document.points.iter().enumerate() {
            let id = PointId(i as u64);
            if slot.is_some_and(|slot| !live.is_fixed(slot) || of_slot.insert(slot, id).is_some()) {
                return Err(SessionError::Points { id });
            }
        }
        live.assume_sizing(size.clone().map(|s| Arc::new(s) as Arc<dyn Sizing>));
        let frame = document.frame.map(Arc::new);
        if frame.is_some() != live.is_constrained() || frame.as_ref().is_some_and(|f| !f.fits(&live)) {
            return Err(unreadable("segments that are not those of the mesh".to_owned()));
        }
        let least = finest_spacing(DVec2::splat(centre.abs().max_element() + radius));
        size.as_ref().map_or(Ok(()), |size| size.check(least))?;
        let efforts = [Effort::Fast, Effort::Standard, Effort::Best, Effort::Fewest];
        let effort = efforts[usize::from(document.effort.min(3))];
        let session = Self {
            bounds: live.bounds()[1],
            live,
            options: document.options.restored(effort)?,
            centre,
            radius,
            grows: document.grows,
            size,
            points: document.points,
            of_slot,
            frame,
            told: Arc::default(),
            changed: document.changed,
            drafts: false,
            history: VecDeque::new(),
        };
        let check = session.checked(session.certificate());
        if !check.holds() {
            return Err(SessionError::NotCertified { certificate: Box::new(check.certificate) });
        }
        if let Some(size) = &session.size {
            let (ratio, at, length) = worst_edge(&session.mesh().mesh, size);
            if ratio > 1.0 + SIZE_TOLERANCE {
                return Err(SizeError::Unreached { at, length }.into());
            }
        }
        Ok(session)
    }
}

impl AnySession {
    /// A saved session, of the method that it was saved with.
    ///
    /// # Errors
    ///
    /// As [`Session::from_ron`].
    pub fn from_ron(text: &str) -> Result<Self, SessionError> {
        Ok(if TemplateSession::is_saved_in(text) {
            TemplateSession::from_ron(text)?.into()
        } else {
            Session::from_ron(text)?.into()
        })
    }

    /// As [`Session::to_ron`].
    ///
    /// # Errors
    ///
    /// [`SessionError::CannotSave`] if the size is given by a function.
    pub fn to_ron(&self) -> Result<String, SessionError> {
        match self {
            Self::Compact(session) => session.to_ron(),
            Self::Templates(session) => session.to_ron(),
        }
    }
}
