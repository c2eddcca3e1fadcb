//! How long the edges of the Voronoi dual are beside the edges that they cross, checked
//! from scratch.
//!
//! ```text
//!          c                  length of the dual edge   cot at c + cot at d
//!        / | \                ----------------------- = -------------------
//!       /  *  \               length of the edge a b             2
//!      a --+-- b
//!       \  *  /    * circumcentres
//!        \ | /
//!          d
//! ```
//!
//! On the boundary the cell is clipped: of the dual edge there is the half in the one
//! triangle, `cot at c / 2`. The ratio there is twice that, which is the ratio that the
//! edge would have with its mirror image beyond the boundary. So the ratio of every edge
//! is the mean of the cotangents opposite, over one triangle or two, and where no angle is
//! larger than [`max_angle_of_ratio`] none is below the bound. Edges on segments inside the
//! mesh are edges like all others.

use crate::par::prelude::*;
use glam::DVec2;
use rustc_hash::FxHashSet;

use super::triangles::rounding_slack_deg;
use super::{ANGLE_TOLERANCE_DEG, CHUNK};
use crate::incidence::well_formed;
use crate::mesh::{TriMesh, TriangleId, VertexId};
use crate::predicates::orient2d;

/// The largest angle, degrees, at which no dual edge can be shorter than `ratio` times its
/// edge: `acot(ratio)`.
///
/// ```
/// use hexdel_geom::certificate::max_angle_of_ratio;
/// assert!((max_angle_of_ratio(0.1) - 84.289).abs() < 1e-3);
/// assert_eq!(max_angle_of_ratio(0.0), 90.0);
/// ```
pub fn max_angle_of_ratio(ratio: f64) -> f64 {
    libm::atan2(1.0, ratio).to_degrees()
}

/// An edge, and the length of the dual edge that crosses it over its own.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DualEdge {
    /// Its vertices, the lower index first.
    pub edge: [VertexId; 2],
    /// Their positions.
    pub ends: [DVec2; 2],
    /// Dual length over length; on the boundary twice that, as only half of the dual edge
    /// is there.
    pub ratio: f64,
    /// Whether only one triangle has the edge.
    pub boundary: bool,
}

/// What [`check_dual_edges`] found.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct DualCheck {
    /// The bound that ratios were held against.
    pub min_ratio: f64,
    /// Edges of one or two counter-clockwise triangles, which are those that were looked at.
    pub edges: usize,
    /// Edges below the bound by more than tolerance and rounding, the excused ones left out.
    pub below: usize,
    /// Edges below the bound of a triangle that is excused.
    pub excused: usize,
    /// The edge with the smallest ratio; none of a mesh without edges.
    pub worst: Option<DualEdge>,
}

impl DualCheck {
    /// Whether every edge keeps the bound, the excused ones left out.
    pub fn holds(&self) -> bool {
        self.below == 0
    }
}

/// A side of a triangle: its ends in order, the triangle, the cotangent opposite and what
/// tolerance and rounding may add to it.
type Side = ([VertexId; 2], TriangleId, f64, f64);

/// Holds the length of every dual edge over that of the edge it crosses against a bound.
/// Edges of `excused` triangles may be below it.
///
/// A cotangent is granted what the certificate grants to the angle: the tolerance and the
/// rounding of the corners.
///
/// # Guarantees
///
/// Never panics, whatever the mesh contains. Triangles that are not well formed, not finite or
/// not counter-clockwise and edges with three or more sides are left to
/// [`certify`](super::certify). The outcome is the same at any number of threads.
///
/// # Complexity
///
/// `O(n log n)`, parallel, with 100 bytes for each triangle.
///
/// # Examples
///
/// ```
/// use hexdel_geom::certificate::check_dual_edges;
/// use hexdel_geom::{DVec2, TriMesh, VertexId};
///
/// // Two right angles opposite the diagonal: the cells on its two sides touch in a point.
/// let square = TriMesh {
///     vertices: vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y],
///     triangles: vec![[0, 1, 2].map(VertexId::new), [0, 2, 3].map(VertexId::new)],
/// };
/// let found = check_dual_edges(&square, 0.1, &[]);
/// assert_eq!((found.edges, found.below), (5, 1));
/// assert_eq!(found.worst.map(|worst| worst.edge), Some([0, 2].map(VertexId::new)));
/// ```
pub fn check_dual_edges(mesh: &TriMesh, min_ratio: f64, excused: &[TriangleId]) -> DualCheck {
    let mut sides: Vec<Side> = mesh
        .triangles
        .par_chunks(CHUNK)
        .enumerate()
        .flat_map_iter(|(chunk, triangles)| {
            let of = move |(i, &v)| sides_of(mesh, TriangleId::new(chunk * CHUNK + i), v);
            triangles.iter().enumerate().flat_map(of)
        })
        .collect();
    sides.par_sort_unstable_by_key(|&(edge, triangle, ..)| (edge, triangle));
    let excused: FxHashSet<TriangleId> = excused.iter().copied().collect();
    let mut found = DualCheck { min_ratio, edges: 0, below: 0, excused: 0, worst: None };
    for sides in sides.chunk_by(|a, b| a.0 == b.0).filter(|sides| sides.len() <= 2) {
        found.note(mesh, sides, &excused);
    }
    found
}

impl DualCheck {
    fn note(&mut self, mesh: &TriMesh, sides: &[Side], excused: &FxHashSet<TriangleId>) {
        let mean = |value: fn(&Side) -> f64| sides.iter().map(value).sum::<f64>() / sides.len() as f64;
        let (ratio, slack) = (mean(|side| side.2), mean(|side| side.3));
        self.edges += 1;
        if ratio + slack < self.min_ratio || ratio.is_nan() {
            let is_excused = sides.iter().any(|side| excused.contains(&side.1));
            *(if is_excused { &mut self.excused } else { &mut self.below }) += 1;
        }
        if self.worst.is_none_or(|worst| ratio < worst.ratio) {
            let edge = sides[0].0;
            let ends = edge.map(|v| mesh.vertices[v.index()]);
            self.worst = Some(DualEdge { edge, ends, ratio, boundary: sides.len() == 1 });
        }
    }
}

/// The three sides of a triangle that is as it should be.
fn sides_of(mesh: &TriMesh, triangle: TriangleId, v: [VertexId; 3]) -> impl Iterator<Item = Side> {
    let corners = well_formed(v, mesh.vertices.len()).then(|| v.map(|v| mesh.vertices[v.index()]));
    let sound = |p: &[DVec2; 3]| p.iter().all(|p| p.is_finite()) && orient2d(p[0], p[1], p[2]) > 0.0;
    let corners = corners.filter(sound);
    (0..3).filter_map(move |i| {
        let p = corners?;
        let [a, b, c] = [p[i], p[(i + 1) % 3], p[(i + 2) % 3]];
        let (u, w) = (b - a, c - a);
        let cotangent = u.dot(w) / u.perp_dot(w);
        // The cotangent changes by 1 + cot^2 for each radian of the angle; the cotangent on the way to the bound
        // may be larger than the one at hand.
        let granted = (ANGLE_TOLERANCE_DEG + rounding_slack_deg([a, b, c])).to_radians();
        let slack = granted * (1.0 + (cotangent.abs() + 2.0 * granted).powi(2));
        let [from, to] = [v[(i + 1) % 3], v[(i + 2) % 3]];
        Some(([from.min(to), from.max(to)], triangle, cotangent, slack))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::voronoi::Voronoi;

    fn mesh(vertices: &[[f64; 2]], triangles: &[[usize; 3]]) -> TriMesh {
        TriMesh {
            vertices: vertices.iter().map(|&p| p.into()).collect(),
            triangles: triangles.iter().map(|t| t.map(VertexId::new)).collect(),
        }
    }

    /// A kite whose left and right angles are given by the heights above and below its diagonal of length 2.
    fn kite(up: f64, down: f64) -> TriMesh {
        mesh(&[[-1.0, 0.0], [1.0, 0.0], [0.0, up], [0.0, -down]], &[[0, 1, 2], [1, 0, 3]])
    }

    /// What the dual of the mesh says of every edge.
    fn agrees_with_the_dual(mesh: &TriMesh) {
        let dual = Voronoi::new(mesh).unwrap();
        let ratio = |e: &crate::VoronoiEdge| if e.is_boundary() { 2.0 * e.weight } else { e.weight };
        let least = dual.edges.iter().map(ratio).fold(f64::INFINITY, f64::min);
        for bound in [-0.5, 0.0, 0.1, 0.3, 0.6] {
            let below = dual.edges.iter().filter(|e| ratio(e) < bound - 1e-9).count();
            let found = check_dual_edges(mesh, bound, &[]);
            assert_eq!((found.edges, found.below), (dual.edges.len(), below), "{bound}");
            assert!((found.worst.unwrap().ratio - least).abs() < 1e-9);
        }
    }

    #[test]
    fn ratios_are_those_of_the_voronoi_dual() {
        for (up, down) in [(1.0, 1.0), (1.2, 1.2), (2.0, 0.5), (1.7, 1.7), (0.3, 0.4)] {
            agrees_with_the_dual(&kite(up, down));
        }
    }

    /// Angles of 2 atan(1 / h) opposite the diagonal, so `cot = (h - 1 / h) / 2`.
    #[test]
    fn an_edge_at_the_bound_keeps_it_and_one_below_does_not() {
        for (up, down) in [(1.1, 1.1), (1.0, 1.2), (1.3, 0.9)] {
            let ratio = 0.25 * (up - 1.0 / up + down - 1.0 / down);
            assert!(check_dual_edges(&kite(up, down), ratio, &[]).holds());
            let found = check_dual_edges(&kite(up, down), ratio + 1e-9, &[]);
            assert_eq!((found.below, found.excused), (1, 0));
            let worst = found.worst.unwrap();
            assert_eq!((worst.edge, worst.boundary), ([0, 1].map(VertexId::new), false));
            assert!((worst.ratio - ratio).abs() < 1e-15);
        }
    }

    /// Of a boundary edge there is half of the dual edge: cot / 2 of its length. It is held against half the bound.
    #[test]
    fn on_the_boundary_half_of_the_bound_counts() {
        let h = 1.1;
        let half = mesh(&[[-1.0, 0.0], [1.0, 0.0], [0.0, h]], &[[0, 1, 2]]);
        let cot = 0.5 * (h - 1.0 / h);
        let dual = Voronoi::new(&half).unwrap();
        let bottom = dual.edges.iter().find(|e| e.ends == [0, 1].map(VertexId::new)).unwrap();
        assert!((bottom.dual_length() / bottom.length - 0.5 * cot).abs() < 1e-15);
        assert!(check_dual_edges(&half, cot, &[]).holds());
        let found = check_dual_edges(&half, cot + 1e-9, &[]);
        assert!(found.below == 1 && found.worst.unwrap().boundary);
    }

    #[test]
    fn what_the_angle_bound_promises_is_so() {
        for ratio in [0.01, 0.1, 0.3] {
            let angle = max_angle_of_ratio(ratio).to_radians();
            let h = 1.0 / (0.5 * angle).tan();
            assert!(check_dual_edges(&kite(h, h), ratio, &[]).holds(), "{ratio}");
            assert_eq!(check_dual_edges(&kite(h, h), ratio * (1.0 + 1e-8), &[]).below, 1);
        }
    }

    #[test]
    fn edges_of_excused_triangles_are_counted_apart() {
        let found = check_dual_edges(&kite(1.0, 1.0), 0.1, &[TriangleId::new(1)]);
        assert!(found.holds() && found.excused == 1 && found.worst.unwrap().ratio == 0.0);
    }

    /// Far from the origin coordinates are rounded to what shows in ratios.
    #[test]
    fn rounding_is_excused_as_far_as_it_carries() {
        let at = |p: DVec2| DVec2::new(1e6, -2e6) + 0.01 * DVec2::new(0.6, 0.8).rotate(p);
        let mut far = kite(1.1, 1.1);
        far.vertices.iter_mut().for_each(|v| *v = at(*v));
        let ratio = 0.5 * (1.1 - 1.0 / 1.1);
        let worst = check_dual_edges(&far, ratio, &[]).worst.unwrap().ratio;
        assert!((worst - ratio).abs() > 1e-10, "{worst}");
        assert!(
            check_dual_edges(&far, ratio, &[]).holds() && !check_dual_edges(&far, ratio + 1e-5, &[]).holds()
        );
    }

    /// So far away that rounding may turn an angle by a twentieth of a radian, its cotangent may be what it is at the
    /// angle turned by that, and at one turned by half as much again it may not.
    #[test]
    fn a_cotangent_is_granted_what_is_granted_to_the_angle() {
        for (x, y) in [(9.0, 7.0), (8.0, 8.0), (7.0, 9.0)] {
            let at = DVec2::splat(2f64.powi(49));
            let corners = [at, at + DVec2::new(x, -y), at + DVec2::new(x, y)];
            let far = mesh(&corners.map(DVec2::into), &[[0, 1, 2]]);
            let granted = (ANGLE_TOLERANCE_DEG + rounding_slack_deg(corners)).to_radians();
            assert!((0.04..0.06).contains(&granted), "{granted}");
            let turned = |by: f64| 1.0 / (2.0 * (y / x).atan() - by).tan();
            assert!(check_dual_edges(&far, turned(granted), &[]).holds(), "{x}");
            assert!(!check_dual_edges(&far, turned(1.5 * granted), &[]).holds(), "{x}");
        }
    }

    /// Right isosceles triangles apart from each other, the right angle at the first corner of each.
    fn right(n: usize) -> TriMesh {
        let corners = |i: usize| [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| [x + 2.0 * i as f64, y]);
        let triangles: Vec<[usize; 3]> = (0..n).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        mesh(&(0..n).flat_map(corners).collect::<Vec<_>>(), &triangles)
    }

    #[test]
    fn an_edge_that_is_below_the_bound_by_all_that_is_granted_keeps_it() {
        let right = right(1);
        let hypotenuse = sides_of(&right, TriangleId::new(0), right.triangles[0]).find(|side| side.2 == 0.0);
        let granted = hypotenuse.unwrap().3;
        assert!(check_dual_edges(&right, granted, &[]).holds());
        assert_eq!(check_dual_edges(&right, granted.next_up(), &[]).below, 1);
    }

    #[test]
    fn the_first_edge_of_those_with_the_smallest_ratio_is_the_worst() {
        let worst = check_dual_edges(&right(2), 0.1, &[]).worst.unwrap();
        assert_eq!((worst.edge, worst.ratio), ([1, 2].map(VertexId::new), 0.0));
        assert_eq!(worst.ends, [DVec2::X, DVec2::Y]);
    }

    /// Triangles are handled a chunk at a time.
    #[test]
    fn excused_triangles_are_found_in_every_chunk() {
        let n = 2 * CHUNK + 5;
        let excused = [CHUNK - 1, CHUNK + 2, n - 1].map(TriangleId::new);
        let found = check_dual_edges(&right(n), 0.1, &excused);
        assert_eq!((found.edges, found.below, found.excused), (3 * n, n - 3, 3));
    }

    #[test]
    fn flat_and_clockwise_triangles_are_not_looked_at() {
        for last in [[2.0, 2.0], [2.0, 1.0]] {
            let found = check_dual_edges(&mesh(&[[0.0, 0.0], [1.0, 1.0], last], &[[0, 1, 2]]), 0.1, &[]);
            assert_eq!((found.edges, found.worst), (0, None));
        }
    }

    #[test]
    fn broken_meshes_are_no_reason_to_panic() {
        let mut broken = kite(1.0, 1.0);
        broken.vertices.push(DVec2::NAN);
        broken.triangles.extend([[0, 1, 9], [0, 0, 1], [0, 1, 4], [2, 1, 0]].map(|t| t.map(VertexId::new)));
        assert_eq!(check_dual_edges(&broken, 0.1, &[]).edges, 5);
        // The diagonal has three sides now.
        broken.triangles.push([0, 1, 2].map(VertexId::new));
        assert_eq!(check_dual_edges(&broken, 0.1, &[]).below, 0);
        assert_eq!(check_dual_edges(&TriMesh::default(), 0.1, &[]).worst, None);
    }
}
