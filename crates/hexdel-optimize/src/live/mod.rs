//! A mesh that stays within its bounds while fixed vertices come and go.
//!
//! Each change cuts a few rings of triangles out of the mesh, works on them
//! with the optimiser, puts back what changed and checks it. Nothing is done
//! to the rest. What a change costs is in proportion to what it touches.
//!
//! | module | what |
//! |---|---|
//! | `store` | slots, serial numbers, the journal |
//! | `locate` | the triangle that holds a point |
//! | `cut` | parts cut out and put back |
//! | `insert` | a new fixed vertex |
//! | `refine` | triangles cut in four |
//! | `size` | edges made as short as wanted |
//! | `save` | the state as data |
//! | `thin` | removal of what has become superfluous |
//! | `verify` | what has changed, held against the certificate |
//!
//! Points, undo and files are left to the session in the crate `hexdel`.

mod cut;
mod insert;
mod locate;
mod refine;
mod save;
mod size;
mod store;
mod thin;
mod verify;

use hexdel_geom::{AngleBounds, DVec2, TriMesh, VertexId};
use serde::Serialize;
use thiserror::Error;

use crate::constraints::Rules;
use crate::error::OptimizeError;
use crate::import::import;
use crate::mesh::{Motion, NONE};
use crate::options::VertexKind;
use crate::refill::Refills;
use cut::{Cut, rings};
use insert::Tools;
use locate::Memory;
use store::{Serials, Store, Undo, Vertex};
use verify::Written;

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

/// What a change did to the mesh, by serial numbers, which are never used
/// again. Ascending.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Delta {
    /// Vertices that are gone.
    pub vertices_removed: Vec<u64>,
    /// New vertices and their positions.
    pub vertices_added: Vec<(u64, DVec2)>,
    /// Vertices that are elsewhere now.
    pub vertices_moved: Vec<(u64, DVec2)>,
    /// Triangles that are gone.
    pub triangles_removed: Vec<u64>,
    /// New triangles and their corners, counter-clockwise.
    pub triangles_added: Vec<(u64, [u64; 3])>,
}

/// The writes of one change, to take it back.
#[derive(Clone, Debug)]
pub struct Step(Vec<Undo>);

/// A mesh of serial numbers, for those who keep a copy.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Snapshot {
    /// The mesh.
    pub mesh: TriMesh,
    /// The serial number of each vertex.
    pub vertex_serials: Vec<u64>,
    /// The slot of each vertex.
    pub vertex_slots: Vec<u32>,
    /// The serial number of each triangle.
    pub triangle_serials: Vec<u64>,
}

/// The mesh.
#[derive(Clone, Debug)]
pub struct LiveMesh {
    store: Store,
    memory: Memory,
    tools: Tools,
    bounds: AngleBounds,
    /// Serial numbers given out when the last step ended.
    issued: Serials,
    /// Whether the serial numbers have been in use by a mesh that this one
    /// replaced.
    adopted: bool,
}

/// Rings of triangles around a change that are cut out with it: four of them
/// move, the last one stays.
const RINGS: usize = 5;

/// Sine of the turn up to which a rim goes straight on, as for a whole outline.
const STRAIGHT: f64 = 1e-3;

/// Rings that are refined where a point finds no room, in the order of trying:
/// one is enough in nine of ten cases.
const INNER_RINGS: [usize; 4] = [1, 2, 0, 3];

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
        let soup = import(mesh, kinds, None)?;
        let mut store = Store::default();
        for i in 0..soup.pos.len() {
            let (at, motion, sector) = (soup.pos[i], soup.motion[i], soup.sector[i]);
            store.add_vertex(Vertex { at, motion, sector, anchor: crate::mesh::NONE, failed: 0, serial: 0 });
        }
        let all: Vec<u32> = soup.tris.iter().map(|&v| store.add_triangle(v)).collect();
        cut::link(&mut store, &all, &[]);
        store.take_journal();
        Ok(Self::of(store, bounds))
    }

    fn of(store: Store, bounds: AngleBounds) -> Self {
        let tools = Tools { rules: Rules::new(bounds, None), refills: Refills::new(), sizing: None };
        Self { memory: Memory::new(&store), issued: store.serials, store, tools, bounds, adopted: false }
    }

    /// Numbers of vertices and triangles.
    pub fn counts(&self) -> [usize; 2] {
        self.store.counts()
    }

    /// Where the vertex in a slot is.
    pub fn position(&self, slot: u32) -> DVec2 {
        self.store.at(slot)
    }

    /// The mesh as it stands, in the order of slots.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn snapshot(&self) -> Snapshot {
        let slots: Vec<u32> = self.store.live_vertices().collect();
        let mut name = vec![VertexId::new(0); self.store.vertices.len()];
        for (i, &v) in slots.iter().enumerate() {
            name[v as usize] = VertexId::new(i);
        }
        let live = || self.store.live_triangles().map(|t| self.store.triangle(t));
        Snapshot {
            mesh: TriMesh {
                vertices: slots.iter().map(|&v| self.store.at(v)).collect(),
                triangles: live().map(|t| t.v.map(|v| name[v as usize])).collect(),
            },
            vertex_serials: slots.iter().map(|&v| self.store.vertex(v).serial).collect(),
            triangle_serials: live().map(|t| t.serial).collect(),
            vertex_slots: slots,
        }
    }

    /// Puts a fixed vertex at `p` and returns its slot.
    ///
    /// # Errors
    ///
    /// [`LiveError`]; the mesh is then as it was.
    pub fn insert(&mut self, p: DVec2) -> Result<u32, LiveError> {
        let t = self.locate(p)?;
        let corner = self.store.triangle(t).v.into_iter().find(|&v| self.store.at(v) == p);
        if let Some(v) = corner {
            return self.pin(v, p);
        }
        let (mark, serials) = (self.store.mark(), self.store.serials);
        for _ in 0..MOST_REFINEMENTS {
            let t = self.locate(p)?;
            if let Some(v) = self.insert_at(t, p, mark, false) {
                return Ok(v);
            }
            if !INNER_RINGS.into_iter().any(|inner| self.refine_around(t, inner)) {
                break;
            }
        }
        self.reset(mark, serials);
        let t = self.locate(p)?;
        self.insert_at(t, p, mark, true).ok_or(LiveError::NoRoom { at: p })
    }

    /// The triangle that holds `p`.
    fn locate(&mut self, p: DVec2) -> Result<u32, LiveError> {
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
        self.store.write_vertex(v, Vertex { at: p, motion: Motion::Fixed, ..old });
        Ok(v)
    }

    /// Refines so many rings around triangle `t`; false, and nothing done, where
    /// what surrounds them cannot be brought inside the bounds.
    fn refine_around(&mut self, t: u32, inner: usize) -> bool {
        let inside = rings(&self.store, &[t], inner);
        let cut = Cut::new(&self.store, rings(&self.store, &inside, RINGS));
        let marks: Vec<bool> = cut.triangles.iter().map(|t| inside.binary_search(t).is_ok()).collect();
        match refine::refine(&cut, &self.tools, &marks) {
            Some(work) if cut.keeps_disk(&work.mesh) => {
                cut.put_back(&mut self.store, &work.mesh, &work.failed);
                true
            }
            _ => false,
        }
    }

    /// Makes room for `p` in triangle `t`; everything that changed since `mark`
    /// holds if that succeeds, and nothing is done if not.
    fn insert_at(&mut self, t: u32, p: DVec2, mark: usize, search: bool) -> Option<u32> {
        let (before, serials) = (self.store.mark(), self.store.serials);
        let cut = Cut::new(&self.store, rings(&self.store, &[t], RINGS));
        let (work, vertex) = insert::insert(&cut, &self.tools, cut.local_triangle(t)?, p, search)?;
        if cut.keeps_disk(&work.mesh) {
            let v = cut.put_back(&mut self.store, &work.mesh, &work.failed)[vertex as usize];
            thin::thin(&mut self.store, &self.tools, v, p);
            if self.shorten(mark, false).is_ok() && verify::settle_changes(&mut self.store, mark, self.bounds)
            {
                return Some(v);
            }
        }
        self.reset(before, serials);
        None
    }

    /// Gives a fixed vertex free, and removes what has become superfluous
    /// around it, most of the time with the vertex itself. A corner of the
    /// domain stays.
    ///
    /// # Panics
    ///
    /// If there is no vertex in the slot.
    pub fn release(&mut self, slot: u32) {
        let old = *self.store.vertex(slot);
        assert!(old.alive(), "no vertex in slot {slot}");
        let Some((motion, sector)) = self.freedom(slot) else {
            return;
        };
        self.store.write_vertex(slot, Vertex { motion, sector, failed: 0, ..old });
        let (mark, serials) = (self.store.mark(), self.store.serials);
        thin::thin(&mut self.store, &self.tools, slot, old.at);
        if !verify::settle_changes(&mut self.store, mark, self.bounds) {
            self.reset(mark, serials);
        }
    }

    /// What a vertex may do that is not fixed, and the angle of the domain
    /// there; none for a corner.
    fn freedom(&self, slot: u32) -> Option<(Motion, f64)> {
        let (mut first, mut last) = (NONE, NONE);
        self.store.around(slot, |t| {
            let tri = self.store.triangle(t);
            let k = tri.corner(slot);
            if tri.n[(k + 2) % 3] == NONE {
                first = tri.v[(k + 1) % 3];
            }
            if tri.n[(k + 1) % 3] == NONE {
                last = tri.v[(k + 2) % 3];
            }
        });
        if first == NONE {
            return Some((Motion::Free, std::f64::consts::TAU));
        }
        let along = (self.store.at(first) - self.store.at(last)).normalize_or_zero();
        let here = (self.store.at(first) - self.store.at(slot)).normalize_or_zero();
        let straight = along.perp_dot(here).abs() < STRAIGHT;
        straight.then_some((Motion::Along(along), std::f64::consts::PI))
    }

    /// The bounds that every angle keeps.
    pub fn bounds(&self) -> AngleBounds {
        self.bounds
    }

    /// Whether there is a fixed vertex in a slot.
    pub fn is_fixed(&self, slot: u32) -> bool {
        let vertex = self.store.vertices.get(slot as usize);
        vertex.is_some_and(|v| v.alive() && v.motion == Motion::Fixed)
    }

    /// The fixed vertex nearest to `p` and its distance, among those within two
    /// rings of triangles: if there is none, none is close.
    pub fn nearest_fixed(&mut self, p: DVec2) -> Option<(u32, f64)> {
        let t = self.locate(p).ok()?;
        let near = rings(&self.store, &[t], 2);
        let fixed = near.into_iter().flat_map(|t| self.store.triangle(t).v).filter(|&v| self.is_fixed(v));
        fixed
            .map(|v| (v, self.store.at(v).distance(p)))
            .min_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)))
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

    /// What was done since the last step, as one step.
    pub fn take_step(&mut self) -> (Step, Delta) {
        let delta = self.delta(&Written::of(self.store.since(0)));
        self.issued = self.store.serials;
        (Step(self.store.take_journal()), delta)
    }

    /// Takes back what was done since the last step.
    pub fn abandon(&mut self) {
        self.reset(0, self.issued);
    }

    /// Takes back the last step that is not taken back yet. Serial numbers
    /// given out since are not given out again.
    pub fn undo(&mut self, step: &Step) -> Delta {
        let written = Written::of(&step.0).now(&self.store);
        self.store.play_back(&step.0);
        self.delta(&written)
    }

    /// Puts another mesh in the place of this one, whose serial numbers go on
    /// from here but for what both have.
    pub fn replace_by(&mut self, mut other: Self) -> (Self, Delta) {
        let serials = self.store.serials;
        if !other.adopted {
            other.store.renumber(serials);
        }
        other.store.serials = other.store.serials.max(serials);
        other.issued = other.store.serials;
        other.adopted = true;
        let mut old = std::mem::replace(self, other);
        old.adopted = true;
        let delta = self.delta_from(&old);
        (old, delta)
    }

    /// The difference of all of another mesh and this one.
    fn delta_from(&self, old: &Self) -> Delta {
        let (was, is) = (old.snapshot(), self.snapshot());
        let corners = |t: [VertexId; 3]| t.map(|v| is.vertex_serials[v.index()]);
        let mut delta = Delta {
            vertices_removed: was.vertex_serials,
            vertices_added: is.vertex_serials.iter().copied().zip(is.mesh.vertices).collect(),
            triangles_removed: was.triangle_serials,
            triangles_added: is
                .triangle_serials
                .iter()
                .copied()
                .zip(is.mesh.triangles.iter().map(|t| corners(*t)))
                .collect(),
            ..Delta::default()
        };
        delta.sort();
        delta
    }

    /// The difference of what was in slots and what is.
    fn delta(&self, written: &Written) -> Delta {
        let mut delta = Delta::default();
        for &(v, serial, at) in &written.vertices {
            let now = self.store.vertices.get(v as usize).filter(|now| now.alive());
            match now {
                Some(now) if now.serial == serial && now.at == at => {}
                Some(now) if now.serial == serial => delta.vertices_moved.push((serial, now.at)),
                now => {
                    delta.vertices_added.extend(now.map(|now| (now.serial, now.at)));
                    delta.vertices_removed.extend((serial != 0).then_some(serial));
                }
            }
        }
        for &(t, serial, _) in &written.triangles {
            let now = self.store.triangles.get(t as usize).filter(|now| now.alive());
            if now.is_none_or(|now| now.serial != serial) {
                let corners = |now: &store::Triangle| now.v.map(|v| self.store.vertex(v).serial);
                delta.triangles_added.extend(now.map(|now| (now.serial, corners(now))));
                delta.triangles_removed.extend((serial != 0).then_some(serial));
            }
        }
        delta.sort();
        delta
    }
}

impl Delta {
    fn sort(&mut self) {
        self.vertices_removed.sort_unstable();
        self.vertices_added.sort_unstable_by_key(|v| v.0);
        self.vertices_moved.sort_unstable_by_key(|v| v.0);
        self.triangles_removed.sort_unstable();
        self.triangles_added.sort_unstable_by_key(|t| t.0);
    }
}
