//! Where a triangle lies with respect to the segments of the mesh, and how
//! much room a vertex has between them.

use hexdel_geom::DVec2;
use hexdel_geom::predicates::locally_delaunay;

use super::{Mesh, Motion, NONE};
use crate::angles::Place;
use crate::constraints::in_wedge;

impl Mesh {
    /// Whether `v` is at most one edge away from a segment or a fixed point
    /// that counts as one.
    pub(crate) fn is_near(&self, v: u32) -> bool {
        if !self.constrained {
            return false;
        }
        match self.motion[v as usize] {
            // Other parts keep what makes it so.
            Motion::Frozen => self.near[v as usize],
            _ => self.is_on_source(v) || self.touches_source(v),
        }
    }

    /// Whether an edge joins `v` to a segment or point.
    pub(crate) fn touches_source(&self, v: u32) -> bool {
        let mut found = false;
        self.around(v, |t, _| found = found || self.tri[t as usize].v.iter().any(|&w| self.is_source(w, v)));
        found
    }

    fn is_source(&self, w: u32, not: u32) -> bool {
        w != not && self.is_on_source(w)
    }

    /// Where triangle `t` lies.
    #[inline]
    pub(crate) fn place(&self, t: u32) -> Place {
        if !self.constrained {
            return Place::default();
        }
        let tri = self.tri[t as usize];
        if self.in_wedge(tri.v) {
            return Place::in_wedge();
        }
        Place::new(tri.v.iter().any(|&v| self.is_near(v)), tri.bound)
    }

    /// Whether a side of triangle `t` is not Delaunay, though all angles keep their
    /// bounds: rounding decides that of a side between two right angles.
    #[inline]
    pub(crate) fn has_wrong_side(&self, t: u32) -> bool {
        self.constrained && {
            let m = self.measure(t);
            (0..3).any(|k| m.is_nearly_right(k) && self.is_wrong(t, k))
        }
    }

    #[cold]
    fn is_wrong(&self, t: u32, k: usize) -> bool {
        self.diamond(t, k).is_some_and(|(_, d)| {
            let [apex, from, to, far] = d.map(|v| self.pos[v as usize]);
            !locally_delaunay(to, apex, from, far)
        })
    }

    /// Whether a triangle with these corners lies in a wedge.
    pub(crate) fn in_wedge(&self, v: [u32; 3]) -> bool {
        let sources = v.map(|v| self.source[v as usize]);
        in_wedge(&self.lines, sources, v.map(|v| self.pos[v as usize]))
    }

    /// The angle between the segments or sides of the domain that enclose
    /// triangle `t` at its corner `v`, radians, and the number of triangles
    /// between them; none where they are not in this part.
    pub(crate) fn room(&self, v: u32, t: u32) -> Option<(f64, usize)> {
        let motion = self.motion[v as usize];
        if !self.constrained || motion == Motion::Free {
            return Some((self.sector[v as usize], self.degree(v)));
        }
        let (forward, last, end) = self.sweep(v, t, 1);
        if end == End::Closed {
            return Some((std::f64::consts::TAU, forward));
        }
        let (backward, first, start) = self.sweep(v, t, 2);
        if motion == Motion::Frozen && (start == End::Rim || end == End::Rim) {
            return None;
        }
        let count = forward + backward - 1;
        if matches!(motion, Motion::Along(_) | Motion::On(_)) {
            return Some((std::f64::consts::PI, count));
        }
        let at = self.pos[v as usize];
        Some((opening(self.pos[first as usize] - at, self.pos[last as usize] - at), count))
    }

    /// Goes around `v` from `t`, counter-clockwise for `turn` 1, clockwise for
    /// 2, up to a segment or the rim: how many triangles, the last
    /// vertex, and what ended it.
    fn sweep(&self, v: u32, first: u32, turn: usize) -> (usize, u32, End) {
        let (mut t, mut count) = (first, 1);
        loop {
            let tri = self.tri[t as usize];
            let side = (tri.corner(v) + turn) % 3;
            // The side's end other than `v`.
            let last = tri.v[(side + turn) % 3];
            if tri.is_bound(side) {
                return (count, last, End::Bound);
            }
            t = tri.n[side];
            if t == NONE {
                return (count, last, End::Rim);
            }
            if t == first {
                return (count, last, End::Closed);
            }
            count += 1;
        }
    }
}

/// What ends a sweep around a vertex.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Bound,
    Rim,
    Closed,
}

/// The angle from `u` counter-clockwise to `w`, in (0, 2 pi].
pub(crate) fn opening(u: DVec2, w: DVec2) -> f64 {
    let a = libm::atan2(u.perp_dot(w), u.dot(w));
    if a <= 0.0 { a + std::f64::consts::TAU } else { a }
}
