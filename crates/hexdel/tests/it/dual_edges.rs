//! Bounds below 90 degrees, and the bound on edges of the Voronoi dual that asks for them: optimised for, checked
//! from scratch, refused where no mesh can keep it.

#![cfg(feature = "io")]

use hexdel::generate::{Kind, generate};
use hexdel::geom::Voronoi;
use hexdel::geom::certificate::DualCheck;
use hexdel::pslg::PslgError;
use hexdel::{
    AngleBounds, Error, MOST_DUAL_EDGE, Mesher, Method, Pslg, PslgTriangulation, SegmentMethod, Session,
    SessionError, TriMesh,
};

fn graph(name: &str) -> Pslg {
    let path = format!("{}/../../fixtures/graphs/{name}.poly", env!("CARGO_MANIFEST_DIR"));
    hexdel::io::read_points(path).unwrap()
}

/// The ratios of inner edges, and those of the boundary as they are: half of a dual edge each.
fn ratios(mesh: &TriMesh) -> [f64; 2] {
    let dual = Voronoi::new(mesh).unwrap();
    let least = |boundary| {
        let weights =
            dual.edges.iter().filter(|e| e.is_boundary() == boundary).map(|e| e.dual_length() / e.length);
        weights.fold(f64::INFINITY, f64::min)
    };
    [least(false), least(true)]
}

fn holds(found: Option<&DualCheck>, mesh: &TriMesh, ratio: f64) {
    let found = found.unwrap();
    assert!(found.holds() && found.min_ratio == ratio && found.excused == 0, "{found:?}");
    let [inner, boundary] = ratios(mesh);
    assert!(inner >= ratio - 1e-9 && boundary >= 0.5 * ratio - 1e-9, "{inner} {boundary}");
    let worst = found.worst.unwrap();
    let of_worst = if worst.boundary { 2.0 * boundary } else { inner };
    assert!((worst.ratio - of_worst).abs() < 1e-9, "{worst:?}");
}

#[test]
fn dual_edges_of_points_are_as_long_as_asked_for() {
    let points = generate(Kind::Uniform, 60, 3);
    let made = Mesher::new().triangulate(&points).unwrap();
    assert!(made.dual_edges.is_none() && ratios(&made.mesh)[0] < 0.1, "{:?}", ratios(&made.mesh));
    for (ratio, most) in [(0.05, 87.138), (0.15, 81.47)] {
        let made = Mesher::new().min_dual_edge(ratio).triangulate(&points).unwrap();
        holds(made.dual_edges.as_ref(), &made.mesh, ratio);
        assert!(
            (made.certificate.bounds.max_deg() - most).abs() < 1e-2,
            "{}",
            made.certificate.bounds.max_deg()
        );
        assert_eq!(made.certificate.bounds.min_deg(), AngleBounds::EXTENDED.min_deg());
        assert!(made.report().dual_edges.is_some());
    }
}

/// Of the angle that the ratio takes and the largest angle, the smaller counts.
#[test]
fn the_smaller_of_two_angles_counts() {
    let points = generate(Kind::Uniform, 20, 1);
    for (asked, most) in [(88.0, 84.2894), (80.0, 80.0)] {
        let bounds = AngleBounds::new(40.0, asked).unwrap();
        let made = Mesher::new().bounds(bounds).min_dual_edge(0.1).triangulate(&points).unwrap();
        assert!((made.certificate.bounds.max_deg() - most).abs() < 1e-4 && made.certificate.holds());
        holds(made.dual_edges.as_ref(), &made.mesh, 0.1);
    }
}

fn plate(mesher: &Mesher, name: &str) -> PslgTriangulation {
    let made = mesher.triangulate_pslg(&graph(name)).unwrap();
    assert!(made.holds(), "{name}: {:?} {:?}", made.failed, made.dual_edges);
    made
}

#[test]
fn pslgs_keep_upper_bounds_below_90_degrees() {
    let near = AngleBounds::new(30.0, 85.0).unwrap();
    let far = AngleBounds::new(43.8978, 85.0).unwrap();
    for name in ["square_with_hole", "airfoil", "regions"] {
        let made = plate(&Mesher::new().bounds(far).near_bounds(near), name);
        assert!(made.certificate.max_angle_deg <= 85.0 + 1e-8, "{name}");
        // The cotangent of 85 degrees.
        assert!(ratios(&made.mesh)[0] > 0.0874, "{name}");
    }
}

/// The segments between two regions and around a hole are edges like all others: inner ones keep the ratio, those on
/// the boundary half of it.
#[test]
fn dual_edges_across_segments_keep_the_ratio() {
    for name in ["square_with_hole", "airfoil", "regions"] {
        let made = plate(&Mesher::new().min_dual_edge(0.1), name);
        holds(made.dual_edges.as_ref(), &made.mesh, 0.1);
        assert!(made.report().dual_edges.is_some());
        let dual = Voronoi::new(&made.mesh).unwrap();
        let inner = made.edges.iter().filter(|e| !e.boundary);
        for edge in inner {
            let mut ends = edge.ends;
            ends.sort();
            let found = dual.edges.iter().find(|e| e.ends == ends).unwrap();
            assert!(found.weight >= 0.1 - 1e-9, "{name}: {found:?}");
        }
    }
}

/// A corner of 20 degrees: triangles in it are exempt, and their edges excused.
#[test]
fn edges_at_exempt_corners_are_excused_and_counted() {
    let mut sliver = Pslg::from_points([(0.0, 0.0), (1.0, 0.0), (1.0, 0.364)].map(Into::into).to_vec());
    sliver.segments = vec![[0, 1], [1, 2], [2, 0]];
    let made = Mesher::new().min_dual_edge(0.1).triangulate_pslg(&sliver).unwrap();
    let found = made.dual_edges.as_ref().unwrap();
    assert!(!made.exempt.is_empty());
    let exempt: Vec<_> = made.exempt.iter().map(|e| e.triangle).collect();
    let all = hexdel::geom::certificate::check_dual_edges(&made.mesh, 0.1, &[]);
    let rest = hexdel::geom::certificate::check_dual_edges(&made.mesh, 0.1, &exempt);
    assert_eq!((found.below + found.excused, found.below), (all.below, rest.below));
    assert_eq!(made.holds(), made.failed.is_empty() && found.below == 0);
}

#[test]
fn ratios_that_no_graded_mesh_keeps_are_refused_at_once() {
    let points = generate(Kind::Uniform, 5, 1);
    let square = graph("square_with_hole");
    for ratio in [0.325, 1.0, 0.0, -0.1, f64::NAN, f64::INFINITY] {
        let mesher = Mesher::new().min_dual_edge(ratio);
        let of_points = mesher.triangulate(&points).unwrap_err();
        let of_graph = mesher.triangulate_pslg(&square).unwrap_err();
        assert_eq!(of_points.to_string(), of_graph.to_string());
        assert!(matches!(of_points, Error::NoDualEdge { .. }), "{of_points}");
    }
    let error = Mesher::new().min_dual_edge(0.4).triangulate(&points).unwrap_err();
    let text = "the ratio of dual edges to edges must be positive and at most 0.324919, got 0.4: angles would have to be \
                at most 68.2 degrees, and no graded mesh has all below 72";
    assert_eq!(error.to_string(), text);
    assert!(
        hexdel::geom::certificate::max_angle_of_ratio(MOST_DUAL_EDGE) >= AngleBounds::LEAST_GRADED_MAX_DEG
    );
    let far = AngleBounds::new(30.0, 71.0).unwrap();
    let near = AngleBounds::new(30.0, 90.0).unwrap();
    let refused = Mesher::new().bounds(far).near_bounds(near).triangulate_pslg(&square).unwrap_err();
    assert_eq!(refused, Error::NoGrading { asked: far });
}

#[test]
fn what_is_not_optimised_is_refused_by_name() {
    let points = generate(Kind::Uniform, 5, 1);
    let mesher = Mesher::new().min_dual_edge(0.1);
    for method in [Method::Templates, Method::Simple] {
        let refused = mesher.clone().method(method).triangulate(&points).unwrap_err();
        assert!(matches!(refused, Error::BoundsBeyondMethod { .. }), "{refused}");
    }
    let paper =
        mesher.clone().segment_method(SegmentMethod::Paper).triangulate_pslg(&graph("regions")).unwrap_err();
    assert!(matches!(paper, Error::Pslg(PslgError::BoundsBeyondMethod { .. })), "{paper}");
    let session = Session::new(&points, &mesher).unwrap_err();
    assert!(matches!(session, SessionError::NotForSessions { option: "a bound on dual edges" }), "{session}");
}
