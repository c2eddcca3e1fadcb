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
//! | `thin` | removal of what has become superfluous |
//! | `verify` | what has changed, held against the certificate |
//!
//! Points, undo and files are left to the session in the crate `hexdel`.

mod cut;
mod insert;
mod locate;
mod refine;
mod store;
mod thin;
mod verify;

use hexdel_geom::{AngleBounds, DVec2, TriMesh, VertexId};
use thiserror::Error;

use crate::constraints::Rules;
use crate::error::OptimizeError;
use crate::import::import;
use crate::mesh::Motion;
use crate::options::VertexKind;
use crate::refill::Refills;
use cut::{Cut, rings};
use insert::Tools;
use locate::Memory;
use store::{Serials, Store, Undo, Vertex};
use verify::Written;

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
        /// The point.
        at: DVec2,
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
#[derive(Clone, Debug, Default, PartialEq)]
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
#[derive(Debug)]
pub struct LiveMesh {
    store: Store,
    memory: Memory,
    tools: Tools,
    bounds: AngleBounds,
}

/// Rings of triangles around a change that are cut out with it: four of them
/// move, the last one stays.
const RINGS: usize = 5;

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
        let tools = Tools { rules: Rules::new(bounds, None), refills: Refills::new() };
        Self { memory: Memory::new(&store), store, tools, bounds }
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
            return Err(LiveError::Occupied { at: p });
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
            if verify::settle_changes(&mut self.store, mark, self.bounds) {
                return Some(v);
            }
        }
        self.reset(before, serials);
        None
    }

    /// Gives a fixed vertex free, and removes what has become superfluous
    /// around it, most of the time with the vertex itself.
    ///
    /// # Panics
    ///
    /// If there is no vertex in the slot.
    pub fn release(&mut self, slot: u32) {
        let old = *self.store.vertex(slot);
        assert!(old.alive(), "no vertex in slot {slot}");
        self.store.write_vertex(slot, Vertex { motion: Motion::Free, failed: 0, ..old });
        let (mark, serials) = (self.store.mark(), self.store.serials);
        thin::thin(&mut self.store, &self.tools, slot, old.at);
        if !verify::settle_changes(&mut self.store, mark, self.bounds) {
            self.reset(mark, serials);
        }
    }

    /// What was done since the last step, as one step.
    pub fn take_step(&mut self) -> (Step, Delta) {
        let delta = self.delta();
        (Step(self.store.take_journal()), delta)
    }

    /// Takes back what was done since the last step. Serial numbers given out
    /// since are not given out again.
    pub fn abandon(&mut self) {
        self.store.rollback(0);
    }

    /// Takes back the last step that is not taken back yet.
    pub fn undo(&mut self, step: &Step) {
        self.store.play_back(&step.0);
    }

    fn delta(&self) -> Delta {
        let written = Written::of(self.store.since(0));
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
        delta.vertices_removed.sort_unstable();
        delta.vertices_added.sort_unstable_by_key(|v| v.0);
        delta.vertices_moved.sort_unstable_by_key(|v| v.0);
        delta.triangles_removed.sort_unstable();
        delta.triangles_added.sort_unstable_by_key(|t| t.0);
        delta
    }
}
