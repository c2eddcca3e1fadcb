//! Checks of how triangles hang together, and of the edges between them.
//!
//! One pass over the vertices; an edge is looked at from its lower vertex, a
//! boundary edge from its head.

use crate::par::prelude::*;

use super::{CHUNK, View, Violation, note};
use crate::incidence::{Fan, Incidence, NONE};
use crate::mesh::{TriangleId, VertexId};
use crate::predicates::locally_delaunay;

/// What the vertices of a mesh, or of a part of it, have to say.
#[derive(Default)]
pub(super) struct Topology {
    pub(super) repeated_edges: usize,
    pub(super) branching_vertices: usize,
    pub(super) unused_vertices: usize,
    pub(super) edges: usize,
    pub(super) non_delaunay_edges: usize,
    pub(super) boundary_edges: usize,
    pub(super) boundary_loops: usize,
    pub(super) violations: Vec<Violation>,
    /// Tail and head of the boundary edges.
    boundary: Vec<[u32; 2]>,
}

pub(super) fn check(view: &View<'_>, cap: usize) -> Topology {
    let n = view.mesh.vertices.len();
    let incidence = Incidence::new(view.mesh);
    let parts: Vec<Topology> = (0..n.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut part = Topology::default();
            let mut fan = Fan::default();
            for v in chunk * CHUNK..n.min((chunk + 1) * CHUNK) {
                fan.load(view.mesh, v, incidence.around(v));
                part.vertex(view, v, &fan, cap);
            }
            part
        })
        .collect();
    let mut sum = parts.into_iter().fold(Topology::default(), |sum, part| sum.merge(part, cap));
    sum.boundary_edges = sum.boundary.len();
    sum.boundary_loops = components(&sum.boundary);
    sum
}

impl Topology {
    fn vertex(&mut self, view: &View<'_>, v: usize, fan: &Fan, cap: usize) {
        let vertex = VertexId::new(v);
        if fan.len() == 0 {
            self.unused_vertices += 1;
            return note(&mut self.violations, cap, || Violation::UnusedVertex { vertex });
        }
        let single = fan.is_single();
        if !single {
            self.branching_vertices += 1;
            let at = view.mesh.vertices[v];
            note(&mut self.violations, cap, || Violation::BranchingVertex { vertex, at });
            for i in (0..fan.len()).filter(|&i| fan.repeats_next(i)) {
                self.repeated_edges += 1;
                let triangle = TriangleId::new(fan.triangles[i] as usize);
                let edge = [vertex, VertexId::new(fan.next[i] as usize)];
                let ends = edge.map(|v| view.mesh.vertices[v.index()]);
                note(&mut self.violations, cap, || Violation::RepeatedEdge { triangle, edge, ends });
            }
        }
        // Only in a tangle can several edges lead to the vertex from the same
        // one.
        let tangle = (!single).then(|| Tangle::new(fan));
        for (i, (&w, &j)) in fan.prev.iter().zip(&fan.successor).enumerate() {
            if j == NONE {
                self.boundary.push([w, v as u32]);
            }
            let first = tangle.as_ref().is_none_or(|tangle| tangle.is_first(w, i));
            self.edges += usize::from((j == NONE || (v as u32) < w) && first);
        }
        for quad in fan.upward_quads(v) {
            if tangle.as_ref().is_none_or(|tangle| tangle.is_simple(quad[2])) {
                self.edge(view, quad, cap);
            }
        }
    }

    fn edge(&mut self, view: &View<'_>, quad: [u32; 4], cap: usize) {
        let at = |i: usize| view.at(quad[i] as usize);
        let [a, b, c, d] = [at(0), at(1), at(2), at(3)];
        if locally_delaunay(a, b, c, d) {
            return;
        }
        self.non_delaunay_edges += 1;
        note(&mut self.violations, cap, || {
            let [a, b, c, d] = quad.map(|v| view.mesh.vertices[v as usize]);
            let edge = [quad[0], quad[2]].map(|v| VertexId::new(v as usize));
            Violation::NotDelaunay { edge, ends: [a, c], opposite: [b, d] }
        });
    }

    fn merge(mut self, part: Self, cap: usize) -> Self {
        self.repeated_edges += part.repeated_edges;
        self.branching_vertices += part.branching_vertices;
        self.unused_vertices += part.unused_vertices;
        self.edges += part.edges;
        self.non_delaunay_edges += part.non_delaunay_edges;
        let room = cap - self.violations.len();
        self.violations.extend(part.violations.into_iter().take(room));
        self.boundary.extend(part.boundary);
        self
    }
}

/// How often each neighbour occurs around a vertex whose triangles are no
/// single fan. Sorted, as there may be any number of them.
struct Tangle {
    /// The `prev` of each triangle, with its position.
    prev: Vec<(u32, usize)>,
    /// All `next` and `prev`.
    ends: Vec<u32>,
}

impl Tangle {
    fn new(fan: &Fan) -> Self {
        let mut prev: Vec<(u32, usize)> = fan.prev.iter().copied().zip(0..).collect();
        let mut ends = [fan.prev.as_slice(), &fan.next].concat();
        prev.sort_unstable();
        ends.sort_unstable();
        Self { prev, ends }
    }

    /// Whether triangle `i` is the first whose `prev` is `w`.
    fn is_first(&self, w: u32, i: usize) -> bool {
        self.prev[self.prev.partition_point(|&(u, _)| u < w)] == (w, i)
    }

    /// Whether the edge to `w` has two triangles and no more.
    fn is_simple(&self, w: u32) -> bool {
        let [below, through] =
            [self.ends.partition_point(|&u| u < w), self.ends.partition_point(|&u| u <= w)];
        through - below == 2
    }
}

/// Connected components of a graph given by its edges.
fn components(edges: &[[u32; 2]]) -> usize {
    let mut vertices: Vec<u32> = edges.iter().flatten().copied().collect();
    vertices.par_sort_unstable();
    vertices.dedup();
    let mut parent: Vec<u32> = (0..vertices.len() as u32).collect();
    let mut count = vertices.len();
    for ends in edges {
        let [a, b] = ends.map(|v| root(&mut parent, vertices.partition_point(|&u| u < v) as u32));
        if a != b {
            parent[a.max(b) as usize] = a.min(b);
            count -= 1;
        }
    }
    count
}

/// The representative of `v`; halves the path to it.
fn root(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}
