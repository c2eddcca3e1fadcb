//! What a live mesh answers: itself as a mesh, what a change did to it, and the
//! way back.

use hexdel_geom::{DVec2, TriMesh, VertexId};

use crate::live::LiveMesh;
use crate::live::store::{Triangle, Undo, Vertex};
use crate::live::verify::Written;
use crate::mesh::NONE;

/// What a change did to the mesh, by serial numbers, which are never used
/// again. Ascending.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
    /// The edges on segments, in a row along each.
    pub segment_edges: Vec<SegmentSide>,
}

/// An edge on a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct SegmentSide {
    /// Its ends, in the direction of the segment.
    pub ends: [VertexId; 2],
    /// The segment, as of [`Constraints::segments`](crate::Constraints::segments).
    pub segment: usize,
    /// Whether only one triangle has it.
    pub boundary: bool,
}

impl LiveMesh {
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
            segment_edges: self.segment_edges(&name),
            vertex_slots: slots,
        }
    }

    /// The sides on segments: each once, as a triangle and the corner opposite;
    /// ascending.
    pub(crate) fn bound_sides(&self) -> Vec<(u32, usize)> {
        let store = &self.store;
        let sides = |t: u32| {
            let tri = store.triangle(t);
            let first = move |k: &usize| tri.is_bound(*k) && (tri.n[*k] == NONE || tri.n[*k] > t);
            (0..3).filter(first).map(move |k| (t, k))
        };
        store.live_triangles().flat_map(sides).collect()
    }

    /// For each triangle, in the order of slots, the first of the parts named by a
    /// point each that it lies in: parts end at those segments that `divides` is true of.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh, and in each part.
    pub fn parts(&self, points: &[DVec2], divides: impl Fn(usize) -> bool) -> Vec<Option<u32>> {
        let store = &self.store;
        let mut part: Vec<Option<u32>> = vec![None; store.triangles.len()];
        for (i, &p) in points.iter().enumerate() {
            let mut queue: Vec<u32> = self.memory.find(store, p).into_iter().collect();
            while let Some(t) = queue.pop() {
                if part[t as usize].is_some() {
                    continue;
                }
                part[t as usize] = Some(i as u32);
                let tri = store.triangle(t);
                let is_open = |k: usize| {
                    !tri.is_bound(k) || store.line_of_side(t, k).is_some_and(|line| !divides(line as usize))
                };
                queue.extend((0..3).filter(|&k| tri.n[k] != NONE && is_open(k)).map(|k| tri.n[k]));
            }
        }
        store.live_triangles().map(|t| part[t as usize]).collect()
    }

    /// The edges on segments, in a row along each.
    fn segment_edges(&self, name: &[VertexId]) -> Vec<SegmentSide> {
        let store = &self.store;
        let mut all: Vec<(u32, f64, SegmentSide)> = Vec::new();
        for (t, k) in self.bound_sides() {
            let Some(segment) = store.line_of_side(t, k) else { continue };
            let line = &store.lines[segment as usize];
            let [a, b] = store.triangle(t).side(k);
            let [from, to] = [a, b].map(|v| (store.at(v) - line.ends[0]).dot(line.along));
            let ends = if from < to { [a, b] } else { [b, a] }.map(|v| name[v as usize]);
            let boundary = store.triangle(t).n[k] == NONE;
            all.push((segment, from.min(to), SegmentSide { ends, segment: segment as usize, boundary }));
        }
        all.sort_by(|x, y| x.0.cmp(&y.0).then(x.1.total_cmp(&y.1)));
        all.into_iter().map(|side| side.2).collect()
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
        other.draft(self.drafts);
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
        for &(v, Vertex { serial, at, .. }) in &written.vertices {
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
        for &(t, Triangle { serial, .. }) in &written.triangles {
            let now = self.store.triangles.get(t as usize).filter(|now| now.alive());
            if now.is_none_or(|now| now.serial != serial) {
                let corners = |now: &Triangle| now.v.map(|v| self.store.vertex(v).serial);
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
