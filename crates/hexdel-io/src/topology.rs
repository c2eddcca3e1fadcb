//! The edges of a mesh and which triangles they join, for formats that list them.
//!
//! No hashing: the edges of each triangle are sorted into the bucket of their smaller
//! end, 24 bytes per triangle and 8 per vertex.

use hexdel_geom::{MarkedEdge, TriMesh, TriangleId, VertexId, orient2d};

/// An edge from the side of one of its triangles.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    /// The larger end.
    end: u32,
    triangle: u32,
}

/// All edges of a mesh.
pub(crate) struct Edges {
    /// For each vertex the end of its run in `sides`, which starts where that of the
    /// vertex before ends.
    ends: Vec<usize>,
    /// By smaller end, larger end, triangle.
    sides: Vec<Side>,
}

/// An edge with the number of triangles that have it.
pub(crate) struct Edge {
    /// The smaller one first.
    pub(crate) ends: [u32; 2],
    pub(crate) triangles: usize,
}

impl Edges {
    /// The edges of a mesh whose corners are vertices of it. Edges of a triangle from
    /// a vertex to itself are left out.
    pub(crate) fn new(mesh: &TriMesh) -> Self {
        let all = || {
            let triangles = mesh.triangles.iter().enumerate();
            triangles.flat_map(|(t, corners)| sides(*corners).map(move |ends| (ends, t as u32)))
        };
        let mut ends = vec![0; mesh.vertices.len()];
        for ([low, high], _) in all() {
            ends[low as usize] += usize::from(low != high);
        }
        let mut total = 0;
        for end in &mut ends {
            (*end, total) = (total, total + *end);
        }
        let mut sides = vec![Side::default(); total];
        for ([low, high], triangle) in all().filter(|([low, high], _)| low != high) {
            let end = &mut ends[low as usize];
            sides[*end] = Side { end: high, triangle };
            *end += 1;
        }
        let mut start = 0;
        for &end in &ends {
            sides[start..end].sort_unstable();
            start = end;
        }
        Self { ends, sides }
    }

    fn bucket(&self, vertex: usize) -> &[Side] {
        let start = if vertex == 0 { 0 } else { self.ends[vertex - 1] };
        &self.sides[start..self.ends[vertex]]
    }

    /// All edges, by their ends.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Edge> {
        (0..self.ends.len()).flat_map(|vertex| {
            let runs = self.bucket(vertex).chunk_by(|a, b| a.end == b.end);
            runs.map(move |run| Edge { ends: [vertex as u32, run[0].end], triangles: run.len() })
        })
    }

    /// The triangle on the other side of the edge of `triangle` opposite to each of
    /// its corners, `None` on a boundary or if there is more than one.
    pub(crate) fn neighbours(&self, triangle: usize, corners: [VertexId; 3]) -> [Option<u32>; 3] {
        let [opposite_c, opposite_a, opposite_b] = sides(corners);
        [opposite_a, opposite_b, opposite_c].map(|[low, high]| {
            let bucket = self.bucket(low as usize);
            let first = bucket.partition_point(|side| side.end < high);
            let length = bucket[first..].partition_point(|side| side.end == high);
            match bucket[first..first + length] {
                [a, b] if a.triangle as usize == triangle => Some(b.triangle),
                [a, b] if b.triangle as usize == triangle => Some(a.triangle),
                _ => None,
            }
        })
    }
}

/// The markers of the edges that have one.
pub(crate) struct EdgeMarkers {
    /// By ends, the smaller first.
    sorted: Vec<([u32; 2], i32)>,
}

impl EdgeMarkers {
    pub(crate) fn new(edges: &[MarkedEdge]) -> Self {
        let ends = |edge: &MarkedEdge| edge.ends.map(|v| v.index() as u32);
        let mut sorted: Vec<_> = edges
            .iter()
            .map(|edge| (ends(edge), edge.marker))
            .map(|([a, b], m)| ([a.min(b), a.max(b)], m))
            .collect();
        sorted.sort_unstable();
        Self { sorted }
    }

    /// The marker of the edge between two vertices, in either order.
    pub(crate) fn of(&self, [a, b]: [u32; 2]) -> Option<i32> {
        let found = self.sorted.binary_search_by_key(&[a.min(b), a.max(b)], |(ends, _)| *ends);
        found.ok().map(|at| self.sorted[at].1)
    }
}

/// The corners of a triangle, counter-clockwise, from its first on.
pub(crate) fn counter_clockwise(mesh: &TriMesh, triangle: usize) -> [VertexId; 3] {
    let [a, b, c] = mesh.triangles[triangle];
    let [p, q, r] = mesh.corners(TriangleId::new(triangle));
    if orient2d(p, q, r) < 0.0 { [a, c, b] } else { [a, b, c] }
}

/// The ends of the edges from corner 0 to 1, 1 to 2, and 2 to 0, the smaller first.
fn sides([a, b, c]: [VertexId; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|ends| {
        let [s, t] = ends.map(|v| v.index() as u32);
        [s.min(t), s.max(t)]
    })
}
