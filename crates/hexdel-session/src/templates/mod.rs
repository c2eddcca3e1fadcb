//! A mesh of templates that points are put into and taken out of.
//!
//! The grid is the state. Its rules ask for more where a point comes and for
//! less where one goes; the tiles that see what changed are asked again what
//! part of the mesh they are. See `docs/sessions.md`.
//!
//! | module | what |
//! |---|---|
//! | `grown` | the grid and its mesh, kept in step |
//! | `cells` | the mesh tile by tile, serial numbers, what has changed |
//! | `laid` | where the lattice lies |
//! | `patch` | what is new, made Delaunay and certified |
//! | `saved` | sessions as text |
//! | `view` | what there is: points, counts, the mesh |

mod cells;
mod grown;
mod laid;
mod orders;
mod patch;
#[cfg(feature = "serde")]
mod saved;
mod view;

use super::domain::{is_inside, reaching};
use super::{Outcome, PointId, SessionError, UNDO};
use cells::{Replaced, Serials};
use grown::{Grown, Step, Stuck};
use hexdel_geom::{DVec2, TriMesh, closest_pair};
use hexdel_grid::{Grid, Lattice};
use hexdel_mesher::for_sessions::Workers;
use hexdel_mesher::for_sessions::check_count;
use hexdel_mesher::for_sessions::{CONFLICT_REACH, FINEST, MAX_COORDINATE, finest_spacing};
use hexdel_mesher::{Mesher, Method};
use hexdel_mesher::{Size, SizeError};
use laid::{Since, fitting};
use orders::Orders;
use std::collections::VecDeque;
use std::sync::Arc;

/// Radii are the same up to so much of them: they are products of spacings and steps.
const SAME_RADIUS: f64 = 1e-9;

/// Steps of level 0 to the corners of an empty domain.
const STEPS: u32 = 3;

/// A mesh of [`Method::Templates`] that changes.
///
/// ```
/// use hexdel::{DVec2, TemplateSession};
///
/// let mut session = TemplateSession::empty(DVec2::ZERO, 1.0)?;
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
/// Those of a [`Session`](super::Session): after every call the mesh is a
/// Delaunay mesh of the domain, here with angles of 43.89 to 90 degrees, with every
/// point a vertex bit for bit and every edge within the size. A call that fails changes nothing.
#[derive(Clone, Debug)]
pub struct TemplateSession {
    grown: Grown,
    points: Orders,
    since: Since,
    /// Whether the domain grows for points outside of it.
    grows: bool,
    /// The options it was made with, and the threads that work as they say.
    #[cfg_attr(not(feature = "serde"), expect(dead_code, reason = "sessions as text have them"))]
    options: Mesher,
    workers: Workers,
    /// What undoes the last calls, the last one at the end.
    history: VecDeque<Undo>,
}

/// What undoes one call.
#[derive(Clone, Debug)]
struct Undo {
    mesh: Before,
    /// Points and their places in the refiner's order before.
    points: Vec<(PointId, Option<u32>)>,
    /// What had come and gone then.
    since: Since,
}

#[derive(Clone, Debug)]
enum Before {
    Step(Box<Step>),
    Whole(Box<Grown>),
}

impl TemplateSession {
    /// A hexagonal domain without points.
    ///
    /// # Errors
    ///
    /// [`SessionError::InvalidDomain`].
    pub fn empty(centre: DVec2, radius: f64) -> Result<Self, SessionError> {
        let reach = centre.abs().max_element() + radius;
        let fits = radius > FINEST * finest_spacing(DVec2::splat(reach)) && reach < MAX_COORDINATE;
        if !(centre.is_finite() && fits) {
            return Err(SessionError::InvalidDomain { centre, radius });
        }
        let lattice = Lattice::new(centre, radius / f64::from(STEPS));
        let grown = Grown::new(lattice, STEPS, (&[], &[]), (Serials::default(), None))?;
        Ok(Self {
            grown,
            points: Orders::default(),
            since: Since::default(),
            grows: false,
            options: Mesher::new().method(Method::Templates),
            workers: Workers::default(),
            history: VecDeque::new(),
        })
    }

    /// The mesh that a mesher makes of points, as a session. Its method is
    /// taken to be [`Method::Templates`], with coarsening.
    ///
    /// # Errors
    ///
    /// [`SessionError::Mesh`], [`SessionError::Duplicate`] by the number of the
    /// earlier point, [`SessionError::NotForSessions`] for options that it does not keep.
    pub fn new(points: &[DVec2], mesher: &Mesher) -> Result<Self, SessionError> {
        mesher.refuse_options_of_pslgs()?;
        super::error::refuse_dual_edges(mesher)?;
        mesher.refuse_bounds_beyond_templates()?;
        if mesher.asked().without_coarsening {
            return Err(SessionError::NotForSessions { option: "meshing without coarsening" });
        }
        let (lattice, steps) = mesher.clone().method(Method::Templates).coarsest_lattice(points)?;
        check_distinct(points, 0)?;
        let ids: Vec<PointId> = (0..points.len() as u64).map(PointId).collect();
        let size = mesher.asked().size.cloned().map(Arc::new);
        if let Some(size) = &size {
            check_size(size, lattice.origin(), f64::from(steps) * lattice.spacing(0))?;
        }
        let kept = (Serials::default(), size);
        let options = mesher.for_session().method(Method::Templates);
        let workers = Workers::new(options.asked().threads)?;
        let grown = workers.run(|| Grown::new(lattice, steps, (&ids, points), kept))?;
        let mut orders = Orders::default();
        ids.iter().zip(0..).for_each(|(&id, order)| orders.set(id, Some(order)));
        Ok(Self {
            grown,
            points: orders,
            since: Since::default(),
            grows: false,
            options,
            workers,
            history: VecDeque::new(),
        })
    }

    /// Whether the domain grows by itself for points outside of it, which is not so unless it
    /// was said.
    #[must_use]
    pub fn growing(mut self, grows: bool) -> Self {
        self.grows = grows;
        self
    }

    /// Puts a point in.
    ///
    /// # Errors
    ///
    /// As [`insert_all`](Self::insert_all).
    pub fn insert(&mut self, point: DVec2) -> Result<Outcome, SessionError> {
        self.insert_all(&[point])
    }

    /// Puts points in, all or none.
    ///
    /// # Errors
    ///
    /// [`SessionError`] for a point that is not finite, outside, there already
    /// or too close to another or to the rim.
    ///
    /// # Complexity
    ///
    /// In proportion to what changes and to the number of levels. A point closer
    /// to the rim than the hexagons along it allow has the whole meshed anew, with
    /// smaller ones there.
    pub fn insert_all(&mut self, points: &[DVec2]) -> Result<Outcome, SessionError> {
        let workers = self.workers.clone();
        workers.run(|| self.insert_all_here(points))
    }

    fn insert_all_here(&mut self, points: &[DVec2]) -> Result<Outcome, SessionError> {
        let before = self.points.named();
        let wider = if self.grows { reaching(self.domain(), points) } else { None };
        let (centre, radius) = self.domain();
        for &point in points {
            // What is outside lies near no point inside, or growing finds out.
            if wider.is_none() || !point.is_finite() || is_inside(point - centre, radius) {
                self.check_point(point)?;
            }
        }
        check_distinct(points, before)?;
        let ids: Vec<PointId> = (before..).map(PointId).take(points.len()).collect();
        let present = self.points.len() + points.len();
        let mut since = self.since.and_come(points.len(), present);
        if let Some(radius) = wider {
            let all = self.points_with(&ids, points);
            check_distinct(&all.1, 0)?;
            let lattice = fitting(self.grown_domain(radius)?, &all.1);
            return self.mesh_anew(lattice, self.grown.size.clone(), all, (ids, since.and_lifted()));
        }
        if since.is_look_due(present) {
            since.seen = 0;
            let (all_ids, all) = self.points_with(&ids, points);
            if let Some(lattice) = self.better_lattice(&all) {
                let anew = self.mesh_anew(
                    lattice,
                    self.grown.size.clone(),
                    (all_ids, all),
                    (ids.clone(), since.and_laid(present)),
                );
                // Where it has no room along the rim, what is there may have.
                if anew.is_ok() {
                    return anew;
                }
            }
        }
        let first = self.grown.refiner.site_ids().len() as u32;
        match self.grown.exchange((&[], false), (&ids, points)) {
            Ok(step) => {
                ids.iter().zip(first..).for_each(|(&id, order)| self.points.set(id, Some(order)));
                let undo = ids.iter().map(|&id| (id, None)).collect();
                Ok(self.done(step, undo, ids, since))
            }
            Err(Stuck::Levels(error)) => {
                Err(grown::too_close(&error, &self.grown.lattice(), &self.points_with(&ids, points).1))
            }
            Err(Stuck::Rim | Stuck::Unsettled) => {
                let all = self.points_with(&ids, points);
                self.mesh_anew(
                    (self.grown.lattice(), self.grown.steps()),
                    self.grown.size.clone(),
                    all,
                    (ids, since),
                )
            }
        }
    }

    /// The points that are there, and others.
    fn points_with(&self, ids: &[PointId], points: &[DVec2]) -> (Vec<PointId>, Vec<DVec2>) {
        let (mut all_ids, mut all) = self.all_points();
        all_ids.extend_from_slice(ids);
        all.extend_from_slice(points);
        (all_ids, all)
    }

    /// Refuses a point that is outside, or that coordinates or levels do not tell
    /// from another.
    fn check_point(&self, at: DVec2) -> Result<(), SessionError> {
        if !at.is_finite() {
            return Err(SessionError::NotFinite { at });
        }
        let (centre, radius) = self.domain();
        if !is_inside(at - centre, radius) {
            return Err(SessionError::Outside { at, radius });
        }
        let near = self.grown.refiner.near(at).into_iter();
        let nearest = near.map(|(site, to)| (to.distance(at), site, to)).min_by(|p, q| p.0.total_cmp(&q.0));
        let Some((distance, site, to)) = nearest else {
            return Ok(());
        };
        if to == at {
            return Err(SessionError::Duplicate { at, of: self.grown.of_site[site as usize] });
        }
        let levels = self.grown.lattice().spacing(Grid::MAX_LEVELS - 2);
        let least = finest_spacing(at).max(finest_spacing(to)).max(levels) * CONFLICT_REACH;
        if distance < least { Err(SessionError::TooClose { at, to, distance, least }) } else { Ok(()) }
    }

    /// Takes points out, all or none. What they alone asked for goes with them.
    ///
    /// # Errors
    ///
    /// [`SessionError::UnknownPoint`].
    ///
    /// # Complexity
    ///
    /// In proportion to what changes and to the number of levels. When a sixteenth of the
    /// points has gone since the last time, all others are put in anew; the whole is meshed
    /// anew then if the rim has been refined.
    pub fn remove(&mut self, ids: &[PointId]) -> Result<Outcome, SessionError> {
        let workers = self.workers.clone();
        workers.run(|| self.remove_here(ids))
    }

    fn remove_here(&mut self, ids: &[PointId]) -> Result<Outcome, SessionError> {
        let mut sorted: Vec<PointId> = ids.to_vec();
        sorted.sort_unstable();
        let twice = sorted.windows(2).find(|w| w[0] == w[1]).map(|w| w[0]);
        let unknown = || sorted.iter().copied().find(|&id| self.order(id).is_none());
        if let Some(id) = twice.or_else(unknown) {
            return Err(SessionError::UnknownPoint { id });
        }
        let undo: Vec<_> = sorted.iter().map(|&id| (id, self.order(id))).collect();
        let gone: Vec<usize> = undo.iter().filter_map(|u| u.1).map(|order| order as usize).collect();
        let mut since = self.since.and_gone(gone.len(), self.points.len());
        let all = since.is_lift_due(self.points.len());
        let mut lattice = (self.grown.lattice(), self.grown.steps());
        if all {
            since = since.and_lifted();
            // Edges along the rim may be longer now, too.
            lattice = self.best_lattice(&self.points_without(&sorted).1);
        } else if since.is_look_due(self.points.len() - gone.len()) {
            since.seen = 0;
            if let Some(better) = self.better_lattice(&self.points_without(&sorted).1) {
                (lattice, since) = (better, since.and_laid(self.points.len()));
            }
        }
        if lattice == (self.grown.lattice(), self.grown.steps())
            && let Ok(step) = self.grown.exchange((&gone, all), (&[], &[]))
        {
            for id in sorted {
                self.points.set(id, None);
            }
            return Ok(self.done(step, undo, Vec::new(), since));
        }
        self.mesh_anew(lattice, self.grown.size.clone(), self.points_without(&sorted), (Vec::new(), since))
    }

    /// The points that are there but for some, ascending.
    fn points_without(&self, gone: &[PointId]) -> (Vec<PointId>, Vec<DVec2>) {
        self.points().filter(|(id, _)| gone.binary_search(id).is_err()).unzip()
    }

    fn order(&self, id: PointId) -> Option<u32> {
        self.points.get(id)
    }

    /// How long edges may be.
    pub fn size(&self) -> Option<&Size> {
        self.grown.size.as_deref()
    }

    /// Wants edges to be as short as a size says, or as long as the points allow.
    ///
    /// # Errors
    ///
    /// [`SessionError::Size`].
    ///
    /// # Complexity
    ///
    /// A look at every edge, and work in proportion to what changes. Where edges along
    /// the rim are too long, or need no longer be as short as a size before wanted them, the
    /// whole is meshed anew.
    pub fn set_size(&mut self, size: Option<Size>) -> Result<Outcome, SessionError> {
        let workers = self.workers.clone();
        workers.run(|| self.set_size_here(size))
    }

    fn set_size_here(&mut self, size: Option<Size>) -> Result<Outcome, SessionError> {
        if let Some(size) = &size {
            let (centre, radius) = self.domain();
            check_size(size, centre, radius)?;
            check_count(&self.grown.mesh().0, size)?;
        }
        let size = size.map(Arc::new);
        if self.grown.frees_rim(size.as_deref()) {
            return self.mesh_anew(
                self.coarsest(),
                size,
                self.all_points(),
                (Vec::new(), self.since.and_lifted()),
            );
        }
        let all = self.all_points();
        let was_short = self.grown.has_short_edge(&all.1);
        match self.grown.set_size(size.clone()) {
            Ok(step) => {
                if was_short || !self.grown.has_short_edge(&all.1) {
                    return Ok(self.done(step, Vec::new(), Vec::new(), self.since));
                }
                self.grown.take_back(step);
                let since = self.since.and_lifted();
                self.mesh_anew(self.best_lattice(&all.1), size, all, (Vec::new(), since))
            }
            Err(Stuck::Levels(_)) => Err(grown::too_fine().into()),
            Err(Stuck::Rim | Stuck::Unsettled) => {
                let anew = (self.grown.lattice(), self.grown.steps());
                self.mesh_anew(anew, size, self.all_points(), (Vec::new(), self.since.and_lifted()))
            }
        }
    }

    /// Cuts the longest edge wanted in a box to `2^-halvings` of the longest that is
    /// there, and leaves the rest as it is but for a transition.
    ///
    /// # Errors
    ///
    /// [`SessionError::Size`].
    pub fn refine_box(&mut self, a: DVec2, b: DVec2, halvings: u8) -> Result<Outcome, SessionError> {
        let (low, high) = (a.min(b), a.max(b));
        let longest = longest_edge_in(&self.grown.mesh().0, low, high);
        let size = (0..halvings).fold(longest, |size, _| 0.5 * size);
        let now = self.size().cloned().unwrap_or_else(Size::unlimited);
        self.set_size(Some(now.and_box(low, high, size)?))
    }

    /// Doubles the radius of the domain. The whole is meshed anew.
    ///
    /// # Errors
    ///
    /// [`SessionError`] if the larger domain cannot be meshed.
    pub fn grow(&mut self) -> Result<Outcome, SessionError> {
        let workers = self.workers.clone();
        workers.run(|| self.grow_here())
    }

    fn grow_here(&mut self) -> Result<Outcome, SessionError> {
        let all = self.all_points();
        let lattice = fitting(self.grown_domain(2.0 * self.domain().1)?, &all.1);
        self.mesh_anew(lattice, self.grown.size.clone(), all, (Vec::new(), self.since.and_lifted()))
    }

    /// The domain with another radius.
    fn grown_domain(&self, radius: f64) -> Result<(DVec2, f64), SessionError> {
        let centre = self.domain().0;
        let fits = centre.abs().max_element() + radius < MAX_COORDINATE;
        if fits { Ok((centre, radius)) } else { Err(SessionError::InvalidDomain { centre, radius }) }
    }

    /// Meshes all points anew in the same domain, on the lattice that suits them, which takes
    /// away what points that came and went have left.
    ///
    /// # Errors
    ///
    /// [`SessionError`] if that fails.
    ///
    /// # Complexity
    ///
    /// That of a mesh made at once.
    pub fn renew(&mut self) -> Result<Outcome, SessionError> {
        let workers = self.workers.clone();
        workers.run(|| self.renew_here())
    }

    fn renew_here(&mut self) -> Result<Outcome, SessionError> {
        let all = self.all_points();
        self.mesh_anew(
            self.best_lattice(&all.1),
            self.grown.size.clone(),
            all,
            (Vec::new(), self.since.and_lifted()),
        )
    }

    /// Takes the last call back that is not taken back yet; 256 are remembered,
    /// none across saving.
    ///
    /// # Errors
    ///
    /// [`SessionError::NothingToUndo`].
    ///
    /// # Complexity
    ///
    /// In proportion to what the call changed.
    pub fn undo(&mut self) -> Result<Outcome, SessionError> {
        let workers = self.workers.clone();
        workers.run(|| self.undo_here())
    }

    fn undo_here(&mut self) -> Result<Outcome, SessionError> {
        let undo = self.history.pop_back().ok_or(SessionError::NothingToUndo)?;
        let before = self.domain();
        let (delta, remeshed) = match undo.mesh {
            Before::Step(step) => {
                let replaced: Replaced = self.grown.take_back(*step);
                (self.grown.cells.delta(&replaced), false)
            }
            Before::Whole(mut old) => {
                // No number is used again.
                old.cells.serials = self.grown.cells.serials;
                let now = std::mem::replace(&mut self.grown, *old);
                (self.grown.cells.delta_from(&now.cells), true)
            }
        };
        for (id, order) in undo.points {
            self.points.set(id, order);
        }
        self.since = undo.since;
        Ok(Outcome { points: Vec::new(), delta, remeshed, domain: self.domain_after(before) })
    }

    /// Meshes points anew, those that are there and new ones.
    fn mesh_anew(
        &mut self,
        (lattice, steps): (Lattice, u32),
        size: Option<Arc<Size>>,
        (ids, points): (Vec<PointId>, Vec<DVec2>),
        (new, since): (Vec<PointId>, Since),
    ) -> Result<Outcome, SessionError> {
        let domain = self.domain();
        let grown = Grown::new(lattice, steps, (&ids, &points), (self.grown.cells.serials, size))?;
        let old = std::mem::replace(&mut self.grown, grown);
        let delta = self.grown.cells.delta_from(&old.cells);
        let mut orders = Orders::new(self.points.named());
        ids.iter().zip(0..).for_each(|(&id, order)| orders.set(id, Some(order)));
        let before = std::mem::replace(&mut self.points, orders);
        // What was there comes back, what is new goes.
        let old_points = before.iter().map(|(id, order)| (id, Some(order)));
        let points = new.iter().map(|&id| (id, None)).chain(old_points).collect();
        let since = std::mem::replace(&mut self.since, since);
        self.remember(Undo { mesh: Before::Whole(Box::new(old)), points, since });
        Ok(Outcome { points: new, delta, remeshed: true, domain: self.domain_after(domain) })
    }

    /// The domain, if it is another than before by more than rounding.
    fn domain_after(&self, before: (DVec2, f64)) -> Option<(DVec2, f64)> {
        let now = self.domain();
        ((now.1 - before.1).abs() > SAME_RADIUS * before.1).then_some(now)
    }

    /// Ends a call.
    fn done(
        &mut self,
        step: Step,
        undo: Vec<(PointId, Option<u32>)>,
        points: Vec<PointId>,
        since: Since,
    ) -> Outcome {
        let delta = self.grown.delta(&step);
        let since = std::mem::replace(&mut self.since, since);
        self.remember(Undo { mesh: Before::Step(Box::new(step)), points: undo, since });
        Outcome { points, delta, remeshed: false, domain: None }
    }

    fn remember(&mut self, undo: Undo) {
        if self.history.len() == UNDO {
            self.history.pop_front();
        }
        self.history.push_back(undo);
    }
}

/// Refuses sizes that coordinates do not resolve in a domain.
fn check_size(size: &Size, centre: DVec2, radius: f64) -> Result<(), SizeError> {
    size.check(finest_spacing(DVec2::splat(centre.abs().max_element() + radius)))
}

/// Length of the longest edge of triangles that may touch an axis-parallel box.
fn longest_edge_in(mesh: &TriMesh, low: DVec2, high: DVec2) -> f64 {
    let mut longest: f64 = 0.0;
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| mesh.vertices[v.index()]);
        if a.min(b).min(c).cmple(high).all() && a.max(b).max(c).cmpge(low).all() {
            longest = longest.max(a.distance(b)).max(b.distance(c)).max(c.distance(a));
        }
    }
    longest
}

/// Refuses points of which two coincide, or are closer than coordinates resolve;
/// the first of them is point `first`.
fn check_distinct(points: &[DVec2], first: u64) -> Result<(), SessionError> {
    let Some(pair) = closest_pair(points) else {
        return Ok(());
    };
    let (to, at) = (points[pair.a], points[pair.b]);
    if to == at {
        return Err(SessionError::Duplicate { at, of: PointId(first + pair.a as u64) });
    }
    let least = finest_spacing(at).max(finest_spacing(to)) * CONFLICT_REACH;
    let distance = pair.distance;
    if distance < least { Err(SessionError::TooClose { at, to, distance, least }) } else { Ok(()) }
}
