//! Delaunay cavities of places: a walk to the triangle, then growth by circles.

use hexdel_geom::DVec2;
use hexdel_optimize::edit::{Cavity, NONE, next, prev};

use super::Refiner;

/// Triangles that a walk may cross.
const STEPS: usize = 60;

impl Refiner<'_> {
    /// The Delaunay cavity of a place, walking straight there from triangle `t`; none if it is too far away. An error is
    /// a corner opposite the edge of a segment that the place is beyond, or in the half-circle over.
    pub(crate) fn find_cavity(&self, x: DVec2, t: u32) -> Result<Option<Cavity>, u32> {
        let Some(there) = self.walk(x, t)? else { return Ok(None) };
        self.delaunay_cavity(x, there).map(Some)
    }

    /// The triangle with a place in it, or the corner opposite the marked edge that is in the way.
    fn walk(&self, x: DVec2, t: u32) -> Result<Option<u32>, u32> {
        let mesh = &self.mesh;
        let from = mesh.corners(t).iter().sum::<DVec2>() / 3.0;
        let ahead = x - from;
        let (mut at, mut back) = (t, NONE);
        for _ in 0..STEPS {
            let crossed = |&c: &u32| {
                if c == back {
                    return false;
                }
                let [u, w] = mesh.edge(c).map(|v| mesh.at(v));
                (w - u).perp_dot(x - u) < 0.0
                    && ahead.perp_dot(u - from) <= 0.0
                    && ahead.perp_dot(w - from) >= 0.0
            };
            let Some(c) = (3 * at..3 * at + 3).find(crossed) else { return Ok(Some(at)) };
            if mesh.is_marked(c) || mesh.twin[c as usize] == NONE {
                return Err(c);
            }
            back = mesh.twin[c as usize];
            at = back / 3;
        }
        Ok(None)
    }

    fn delaunay_cavity(&self, x: DVec2, t: u32) -> Result<Cavity, u32> {
        let mut cavity = self.mesh.cavity_of(t);
        let (mut i, mut still) = (0, 0);
        while still < cavity.len() {
            let inner = cavity.inner(i);
            if self.mesh.is_marked(inner) {
                let [u, w] = self.mesh.edge(inner).map(|v| self.mesh.at(v) - x);
                if !self.mesh.is_locked(inner) && u.dot(w) < 0.0 {
                    return Err(inner);
                }
            } else if let Some(grown) = self.grown_by_circle(&cavity, i, x) {
                cavity = grown;
                (i, still) = (i % cavity.len(), 0);
                continue;
            }
            still += 1;
            i = cavity.after(i);
        }
        Ok(cavity)
    }

    /// The Delaunay cavity of a place on the segment's edge opposite corner `c`, on the side of `c`.
    pub(crate) fn delaunay_half(&self, x: DVec2, c: u32) -> Cavity {
        let mut cavity = self.mesh.cavity_on(c);
        let (mut i, mut still) = (1, 0);
        while still < cavity.len() {
            if i > 0
                && let Some(grown) = self.grown_by_circle(&cavity, i, x)
            {
                cavity = grown;
                (i, still) = (i % cavity.len(), 0);
                continue;
            }
            still += 1;
            i = cavity.after(i);
        }
        cavity
    }

    /// The cavity with the triangle beyond edge `i`, if `x` is in its circle and no vertex would be enclosed.
    fn grown_by_circle(&self, cavity: &Cavity, i: usize, x: DVec2) -> Option<Cavity> {
        let inner = cavity.inner(i);
        let k = self.mesh.twin[inner as usize];
        if k == NONE || self.mesh.is_marked(inner) {
            return None;
        }
        let [u, v, w] = [k, next(k), prev(k)].map(|c| self.mesh.at(self.mesh.v(c)) - x);
        let inside = u.length_squared() * v.perp_dot(w)
            + v.length_squared() * w.perp_dot(u)
            + w.length_squared() * u.perp_dot(v);
        if inside <= 0.0 {
            return None;
        }
        self.mesh.grown(cavity, i).filter(|grown| grown.enclosed().is_empty())
    }
}
