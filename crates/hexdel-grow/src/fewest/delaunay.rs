//! Right angles on both sides of an edge: whether it is Delaunay is for rounding to say, and must be asked exactly.

use hexdel_geom::{incircle, orient2d};
use hexdel_optimize::edit::{EditMesh, NONE, next, prev};

use crate::limits::{Limits, Shape};
use crate::refiner::{self, Refiner};

/// Up to this cotangent an angle counts as a right one here, to either side.
const NEARLY: f64 = 1e-9;

/// Whether a triangle has an angle out of the bounds, or an edge that is not Delaunay between right angles. Between
/// smaller ones all edges are.
pub(super) fn is_bad(mesh: &EditMesh, limits: &Limits, t: u32) -> bool {
    refiner::is_bad(mesh, limits, t) || (3 * t..3 * t + 3).any(|c| is_spoilt(mesh, c))
}

/// Whether the edge opposite a corner is between right angles and not Delaunay, exactly.
fn is_spoilt(mesh: &EditMesh, c: u32) -> bool {
    let k = mesh.twin[c as usize];
    if k == NONE || mesh.is_marked(c) || !is_right(mesh, c) || !is_right(mesh, k) {
        return false;
    }
    let [a, b, d] = [c, next(c), prev(c)].map(|c| mesh.at(mesh.v(c)));
    incircle(a, b, d, mesh.at(mesh.v(k))) > 0.0
}

fn is_right(mesh: &EditMesh, c: u32) -> bool {
    let shape = Shape::of(mesh.corners(c / 3));
    shape.dots[c as usize % 3].abs() <= NEARLY * shape.cross
}

impl Refiner<'_> {
    /// Flips an edge of a triangle that is not Delaunay between right angles if the other diagonal is good.
    pub(super) fn flip_cocircular(&mut self, t: u32) -> bool {
        let Some(c) = (3 * t..3 * t + 3).find(|&c| is_spoilt(&self.mesh, c)) else { return false };
        let k = self.mesh.twin[c as usize];
        let [a, b, d, e] = [c, next(c), prev(c), k].map(|c| self.mesh.at(self.mesh.v(c)));
        let [b_v, d_v] = self.mesh.edge(c);
        if orient2d(a, b, e) <= 0.0 || orient2d(a, e, d) <= 0.0 {
            return false;
        }
        let flipped = self.mesh.flip(c);
        if flipped.iter().all(|&t| !is_bad(&self.mesh, &self.limits, t)) {
            return true;
        }
        // The same slots have the edge between the other two.
        let back = (3 * flipped[0]..3 * flipped[0] + 3).find(|&c| {
            let twin = self.mesh.twin[c as usize];
            twin != NONE && [self.mesh.v(c), self.mesh.v(twin)].iter().all(|v| [b_v, d_v].contains(v))
        });
        self.mesh.flip(back.expect("the edge that was flipped"));
        false
    }
}
