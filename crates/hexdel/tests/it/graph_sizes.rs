//! Edges of the meshes of PSLGs no longer than wanted, or listed, and sizes that
//! are refused.

#![cfg(feature = "io")]

use crate::common::graph;
use hexdel::pslg::{PslgError, Reason};
use hexdel::{
    DVec2, Domain, Error, Mesher, Method, Pslg, PslgTriangulation, Raster, SegmentMethod, Size, SizeError,
    triangle_fits,
};

/// The corners of the rectangle around a PSLG.
fn bounds(graph: &Pslg) -> [DVec2; 2] {
    let start = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    graph.points.iter().fold(start, |[low, high], &p| [low.min(p), high.max(p)])
}

/// Sizes for a PSLG in a rectangle, each a part of its longer side.
fn sizes([low, high]: [DVec2; 2]) -> Vec<(&'static str, Size)> {
    let (side, at) = ((high - low).max_element(), |x, y| low + (high - low) * DVec2::new(x, y));
    let values = vec![Some(0.05 * side), None, Some(0.2 * side), Some(0.1 * side)];
    let raster = Raster { columns: 2, rows: 2, low, cell: 0.5 * side, values };
    let corner = [(at(0.0, 0.0), 0.01 * side), (at(0.7, 0.4), 0.03 * side)];
    let triangle = vec![at(0.1, 0.1), at(0.6, 0.15), at(0.2, 0.7)];
    let function = move |p: DVec2| 0.04 * side + 0.2 * p.distance(low);
    vec![
        ("constant", Size::constant(0.06 * side).unwrap()),
        ("box", Size::unlimited().and_box(at(0.3, 0.3), at(0.5, 0.6), 0.02 * side).unwrap()),
        ("points", Size::constant(0.3 * side).unwrap().and_points(&corner).unwrap()),
        ("raster", Size::unlimited().and_raster(&raster).unwrap()),
        (
            "polygon",
            Size::unlimited().with_gradation(0.2).unwrap().and_polygon(triangle, 0.03 * side).unwrap(),
        ),
        ("function", Size::function(function)),
    ]
}

/// Whether every edge fits, or a triangle that has it is listed.
fn assert_sized(made: &PslgTriangulation, size: &Size, what: &str) {
    let listed = |t: usize| made.failed.iter().any(|f| f.triangle.index() == t);
    for (i, t) in made.mesh.triangles.iter().enumerate() {
        let corners = t.map(|v| made.mesh.vertices[v.index()]);
        assert!(triangle_fits(size, corners) || listed(i), "{what}: {corners:?}");
    }
    let is_long = |f: &hexdel::pslg::Exception| matches!(f.reason, Reason::TooLong { .. });
    let long = made.failed.iter().any(is_long);
    assert!(long || made.size_ratio.is_some_and(|r| r <= 1.0 + 1e-9), "{what}: {:?}", made.size_ratio);
    assert_eq!(made.report().size_ratio, made.size_ratio);
}

#[test]
fn every_edge_is_as_short_as_wanted_and_every_angle_kept() {
    for name in ["square_with_hole", "narrow", "letters"] {
        let graph = graph(name);
        for (kind, size) in sizes(bounds(&graph)) {
            let what = format!("{name}, {kind}");
            let made = Mesher::new().size(size.clone()).triangulate_pslg(&graph).unwrap();
            assert_sized(&made, &size, &what);
            assert!(made.holds() && made.failed.is_empty(), "{what}: {:?}", made.failed);
        }
    }
}

#[test]
fn every_way_and_domain_keeps_to_sizes() {
    let plate = graph("square_with_hole");
    let size = Size::constant(0.6).unwrap();
    for domain in [Domain::Hexagon, Domain::Hull, Domain::Box, Domain::Inside] {
        for method in [Method::Compact, Method::Templates] {
            let mesher = Mesher::new().method(method).domain(domain).size(size.clone());
            let made = mesher.triangulate_pslg(&plate).unwrap();
            assert_sized(&made, &size, domain.name());
            assert!(made.holds(), "{domain:?}, {method:?}: {:?}", made.failed);
        }
    }
    let made = Mesher::new().segment_method(SegmentMethod::Paper).size(size.clone()).triangulate_pslg(&plate);
    assert_sized(&made.unwrap(), &size, "paper");
    let alone = Pslg::from_points(vec![DVec2::ONE]);
    let made = Mesher::new().size(Size::constant(0.2).unwrap()).triangulate_pslg(&alone).unwrap();
    assert!(made.holds() && made.size_ratio.is_some_and(|r| r <= 1.0 + 1e-9));
}

#[test]
fn a_sized_mesh_is_the_same_at_any_number_of_threads() {
    let letters = graph("letters");
    for (kind, size) in sizes(bounds(&letters)).into_iter().take(3) {
        let made = |threads| Mesher::new().threads(threads).size(size.clone()).triangulate_pslg(&letters);
        assert!(made(1).unwrap().mesh == made(2).unwrap().mesh, "{kind}");
    }
}

#[test]
fn sizes_of_graphs_that_cannot_be_had_are_refused() {
    let plate = graph("square_with_hole");
    let refused = |size: Size| match Mesher::new().size(size).triangulate_pslg(&plate) {
        Err(error) => error,
        Ok(made) => panic!("{}", made.mesh.triangles.len()),
    };
    let below = refused(Size::constant(1e-13).unwrap());
    assert!(matches!(below, Error::Size(SizeError::BelowResolution { .. })), "{below}");
    let many = refused(Size::constant(1e-6).unwrap());
    assert!(matches!(many, Error::Pslg(PslgError::TooMany { .. })), "{many}");
    for bad in [0.0, -1.0, f64::NAN] {
        let error = refused(Size::function(move |_| bad));
        assert!(matches!(error, Error::Size(SizeError::NotPositive { .. })), "{error}");
        let spot = move |p: DVec2| if p.distance(DVec2::new(0.5, 0.5)) < 0.3 { bad } else { 1.0 };
        let error = refused(Size::function(spot));
        assert!(matches!(error, Error::Size(SizeError::NotPositive { .. })), "{error}");
    }
}

#[test]
fn edges_that_cannot_be_shorter_are_listed() {
    // What coordinates resolve around a corner ends before the size does.
    let plate = graph("square_with_hole");
    let cusp = Size::function(|p| 1e-300 + 0.5 * p.distance(DVec2::new(0.37, 0.41)));
    let made = Mesher::new().size(cusp.clone()).triangulate_pslg(&plate).unwrap();
    assert_sized(&made, &cusp, "cusp");
    assert!(!made.holds() && made.failed.iter().all(|f| matches!(f.reason, Reason::TooLong { .. })));
    let report = made.report();
    let first = report.failed.first().unwrap();
    assert!(first.reason == "too long" && first.lengths.is_some_and(|[length, limit]| length > limit));
    assert!(first.to_string().contains("an edge of length"), "{first}");
    assert!(made.certificate.out_of_bounds == 0 && made.size_ratio.is_some_and(|r| r > 1.0));
}
