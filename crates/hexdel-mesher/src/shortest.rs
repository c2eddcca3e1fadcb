//! The shortest edge that is promised (paper, section 6.3).
//!
//! The paper bounds edges by `l_min = d_min sqrt(7) / (12 sqrt(3))`, `d_min` the distance of
//! the closest two points. What else makes a mesh fine stands in for `d_min` where it is
//! less: a size that is wanted, and in a session, whose domain is there before its points,
//! the distance of a point to a corner or side of it.

use crate::placement::{Placement, corners, finest_spacing};
use crate::size::Size;
use hexdel_geom::{DVec2, LENGTH_TOLERANCE, PointSet, TriMesh, closest_pair};
use hexdel_optimize::Sizing;

/// The paper's bound on the shortest edge over the distance of the closest
/// pair (section 6.3): `sqrt(7) / (12 sqrt(3))`.
const SHORTEST_EDGE: f64 = 0.127_293_769_304_328_9;

/// The shortest edge that there may be where nothing asks for less than `features`.
fn shortest_edge(features: impl IntoIterator<Item = Option<f64>>) -> Option<f64> {
    let least = features.into_iter().flatten().min_by(f64::total_cmp)?;
    Some(SHORTEST_EDGE * least)
}

/// The same of points in a mesh made at once, and of the least size wanted. A single point has
/// no scale but that of the lattice around it.
pub(crate) fn of_placement(placement: &Placement, wanted: Option<f64>) -> Option<f64> {
    let alone = placement.closest.map_or(placement.lattice.spacing(0), |_| f64::INFINITY);
    shortest_edge([placement.closest, wanted.map(|wanted| wanted.min(alone))])
}

/// The same of the mesh of a session in a hexagon: what its points, its domain and its sizes
/// ask for.
pub fn of_session(
    points: &[DVec2],
    (centre, radius): (DVec2, f64),
    mesh: &TriMesh,
    size: Option<&Size>,
) -> Option<f64> {
    let corners = corners(centre, radius);
    let all: Vec<DVec2> = points.iter().copied().chain(corners).collect();
    // Points of a session are finite: they were checked when they came.
    let closest = PointSet::new(&all).ok().and_then(|set| closest_pair(set.sites()));
    let to_sides = points.iter().filter_map(|&p| distance_to_sides(p, &corners)).min_by(f64::total_cmp);
    let wanted = size.map(|size| least_wanted(mesh, size));
    shortest_edge([closest.map(|pair| pair.distance), to_sides, wanted])
}

/// Whether an edge of a mesh is shorter than `least` by more than a certificate tolerates.
pub fn has_shorter_edge(mesh: &TriMesh, least: f64) -> bool {
    let least = least * (1.0 - LENGTH_TOLERANCE);
    mesh.triangles.iter().any(|t| {
        let [a, b, c] = t.map(|v| mesh.vertices[v.index()]);
        a.distance(b).min(b.distance(c)).min(c.distance(a)) < least
    })
}

/// The distance of a point to the lines of the sides that it does not lie on, up to rounding.
fn distance_to_sides(p: DVec2, corners: &[DVec2; 6]) -> Option<f64> {
    let sides = (0..6).map(|i| {
        let (a, along) = (corners[i], corners[(i + 1) % 6] - corners[i]);
        (along.perp_dot(p - a) / along.length()).abs()
    });
    sides.filter(|d| *d > finest_spacing(p.abs().max(corners[0].abs()))).min_by(f64::total_cmp)
}

/// The least size wanted at the ends and middles of a mesh's edges.
pub(crate) fn least_wanted(mesh: &TriMesh, size: &Size) -> f64 {
    let at_vertices = mesh.vertices.iter().map(|&v| size.at(v));
    let at_edges = mesh.triangles.iter().flat_map(|t| {
        let [a, b, c] = t.map(|v| mesh.vertices[v.index()]);
        [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)].map(|p| size.at(p))
    });
    at_vertices.chain(at_edges).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_is_the_papers() {
        assert!((SHORTEST_EDGE - 7_f64.sqrt() / (12.0 * 3_f64.sqrt())).abs() < 1e-15);
        assert_eq!(shortest_edge([None, None]), None);
        assert_eq!(shortest_edge([None, Some(2.0), Some(1.0)]), Some(SHORTEST_EDGE));
    }

    #[test]
    fn of_a_session_the_domain_counts_as_well() {
        let mesh = TriMesh::default();
        let of =
            |points: &[DVec2]| of_session(points, (DVec2::ZERO, 1.0), &mesh, None).map(|l| l / SHORTEST_EDGE);
        assert!((of(&[]).unwrap() - 1.0).abs() < 1e-12);
        assert!((of(&[DVec2::ZERO, DVec2::new(0.1, 0.0)]).unwrap() - 0.1).abs() < 1e-12);
        // Near the side in the north; on it, a tenth from the corner and nearer to the line of
        // the next side; at a corner.
        let north = 0.75_f64.sqrt();
        assert!((of(&[DVec2::new(0.0, north - 0.01)]).unwrap() - 0.01).abs() < 1e-12);
        assert!((of(&[DVec2::new(0.4, north)]).unwrap() - 0.1 * north).abs() < 1e-12);
        assert!(of(&[DVec2::new(1.0, 0.0)]).unwrap() > 0.8);
    }
}
