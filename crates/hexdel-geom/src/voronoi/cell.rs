//! The cell of one vertex as a polygon, cut off at the boundary of the mesh.
//!
//! Corners are the circumcentres around the vertex; at the boundary also the
//! vertex itself and the middles of its two edges there:
//!
//! ```text
//!      c2 ----- c1
//!      |         |
//!     m2 -- v -- m1     boundary
//! ```

use super::{Voronoi, VoronoiEdge, cotangent};
use crate::incidence::{Fan, NONE};
use crate::mesh::{TriMesh, TriangleId, VertexId};
use glam::DVec2;

/// A circumcentre that lies beyond an edge of the boundary that its triangle
/// has: the angle opposite is obtuse.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leak {
    pub(super) triangle: TriangleId,
    /// The edge, with the mesh on its left.
    line: [DVec2; 2],
}

impl Leak {
    /// The leak at an edge, if it is one of the boundary and there is one.
    pub(super) fn at(mesh: &TriMesh, edge: &VoronoiEdge) -> Option<Self> {
        let ends = edge.ends.map(|v| mesh.vertices[v.index()]);
        let (triangle, line) = match edge.triangles {
            [Some(left), None] => (left, ends),
            [None, Some(right)] => (right, [ends[1], ends[0]]),
            _ => return None,
        };
        (edge.weight < 0.0).then_some(Self { triangle, line })
    }
}

/// The fan's triangles in counter-clockwise order, from the boundary on if
/// there is one.
pub(super) fn walk(fan: &Fan) -> impl Iterator<Item = usize> {
    let start = fan.start();
    let mut at = start;
    (0..fan.len()).map(move |_| {
        let i = at;
        // At the end of an open fan there is nothing more to take.
        at = if fan.successor[i] == NONE { start } else { fan.successor[i] as usize };
        i
    })
}

/// Whether the fan begins and ends at the boundary.
pub(super) fn is_open(fan: &Fan) -> bool {
    fan.successor.contains(&NONE)
}

impl Voronoi<'_> {
    /// The corners of the cell of a vertex, counter-clockwise; none of a vertex
    /// without triangles.
    ///
    /// The cell is the part of the mesh that is closer to the vertex than to
    /// any other, if the mesh is Delaunay. Where an angle opposite the boundary
    /// is obtuse, the cell is cut off at that edge; circumcentres that lie
    /// beyond the boundary but not beyond an edge of their own triangle are
    /// left where they are.
    ///
    /// # Panics
    ///
    /// If the vertex is not of the mesh.
    ///
    /// # Complexity
    ///
    /// Linear in the number of its corners, times the obtuse angles opposite the
    /// boundary among its triangles, of which each is looked up among all.
    ///
    /// # Examples
    ///
    /// ```
    /// use hexdel_geom::{DVec2, TriMesh, VertexId, Voronoi};
    ///
    /// let mesh = TriMesh {
    ///     vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
    ///     triangles: vec![[0, 1, 2].map(VertexId::new)],
    /// };
    /// let cell = Voronoi::new(&mesh)?.cell(VertexId::new(0));
    /// assert_eq!(cell, [(0.0, 0.0), (0.5, 0.0), (0.5, 0.5), (0.0, 0.5)].map(|(x, y)| DVec2::new(x, y)));
    /// # Ok::<(), hexdel_geom::VoronoiError>(())
    /// ```
    pub fn cell(&self, vertex: VertexId) -> Vec<DVec2> {
        let mut fan = Fan::default();
        fan.load(self.mesh, vertex.index(), self.incidence.around(vertex.index()));
        let mut corners = Vec::with_capacity(fan.len() + 3);
        let places: Vec<usize> = walk(&fan).collect();
        let (Some(&first), Some(&last)) = (places.first(), places.last()) else {
            return corners;
        };
        let at = self.mesh.vertices[vertex.index()];
        let position = |v: u32| self.mesh.vertices[v as usize];
        let open = is_open(&fan);
        if open {
            corners.push(at);
            // A middle beyond which the circumcentre lies is no corner.
            if cotangent(at, position(fan.prev[first]), position(fan.next[first])) >= 0.0 {
                corners.push(at.midpoint(position(fan.next[first])));
            }
        }
        for &i in &places {
            let centre = self.circumcentres[fan.triangles[i] as usize];
            if corners.last() != Some(&centre) {
                corners.push(centre);
            }
        }
        if open && cotangent(at, position(fan.next[last]), position(fan.prev[last])) >= 0.0 {
            let middle = at.midpoint(position(fan.prev[last]));
            if corners.last() != Some(&middle) {
                corners.push(middle);
            }
        }
        let leak = |t: &u32| self.leaks.binary_search_by_key(&(*t as usize), |leak| leak.triangle.index());
        for at in fan.triangles.iter().filter_map(|t| leak(t).ok()) {
            corners = clip(&corners, self.leaks[at].line);
        }
        corners
    }
}

/// The part of a convex polygon on the left of a line (Sutherland and Hodgman
/// 1974).
fn clip(polygon: &[DVec2], [from, to]: [DVec2; 2]) -> Vec<DVec2> {
    let height = |p: DVec2| (to - from).perp_dot(p - from);
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (of_p, of_q) = (height(p), height(q));
        if of_p >= 0.0 {
            kept.push(p);
        }
        if (of_p > 0.0 && of_q < 0.0) || (of_p < 0.0 && of_q > 0.0) {
            kept.push(p.lerp(q, of_p / (of_p - of_q)));
        }
    }
    kept
}
