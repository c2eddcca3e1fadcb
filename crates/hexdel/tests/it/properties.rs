//! What holds for every input, tried on random ones, by every method. What the
//! compact method promises alone is in `compact.rs`.
//!
//! A failing case is not kept by proptest: once understood it goes to
//! `fixtures/regressions`, where every later test sees it.

#![cfg(feature = "io")]

use crate::common::{self, bits, hold};
use hexdel::generate::{Kind, generate};
use hexdel::{DVec2, Error, Mesher, Method, Triangulation, Unwatched};
use hexdel_grid::Lattice;
use hexdel_refine::{Refiner, RuleSet};
use proptest::prelude::*;

fn config() -> ProptestConfig {
    ProptestConfig { failure_persistence: None, ..ProptestConfig::default() }
}

fn vectors(raw: Vec<(f64, f64)>) -> Vec<DVec2> {
    raw.into_iter().map(DVec2::from).collect()
}

/// Points without pattern, points full of ties, and every generator.
fn point_sets(most: usize) -> impl Strategy<Value = Vec<DVec2>> {
    let plain = prop::collection::vec((-1.0..1.0, -1.0..1.0), 1..most).prop_map(vectors);
    let ties = prop::collection::vec((-9_i8..9, -9_i8..9), 1..most)
        .prop_map(|raw| raw.into_iter().map(|(x, y)| DVec2::new(x.into(), y.into()) * 0.1).collect());
    let kinds = (0..Kind::ALL.len(), 1..most, any::<u64>())
        .prop_map(|(kind, n, seed)| generate(Kind::ALL[kind], n, seed));
    prop_oneof![plain, ties, kinds]
}

fn templates() -> Mesher {
    Mesher::new().method(Method::Templates)
}

fn triangulate(points: &[DVec2]) -> Result<Triangulation, Error> {
    templates().triangulate(points)
}

fn mesh(points: &[DVec2], method: Method) -> Triangulation {
    Mesher::new().method(method).triangulate(points).unwrap()
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn templates_keep_their_promises(points in point_sets(40)) {
        hold(&triangulate(&points).unwrap(), &points);
    }

    #[test]
    fn simple_refinement_keeps_its_promises(points in point_sets(80)) {
        hold(&mesh(&points, Method::Simple), &points);
    }

    #[test]
    fn the_compact_method_keeps_its_promises(points in point_sets(20)) {
        hold(&mesh(&points, Method::Compact), &points);
    }

    #[test]
    fn promises_do_not_need_coarsening(points in point_sets(25)) {
        hold(&templates().coarsening(false).triangulate(&points).unwrap(), &points);
    }

    /// Adding points later leaves no rule unobeyed either.
    #[test]
    fn no_rule_is_left_unobeyed(points in point_sets(40), later in 0_usize..20, simple in any::<bool>()) {
        let set = hexdel::geom::PointSet::new(&points).unwrap();
        let sites = set.sites();
        let spacing = common::closest_distance(&points).map_or(1.0, |d| 100.0 * d);
        let rules = if simple { RuleSet::simple() } else { RuleSet::extended() };
        let mut refiner = Refiner::new(Lattice::new(sites[0], spacing), rules);
        let (first, rest) = sites.split_at(sites.len().saturating_sub(later));
        for batch in [first, rest] {
            refiner.insert(batch, &Unwatched).unwrap();
            prop_assert_eq!(refiner.violation(), None);
            prop_assert_eq!(refiner.grid().unbalanced(), None);
        }
        let mut leaves: Vec<_> = refiner.occupants().iter().map(|o| (o.level, o.at.hex)).collect();
        leaves.sort_unstable();
        leaves.dedup();
        prop_assert_eq!(leaves.len(), sites.len());
    }

    /// Down to one point, and to points in any relation to each other.
    #[test]
    fn a_handful_of_points(raw in prop::collection::vec((-1.0..1.0, -1.0..1.0), 1..=5), flat in 0_i32..12) {
        let flatten = 0.1_f64.powi(flat);
        let points: Vec<DVec2> = vectors(raw).into_iter().map(|p| p * DVec2::new(1.0, flatten)).collect();
        for method in [Method::Templates, Method::Simple] {
            hold(&mesh(&points, method), &points);
        }
    }

    /// Exactly collinear where the slope allows, else as nearly as rounding does.
    #[test]
    fn points_on_a_line(
        along in prop::collection::vec(-500_i32..500, 2..30),
        (dx, dy) in (-40_i32..40, -40_i32..40),
        exact in any::<bool>(),
    ) {
        prop_assume!((dx, dy) != (0, 0));
        let unit = if exact { 0.125 } else { 0.1 };
        let step = DVec2::new(dx.into(), dy.into()) * unit;
        let points: Vec<DVec2> = along.into_iter().map(|t| step * f64::from(t)).collect();
        hold(&triangulate(&points).unwrap(), &points);
    }

    /// Two points as close as ten decimal places, and others.
    #[test]
    fn a_close_pair(points in point_sets(8), (angle, digits) in (0.0..6.3_f64, 1.0..10.0_f64)) {
        let mut points = points;
        let distance: f64 = 0.1_f64.powf(digits);
        points.push(points[0] + DVec2::from_angle(angle) * distance);
        hold(&triangulate(&points).unwrap(), &points);
    }

    #[test]
    fn the_mesh_does_not_depend_on_threads(points in point_sets(120)) {
        let on = |threads| bits(&templates().threads(threads).triangulate(&points).unwrap());
        let one = on(1);
        prop_assert!(one == on(2), "two threads");
        prop_assert!(one == on(8), "eight threads");
    }

    /// A power of two changes exponents only.
    #[test]
    fn scaling_by_a_power_of_two_scales_the_mesh(points in point_sets(40), exponent in -120_i32..120) {
        // A single point has no scale: its patch has radius 1.
        prop_assume!(common::closest_distance(&points).is_some());
        let scale = 2.0_f64.powi(exponent);
        let plain = triangulate(&points).unwrap();
        let scaled: Vec<DVec2> = points.iter().map(|&p| p * scale).collect();
        let scaled = triangulate(&scaled).unwrap();
        prop_assert_eq!(&plain.mesh.triangles, &scaled.mesh.triangles);
        for (p, q) in plain.mesh.vertices.iter().zip(&scaled.mesh.vertices) {
            prop_assert_eq!(*p * scale, *q);
        }
    }

    /// The grid goes with the points. Only rounding differs: it moves vertices
    /// by units in the last place and so decides the diagonals of rectangles.
    #[test]
    fn translation_translates_the_mesh(
        raw in prop::collection::vec((-600_i32..600, -600_i32..600), 0..30),
        (dx, dy) in (-4_i32..4, -4_i32..4),
    ) {
        // The two outermost points make the smallest circle's centre exact.
        let ends = [(-1024, 0), (1024, 0)];
        let grid = ends.into_iter().chain(raw).map(|(x, y)| DVec2::new(x.into(), y.into()) / 1024.0);
        let here: Vec<DVec2> = grid.collect();
        let way = DVec2::new(dx.into(), dy.into());
        let there: Vec<DVec2> = here.iter().map(|&p| p + way).collect();
        let (a, b) = (triangulate(&here).unwrap(), triangulate(&there).unwrap());
        hold(&b, &there);
        prop_assert_eq!(&a.vertex_of_input, &b.vertex_of_input);
        prop_assert_eq!(a.mesh.triangles.len(), b.mesh.triangles.len());
        prop_assert_eq!(a.mesh.vertices.len(), b.mesh.vertices.len());
        for (p, q) in a.mesh.vertices.iter().zip(&b.mesh.vertices) {
            prop_assert!((*p + way - *q).abs().max_element() < 256.0 * f64::EPSILON, "{} {}", p, q);
        }
        for (i, (s, t)) in a.mesh.triangles.iter().zip(&b.mesh.triangles).enumerate() {
            let right = |made: &Triangulation| {
                let corners = made.mesh.corners(hexdel::TriangleId::new(i));
                hexdel::geom::quality::angles_deg(corners).iter().any(|a| (a - 90.0).abs() < 1e-6)
            };
            prop_assert!(s == t || right(&a) && right(&b), "triangle {}", i);
        }
    }

    #[test]
    fn points_may_be_turned_by_sixty_degrees(points in point_sets(40)) {
        let turn = DVec2::new(0.5, 0.75_f64.sqrt());
        let turned: Vec<DVec2> = points.iter().map(|p| turn.rotate(*p)).collect();
        hold(&triangulate(&turned).unwrap(), &turned);
    }

    #[test]
    fn duplicates_share_a_vertex_and_change_nothing(
        points in point_sets(30),
        again in prop::collection::vec(any::<prop::sample::Index>(), 1..40),
    ) {
        let mut repeated = points.clone();
        let copies: Vec<usize> = again.iter().map(|i| i.index(points.len())).collect();
        repeated.extend(copies.iter().map(|&i| points[i]));
        let (once, more) = (triangulate(&points).unwrap(), triangulate(&repeated).unwrap());
        prop_assert!(bits(&once) == bits(&more));
        for (copy, &i) in copies.iter().enumerate() {
            prop_assert_eq!(more.vertex_of_input[points.len() + copy], once.vertex_of_input[i]);
        }
        prop_assert_eq!(&more.vertex_of_input[..points.len()], &once.vertex_of_input[..]);
    }

    /// A prescribed domain is the one made, and as good as any.
    #[test]
    fn a_domain_of_any_radius(points in point_sets(20), times in 2.0..9.0_f64) {
        let least = triangulate(&points).unwrap().patch.radius;
        let made = templates().domain_radius(least * times).triangulate(&points).unwrap();
        hold(&made, &points);
        prop_assert!((made.patch.radius / (least * times) - 1.0).abs() < 1e-12);
        let reach = made.mesh.vertices.iter().map(|v| v.distance(made.patch.centre)).fold(0.0, f64::max);
        prop_assert!((reach / made.patch.radius - 1.0).abs() < 1e-9, "{} {}", reach, made.patch.radius);
    }
}

#[test]
fn every_kind_of_point_set() {
    for kind in Kind::ALL {
        for (seed, n) in [(1, 10), (2, 100)] {
            let points = generate(kind, n, seed);
            for method in [Method::Templates, Method::Simple] {
                hold(&mesh(&points, method), &points);
            }
        }
    }
}

/// The phenomenon that the fixture is named for: on its way down the levels
/// every one of its points meets a boundary between hexagons, most of them
/// exactly.
#[test]
fn the_fixture_on_edges_and_corners_lies_there() {
    let points = common::points("on_hexagon_edges_and_corners");
    let made = triangulate(&points).unwrap();
    hold(&made, &points);
    assert_eq!(made.patch.centre, DVec2::ZERO);
    assert_eq!(common::closest_distance(&points), Some(1.0));
    let coarsest = Lattice::new(DVec2::ZERO, 512.0 / 4.154_700_539);
    let norm = |v: DVec2| {
        let along = |x: f64, y: f64| (x * v.x + y * v.y).abs();
        let tall = 0.75_f64.sqrt();
        along(1.0, 0.0).max(along(0.5, tall)).max(along(0.5, -tall))
    };
    let boundary = |p: &DVec2| {
        (0..10).map(|level| (norm(coarsest.locate(level, *p).offset) - 0.5).abs()).fold(f64::MAX, f64::min)
    };
    let distances: Vec<f64> = points.iter().map(boundary).collect();
    // The last place of the coordinates in units of the finest spacing.
    let rounding = 10.0 * f64::EPSILON * 4.154_700_539;
    assert!(distances.iter().all(|d| *d < rounding), "{distances:?}");
    assert!(distances.iter().filter(|d| **d == 0.0).count() >= 20, "{distances:?}");
}
