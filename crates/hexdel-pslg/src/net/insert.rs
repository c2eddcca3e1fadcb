//! Location, insertion and removal of vertices, flips.
//!
//! Insertion is by splitting and Lawson's flips ("Software for C1 surface
//! interpolation", 1977), with exact predicates: of a Delaunay mesh it makes a
//! Delaunay mesh, of any mesh a valid one, and constrained edges stay.

use super::{Kind, NONE, Net};
use hexdel_geom::{DVec2, incircle, orient2d};

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Place {
    /// On a vertex.
    Vertex(u32),
    /// Inside the edge opposite a corner of a triangle.
    Edge(u32, usize),
    /// Inside a triangle.
    Inside(u32),
    /// In no triangle.
    Outside,
}

impl Net {
    /// A triangle of the part of the plane, as segments divide it, that a point
    /// lies in; none outside, and none on a segment, which has two sides.
    pub(crate) fn part_at(&self, p: DVec2, hint: u32) -> Option<u32> {
        match self.locate(p, hint) {
            Place::Inside(t) => Some(t),
            Place::Edge(t, i) => (!self.is_border(t, i)).then_some(t),
            Place::Vertex(v) => {
                let mut star = Vec::with_capacity(8);
                self.star(v, &mut star);
                // The segment of an edge stands at the corner opposite.
                let on_segment = |&t: &u32| {
                    let tri = self.tri(t);
                    (0..3).any(|i| tri.v[i] != v && tri.s[i] != NONE)
                };
                (!star.iter().any(on_segment)).then(|| self.some_triangle(v))
            }
            Place::Outside => None,
        }
    }

    /// Finds a point by walking from triangle `hint`.
    pub(crate) fn locate(&self, p: DVec2, hint: u32) -> Place {
        let mut t = if hint < self.tri_count() && self.tri(hint).alive() {
            hint
        } else {
            match self.alive().next() {
                Some(t) => t,
                None => return Place::Outside,
            }
        };
        // In a Delaunay mesh a walk never comes back (Edelsbrunner, "An
        // acyclicity theorem for cell complexes in d dimensions", 1990); in
        // others it may, and all triangles are looked at instead.
        for step in 0..self.tri_count() as usize + 3 {
            match self.step(p, t, step) {
                Ok(place) => return place,
                Err(NONE) => break,
                Err(next) => t = next,
            }
        }
        self.alive().find_map(|t| self.step(p, t, 0).ok()).unwrap_or(Place::Outside)
    }

    /// Where in triangle `t` a point lies, or the neighbour nearer to it.
    fn step(&self, p: DVec2, t: u32, turn: usize) -> Result<Place, u32> {
        let tri = self.tri(t);
        let mut on = [false; 3];
        for k in 0..3 {
            let i = (k + turn) % 3;
            let [a, b] = tri.edge(i);
            let side = orient2d(self.at(a), self.at(b), p);
            if side < 0.0 {
                return Err(tri.n[i]);
            }
            on[i] = side == 0.0;
        }
        Ok(match on {
            [false, false, false] => Place::Inside(t),
            [true, false, false] => Place::Edge(t, 0),
            [false, true, false] => Place::Edge(t, 1),
            [false, false, true] => Place::Edge(t, 2),
            [false, ..] => Place::Vertex(tri.v[0]),
            [_, false, _] => Place::Vertex(tri.v[1]),
            _ => Place::Vertex(tri.v[2]),
        })
    }

    /// Inserts a point, or binds the vertex that is there already; `None` if
    /// it lies outside.
    pub(crate) fn insert(&mut self, at: DVec2, kind: Kind, hint: u32) -> Option<u32> {
        let place = self.locate(at, hint);
        if let Place::Vertex(v) = place {
            if self.vertex(v).kind == Kind::Free {
                self.move_to(v, at, kind);
            }
            return Some(v);
        }
        let v = match place {
            Place::Inside(t) => self.split_triangle(t, at, kind),
            Place::Edge(t, i) => self.split_edge(t, i, at, kind),
            _ => return None,
        };
        self.legalise(v);
        Some(v)
    }

    /// One triangle becomes three.
    pub(crate) fn split_triangle(&mut self, t: u32, at: DVec2, kind: Kind) -> u32 {
        let [a, b, c] = self.tri(t).v;
        let v = self.add_vertex(at, kind);
        self.replace(&[t], &[[a, b, v], [b, c, v], [c, a, v]], |_, _| NONE);
        v
    }

    /// An edge becomes two, its triangles become twice as many. Both halves
    /// are part of the piece that the edge was part of.
    pub(crate) fn split_edge(&mut self, t: u32, i: usize, at: DVec2, kind: Kind) -> u32 {
        let c = self.tri(t).v[i];
        let [a, b] = self.tri(t).edge(i);
        let piece = self.tri(t).s[i];
        let v = self.add_vertex(at, kind);
        let piece_of = |p: u32, q: u32| {
            let halves = (p == v && (q == a || q == b)) || (q == v && (p == a || p == b));
            if halves { piece } else { NONE }
        };
        match self.beyond(t, i) {
            Some((n, j)) => {
                let d = self.tri(n).v[j];
                self.replace(&[t, n], &[[c, a, v], [c, v, b], [d, b, v], [d, v, a]], piece_of);
            }
            None => self.replace(&[t], &[[c, a, v], [c, v, b]], piece_of),
        }
        v
    }

    /// Lawson's flips around a new vertex.
    pub(crate) fn legalise(&mut self, v: u32) {
        let mut star = Vec::with_capacity(8);
        self.star(v, &mut star);
        let mut stack: Vec<[u32; 2]> =
            star.iter().filter_map(|&t| self.tri(t).corner(v).map(|i| self.tri(t).edge(i))).collect();
        while let Some([a, b]) = stack.pop() {
            let Some((t, i)) = self.find_edge(a, b).filter(|&(t, i)| self.tri(t).v[i] == v) else {
                continue;
            };
            let Some((n, j)) = self.beyond(t, i) else { continue };
            let d = self.tri(n).v[j];
            let inside = incircle(self.at(v), self.at(a), self.at(b), self.at(d)) > 0.0;
            if inside && self.flip(t, i) {
                stack.extend([[a, d], [d, b]]);
            }
        }
    }

    /// Flips the edge opposite corner `i` of `t`, if it is neither constrained
    /// nor on the rim and both new triangles are counter-clockwise.
    pub(crate) fn flip(&mut self, t: u32, i: usize) -> bool {
        let Some((n, [a, b, c, d])) = self.quad(t, i) else { return false };
        if self.orient(a, b, d) <= 0.0 || self.orient(a, d, c) <= 0.0 {
            return false;
        }
        self.replace(&[t, n], &[[a, b, d], [a, d, c]], |_, _| NONE);
        true
    }

    /// The triangle beyond an unconstrained edge and the corners `a b c` of the
    /// first triangle, from the one opposite the edge, with `d` beyond.
    pub(crate) fn quad(&self, t: u32, i: usize) -> Option<(u32, [u32; 4])> {
        let tri = self.tri(t);
        if tri.s[i] != NONE {
            return None;
        }
        let (n, j) = self.beyond(t, i)?;
        let [b, c] = tri.edge(i);
        Some((n, [tri.v[i], b, c, self.tri(n).v[j]]))
    }

    /// Removes a free vertex and fills the hole with Delaunay ears. `false`,
    /// with nothing changed, if the hole cannot be filled.
    pub(crate) fn remove(&mut self, v: u32) -> bool {
        let mut star = Vec::with_capacity(8);
        self.star(v, &mut star);
        let polygon: Vec<u32> =
            star.iter().filter_map(|&t| self.tri(t).corner(v).map(|i| self.tri(t).edge(i)[0])).collect();
        let Some(ears) = self.ears(polygon) else { return false };
        self.replace(&star, &ears, |_, _| NONE);
        self.retire(v);
        true
    }

    /// Triangulates a simple polygon, counter-clockwise.
    fn ears(&self, mut polygon: Vec<u32>) -> Option<Vec<[u32; 3]>> {
        let mut out = Vec::with_capacity(polygon.len());
        while polygon.len() > 3 {
            let n = polygon.len();
            let ear = |i: usize| [polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]];
            let valid = |&i: &usize| self.is_ear(ear(i), &polygon);
            let delaunay = |i: &usize| self.is_empty(ear(*i), &polygon);
            let i = (0..n).filter(valid).find(delaunay).or_else(|| (0..n).find(valid))?;
            out.push(ear(i));
            polygon.remove(i);
        }
        let last = [polygon[0], polygon[1], polygon[2]];
        (self.orient(last[0], last[1], last[2]) > 0.0).then(|| out.push(last))?;
        Some(out)
    }

    fn is_ear(&self, [a, b, c]: [u32; 3], polygon: &[u32]) -> bool {
        self.orient(a, b, c) > 0.0
            && polygon.iter().filter(|p| ![a, b, c].contains(p)).all(|&p| {
                self.orient(a, b, p) < 0.0 || self.orient(b, c, p) < 0.0 || self.orient(c, a, p) < 0.0
            })
    }

    fn is_empty(&self, [a, b, c]: [u32; 3], polygon: &[u32]) -> bool {
        let [pa, pb, pc] = [a, b, c].map(|v| self.at(v));
        polygon.iter().filter(|p| ![a, b, c].contains(p)).all(|&p| incircle(pa, pb, pc, self.at(p)) <= 0.0)
    }
}
