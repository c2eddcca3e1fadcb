//! The mesh against spade's Delaunay triangulation of its vertices.
//!
//! A triangle with no vertex on or in its circumcircle but its corners belongs
//! to every Delaunay triangulation of the vertices. So a triangle of ours that
//! spade has not must have a fourth vertex exactly on its circle, and then the
//! apex of one of its neighbours lies there as well: the vertices on an empty
//! circle form a convex polygon that our triangles divide.
//!
//! Spade triangulates the convex hull. The sides of our patch are straight but
//! for rounding, so its hull has slivers along them that our mesh has not; all
//! else must be equal in number.

#![cfg(feature = "io")]

use crate::common;
use hexdel::geom::incircle;
use hexdel::{DVec2, Mesher, Triangulation, VertexId};
use proptest::prelude::*;
use spade::{DelaunayTriangulation, Point2, Triangulation as _};
use std::collections::{BTreeMap, BTreeSet};

type Triangle = [usize; 3];

/// The corners in order from the lowest: one name for each oriented triangle.
fn named([a, b, c]: Triangle) -> Triangle {
    match a.min(b).min(c) {
        low if low == a => [a, b, c],
        low if low == b => [b, c, a],
        _ => [c, a, b],
    }
}

fn by_spade(vertices: &[DVec2]) -> BTreeSet<Triangle> {
    let points = vertices.iter().map(|v| Point2::new(v.x, v.y)).collect();
    let made = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(points).unwrap();
    assert_eq!(made.num_vertices(), vertices.len(), "no two vertices coincide");
    made.inner_faces().map(|f| named(f.vertices().map(|v| v.index()))).collect()
}

/// Whether a triangle has hardly any area for its size.
fn is_sliver(t: Triangle, vertices: &[DVec2]) -> bool {
    let [a, b, c] = t.map(|v| vertices[v]);
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    (b - a).perp_dot(c - a) < 1e-6 * longest
}

fn agrees(made: &Triangulation) {
    let vertices = &made.mesh.vertices;
    let ours: BTreeSet<Triangle> =
        made.mesh.triangles.iter().map(|t| named(t.map(VertexId::index))).collect();
    let theirs = by_spade(vertices);
    let mut apexes = BTreeMap::new();
    for &[a, b, c] in &ours {
        apexes.extend([((a, b), c), ((b, c), a), ((c, a), b)]);
    }
    for t in ours.difference(&theirs) {
        let [a, b, c] = *t;
        let beside = [(b, a), (c, b), (a, c)].into_iter().filter_map(|edge| apexes.get(&edge));
        let corners = t.map(|v| vertices[v]);
        let mut signs = beside.map(|&d| incircle(corners[0], corners[1], corners[2], vertices[d]));
        assert!(signs.any(|sign| sign == 0.0), "{corners:?} is in no Delaunay triangulation");
    }
    let slivers = theirs.difference(&ours).filter(|t| is_sliver(**t, vertices));
    let slivers: Vec<&Triangle> = slivers.collect();
    let rim = apexes.keys().filter(|&&(a, b)| !apexes.contains_key(&(b, a)));
    let rim: BTreeSet<usize> = rim.map(|edge| edge.0).collect();
    assert!(slivers.iter().all(|t| t.iter().all(|v| rim.contains(v))), "slivers inside: {slivers:?}");
    assert_eq!(theirs.len() - slivers.len(), ours.len());
}

#[test]
fn fixtures_agree_with_spade() {
    for fixture in common::fixtures() {
        for (method, _) in common::METHODS {
            if let Ok(made) = Mesher::new().method(method).triangulate(&fixture.points) {
                agrees(&made);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_points_agree_with_spade(
        raw in prop::collection::vec((-1.0..1.0, -1.0..1.0), 1..30),
        method in 0..common::METHODS.len(),
    ) {
        let points: Vec<DVec2> = raw.into_iter().map(DVec2::from).collect();
        let (method, _) = common::METHODS[method];
        agrees(&Mesher::new().method(method).triangulate(&points).unwrap());
    }
}
