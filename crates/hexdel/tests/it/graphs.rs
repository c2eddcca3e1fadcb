//! PSLGs of points and segments: domains, bounds, repair, what the result
//! says, and errors that name what is at fault.

#![cfg(feature = "io")]

use crate::common::{self, graph};
use hexdel::geom::{Cancelled, Region, check_segments, orient2d};
use hexdel::pslg::{Feature, PslgError, Reason, Repair, ValidateError};
use hexdel::{
    AngleBounds, DVec2, Domain, Error, Mesher, Method, Monitor, Phase, Pslg, PslgTriangulation,
    SegmentMethod, TriangleId, triangulate_pslg,
};
use std::sync::Mutex;
use std::time::Duration;

fn area(made: &PslgTriangulation) -> f64 {
    let corners = (0..made.mesh.triangles.len()).map(|t| made.mesh.corners(TriangleId::new(t)));
    corners.map(|[a, b, c]| 0.5 * (b - a).perp_dot(c - a)).sum()
}

/// Holds a mesh to what is promised of it, by coordinates and indices alone.
#[track_caller]
fn hold(made: &PslgTriangulation) {
    assert!(made.holds(), "{:?}", made.failed);
    let corners = |t| made.mesh.corners(TriangleId::new(t));
    assert!((0..made.mesh.triangles.len()).map(corners).all(|[a, b, c]| orient2d(a, b, c) > 0.0));
    for (point, vertex) in made.graph.points.iter().zip(&made.vertex_of_point) {
        assert!(vertex.is_none_or(|v| made.mesh.vertices[v.index()] == *point));
    }
    let found = check_segments(&made.mesh, &made.mesh.vertices, &edges(made));
    assert_eq!(found.kept, made.edges.len());
    let mut counts = vec![0; made.graph.segments.len()];
    for segment in made.edges.iter().filter_map(|e| e.segment) {
        counts[segment as usize] += 1;
    }
    assert_eq!(counts, made.edges_of_segment);
}

fn edges(made: &PslgTriangulation) -> Vec<[u32; 2]> {
    made.edges.iter().map(|e| e.ends.map(|v| v.index() as u32)).collect()
}

/// Far bounds, areas by region and sizes are found out on the finished mesh.
#[test]
fn what_is_promised_by_place_is_certified() {
    let corners = [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (4.0, 0.0), (5.0, 9.0)];
    let mut plate = Pslg::from_points(corners.map(DVec2::from).to_vec());
    plate.segments = vec![[0, 4], [4, 1], [1, 2], [2, 5], [5, 3], [3, 0], [4, 5]];
    let region = |x, max_area| Region { point: DVec2::new(x, 4.0), attribute: x, max_area };
    plate.regions = vec![region(1.0, Some(0.2)), region(8.0, None)];
    let made = Mesher::new().max_area(0.7).triangulate_pslg(&plate).unwrap();
    hold(&made);
    assert!(made.places.holds() && made.places.far > 0, "{:?}", made.places);
    assert!(made.places.far_min_deg.unwrap() >= made.far_bounds.min_deg() - 1e-9);
    for (t, region) in made.region_of_triangle.iter().enumerate() {
        let [a, b, c] = made.mesh.corners(TriangleId::new(t));
        let limit = if *region == Some(0) { 0.2 } else { 0.7 };
        assert!(0.5 * (b - a).perp_dot(c - a) <= limit);
    }
    // Regions found anew in the mesh are those that the mesher tells.
    let seeds: Vec<DVec2> = plate.regions.iter().map(|r| r.point).collect();
    let edges = &made.segments.edges;
    assert_eq!(hexdel::geom::segments::faces(&made.mesh, edges, &seeds), made.region_of_triangle);
    assert_eq!(made.report().far_triangles, made.places.far);
}

/// Positions along a track with a centimetre of noise: the hull is a needle. Points and
/// sides of it are in the mesh, with no budget left as well.
#[test]
fn a_hull_of_a_centimetre_by_a_kilometre() {
    let noise = [0.005, 0.002, -0.009, -0.005, -0.001];
    let at = |(i, y)| DVec2::new(500_000.0 + 250.0 * f64::from(i), 5_200_000.0 + y);
    let track = Pslg::from_points((0..).zip(noise).map(at).collect());
    let made = Mesher::new().domain(Domain::Hull).budget(Duration::ZERO).triangulate_pslg(&track).unwrap();
    assert!(made.budget_spent && made.segments.missing.is_empty());
    let c = &made.certificate;
    let broken = c.not_counter_clockwise + c.malformed + c.repeated_edges + c.unused_vertices;
    assert_eq!((broken, c.inputs_kept, c.inputs), (0, 5, 5));
    let listed = made.failed.len() + made.exempt.len();
    assert!(made.certificate.out_of_bounds <= listed && !made.holds());
}

#[test]
fn holes_are_left_out_and_markers_kept() {
    let made = triangulate_pslg(&graph("square_with_hole")).unwrap();
    hold(&made);
    assert_eq!(made.domain, Domain::Inside);
    assert!((area(&made) - 15.0).abs() < 1e-12, "{}", area(&made));
    assert_eq!((made.certificate.boundary_loops, made.certificate.euler_characteristic), (2, 0));
    let marker_of = |p: usize| made.vertex_markers[made.vertex_of_point[p].unwrap().index()];
    assert_eq!([0, 4].map(marker_of), [1, 2]);
    for edge in &made.edges {
        assert!(edge.boundary);
        assert_eq!(edge.marker, made.graph.segment_markers[edge.segment.unwrap() as usize]);
    }
    assert!(made.point_of_vertex.iter().flatten().count() == 8 && made.repairs.is_none());
}

#[test]
fn regions_are_told_apart_and_keep_their_areas() {
    let made = triangulate_pslg(&graph("regions")).unwrap();
    hold(&made);
    assert_eq!(made.vertex_of_point[8], None);
    let attributes = made.region_attributes();
    for (t, (region, attribute)) in made.region_of_triangle.iter().zip(attributes).enumerate() {
        let [a, b, c] = made.mesh.corners(TriangleId::new(t));
        let east = (a.x + b.x + c.x) / 3.0 > 2.0;
        assert_eq!((*region, attribute), if east { (Some(1), 20.0) } else { (Some(0), 10.5) });
        assert!(east || 0.5 * (b - a).perp_dot(c - a) <= 0.05);
    }
}

#[test]
fn a_point_on_a_segment_divides_it() {
    let made = triangulate_pslg(&graph("t_junction")).unwrap();
    hold(&made);
    // Segment 0, its two parts, is a chain from point 0 by point 4 to point 1.
    let chain: Vec<_> = made.edges.iter().filter(|e| e.segment == Some(0)).collect();
    assert!(chain.windows(2).all(|w| w[0].ends[1] == w[1].ends[0]));
    let ends = [chain[0].ends[0], chain[chain.len() - 1].ends[1]];
    assert_eq!(ends.map(Some), [0, 1].map(|p: usize| made.vertex_of_point[p]));
    assert!(chain.iter().any(|e| Some(e.ends[0]) == made.vertex_of_point[4]));
    assert_eq!(made.segments.segments, 6);
}

#[test]
fn every_domain_covers_what_it_should() {
    let points = Pslg::from_points(common::points("plane100"));
    let covered = |graph: &Pslg, domain| {
        let made = Mesher::new().domain(domain).triangulate_pslg(graph).unwrap();
        hold(&made);
        assert_eq!(made.domain, domain);
        assert!(made.certificate.disk && made.certificate.inputs == 100);
        assert_eq!(made.vertex_of_point.iter().flatten().count(), 100);
        area(&made)
    };
    let [hexagon, boxed, hull] = [Domain::Hexagon, Domain::Box, Domain::Hull].map(|d| covered(&points, d));
    assert!(hexagon > boxed && boxed > hull && hull > 0.8, "{hexagon} {boxed} {hull}");
    let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (min, max) = points.points.iter().fold(start, |(min, max), &p| (min.min(p), max.max(p)));
    let side = (max - min) + 0.2 * (max - min).max_element();
    assert!((boxed - side.x * side.y).abs() < 1e-12);

    // Holes are left out of each, the outside of the outline of none.
    let plate = graph("square_with_hole");
    for (domain, expected) in [(Domain::Hull, 15.0), (Domain::Box, 4.8 * 4.8 - 1.0), (Domain::Inside, 15.0)] {
        let made = Mesher::new().domain(domain).triangulate_pslg(&plate).unwrap();
        hold(&made);
        assert!((area(&made) - expected).abs() < 1e-12, "{domain:?}: {}", area(&made));
        assert_eq!(made.edges_of_segment.len(), 8);
        assert!(made.edges.iter().all(|e| e.segment.is_none_or(|s| s < 8)));
    }
}

#[test]
fn narrow_corners_are_exempt_or_blamed() {
    let mut kite = graph("narrow");
    // Without the corner of 3 degrees.
    kite.points[7] = DVec2::new(4.0, 3.0);
    let made = triangulate_pslg(&kite).unwrap();
    hold(&made);
    assert!(made.exempt.iter().all(|e| matches!(e.reason, Reason::Sector { point: 4 | 7, .. })));
    let corner = made.report().exempt[0].corner.unwrap();
    assert!(corner.at == kite.points[corner.point as usize] && (corner.angle_deg - 12.0).abs() < 1e-6);

    let made = triangulate_pslg(&graph("narrow")).unwrap();
    hold(&made);
    assert!(made.exempt.iter().all(|e| matches!(e.reason, Reason::Sector { point: 4 | 7, .. })));

    let needle = |angle_deg: f64| {
        let apex = DVec2::new(4.0, 3.0 + angle_deg.to_radians().tan());
        let mut needle = graph("narrow");
        needle.points = vec![DVec2::ZERO, DVec2::new(8.0, 0.0), DVec2::new(8.0, 6.0), DVec2::new(0.0, 6.0)];
        needle.points.extend([DVec2::new(3.0, 3.0), DVec2::new(4.0, 3.0), apex]);
        needle.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [4, 6]];
        needle
    };
    let made = triangulate_pslg(&needle(0.1)).unwrap();
    hold(&made);
    let apex = made.vertex_of_input()[4].unwrap();
    assert!(made.exempt.iter().all(|e| made.mesh.triangles[e.triangle.index()].contains(&apex)));

    // A two-hundredth of a degree, for which the method is not made.
    let made = triangulate_pslg(&needle(0.005)).unwrap();
    let report = made.report();
    assert!(!made.holds() && !report.holds && !report.failed.is_empty());
    assert_eq!(report.certificate.out_of_bounds, report.failed.len() + report.exempt.len());
    for entry in &report.failed {
        assert!(entry.reason == "near sector" && entry.corner.unwrap().point == 4, "{entry}");
    }
    assert!(made.segments.missing.is_empty());
}

#[test]
fn what_crosses_is_named_and_repaired() {
    let crossing = graph("crossing");
    let at = DVec2::splat(0.5);
    let error = triangulate_pslg(&crossing).unwrap_err();
    assert_eq!(error, Error::Segments(ValidateError::Crossing { segments: [4, 5], at }));
    let made = Mesher::new().repair().triangulate_pslg(&crossing).unwrap();
    hold(&made);
    let repairs = made.repairs.as_ref().unwrap();
    assert_eq!(repairs.repairs, [Repair::DividedAtCrossing { segments: [4, 5], at }]);
    assert_eq!(repairs.sources.iter().flatten().count(), 8);
    assert_eq!(made.vertex_of_input().iter().flatten().count(), 4);
    assert_eq!(made.report().repairs[0].to_string(), "segments 4 and 5 crossed at (0.5, 0.5)");
}

#[test]
fn what_coordinates_do_not_resolve_is_named_and_repaired() {
    let needle = graph("needle");
    let error = triangulate_pslg(&needle).unwrap_err();
    let Error::Pslg(PslgError::TooClose { items, .. }) = error else { panic!("{error}") };
    assert!(items.contains(&Feature::Point(4)) && items.contains(&Feature::Segment(0)), "{items:?}");
    hold(&Mesher::new().repair().triangulate_pslg(&needle).unwrap());
    hold(&Mesher::new().repair_within(1e-6).triangulate_pslg(&needle).unwrap());
    // A tolerance too small to repair it: the items keep their numbers.
    let mut twice = needle.clone();
    twice.points.insert(0, DVec2::ZERO);
    twice.segments.iter_mut().flatten().for_each(|p| *p += 1);
    let error = Mesher::new().repair_within(0.0).triangulate_pslg(&twice).unwrap_err();
    let Error::Pslg(PslgError::TooClose { items, .. }) = error else { panic!("{error}") };
    assert!(items.contains(&Feature::Point(5)), "{items:?}");
}

/// Fewer triangles, under the same promises.
#[test]
fn compact_meshes_are_smaller() {
    for name in ["square_with_hole", "letters", "airfoil"] {
        let mesh = |method| Mesher::new().method(method).triangulate_pslg(&graph(name)).unwrap();
        let (compact, templates) = (mesh(Method::Compact), mesh(Method::Templates));
        hold(&compact);
        hold(&templates);
        assert!(compact.mesh.triangles.len() < templates.mesh.triangles.len(), "{name}");
    }
}

/// The paper's way keeps segments and orientation, and its bounds elsewhere.
#[test]
fn the_papers_way_keeps_what_it_promises() {
    let mesher = Mesher::new().segment_method(SegmentMethod::Paper);
    let made = mesher.triangulate_pslg(&graph("square_with_hole")).unwrap();
    hold(&made);
    assert_eq!((made.method, made.report().method), (SegmentMethod::Paper, "paper"));
    assert!(made.report().failed.iter().all(|entry| entry.reason == "template"));
}

#[test]
fn bounds_hold_where_they_are_asked_for() {
    let letters = graph("square_with_hole");
    for (bounds, least) in [([30.0, 90.0], 30.0), ([40.0, 90.0], 40.0), ([20.0, 90.0], 20.0)] {
        let bounds = AngleBounds::new(bounds[0], bounds[1]).unwrap();
        let made = Mesher::new().bounds(bounds).triangulate_pslg(&letters).unwrap();
        assert!(made.holds() && made.certificate.min_angle_deg >= least - 1e-8, "{:?}", made.failed);
        assert_eq!(made.certificate.bounds, bounds);
    }
    let tight = AngleBounds::new(50.0, 80.0).unwrap();
    let error = Mesher::new().bounds(tight).triangulate_pslg(&letters).unwrap_err();
    assert!(matches!(error, Error::Pslg(PslgError::BoundsBeyondMethod { .. })), "{error}");
}

#[test]
fn options_without_a_use_are_refused() {
    let plate = graph("square_with_hole");
    for mesher in [
        Mesher::new().method(Method::Simple),
        Mesher::new().domain_radius(9.0),
        Mesher::new().coarsening(false),
    ] {
        assert!(matches!(mesher.triangulate_pslg(&plate), Err(Error::NotForGraphs { .. })));
    }
    let near = AngleBounds::new(20.0, 90.0).unwrap();
    for mesher in [
        Mesher::new().domain(Domain::Hull),
        Mesher::new().near_bounds(near),
        Mesher::new().max_area(1.0),
        Mesher::new().repair(),
        Mesher::new().segment_method(SegmentMethod::Paper),
    ] {
        assert!(matches!(mesher.triangulate(&plate.points), Err(Error::NotForPoints { .. })));
    }
    assert!(Mesher::new().domain(Domain::Hexagon).triangulate(&plate.points).is_ok());
    for tolerance in [f64::NAN, -1.0, f64::INFINITY] {
        let error = Mesher::new().repair_within(tolerance).triangulate_pslg(&plate).unwrap_err();
        assert!(matches!(error, Error::InvalidTolerance { .. }), "{error}");
    }
    assert!(matches!(
        Mesher::new().max_area(-1.0).triangulate_pslg(&plate),
        Err(Error::Pslg(PslgError::InvalidArea { .. }))
    ));
}

#[test]
fn graphs_that_are_none_are_refused() {
    let mut open = graph("square_with_hole");
    open.segments.truncate(3);
    open.segment_markers.clear();
    open.holes.clear();
    let error = triangulate_pslg(&open).unwrap_err();
    assert!(matches!(&error, Error::Pslg(PslgError::NothingEnclosed { count: 2, .. })), "{error}");
    let [a, b] = [open.points[0], open.points[3]].map(|p| format!("({}, {})", p.x, p.y));
    assert!(error.to_string().ends_with(&format!("; loose ends: point 0 at {a}, point 3 at {b}")), "{error}");
    let far = Pslg { segments: vec![[0, 7]], ..Pslg::from_points(vec![DVec2::ZERO]) };
    assert!(matches!(triangulate_pslg(&far), Err(Error::Segments(ValidateError::Layout(_)))));
    for domain in [Domain::Box, Domain::Hull, Domain::Hexagon] {
        let mesher = Mesher::new().domain(domain);
        assert!(matches!(mesher.triangulate_pslg(&Pslg::default()), Err(Error::Points(_))));
        let nan = Pslg::from_points(vec![DVec2::ZERO, DVec2::NAN]);
        assert!(matches!(mesher.triangulate_pslg(&nan), Err(Error::Points(_))));
    }
    // One point has no size, but a box.
    hold(&Mesher::new().domain(Domain::Box).triangulate_pslg(&Pslg::from_points(vec![DVec2::ONE])).unwrap());
}

#[test]
fn threads_do_not_change_a_byte() {
    let letters = graph("airfoil");
    let bits = |threads| {
        let made = Mesher::new().threads(threads).triangulate_pslg(&letters).unwrap();
        (common::bits_of(&made.mesh), made.edges, made.vertex_markers)
    };
    let one = bits(1);
    assert!(one == bits(2) && one == bits(5));
}

#[test]
fn progress_comes_and_work_stops() {
    #[derive(Default)]
    struct Log(Mutex<Vec<Phase>>);
    impl Monitor for Log {
        fn progress(&self, phase: Phase, done: u64, total: u64) {
            assert!(done <= total);
            self.0.lock().unwrap().push(phase);
        }
    }
    struct Never;
    impl Monitor for Never {
        fn cancelled(&self) -> bool {
            true
        }
    }
    let plate = graph("square_with_hole");
    let log = Log::default();
    let made = Mesher::new().triangulate_pslg_watched(&plate, &log).unwrap();
    let log = log.0.into_inner().unwrap();
    for phase in [Phase::Refine, Phase::Extract, Phase::Optimize, Phase::Certify] {
        assert!(log.contains(&phase), "{phase:?}");
    }
    let s = made.seconds;
    assert!(s.total > 0.0 && (s.refine + s.extract + s.certify - s.total).abs() < 1e-9);
    let stopped = Mesher::new().triangulate_pslg_watched(&plate, &Never).unwrap_err();
    assert_eq!(stopped, Error::Cancelled(Cancelled));
}
