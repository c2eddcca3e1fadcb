//! Triangulations of the crate `spade` and meshes of ours, from one to the other;
//! behind the feature `spade`.
//!
//! | from | to | |
//! |---|---|---|
//! | any triangulation of spade | [`TriMesh`] | [`mesh_of`] |
//! | a constrained one | [`Pslg`], to be meshed | [`graph_of`] |
//! | [`TriMesh`] | a Delaunay triangulation | [`delaunay_of`] |
//! | [`TriMesh`] | a constrained one | [`constrained_of`] |
//!
//! Vertices keep their order both ways, so that indices mean the same.

use ::spade::{
    ConstrainedDelaunayTriangulation, DelaunayTriangulation, HasPosition, HintGenerator, InsertionError,
    Point2, Triangulation,
};
use hexdel_geom::{DVec2, Pslg, TriMesh, VertexId};
use thiserror::Error;

/// Why spade does not take a mesh.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SpadeError {
    /// A coordinate is not finite, or nearer to zero than spade takes.
    #[error("spade takes no vertex {vertex} at ({}, {}): {source}", at.x, at.y)]
    Vertex {
        /// Index of the vertex.
        vertex: usize,
        /// Its position.
        at: DVec2,
        /// What spade says.
        source: InsertionError,
    },
    /// Two vertices are at the same place, which would change the order of those after.
    #[error("of {vertices} vertices only {distinct} are at places of their own")]
    Duplicates {
        /// How many vertices there are.
        vertices: usize,
        /// How many places.
        distinct: usize,
    },
    /// An edge names a vertex that is not there.
    #[error("edge {edge} names vertex {vertex} of {vertices}")]
    NoVertex {
        /// Index of the edge.
        edge: usize,
        /// The index it names.
        vertex: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// An edge crosses another one.
    #[error("edge {} to {} crosses another one", edge[0], edge[1])]
    Crossing {
        /// Indices of its ends.
        edge: [usize; 2],
    },
}

/// The mesh of a triangulation: its vertices in their order, its inner faces
/// counter-clockwise.
///
/// # Complexity
///
/// Linear.
///
/// # Examples
///
/// ```
/// use spade::{DelaunayTriangulation, Point2, Triangulation};
///
/// let mut triangulation = DelaunayTriangulation::<Point2<f64>>::new();
/// for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)] {
///     triangulation.insert(Point2::new(x, y))?;
/// }
/// let mesh = hexdel::spade::mesh_of(&triangulation);
/// assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (3, 1));
/// # Ok::<(), spade::InsertionError>(())
/// ```
pub fn mesh_of<T>(triangulation: &T) -> TriMesh
where
    T: Triangulation,
    T::Vertex: HasPosition<Scalar = f64>,
{
    let at = |p: Point2<f64>| DVec2::new(p.x, p.y);
    let corners = |face: [usize; 3]| face.map(VertexId::new);
    TriMesh {
        vertices: triangulation.vertices().map(|v| at(v.position())).collect(),
        triangles: triangulation
            .inner_faces()
            .map(|face| corners(face.vertices().map(|v| v.fix().index())))
            .collect(),
    }
}

/// The PSLG of a constrained triangulation: its vertices as points, its constraints as
/// segments. What [`triangulate_pslg`](crate::triangulate_pslg) makes of it keeps both.
///
/// # Complexity
///
/// Linear.
pub fn graph_of<V, DE, UE, F, L>(triangulation: &ConstrainedDelaunayTriangulation<V, DE, UE, F, L>) -> Pslg
where
    V: HasPosition<Scalar = f64>,
    DE: Default,
    UE: Default,
    F: Default,
    L: HintGenerator<f64>,
{
    let points = triangulation.vertices().map(|v| DVec2::new(v.position().x, v.position().y));
    let mut graph = Pslg::from_points(points.collect());
    let constraints = triangulation.undirected_edges().filter(|edge| edge.is_constraint_edge());
    graph.segments = constraints.map(|edge| edge.vertices().map(|v| v.fix().index() as u32)).collect();
    graph
}

/// The Delaunay triangulation of a mesh's vertices. Its triangles are those of a convex
/// Delaunay mesh, but for the choice of diagonals where four vertices are on a circle:
/// [`constrained_of`] all edges keeps that.
///
/// # Errors
///
/// [`SpadeError`] for vertices that spade does not take.
///
/// # Complexity
///
/// `n log n`.
pub fn delaunay_of(mesh: &TriMesh) -> Result<DelaunayTriangulation<Point2<f64>>, SpadeError> {
    let made = DelaunayTriangulation::bulk_load_stable(points(mesh)?);
    let made = made.map_err(|source| refused(mesh, 0, source))?;
    distinct(mesh, made.num_vertices())?;
    Ok(made)
}

/// A constrained triangulation of a mesh's vertices with edges that must be in it. With all
/// edges of a mesh of a convex domain ([`edges_of`]) its faces are the mesh's triangles, and
/// slivers of no width along sides that rounding bent inwards.
///
/// # Errors
///
/// [`SpadeError`] for vertices that spade does not take, and for edges that cross.
///
/// # Complexity
///
/// `n log n`.
pub fn constrained_of(
    mesh: &TriMesh,
    edges: &[[VertexId; 2]],
) -> Result<ConstrainedDelaunayTriangulation<Point2<f64>>, SpadeError> {
    let vertices = mesh.vertices.len();
    let ends: Vec<[usize; 2]> = edges.iter().map(|edge| edge.map(VertexId::index)).collect();
    for (edge, ends) in ends.iter().enumerate() {
        if let Some(&vertex) = ends.iter().find(|v| **v >= vertices) {
            return Err(SpadeError::NoVertex { edge, vertex, vertices });
        }
    }
    let mut crossing = None;
    let note = |edge| crossing = crossing.or(Some(edge));
    let made = ConstrainedDelaunayTriangulation::try_bulk_load_cdt(points(mesh)?, ends, note);
    let made = made.map_err(|source| refused(mesh, 0, source))?;
    distinct(mesh, made.num_vertices())?;
    match crossing {
        Some(edge) => Err(SpadeError::Crossing { edge }),
        None => Ok(made),
    }
}

/// All edges of a mesh, each once.
pub fn edges_of(mesh: &TriMesh) -> Vec<[VertexId; 2]> {
    let sides = |t: &[VertexId; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let mut edges: Vec<[VertexId; 2]> =
        mesh.triangles.iter().flat_map(sides).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

fn points(mesh: &TriMesh) -> Result<Vec<Point2<f64>>, SpadeError> {
    for (vertex, at) in mesh.vertices.iter().enumerate() {
        for coordinate in [at.x, at.y] {
            ::spade::validate_coordinate(coordinate).map_err(|source| refused(mesh, vertex, source))?;
        }
    }
    Ok(mesh.vertices.iter().map(|p| Point2::new(p.x, p.y)).collect())
}

fn refused(mesh: &TriMesh, vertex: usize, source: InsertionError) -> SpadeError {
    SpadeError::Vertex { vertex, at: mesh.vertices.get(vertex).copied().unwrap_or_default(), source }
}

fn distinct(mesh: &TriMesh, distinct: usize) -> Result<(), SpadeError> {
    let vertices = mesh.vertices.len();
    if vertices == distinct { Ok(()) } else { Err(SpadeError::Duplicates { vertices, distinct }) }
}
