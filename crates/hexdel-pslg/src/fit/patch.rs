//! A bad triangle and its surroundings, as far as they may change.

use super::judge::{Judge, LEAST_DEGREE};
use super::levenberg::Levenberg;
use crate::net::{Kind, Net};

/// Vertices that may move, and the triangles around them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Patch {
    pub(crate) movable: Vec<u32>,
    pub(crate) tris: Vec<u32>,
}

impl Patch {
    /// The vertices within `reach` edges of a triangle, and at most `ring`
    /// edges from a point or segment.
    pub(crate) fn around(net: &Net, t: u32, reach: u32, ring: u32) -> Self {
        let mut vertices = net.tri(t).v.to_vec();
        let mut star = Vec::new();
        let mut done = 0;
        for _ in 0..reach {
            let end = vertices.len();
            for i in done..end {
                net.star(vertices[i], &mut star);
                for w in star.iter().flat_map(|&t| net.tri(t).v) {
                    if !vertices.contains(&w) {
                        vertices.push(w);
                    }
                }
            }
            done = end;
        }
        vertices.retain(|&v| {
            let vertex = net.vertex(v);
            vertex.ring <= ring && matches!(vertex.kind, Kind::Free | Kind::Along { .. })
        });
        let mut tris = vec![t];
        for &v in &vertices {
            net.star(v, &mut star);
            tris.extend(&star);
        }
        tris.sort_unstable();
        tris.dedup();
        Self { movable: vertices, tris }
    }

    /// The same after changes that touched some triangles and made vertices.
    pub(crate) fn after(&self, net: &Net, touched: &[u32], first_new: u32) -> Self {
        let gone = |&v: &u32| net.vertex(v).kind != Kind::Gone;
        let movable = self.movable.iter().copied().filter(gone).chain(first_new..net.vertex_count());
        let mut tris: Vec<u32> =
            self.tris.iter().chain(touched).copied().filter(|&t| net.tri(t).alive()).collect();
        tris.sort_unstable();
        tris.dedup();
        Self { movable: movable.collect(), tris }
    }

    /// Flips edges inside of the patch as long as that makes it better.
    pub(crate) fn flip(&self, net: &mut Net, judge: Judge<'_>) {
        // Each pass lowers the penalty; a few find what there is to find.
        for _ in 0..4 {
            let mut any = false;
            for &t in &self.tris {
                for i in 0..3 {
                    any |= self.try_flip(net, judge, t, i);
                }
            }
            if !any {
                return;
            }
        }
    }

    fn try_flip(&self, net: &mut Net, judge: Judge<'_>, t: u32, i: usize) -> bool {
        let n = net.tri(t).n[i];
        if self.tris.binary_search(&n).is_err() {
            return false;
        }
        let before = judge.sum(net, &[t, n]);
        if before == 0.0 {
            return false;
        }
        let starves = |v: u32| net.vertex(v).kind == Kind::Free && net.degree(v) <= LEAST_DEGREE;
        if net.tri(t).edge(i).into_iter().any(starves) {
            return false;
        }
        let mark = net.mark();
        // The numbers of both triangles are used again.
        if net.flip(t, i) {
            if judge.sum(net, &[t, n]) < before {
                return true;
            }
            net.rollback(mark);
        }
        false
    }

    /// Flips and moves, once or twice. Returns the penalty of the patch.
    pub(crate) fn improve(&self, net: &mut Net, judge: Judge<'_>, solver: &mut Levenberg) -> f64 {
        let mut left = f64::INFINITY;
        for _ in 0..2 {
            self.flip(net, judge);
            solver.run(net, judge, &self.movable, &self.tris, 25);
            left = judge.sum(net, &self.tris);
            if left == 0.0 {
                break;
            }
        }
        left
    }
}
