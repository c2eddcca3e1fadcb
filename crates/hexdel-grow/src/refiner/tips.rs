//! Narrow corners of the input inside the mesh: their tips are cut off by isosceles triangles that stay.
//!
//! ```text
//!          o-----------      o  at one distance, a power of two, on all segments that meet in A
//!        / |
//!      A   |   =             the triangle at A stays; on goes the mesh from its base
//!        \ |
//!          o-----------
//! ```
//!
//! Without them a vertex on one segment asks for one on the other, nearer to the corner, and so on.

use hexdel_geom::{DVec2, orient2d};
use hexdel_optimize::edit::{Kind, LOCKED, NONE, next, prev};

use super::Refiner;
use super::split::power_of_two;

/// The radius of a tip over the length of the shortest segment at the corner, and over the distance of anything else.
const REACH: f64 = 0.7;

/// The least of the distance of anything else that counts, in lengths of the shortest segment.
const LEAST: f64 = 1e-3;

/// The radii at both ends of a segment over its length.
const SHARED: f64 = 0.9;

/// A corner of the input with a narrow sector.
struct Tip {
    apex: u32,
    radius: f64,
    /// The ends of all edges of segments at the apex, each once.
    ends: Vec<u32>,
    /// Pairs of them, clockwise and counter-clockwise, with a narrow sector between.
    narrow: Vec<[u32; 2]>,
}

impl Refiner<'_> {
    /// Cuts the tips off. `shrink` says how much smaller than usual the radius at a vertex is.
    pub(crate) fn protect(&mut self, shrink: &dyn Fn(u32) -> f64) {
        let fixed = (0..self.mesh.pos.len() as u32).filter(|&v| self.mesh.kind[v as usize] == Kind::Fixed);
        let mut tips: Vec<Tip> = fixed.filter_map(|v| self.tip(v, shrink)).collect();
        if tips.is_empty() {
            return;
        }
        let mut of_vertex = vec![NONE; self.mesh.pos.len()];
        for (i, tip) in tips.iter().enumerate() {
            of_vertex[tip.apex as usize] = i as u32;
        }
        self.share(&mut tips, &of_vertex);
        let mut made: Vec<Vec<u32>> = Vec::with_capacity(tips.len());
        for i in 0..tips.len() {
            let mut ring = vec![NONE; tips[i].ends.len()];
            for (k, at) in ring.iter_mut().enumerate() {
                let end = tips[i].ends[k];
                let Some(v) = self.cut(tips[i].apex, end, tips[i].radius) else { continue };
                *at = v;
                // The same edge from the other end leads here by now.
                let other = of_vertex.get(end as usize).copied().unwrap_or(NONE);
                if other != NONE && other as usize > i {
                    Self::redirect(&mut tips, other as usize, i, v);
                }
            }
            made.push(ring);
        }
        self.restore_delaunay();
        for (tip, made) in tips.iter().zip(&made) {
            self.lock(tip, made);
        }
    }

    /// The input's corners whose tips have a bad triangle beside them: their radii were too large.
    pub(crate) fn stuck(&self, inputs: u32) -> Vec<u32> {
        let mut stuck = Vec::new();
        for t in self.mesh.triangles().filter(|&t| self.is_bad(t)) {
            let corners = 3 * t..3 * t + 3;
            let beyond =
                corners.clone().filter(|&c| self.mesh.is_locked(c)).map(|c| self.mesh.twin[c as usize]);
            let beyond: Vec<u32> = beyond.filter(|&c| c != NONE).collect();
            if beyond.is_empty() {
                continue;
            }
            let near = beyond.into_iter().chain(corners).map(|c| self.mesh.v(c));
            stuck.extend(near.filter(|&v| v < inputs && self.mesh.kind[v as usize] == Kind::Fixed));
        }
        stuck.sort_unstable();
        stuck.dedup();
        stuck
    }

    /// The narrow sectors of the mesh at a vertex.
    fn tip(&self, v: u32, shrink: &dyn Fn(u32) -> f64) -> Option<Tip> {
        if self.mesh.corner_of[v as usize] == NONE {
            return None;
        }
        let start = self.first_corner(v);
        let (ends, narrow, clear_sq, locked) = self.around(v, start);
        if narrow.is_empty() || locked {
            return None;
        }
        let at = self.mesh.at(v);
        let shortest = ends.iter().map(|&w| self.mesh.at(w).distance(at)).fold(f64::MAX, f64::min);
        let clear = clear_sq.sqrt().max(LEAST * shortest);
        let radius = shrink(v) * power_of_two(REACH * shortest.min(clear).min(self.aim_at(at)));
        Some(Tip { apex: v, radius, ends, narrow })
    }

    /// The corner of a vertex to begin a round at: after the outline, or else after a marked edge.
    fn first_corner(&self, v: u32) -> u32 {
        let first = self.mesh.corner_of[v as usize];
        let (mut c, mut found) = (first, first);
        loop {
            if self.mesh.is_marked(prev(c)) {
                found = c;
            }
            let beyond = self.mesh.twin[prev(c) as usize];
            if beyond == NONE {
                return c;
            }
            c = prev(beyond);
            if c == first {
                return found;
            }
        }
    }

    /// Counter-clockwise from a corner: ends of marked edges, narrow sectors, the squared distance of anything else, and
    /// whether an edge is locked.
    fn around(&self, v: u32, start: u32) -> (Vec<u32>, Vec<[u32; 2]>, f64, bool) {
        let mesh = &self.mesh;
        let at = mesh.at(v);
        let (mut ends, mut narrow, mut clear_sq, mut locked) = (Vec::new(), Vec::new(), f64::MAX, false);
        let (mut c, mut from) = (start, NONE);
        let mut note = |ends: &mut Vec<u32>, side: u32, end: u32| {
            locked |= mesh.is_locked(side);
            if !ends.contains(&end) {
                ends.push(end);
            }
        };
        loop {
            let [a, b] = [next(c), prev(c)].map(|c| mesh.v(c));
            if mesh.is_marked(prev(c)) {
                note(&mut ends, prev(c), a);
                from = a;
            } else {
                clear_sq = clear_sq.min(mesh.at(a).distance_squared(at));
            }
            if mesh.is_marked(c) {
                clear_sq = clear_sq.min(distance_sq(at, mesh.at(a), mesh.at(b)));
            }
            if mesh.is_marked(next(c)) {
                note(&mut ends, next(c), b);
                if from != NONE && from != b && self.is_narrow(at, mesh.at(from), mesh.at(b)) {
                    narrow.push([from, b]);
                }
            } else {
                clear_sq = clear_sq.min(mesh.at(b).distance_squared(at));
            }
            let beyond = mesh.twin[next(c) as usize];
            if beyond == NONE || next(beyond) == start {
                return (ends, narrow, clear_sq, locked);
            }
            c = next(beyond);
        }
    }

    fn is_narrow(&self, at: DVec2, a: DVec2, b: DVec2) -> bool {
        let (u, w) = (a - at, b - at);
        let (dot, cross) = (u.dot(w), u.perp_dot(w));
        cross > 0.0 && dot > self.limits.lo * cross
    }

    /// Two tips on one segment share its length.
    fn share(&self, tips: &mut [Tip], of_vertex: &[u32]) {
        for _ in 0..4 {
            for i in 0..tips.len() {
                for k in 0..tips[i].ends.len() {
                    let end = tips[i].ends[k];
                    let other = of_vertex[end as usize] as usize;
                    if other >= tips.len() {
                        continue;
                    }
                    let length = self.mesh.at(tips[i].apex).distance(self.mesh.at(end));
                    while tips[i].radius + tips[other].radius > SHARED * length {
                        let larger = if tips[i].radius > tips[other].radius { i } else { other };
                        tips[larger].radius *= 0.5;
                    }
                }
            }
        }
    }

    /// The end of another tip's edge has come nearer.
    fn redirect(tips: &mut [Tip], other: usize, tip: usize, nearer: u32) {
        let apex = tips[tip].apex;
        let tip = &mut tips[other];
        let ends = tip.ends.iter_mut().chain(tip.narrow.iter_mut().flatten());
        for end in ends.filter(|end| **end == apex) {
            *end = nearer;
        }
    }

    /// A vertex on an edge at a distance from its start.
    fn cut(&mut self, apex: u32, end: u32, radius: f64) -> Option<u32> {
        let edge = self.mesh.star(apex).find_map(|c| {
            let to = |side: u32| self.mesh.v(side) == end;
            if to(next(c)) { Some(prev(c)) } else { to(prev(c)).then(|| next(c)) }
        })?;
        let segment = self.mesh.segment(edge).filter(|_| !self.mesh.is_locked(edge))?;
        let (a, b) = (self.mesh.at(apex), self.mesh.at(end));
        let at = self.on_segment(segment, a + (radius / a.distance(b)) * (b - a));
        let cavity = self.mesh.cavity_on(edge);
        let twin = self.mesh.twin[edge as usize];
        let other = (twin != NONE).then(|| self.mesh.cavity_on(twin));
        let turned = |c: &hexdel_optimize::edit::Cavity| {
            let ring = c.ring();
            (1..ring.len())
                .any(|i| orient2d(self.mesh.at(ring[i]), self.mesh.at(ring[c.after(i)]), at) <= 0.0)
        };
        if turned(&cavity) || other.as_ref().is_some_and(turned) {
            return None;
        }
        let mut slots = std::mem::take(&mut self.slots);
        let v = self.mesh.refill(&cavity, other.as_ref(), at, Kind::Fixed, &mut slots);
        self.slots = slots;
        Some(v)
    }

    /// Locks the triangles between the apex and two vertices beside a narrow sector, if they are there.
    fn lock(&mut self, tip: &Tip, made: &[u32]) {
        let vertex = |end: u32| tip.ends.iter().position(|&e| e == end).map(|k| made[k]);
        for [a, b] in &tip.narrow {
            let (Some(a), Some(b)) = (vertex(*a), vertex(*b)) else { continue };
            let between =
                |&c: &u32| self.mesh.v(next(c)) == a && self.mesh.v(prev(c)) == b && a != NONE && b != NONE;
            let Some(base) = self.mesh.star(tip.apex).find(between) else { continue };
            self.stats.tips += 1;
            for c in [base, next(base), prev(base)] {
                self.mesh.set_mark(c, self.mesh.mark[c as usize] | LOCKED);
            }
        }
    }

    /// Flips what is not Delaunay, everywhere.
    pub(super) fn restore_delaunay(&mut self) {
        let mut stack: Vec<u32> =
            (0..self.mesh.vertex.len() as u32).filter(|c| self.mesh.alive(c / 3)).collect();
        let mut most = 100 * stack.len();
        while let Some(c) = stack.pop() {
            if most == 0 {
                break;
            }
            most -= 1;
            if self.may_flip(c) {
                for t in self.mesh.flip(c) {
                    stack.extend(3 * t..3 * t + 3);
                }
            }
        }
    }
}

/// Squared distance of a point from a segment.
fn distance_sq(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let e = b - a;
    let t = ((p - a).dot(e) / e.length_squared()).clamp(0.0, 1.0);
    p.distance_squared(a + t * e)
}
