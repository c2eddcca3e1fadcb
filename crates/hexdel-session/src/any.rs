//! Sessions of either method behind one type.

use super::{Outcome, PointId, Session, SessionCheck, SessionError, SessionMesh, TemplateSession};
use hexdel_geom::{Certificate, DVec2, Pslg};
use hexdel_mesher::Size;
use hexdel_mesher::Warning;
use hexdel_mesher::{Mesher, Method};
use hexdel_pslg::RepairReport;

/// A session of either method.
///
/// ```
/// use hexdel::{AnySession, DVec2, Method, Mesher, Pslg};
///
/// let points = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y]);
/// for method in [Method::Compact, Method::Templates] {
///     let mut session = AnySession::new(&points, &Mesher::new().method(method))?;
///     session.insert(DVec2::new(0.25, 0.25))?;
///     assert!(session.check().holds());
/// }
/// # Ok::<(), hexdel::SessionError>(())
/// ```
///
/// # Guarantees
///
/// Those of the session inside.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum AnySession {
    /// Of [`Method::Compact`], with or without segments.
    Compact(Box<Session>),
    /// Of [`Method::Templates`].
    Templates(Box<TemplateSession>),
}

/// Calls what both kinds of sessions have.
macro_rules! of_either {
    ($any:expr, $session:ident => $call:expr) => {
        match $any {
            AnySession::Compact($session) => $call,
            AnySession::Templates($session) => $call,
        }
    };
}

impl From<Session> for AnySession {
    fn from(session: Session) -> Self {
        Self::Compact(Box::new(session))
    }
}

impl From<TemplateSession> for AnySession {
    fn from(session: TemplateSession) -> Self {
        Self::Templates(Box::new(session))
    }
}

impl AnySession {
    /// The mesh of the points of a PSLG as a session, with its segments if there are any:
    /// of templates if that is the mesher's method, else compact.
    ///
    /// # Errors
    ///
    /// As [`Session::new`], [`Session::with_segments`] and [`TemplateSession::new`];
    /// [`SessionError::NoSegments`] where templates are to have segments.
    pub fn new(graph: &Pslg, mesher: &Mesher) -> Result<Self, SessionError> {
        Ok(match (graph.segments.is_empty(), mesher.asked().method == Method::Templates) {
            (true, true) => TemplateSession::new(&graph.points, mesher)?.into(),
            (true, false) => Session::new(&graph.points, mesher)?.into(),
            (false, false) => Session::with_segments(graph, mesher)?.into(),
            (false, true) => return Err(SessionError::NoSegments),
        })
    }

    /// A session that begins with points, in a domain that follows them and grows by itself:
    /// of templates if that is the mesher's method, else compact. The outcome has the whole
    /// mesh as new.
    ///
    /// ```
    /// use hexdel::{AnySession, DVec2, Mesher};
    ///
    /// let (mut session, first) = AnySession::begin(&[DVec2::new(5.0, 5.0)], &Mesher::new())?;
    /// assert_eq!(first.points.len(), 1);
    /// let more = session.insert(DVec2::new(500.0, 5.0))?;
    /// assert!(more.domain.is_some_and(|(_, radius)| radius > 495.0));
    /// # Ok::<(), hexdel::SessionError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`Session::new`] and [`TemplateSession::new`].
    pub fn begin(points: &[DVec2], mesher: &Mesher) -> Result<(Self, Outcome), SessionError> {
        let session: Self = if mesher.asked().method == Method::Templates {
            TemplateSession::new(points, mesher)?.growing(true).into()
        } else {
            Session::new(points, mesher)?.growing(true).into()
        };
        let outcome = Outcome::of_beginning(&session.mesh(), session.domain());
        Ok((session, outcome))
    }

    /// A hexagonal domain without points: of templates if that is the method, else
    /// compact.
    ///
    /// # Errors
    ///
    /// [`SessionError::InvalidDomain`].
    pub fn empty(centre: DVec2, radius: f64, method: Method) -> Result<Self, SessionError> {
        Ok(if method == Method::Templates {
            TemplateSession::empty(centre, radius)?.into()
        } else {
            Session::empty(centre, radius)?.into()
        })
    }

    /// As [`Session::insert`].
    ///
    /// # Errors
    ///
    /// As [`insert_all`](Self::insert_all).
    pub fn insert(&mut self, point: DVec2) -> Result<Outcome, SessionError> {
        self.insert_all(&[point])
    }

    /// As [`Session::insert_all`] and [`TemplateSession::insert_all`].
    ///
    /// # Errors
    ///
    /// Theirs.
    pub fn insert_all(&mut self, points: &[DVec2]) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.insert_all(points))
    }

    /// As [`Session::remove`] and [`TemplateSession::remove`].
    ///
    /// # Errors
    ///
    /// Theirs.
    pub fn remove(&mut self, ids: &[PointId]) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.remove(ids))
    }

    /// How long edges may be.
    pub fn size(&self) -> Option<&Size> {
        of_either!(self, session => session.size())
    }

    /// As [`Session::set_size`] and [`TemplateSession::set_size`].
    ///
    /// # Errors
    ///
    /// [`SessionError::Size`].
    pub fn set_size(&mut self, size: Option<Size>) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.set_size(size))
    }

    /// As [`Session::refine_box`] and [`TemplateSession::refine_box`].
    ///
    /// # Errors
    ///
    /// [`SessionError::Size`].
    pub fn refine_box(&mut self, a: DVec2, b: DVec2, halvings: u8) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.refine_box(a, b, halvings))
    }

    /// As [`Session::grow`] and [`TemplateSession::grow`].
    ///
    /// # Errors
    ///
    /// Theirs.
    pub fn grow(&mut self) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.grow())
    }

    /// As [`Session::renew`] and [`TemplateSession::renew`].
    ///
    /// # Errors
    ///
    /// Theirs.
    pub fn renew(&mut self) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.renew())
    }

    /// As [`Session::undo`].
    ///
    /// # Errors
    ///
    /// [`SessionError::NothingToUndo`].
    pub fn undo(&mut self) -> Result<Outcome, SessionError> {
        of_either!(self, session => session.undo())
    }

    /// The points that are there.
    pub fn points(&self) -> Vec<(PointId, DVec2)> {
        of_either!(self, session => session.points().collect())
    }

    /// Numbers of points, vertices and triangles.
    pub fn counts(&self) -> [usize; 3] {
        of_either!(self, session => session.counts())
    }

    /// Centre and circumradius of the domain.
    pub fn domain(&self) -> (DVec2, f64) {
        of_either!(self, session => session.domain())
    }

    /// The mesh as it stands.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh, but for sorting.
    pub fn mesh(&self) -> SessionMesh {
        of_either!(self, session => session.mesh())
    }

    /// The certificate of the whole mesh, made from scratch.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn certificate(&self) -> Certificate {
        of_either!(self, session => session.certificate())
    }

    /// What the mesh keeps, found out from scratch.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn check(&self) -> SessionCheck {
        match self {
            Self::Compact(session) => session.check(),
            Self::Templates(session) => session.certificate().into(),
        }
    }

    /// As [`Session::warnings`]; templates have none.
    pub fn warnings(&self) -> &[Warning] {
        match self {
            Self::Compact(session) => session.warnings(),
            Self::Templates(_) => &[],
        }
    }

    /// As [`Session::repairs`]; templates have none.
    pub fn repairs(&self) -> Option<&RepairReport> {
        match self {
            Self::Compact(session) => session.repairs(),
            Self::Templates(_) => None,
        }
    }

    /// The attribute of the region of each triangle of a mesh of this session, 0 if it lies
    /// in none; none at all of templates.
    pub fn region_attributes(&self, made: &SessionMesh) -> Vec<f64> {
        match self {
            Self::Compact(session) => session.region_attributes(made),
            Self::Templates(_) => Vec::new(),
        }
    }
}
