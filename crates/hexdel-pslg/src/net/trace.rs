//! The way of a segment through the triangles, and its recovery by flips
//! (Sloan, "A fast algorithm for generating constrained Delaunay
//! triangulations", 1993).

use super::{Kind, NONE, Net};
use hexdel_geom::{DVec2, incircle};

/// Free vertices exactly on an edge to be that are taken out of its way.
const IN_THE_WAY: usize = 16;

/// What a segment meets on its way from a vertex.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Trace {
    /// A vertex, after crossing some edges, none of them constrained.
    Vertex {
        /// The vertex: where the segment ends, or one exactly on it before.
        vertex: u32,
        /// The edges crossed, each from right to left.
        crossed: Vec<[u32; 2]>,
    },
    /// A constrained edge that it crosses, from right to left.
    Blocked([u32; 2]),
    /// The rim.
    Lost,
}

impl Net {
    /// Follows the straight line from vertex `a` towards vertex `b`.
    pub(crate) fn trace(&self, a: u32, b: u32) -> Trace {
        let mut star = Vec::with_capacity(8);
        self.star(a, &mut star);
        let mut start = None;
        for &t in &star {
            let i = self.tri(t).corner(a).unwrap_or(0);
            let [right, left] = self.tri(t).edge(i);
            for next in [right, left] {
                if next == b || (self.orient(a, b, next) == 0.0 && self.is_ahead(a, b, next)) {
                    return Trace::Vertex { vertex: next, crossed: Vec::new() };
                }
            }
            if self.orient(a, b, right) < 0.0 && self.orient(a, b, left) > 0.0 {
                start = Some((t, i));
            }
        }
        match start {
            Some((t, i)) => self.follow(a, b, t, i),
            None => Trace::Lost,
        }
    }

    fn is_ahead(&self, a: u32, b: u32, v: u32) -> bool {
        (self.at(b) - self.at(a)).dot(self.at(v) - self.at(a)) > 0.0
    }

    fn follow(&self, a: u32, b: u32, mut t: u32, mut i: usize) -> Trace {
        let mut crossed = Vec::new();
        loop {
            let [right, left] = self.tri(t).edge(i);
            if self.tri(t).s[i] != NONE {
                return Trace::Blocked([right, left]);
            }
            crossed.push([right, left]);
            let Some((n, j)) = self.beyond(t, i) else { return Trace::Lost };
            let d = self.tri(n).v[j];
            let side = if d == b { 0.0 } else { self.orient(a, b, d) };
            if side == 0.0 {
                return Trace::Vertex { vertex: d, crossed };
            }
            // Out through the edge from the new corner to the one on the other
            // side of the line: opposite the one on its own side.
            let stays = if side > 0.0 { left } else { right };
            t = n;
            i = self.tri(n).corner(stays).expect("the next triangle has both corners of the shared edge");
        }
    }

    /// Makes `a b` an edge by flipping what it crosses, and part of a piece.
    /// `false` if the flips did not come to an end.
    pub(crate) fn recover(&mut self, a: u32, b: u32, crossed: Vec<[u32; 2]>, piece: u32) -> bool {
        let budget = 16 * crossed.len() * crossed.len() + 64;
        let mut queue: std::collections::VecDeque<_> = crossed.into();
        let mut made = Vec::new();
        for _ in 0..budget {
            let Some([p, q]) = queue.pop_front() else { break };
            let Some((t, i)) = self.find_edge(p, q) else { continue };
            let Some((_, [c, .., d])) = self.quad(t, i) else { return false };
            if !self.flip(t, i) {
                queue.push_back([p, q]);
                continue;
            }
            if self.cuts(a, b, c, d) { queue.push_back([c, d]) } else { made.push([c, d]) }
        }
        if !queue.is_empty() || self.find_either(a, b).is_none() {
            return false;
        }
        self.constrain(a, b, piece);
        self.relax(made);
        true
    }

    /// Makes `a b` an edge and part of a piece, without free vertices exactly on
    /// it. Returns whether edges had to be flipped for it, or where that failed.
    pub(crate) fn link(&mut self, a: u32, b: u32, piece: u32) -> Result<bool, DVec2> {
        for _ in 0..IN_THE_WAY {
            match self.trace(a, b) {
                Trace::Vertex { vertex, crossed } if vertex == b => {
                    let flips = !crossed.is_empty();
                    return if self.recover(a, b, crossed, piece) { Ok(flips) } else { Err(self.at(a)) };
                }
                Trace::Vertex { vertex, .. }
                    if self.vertex(vertex).kind == Kind::Free && self.remove(vertex) => {}
                Trace::Vertex { vertex, .. } => return Err(self.at(vertex)),
                Trace::Blocked([p, q]) => return Err(self.at(p).midpoint(self.at(q))),
                Trace::Lost => return Err(self.at(a)),
            }
        }
        Err(self.at(a))
    }

    /// Whether edge `c d` crosses the line from `a` to `b` between its ends.
    fn cuts(&self, a: u32, b: u32, c: u32, d: u32) -> bool {
        let ends = [a, b];
        if ends.contains(&c) || ends.contains(&d) {
            return false;
        }
        let (c, d) = (self.orient(a, b, c), self.orient(a, b, d));
        (c > 0.0 && d < 0.0) || (c < 0.0 && d > 0.0)
    }

    /// Lawson's flips from some edges on, with a budget.
    pub(crate) fn relax(&mut self, mut edges: Vec<[u32; 2]>) {
        let mut budget = 64 * edges.len() + 64;
        while let Some([a, b]) = edges.pop() {
            let Some((t, i)) = self.find_edge(a, b).filter(|_| budget > 0) else { continue };
            let Some((_, [c, p, q, d])) = self.quad(t, i) else { continue };
            budget -= 1;
            let inside = incircle(self.at(c), self.at(p), self.at(q), self.at(d)) > 0.0;
            if inside && self.flip(t, i) {
                edges.extend([[c, p], [p, c], [p, d], [d, p], [d, q], [q, d], [q, c], [c, q]]);
            }
        }
    }
}
