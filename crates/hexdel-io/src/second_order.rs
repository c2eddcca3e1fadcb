//! Second-order elements: a node on the midpoint of each edge.
//!
//! As Triangle's `-o2` has them: numbered after the vertices, by their edges; in a
//! triangle after its corners, each opposite to the corner of its place.
//!
//! ```text
//!          c
//!        /   \          a b c | bc ca ab
//!      ca     bc
//!     /         \
//!    a --- ab --- b
//! ```

use hexdel_geom::{DVec2, VertexId};

use crate::topology::Edges;
use crate::view::MeshView;

/// The midpoints of a mesh's edges.
pub(crate) struct Midpoints {
    /// The ends of each edge, the smaller first, sorted.
    ends: Vec<[u32; 2]>,
    /// The marker of each: the edge's own, or else 1 on the boundary and 0 inside.
    markers: Vec<i32>,
    /// The number of the first: how many vertices there are.
    first: usize,
}

impl Midpoints {
    pub(crate) fn new(view: &MeshView<'_>) -> Self {
        let edges = Edges::new(view.mesh);
        let (ends, mut markers): (Vec<_>, Vec<_>) =
            edges.iter().map(|edge| (edge.ends, i32::from(edge.triangles == 1))).unzip();
        for edge in view.marked_edges.unwrap_or(&[]) {
            if let Ok(at) = ends.binary_search(&sorted(edge.ends)) {
                markers[at] = edge.marker;
            }
        }
        Self { ends, markers, first: view.mesh.vertices.len() }
    }

    /// Each midpoint's number, the ends of its edge, its place and marker.
    pub(crate) fn nodes(&self, vertices: &[DVec2]) -> impl Iterator<Item = (usize, [u32; 2], DVec2, i32)> {
        let edges = self.ends.iter().zip(&self.markers).enumerate();
        edges.map(|(i, (&ends, &marker))| {
            let [a, b] = ends.map(|v| vertices[v as usize]);
            (self.first + i, ends, a.midpoint(b), marker)
        })
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.ends.len()
    }

    /// The numbers of a triangle's midpoints, opposite to its corners. Those of an
    /// edge without length are its vertex.
    pub(crate) fn of(&self, [a, b, c]: [VertexId; 3]) -> [usize; 3] {
        [[b, c], [c, a], [a, b]].map(|ends| {
            let found = self.ends.binary_search(&sorted(ends));
            found.map_or(ends[0].index(), |at| self.first + at)
        })
    }
}

fn sorted(ends: [VertexId; 2]) -> [u32; 2] {
    let [a, b] = ends.map(|v| v.index() as u32);
    [a.min(b), a.max(b)]
}
