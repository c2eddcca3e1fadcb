//! The Voronoi dual of a triangle mesh: what finite volumes and discrete
//! exterior calculus work on.
//!
//! ```text
//!            c                 weight of the edge a b = (cot at c + cot at d) / 2
//!          / | \                                      = dual length / length
//!         /  *  \    * circumcentres
//!        a --+-- b   the dual edge * * crosses a b at a right angle,
//!         \  *  /    in the middle
//!          \ | /
//!            d
//! ```
//!
//! In a Delaunay mesh without obtuse angles every circumcentre lies in its
//! triangle, all lengths and areas here are those of the Voronoi cells, cut off
//! at the boundary, and no weight is negative. In any other mesh lengths and
//! areas are signed (the circumcentric dual of discrete exterior calculus),
//! and [`VoronoiSummary`] says how often that shows.
//!
//! Left to others: whether the mesh is Delaunay (the certificate).

mod cell;
#[cfg(test)]
mod tests;

use crate::certificate::ANGLE_TOLERANCE_DEG;
use crate::incidence::{Fan, Incidence, NONE, well_formed};
use crate::mesh::{TriMesh, TriangleId, VertexId};
use crate::par::prelude::*;
use cell::Leak;
use glam::DVec2;
use thiserror::Error;

/// Why a mesh has no dual.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum VoronoiError {
    /// A triangle names a vertex twice, or one that there is not.
    #[error("triangle {} does not have three corners in the mesh", triangle.index())]
    Malformed {
        /// The triangle.
        triangle: TriangleId,
    },
    /// A triangle without a circumcentre: flat, clockwise, or not finite.
    #[error("triangle {} is flat, clockwise or not finite", triangle.index())]
    NotCounterClockwise {
        /// The triangle.
        triangle: TriangleId,
    },
    /// The triangles around a vertex form no single fan.
    #[error("vertex {} at ({}, {}) has no single fan of triangles", vertex.index(), at.x, at.y)]
    Branching {
        /// The vertex.
        vertex: VertexId,
        /// Where it is.
        at: DVec2,
    },
}

/// An edge of the mesh and the edge of the dual that crosses it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VoronoiEdge {
    /// Its vertices, the lower index first.
    pub ends: [VertexId; 2],
    /// The triangles on its left and right as seen from the first end. At
    /// least one is there; on the boundary the other is not.
    pub triangles: [Option<TriangleId>; 2],
    /// Distance of its ends, input units.
    pub length: f64,
    /// Half the cotangents of the angles opposite: the edge's entry in the
    /// cotangent Laplacian, and its transmissibility in a two-point flux.
    pub weight: f64,
}

impl VoronoiEdge {
    /// Distance of the circumcentres on both sides, on the boundary of the one
    /// and the edge, input units. Negative where they lie the wrong way round.
    pub fn dual_length(&self) -> f64 {
        self.weight * self.length
    }

    /// Whether only one triangle has it.
    pub fn is_boundary(&self) -> bool {
        self.triangles.contains(&None)
    }
}

/// The Voronoi dual of a mesh.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, TriMesh, VertexId, Voronoi};
///
/// let mesh = TriMesh {
///     vertices: [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec2::new(x, y)).to_vec(),
///     triangles: vec![[0, 1, 2].map(VertexId::new), [0, 2, 3].map(VertexId::new)],
/// };
/// let dual = Voronoi::new(&mesh)?;
/// assert_eq!(dual.areas, [0.25; 4]);
/// assert_eq!(dual.edges.len(), 5);
/// assert!(dual.edges.iter().all(|e| e.weight >= 0.0));
/// # Ok::<(), hexdel_geom::VoronoiError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Voronoi<'a> {
    mesh: &'a TriMesh,
    incidence: Incidence,
    /// The circumcentre of each triangle.
    pub circumcentres: Vec<DVec2>,
    /// Every edge of the mesh once, by first end, then counter-clockwise
    /// around it.
    pub edges: Vec<VoronoiEdge>,
    /// For each vertex the area of its cell, square input units. They sum to
    /// the area of the mesh.
    pub areas: Vec<f64>,
    /// Circumcentres that lie beyond an edge of the boundary, by triangle: one
    /// has one obtuse angle at most.
    leaks: Vec<Leak>,
}

/// What a dual is like.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VoronoiSummary {
    /// The shortest edge of the dual, input units. Zero between two triangles
    /// whose right angles lie on a common circle.
    pub shortest_dual_edge: f64,
    /// The smallest of dual length over length.
    pub min_weight: f64,
    /// Edges whose weight is negative.
    pub negative_weights: usize,
    /// Triangles that do not hold their circumcentre.
    pub obtuse_triangles: usize,
    /// How far dual edges are from crossing at right angles: the largest
    /// distance along an edge between the circumcentres on its two sides, over
    /// the length of the edge. Rounding alone.
    pub max_skew: f64,
    /// The smallest area of a cell, square input units.
    pub min_area: f64,
}

/// Vertices whose edges are listed by one task.
const VERTICES_PER_TASK: usize = 4096;

impl<'a> Voronoi<'a> {
    /// The dual of a mesh.
    ///
    /// Angles within the certificate's tolerance of 90 degrees count as right.
    /// The outcome does not depend on the number of threads.
    ///
    /// # Errors
    ///
    /// [`VoronoiError`] for the first triangle or vertex that is not that of a
    /// surface with counter-clockwise triangles.
    ///
    /// # Complexity
    ///
    /// Linear; about 150 bytes per triangle.
    pub fn new(mesh: &'a TriMesh) -> Result<Self, VoronoiError> {
        let circumcentres = circumcentres(mesh)?;
        let incidence = Incidence::new(mesh);
        let edges = edges(mesh, &incidence)?;
        let mut areas = vec![0.0; mesh.vertices.len()];
        for edge in &edges {
            // Two right-angled triangles of half the edge and a part of the dual edge.
            let quarter = 0.25 * edge.length * edge.dual_length();
            for end in edge.ends {
                areas[end.index()] += quarter;
            }
        }
        let mut leaks: Vec<Leak> = edges.iter().filter_map(|edge| Leak::at(mesh, edge)).collect();
        leaks.sort_unstable_by_key(|leak| leak.triangle.index());
        Ok(Self { mesh, incidence, circumcentres, edges, areas, leaks })
    }

    /// What stands out.
    pub fn summary(&self) -> VoronoiSummary {
        let weights = || self.edges.iter().map(|e| e.weight);
        let obtuse = |corners: &[VertexId; 3]| {
            let p = corners.map(|v| self.mesh.vertices[v.index()]);
            (0..3).any(|i| cotangent(p[(i + 1) % 3], p[i], p[(i + 2) % 3]) < 0.0)
        };
        VoronoiSummary {
            shortest_dual_edge: least(self.edges.iter().map(|e| e.dual_length().abs())),
            min_weight: least(weights()),
            negative_weights: weights().filter(|w| *w < 0.0).count(),
            obtuse_triangles: self.mesh.triangles.par_iter().filter(|t| obtuse(t)).count(),
            max_skew: self.edges.iter().map(|e| self.skew(e)).fold(0.0, f64::max),
            min_area: least(self.areas.iter().copied()),
        }
    }

    /// The circumcentres' distance along the edge over its length.
    fn skew(&self, edge: &VoronoiEdge) -> f64 {
        let [from, to] = edge.ends.map(|v| self.mesh.vertices[v.index()]);
        let middle = from.midpoint(to);
        let [left, right] = edge.triangles.map(|t| t.map_or(middle, |t| self.circumcentres[t.index()]));
        (left - right).dot(to - from).abs() / (edge.length * edge.length)
    }
}

/// The least, or zero of none.
fn least(values: impl Iterator<Item = f64>) -> f64 {
    values.reduce(f64::min).unwrap_or(0.0)
}

fn circumcentres(mesh: &TriMesh) -> Result<Vec<DVec2>, VoronoiError> {
    let centre = |(t, corners): (usize, &[VertexId; 3])| {
        let triangle = TriangleId::new(t);
        if !well_formed(*corners, mesh.vertices.len()) {
            return Err(VoronoiError::Malformed { triangle });
        }
        circumcentre(mesh.corners(triangle)).ok_or(VoronoiError::NotCounterClockwise { triangle })
    };
    // Collecting in order finds the first fault by index only if all are seen.
    let centres: Vec<_> = mesh.triangles.par_iter().enumerate().map(centre).collect();
    centres.into_iter().collect()
}

/// The centre of the circle through three points; none unless they turn left.
fn circumcentre([a, b, c]: [DVec2; 3]) -> Option<DVec2> {
    let (u, v) = (b - a, c - a);
    let twice_area = u.perp_dot(v);
    let offset = (u * v.length_squared() - v * u.length_squared()).perp() / (2.0 * twice_area);
    // The cross product's sign is that of the exact one or it is negligible.
    (twice_area > 0.0 && offset.is_finite()).then(|| a + offset)
}

/// The cotangent of the angle at `b` between `a` and `c`; zero for one that
/// counts as right.
fn cotangent(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let (u, v) = (a - b, c - b);
    let cotangent = u.dot(v) / u.perp_dot(v).abs();
    // Near 90 degrees the cotangent is what is missing, in radians.
    if cotangent.abs() <= ANGLE_TOLERANCE_DEG.to_radians() { 0.0 } else { cotangent }
}

/// All edges, by their lower end.
fn edges(mesh: &TriMesh, incidence: &Incidence) -> Result<Vec<VoronoiEdge>, VoronoiError> {
    let starts: Vec<usize> = (0..mesh.vertices.len()).step_by(VERTICES_PER_TASK).collect();
    let blocks: Vec<_> = starts
        .into_par_iter()
        .map(|start| {
            let mut fan = Fan::default();
            let mut edges = Vec::new();
            for v in start..mesh.vertices.len().min(start + VERTICES_PER_TASK) {
                fan.load(mesh, v, incidence.around(v));
                if fan.len() > 0 && !fan.is_single() {
                    let at = mesh.vertices[v];
                    return Err(VoronoiError::Branching { vertex: VertexId::new(v), at });
                }
                edges_at(mesh, v, &fan, &mut edges);
            }
            Ok(edges)
        })
        .collect();
    let mut all = Vec::with_capacity(mesh.triangles.len() * 3 / 2 + mesh.vertices.len() / 8);
    for block in blocks {
        all.append(&mut block?);
    }
    Ok(all)
}

/// The edges from vertex `v` to higher ones.
fn edges_at(mesh: &TriMesh, v: usize, fan: &Fan, edges: &mut Vec<VoronoiEdge>) {
    let mut walk = cell::walk(fan).peekable();
    if let Some(&first) = walk.peek()
        && cell::is_open(fan)
    {
        push(mesh, v, fan.next[first], [Some(first), None], fan, edges);
    }
    for i in walk {
        let successor = fan.successor[i];
        let left = (successor != NONE).then_some(successor as usize);
        push(mesh, v, fan.prev[i], [left, Some(i)], fan, edges);
    }
}

/// Adds the edge from `v` to `w` if `w` is higher, with the places of the
/// triangles on its sides in the fan.
fn push(
    mesh: &TriMesh,
    v: usize,
    w: u32,
    sides: [Option<usize>; 2],
    fan: &Fan,
    edges: &mut Vec<VoronoiEdge>,
) {
    let w = w as usize;
    if w < v {
        return;
    }
    let [from, to] = [v, w].map(|i| mesh.vertices[i]);
    // Left of v w the third corner is the triangle's `prev`, right of it `next`.
    let opposite = [sides[0].map(|i| fan.prev[i]), sides[1].map(|i| fan.next[i])];
    let cotangents = opposite
        .map(|corner| corner.map_or(0.0, |corner| cotangent(from, mesh.vertices[corner as usize], to)));
    edges.push(VoronoiEdge {
        ends: [v, w].map(VertexId::new),
        triangles: sides.map(|side| side.map(|i| TriangleId::new(fan.triangles[i] as usize))),
        length: from.distance(to),
        weight: 0.5 * (cotangents[0] + cotangents[1]),
    });
}
