//! The changes of topology: all are one operation, the replacement of a few
//! triangles by others with the same outline.

use hexdel_geom::DVec2;

use super::{Mesh, Motion, NONE, Tri};
use crate::constraints::line_between;

/// Storage that replacements use in turn.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    outline: Vec<Side>,
    dropped: Vec<u32>,
}

/// One directed side of the outline and what lies beyond it.
#[derive(Clone, Copy, Debug)]
struct Side {
    from: u32,
    to: u32,
    beyond: u32,
    bound: bool,
}

impl Mesh {
    /// Replaces the triangles `old` by `new`, which must cover the same
    /// outline, counter-clockwise. Slots of `old` are reused; the ids of the
    /// new triangles are appended to `made`.
    ///
    /// The caller has checked that no edge of `new` inside the outline exists
    /// outside of it ([`Mesh::adjacent`]).
    pub(crate) fn replace(&mut self, old: &[u32], new: &[[u32; 3]], made: &mut Vec<u32>) {
        self.replace_bound(old, new, &[], made);
    }

    /// The same where some of the edges between the new triangles, or sides of
    /// the new rim, must stay from now on. Sides of the outline stay what they
    /// are.
    pub(crate) fn replace_bound(
        &mut self,
        old: &[u32],
        new: &[[u32; 3]],
        bound: &[[u32; 2]],
        made: &mut Vec<u32>,
    ) {
        let Scratch { mut outline, mut dropped } = std::mem::take(&mut self.scratch);
        self.outline(old, &mut outline);
        dropped.clear();
        for &t in old {
            dropped.extend(self.tri[t as usize].v);
        }
        for &t in &old[new.len().min(old.len())..] {
            self.set_tri(t, Tri::DEAD);
        }
        let base = made.len();
        for i in 0..new.len() {
            let t = if i < old.len() { old[i] } else { self.add_tri() };
            made.push(t);
        }
        for (i, &v) in new.iter().enumerate() {
            let mut tri = Tri { v, n: [NONE; 3], bound: 0 };
            for k in 0..3 {
                let (from, to) = (v[(k + 1) % 3], v[(k + 2) % 3]);
                let inner = new.iter().position(|w| has_side(*w, to, from));
                let joins = |b: &[u32; 2]| *b == [from, to] || *b == [to, from];
                let mut stays = bound.iter().any(joins);
                if let Some(j) = inner {
                    tri.n[k] = made[base + j];
                } else if let Some(side) = outline.iter().find(|s| s.from == from && s.to == to) {
                    tri.n[k] = self.attach(*side, made[base + i]);
                    stays |= side.bound;
                }
                // A side that joins two sides of the rim (a rim vertex removed)
                // has no counterpart in the outline: it is rim itself.
                tri.bound |= u8::from(stays) << k;
            }
            self.set_tri(made[base + i], tri);
            for w in v {
                self.set_anchor(w, made[base + i]);
            }
        }
        for &v in &dropped {
            if !new.iter().any(|w| w.contains(&v)) {
                self.set_anchor(v, NONE);
            }
        }
        self.scratch = Scratch { outline, dropped };
    }

    fn outline(&self, old: &[u32], sides: &mut Vec<Side>) {
        sides.clear();
        for &t in old {
            let tri = self.tri[t as usize];
            for k in 0..3 {
                if tri.n[k] == NONE || !old.contains(&tri.n[k]) {
                    sides.push(Side {
                        from: tri.v[(k + 1) % 3],
                        to: tri.v[(k + 2) % 3],
                        beyond: tri.n[k],
                        bound: tri.is_bound(k),
                    });
                }
            }
        }
    }

    /// Tells what lies beyond a side of the outline that its neighbour is `t`
    /// now.
    fn attach(&mut self, side: Side, t: u32) -> u32 {
        let Side { from, to, beyond, .. } = side;
        if beyond != NONE {
            let mut tri = self.tri[beyond as usize];
            let k = (0..3).find(|&k| tri.v[(k + 1) % 3] == to && tri.v[(k + 2) % 3] == from);
            debug_assert!(k.is_some(), "neighbours share a side");
            if let Some(k) = k {
                tri.n[k] = t;
                self.set_tri(beyond, tri);
            }
        }
        beyond
    }

    /// The two triangles and four vertices of the side opposite corner `k` of
    /// `t`: `[apex, from, to, far apex]`, unless the side is rim or must stay.
    #[inline]
    pub(crate) fn diamond(&self, t: u32, k: usize) -> Option<(u32, [u32; 4])> {
        if self.tri[t as usize].is_bound(k) { None } else { self.pair(t, k) }
    }

    /// The same where the side may be one that must stay.
    #[inline]
    fn pair(&self, t: u32, k: usize) -> Option<(u32, [u32; 4])> {
        let tri = self.tri[t as usize];
        let u = tri.n[k];
        if u == NONE {
            return None;
        }
        let (from, to) = (tri.v[(k + 1) % 3], tri.v[(k + 2) % 3]);
        let far = self.tri[u as usize].v.into_iter().find(|&v| v != from && v != to)?;
        Some((u, [tri.v[k], from, to, far]))
    }

    /// Whether the side opposite corner `k` of `t` can be exchanged for the
    /// other diagonal without making the topology degenerate.
    pub(crate) fn can_flip(&self, [apex, from, to, far]: [u32; 4]) -> bool {
        self.degree(from) > 2 && self.degree(to) > 2 && apex != far && !self.adjacent(apex, far)
    }

    /// Exchanges the side opposite corner `k` of `t` for the other diagonal;
    /// false, and nothing done, where that is impossible.
    pub(crate) fn flip(&mut self, t: u32, k: usize) -> bool {
        let Some((u, d)) = self.diamond(t, k) else {
            return false;
        };
        if !self.can_flip(d) {
            return false;
        }
        let [apex, from, to, far] = d;
        let a = self.tri[t as usize];
        let b = self.tri[u as usize];
        let j = b.corner(far);
        // Beyond from-far, far-to, to-apex, apex-from.
        let beyond = [b.n[b.corner(to)], b.n[b.corner(from)], a.n[(k + 1) % 3], a.n[(k + 2) % 3]];
        let bound = [
            b.is_bound(b.corner(to)),
            b.is_bound(b.corner(from)),
            a.is_bound((k + 1) % 3),
            a.is_bound((k + 2) % 3),
        ]
        .map(u8::from);
        debug_assert_eq!(b.n[j], t);
        let (first, second) = (bound[0] | bound[3] << 2, bound[2] | bound[1] << 2);
        self.set_tri(t, Tri { v: [apex, from, far], n: [beyond[0], u, beyond[3]], bound: first });
        self.set_tri(u, Tri { v: [far, to, apex], n: [beyond[2], t, beyond[1]], bound: second });
        self.relink(beyond[0], u, t);
        self.relink(beyond[2], t, u);
        self.set_anchor(from, t);
        self.set_anchor(to, u);
        self.set_anchor(apex, t);
        self.set_anchor(far, t);
        true
    }

    fn relink(&mut self, at: u32, old: u32, new: u32) {
        if at != NONE {
            let mut tri = self.tri[at as usize];
            for n in &mut tri.n {
                if *n == old {
                    *n = new;
                }
            }
            self.set_tri(at, tri);
        }
    }

    /// Puts a new vertex at the middle of the side opposite corner `k` of `t`.
    ///
    /// A vertex on a segment or on the rim slides along it, any other is free.
    /// None where the side is the seam to another part, or an end of it.
    pub(crate) fn split_edge(&mut self, t: u32, k: usize, made: &mut Vec<u32>) -> Option<u32> {
        let tri = self.tri[t as usize];
        let (apex, from, to) = (tri.v[k], tri.v[(k + 1) % 3], tri.v[(k + 2) % 3]);
        let (p, q) = (self.pos[from as usize], self.pos[to as usize]);
        let mut mid = 0.5 * (p + q);
        let mut motion = Motion::Free;
        let mut bound: &[[u32; 2]] = &[];
        let beyond = self.pair(t, k);
        if beyond.is_none() && [from, to].iter().all(|v| self.motion[*v as usize] == Motion::Frozen) {
            return None;
        }
        if tri.is_bound(k) {
            let line = self.line_between(from, to)?;
            mid = self.nearest_on(line, mid);
            motion = Motion::On(line);
        } else if beyond.is_none() {
            motion = Motion::Along((q - p).normalize());
        }
        let sector = if beyond.is_none() { std::f64::consts::PI } else { std::f64::consts::TAU };
        let m = self.add_vertex(mid, motion, sector);
        let halves = [[from, m], [m, to]];
        if tri.is_bound(k) {
            bound = &halves;
        }
        match beyond {
            Some((u, [_, _, _, far])) => {
                let new = [[apex, from, m], [apex, m, to], [far, m, from], [far, to, m]];
                self.replace_bound(&[t, u], &new, bound, made);
            }
            None => self.replace_bound(&[t], &[[apex, from, m], [apex, m, to]], bound, made),
        }
        Some(m)
    }

    /// The segment that an edge is part of.
    pub(crate) fn line_between(&self, a: u32, b: u32) -> Option<u32> {
        let ends = [a, b].map(|v| self.pos[v as usize]);
        line_between(&self.lines, [a, b].map(|v| self.source(v)), ends)
    }

    /// The point of a segment nearest to `p`, rounded.
    pub(crate) fn nearest_on(&self, line: u32, p: DVec2) -> DVec2 {
        self.lines[line as usize].nearest(p)
    }
}

fn has_side(v: [u32; 3], from: u32, to: u32) -> bool {
    (0..3).any(|k| v[k] == from && v[(k + 1) % 3] == to)
}
