//! Small changes of topology, and taking an attempt back.

use hexdel_geom::DVec2;

use super::{EditMesh, Kind, NONE, next, prev};

/// A triangle as it was.
#[derive(Clone, Copy, Debug)]
struct Was {
    slot: u32,
    vertex: [u32; 3],
    twin: [u32; 3],
    mark: [u32; 3],
}

/// What an attempt changed, in order to take it back. One is made for many attempts.
///
/// It holds replaced triangles, moved vertices, and those that came or went, each list short.
#[derive(Clone, Debug, Default)]
pub struct Saved {
    triangles: Vec<Was>,
    /// Slots that the attempt took.
    made: Vec<u32>,
    /// Vertices and where they were.
    moved: Vec<(u32, DVec2)>,
    removed: Vec<(u32, Kind)>,
    added: Vec<u32>,
}

impl Saved {
    /// An attempt begins.
    pub fn clear(&mut self) {
        self.triangles.clear();
        self.made.clear();
        self.moved.clear();
        self.removed.clear();
        self.added.clear();
    }
}

/// An edge of the hole: its ends, the corner beyond, and its mark.
#[derive(Clone, Copy)]
struct Side {
    ends: [u32; 2],
    beyond: u32,
    mark: u32,
}

impl EditMesh {
    /// Puts triangles in the place of others that cover the same part of the plane. Slots are reused, the first for the
    /// first; `slots` are those of the new ones. Outline edges of the part keep their marks, edges inside it lose
    /// them. Neither positions nor vertices change; one that is left without a triangle is for the caller to remove.
    ///
    /// # Complexity
    ///
    /// Quadratic in the number of triangles, which is small.
    pub fn replace(
        &mut self,
        old: &[u32],
        new: &[[u32; 3]],
        slots: &mut Vec<u32>,
        saved: Option<&mut Saved>,
    ) {
        if let Some(saved) = saved {
            let record = |&t: &u32| self.record(t);
            saved.triangles.extend(old.iter().map(record));
            self.exchange(old, new, slots);
            saved.made.extend_from_slice(slots);
        } else {
            self.exchange(old, new, slots);
        }
    }

    fn exchange(&mut self, old: &[u32], new: &[[u32; 3]], slots: &mut Vec<u32>) {
        let sides = self.sides(old);
        for &t in old {
            self.vertex[3 * t as usize] = NONE;
        }
        slots.clear();
        for i in 0..new.len() {
            let slot = if i < old.len() { old[i] } else { self.add_slot() };
            slots.push(slot);
        }
        for &t in old.iter().skip(new.len()) {
            self.free_slot(t);
        }
        for (&t, v) in slots.iter().zip(new) {
            for (c, &v) in (3 * t..).zip(v) {
                self.vertex[c as usize] = v;
                self.twin[c as usize] = NONE;
                self.mark[c as usize] = 0;
                self.corner_of[v as usize] = c;
            }
            self.touch(t);
        }
        for (i, &t) in slots.iter().enumerate() {
            for c in 3 * t..3 * t + 3 {
                self.find_twin(c, &sides, &slots[i + 1..]);
            }
        }
    }

    /// Edges of triangles that have none of them beyond.
    fn sides(&self, old: &[u32]) -> Vec<Side> {
        let corners = old.iter().flat_map(|&t| 3 * t..3 * t + 3);
        let outer = corners.filter(|&c| {
            let twin = self.twin[c as usize];
            twin == NONE || !old.contains(&(twin / 3))
        });
        let side =
            |c: u32| Side { ends: self.edge(c), beyond: self.twin[c as usize], mark: self.mark[c as usize] };
        outer.map(side).collect()
    }

    /// The twin of a new corner: beyond the hole, or of a later new triangle.
    fn find_twin(&mut self, c: u32, sides: &[Side], later: &[u32]) {
        let [a, b] = self.edge(c);
        if let Some(side) = sides.iter().find(|s| s.ends == [a, b]) {
            self.mark[c as usize] = side.mark;
            self.pair(c, side.beyond);
            return;
        }
        let mut others = later.iter().flat_map(|&t| 3 * t..3 * t + 3);
        if let Some(d) = others.find(|&d| self.edge(d) == [b, a]) {
            self.pair(c, d);
        }
    }

    fn record(&self, t: u32) -> Was {
        let c = 3 * t as usize;
        let three = |of: &[u32]| [of[c], of[c + 1], of[c + 2]];
        Was { slot: t, vertex: three(&self.vertex), twin: three(&self.twin), mark: three(&self.mark) }
    }

    /// Moves a vertex, remembering where it was.
    pub fn try_move(&mut self, v: u32, p: DVec2, saved: &mut Saved) {
        saved.moved.push((v, self.at(v)));
        self.move_to(v, p);
    }

    /// A new vertex that goes again if the attempt is taken back.
    pub fn try_add_vertex(&mut self, p: DVec2, kind: Kind, saved: &mut Saved) -> u32 {
        let v = self.add_vertex(p, kind);
        saved.added.push(v);
        v
    }

    /// Removes a vertex without triangles until the attempt is taken back. Its slot is not reused
    /// within the attempt; [`keep`](Self::keep) frees it.
    pub fn try_remove_vertex(&mut self, v: u32, saved: &mut Saved) {
        saved.removed.push((v, self.kind[v as usize]));
        self.kind[v as usize] = Kind::Dead;
    }

    /// The attempt stands.
    pub fn keep(&mut self, saved: &mut Saved) {
        self.free_vertices.extend(saved.removed.iter().map(|&(v, _)| v));
        saved.clear();
    }

    /// Takes an attempt back: one [`replace`](Self::replace), or several of triangles that are not each other's, and
    /// moves and vertices in any number.
    pub fn take_back(&mut self, saved: &mut Saved) {
        // First, as long as the triangles are those that the moves have touched.
        for &(v, p) in saved.moved.iter().rev() {
            if self.kind[v as usize] == Kind::Dead {
                self.pos[v as usize] = p;
            } else {
                self.move_to(v, p);
            }
        }
        for &t in &saved.made {
            if !saved.triangles.iter().any(|was| was.slot == t) {
                self.free_slot(t);
            }
        }
        for was in &saved.triangles {
            if let Some(i) = self.free_triangles.iter().rposition(|&t| t == was.slot) {
                self.free_triangles.swap_remove(i);
            }
            let c = 3 * was.slot as usize;
            for i in 0..3 {
                self.vertex[c + i] = was.vertex[i];
                self.mark[c + i] = was.mark[i];
                self.pair((c + i) as u32, was.twin[i]);
                self.corner_of[was.vertex[i] as usize] = (c + i) as u32;
            }
            self.touch(was.slot);
        }
        for &(v, kind) in &saved.removed {
            self.kind[v as usize] = kind;
        }
        for &v in saved.added.iter().rev() {
            self.remove_vertex(v);
        }
        saved.clear();
    }

    /// Flips the edge opposite a corner, which two triangles have and no mark; their slots are theirs afterwards, too.
    ///
    /// ```text
    ///        d                 d
    ///      / | \             /   \
    ///     a  |  e    ->     a --- e
    ///      \ | /             \   /
    ///        b                 b
    /// ```
    pub fn flip(&mut self, c: u32) -> [u32; 2] {
        let k = self.twin[c as usize];
        let (a, b, d, e) = (self.v(c), self.v(next(c)), self.v(prev(c)), self.v(k));
        let side = |m: &Self, c: u32| (m.twin[c as usize], m.mark[c as usize]);
        let (ab, da) = (side(self, prev(c)), side(self, next(c)));
        let (be, ed) = (side(self, next(k)), side(self, prev(k)));
        let (s, t) = (c / 3, k / 3);
        self.set(s, [a, b, e], [be, (3 * t + 2, 0), ab]);
        self.set(t, [a, e, d], [ed, da, (3 * s + 1, 0)]);
        [s, t]
    }

    /// Writes a triangle: its vertices, and the twin and mark opposite each.
    fn set(&mut self, t: u32, vertices: [u32; 3], sides: [(u32, u32); 3]) {
        for ((c, v), (twin, mark)) in (3 * t..).zip(vertices).zip(sides) {
            self.vertex[c as usize] = v;
            self.mark[c as usize] = mark;
            self.pair(c, twin);
            self.corner_of[v as usize] = c;
        }
        self.touch(t);
    }

    /// Kills triangles: beyond their edges there is outside then. A vertex left with several fans of triangles becomes
    /// one for each; the result are the new ones, each with the one that it was.
    pub fn carve(&mut self, doomed: &[bool]) -> Vec<[u32; 2]> {
        for t in (0..self.slots()).filter(|&t| doomed[t as usize]) {
            for c in 3 * t..3 * t + 3 {
                let twin = self.twin[c as usize];
                if twin != NONE {
                    self.twin[twin as usize] = NONE;
                }
            }
            self.free_slot(t);
        }
        self.corner_of.fill(NONE);
        for c in 0..self.vertex.len() as u32 {
            if self.alive(c / 3) {
                self.corner_of[self.vertex[c as usize] as usize] = c;
            }
        }
        for v in 0..self.pos.len() as u32 {
            if self.corner_of[v as usize] == NONE && self.kind[v as usize] != Kind::Dead {
                self.remove_vertex(v);
            }
        }
        self.split_fans()
    }

    fn split_fans(&mut self) -> Vec<[u32; 2]> {
        let mut seen = vec![false; self.vertex.len()];
        for v in (0..self.pos.len() as u32).filter(|&v| self.kind[v as usize] != Kind::Dead) {
            for c in self.star(v) {
                seen[c as usize] = true;
            }
        }
        let mut copies = Vec::new();
        for c in 0..self.vertex.len() as u32 {
            if seen[c as usize] || !self.alive(c / 3) {
                continue;
            }
            let v = self.v(c);
            // Slots of carved vertices are not for copies, so that numbers stay apart.
            self.pos.push(self.at(v));
            self.kind.push(self.kind[v as usize]);
            self.corner_of.push(c);
            let copy = self.pos.len() as u32 - 1;
            let fan: Vec<u32> = self.star(copy).collect();
            for d in fan {
                seen[d as usize] = true;
                self.vertex[d as usize] = copy;
            }
            copies.push([copy, v]);
        }
        copies
    }
}
