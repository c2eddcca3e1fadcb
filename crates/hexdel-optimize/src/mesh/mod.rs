//! An editable triangle mesh with a journal: every change can be taken back.
//!
//! Triangles know their neighbours, vertices one of their triangles. Slots are
//! never reused while a mesh is edited; a round of work is short and the mesh
//! is compacted when it ends (`convert`). What keeps the topology a manifold
//! is in `ops`.

mod check;
mod convert;
mod ops;
mod place;
#[cfg(test)]
mod tests;

pub(crate) use convert::{Around, Soup, Vertices};
pub(crate) use place::opening;

use std::sync::Arc;

use hexdel_geom::DVec2;

use crate::angles::Measure;
use crate::constraints::{Line, NOWHERE, POINT};

/// No triangle, no vertex.
pub(crate) const NONE: u32 = u32::MAX;

/// A triangle: corners counter-clockwise, and across the side opposite each
/// corner the neighbour, or [`NONE`] on the rim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tri {
    pub(crate) v: [u32; 3],
    pub(crate) n: [u32; 3],
    /// The sides that must stay: bit `k` that opposite corner `k`. The same on
    /// both sides.
    pub(crate) bound: u8,
}

impl Tri {
    pub(crate) const DEAD: Self = Self { v: [NONE; 3], n: [NONE; 3], bound: 0 };

    pub(crate) fn alive(&self) -> bool {
        self.v[0] != NONE
    }

    /// Whether the side opposite corner `k` must stay.
    #[inline]
    pub(crate) fn is_bound(&self, k: usize) -> bool {
        self.bound >> k & 1 == 1
    }

    /// Which corner `v` is.
    #[inline]
    pub(crate) fn corner(&self, v: u32) -> usize {
        if self.v[0] == v {
            0
        } else if self.v[1] == v {
            1
        } else {
            debug_assert_eq!(self.v[2], v);
            2
        }
    }
}

/// How a vertex may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Motion {
    /// Not at all.
    Fixed,
    /// Not now: the vertex is shared with a part that others work on.
    Frozen,
    /// Along a unit vector.
    Along(DVec2),
    /// Along a segment, to the rounded points of it.
    On(u32),
    /// Anywhere.
    Free,
}

/// One change, as what it replaced.
#[derive(Clone, Copy, Debug)]
enum Change {
    Moved(u32, DVec2),
    Triangle(u32, Tri),
    Anchor(u32, u32),
    /// Motion and source.
    Kind(u32, Motion, u32),
    NewTriangle,
    NewVertex,
}

/// The mesh.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    /// Positions; finite.
    pub(crate) pos: Vec<DVec2>,
    /// As long as `pos`.
    pub(crate) motion: Vec<Motion>,
    /// Angle of the domain at each vertex, radians: a full turn inside, a
    /// half-turn on a side. As long as `pos`; never changes.
    pub(crate) sector: Vec<f64>,
    /// Dead or: corners alive and distinct, neighbours alive and mutual. The
    /// triangles at a vertex form one fan, except at frozen ones: a part may
    /// touch itself there.
    pub(crate) tri: Vec<Tri>,
    /// One live triangle at each live vertex, `NONE` for dead ones.
    anchor: Vec<u32>,
    /// Number of live triangles at each vertex, plus those of the vertex that
    /// lie outside of this mesh when it is a part of a larger one.
    degree: Vec<u32>,
    /// Whether there are segments, and `source` and `near` are in use.
    constrained: bool,
    /// The segment that each vertex lies on, `POINT` or `NOWHERE`.
    source: Vec<u32>,
    /// Of frozen vertices: whether they are near a source in the whole mesh.
    near: Vec<bool>,
    /// What [`Motion::On`] refers to.
    lines: Arc<[Line]>,
    /// Changes since the last commit, oldest first.
    journal: Vec<Change>,
    /// Storage of [`Mesh::replace`].
    scratch: ops::Scratch,
}

impl Mesh {
    /// Number of triangles at `v`.
    #[inline]
    pub(crate) fn degree(&self, v: u32) -> usize {
        self.degree[v as usize] as usize
    }

    pub(crate) fn alive(&self, v: u32) -> bool {
        self.anchor[v as usize] != NONE
    }

    /// Whether `v` may neither move nor go.
    pub(crate) fn is_fixed(&self, v: u32) -> bool {
        matches!(self.motion[v as usize], Motion::Fixed | Motion::Frozen)
    }

    #[inline]
    pub(crate) fn measure(&self, t: u32) -> Measure {
        let [a, b, c] = self.tri[t as usize].v.map(|v| self.pos[v as usize]);
        Measure::of(a, b, c)
    }

    /// Calls `f` with each triangle at `v` and the corner `v` is of it,
    /// counter-clockwise; on the rim, from the first to the last. Returns
    /// whether the triangles close around `v`.
    #[inline]
    pub(crate) fn around(&self, v: u32, mut f: impl FnMut(u32, usize)) -> bool {
        let first = self.anchor[v as usize];
        // A free vertex is inside, and needs no way back to the rim.
        let inside = matches!(self.motion[v as usize], Motion::Free);
        let (start, closed) = if inside { (first, true) } else { self.first_around(v, first) };
        let mut t = start;
        loop {
            let k = self.tri[t as usize].corner(v);
            f(t, k);
            t = self.tri[t as usize].n[(k + 1) % 3];
            if t == NONE || t == start {
                return closed && t != NONE;
            }
        }
    }

    /// The triangle at `v` from which on the others follow counter-clockwise: the first
    /// on the rim, or `t` if they close around `v`.
    #[inline]
    fn first_around(&self, v: u32, t: u32) -> (u32, bool) {
        let mut first = t;
        loop {
            let k = self.tri[first as usize].corner(v);
            let before = self.tri[first as usize].n[(k + 2) % 3];
            if before == NONE {
                return (first, false);
            }
            first = before;
            if first == t {
                return (t, true);
            }
        }
    }

    /// Whether an edge joins `a` and `b`, or may join them in another part.
    pub(crate) fn adjacent(&self, a: u32, b: u32) -> bool {
        // Only one fan of a frozen vertex can be walked; ask the other one.
        let (a, b) = if self.motion[a as usize] == Motion::Frozen { (b, a) } else { (a, b) };
        if self.motion[a as usize] == Motion::Frozen {
            return true;
        }
        let mut found = false;
        self.around(a, |t, _| found |= self.tri[t as usize].v.contains(&b));
        found
    }

    /// The triangle on the left of the side from `a` to `b`, or on its right
    /// where it has none on the left, and the corner opposite.
    pub(crate) fn side(&self, a: u32, b: u32) -> Option<(u32, usize)> {
        let (a, b) = if self.motion[a as usize] == Motion::Frozen { (b, a) } else { (a, b) };
        let mut found = None;
        self.around(a, |t, k| {
            let c = self.tri[t as usize].v;
            if c[(k + 1) % 3] == b {
                found = Some((t, (k + 2) % 3));
            } else if c[(k + 2) % 3] == b && found.is_none() {
                found = Some((t, (k + 1) % 3));
            }
        });
        found
    }

    /// Collects the triangles at `v` and the vertices around it, both
    /// counter-clockwise; returns whether the ring is closed.
    pub(crate) fn ring(&self, v: u32, tris: &mut Vec<u32>, ring: &mut Vec<u32>) -> bool {
        tris.clear();
        ring.clear();
        let mut last = NONE;
        let closed = self.around(v, |t, k| {
            let c = self.tri[t as usize].v;
            tris.push(t);
            ring.push(c[(k + 1) % 3]);
            last = c[(k + 2) % 3];
        });
        if !closed {
            ring.push(last);
        }
        closed
    }

    /// Length of the shortest edge at `v`.
    #[inline]
    pub(crate) fn shortest_edge(&self, v: u32) -> f64 {
        let p = self.pos[v as usize];
        let mut min = f64::INFINITY;
        self.around(v, |t, k| {
            let c = self.tri[t as usize].v;
            let d = |w: u32| (self.pos[w as usize] - p).length_squared();
            min = min.min(d(c[(k + 1) % 3])).min(d(c[(k + 2) % 3]));
        });
        min.sqrt()
    }

    #[inline]
    pub(crate) fn set_pos(&mut self, v: u32, p: DVec2) {
        self.journal.push(Change::Moved(v, self.pos[v as usize]));
        self.pos[v as usize] = p;
    }

    /// Makes a vertex a fixed one at `p`: of its segment, or a point that counts
    /// as one.
    pub(crate) fn fix(&mut self, v: u32, p: DVec2) {
        self.set_pos(v, p);
        let i = v as usize;
        let source = self.source.get(i).copied().unwrap_or(NOWHERE);
        self.journal.push(Change::Kind(v, self.motion[i], source));
        self.motion[i] = Motion::Fixed;
        if self.constrained && source == NOWHERE {
            self.source[i] = POINT;
        }
    }

    fn count(&mut self, t: Tri, up: bool) {
        if t.alive() {
            for v in t.v {
                let d = &mut self.degree[v as usize];
                *d = if up { *d + 1 } else { *d - 1 };
            }
        }
    }

    fn set_tri(&mut self, t: u32, new: Tri) {
        let old = self.tri[t as usize];
        self.journal.push(Change::Triangle(t, old));
        self.count(old, false);
        self.count(new, true);
        self.tri[t as usize] = new;
    }

    fn add_tri(&mut self) -> u32 {
        self.tri.push(Tri::DEAD);
        self.journal.push(Change::NewTriangle);
        (self.tri.len() - 1) as u32
    }

    fn set_anchor(&mut self, v: u32, t: u32) {
        let old = self.anchor[v as usize];
        if old != t {
            self.journal.push(Change::Anchor(v, old));
            self.anchor[v as usize] = t;
        }
    }

    /// A new vertex, in no triangle yet.
    pub(crate) fn add_vertex(&mut self, p: DVec2, motion: Motion, sector: f64) -> u32 {
        self.pos.push(p);
        self.motion.push(motion);
        self.sector.push(sector);
        self.anchor.push(NONE);
        self.degree.push(0);
        if self.constrained {
            self.source.push(if let Motion::On(line) = motion { line } else { NOWHERE });
            self.near.push(false);
        }
        self.journal.push(Change::NewVertex);
        (self.pos.len() - 1) as u32
    }

    /// Makes all changes so far final.
    pub(crate) fn commit(&mut self) {
        self.journal.clear();
    }

    /// Takes all changes since the last commit back.
    pub(crate) fn rollback(&mut self) {
        while let Some(change) = self.journal.pop() {
            match change {
                Change::Moved(v, p) => self.pos[v as usize] = p,
                Change::Anchor(v, t) => self.anchor[v as usize] = t,
                Change::Kind(v, motion, source) => {
                    self.motion[v as usize] = motion;
                    if self.constrained {
                        self.source[v as usize] = source;
                    }
                }
                Change::Triangle(t, old) => {
                    self.count(self.tri[t as usize], false);
                    self.count(old, true);
                    self.tri[t as usize] = old;
                }
                Change::NewTriangle => {
                    self.tri.pop();
                }
                Change::NewVertex => {
                    self.pos.pop();
                    self.motion.pop();
                    self.sector.pop();
                    self.anchor.pop();
                    self.degree.pop();
                    if self.constrained {
                        self.source.pop();
                        self.near.pop();
                    }
                }
            }
        }
    }

    /// Calls `f` with every live triangle written since the last commit.
    pub(crate) fn changed(&self, mut f: impl FnMut(u32)) {
        for c in &self.journal {
            if let Change::Triangle(t, _) = *c
                && self.tri[t as usize].alive()
            {
                f(t);
            }
        }
    }

    /// Calls `f` with the corners of every triangle that was written since the
    /// last commit, as it was before.
    pub(crate) fn overwritten(&self, mut f: impl FnMut([u32; 3])) {
        for c in &self.journal {
            if let Change::Triangle(_, old) = *c
                && old.alive()
            {
                f(old.v);
            }
        }
    }

    pub(crate) fn is_constrained(&self) -> bool {
        self.constrained
    }

    /// As of `source`; `NOWHERE` if there are no segments.
    pub(crate) fn source(&self, v: u32) -> u32 {
        self.source.get(v as usize).copied().unwrap_or(NOWHERE)
    }

    /// What vertices know of segments.
    pub(crate) fn surroundings(&self) -> Around {
        Around { source: self.source.clone(), near: self.near.clone(), lines: self.lines.clone() }
    }

    /// Whether vertex `v` lies on a segment or counts as one.
    pub(crate) fn is_on_source(&self, v: u32) -> bool {
        self.source[v as usize] != NOWHERE
    }

    /// The segment of a vertex that slides along one.
    pub(crate) fn line(&self, v: u32) -> Option<&Line> {
        match self.motion[v as usize] {
            Motion::On(line) => Some(&self.lines[line as usize]),
            _ => None,
        }
    }

    /// Ids of the live triangles, ascending.
    pub(crate) fn live(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.tri.len() as u32).filter(|&t| self.tri[t as usize].alive())
    }
}
