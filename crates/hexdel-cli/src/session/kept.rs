//! Sessions of either method, as commands know them.

use super::Refusal;
use hexdel::{
    Certificate, DVec2, Mesher, Outcome, PointId, Pslg, Session, SessionCheck, SessionError, SessionMesh,
    Size, TemplateSession,
};

/// A session of either method.
#[derive(Debug)]
pub(super) enum Kept {
    Compact(Box<Session>),
    Templates(Box<TemplateSession>),
}

/// Calls what both kinds of sessions have.
macro_rules! of_either {
    ($kept:expr, $session:ident => $call:expr) => {
        match $kept {
            Kept::Compact($session) => $call,
            Kept::Templates($session) => $call,
        }
    };
}

impl Kept {
    /// A session of the points of a graph, with its segments if there are any.
    pub(super) fn open(graph: &Pslg, templates: bool) -> Result<Self, Refusal> {
        let mesher = Mesher::new();
        Ok(match (graph.segments.is_empty(), templates) {
            (true, true) => Self::Templates(Box::new(TemplateSession::new(&graph.points, &mesher)?)),
            (true, false) => Self::Compact(Box::new(Session::new(&graph.points, &mesher)?)),
            (false, false) => Self::Compact(Box::new(Session::with_segments(graph, &mesher)?)),
            (false, true) => return Err("sessions of templates know no segments".into()),
        })
    }

    pub(super) fn empty(centre: DVec2, radius: f64, templates: bool) -> Result<Self, SessionError> {
        Ok(if templates {
            Self::Templates(Box::new(TemplateSession::empty(centre, radius)?))
        } else {
            Self::Compact(Box::new(Session::empty(centre, radius)?))
        })
    }

    /// A saved session, of the method that it was saved with.
    pub(super) fn load(text: &str) -> Result<Self, SessionError> {
        Ok(if TemplateSession::is_saved_in(text) {
            Self::Templates(Box::new(TemplateSession::from_ron(text)?))
        } else {
            Self::Compact(Box::new(Session::from_ron(text)?))
        })
    }

    pub(super) fn insert_all(&mut self, points: &[DVec2]) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.insert_all(points))
    }

    pub(super) fn remove(&mut self, ids: &[PointId]) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.remove(ids))
    }

    pub(super) fn size(&self) -> Option<&Size> {
        of_either!(self, session => session.size())
    }

    pub(super) fn set_size(&mut self, size: Option<Size>) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.set_size(size))
    }

    pub(super) fn refine_box(&mut self, a: DVec2, b: DVec2, halvings: u8) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.refine_box(a, b, halvings))
    }

    pub(super) fn grow(&mut self) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.grow())
    }

    pub(super) fn undo(&mut self) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.undo())
    }

    pub(super) fn points(&self) -> Vec<(PointId, DVec2)> {
        of_either!(self, session => session.points().collect())
    }

    pub(super) fn counts(&self) -> [usize; 3] {
        of_either!(self, session => session.counts())
    }

    pub(super) fn domain(&self) -> (DVec2, f64) {
        of_either!(self, session => session.domain())
    }

    pub(super) fn mesh(&self) -> SessionMesh {
        of_either!(self, session => session.mesh())
    }

    pub(super) fn certificate(&self) -> Certificate {
        of_either!(self, session => session.certificate())
    }

    /// What the mesh keeps, found out from scratch.
    pub(super) fn check(&self) -> SessionCheck {
        match self {
            Self::Compact(session) => session.check(),
            Self::Templates(session) => session.certificate().into(),
        }
    }

    /// The attributes of the regions that triangles are in, zero for none.
    pub(super) fn region_attributes(&self, made: &SessionMesh) -> Vec<f64> {
        match self {
            Self::Compact(session) => session.region_attributes(made),
            Self::Templates(_) => Vec::new(),
        }
    }

    pub(super) fn to_ron(&self) -> Result<String, SessionError> {
        of_either!(self, session => session.to_ron())
    }
}
