//! Which triangles surround a vertex, and how they hang together.
//!
//! A counting sort of the triangle corners by vertex: 12 bytes per triangle
//! and 4 per vertex, no hashing. Everything about an edge can be read off the
//! triangles around one of its ends, so no edge table is needed:
//!
//! ```text
//!        prev[i] = next[j]          triangle i = (v, next[i], prev[i])
//!         /   |   \                 triangle j = (v, next[j], prev[j])
//!        / j  |  i \                j is the successor of i: the next one
//!       /     |     \               counter-clockwise around v
//!   prev[j] - v - next[i]
//! ```
//!
//! Triangles with a corner that is no vertex, or the same corner twice, are
//! left out.

use crate::par::current_num_threads;
use crate::par::prelude::*;

use crate::mesh::{TriMesh, VertexId};

/// Whether the corners are three different vertices of a mesh of
/// `vertex_count`.
#[inline]
pub(crate) fn well_formed(corners: [VertexId; 3], vertex_count: usize) -> bool {
    let [a, b, c] = corners;
    a != b && b != c && c != a && corners.iter().all(|v| v.index() < vertex_count)
}

/// The triangles around each vertex, in increasing order.
#[derive(Clone, Debug)]
pub(crate) struct Incidence {
    /// Consecutive vertex ranges of `block_len` vertices (the last may be
    /// shorter).
    blocks: Vec<Block>,
    /// At least 1.
    block_len: usize,
}

#[derive(Clone, Debug)]
struct Block {
    /// For each vertex of the block the end of its run in `triangles`; not
    /// decreasing. The run starts where that of the vertex before ends.
    ends: Vec<u32>,
    /// Triangle indices, by vertex, increasing for each.
    triangles: Vec<u32>,
}

/// A block of its own for each thread is what parallelism can use; each block
/// reads all triangles, so that more of them cost more than they gain.
const MAX_BLOCKS: usize = 16;

/// Corners that a block can index: 6 per vertex on average, so 2^28 vertices
/// leave ample room below 2^32 (and see [`Incidence::new`]).
const MAX_BLOCK_LEN: usize = 1 << 28;

impl Incidence {
    /// The incidence of all well-formed triangles.
    ///
    /// The outcome does not depend on the number of threads.
    ///
    /// # Panics
    ///
    /// In debug builds, if the corners at 2^28 consecutive vertices exceed
    /// `u32::MAX`.
    pub(crate) fn new(mesh: &TriMesh) -> Self {
        let n = mesh.vertices.len();
        let threads = current_num_threads().clamp(1, MAX_BLOCKS);
        let block_len = n.div_ceil(threads).clamp(1, MAX_BLOCK_LEN);
        let blocks = (0..n.div_ceil(block_len))
            .into_par_iter()
            .map(|b| Block::new(mesh, b * block_len, block_len.min(n - b * block_len)))
            .collect();
        Self { blocks, block_len }
    }

    /// The triangles around vertex `v`, in increasing order.
    #[inline]
    pub(crate) fn around(&self, v: usize) -> &[u32] {
        let block = &self.blocks[v / self.block_len];
        let i = v % self.block_len;
        let start = if i == 0 { 0 } else { block.ends[i - 1] };
        &block.triangles[start as usize..block.ends[i] as usize]
    }
}

impl Block {
    fn new(mesh: &TriMesh, first: usize, len: usize) -> Self {
        let n = mesh.vertices.len();
        // Counts, then running starts, and once filled in the ends.
        let mut ends = vec![0_u32; len];
        for &corners in mesh.triangles.iter().filter(|&&t| well_formed(t, n)) {
            for v in corners {
                if let Some(count) = ends.get_mut(v.index().wrapping_sub(first)) {
                    *count += 1;
                }
            }
        }
        let mut total = 0_u64;
        for end in &mut ends {
            let count = *end;
            *end = total as u32;
            total += u64::from(count);
        }
        debug_assert!(u32::try_from(total).is_ok(), "too many corners for one block");
        let mut triangles = vec![0_u32; total as usize];
        for (t, &corners) in mesh.triangles.iter().enumerate().filter(|(_, t)| well_formed(**t, n)) {
            for v in corners {
                if let Some(end) = ends.get_mut(v.index().wrapping_sub(first)) {
                    triangles[*end as usize] = t as u32;
                    *end += 1;
                }
            }
        }
        Self { ends, triangles }
    }
}

/// No triangle follows: the edge is on the boundary.
pub(crate) const NONE: u32 = u32::MAX;

/// The triangles around one vertex and how they are joined.
#[derive(Default)]
pub(crate) struct Fan {
    /// Mesh indices of the triangles, increasing.
    pub(crate) triangles: Vec<u32>,
    /// For each triangle the corner after the vertex, counter-clockwise.
    pub(crate) next: Vec<u32>,
    /// For each triangle the corner before the vertex.
    pub(crate) prev: Vec<u32>,
    /// For each triangle the position (in `triangles`) of the first one whose
    /// `next` is its `prev`, or [`NONE`].
    pub(crate) successor: Vec<u32>,
    /// For each triangle the last one whose `successor` it is, or [`NONE`].
    predecessor: Vec<u32>,
    /// Whether the triangles are joined to one cycle, as inside a mesh. Then
    /// `predecessor`, `merging` and `sorted` are not filled.
    closed: bool,
    /// Whether a triangle is the successor of two.
    merging: bool,
    /// `next` with positions, sorted; filled for large fans only.
    sorted: Vec<(u32, u32)>,
}

/// Up to this many triangles, looking at all pairs beats sorting.
const SMALL_FAN: usize = 16;

/// The corners of a triangle after and before `v`.
#[inline]
fn ends(mesh: &TriMesh, v: usize, t: u32) -> (u32, u32) {
    let [a, b, c] = mesh.triangles[t as usize];
    let (next, prev) = match v {
        v if v == a.index() => (b, c),
        v if v == b.index() => (c, a),
        _ => (a, b),
    };
    (next.index() as u32, prev.index() as u32)
}

impl Fan {
    /// Makes this the fan of vertex `v` with the given triangles around it.
    pub(crate) fn load(&mut self, mesh: &TriMesh, v: usize, around: &[u32]) {
        self.triangles.clear();
        self.triangles.extend_from_slice(around);
        self.closed = around.len() <= SMALL_FAN && self.load_closed(mesh, v, around);
        if !self.closed {
            self.load_any(mesh, v, around);
        }
    }

    /// Loads a small fan and says whether it is one cycle.
    ///
    /// A walk from successor to successor that is back where it began after as
    /// many steps as there are triangles has passed them all. Each is then the
    /// successor of one, which none of two with the same `next` or `prev` would
    /// be: the fan is in order.
    fn load_closed(&mut self, mesh: &TriMesh, v: usize, around: &[u32]) -> bool {
        let n = around.len();
        let [mut next, mut prev, mut successor] = [[0; SMALL_FAN]; 3];
        for ((&t, next), prev) in around.iter().zip(&mut next).zip(&mut prev) {
            (*next, *prev) = ends(mesh, v, t);
        }
        let mut at = 0;
        for step in 1..=n {
            let Some(j) = next[..n].iter().position(|&w| w == prev[at]) else {
                return false;
            };
            successor[at] = j as u32;
            at = j;
            if at == 0 && step < n {
                return false;
            }
        }
        let fill = |into: &mut Vec<u32>, from: &[u32]| {
            into.clear();
            into.extend_from_slice(from);
        };
        fill(&mut self.next, &next[..n]);
        fill(&mut self.prev, &prev[..n]);
        fill(&mut self.successor, &successor[..n]);
        n > 0 && at == 0
    }

    /// Loads a fan of any size and form.
    fn load_any(&mut self, mesh: &TriMesh, v: usize, around: &[u32]) {
        self.next.clear();
        self.prev.clear();
        for &t in around {
            let (next, prev) = ends(mesh, v, t);
            self.next.push(next);
            self.prev.push(prev);
        }
        self.sorted.clear();
        if self.len() > SMALL_FAN {
            self.sorted.extend(self.next.iter().zip(0..).map(|(&n, i)| (n, i)));
            self.sorted.sort_unstable();
        }
        self.successor.clear();
        self.predecessor.clear();
        self.predecessor.resize(self.len(), NONE);
        self.merging = false;
        for i in 0..self.len() {
            let successor = self.leaving_to(self.prev[i]);
            self.successor.push(successor);
            if let Some(predecessor) = self.predecessor.get_mut(successor as usize) {
                self.merging |= *predecessor != NONE;
                *predecessor = i as u32;
            }
        }
    }

    /// Number of triangles.
    pub(crate) fn len(&self) -> usize {
        self.triangles.len()
    }

    /// The first triangle whose `next` is `w`, or [`NONE`].
    fn leaving_to(&self, w: u32) -> u32 {
        if self.sorted.is_empty() {
            return self.next.iter().position(|&n| n == w).map_or(NONE, |i| i as u32);
        }
        let at = self.sorted.partition_point(|&(n, _)| n < w);
        self.sorted.get(at).filter(|s| s.0 == w).map_or(NONE, |s| s.1)
    }

    /// Whether an earlier triangle has the same directed edge from the vertex.
    pub(crate) fn repeats_next(&self, i: usize) -> bool {
        !self.closed && self.leaving_to(self.next[i]) != i as u32
    }

    /// Whether two triangles have the same directed edge to or from the
    /// vertex. Those that go to the vertex and have no partner may be missed.
    pub(crate) fn is_tangled(&self) -> bool {
        !self.closed && (self.merging || (0..self.len()).any(|i| self.repeats_next(i)))
    }

    /// Whether the triangles are joined to one path or one cycle.
    pub(crate) fn is_single(&self) -> bool {
        if self.closed {
            return true;
        }
        // Successors that are distinct make paths, each with one start and
        // one end, and cycles.
        if self.is_tangled() || self.successor.iter().filter(|&&s| s == NONE).count() > 1 {
            return false;
        }
        // From the start of the only path, or from anywhere on a cycle, all
        // triangles have to be reached.
        let start = self.start() as u32;
        let (mut at, mut steps) = (start, 0);
        while let Some(&successor) = self.successor.get(at as usize) {
            (at, steps) = (successor, steps + 1);
            if at == start {
                break;
            }
        }
        steps == self.len()
    }

    /// Where a single fan begins: the triangle that is no other's successor, or
    /// any if there is none.
    pub(crate) fn start(&self) -> usize {
        if self.closed { 0 } else { self.predecessor.iter().position(|&p| p == NONE).unwrap_or(0) }
    }

    /// The edges from vertex `v` that have a triangle on both sides and lead
    /// to a higher vertex, each as the quadrilateral `a b c d` around it,
    /// counter-clockwise from `a = v`; the edge is `a c`.
    pub(crate) fn upward_quads(&self, v: usize) -> impl Iterator<Item = [u32; 4]> {
        let a = v as u32;
        self.successor.iter().enumerate().filter_map(move |(i, &j)| {
            let c = self.prev[i];
            (j != NONE && a < c).then(|| [a, self.next[i], c, self.prev[j as usize]])
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DVec2;

    fn mesh(vertices: usize, triangles: &[[usize; 3]]) -> TriMesh {
        TriMesh {
            vertices: vec![DVec2::ZERO; vertices],
            triangles: triangles.iter().map(|t| t.map(VertexId::new)).collect(),
        }
    }

    fn single(vertices: usize, triangles: &[[usize; 3]]) -> bool {
        let mesh = mesh(vertices, triangles);
        let mut fan = Fan::default();
        fan.load(&mesh, 0, Incidence::new(&mesh).around(0));
        fan.is_single()
    }

    #[test]
    fn triangles_around_each_vertex() {
        let mesh = mesh(5, &[[0, 1, 2], [2, 1, 3], [0, 0, 3], [1, 2, 9]]);
        let incidence = Incidence::new(&mesh);
        let around: Vec<&[u32]> = (0..5).map(|v| incidence.around(v)).collect();
        assert_eq!(around, [&[0][..], &[0, 1], &[0, 1], &[1], &[]]);
    }

    #[test]
    fn single_fans() {
        assert!(single(4, &[[0, 1, 2], [0, 2, 3], [0, 3, 1]]));
        assert!(single(5, &[[0, 3, 4], [0, 1, 2], [0, 2, 3]]));
        // Two paths, a path and a cycle, two cycles, a repeated edge.
        assert!(!single(5, &[[0, 1, 2], [0, 3, 4]]));
        assert!(!single(6, &[[0, 4, 5], [0, 1, 2], [0, 2, 3], [0, 3, 1]]));
        assert!(!single(7, &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [4, 5, 0], [0, 5, 6], [0, 6, 4]]));
        assert!(!single(4, &[[0, 1, 2], [0, 1, 3]]));
    }

    #[test]
    fn large_fans_match_small_ones() {
        let n = 100;
        let mut wheel: Vec<[usize; 3]> = (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect();
        assert!(single(n + 1, &wheel));
        wheel.swap(3, 70);
        wheel.remove(50);
        assert!(single(n + 1, &wheel));
        wheel.remove(20);
        assert!(!single(n + 1, &wheel));
    }
}
