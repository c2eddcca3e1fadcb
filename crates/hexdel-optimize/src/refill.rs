//! Which triangles close the hole a removed vertex leaves.
//!
//! All triangulations of the hole are compared (Catalan's number of them: 132
//! for eight corners). What decides whether motion can bring the angles
//! inside is mostly the number of triangles at each vertex: `n` triangles in a
//! sector of angle `a` need `min <= a / n <= max`, and the nearer `a / n` is
//! to either bound, the less room is left for the neighbours.

use hexdel_geom::AngleBounds;

use crate::angles::{Limits, Measure};
use crate::constraints::Rules;
use crate::mesh::Mesh;

/// Holes with more corners are left alone: in bounds above 40 degrees a vertex
/// has at most nine triangles, and removing one that has more than eight
/// never helps its neighbours.
pub(crate) const MAX_CORNERS: usize = 8;

/// Weight of the squared angles outside the bounds, now, against the cost of
/// degrees; measured.
const SHAPE_WEIGHT: f64 = 0.1;

/// Cost of a vertex with as many triangles as its sector cannot hold.
const IMPOSSIBLE: f64 = 1e3;

/// All triangulations of convex polygons.
#[derive(Clone, Debug)]
pub(crate) struct Refills {
    /// Entry `n`: the triangulations of `n` corners, each `n - 2` triples.
    of: Vec<Vec<Vec<[u8; 3]>>>,
}

impl Refills {
    pub(crate) fn new() -> Self {
        let of = (0..=MAX_CORNERS).map(|n| if n < 3 { Vec::new() } else { fans(0, n - 1) }).collect();
        Self { of }
    }

    /// The cheapest `keep` refills of the hole that the triangles `tris` around
    /// a vertex leave, cheapest first. Its corners `ring` are in
    /// counter-clockwise order; `closed` says whether it surrounds the vertex
    /// or ends at the rim or at a segment.
    pub(crate) fn choose(
        &self,
        mesh: &Mesh,
        rules: &Rules<'_>,
        (tris, ring): (&[u32], &[u32]),
        closed: bool,
        keep: usize,
        out: &mut Vec<(f64, usize)>,
    ) {
        out.clear();
        let n = ring.len();
        let shape = shapes(mesh, rules.limits(mesh.place(tris[0])), ring);
        let costs: [[f64; MAX_CORNERS - 1]; MAX_CORNERS] = std::array::from_fn(|i| {
            let of = |v: u32| Corner::of(mesh, rules, v, tris[i.min(tris.len() - 1)]);
            let Some(corner) = ring.get(i).and_then(|&v| of(v)) else { return [0.0; MAX_CORNERS - 1] };
            let end = !closed && (i == 0 || i == n - 1);
            let left = corner.degree - if end { 1 } else { 2 };
            std::array::from_fn(|more| if more + 2 < n { corner.cost(left + more + 1) } else { 0.0 })
        });
        for (index, tris) in self.of[n].iter().enumerate() {
            let mut added = [0usize; MAX_CORNERS];
            let mut cost = 0.0;
            for t in tris {
                for &c in t {
                    added[usize::from(c)] += 1;
                }
                cost += shape[rank(t.map(usize::from))];
            }
            cost *= SHAPE_WEIGHT;
            for (costs, added) in costs.iter().zip(&added[..n]) {
                cost += costs[added - 1];
            }
            if cost < IMPOSSIBLE {
                out.push((cost, index));
            }
        }
        out.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        out.truncate(keep);
    }

    /// How many refills a ring of so many corners has.
    #[cfg(test)]
    pub(crate) fn count(&self, corners: usize) -> usize {
        self.of[corners].len()
    }

    /// The triangles of refill `index` of a ring, or none where one of its
    /// diagonals is an edge elsewhere.
    pub(crate) fn triangles(
        &self,
        mesh: &Mesh,
        ring: &[u32],
        closed: bool,
        index: usize,
        out: &mut Vec<[u32; 3]>,
    ) -> bool {
        out.clear();
        let n = ring.len();
        for t in &self.of[n][index] {
            for k in 0..3 {
                let (i, j) = (usize::from(t[k]), usize::from(t[(k + 1) % 3]));
                let (i, j) = (i.min(j), i.max(j));
                let side = j == i + 1 || (closed && i == 0 && j == n - 1);
                if !side && mesh.adjacent(ring[i], ring[j]) {
                    return false;
                }
            }
            out.push(t.map(|c| ring[usize::from(c)]));
        }
        true
    }
}

/// The triangulations of corners `a..=b`.
fn fans(a: usize, b: usize) -> Vec<Vec<[u8; 3]>> {
    if b < a + 2 {
        return vec![Vec::new()];
    }
    let mut all = Vec::new();
    for m in a + 1..b {
        for left in fans(a, m) {
            for right in fans(m, b) {
                let mut t = left.clone();
                t.extend(right);
                t.push([a as u8, m as u8, b as u8]);
                all.push(t);
            }
        }
    }
    all
}

/// What the triangle of each three corners of the ring is outside, by [`rank`].
fn shapes(mesh: &Mesh, limits: &Limits, ring: &[u32]) -> [f64; TRIPLES] {
    let mut shape = [0.0; TRIPLES];
    let p = |i: usize| mesh.pos[ring[i] as usize];
    for k in 2..ring.len() {
        for j in 1..k {
            for i in 0..j {
                shape[rank([i, j, k])] = limits.energy(&Measure::of(p(i), p(j), p(k)));
            }
        }
    }
    shape
}

/// How many three corners of a hole there are.
const TRIPLES: usize = MAX_CORNERS * (MAX_CORNERS - 1) * (MAX_CORNERS - 2) / 6;

/// The place of three ascending numbers among all, in the order of the last, then
/// the second, then the first.
#[inline]
fn rank([i, j, k]: [usize; 3]) -> usize {
    k * (k - 1) * (k - 2) / 6 + j * (j - 1) / 2 + i
}

/// A corner of a hole or triangle, between the segments or sides that enclose
/// it.
pub(crate) struct Corner<'a> {
    limits: &'a Limits,
    /// Angle between the segments, radians; a full turn if there are none.
    sector: f64,
    /// Triangles between them.
    pub(crate) degree: usize,
}

impl<'a> Corner<'a> {
    /// Corner `v` of triangle `t`; none where a seam hides what encloses it.
    #[inline]
    pub(crate) fn of(mesh: &Mesh, rules: &'a Rules<'_>, v: u32, t: u32) -> Option<Self> {
        let (sector, degree) = mesh.room(v, t)?;
        Some(Self { limits: rules.limits_at(mesh, v), sector, degree })
    }

    /// That of a vertex with nothing around it.
    pub(crate) fn inside(limits: &'a Limits) -> Self {
        Self { limits, sector: std::f64::consts::TAU, degree: 0 }
    }

    /// What it costs to have so many triangles.
    #[inline]
    pub(crate) fn cost(&self, degree: usize) -> f64 {
        degree_cost(self.limits, self.sector, degree)
    }
}

/// How little room `degree` triangles leave in a sector: the inverse of the
/// distance of their mean angle to the bounds, in degrees, plus one.
pub(crate) fn degree_cost(limits: &Limits, sector: f64, degree: usize) -> f64 {
    if degree == 1 && sector <= limits.max_rad {
        // The angle between two segments is what it is.
        return 0.0;
    }
    let mean = sector / degree as f64;
    // A sector's angle carries the rounding of an arc cosine.
    let room = (mean - limits.min_rad).min(limits.max_rad - mean) + 1e-9;
    if room < 0.0 { IMPOSSIBLE } else { 1.0 / (room.to_degrees() + 1.0) }
}

/// How many times what it costs at [`AngleBounds::EXTENDED`] five, six and seven
/// triangles cost at a vertex; no less than 1, as nothing is gained by trying less at
/// wider bounds, and no more than 3.
pub(crate) fn tightness(limits: &Limits) -> f64 {
    let usual = |l: &Limits| (5..=7).map(|degree| degree_cost(l, std::f64::consts::TAU, degree)).sum::<f64>();
    (usual(limits) / usual(&Limits::new(AngleBounds::EXTENDED))).clamp(1.0, 3.0)
}
