//! Triangles of a part cut in four, and their neighbours so that edges fit.
//!
//! Cutting in four keeps every angle. A neighbour with one side cut is halved
//! and one with two is cut in three (Bank, Sherman & Weiser, "Refinement
//! algorithms and data structures for regular local mesh refinement", 1983),
//! which leaves the bounds: to be repaired.

use std::collections::BTreeMap;

use hexdel_geom::DVec2;

use crate::constraints::NOWHERE;
use crate::live::cut::Cut;
use crate::live::insert::{Tools, repair_rounds};
use crate::mesh::{Around, Mesh, Motion, NONE, Tri, Vertices};
use crate::work::Work;

/// The part with the triangles that `inner` marks cut in four, repaired as far as the allowance reaches; none where
/// one of them cannot be cut.
pub(crate) fn refine<'a>(cut: &Cut, tools: &'a Tools, inner: &[bool]) -> Option<Work<'a>> {
    let mut work = tools.free_work(cut_in_four(cut, inner)?, cut.failed.clone());
    repair_rounds(&mut work);
    Some(work)
}

/// The part with the triangles that `inner` marks cut in four; none if one of
/// them has a side on the seam.
fn cut_in_four(cut: &Cut, inner: &[bool]) -> Option<Mesh> {
    let old = &cut.mesh;
    let mut built = Builder {
        old,
        pos: old.pos.clone(),
        motion: old.motion.clone(),
        sector: old.sector.clone(),
        around: old.surroundings(),
        cut: BTreeMap::new(),
    };
    for (t, tri) in old.tri.iter().enumerate() {
        for k in (0..3).filter(|_| inner[t]) {
            let (a, b) = (tri.v[(k + 1) % 3], tri.v[(k + 2) % 3]);
            if tri.n[k] == NONE && [a, b].iter().all(|&v| old.motion[v as usize] == Motion::Frozen) {
                return None;
            }
            built.cut_side(a, b, tri.n[k] == NONE, tri.is_bound(k))?;
        }
    }
    let mut tris = Vec::with_capacity(2 * old.tri.len());
    let mut bound = Vec::with_capacity(tris.capacity());
    for tri in &old.tri {
        let first = tris.len();
        built.triangle(tri.v, &mut tris);
        bound.extend(tris[first..].iter().map(|&v| built.bound_of(tri, v)));
    }
    let mut outside: Vec<u32> = vec![0; built.pos.len()];
    for v in 0..old.pos.len() as u32 {
        outside[v as usize] = old.degree(v) as u32;
    }
    for &v in old.tri.iter().flat_map(|t| &t.v) {
        outside[v as usize] -= 1;
    }
    let vertices = Vertices {
        pos: built.pos,
        motion: built.motion,
        sector: built.sector,
        outside,
        around: built.around,
    };
    Mesh::build(vertices, &tris, &bound).ok()
}

struct Builder<'a> {
    old: &'a Mesh,
    pos: Vec<DVec2>,
    motion: Vec<Motion>,
    sector: Vec<f64>,
    around: Around,
    /// Sides cut, lower end first, and the vertex at their middle.
    cut: BTreeMap<[u32; 2], u32>,
}

impl Builder<'_> {
    /// None if the side is on a segment that coordinates do not divide there.
    fn cut_side(&mut self, a: u32, b: u32, rim: bool, bound: bool) -> Option<()> {
        let key = [a.min(b), a.max(b)];
        if self.cut.contains_key(&key) {
            return Some(());
        }
        let (p, q) = (self.pos[a as usize], self.pos[b as usize]);
        let mut at = 0.5 * (p + q);
        let mut motion = if rim { Motion::Along((q - p).normalize()) } else { Motion::Free };
        if bound {
            let line = self.old.line_between(a, b)?;
            at = self.old.nearest_on(line, at);
            motion = Motion::On(line);
        }
        self.cut.insert(key, self.pos.len() as u32);
        self.pos.push(at);
        self.motion.push(motion);
        self.sector.push(if rim { std::f64::consts::PI } else { std::f64::consts::TAU });
        if self.old.is_constrained() {
            self.around.source.push(if let Motion::On(line) = motion { line } else { NOWHERE });
            self.around.near.push(false);
        }
        Some(())
    }

    /// The sides of a part of `tri` that are on segments.
    fn bound_of(&self, tri: &Tri, part: [u32; 3]) -> u8 {
        let on = |v: u32, k: usize| {
            let (from, to) = (tri.v[(k + 1) % 3], tri.v[(k + 2) % 3]);
            v == from || v == to || self.middle(from, to) == Some(v)
        };
        let is_bound = |i: &usize| {
            let (from, to) = (part[(i + 1) % 3], part[(i + 2) % 3]);
            (0..3).any(|k| tri.is_bound(k) && on(from, k) && on(to, k))
        };
        (0..3).filter(is_bound).map(|i| 1 << i).sum()
    }

    fn middle(&self, a: u32, b: u32) -> Option<u32> {
        self.cut.get(&[a.min(b), a.max(b)]).copied()
    }

    /// What a triangle becomes, by how many of its sides are cut.
    fn triangle(&self, v: [u32; 3], out: &mut Vec<[u32; 3]>) {
        // The middle of the side opposite each corner.
        let m: [Option<u32>; 3] = std::array::from_fn(|k| self.middle(v[(k + 1) % 3], v[(k + 2) % 3]));
        let turned = |k: usize| [v[k], v[(k + 1) % 3], v[(k + 2) % 3]];
        match m {
            [None, None, None] => out.push(v),
            [Some(a), Some(b), Some(c)] => {
                out.extend([[v[0], c, b], [c, v[1], a], [b, a, v[2]], [a, b, c]]);
            }
            _ => {
                let cuts = m.iter().flatten().count();
                let k = (0..3).find(|&k| m[k].is_some() == (cuts == 1)).expect("one side differs");
                let [a, b, c] = turned(k);
                if let Some(x) = m[k] {
                    out.extend([[a, b, x], [a, x, c]]);
                } else if let (Some(at_ca), Some(at_ab)) = (m[(k + 1) % 3], m[(k + 2) % 3]) {
                    // The quadrilateral left is halved by its shorter diagonal.
                    let d = |u: u32, w: u32| self.pos[u as usize].distance_squared(self.pos[w as usize]);
                    out.push([a, at_ab, at_ca]);
                    if d(at_ab, c) <= d(b, at_ca) {
                        out.extend([[at_ab, b, c], [at_ab, c, at_ca]]);
                    } else {
                        out.extend([[at_ab, b, at_ca], [b, c, at_ca]]);
                    }
                }
            }
        }
    }
}
