//! Taking Steiner points out.

use hexdel_geom::{DVec2, orient2d};
use hexdel_optimize::edit::Cavity;

use super::window::Window;
use super::{Search, is_steiner};
use crate::refiner::Refiner;

/// Steiner points removed in one step, at most.
const MOST_REMOVED: usize = 5;

/// Flips after a removal, at most: four points nearly on a circle may not be flipped to and fro.
const MOST_FLIPS: usize = 200;

impl Search<'_> {
    /// Removes the Steiner points nearest to the centre; how many went.
    pub(super) fn ruin(&mut self, window: &Window) -> usize {
        let count = 1 + self.random.below(MOST_REMOVED);
        let mesh = &self.refiner.mesh;
        let mut near: Vec<(f64, u32)> = (0..mesh.pos.len() as u32)
            .filter(|&v| is_steiner(mesh.kind[v as usize]))
            .map(|v| (mesh.at(v).distance_squared(window.centre), v))
            .collect();
        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.truncate(count);
        near.into_iter().filter(|&(_, v)| self.refiner.remove(v)).count()
    }
}

impl Refiner<'_> {
    /// Removes a vertex that is free or on a segment, and flips what is not Delaunay then. False if its place cannot be
    /// triangulated.
    fn remove(&mut self, v: u32) -> bool {
        let mut old = Vec::new();
        let mut new = Vec::new();
        let mut take = |mesh: &Self, cavity: &Cavity| {
            old.extend_from_slice(cavity.triangles());
            mesh.cut_ears(cavity.ring(), &mut new)
        };
        let mut merged = None;
        if self.mesh.kind[v as usize].slides() {
            let Some([left, right]) = self.mesh.cavities_beside(v) else { return false };
            if !take(self, &left) || !right.is_empty() && !take(self, &right) {
                return false;
            }
            merged = Some(([left.ring()[0], left.ring()[1]], self.mesh.mark[left.inner(0) as usize]));
        } else {
            let Some(star) = self.mesh.cavity_around(v) else { return false };
            if !take(self, &star) {
                return false;
            }
        }
        let mut slots = std::mem::take(&mut self.slots);
        self.mesh.replace(&old, &new, &mut slots, None);
        self.mesh.remove_vertex(v);
        if let Some((edge, mark)) = merged {
            let corners = slots.iter().flat_map(|&t| 3 * t..3 * t + 3);
            let c = corners.clone().find(|&c| self.mesh.edge(c) == edge).expect("an edge of the left side");
            self.mesh.set_mark(c, mark);
        }
        self.make_delaunay(&slots);
        self.slots = slots;
        true
    }

    fn make_delaunay(&mut self, slots: &[u32]) {
        let mut stack = slots.to_vec();
        let mut flips = 0;
        while let Some(t) = stack.pop() {
            if flips < MOST_FLIPS
                && let Some(c) = (3 * t..3 * t + 3).find(|&c| self.may_flip(c))
            {
                stack.extend(self.mesh.flip(c));
                flips += 1;
            }
        }
    }

    /// Triangulates a polygon, cutting off the best shaped ear again and again; false if there is none at some time.
    fn cut_ears(&self, ring: &[u32], out: &mut Vec<[u32; 3]>) -> bool {
        let mut ring = ring.to_vec();
        while ring.len() >= 3 {
            let n = ring.len();
            let at = |i: usize| [ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]];
            let ears = (0..n).filter_map(|i| Some((self.flatness_of_ear(&ring, at(i))?, i)));
            let Some((_, i)) = ears.min_by(|a, b| a.0.total_cmp(&b.0)) else { return false };
            out.push(at(i));
            if n == 3 {
                return true;
            }
            ring.remove(i);
        }
        false
    }

    /// Squared sides over the area, if a triangle of a polygon's neighbouring vertices is an ear.
    fn flatness_of_ear(&self, ring: &[u32], ear: [u32; 3]) -> Option<f64> {
        let [p, q, r] = ear.map(|v| self.mesh.at(v));
        let is_inside =
            |x: DVec2| orient2d(p, q, x) >= 0.0 && orient2d(q, r, x) >= 0.0 && orient2d(r, p, x) >= 0.0;
        let is_ear =
            orient2d(p, q, r) > 0.0 && !ring.iter().any(|v| !ear.contains(v) && is_inside(self.mesh.at(*v)));
        let sides = p.distance_squared(q) + q.distance_squared(r) + r.distance_squared(p);
        is_ear.then(|| sides / (q - p).perp_dot(r - p))
    }
}
