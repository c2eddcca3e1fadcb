//! A triangulation with adjacency that can be changed in place.
//!
//! Everything in this crate that changes a mesh does it through one operation:
//! [`Net::replace`] exchanges a connected set of triangles for others with the
//! same rim.
//!
//! | module | what |
//! |---|---|
//! | [`insert`] | location, insertion and removal of vertices, flips |
//! | [`trace`] | the way of a segment through the triangles, and its recovery |

pub(crate) mod insert;
pub(crate) mod trace;

use hexdel_geom::{DVec2, TriMesh, orient2d, point_on_segment};

/// No triangle, no segment, no vertex.
pub(crate) const NONE: u32 = u32::MAX;

/// What binds a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// Nothing: it may move and go. Never on the rim of the mesh.
    Free,
    /// A piece of a segment, at the fraction `t` of its length.
    Along {
        /// Index of the piece.
        piece: u32,
        /// Strictly between 0 and 1.
        t: f64,
    },
    /// It is an input point, by site.
    Site(u32),
    /// It is on the rim of the domain, or something else that must not move.
    Rim,
    /// It has been removed.
    Gone,
}

/// A vertex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    /// Position, in input units, as it will be written.
    pub(crate) at: DVec2,
    /// What binds it.
    pub(crate) kind: Kind,
    /// One of its triangles; `NONE` if it is gone.
    tri: u32,
    /// Edges to the nearest constrained vertex, as far as somebody counted.
    pub(crate) ring: u32,
}

/// A triangle. Entry `i` of each array belongs to the edge opposite corner
/// `i`, from corner `i + 1` to corner `i + 2`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tri {
    /// Corners, counter-clockwise; the first is `NONE` if the triangle is gone.
    pub(crate) v: [u32; 3],
    /// Neighbours; `NONE` at the rim. Mutual.
    pub(crate) n: [u32; 3],
    /// The piece that each edge is a part of, or `NONE`. The same on both sides.
    pub(crate) s: [u32; 3],
}

impl Tri {
    const GONE: Self = Self { v: [NONE; 3], n: [NONE; 3], s: [NONE; 3] };

    /// Whether the triangle is still there.
    #[inline]
    pub(crate) fn alive(&self) -> bool {
        self.v[0] != NONE
    }

    /// Which corner `v` is.
    #[inline]
    pub(crate) fn corner(&self, v: u32) -> Option<usize> {
        self.v.iter().position(|&c| c == v)
    }

    /// The edge opposite corner `i`.
    #[inline]
    pub(crate) fn edge(&self, i: usize) -> [u32; 2] {
        [self.v[(i + 1) % 3], self.v[(i + 2) % 3]]
    }
}

/// A triangulation. Invariants are those of its parts' fields.
#[derive(Clone, Default)]
pub(crate) struct Net {
    vertices: Vec<Vertex>,
    tris: Vec<Tri>,
    /// The end points of each piece.
    pub(crate) lines: Vec<[DVec2; 2]>,
    /// The first piece at which no part of the plane ends, if there is one.
    pub(crate) soft: Option<u32>,
}

impl Net {
    /// A net of given triangles; vertices on its rim are `Rim`, others `Free`.
    /// The triangles must be a manifold, counter-clockwise.
    pub(crate) fn of(mesh: &TriMesh) -> Self {
        let vertex = |&at| Vertex { at, kind: Kind::Free, tri: NONE, ring: NONE };
        let mut net = Self { vertices: mesh.vertices.iter().map(vertex).collect(), ..Self::default() };
        let mut edges: Vec<(u32, u32, u32)> = Vec::with_capacity(3 * mesh.triangles.len());
        for (t, corners) in mesh.triangles.iter().enumerate() {
            let v = corners.map(|c| c.index() as u32);
            for (i, &corner) in v.iter().enumerate() {
                net.vertices[corner as usize].tri = t as u32;
                let (a, b) = (v[(i + 1) % 3], v[(i + 2) % 3]);
                edges.push((a.min(b), a.max(b), 3 * t as u32 + i as u32));
            }
            net.tris.push(Tri { v, n: [NONE; 3], s: [NONE; 3] });
        }
        edges.sort_unstable();
        for pair in edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
            match *pair {
                [(.., h), (.., g)] => {
                    net.tris[h as usize / 3].n[h as usize % 3] = g / 3;
                    net.tris[g as usize / 3].n[g as usize % 3] = h / 3;
                }
                [(a, b, _), ..] => {
                    net.vertices[a as usize].kind = Kind::Rim;
                    net.vertices[b as usize].kind = Kind::Rim;
                }
                [] => {}
            }
        }
        net
    }

    /// Two triangles that make a rectangle of `Rim` vertices.
    pub(crate) fn rectangle(min: DVec2, max: DVec2) -> Self {
        let vertices = vec![min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)];
        let id = hexdel_geom::VertexId::new;
        let triangles = vec![[id(0), id(1), id(2)], [id(0), id(2), id(3)]];
        Self::of(&TriMesh { vertices, triangles })
    }

    /// Whether a part of the plane ends at the edge opposite corner `i`.
    #[inline]
    pub(crate) fn is_border(&self, t: u32, i: usize) -> bool {
        let piece = self.tri(t).s[i];
        piece != NONE && self.soft.is_none_or(|soft| piece < soft)
    }

    #[inline]
    pub(crate) fn vertex(&self, v: u32) -> &Vertex {
        &self.vertices[v as usize]
    }

    #[inline]
    pub(crate) fn at(&self, v: u32) -> DVec2 {
        self.vertices[v as usize].at
    }

    #[inline]
    pub(crate) fn tri(&self, t: u32) -> &Tri {
        &self.tris[t as usize]
    }

    /// One more than the largest vertex number, gone ones included.
    pub(crate) fn vertex_count(&self) -> u32 {
        self.vertices.len() as u32
    }

    /// One more than the largest triangle number, gone ones included.
    pub(crate) fn tri_count(&self) -> u32 {
        self.tris.len() as u32
    }

    /// All triangles that are there.
    pub(crate) fn alive(&self) -> impl Iterator<Item = u32> {
        (0..self.tri_count()).filter(|&t| self.tri(t).alive())
    }

    /// The corner positions of a triangle.
    #[inline]
    pub(crate) fn corners(&self, t: u32) -> [DVec2; 3] {
        self.tri(t).v.map(|v| self.at(v))
    }

    /// One of a vertex's triangles; `NONE` if it is gone.
    #[inline]
    pub(crate) fn some_triangle(&self, v: u32) -> u32 {
        self.vertex(v).tri
    }

    /// The sign of the orientation of three vertices, exact.
    #[inline]
    pub(crate) fn orient(&self, a: u32, b: u32, c: u32) -> f64 {
        orient2d(self.at(a), self.at(b), self.at(c))
    }

    /// How many triangles a vertex has.
    pub(crate) fn degree(&self, v: u32) -> usize {
        let mut star = Vec::with_capacity(8);
        self.star(v, &mut star);
        star.len()
    }

    /// The triangles at a vertex; counter-clockwise, from the rim if it is on it.
    pub(crate) fn star(&self, v: u32, out: &mut Vec<u32>) {
        self.fan(v, self.vertex(v).tri, out);
    }

    /// The triangles that hang together with `first` at its corner `v`.
    pub(crate) fn fan(&self, v: u32, first: u32, out: &mut Vec<u32>) {
        out.clear();
        let step = |t: u32, turn: usize| {
            let tri = self.tri(t);
            let i = tri.corner(v).expect("a triangle of a star has the vertex it is the star of");
            tri.n[(i + turn) % 3]
        };
        let mut t = first;
        while t != NONE {
            out.push(t);
            t = step(t, 1);
            if t == first {
                return;
            }
        }
        let before = out.len();
        let mut t = if first == NONE { NONE } else { step(first, 2) };
        while t != NONE {
            out.push(t);
            t = step(t, 2);
        }
        let clockwise = out.len() - before;
        out[before..].reverse();
        out.rotate_right(clockwise);
    }

    /// A vertex at the same place for the fan of triangle `t`.
    pub(crate) fn copy_vertex(&mut self, v: u32, t: u32) -> u32 {
        self.vertices.push(Vertex { tri: t, ..*self.vertex(v) });
        self.vertex_count() - 1
    }

    /// Exchanges a corner of a triangle for a copy.
    pub(crate) fn rename(&mut self, t: u32, from: u32, to: u32) {
        for v in &mut self.tris[t as usize].v {
            if *v == from {
                *v = to;
            }
        }
    }

    /// The triangle left of the directed edge, and the corner opposite it.
    pub(crate) fn find_edge(&self, a: u32, b: u32) -> Option<(u32, usize)> {
        let mut star = Vec::with_capacity(8);
        self.star(a, &mut star);
        star.into_iter().find_map(|t| {
            let tri = self.tri(t);
            let i = tri.corner(a)?;
            (tri.v[(i + 1) % 3] == b).then_some((t, (i + 2) % 3))
        })
    }

    /// The triangle at an edge, from either side, and the corner opposite it.
    pub(crate) fn find_either(&self, a: u32, b: u32) -> Option<(u32, usize)> {
        self.find_edge(a, b).or_else(|| self.find_edge(b, a))
    }

    /// The corner beyond the edge opposite corner `i` of `t`.
    #[inline]
    pub(crate) fn beyond(&self, t: u32, i: usize) -> Option<(u32, usize)> {
        let n = self.tri(t).n[i];
        if n == NONE {
            return None;
        }
        let j = self.tri(n).n.iter().position(|&m| m == t).expect("neighbours are mutual");
        // Two triangles may share two edges while a vertex of degree two is
        // being made: then the edge decides.
        let [a, b] = self.tri(t).edge(i);
        let j = if self.tri(n).edge(j) == [b, a] {
            j
        } else {
            (0..3).find(|&j| self.tri(n).edge(j) == [b, a])?
        };
        Some((n, j))
    }

    /// A new vertex that no triangle has yet.
    pub(crate) fn add_vertex(&mut self, at: DVec2, kind: Kind) -> u32 {
        self.vertices.push(Vertex { at, kind, tri: NONE, ring: NONE });
        self.vertex_count() - 1
    }

    /// Moves a vertex.
    pub(crate) fn move_to(&mut self, v: u32, at: DVec2, kind: Kind) {
        let vertex = &mut self.vertices[v as usize];
        vertex.at = at;
        vertex.kind = kind;
    }

    /// Sets the count of edges to the nearest constrained vertex.
    pub(crate) fn set_ring(&mut self, v: u32, ring: u32) {
        self.vertices[v as usize].ring = ring;
    }

    /// Makes an edge part of a piece, or of none.
    pub(crate) fn constrain(&mut self, a: u32, b: u32, piece: u32) {
        for (a, b) in [(a, b), (b, a)] {
            if let Some((t, i)) = self.find_edge(a, b) {
                self.tris[t as usize].s[i] = piece;
            }
        }
    }

    /// Where on a piece one of its vertices lies, as a fraction of its length.
    pub(crate) fn fraction_of(&self, v: u32, piece: u32) -> f64 {
        match self.vertex(v).kind {
            Kind::Along { piece: p, t } if p == piece => t,
            _ if self.at(v) == self.lines[piece as usize][0] => 0.0,
            _ => 1.0,
        }
    }

    /// The double nearest to the point of a piece at a fraction of its length.
    pub(crate) fn along(&self, piece: u32, t: f64) -> DVec2 {
        let [a, b] = self.lines[piece as usize];
        point_on_segment(a, b, t)
    }

    /// Exchanges triangles for others with the same rim. `piece_of` says which
    /// piece a new inner edge is part of.
    ///
    /// Numbers of old triangles are used again, in order.
    pub(crate) fn replace(&mut self, old: &[u32], new: &[[u32; 3]], piece_of: impl Fn(u32, u32) -> u32) {
        let rim = self.rim(old);
        let ids: Vec<u32> = (0..new.len())
            .map(|k| old.get(k).copied().unwrap_or((self.tris.len() + k - old.len().min(k)) as u32))
            .collect();
        self.tris.resize(self.tris.len() + new.len().saturating_sub(old.len()), Tri::GONE);
        for (k, &v) in new.iter().enumerate() {
            let mut tri = Tri { v, n: [NONE; 3], s: [NONE; 3] };
            for i in 0..3 {
                let [a, b] = tri.edge(i);
                if let Some(&(.., outer, piece)) = rim.iter().find(|r| (r.0, r.1) == (a, b)) {
                    (tri.n[i], tri.s[i]) = (outer, piece);
                    self.relink(outer, [b, a], ids[k]);
                } else {
                    let twin = (0..new.len()).find(|&m| has_edge(new[m], b, a));
                    tri.n[i] = twin.map_or(NONE, |m| ids[m]);
                    tri.s[i] = piece_of(a, b);
                }
            }
            self.tris[ids[k] as usize] = tri;
            for v in tri.v {
                self.vertices[v as usize].tri = ids[k];
            }
        }
        for &t in old.iter().skip(new.len()) {
            self.tris[t as usize] = Tri::GONE;
        }
    }

    /// The directed edges around triangles, with what lies beyond.
    fn rim(&self, old: &[u32]) -> Vec<(u32, u32, u32, u32)> {
        let mut rim = Vec::with_capacity(old.len() + 2);
        for &t in old {
            let tri = self.tri(t);
            for i in 0..3 {
                if tri.n[i] == NONE || !old.contains(&tri.n[i]) {
                    let [a, b] = tri.edge(i);
                    rim.push((a, b, tri.n[i], tri.s[i]));
                }
            }
        }
        rim
    }

    fn relink(&mut self, outer: u32, edge: [u32; 2], to: u32) {
        if outer == NONE {
            return;
        }
        let tri = &mut self.tris[outer as usize];
        let i = (0..3).find(|&i| tri.edge(i) == edge).expect("a neighbour has the shared edge");
        tri.n[i] = to;
    }

    /// Takes a vertex that no triangle has any more out of the mesh.
    pub(crate) fn retire(&mut self, v: u32) {
        let vertex = &mut self.vertices[v as usize];
        vertex.kind = Kind::Gone;
        vertex.tri = NONE;
    }

    /// Cuts triangles away; what they leave without any triangle goes too.
    /// The rest must be a manifold at every vertex, or fall apart into fans
    /// that only `split_fans` can tell apart.
    pub(crate) fn carve(&mut self, doomed: &[bool]) {
        for t in 0..self.tris.len() {
            if !doomed[t] {
                for i in 0..3 {
                    let n = self.tris[t].n[i];
                    if self.tris[t].alive() && n != NONE && doomed[n as usize] {
                        self.tris[t].n[i] = NONE;
                    }
                }
            }
        }
        for (tri, &doomed) in self.tris.iter_mut().zip(doomed) {
            if doomed {
                *tri = Tri::GONE;
            }
        }
        for vertex in &mut self.vertices {
            vertex.tri = NONE;
        }
        for t in 0..self.tris.len() {
            if self.tris[t].alive() {
                for v in self.tris[t].v {
                    self.vertices[v as usize].tri = t as u32;
                }
            }
        }
        for vertex in self.vertices.iter_mut().filter(|v| v.tri == NONE) {
            vertex.kind = Kind::Gone;
        }
    }

    /// The first broken invariant, for tests.
    #[cfg(test)]
    pub(crate) fn violation(&self) -> Option<String> {
        self.alive().find_map(|t| {
            let tri = self.tri(t);
            let [a, b, c] = tri.v;
            if self.orient(a, b, c) <= 0.0 {
                return Some(format!("triangle {t} is not counter-clockwise"));
            }
            (0..3).find_map(|i| {
                let n = tri.n[i];
                let twin = self.find_edge(tri.edge(i)[1], tri.edge(i)[0]);
                match twin {
                    None => (n != NONE).then(|| format!("triangle {t} has a false neighbour")),
                    Some((m, j)) => {
                        let there = self.tri(m);
                        (n != m || there.n[j] != t || there.s[j] != tri.s[i])
                            .then(|| format!("triangles {t} and {m} disagree"))
                    }
                }
            })
        })
    }
}

fn has_edge(v: [u32; 3], a: u32, b: u32) -> bool {
    (0..3).any(|i| v[i] == a && v[(i + 1) % 3] == b)
}

#[cfg(test)]
mod tests;
