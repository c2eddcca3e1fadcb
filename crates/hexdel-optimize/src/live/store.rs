//! Vertices and triangles in slots, with a journal of every write.
//!
//! A slot that becomes free is used again; serial numbers are not. The journal
//! takes changes back in reverse, and what lies between two places of it is
//! the difference of the mesh then and now.

use std::sync::Arc;

use hexdel_geom::DVec2;

use crate::constraints::{Line, NOWHERE, POINT, in_wedge, line_between};
use crate::mesh::{Motion, NONE};

/// A vertex, or a free slot: then `serial` is 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vertex {
    pub(crate) at: DVec2,
    pub(crate) motion: Motion,
    /// Angle of the domain at the vertex, radians.
    pub(crate) sector: f64,
    /// A triangle at the vertex.
    pub(crate) anchor: u32,
    /// As in `Soup::failed`.
    pub(crate) failed: u8,
    /// The segment that the vertex lies on, `POINT` or `NOWHERE`.
    pub(crate) source: u32,
    pub(crate) serial: u64,
}

impl Vertex {
    pub(crate) const FREE: Self = Self {
        at: DVec2::ZERO,
        motion: Motion::Free,
        sector: 0.0,
        anchor: NONE,
        failed: 0,
        source: NOWHERE,
        serial: 0,
    };

    pub(crate) fn alive(&self) -> bool {
        self.serial != 0
    }
}

/// A triangle, or a free slot: then `serial` is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Triangle {
    /// Corners, counter-clockwise.
    pub(crate) v: [u32; 3],
    /// Across the side opposite each corner the neighbour, or `NONE`.
    pub(crate) n: [u32; 3],
    /// The sides on segments: bit `k` that opposite corner `k`. The same on both
    /// sides.
    pub(crate) bound: u8,
    pub(crate) serial: u64,
}

impl Triangle {
    pub(crate) const FREE: Self = Self { v: [NONE; 3], n: [NONE; 3], bound: 0, serial: 0 };

    pub(crate) fn alive(&self) -> bool {
        self.serial != 0
    }

    /// Which corner `v` is.
    pub(crate) fn corner(&self, v: u32) -> usize {
        (0..3).find(|&k| self.v[k] == v).expect("the vertex is a corner")
    }

    /// Whether the side opposite corner `k` is on a segment.
    pub(crate) fn is_bound(&self, k: usize) -> bool {
        self.bound >> k & 1 == 1
    }

    /// The ends of the side opposite corner `k`, with the triangle on the left.
    pub(crate) fn side(&self, k: usize) -> [u32; 2] {
        [self.v[(k + 1) % 3], self.v[(k + 2) % 3]]
    }
}

/// One write, as what undoes it.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Undo {
    Vertex(u32, Vertex),
    Triangle(u32, Triangle),
    /// A slot came into use; whether it was added at the end.
    VertexTaken(u32, bool),
    TriangleTaken(u32, bool),
    /// A slot was put on its list of free ones.
    VertexFreed,
    TriangleFreed,
}

/// The serial numbers given out last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Serials {
    pub(crate) vertex: u64,
    pub(crate) triangle: u64,
}

/// The slots.
#[derive(Clone, Debug, Default)]
pub(crate) struct Store {
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) triangles: Vec<Triangle>,
    /// Exactly the free slots, in the order of becoming free.
    pub(crate) free_vertices: Vec<u32>,
    pub(crate) free_triangles: Vec<u32>,
    pub(crate) serials: Serials,
    /// Whether there are segments or points that bounds depend on.
    pub(crate) constrained: bool,
    /// What [`Motion::On`] refers to.
    pub(crate) lines: Arc<[Line]>,
    /// Writes since it was last emptied, oldest first.
    journal: Vec<Undo>,
}

impl Serials {
    /// The later ones of both.
    pub(crate) fn max(self, other: Self) -> Self {
        Self { vertex: self.vertex.max(other.vertex), triangle: self.triangle.max(other.triangle) }
    }
}

impl Store {
    /// Gives all that is there new serial numbers, after `last`.
    pub(crate) fn renumber(&mut self, last: Serials) {
        self.serials = last;
        for v in self.vertices.iter_mut().filter(|v| v.alive()) {
            self.serials.vertex += 1;
            v.serial = self.serials.vertex;
        }
        for t in self.triangles.iter_mut().filter(|t| t.alive()) {
            self.serials.triangle += 1;
            t.serial = self.serials.triangle;
        }
    }

    /// Slots with an empty journal; `free` holds those of vertices and those of
    /// triangles.
    pub(crate) fn of(
        vertices: Vec<Vertex>,
        triangles: Vec<Triangle>,
        free: [Vec<u32>; 2],
        serials: Serials,
    ) -> Self {
        let [free_vertices, free_triangles] = free;
        Self { vertices, triangles, free_vertices, free_triangles, serials, ..Self::default() }
    }

    pub(crate) fn vertex(&self, v: u32) -> &Vertex {
        &self.vertices[v as usize]
    }

    pub(crate) fn triangle(&self, t: u32) -> &Triangle {
        &self.triangles[t as usize]
    }

    pub(crate) fn at(&self, v: u32) -> DVec2 {
        self.vertices[v as usize].at
    }

    pub(crate) fn corners(&self, t: u32) -> [DVec2; 3] {
        self.triangle(t).v.map(|v| self.at(v))
    }

    /// Whether a vertex lies on a segment or counts as one.
    pub(crate) fn is_source(&self, v: u32) -> bool {
        self.vertex(v).source != NOWHERE
    }

    /// Whether a vertex is at most one edge away from a segment or a point that
    /// counts as one.
    pub(crate) fn is_near(&self, v: u32) -> bool {
        let mut near = self.constrained && self.is_source(v);
        if self.constrained && !near {
            self.around(v, |t| near = near || self.triangle(t).v.iter().any(|&w| self.is_source(w)));
        }
        near
    }

    /// Whether all corners of a triangle lie on two segments without room
    /// between them.
    pub(crate) fn in_wedge(&self, t: u32) -> bool {
        let sources = self.triangle(t).v.map(|v| self.vertex(v).source);
        in_wedge(&self.lines, sources, self.corners(t))
    }

    /// The segment that the side opposite corner `k` of a triangle is part of.
    pub(crate) fn line_of_side(&self, t: u32, k: usize) -> Option<u32> {
        let tri = self.triangle(t);
        let [a, b] = tri.side(k);
        let sources = [a, b].map(|v| self.vertex(v).source);
        if tri.is_bound(k) { line_between(&self.lines, sources, [a, b].map(|v| self.at(v))) } else { None }
    }

    /// Whether a vertex is between the ends of a segment.
    pub(crate) fn line_of_vertex(&self, v: u32) -> Option<u32> {
        Some(self.vertex(v).source).filter(|&s| s < POINT)
    }

    /// Live slots.
    pub(crate) fn live_vertices(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.vertices.len() as u32).filter(|&v| self.vertex(v).alive())
    }

    /// Live slots.
    pub(crate) fn live_triangles(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.triangles.len() as u32).filter(|&t| self.triangle(t).alive())
    }

    /// How many vertices and triangles there are.
    pub(crate) fn counts(&self) -> [usize; 2] {
        [self.vertices.len() - self.free_vertices.len(), self.triangles.len() - self.free_triangles.len()]
    }

    /// Calls `f` with each triangle at `v`; counter-clockwise, on the rim from
    /// the first to the last.
    pub(crate) fn around(&self, v: u32, mut f: impl FnMut(u32)) {
        let first = self.vertex(v).anchor;
        let mut t = first;
        loop {
            let tri = self.triangle(t);
            let before = tri.n[(tri.corner(v) + 2) % 3];
            if before == NONE || before == first {
                break;
            }
            t = before;
        }
        let start = if self.rim_before(v, t) { t } else { first };
        t = start;
        loop {
            f(t);
            let tri = self.triangle(t);
            t = tri.n[(tri.corner(v) + 1) % 3];
            if t == NONE || t == start {
                break;
            }
        }
    }

    fn rim_before(&self, v: u32, t: u32) -> bool {
        let tri = self.triangle(t);
        tri.n[(tri.corner(v) + 2) % 3] == NONE
    }

    pub(crate) fn write_vertex(&mut self, v: u32, new: Vertex) {
        let old = std::mem::replace(&mut self.vertices[v as usize], new);
        if old != new {
            self.journal.push(Undo::Vertex(v, old));
        }
    }

    pub(crate) fn write_triangle(&mut self, t: u32, new: Triangle) {
        let old = std::mem::replace(&mut self.triangles[t as usize], new);
        if old != new {
            self.journal.push(Undo::Triangle(t, old));
        }
    }

    /// A slot with a new serial number.
    pub(crate) fn add_vertex(&mut self, new: Vertex) -> u32 {
        let slot = self.free_vertices.pop();
        let v = slot.unwrap_or(self.vertices.len() as u32);
        if slot.is_none() {
            self.vertices.push(Vertex::FREE);
        }
        self.journal.push(Undo::VertexTaken(v, slot.is_none()));
        self.serials.vertex += 1;
        self.write_vertex(v, Vertex { serial: self.serials.vertex, ..new });
        v
    }

    /// A slot with a new serial number, without neighbours.
    pub(crate) fn add_triangle(&mut self, v: [u32; 3], bound: u8) -> u32 {
        let slot = self.free_triangles.pop();
        let t = slot.unwrap_or(self.triangles.len() as u32);
        if slot.is_none() {
            self.triangles.push(Triangle::FREE);
        }
        self.journal.push(Undo::TriangleTaken(t, slot.is_none()));
        self.serials.triangle += 1;
        self.write_triangle(t, Triangle { v, n: [NONE; 3], bound, serial: self.serials.triangle });
        t
    }

    pub(crate) fn free_vertex(&mut self, v: u32) {
        self.write_vertex(v, Vertex::FREE);
        self.free_vertices.push(v);
        self.journal.push(Undo::VertexFreed);
    }

    pub(crate) fn free_triangle(&mut self, t: u32) {
        self.write_triangle(t, Triangle::FREE);
        self.free_triangles.push(t);
        self.journal.push(Undo::TriangleFreed);
    }

    /// The present place of the journal.
    pub(crate) fn mark(&self) -> usize {
        self.journal.len()
    }

    /// Writes since `mark`.
    pub(crate) fn since(&self, mark: usize) -> &[Undo] {
        &self.journal[mark..]
    }

    /// Takes back what was written since `mark`, but for serial numbers.
    pub(crate) fn rollback(&mut self, mark: usize) {
        let undone = self.journal.split_off(mark);
        self.play_back(&undone);
    }

    /// Empties the journal and returns what was in it.
    pub(crate) fn take_journal(&mut self) -> Vec<Undo> {
        std::mem::take(&mut self.journal)
    }

    /// Takes back the writes of a journal that was taken out: the last one not
    /// taken back yet.
    pub(crate) fn play_back(&mut self, journal: &[Undo]) {
        for undo in journal.iter().rev() {
            match *undo {
                Undo::Vertex(v, old) => self.vertices[v as usize] = old,
                Undo::Triangle(t, old) => self.triangles[t as usize] = old,
                Undo::VertexTaken(_, true) => drop(self.vertices.pop()),
                Undo::TriangleTaken(_, true) => drop(self.triangles.pop()),
                Undo::VertexTaken(v, false) => self.free_vertices.push(v),
                Undo::TriangleTaken(t, false) => self.free_triangles.push(t),
                Undo::VertexFreed => drop(self.free_vertices.pop()),
                Undo::TriangleFreed => drop(self.free_triangles.pop()),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vertex(x: f64) -> Vertex {
        Vertex { at: DVec2::new(x, 0.0), ..Vertex::FREE }
    }

    #[test]
    fn rollback_restores_slots_and_their_lists() {
        let mut store = Store::default();
        let a = store.add_vertex(vertex(1.0));
        let b = store.add_vertex(vertex(2.0));
        store.free_vertex(a);
        let (mark, before) = (store.mark(), store.clone());
        assert_eq!(store.add_vertex(vertex(3.0)), a);
        store.free_vertex(b);
        store.add_vertex(vertex(4.0));
        store.add_vertex(vertex(5.0));
        store.add_triangle([0, 1, 2], 0);
        store.rollback(mark);
        assert_eq!(store.vertices, before.vertices);
        assert_eq!(store.triangles, before.triangles);
        assert_eq!(store.free_vertices, before.free_vertices);
        assert_eq!(store.serials, Serials { vertex: 5, triangle: 1 });
    }
}
