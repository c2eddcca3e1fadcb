//! A mesh as Triangle numbers it: input points first and in their order, with attributes.

use hexdel::geom::{DVec2, VertexId};
use hexdel::{PslgTriangulation, TriMesh};
use hexdel_io::{MarkedEdge, MeshView, PointFile};

/// A mesh with its vertices in Triangle's order.
pub(crate) struct Numbered {
    mesh: TriMesh,
    markers: Vec<i32>,
    edges: Vec<MarkedEdge>,
    attributes: Vec<f64>,
    attributes_per_vertex: usize,
    first_number: u32,
}

impl Numbered {
    /// The mesh of the points of a file. Points that are no vertex, in holes or twice, are
    /// there all the same, so that the numbers of all are those of the file, unless `without_unused`.
    pub(super) fn new(
        made: &PslgTriangulation,
        input: &PointFile,
        without_unused: bool,
        first_number: u32,
    ) -> Self {
        let order = Order::new(made, &input.pslg.points, without_unused);
        let given = &input.pslg;
        let per_vertex = given.attributes_per_point;
        let of_vertices = made.vertex_attributes(given);
        let of_segments = markers_of_segments(made);
        let (mut vertices, mut markers, mut attributes) = (Vec::new(), Vec::new(), Vec::new());
        for &source in &order.sources {
            match source {
                Source::Vertex(v) => {
                    vertices.push(made.mesh.vertices[v]);
                    let own = made.point_of_vertex[v].and_then(|p| made.graph.point_markers.get(p as usize));
                    let of_segment = of_segments[v].filter(|_| own.is_none_or(|&own| own == 0));
                    markers.push(of_segment.unwrap_or(made.vertex_markers[v]));
                    attributes.extend_from_slice(&of_vertices[v * per_vertex..(v + 1) * per_vertex]);
                }
                Source::Unused(i) => {
                    vertices.push(given.points[i]);
                    markers.push(given.point_markers.get(i).copied().unwrap_or(0));
                    attributes.extend_from_slice(given.attributes(i));
                }
            }
        }
        let number = |v: VertexId| VertexId::new(order.number_of_vertex[v.index()]);
        let triangles = made.mesh.triangles.iter().map(|t| t.map(number)).collect();
        let edges =
            made.edges.iter().map(|e| MarkedEdge { ends: e.ends.map(number), marker: e.marker }).collect();
        Self {
            mesh: TriMesh { vertices, triangles },
            markers,
            edges,
            attributes,
            attributes_per_vertex: per_vertex,
            first_number,
        }
    }

    /// What is written.
    pub(crate) fn view(&self) -> MeshView<'_> {
        MeshView::new(&self.mesh)
            .with_vertex_markers(&self.markers)
            .with_marked_edges(&self.edges)
            .with_vertex_attributes(&self.attributes, self.attributes_per_vertex)
            .with_first_number(self.first_number)
    }
}

/// For each vertex the marker of the first segment given, of those that have one, that it lies
/// on: where segments meet, Triangle takes that one.
fn markers_of_segments(made: &PslgTriangulation) -> Vec<Option<i32>> {
    let mut first: Vec<Option<(u32, i32)>> = vec![None; made.mesh.vertices.len()];
    for edge in &made.edges {
        let Some(segment) = edge.segment else { continue };
        // That of an edge is 1 on the boundary where the segment has none.
        let marker = made.graph.segment_markers.get(segment as usize).copied().unwrap_or(0);
        if marker == 0 {
            continue;
        }
        let sources = made.repairs.as_ref().and_then(|report| report.sources.get(segment as usize));
        let given = sources.and_then(|sources| sources.iter().min()).copied().unwrap_or(segment);
        for end in edge.ends {
            let found = &mut first[end.index()];
            if found.is_none_or(|(known, _)| given < known) {
                *found = Some((given, marker));
            }
        }
    }
    first.into_iter().map(|found| found.map(|(_, marker)| marker)).collect()
}

/// What a vertex in the new order is.
#[derive(Clone, Copy)]
enum Source {
    /// A vertex of the mesh.
    Vertex(usize),
    /// A point given that is none of its own.
    Unused(usize),
}

struct Order {
    sources: Vec<Source>,
    number_of_vertex: Vec<usize>,
}

impl Order {
    fn new(made: &PslgTriangulation, points: &[DVec2], without_unused: bool) -> Self {
        let count = made.mesh.vertices.len();
        let mut order =
            Self { sources: Vec::with_capacity(count), number_of_vertex: vec![usize::MAX; count] };
        for (i, vertex) in made.vertex_of_input().into_iter().enumerate().take(points.len()) {
            let fresh = vertex.map(VertexId::index).filter(|&v| order.number_of_vertex[v] == usize::MAX);
            match fresh {
                Some(v) => order.add(v),
                None if without_unused => {}
                None => order.sources.push(Source::Unused(i)),
            }
        }
        for v in 0..count {
            if order.number_of_vertex[v] == usize::MAX {
                order.add(v);
            }
        }
        order
    }

    fn add(&mut self, v: usize) {
        self.number_of_vertex[v] = self.sources.len();
        self.sources.push(Source::Vertex(v));
    }
}
