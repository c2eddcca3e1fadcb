//! Between arrays and the editable mesh.

use std::sync::Arc;

use hexdel_geom::DVec2;
use hexdel_geom::predicates::locally_delaunay;

use super::{Mesh, Motion, NONE, Tri};
use crate::angles::{Measure, Place};
use crate::constraints::{Line, NOWHERE, in_wedge};

/// A mesh as arrays: what is kept between the rounds of work. Those of vertices
/// are as long as `pos`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Soup {
    pub(crate) pos: Vec<DVec2>,
    pub(crate) motion: Vec<Motion>,
    /// Angle of the domain at each vertex, radians.
    pub(crate) sector: Vec<f64>,
    /// Index of the vertex in the caller's mesh, `NONE` for new ones.
    pub(crate) origin: Vec<u32>,
    /// Radius in rings of the patches in which the removal of the vertex
    /// failed, with nothing changed nearby since; 0 if it has not been tried.
    pub(crate) failed: Vec<u8>,
    pub(crate) tris: Vec<[u32; 3]>,
    /// The sides of each triangle that must stay, as in `Tri`.
    pub(crate) bound: Vec<u8>,
    /// The segment that each vertex lies on, `POINT` or `NOWHERE`; empty if
    /// there are no segments and points that bounds depend on.
    pub(crate) source: Vec<u32>,
    /// What [`Motion::On`] refers to.
    pub(crate) lines: Arc<[Line]>,
}

impl Soup {
    /// Whether there are segments or points that bounds depend on.
    pub(crate) fn is_constrained(&self) -> bool {
        !self.source.is_empty()
    }

    /// Whether each vertex is at most one edge away from a source; empty if
    /// there are none.
    pub(crate) fn near(&self) -> Vec<bool> {
        let mut near: Vec<bool> = self.source.iter().map(|&s| s != NOWHERE).collect();
        if self.is_constrained() {
            for t in &self.tris {
                if t.iter().any(|&v| self.source[v as usize] != NOWHERE) {
                    for &v in t {
                        near[v as usize] = true;
                    }
                }
            }
        }
        near
    }

    /// Where triangle `t` lies, given the result of [`Soup::near`].
    pub(crate) fn place(&self, t: usize, near: &[bool]) -> Place {
        if near.is_empty() {
            return Place::default();
        }
        let v = self.tris[t];
        let sources = v.map(|v| self.source[v as usize]);
        if in_wedge(&self.lines, sources, v.map(|v| self.pos[v as usize])) {
            return Place::in_wedge();
        }
        Place::new(v.iter().any(|&v| near[v as usize]), self.bound[t])
    }
}

impl Soup {
    /// The triangles that [`Mesh::has_wrong_side`] tells of, ascending.
    pub(crate) fn beside_wrong_sides(&self) -> Vec<u32> {
        if !self.is_constrained() {
            return Vec::new();
        }
        // Sides opposite right angles, and where those are.
        let mut sides: Vec<([u32; 2], u32, usize)> = Vec::new();
        for (t, v) in (0..).zip(&self.tris) {
            let [a, b, c] = v.map(|v| self.pos[v as usize]);
            let m = Measure::of(a, b, c);
            for k in (0..3).filter(|&k| m.is_nearly_right(k) && self.bound[t as usize] >> k & 1 == 0) {
                let (from, to) = (v[(k + 1) % 3], v[(k + 2) % 3]);
                sides.push(([from.min(to), from.max(to)], t, k));
            }
        }
        sides.sort_unstable();
        let mut wrong: Vec<u32> = Vec::new();
        for pair in sides.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let corner = |(_, t, k): ([u32; 2], u32, usize), i: usize| {
                self.pos[self.tris[t as usize][(k + i) % 3] as usize]
            };
            let [near, far] = [pair[0], pair[1]];
            if !locally_delaunay(corner(near, 2), corner(near, 0), corner(near, 1), corner(far, 0)) {
                wrong.extend([near.1, far.1]);
            }
        }
        wrong.sort_unstable();
        wrong.dedup();
        wrong
    }
}

/// A side that two triangles have in the same direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BadSide {
    pub(crate) from: u32,
    pub(crate) to: u32,
}

/// The vertices of a mesh to be built.
pub(crate) struct Vertices {
    pub(crate) pos: Vec<DVec2>,
    pub(crate) motion: Vec<Motion>,
    pub(crate) sector: Vec<f64>,
    /// Triangles at each vertex that are not in the mesh.
    pub(crate) outside: Vec<u32>,
    pub(crate) around: Around,
}

/// What vertices know of segments; all empty if there are none.
#[derive(Default)]
pub(crate) struct Around {
    /// As in `Soup`.
    pub(crate) source: Vec<u32>,
    /// As [`Soup::near`] says.
    pub(crate) near: Vec<bool>,
    pub(crate) lines: Arc<[Line]>,
}

impl Mesh {
    /// Builds the mesh of `tris`; `bound` are the sides of each that must stay,
    /// or empty if there are none.
    ///
    /// # Complexity
    ///
    /// Linear for vertices of bounded degree.
    pub(crate) fn build(vertices: Vertices, tris: &[[u32; 3]], bound: &[u8]) -> Result<Self, BadSide> {
        let Vertices { pos, motion, sector, outside: mut degree, around } = vertices;
        let neighbours = neighbours(pos.len(), tris)?;
        let mut anchor = vec![NONE; pos.len()];
        for (t, v) in tris.iter().enumerate() {
            for &v in v {
                anchor[v as usize] = t as u32;
                degree[v as usize] += 1;
            }
        }
        let bound = bound.iter().copied().chain(std::iter::repeat(0));
        let tri =
            tris.iter().zip(neighbours).zip(bound).map(|((&v, n), bound)| Tri { v, n, bound }).collect();
        let Around { source, near, lines } = around;
        let constrained = !source.is_empty();
        Ok(Self {
            pos,
            motion,
            sector,
            tri,
            anchor,
            degree,
            constrained,
            source,
            near,
            lines,
            ..Self::default()
        })
    }
}

/// The neighbours of each triangle, found by sorting the sides into buckets
/// by their smaller vertex.
fn neighbours(vertices: usize, tris: &[[u32; 3]]) -> Result<Vec<[u32; 3]>, BadSide> {
    let side = |t: usize, k: usize| (tris[t][(k + 1) % 3], tris[t][(k + 2) % 3]);
    let sides = || (0..tris.len()).flat_map(|t| (0..3).map(move |k| (t, k)));
    let mut start = vec![0u32; vertices + 1];
    for (t, k) in sides() {
        let (a, b) = side(t, k);
        start[a.min(b) as usize + 1] += 1;
    }
    for i in 0..vertices {
        start[i + 1] += start[i];
    }
    let mut bucket = vec![0u32; tris.len() * 3];
    let mut n = vec![[NONE; 3]; tris.len()];
    let mut fill = start.clone();
    for (t, k) in sides() {
        let (a, b) = side(t, k);
        let low = a.min(b) as usize;
        for &code in &bucket[start[low] as usize..fill[low] as usize] {
            let (t2, k2) = (code as usize / 3, code as usize % 3);
            let other = side(t2, k2);
            if other == (a, b) {
                return Err(BadSide { from: a, to: b });
            }
            if other == (b, a) {
                n[t][k] = t2 as u32;
                n[t2][k2] = t as u32;
            }
        }
        bucket[fill[low] as usize] = (3 * t + k) as u32;
        fill[low] += 1;
    }
    Ok(n)
}
