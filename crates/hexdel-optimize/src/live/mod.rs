//! A mesh that stays within its bounds while fixed vertices come and go.
//!
//! Each change cuts a few rings of triangles out of the mesh, works on them
//! with the optimiser, puts back what changed and checks it. Nothing is done
//! to the rest. What a change costs is in proportion to what it touches.
//!
//! | module | what |
//! |---|---|
//! | `answer` | the mesh, what a change did to it, and the way back |
//! | `bloom` | triangles made room in |
//! | `store` | slots, serial numbers, the journal |
//! | `locate` | the triangle that holds a point |
//! | `cut` | parts cut out and put back |
//! | `insert` | a new fixed vertex |
//! | `coarsen` | many vertices taken out at once |
//! | `release` | a fixed vertex that becomes free |
//! | `refine` | triangles cut in four |
//! | `size` | edges made as short as wanted |
//! | `save` | the state as data |
//! | `thin` | removal of what has become superfluous |
//! | `verify` | what has changed, held against the certificate |
//!
//! Points, undo and files are left to the session in the crate `hexdel`.

mod answer;
mod bloom;
mod coarsen;
mod cut;
mod insert;
mod locate;
mod refine;
mod release;
mod save;
mod size;
mod store;
mod thin;
mod verify;

use hexdel_geom::{AngleBounds, DVec2, TriMesh, keeps_bounds_at};
use thiserror::Error;

use crate::constraints::{Constraints, NOWHERE, POINT, Rules};
use crate::error::OptimizeError;
use crate::import::import;
use crate::mesh::Motion;
use crate::options::VertexKind;
use crate::refill::Refills;
use crate::work::Work;
use cut::{Cut, rings};
use insert::{ALLOWANCE, DRAFT_ALLOWANCE, Spot, Tools};
use locate::Memory;
use store::{Serials, Store, Vertex};
use verify::{Bounds, keeps_bounds_here};

pub use answer::{Delta, SegmentSide, Snapshot, Step};
pub use save::{LiveState, StateError};

/// Why a change of a [`LiveMesh`] was not made. The mesh is as it was.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LiveError {
    /// The point is not inside the mesh.
    #[error("({:?}, {:?}) lies outside of the mesh", at.x, at.y)]
    Outside {
        /// The point.
        at: DVec2,
    },
    /// There is a fixed vertex at the point already.
    #[error("there is a fixed vertex at ({:?}, {:?}) already", at.x, at.y)]
    Occupied {
        /// Its slot.
        slot: u32,
        /// The point.
        at: DVec2,
    },
    /// Edges at a place cannot be made as short as wanted within the bounds.
    #[error("edges at ({:?}, {:?}) cannot be made shorter than {length:e}", at.x, at.y)]
    Unsized {
        /// The middle of an edge that is too long.
        at: DVec2,
        /// Its length.
        length: f64,
    },
    /// Edges as short as wanted would take too many triangles.
    #[error("edges this short would take about {triangles:.1e} triangles")]
    TooMany {
        /// How many.
        triangles: f64,
    },
    /// No change nearby makes room for the point within the bounds.
    #[error("no change nearby makes room for ({:?}, {:?}) within the bounds", at.x, at.y)]
    NoRoom {
        /// The point.
        at: DVec2,
    },
}

/// The mesh.
#[derive(Clone, Debug)]
pub struct LiveMesh {
    store: Store,
    memory: Memory,
    tools: Tools,
    bounds: Bounds,
    /// Serial numbers given out when the last step ended.
    issued: Serials,
    /// Whether the serial numbers have been in use by a mesh that this one
    /// replaced.
    adopted: bool,
    /// Whether what becomes superfluous stays.
    drafts: bool,
    /// Triangles that sweeps went over to make room for the last point.
    visited: u64,
}

/// Rings of triangles around a change that are cut out with it: four of them
/// move, the last one stays.
const RINGS: usize = 5;

/// Rings whose triangles get a vertex in their middle where a point finds no room, before
/// any are cut in four.
const BLOOM_RINGS: [usize; 2] = [1, 2];

/// The same while another point is so close that edges have to become much shorter: with
/// one ring the next round would find no vertices to move around the last one's.
const CROWDED_RINGS: [usize; 2] = [3, 2];

/// Triangles that sweeps may go over to make room for one point, at most.
const MOST_VISITS: u64 = 16 * ALLOWANCE;

/// The same for each triangle of the mesh, and at least: the whole mesh is made anew for about as much.
const VISITS: u64 = 4000;
const LEAST_VISITS: u64 = ALLOWANCE / 5;

/// Refinements until a point of a draft finds room.
const MOST_DRAFT_REFINEMENTS: usize = 4;

/// Rings that are refined where a point finds no room, in the order of trying:
/// one is enough in nine of ten cases.
const INNER_RINGS: [usize; 4] = [1, 2, 0, 3];

/// A point that is this much closer to a fixed vertex than edges are long finds no room.
const CROWDED: f64 = 0.2;

/// A way to make the marked triangles of a part smaller and to repair what surrounds them; none where they
/// cannot be divided.
type Refine = for<'a> fn(&Cut, &'a Tools, &[bool]) -> Option<Work<'a>>;

/// Refinements until a point finds room. Each halves the edges around it; as
/// many as there are bits in a coordinate would be pointless.
const MOST_REFINEMENTS: usize = 48;

impl LiveMesh {
    /// Takes over a mesh that is within `bounds`, with a kind for each vertex.
    /// Vertices keep their indices as slots.
    ///
    /// # Errors
    ///
    /// An [`OptimizeError`] that names what is wrong with the mesh.
    pub fn new(mesh: TriMesh, kinds: &[VertexKind], bounds: AngleBounds) -> Result<Self, OptimizeError> {
        Self::taken(mesh, kinds, bounds, None)
    }

    /// The same with segments. Of the constraints `segments`, `edges`, `points`,
    /// `near` and `wedges` are kept to; every fixed vertex to come is one of
    /// `points`.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new), and where the constraints name what is not there.
    pub fn with_segments(
        mesh: TriMesh,
        kinds: &[VertexKind],
        bounds: AngleBounds,
        constraints: &Constraints<'_>,
    ) -> Result<Self, OptimizeError> {
        Self::taken(mesh, kinds, bounds, Some(constraints))
    }

    fn taken(
        mesh: TriMesh,
        kinds: &[VertexKind],
        far: AngleBounds,
        constraints: Option<&Constraints<'_>>,
    ) -> Result<Self, OptimizeError> {
        let soup = import(mesh, kinds, constraints)?;
        let mut store = Store::default();
        (store.constrained, store.lines) = (soup.is_constrained(), soup.lines.clone());
        for i in 0..soup.pos.len() {
            let (at, motion, sector) = (soup.pos[i], soup.motion[i], soup.sector[i]);
            let source = soup.source.get(i).copied().unwrap_or(NOWHERE);
            store.add_vertex(Vertex { at, motion, sector, source, ..Vertex::FREE });
        }
        let triangles = soup.tris.iter().zip(&soup.bound);
        let all: Vec<u32> = triangles.map(|(&v, &bound)| store.add_triangle(v, bound)).collect();
        cut::link(&mut store, &all, &[]);
        store.take_journal();
        let near = constraints.map_or(far, |c| c.near);
        Ok(Self::of(store, Bounds { near, far }))
    }

    fn of(store: Store, bounds: Bounds) -> Self {
        let constraints = Constraints { near: bounds.near, ..Constraints::default() };
        let rules = Rules::new(bounds.far, store.constrained.then_some(&constraints));
        let tools = Tools { rules, refills: Refills::new(), sizing: None, allowance: ALLOWANCE };
        Self {
            memory: Memory::new(&store),
            issued: store.serials,
            store,
            tools,
            bounds,
            adopted: false,
            drafts: false,
            visited: 0,
        }
    }

    /// Whether changes from now on are drafts: vertices that become superfluous stay, and a point
    /// for which room takes long to make is refused. The mesh is held to the same bounds.
    pub fn draft(&mut self, drafts: bool) {
        self.drafts = drafts;
        self.tools.allowance = if drafts { DRAFT_ALLOWANCE } else { ALLOWANCE };
    }

    /// Numbers of vertices and triangles.
    pub fn counts(&self) -> [usize; 2] {
        self.store.counts()
    }

    /// Where the vertex in a slot is.
    pub fn position(&self, slot: u32) -> DVec2 {
        self.store.at(slot)
    }

    /// Puts a fixed vertex at `p` and returns its slot.
    ///
    /// # Errors
    ///
    /// [`LiveError`]; the mesh is then as it was.
    pub fn insert(&mut self, p: DVec2) -> Result<u32, LiveError> {
        self.insert_within(p, if self.drafts { DRAFT_ALLOWANCE } else { MOST_VISITS })
    }

    /// The same, but the point is refused for want of room as soon as the search has taken about as much work as
    /// meshing the whole anew.
    ///
    /// # Errors
    ///
    /// As [`insert`](Self::insert).
    pub fn insert_soon(&mut self, p: DVec2) -> Result<u32, LiveError> {
        let [_, triangles] = self.counts();
        let whole = (VISITS * triangles as u64).clamp(LEAST_VISITS, MOST_VISITS);
        self.insert_within(p, if self.drafts { DRAFT_ALLOWANCE } else { whole })
    }

    /// Puts a fixed vertex at `p`, for which room is made in at most so many visits.
    fn insert_within(&mut self, p: DVec2, most: u64) -> Result<u32, LiveError> {
        let spot = self.locate(p)?;
        let corner = self.store.triangle(spot.triangle).v.into_iter().find(|&v| self.store.at(v) == p);
        if let Some(v) = corner {
            return self.pin(v, p);
        }
        let allowance = self.tools.allowance;
        self.tools.allowance = most.min(allowance);
        let slot = self.insert_new(p, most);
        self.tools.allowance = allowance;
        slot
    }

    /// Puts a fixed vertex where there is none.
    fn insert_new(&mut self, p: DVec2, most: u64) -> Result<u32, LiveError> {
        let (mark, serials) = (self.store.mark(), self.store.serials);
        let refinements = if self.drafts { MOST_DRAFT_REFINEMENTS } else { MOST_REFINEMENTS };
        self.visited = 0;
        for _ in 0..refinements {
            let spot = self.locate(p)?;
            let crowded = self.is_crowded(spot.triangle, p);
            if !crowded && let Some(v) = self.insert_at(spot, p, mark, false) {
                return Ok(v);
            }
            if !self.make_room(spot.triangle, crowded, most) {
                break;
            }
        }
        self.reset(mark, serials);
        if self.drafts {
            return Err(LiveError::NoRoom { at: p });
        }
        let spot = self.locate(p)?;
        self.insert_at(spot, p, mark, true).ok_or(LiveError::NoRoom { at: p })
    }

    /// Where `p` lies.
    fn locate(&mut self, p: DVec2) -> Result<Spot, LiveError> {
        if self.memory.is_outgrown(&self.store) {
            self.memory = Memory::new(&self.store);
        }
        self.memory.locate(&self.store, p).ok_or(LiveError::Outside { at: p })
    }

    fn reset(&mut self, mark: usize, serials: Serials) {
        self.store.rollback(mark);
        self.store.serials = serials;
    }

    /// Fixes a vertex that is where a point is to be.
    fn pin(&mut self, v: u32, p: DVec2) -> Result<u32, LiveError> {
        let old = *self.store.vertex(v);
        if old.motion == Motion::Fixed {
            return Err(LiveError::Occupied { slot: v, at: p });
        }
        let counts = self.store.constrained && old.source == NOWHERE;
        let source = if counts { POINT } else { old.source };
        self.store.write_vertex(v, Vertex { at: p, motion: Motion::Fixed, source, ..old });
        Ok(v)
    }

    /// Whether a fixed vertex is much closer to `p` than the triangle there is wide, so
    /// that no change of its neighbourhood makes room.
    fn is_crowded(&self, t: u32, p: DVec2) -> bool {
        let [a, b, c] = self.store.corners(t);
        let shortest = a.distance(b).min(b.distance(c)).min(c.distance(a));
        let near = rings(&self.store, &[t], 1);
        let mut fixed = near.into_iter().flat_map(|t| self.store.triangle(t).v).filter(|&v| self.is_fixed(v));
        fixed.any(|v| self.store.at(v).distance(p) < CROWDED * shortest)
    }

    /// Makes triangles smaller around triangle `t`; false, and nothing done, where
    /// what surrounds them is not brought inside the bounds within `most` visits of all rounds.
    fn make_room(&mut self, t: u32, crowded: bool, most: u64) -> bool {
        let blooms = if crowded { CROWDED_RINGS } else { BLOOM_RINGS };
        blooms.into_iter().any(|inner| {
            self.visited < most && self.work_inside(rings(&self.store, &[t], inner), bloom::refine)
        }) || INNER_RINGS.into_iter().any(|inner| self.visited < most && self.refine_around(t, inner))
    }

    /// Refines so many rings around triangle `t`; false, and nothing done, where
    /// what surrounds them cannot be brought inside the bounds.
    fn refine_around(&mut self, t: u32, inner: usize) -> bool {
        self.work_inside(rings(&self.store, &[t], inner), refine::refine)
    }

    /// Refines triangles, ascending, in a way that is given; false, and nothing done,
    /// where that fails.
    fn work_inside(&mut self, mut inside: Vec<u32>, refine: Refine) -> bool {
        let cut = Cut::new(&self.store, rings(&self.store, &inside, RINGS));
        inside.retain(|&t| !self.is_exempt(t));
        let marks: Vec<bool> = cut.triangles.iter().map(|t| inside.binary_search(t).is_ok()).collect();
        let Some(work) = refine(&cut, &self.tools, &marks) else {
            return false;
        };
        self.visited += work.visits();
        let holds = work.bad().is_empty() && cut.keeps_disk(&work.mesh);
        if holds {
            cut.put_back(&mut self.store, &work.mesh, &work.failed);
        }
        holds
    }

    /// Whether a triangle is within its bounds for no other reason than the angle
    /// between segments. Its quarters would not be.
    fn is_exempt(&self, t: u32) -> bool {
        self.store.constrained && !keeps_bounds_at(self.store.corners(t), self.bounds.near, [true; 3])
    }

    /// Makes room for `p` where it lies; everything that changed since `mark`
    /// holds if that succeeds, and nothing is done if not.
    fn insert_at(&mut self, spot: Spot, p: DVec2, mark: usize, search: bool) -> Option<u32> {
        let (before, serials) = (self.store.mark(), self.store.serials);
        let cut = Cut::new(&self.store, rings(&self.store, &[spot.triangle], RINGS));
        let there = Spot { triangle: cut.local_triangle(spot.triangle)?, ..spot };
        let (work, vertex) = insert::insert(&cut, &self.tools, there, p, search)?;
        if cut.keeps_disk(&work.mesh) {
            let v = cut.put_back(&mut self.store, &work.mesh, &work.failed)[vertex as usize];
            if !self.drafts {
                thin::thin(&mut self.store, &self.tools, v, p);
            }
            if self.shorten(mark, false).is_ok() && verify::settle_changes(&mut self.store, mark, self.bounds)
            {
                return Some(v);
            }
        }
        self.reset(before, serials);
        None
    }

    /// The bounds that every angle keeps, of triangles near segments and points
    /// of a PSLG and of all others.
    pub fn bounds(&self) -> [AngleBounds; 2] {
        [self.bounds.near, self.bounds.far]
    }

    /// The ends of each segment.
    pub fn segments(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        self.store.lines.iter().map(|line| line.ends)
    }

    /// Whether there are segments, or points that bounds depend on.
    pub fn is_constrained(&self) -> bool {
        self.store.constrained
    }

    /// The corners of the triangles that do not keep the bounds of their places, but
    /// for corners whose angle is that of segments.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn out_of_bounds(&self) -> Vec<[DVec2; 3]> {
        let bad = |t: &u32| !keeps_bounds_here(&self.store, self.bounds, *t);
        self.store.live_triangles().filter(bad).map(|t| self.store.corners(t)).collect()
    }

    /// Whether the vertex in a slot is where a segment ends.
    pub fn ends_segment(&self, slot: u32) -> bool {
        let mut bound = false;
        self.store.around(slot, |t| {
            let tri = self.store.triangle(t);
            let k = tri.corner(slot);
            bound |= tri.is_bound((k + 1) % 3) || tri.is_bound((k + 2) % 3);
        });
        bound && self.store.line_of_vertex(slot).is_none()
    }

    /// The segment that the vertex in a slot lies on between the ends, if any.
    pub fn line_of(&self, slot: u32) -> Option<usize> {
        self.store.line_of_vertex(slot).map(|line| line as usize)
    }

    /// The segment that `p` lies on up to rounding, if any.
    pub fn line_at(&self, p: DVec2) -> Option<usize> {
        self.memory.line_at(&self.store, p).map(|line| line as usize)
    }

    /// Whether there is a fixed vertex in a slot.
    pub fn is_fixed(&self, slot: u32) -> bool {
        let vertex = self.store.vertices.get(slot as usize);
        vertex.is_some_and(|v| v.alive() && v.motion == Motion::Fixed)
    }

    /// The fixed vertex nearest to `p` and its distance, among those within two
    /// rings of triangles: if there is none, none is close.
    pub fn nearest_fixed(&mut self, p: DVec2) -> Option<(u32, f64)> {
        let spot = self.locate(p).ok()?;
        let near = rings(&self.store, &[spot.triangle], 2);
        let fixed = near.into_iter().flat_map(|t| self.store.triangle(t).v).filter(|&v| self.is_fixed(v));
        fixed
            .map(|v| (v, self.store.at(v).distance(p)))
            .min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))
    }

    /// The point nearest to `p` of the segments within two rings of triangles, if
    /// `p` is not on one of them itself, and its distance.
    pub fn nearest_on_segment(&mut self, p: DVec2) -> Option<(DVec2, f64)> {
        let spot = self.locate(p).ok().filter(|spot| spot.side.is_none())?;
        let near = rings(&self.store, &[spot.triangle], 2);
        let sides = near.into_iter().flat_map(|t| (0..3).map(move |k| (t, k)));
        let lines = sides.filter_map(|(t, k)| self.store.line_of_side(t, k));
        lines
            .map(|line| self.store.lines[line as usize].nearest(p))
            .map(|q| (q, q.distance(p)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Length of the longest edge of triangles that may touch an axis-parallel
    /// box.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn longest_edge_in(&self, low: DVec2, high: DVec2) -> f64 {
        let mut longest: f64 = 0.0;
        for t in self.store.live_triangles() {
            let [a, b, c] = self.store.corners(t);
            let (from, to) = (a.min(b).min(c), a.max(b).max(c));
            if from.cmple(high).all() && to.cmpge(low).all() {
                longest = longest.max(a.distance(b)).max(b.distance(c)).max(c.distance(a));
            }
        }
        longest
    }
}
