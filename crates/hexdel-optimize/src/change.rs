//! Candidate changes of topology near a triangle, and their ranking.
//!
//! Every change replaces a few triangles that form a disc. Its rank is known
//! without touching the mesh: how much room the new degrees leave, and how
//! far the new triangles are outside the bounds as they stand.

use hexdel_geom::DVec2;

use crate::angles::Measure;
use crate::constraints::Rules;
use crate::mesh::{Mesh, Motion, NONE};
use crate::refill::{Corner, MAX_CORNERS, Refills};
use crate::segment::SegmentHole;

/// What is done to the disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Action {
    /// The disc around this vertex is refilled without it.
    Remove { vertex: u32, refill: usize },
    /// The disc gets a new vertex joined to its whole outline.
    Insert { disc: [u32; 6], len: usize, at: DVec2 },
    /// The disc around this vertex on a segment is refilled without it.
    Dissolve { vertex: u32 },
    /// The side opposite a corner, on a segment, gets a vertex in the middle.
    Split { triangle: u32, corner: usize },
    /// The side opposite a corner is exchanged for the other diagonal.
    Flip { triangle: u32, corner: usize },
}

impl Action {
    /// The vertices around which the change happens.
    pub(crate) fn region(self, mesh: &Mesh, verts: &mut Vec<u32>) {
        verts.clear();
        match self {
            Self::Remove { vertex, .. } | Self::Dissolve { vertex } => {
                mesh.ring(vertex, &mut Vec::new(), verts);
                verts.push(vertex);
            }
            Self::Flip { triangle, corner } => {
                if let Some((_, d)) = mesh.diamond(triangle, corner) {
                    verts.extend(d);
                }
            }
            Self::Split { triangle, .. } => verts.extend(mesh.tri[triangle as usize].v),
            Self::Insert { disc, len, .. } => {
                verts.extend(outline(mesh, &disc[..len]).unwrap_or_default());
            }
        }
    }
}

/// A change and its rank; less is better.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Change {
    pub(crate) cost: f64,
    pub(crate) action: Action,
}

/// What a vertex with two triangles on a side of a segment costs: as in
/// `refill`, for the room that one of three triangles leaves.
const SPLIT_COST: f64 = 0.1;

/// Weight of the squared angles outside, as in `refill`.
const SHAPE_WEIGHT: f64 = 0.1;

/// Lists changes near triangle `t`.
pub(crate) struct Finder<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) rules: &'a Rules<'a>,
    pub(crate) refills: &'a Refills,
    pub(crate) out: &'a mut Vec<Change>,
}

impl Finder<'_> {
    /// All changes at `t` and the removals of the vertices `around` it, best
    /// first.
    pub(crate) fn find(&mut self, t: u32, around: &[u32]) {
        self.out.clear();
        let tri = self.mesh.tri[t as usize];
        for &v in around {
            self.removals(v);
            self.dissolutions(v);
        }
        for k in 0..3 {
            self.flips(t, k);
            self.splits(t, k);
            let n = tri.n[k];
            for j in (0..3).filter(|_| n != NONE) {
                if self.mesh.tri[n as usize].n[j] != t {
                    self.flips(n, j);
                    self.splits(n, j);
                }
            }
        }
        self.all_insertions(t);
        self.sort();
    }

    /// The insertions near `t`, best first.
    pub(crate) fn find_insertions(&mut self, t: u32) {
        self.out.clear();
        self.all_insertions(t);
        self.sort();
    }

    fn sort(&mut self) {
        // Stable: equal costs keep the order in which they were found.
        self.out.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    }

    fn all_insertions(&mut self, t: u32) {
        let beyond = self.mesh.tri[t as usize].n;
        for n in beyond.into_iter().filter(|n| *n != NONE) {
            self.insertions([t, n]);
        }
        if !beyond.contains(&NONE) {
            self.insertion(&[t, beyond[0], beyond[1], beyond[2]]);
        }
    }

    /// The change of cost at corner `v` of triangle `t` when it gets so many
    /// triangles more.
    fn cost_at(&self, v: u32, t: u32, more: isize) -> f64 {
        Corner::of(self.mesh, self.rules, v, t)
            .map_or(0.0, |c| c.cost(c.degree.saturating_add_signed(more)) - c.cost(c.degree))
    }

    /// What the angles of triangle `t` are outside.
    fn energy(&self, t: u32) -> f64 {
        let place = self.mesh.place(t);
        let limits = self.rules.limits(place);
        limits.energy(&place.view(self.mesh.measure(t), limits))
    }

    fn removals(&mut self, v: u32) {
        if self.mesh.motion[v as usize] != Motion::Free {
            return;
        }
        let (mut tris, mut ring) = (Vec::new(), Vec::new());
        let closed = self.mesh.ring(v, &mut tris, &mut ring);
        if !closed || ring.len() > MAX_CORNERS {
            return;
        }
        let mut chosen = Vec::new();
        self.refills.choose(self.mesh, self.rules, (&tris, &ring), closed, 2, &mut chosen);
        let now = |v, t| Corner::of(self.mesh, self.rules, v, t).map_or(0.0, |c| c.cost(c.degree));
        let before: f64 = ring.iter().zip(&tris).map(|(&w, &t)| now(w, t)).sum::<f64>() + now(v, tris[0]);
        let old: f64 = tris.iter().map(|&t| self.energy(t)).sum();
        for (cost, refill) in chosen {
            let cost = cost - before - SHAPE_WEIGHT * old;
            self.out.push(Change { cost, action: Action::Remove { vertex: v, refill } });
        }
    }

    fn dissolutions(&mut self, v: u32) {
        let Some(hole) = SegmentHole::of(self.mesh, v) else { return };
        if let Some(refill) = hole.refill(self.mesh, self.rules, self.refills) {
            self.out.push(Change { cost: refill.cost, action: Action::Dissolve { vertex: v } });
        }
    }

    /// Splits the side opposite corner `k`, if it is on a segment. Flips are to
    /// give the new vertex more than two triangles on each side.
    fn splits(&mut self, t: u32, k: usize) {
        let tri = self.mesh.tri[t as usize];
        if tri.is_bound(k) {
            let cost = SPLIT_COST + self.cost_at(tri.v[k], t, 1) - SHAPE_WEIGHT * self.energy(t);
            self.out.push(Change { cost, action: Action::Split { triangle: t, corner: k } });
        }
    }

    fn flips(&mut self, t: u32, k: usize) {
        let Some((u, d)) = self.mesh.diamond(t, k) else {
            return;
        };
        if !self.mesh.can_flip(d) {
            return;
        }
        let mut cost = 0.0;
        for (i, v) in d.into_iter().enumerate() {
            cost += self.cost_at(v, if i == 3 { u } else { t }, if i == 0 || i == 3 { 1 } else { -1 });
        }
        let [a, b, c, f] = d.map(|v| self.mesh.pos[v as usize]);
        let limits = self.rules.limits(self.mesh.place(t));
        let shape = limits.energy(&Measure::of(a, b, f)) + limits.energy(&Measure::of(f, c, a));
        cost += SHAPE_WEIGHT * (shape - self.energy(t) - self.energy(u));
        self.out.push(Change { cost, action: Action::Flip { triangle: t, corner: k } });
    }

    /// All discs that add one to three neighbours to `base`.
    fn insertions(&mut self, base: [u32; 2]) {
        let mut beyond = Vec::new();
        for t in base {
            for n in self.mesh.tri[t as usize].n {
                if n != NONE && !base.contains(&n) && !beyond.contains(&n) {
                    beyond.push(n);
                }
            }
        }
        for mask in 1u32..1 << beyond.len() {
            if mask.count_ones() <= 3 {
                let mut disc = base.to_vec();
                disc.extend((0..beyond.len()).filter(|i| mask >> i & 1 == 1).map(|i| beyond[i]));
                self.insertion(&disc);
            }
        }
    }

    fn insertion(&mut self, disc: &[u32]) {
        let Some(outline) = outline(self.mesh, disc) else {
            return;
        };
        let at = outline.iter().map(|&v| self.mesh.pos[v as usize]).sum::<DVec2>() / outline.len() as f64;
        let limits = self.rules.limits(self.mesh.place(disc[0]));
        let mut cost = Corner::inside(limits).cost(outline.len());
        let mut shape = 0.0;
        for (i, &v) in outline.iter().enumerate() {
            let has = |t: &&u32| self.mesh.tri[**t as usize].v.contains(&v);
            let inside = disc.iter().filter(has).count();
            let some = disc.iter().find(has).copied().unwrap_or(disc[0]);
            cost += self.cost_at(v, some, 2 - inside as isize);
            let w = outline[(i + 1) % outline.len()];
            shape += limits.energy(&Measure::of(at, self.mesh.pos[v as usize], self.mesh.pos[w as usize]));
        }
        let old: f64 = disc.iter().map(|&t| self.energy(t)).sum();
        cost += SHAPE_WEIGHT * (shape - old);
        if cost < 100.0 {
            let mut d = [NONE; 6];
            d[..disc.len()].copy_from_slice(disc);
            self.out.push(Change { cost, action: Action::Insert { disc: d, len: disc.len(), at } });
        }
    }
}

/// The outline of a disc of triangles, counter-clockwise; none where it passes
/// a vertex twice, a segment goes through it, or it is no disc.
pub(crate) fn outline(mesh: &Mesh, disc: &[u32]) -> Option<Vec<u32>> {
    let mut sides = Vec::with_capacity(disc.len() + 2);
    for &t in disc {
        let tri = mesh.tri[t as usize];
        for k in 0..3 {
            if disc.contains(&tri.n[k]) {
                if tri.is_bound(k) {
                    return None;
                }
            } else {
                sides.push((tri.v[(k + 1) % 3], tri.v[(k + 2) % 3]));
            }
        }
    }
    if sides.len() != disc.len() + 2 {
        return None;
    }
    let mut loop_ = vec![sides[0].0];
    let mut at = sides[0].1;
    while at != sides[0].0 {
        if loop_.contains(&at) {
            return None;
        }
        loop_.push(at);
        at = sides.iter().find(|s| s.0 == at)?.1;
    }
    (loop_.len() == sides.len()).then_some(loop_)
}

/// Makes the change; the vertices whose motion should settle it are put into
/// `verts`. False, and nothing changed, where the topology forbids it.
pub(crate) fn apply(
    mesh: &mut Mesh,
    (rules, refills): (&Rules<'_>, &Refills),
    action: Action,
    verts: &mut Vec<u32>,
) -> bool {
    verts.clear();
    let mut made = Vec::new();
    match action {
        Action::Remove { vertex, refill } => {
            let mut tris = Vec::new();
            let closed = mesh.ring(vertex, &mut tris, verts);
            let mut new = Vec::new();
            if !refills.triangles(mesh, verts, closed, refill, &mut new) {
                return false;
            }
            mesh.replace(&tris, &new, &mut made);
        }
        Action::Dissolve { vertex } => {
            let Some(hole) = SegmentHole::of(mesh, vertex) else { return false };
            let Some(refill) = hole.refill(mesh, rules, refills) else { return false };
            hole.fill(mesh, &refill);
            verts.extend(hole.ring());
        }
        Action::Split { triangle, corner } => {
            verts.extend(mesh.tri[triangle as usize].v);
            let Some(v) = mesh.split_edge(triangle, corner, &mut made) else { return false };
            mesh.ring(v, &mut Vec::new(), verts);
            verts.push(v);
        }
        Action::Flip { triangle, corner } => {
            let Some((_, d)) = mesh.diamond(triangle, corner) else {
                return false;
            };
            verts.extend(d);
            return mesh.flip(triangle, corner);
        }
        Action::Insert { disc, len, at } => {
            let Some(outline) = outline(mesh, &disc[..len]) else {
                return false;
            };
            let v = mesh.add_vertex(at, Motion::Free, std::f64::consts::TAU);
            let n = outline.len();
            let new: Vec<[u32; 3]> = (0..n).map(|i| [v, outline[i], outline[(i + 1) % n]]).collect();
            mesh.replace(&disc[..len], &new, &mut made);
            verts.push(v);
            verts.extend(outline);
        }
    }
    true
}
