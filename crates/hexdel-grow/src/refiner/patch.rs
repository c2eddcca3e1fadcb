//! Motion of a few vertices at once: projections of all corners of a patch.

use hexdel_geom::DVec2;
use hexdel_optimize::edit::{Kind, NONE, next, prev};

use super::Refiner;
use crate::limits::surely_turns_left;

/// Sweeps over all corners.
const SWEEPS: usize = 20;

/// A corner is pushed by this much of what takes it onto its bound, to first order.
const RELAXATION: f64 = 1.3;

/// Sweeps go on as long as five leave less than this much of the squared violations.
const PROGRESS: f64 = 0.6;

/// A gradient below this part of a corner's squared sides is none: nothing that may move moves the corner.
const LEAST: f64 = 1e-6;

/// What a vertex of a patch may do.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Moves {
    Not,
    Freely,
    /// Along this unit vector, on this segment.
    Along(DVec2, u32),
}

/// A triangle of a patch: places of its vertices in the patch, and its number.
#[derive(Clone, Copy, Debug)]
struct Tri {
    at: [u32; 3],
    t: u32,
    /// Corners without a lower bound, by bit.
    exempt: u8,
}

/// Buffers of a patch: movable vertices first.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    round: u32,
    /// By vertex of the mesh: the round it was met in, and its place.
    vertex: Vec<(u32, u32)>,
    /// By triangle of the mesh: the round it was met in.
    triangle: Vec<u32>,
    movable: Vec<u32>,
    pos: Vec<DVec2>,
    moves: Vec<Moves>,
    tris: Vec<Tri>,
}

impl Refiner<'_> {
    /// Moves the vertices of a triangle and those so many rings around it. Kept if fewer triangles are bad than before, or
    /// none in strict mode.
    pub(crate) fn move_patch(&mut self, t: u32, rings: usize) -> bool {
        let mut patch = std::mem::take(&mut self.scratch);
        let kept = self.gather(&mut patch, t, rings) && self.settle(&mut patch) && self.is_better(&patch);
        if kept {
            self.stats.patches += 1;
            for (&v, &p) in patch.movable.iter().zip(&patch.pos) {
                self.mesh.pos[v as usize] = p;
            }
            for tri in &patch.tris {
                let stamp = &mut self.mesh.stamp[tri.t as usize];
                *stamp = stamp.wrapping_add(1);
                self.push_if_bad(tri.t);
            }
        }
        self.scratch = patch;
        kept
    }

    /// Collects movable vertices and all triangles at them. False if there are none.
    fn gather(&self, patch: &mut Scratch, t: u32, rings: usize) -> bool {
        patch.begin(self.mesh.pos.len(), self.mesh.slots() as usize);
        let may_move = |v: u32| {
            let kind = self.mesh.kind[v as usize];
            kind == Kind::Free || kind.slides()
        };
        for v in self.mesh.vertices(t) {
            if may_move(v) {
                patch.join(v);
            }
        }
        let mut low = 0;
        for _ in 0..rings {
            let high = patch.movable.len();
            for k in low..high {
                for c in self.mesh.star(patch.movable[k]) {
                    for v in [self.mesh.v(next(c)), self.mesh.v(prev(c))] {
                        if may_move(v) {
                            patch.join(v);
                        }
                    }
                }
            }
            low = high;
        }
        for k in 0..patch.movable.len() {
            let v = patch.movable[k];
            patch.pos.push(self.mesh.at(v));
            patch.moves.push(self.moves_of(v));
        }
        for k in 0..patch.movable.len() {
            for c in self.mesh.star(patch.movable[k]) {
                self.add_triangle(patch, c / 3);
            }
        }
        !patch.movable.is_empty()
    }

    fn moves_of(&self, v: u32) -> Moves {
        if self.mesh.kind[v as usize] == Kind::Free {
            return Moves::Freely;
        }
        let mut sides = self.mesh.star(v).flat_map(|c| [next(c), prev(c)]);
        match sides.find_map(|c| self.mesh.segment(c)) {
            Some(segment) => {
                let [a, b] = self.segments[segment as usize];
                Moves::Along((b - a).normalize(), segment)
            }
            None => Moves::Not,
        }
    }

    fn add_triangle(&self, patch: &mut Scratch, t: u32) {
        if std::mem::replace(&mut patch.triangle[t as usize], patch.round) == patch.round {
            return;
        }
        let at = self.mesh.vertices(t).map(|v| patch.place_of(v, self.mesh.at(v)));
        let exempt = (0..3).filter(|&i| self.is_exempt(3 * t + i)).fold(0, |bits, i| bits | 1 << i);
        patch.tris.push(Tri { at, t, exempt });
    }

    /// Sweeps over the patch; vertices on segments end on them. False if it is of no use.
    fn settle(&self, patch: &mut Scratch) -> bool {
        let mut last = f64::MAX;
        for sweep in 0..SWEEPS {
            let violation = self.sweep_patch(patch);
            if violation == 0.0 {
                break;
            }
            if sweep % 5 == 4 {
                if violation > PROGRESS * last {
                    break;
                }
                last = violation;
            }
        }
        for k in 0..patch.movable.len() {
            if let Moves::Along(_, segment) = patch.moves[k] {
                patch.pos[k] = self.on_segment(segment, patch.pos[k]);
            }
        }
        patch.pos.iter().all(|p| p.is_finite())
    }

    /// Pushes all corners of the patch once; the sum of squared violations, as angles.
    fn sweep_patch(&self, patch: &mut Scratch) -> f64 {
        let Scratch { pos, moves, tris, .. } = patch;
        let mut violation = 0.0;
        for tri in tris.iter() {
            for i in 0..3 {
                let [o, p, q] = [i, (i + 1) % 3, (i + 2) % 3].map(|k| tri.at[k] as usize);
                let (u, w) = (pos[p] - pos[o], pos[q] - pos[o]);
                let Some(push) = self.limits.push(u.dot(w), u.perp_dot(w)) else { continue };
                if push.by_dot > 0.0 && tri.exempt >> i & 1 == 1 {
                    continue;
                }
                // Derivatives by the ends of the sides and by the corner.
                let by_p = push.by_dot * w - push.by_cross * w.perp();
                let by_q = push.by_dot * u + push.by_cross * u.perp();
                let allowed = |v: usize, by: DVec2| match moves[v] {
                    Moves::Not => DVec2::ZERO,
                    Moves::Freely => by,
                    Moves::Along(along, _) => along * along.dot(by),
                };
                let by = [allowed(o, -by_p - by_q), allowed(p, by_p), allowed(q, by_q)];
                let norm_sq: f64 = by.iter().map(|b| b.length_squared()).sum();
                let sides_sq = u.length_squared() + w.length_squared();
                if norm_sq <= LEAST * sides_sq {
                    violation += 1.0;
                    continue;
                }
                violation += push.g * push.g / (norm_sq * sides_sq);
                let factor = -RELAXATION * push.g / norm_sq;
                for (v, by) in [o, p, q].into_iter().zip(by) {
                    pos[v] += factor * by;
                }
            }
        }
        violation
    }

    fn is_better(&self, patch: &Scratch) -> bool {
        let before = patch.tris.iter().filter(|tri| self.is_bad(tri.t)).count();
        let most = if self.strict { 0 } else { before.saturating_sub(1) };
        let mut after = 0;
        for tri in &patch.tris {
            let [a, b, c] = tri.at.map(|k| patch.pos[k as usize]);
            if !surely_turns_left(b - a, c - a) {
                return false;
            }
            let shape = crate::limits::Shape::of([a, b, c]);
            let (high, low) = (self.limits.hi * shape.cross, self.limits.lo * shape.cross);
            let is_out = |i: usize| shape.dots[i] < high || shape.dots[i] > low && tri.exempt >> i & 1 == 0;
            after += usize::from((0..3).any(is_out));
            if after > most {
                return false;
            }
        }
        true
    }
}

impl Scratch {
    fn begin(&mut self, vertices: usize, triangles: usize) {
        self.round += 1;
        if self.vertex.len() < vertices {
            self.vertex.resize(vertices, (0, NONE));
        }
        if self.triangle.len() < triangles {
            self.triangle.resize(triangles, 0);
        }
        self.movable.clear();
        self.pos.clear();
        self.moves.clear();
        self.tris.clear();
    }

    /// Makes a vertex movable.
    fn join(&mut self, v: u32) {
        if self.vertex[v as usize].0 != self.round {
            self.vertex[v as usize] = (self.round, self.movable.len() as u32);
            self.movable.push(v);
        }
    }

    /// The place of a vertex in the patch, where it stays unless it is movable.
    fn place_of(&mut self, v: u32, at: DVec2) -> u32 {
        let entry = &mut self.vertex[v as usize];
        if entry.0 != self.round {
            *entry = (self.round, self.pos.len() as u32);
            self.pos.push(at);
            self.moves.push(Moves::Not);
        }
        entry.1
    }
}
