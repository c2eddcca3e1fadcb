//! The editable mesh: a corner table in struct-of-arrays form.
//!
//! Corner `c` belongs to triangle `c / 3` and stands for three things: the vertex there, the edge opposite it,
//! and the triangle beyond that edge. Triangles are counter-clockwise.
//!
//! ```text
//!            prev(c)
//!           /   |   \
//!          c    |   twin[c]
//!           \   |   /
//!            next(c)
//! ```
//!
//! | module | what |
//! |---|---|
//! | `build` | from and to [`TriMesh`](hexdel_geom::TriMesh), numbered along a curve |
//! | `curve` | the Hilbert curve |
//! | `change` | retriangulations, flips, and taking one attempt back |
//! | `cavity` | cavity polygons and their refill by a fan |
//! | `check` | the invariants |
//!
//! The mesh knows neither bounds nor goals. An attempt at a change is taken back with [`Saved`]; there is no
//! journal. Not part of the public interface of the project: it may change with any version.

mod build;
mod cavity;
mod change;
mod check;
pub mod curve;
#[cfg(test)]
mod tests;

use hexdel_geom::DVec2;

pub use build::Exported;
pub use cavity::{Cavity, MOST_EDGES, MOST_ENCLOSED};
pub use change::Saved;
pub use check::Broken;

pub use crate::random::Random;

/// No corner, no vertex, no triangle.
pub const NONE: u32 = u32::MAX;

/// Bit of a mark: the edge may be neither flipped away nor divided, and nothing is inserted across it.
pub const LOCKED: u32 = 1 << 31;

/// What a vertex may do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Kind {
    /// It stays: input points, corners of the domain.
    Fixed,
    /// It slides on the segment that its two marked edges are part of.
    OnSegment,
    /// It slides on a straight side of the domain.
    OnOutline,
    /// It is on a segment, and stays where it is; it may be removed.
    Held,
    /// It goes anywhere.
    Free,
    /// Its slot is empty.
    Dead,
}

impl Kind {
    /// Whether a vertex of this kind slides along marked edges.
    #[inline]
    pub fn slides(self) -> bool {
        matches!(self, Self::OnSegment | Self::OnOutline)
    }
}

/// The next corner of the same triangle, counter-clockwise.
#[inline]
pub fn next(c: u32) -> u32 {
    if c % 3 == 2 { c - 2 } else { c + 1 }
}

/// The previous corner of the same triangle.
#[inline]
pub fn prev(c: u32) -> u32 {
    if c.is_multiple_of(3) { c + 2 } else { c - 1 }
}

/// A triangle mesh that can be changed in place.
#[derive(Clone, Debug, Default)]
pub struct EditMesh {
    /// Positions, by vertex. Those of dead vertices mean nothing.
    pub pos: Vec<DVec2>,
    /// By vertex.
    pub kind: Vec<Kind>,
    /// A corner at each vertex that has one; of dead ones anything.
    pub corner_of: Vec<u32>,
    /// The vertex of each corner, three a triangle; the first is [`NONE`] where the triangle is dead.
    pub vertex: Vec<u32>,
    /// The opposite corner across the edge opposite to each corner; [`NONE`] outside.
    pub twin: Vec<u32>,
    /// Of the edge opposite each corner: its segment and one, 0 for none, and [`LOCKED`]. The same on both sides.
    pub mark: Vec<u32>,
    /// By triangle: how often its slot or a corner's position was changed, so that queues can tell.
    pub stamp: Vec<u32>,
    /// Dead triangles.
    free_triangles: Vec<u32>,
    /// Dead vertices.
    free_vertices: Vec<u32>,
}

impl EditMesh {
    /// How many slots for triangles there are; dead ones count.
    #[inline]
    pub fn slots(&self) -> u32 {
        self.stamp.len() as u32
    }

    /// How many triangles are alive.
    pub fn triangle_count(&self) -> usize {
        self.stamp.len() - self.free_triangles.len()
    }

    /// How many vertices are alive.
    pub fn vertex_count(&self) -> usize {
        self.pos.len() - self.free_vertices.len()
    }

    /// Whether a triangle is alive.
    #[inline]
    pub fn alive(&self, t: u32) -> bool {
        self.vertex[3 * t as usize] != NONE
    }

    /// The triangles that are alive, in order.
    pub fn triangles(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.slots()).filter(|&t| self.alive(t))
    }

    /// Where a vertex is.
    #[inline]
    pub fn at(&self, v: u32) -> DVec2 {
        self.pos[v as usize]
    }

    /// The vertex of a corner.
    #[inline]
    pub fn v(&self, c: u32) -> u32 {
        self.vertex[c as usize]
    }

    /// The vertices of a triangle.
    #[inline]
    pub fn vertices(&self, t: u32) -> [u32; 3] {
        let c = 3 * t as usize;
        [self.vertex[c], self.vertex[c + 1], self.vertex[c + 2]]
    }

    /// Where the corners of a triangle are.
    #[inline]
    pub fn corners(&self, t: u32) -> [DVec2; 3] {
        self.vertices(t).map(|v| self.at(v))
    }

    /// The ends of the edge opposite a corner, counter-clockwise.
    #[inline]
    pub fn edge(&self, c: u32) -> [u32; 2] {
        [self.v(next(c)), self.v(prev(c))]
    }

    /// Whether the edge opposite a corner is part of a segment or locked.
    #[inline]
    pub fn is_marked(&self, c: u32) -> bool {
        self.mark[c as usize] != 0
    }

    /// Whether the edge opposite a corner is locked.
    #[inline]
    pub fn is_locked(&self, c: u32) -> bool {
        self.mark[c as usize] & LOCKED != 0
    }

    /// The segment that the edge opposite a corner is part of.
    #[inline]
    pub fn segment(&self, c: u32) -> Option<u32> {
        (self.mark[c as usize] & !LOCKED).checked_sub(1)
    }

    /// Marks an edge, given by a corner opposite it, on both sides.
    pub fn set_mark(&mut self, c: u32, mark: u32) {
        self.mark[c as usize] = mark;
        let twin = self.twin[c as usize];
        if twin != NONE {
            self.mark[twin as usize] = mark;
        }
    }

    /// The corners at a vertex: counter-clockwise all around, or, at the outline, counter-clockwise to the one end and
    /// then clockwise to the other.
    #[inline]
    pub fn star(&self, v: u32) -> Star<'_> {
        let start = self.corner_of[v as usize];
        Star { mesh: self, start, at: start, back: false }
    }

    /// The vertices around a vertex, each once, in no order that matters; into `ring`, which is cleared.
    pub fn ring(&self, v: u32, ring: &mut Vec<u32>) {
        ring.clear();
        for c in self.star(v) {
            ring.push(self.v(next(c)));
            // The last one of an open star has no triangle of its own beyond.
            if self.twin[next(c) as usize] == NONE {
                ring.push(self.v(prev(c)));
            }
        }
    }

    /// The corner opposite the edge `a`-`b` in the triangle that has it in this direction.
    pub fn corner_opposite(&self, a: u32, b: u32) -> Option<u32> {
        self.star(a).find(|&c| self.v(next(c)) == b).map(prev)
    }

    /// Moves a vertex, and marks the triangles around it as changed.
    pub fn move_to(&mut self, v: u32, p: DVec2) {
        self.pos[v as usize] = p;
        let start = self.corner_of[v as usize];
        let mut star = Turn { start, at: start, back: false };
        while let Some(c) = star.step(&self.twin) {
            let stamp = &mut self.stamp[c as usize / 3];
            *stamp = stamp.wrapping_add(1);
        }
    }

    /// A new vertex without triangles, in a dead one's slot if there is one.
    pub fn add_vertex(&mut self, p: DVec2, kind: Kind) -> u32 {
        if let Some(v) = self.free_vertices.pop() {
            (self.pos[v as usize], self.kind[v as usize], self.corner_of[v as usize]) = (p, kind, NONE);
            return v;
        }
        self.pos.push(p);
        self.kind.push(kind);
        self.corner_of.push(NONE);
        self.pos.len() as u32 - 1
    }

    /// Frees the slot of a vertex that no triangle has any more.
    pub fn remove_vertex(&mut self, v: u32) {
        self.kind[v as usize] = Kind::Dead;
        self.free_vertices.push(v);
    }

    /// A slot for a triangle, which counts as alive once it has vertices.
    fn add_slot(&mut self) -> u32 {
        if let Some(t) = self.free_triangles.pop() {
            return t;
        }
        self.vertex.extend([NONE; 3]);
        self.twin.extend([NONE; 3]);
        self.mark.extend([0; 3]);
        self.stamp.push(0);
        self.slots() - 1
    }

    fn free_slot(&mut self, t: u32) {
        self.vertex[3 * t as usize] = NONE;
        self.touch(t);
        self.free_triangles.push(t);
    }

    #[inline]
    fn touch(&mut self, t: u32) {
        let stamp = &mut self.stamp[t as usize];
        *stamp = stamp.wrapping_add(1);
    }

    /// Makes two corners opposite each other; the second may be [`NONE`].
    #[inline]
    fn pair(&mut self, c: u32, twin: u32) {
        self.twin[c as usize] = twin;
        if twin != NONE {
            self.twin[twin as usize] = c;
        }
    }
}

/// The corners at a vertex, see [`EditMesh::star`].
#[derive(Clone, Debug)]
pub struct Star<'a> {
    mesh: &'a EditMesh,
    start: u32,
    at: u32,
    back: bool,
}

impl Iterator for Star<'_> {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        let mut turn = Turn { start: self.start, at: self.at, back: self.back };
        let c = turn.step(&self.mesh.twin);
        (self.at, self.back) = (turn.at, turn.back);
        c
    }
}

/// A walk around a vertex that does not hold on to the mesh.
#[derive(Clone, Copy, Debug)]
struct Turn {
    start: u32,
    /// The corner that comes next.
    at: u32,
    /// Whether the walk met the outline and goes clockwise by now.
    back: bool,
}

impl Turn {
    #[inline]
    fn step(&mut self, twin: &[u32]) -> Option<u32> {
        let c = self.at;
        if c == NONE {
            return None;
        }
        if !self.back {
            let beyond = twin[next(c) as usize];
            if beyond != NONE {
                self.at = next(beyond);
                if self.at == self.start {
                    self.at = NONE;
                }
                return Some(c);
            }
            self.back = true;
            self.at = clockwise(self.start, twin);
            return Some(c);
        }
        self.at = clockwise(c, twin);
        Some(c)
    }
}

/// The corner clockwise after `c` at the same vertex.
#[inline]
fn clockwise(c: u32, twin: &[u32]) -> u32 {
    let beyond = twin[prev(c) as usize];
    if beyond == NONE { NONE } else { prev(beyond) }
}
