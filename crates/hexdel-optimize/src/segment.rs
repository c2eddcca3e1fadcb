//! Removing a vertex from a segment: each side of it is refilled by itself, and
//! the two neighbours on the segment are joined.

use crate::constraints::Rules;
use crate::mesh::{Mesh, Motion};
use crate::refill::{MAX_CORNERS, Refills};

/// The hole that a vertex on a segment leaves.
///
/// ```text
///       c---b                  c---b
///      /|\ /|\                / \ /|\        ring  p a b c q d
///     q-+-v-+-p   becomes    q---+---p       split 4, where q is
///      \ \|/ /                \  |  /
///       \-d-/                  \-d-/
/// ```
pub(crate) struct SegmentHole {
    /// Triangles around the vertex, from the first neighbour on the segment.
    tris: Vec<u32>,
    /// Vertices around it.
    ring: Vec<u32>,
    /// Where in the ring the other neighbour is. Triangles up to there lie on
    /// one side; the others, if there are any, on the other.
    split: usize,
}

/// What a hole is filled with.
pub(crate) struct SegmentRefill {
    /// As of [`Refills::choose`], the mean of the sides.
    pub(crate) cost: f64,
    pub(crate) tris: Vec<[u32; 3]>,
}

impl SegmentHole {
    /// The hole of `v`; none if it is on no segment, or has too many triangles.
    pub(crate) fn of(mesh: &Mesh, v: u32) -> Option<Self> {
        if !matches!(mesh.motion[v as usize], Motion::On(_)) {
            return None;
        }
        let (mut tris, mut ring) = (Vec::new(), Vec::new());
        let closed = mesh.ring(v, &mut tris, &mut ring);
        let mut split = ring.len() - 1;
        if closed {
            // The side from `v` to the ring's vertex `i` is opposite the next.
            let stays = |i: &usize| {
                let tri = mesh.tri[tris[*i] as usize];
                tri.is_bound((tri.corner(v) + 2) % 3)
            };
            let bound: Vec<usize> = (0..tris.len()).filter(stays).collect();
            let [first, second] = *bound else { return None };
            tris.rotate_left(first);
            ring.rotate_left(first);
            split = second - first;
        }
        let hole = Self { tris, ring, split };
        let fits = |(_, ring): &(&[u32], Vec<u32>)| (3..=MAX_CORNERS).contains(&ring.len());
        hole.sides().iter().all(fits).then_some(hole)
    }

    /// Triangles and corners of the hole on each side of the segment.
    fn sides(&self) -> Vec<(&[u32], Vec<u32>)> {
        let mut sides = vec![(&self.tris[..self.split], self.ring[..=self.split].to_vec())];
        if self.split < self.tris.len() {
            let mut ring = self.ring[self.split..].to_vec();
            ring.push(self.ring[0]);
            sides.push((&self.tris[self.split..], ring));
        }
        sides
    }

    /// The vertices around the hole.
    pub(crate) fn ring(&self) -> &[u32] {
        &self.ring
    }

    /// The cheapest refill; none where the topology or areas forbid all.
    pub(crate) fn refill(&self, mesh: &Mesh, rules: &Rules<'_>, refills: &Refills) -> Option<SegmentRefill> {
        let (mut cost, mut all) = (0.0, Vec::new());
        let (mut chosen, mut new) = (Vec::new(), Vec::new());
        let sides = self.sides();
        for (tris, ring) in &sides {
            if !rules.can_cover(mesh, tris, ring.len() - 2) {
                return None;
            }
            refills.choose(mesh, rules, (tris, ring), false, 1, &mut chosen);
            let &(least, index) = chosen.first()?;
            cost += least / sides.len() as f64;
            if !refills.triangles(mesh, ring, false, index, &mut new) {
                return None;
            }
            all.append(&mut new);
        }
        Some(SegmentRefill { cost, tris: all })
    }

    /// Fills the hole.
    pub(crate) fn fill(&self, mesh: &mut Mesh, refill: &SegmentRefill) {
        let joined = [self.ring[0], self.ring[self.split]];
        mesh.replace_bound(&self.tris, &refill.tris, &[joined], &mut Vec::new());
    }
}
