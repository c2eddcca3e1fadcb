//! Meshes that points are put into and taken out of.
//!
//! The mesh of a [`Session`] is compact. Each call changes it where it has to and
//! nowhere else, and says what became of which vertices and triangles. How
//! that is done is `hexdel-optimize`'s business (`live`); here are the points,
//! their names, undo, and the mesh made anew where changes nearby do not
//! suffice. A [`TemplateSession`] does the same on the grid. `docs/sessions.md` explains
//! the whole.
//!
//! | module | what |
//! |---|---|
//! | `insert`, `draft` | points come, for good or for the time being |
//! | `remesh` | all points meshed anew |
//! | `graph`, `divide` | sessions of PSLGs |
//! | `domain` | hexagons that grow |
//! | `templates` | [`TemplateSession`] |
//! | `any` | [`AnySession`]: either |
//! | `saved` | sessions as text, with the feature `serde` |
//! | `certificate`, `values`, `outcome` | what is kept, values at vertices, what calls answer |
//! | `error`, `fault` | why a call did nothing, for people and for programs |
//!
//! Left to others: meshes made at once (`hexdel-mesher`). The crate `hexdel` has all of it under one name.

/// The example of the README, so that it stays true.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod any;
mod certificate;
mod divide;
mod domain;
mod draft;
mod error;
mod fault;
mod graph;
mod insert;
mod outcome;
mod remesh;
#[cfg(feature = "serde")]
mod saved;
mod templates;
mod values;

use hexdel_geom::{AngleBounds, DVec2, TriMesh, VertexId};
use hexdel_mesher::Triangulation;
use hexdel_mesher::for_sessions::{CONFLICT_REACH, FINEST, MAX_COORDINATE, corners, finest_spacing};
use hexdel_mesher::{Mesher, Method};
use hexdel_mesher::{Size, SizeError};
use hexdel_optimize::live::{LiveError, LiveMesh, Step};
use hexdel_optimize::{Sizing, kinds_of};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

pub use any::AnySession;
pub use error::SessionError;
pub use graph::SessionCheck;
use graph::{Frame, Told};
pub use outcome::{Outcome, PointId, SessionMesh};
use remesh::kinds;
pub use templates::TemplateSession;

/// Calls that can be undone.
const UNDO: usize = 256;

/// A mesh that changes.
///
/// ```
/// use hexdel::{DVec2, Session};
///
/// let mut session = Session::empty(DVec2::ZERO, 1.0)?;
/// let first = session.insert(DVec2::new(0.1, 0.2))?;
/// let second = session.insert(DVec2::new(0.1, 0.25))?;
/// assert!(session.certificate().holds());
/// assert!(!second.delta.triangles_added.is_empty());
///
/// session.remove(&[first.points[0]])?;
/// session.undo()?;
/// assert_eq!(session.points().count(), 2);
/// # Ok::<(), hexdel::SessionError>(())
/// ```
///
/// # Guarantees
///
/// After every call the mesh is a Delaunay mesh of the domain within the
/// bounds, with every point a vertex bit for bit and every edge within the
/// size: what has changed was held against the certificate's own
/// predicates. A call that fails changes nothing.
#[derive(Clone, Debug)]
pub struct Session {
    live: LiveMesh,
    bounds: AngleBounds,
    /// What the whole is meshed anew with, but for size and domain.
    options: Mesher,
    centre: DVec2,
    radius: f64,
    /// Whether the domain grows for points outside of it.
    grows: bool,
    size: Option<Size>,
    /// The slot of each point, none for removed ones.
    points: Vec<Option<u32>>,
    /// The point in each slot that has one.
    of_slot: BTreeMap<u32, PointId>,
    /// What there is of a PSLG.
    frame: Option<Arc<Frame>>,
    /// What was to be said of it.
    told: Arc<Told>,
    /// Points that have come or gone since the mesh was compared with one made at once.
    changed: usize,
    /// Whether calls do only what bounds and sizes ask for.
    drafts: bool,
    /// What undoes the last calls, the last one at the end.
    history: VecDeque<Undo>,
}

/// What undoes one call.
#[derive(Clone, Debug)]
struct Undo {
    mesh: Before,
    /// Points and their slots before.
    points: Vec<(PointId, Option<u32>)>,
    /// Size and radius before.
    size: Option<Size>,
    radius: f64,
    changed: usize,
}

#[derive(Clone, Debug)]
enum Before {
    Step(Step),
    /// The whole mesh, and what of it lies on segments.
    Whole(Box<LiveMesh>, Option<Arc<Frame>>),
}

impl Session {
    /// A hexagonal domain without points, within the bounds of
    /// [`Method::Compact`].
    ///
    /// # Errors
    ///
    /// [`SessionError::InvalidDomain`].
    pub fn empty(centre: DVec2, radius: f64) -> Result<Self, SessionError> {
        let reach = centre.abs().max_element() + radius;
        let least = (FINEST * finest_spacing(DVec2::splat(reach))).max(1.0 / MAX_COORDINATE);
        let fits = radius > least && reach < MAX_COORDINATE;
        if !(centre.is_finite() && fits) {
            return Err(SessionError::InvalidDomain { centre, radius });
        }
        let mut vertices = corners(centre, radius).to_vec();
        vertices.push(centre);
        let triangles = (0..6).map(|i| [6, i, (i + 1) % 6].map(VertexId::new)).collect();
        let mesh = TriMesh { vertices, triangles };
        let kinds = kinds_of(&mesh, |_| false);
        let bounds = Method::Compact.bounds();
        let live = LiveMesh::new(mesh, &kinds, bounds).map_err(hexdel_mesher::Error::Optimize)?;
        Ok(Self {
            live,
            bounds,
            options: Mesher::new(),
            centre,
            radius,
            grows: false,
            size: None,
            points: Vec::new(),
            of_slot: BTreeMap::new(),
            frame: None,
            told: Arc::default(),
            changed: 0,
            drafts: false,
            history: VecDeque::new(),
        })
    }

    /// The mesh that a mesher makes of points, as a session. Its method
    /// is taken to be [`Method::Compact`].
    ///
    /// # Errors
    ///
    /// [`SessionError::Mesh`], [`SessionError::Duplicate`] by the number of the
    /// earlier point, [`SessionError::NotForSessions`] for the simple method.
    pub fn new(points: &[DVec2], mesher: &Mesher) -> Result<Self, SessionError> {
        let made = compact(mesher)?.triangulate(points)?;
        Self::of(made, mesher)
    }

    /// A mesh that a mesher has made of points, as a session: that of [`new`](Self::new), if
    /// the mesh has been made already.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Session};
    /// let points = [DVec2::ZERO, DVec2::X, DVec2::new(0.2, 0.7)];
    /// let mesher = Mesher::new();
    /// let made = mesher.triangulate(&points)?;
    /// let mut session = Session::of(made, &mesher)?;
    /// session.insert(DVec2::new(0.4, 0.4))?;
    /// # Ok::<(), hexdel::SessionError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new) but for [`SessionError::Mesh`].
    pub fn of(made: Triangulation, mesher: &Mesher) -> Result<Self, SessionError> {
        let mesher = compact(mesher)?;
        let inputs = made.input_of_vertex();
        for (i, v) in made.vertex_of_input.iter().enumerate() {
            if let Some(first) = inputs[v.index()].filter(|&first| first as usize != i) {
                let at = made.mesh.vertices[v.index()];
                return Err(SessionError::Duplicate { at, of: PointId(u64::from(first)) });
            }
        }
        let kinds = kinds(&made);
        let slots: Vec<u32> = made.vertex_of_input.iter().map(|v| v.index() as u32).collect();
        let mut live = LiveMesh::new(made.mesh, &kinds, made.certificate.bounds)
            .map_err(hexdel_mesher::Error::Optimize)?;
        let size = mesher.asked().size.cloned();
        live.assume_sizing(size.clone().map(|s| Arc::new(s) as Arc<dyn Sizing>));
        Ok(Self {
            live,
            bounds: made.certificate.bounds,
            options: mesher.for_session(),
            centre: made.patch.centre,
            radius: made.patch.radius,
            grows: false,
            size,
            of_slot: slots.iter().enumerate().map(|(i, &v)| (v, PointId(i as u64))).collect(),
            points: slots.into_iter().map(Some).collect(),
            frame: None,
            told: Arc::default(),
            changed: 0,
            drafts: false,
            history: VecDeque::new(),
        })
    }

    /// Refuses a point that coordinates do not tell from another.
    fn check_point(&mut self, at: DVec2) -> Result<(), SessionError> {
        if !at.is_finite() {
            return Err(SessionError::NotFinite { at });
        }
        let fixed = self.live.nearest_fixed(at).map(|(slot, distance)| (self.live.position(slot), distance));
        let on_segment = if self.frame.is_some() { self.live.nearest_on_segment(at) } else { None };
        for (to, distance) in fixed.into_iter().chain(on_segment) {
            let least = finest_spacing(at).max(finest_spacing(to)) * CONFLICT_REACH;
            if distance > 0.0 && distance < least {
                return Err(SessionError::TooClose { at, to, distance, least });
            }
        }
        Ok(())
    }

    /// Takes back all since the last call, points beyond `before` with it.
    fn abandon(&mut self, before: usize) {
        self.live.abandon();
        for slot in self.points.drain(before..).flatten() {
            self.of_slot.remove(&slot);
        }
    }

    /// Takes points out, all or none. Vertices that become superfluous go with
    /// them.
    ///
    /// # Errors
    ///
    /// [`SessionError::UnknownPoint`]; of a PSLG [`SessionError::SegmentEnd`], and
    /// [`SessionError::NoRoom`] where the bounds of places without a point cannot be
    /// reached.
    ///
    /// # Complexity
    ///
    /// In proportion to the triangles that change, but for comparison with a mesh made at
    /// once as after [`insert_all`](Self::insert_all).
    pub fn remove(&mut self, ids: &[PointId]) -> Result<Outcome, SessionError> {
        let mut sorted: Vec<PointId> = ids.to_vec();
        sorted.sort_unstable();
        let known = |id: &PointId| self.points.get(id.0 as usize).copied().flatten();
        let twice = sorted.windows(2).find(|w| w[0] == w[1]).map(|w| w[0]);
        if let Some(id) = twice.or_else(|| sorted.iter().copied().find(|id| known(id).is_none())) {
            return Err(SessionError::UnknownPoint { id });
        }
        let slots: Vec<(PointId, u32)> =
            ids.iter().filter_map(|&id| self.points[id.0 as usize].map(|slot| (id, slot))).collect();
        if let Some(&(id, _)) = slots.iter().find(|(_, slot)| self.live.ends_segment(*slot)) {
            return Err(SessionError::SegmentEnd { id });
        }
        let was_short = self.was_short();
        for &(_, slot) in &slots {
            let at = self.live.position(slot);
            if self.live.release(slot).is_err() {
                self.live.abandon();
                return Err(SessionError::NoRoom { at });
            }
        }
        for &(id, slot) in &slots {
            self.points[id.0 as usize] = None;
            self.of_slot.remove(&slot);
        }
        let changed = self.changed;
        let abandon = |session: &mut Self| {
            session.live.abandon();
            for &(id, slot) in &slots {
                session.points[id.0 as usize] = Some(slot);
                session.of_slot.insert(slot, id);
            }
        };
        let outcome = self.improved(ids.len(), was_short, abandon).unwrap_or_else(|| {
            let undo = slots.iter().map(|&(id, slot)| (id, Some(slot))).collect();
            self.done(self.points.len(), undo, self.size.clone())
        });
        Ok(self.counting_from(changed, outcome))
    }

    /// Lets undo of a call restore the count of changed points.
    fn counting_from(&mut self, changed: usize, outcome: Outcome) -> Outcome {
        self.history.back_mut().into_iter().for_each(|undo| undo.changed = changed);
        outcome
    }

    /// Wants edges to be as short as a size says, or as long as the points
    /// allow.
    ///
    /// # Errors
    ///
    /// [`SessionError::Size`].
    ///
    /// # Complexity
    ///
    /// A look at every edge, and work in proportion to what changes.
    pub fn set_size(&mut self, size: Option<Size>) -> Result<Outcome, SessionError> {
        if let Some(size) = &size {
            let reach = self.centre.abs().max_element() + self.radius;
            size.check(finest_spacing(DVec2::splat(reach)))?;
        }
        let sizing = size.clone().map(|s| Arc::new(s) as Arc<dyn Sizing>);
        match self.live.set_sizing(sizing) {
            Ok(()) => {
                let old = std::mem::replace(&mut self.size, size);
                Ok(self.done(self.points.len(), Vec::new(), old))
            }
            Err(LiveError::Unsized { at, length }) => {
                self.live.abandon();
                Err(SizeError::Unreached { at, length }.into())
            }
            Err(LiveError::TooMany { triangles }) => Err(SizeError::TooMany { triangles }.into()),
            Err(other) => {
                self.live.abandon();
                Err(SessionError::Live(other))
            }
        }
    }

    /// Cuts the longest edge wanted in a box to `2^-halvings` of the longest
    /// that is there, and leaves the rest as it is but for a transition.
    ///
    /// # Errors
    ///
    /// [`SessionError::Size`].
    pub fn refine_box(&mut self, a: DVec2, b: DVec2, halvings: u8) -> Result<Outcome, SessionError> {
        let (low, high) = (a.min(b), a.max(b));
        let longest = self.live.longest_edge_in(low, high);
        let size = (0..halvings).fold(longest, |size, _| 0.5 * size);
        let now = self.size.clone().unwrap_or_else(Size::unlimited);
        self.set_size(Some(now.and_box(low, high, size)?))
    }

    /// Doubles the radius of the domain. The whole is meshed anew.
    ///
    /// # Errors
    ///
    /// [`SessionError`] if the larger domain cannot be meshed, or if it is that of
    /// a PSLG.
    pub fn grow(&mut self) -> Result<Outcome, SessionError> {
        if self.frame.is_some() {
            return Err(SessionError::NotForSessions { option: "growing the domain of a PSLG" });
        }
        let (ids, points) = self.present();
        self.remesh(&ids, &points, 2.0 * self.radius, self.size.clone())
    }

    /// Meshes all points anew in the same domain, as if they had come at once.
    ///
    /// # Errors
    ///
    /// [`SessionError`] if that fails, or the domain is that of a PSLG and not what its
    /// segments enclose.
    ///
    /// # Complexity
    ///
    /// That of a mesh made at once.
    pub fn renew(&mut self) -> Result<Outcome, SessionError> {
        if let Some(frame) = self.frame.clone() {
            let anew = self.anew_with_segments(&frame, &[])?;
            return Ok(self.replace_graph(anew));
        }
        let (ids, points) = self.present();
        self.remesh(&ids, &points, self.radius, self.size.clone())
    }

    /// Takes the last call back that changed something and is not taken back
    /// yet; 256 are remembered, none across saving.
    ///
    /// # Errors
    ///
    /// [`SessionError::NothingToUndo`].
    ///
    /// # Complexity
    ///
    /// In proportion to what the call changed.
    pub fn undo(&mut self) -> Result<Outcome, SessionError> {
        let undo = self.history.pop_back().ok_or(SessionError::NothingToUndo)?;
        let (delta, remeshed) = match undo.mesh {
            Before::Step(step) => (self.live.undo(&step), false),
            Before::Whole(old, frame) => {
                self.frame = frame;
                (self.live.replace_by(*old).1, true)
            }
        };
        // All slots are freed before any is taken: some may change hands.
        for &(id, _) in &undo.points {
            if let Some(slot) = self.points[id.0 as usize].take() {
                self.of_slot.remove(&slot);
            }
        }
        for (id, slot) in undo.points {
            self.points[id.0 as usize] = slot;
            if let Some(slot) = slot {
                self.of_slot.insert(slot, id);
            }
        }
        let domain = (undo.radius != self.radius).then_some((self.centre, undo.radius));
        (self.size, self.radius, self.changed) = (undo.size, undo.radius, undo.changed);
        self.live.assume_sizing(self.size.clone().map(|s| Arc::new(s) as Arc<dyn Sizing>));
        Ok(Outcome { points: Vec::new(), delta, remeshed, domain })
    }

    /// Ends a call whose points come after `before`; undoing it restores the
    /// slots of `points` and the size.
    fn done(&mut self, before: usize, points: Vec<(PointId, Option<u32>)>, size: Option<Size>) -> Outcome {
        let (step, delta) = self.live.take_step();
        let (radius, changed) = (self.radius, self.changed);
        self.push(Undo { mesh: Before::Step(step), points, size, radius, changed });
        let points = (before..self.points.len()).map(|i| PointId(i as u64)).collect();
        Outcome { points, delta, remeshed: false, domain: None }
    }

    fn push(&mut self, undo: Undo) {
        if self.history.len() == UNDO {
            self.history.pop_front();
        }
        self.history.push_back(undo);
    }

    /// The points that are there.
    pub fn points(&self) -> impl Iterator<Item = (PointId, DVec2)> + '_ {
        let present =
            |(i, slot): (usize, &Option<u32>)| slot.map(|slot| (PointId(i as u64), self.live.position(slot)));
        self.points.iter().enumerate().filter_map(present)
    }

    /// Numbers of points, vertices and triangles.
    pub fn counts(&self) -> [usize; 3] {
        let [vertices, triangles] = self.live.counts();
        [self.of_slot.len(), vertices, triangles]
    }

    /// Centre and circumradius of the domain.
    pub fn domain(&self) -> (DVec2, f64) {
        (self.centre, self.radius)
    }

    /// How long edges may be.
    pub fn size(&self) -> Option<&Size> {
        self.size.as_ref()
    }

    /// Vertices and triangles as they stand: those of [`mesh`](Self::mesh), without names.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn plain_mesh(&self) -> TriMesh {
        self.live.snapshot().mesh
    }

    /// The mesh as it stands.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn mesh(&self) -> SessionMesh {
        let snapshot = self.live.snapshot();
        let named = |(v, slot): (usize, &u32)| self.of_slot.get(slot).map(|&id| (id, VertexId::new(v)));
        let mut points: Vec<(PointId, VertexId)> =
            snapshot.vertex_slots.iter().enumerate().filter_map(named).collect();
        points.sort_unstable();
        let mut made = SessionMesh {
            points,
            mesh: snapshot.mesh.clone(),
            vertex_serials: snapshot.vertex_serials.clone(),
            triangle_serials: snapshot.triangle_serials.clone(),
            ..SessionMesh::default()
        };
        if let Some(frame) = &self.frame {
            self.add_segments(frame, &snapshot, &mut made);
        }
        made
    }
}

/// A mesher as a compact session takes it.
fn compact(mesher: &Mesher) -> Result<Mesher, SessionError> {
    if mesher.asked().method == Method::Simple {
        return Err(SessionError::NotForSessions { option: "the simple method" });
    }
    error::refuse_dual_edges(mesher)?;
    Ok(mesher.clone().method(Method::Compact))
}
