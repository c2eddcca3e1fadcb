//! The effort that searches for few Steiner points.

#![cfg(feature = "io")]

use crate::common::graph;
use hexdel::{AngleBounds, Effort, Mesher, Pslg, PslgTriangulation, Size};

fn mesher(min_deg: f64, effort: Effort) -> Mesher {
    let bounds = AngleBounds::new(min_deg, 90.0).unwrap();
    Mesher::new().bounds(bounds).near_bounds(bounds).effort(effort)
}

fn meshed(mesher: &Mesher, pslg: &Pslg) -> PslgTriangulation {
    let made = mesher.triangulate_pslg(pslg).unwrap();
    assert!(made.holds(), "{:?}", made.failed);
    assert!(made.certificate.delaunay && made.certificate.max_angle_deg <= 90.0 + 1e-9);
    made
}

#[test]
fn a_search_finds_fewer_triangles_than_removals() {
    // Share of the triangles at best effort, at most, at 0 and at 30 degrees.
    for (name, most) in [
        ("narrow", [0.1, 0.1]),
        ("splinter", [0.1, 1.0]),
        ("square_with_hole", [0.8, 0.9]),
        ("t_junction", [0.5, 1.0]),
    ] {
        for (min_deg, most) in [0.0, 30.0].into_iter().zip(most) {
            let pslg = graph(name);
            let [best, fewest] = [Effort::Best, Effort::Fewest]
                .map(|effort| meshed(&mesher(min_deg, effort), &pslg).mesh.triangles.len());
            assert!(fewest as f64 <= most * best as f64, "{name} {min_deg}: {fewest} {best}");
        }
    }
}

#[test]
fn a_search_is_the_same_at_any_number_of_threads() {
    let pslg = graph("narrow");
    let [one, two] = [1, 2].map(|threads| meshed(&mesher(0.0, Effort::Fewest).threads(threads), &pslg).mesh);
    assert_eq!(one, two);
}

/// What the search does not know is left to best effort.
#[test]
fn sizes_and_other_bounds_are_those_of_best_effort() {
    let pslg = graph("square_with_hole");
    let sized = |effort| mesher(30.0, effort).size(Size::constant(1.0).unwrap());
    let tighter = |effort| mesher(43.0, effort);
    let by_place = |effort| Mesher::new().effort(effort);
    for mesher in [&sized as &dyn Fn(Effort) -> Mesher, &tighter, &by_place] {
        let [best, fewest] = [Effort::Best, Effort::Fewest].map(|effort| meshed(&mesher(effort), &pslg).mesh);
        assert_eq!(best, fewest);
    }
}
