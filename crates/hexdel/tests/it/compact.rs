//! The compact method: what it promises, on every kind of input.

#![cfg(feature = "io")]

use crate::common::{self, bits};
use hexdel::generate::{Kind, generate};
use hexdel::geom::{CertifyOptions, certify};
use hexdel::{AngleBounds, DVec2, Effort, Error, Mesher, Method, Start, Triangulation};
use proptest::prelude::*;
use std::time::Duration;

fn compact() -> Mesher {
    Mesher::new().method(Method::Compact)
}

fn triangulate(points: &[DVec2]) -> Result<Triangulation, Error> {
    Mesher::new().method(Method::Templates).triangulate(points)
}

/// Holds a mesh to the bounds asked for, from scratch.
#[track_caller]
fn hold(made: &Triangulation, points: &[DVec2], bounds: AngleBounds) {
    let options = CertifyOptions { bounds, inputs: Some(points), ..CertifyOptions::default() };
    let certificate = certify(&made.mesh, &options);
    assert!(certificate.holds(), "{:?}", certificate.violations);
    assert!(certificate.delaunay && certificate.disk);
    assert_eq!(certificate.inputs_kept, points.len());
    for (point, vertex) in points.iter().zip(&made.vertex_of_input) {
        assert_eq!(made.mesh.vertices[vertex.index()], *point);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 9, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn every_input_is_meshed_with_fewer_triangles(
        kind in 0..Kind::ALL.len(), n in 30_usize..200, seed in any::<u64>(),
    ) {
        let points = generate(Kind::ALL[kind], n, seed);
        let made = compact().triangulate(&points).unwrap();
        hold(&made, &points, AngleBounds::EXTENDED);
        let templates = triangulate(&points).unwrap();
        prop_assert!(2 * made.mesh.triangles.len() < templates.mesh.triangles.len());
    }
}

#[test]
fn every_kind_of_point_set() {
    for kind in Kind::ALL {
        for (seed, n) in [(1, 1), (2, 2), (3, 40)] {
            let points = generate(kind, n, seed);
            let made = compact().triangulate(&points).unwrap();
            hold(&made, &points, AngleBounds::EXTENDED);
            assert_eq!(made.start, Start::Coarse, "{kind} {n}");
        }
    }
}

#[test]
fn it_is_the_default() {
    let points = generate(Kind::Uniform, 10, 4);
    let made = hexdel::triangulate(&points).unwrap();
    assert_eq!(made.method, Method::Compact);
    assert!(bits(&made) == bits(&compact().triangulate(&points).unwrap()));
}

/// A power of two changes exponents only, in every comparison.
#[test]
fn scaling_by_a_power_of_two_scales_the_mesh() {
    let points = generate(Kind::Pairs, 16, 4);
    let plain = compact().triangulate(&points).unwrap();
    for exponent in [-100, -7, 60] {
        let scale = 2.0_f64.powi(exponent);
        let scaled: Vec<DVec2> = points.iter().map(|&p| p * scale).collect();
        let scaled = compact().triangulate(&scaled).unwrap();
        assert_eq!(plain.mesh.triangles, scaled.mesh.triangles);
        for (p, q) in plain.mesh.vertices.iter().zip(&scaled.mesh.vertices) {
            assert_eq!(*p * scale, *q);
        }
    }
}

#[test]
fn every_fixture() {
    for fixture in common::fixtures() {
        match (compact().triangulate(&fixture.points), triangulate(&fixture.points)) {
            (Ok(made), _) => hold(&made, &fixture.points, AngleBounds::EXTENDED),
            (Err(error), other) => assert_eq!(Some(error), other.err(), "{}", fixture.name),
        }
    }
}

#[test]
fn other_bounds() {
    let points = generate(Kind::Uniform, 60, 5);
    let mut last = usize::MAX;
    for (min, max) in [(43.0, 90.0), (40.0, 90.0), (30.0, 90.0), (30.0, 110.0), (20.0, 120.0)] {
        let bounds = AngleBounds::new(min, max).unwrap();
        let made = compact().bounds(bounds).triangulate(&points).unwrap();
        hold(&made, &points, bounds);
        assert_eq!(made.certificate.bounds, bounds);
        assert!(made.mesh.triangles.len() < last, "{min} {max}");
        last = made.mesh.triangles.len();
    }
}

#[test]
fn growth_that_spends_its_limit_is_not_repaired() {
    let points = generate(Kind::Uniform, 60, 5);
    for (min, start) in [(40.0, Start::Grown), (42.5, Start::Coarse), (43.0, Start::Coarse)] {
        let bounds = AngleBounds::new(min, 90.0).unwrap();
        let made = compact().bounds(bounds).triangulate(&points).unwrap();
        hold(&made, &points, bounds);
        assert_eq!(made.start, start, "{min}");
    }
}

#[test]
fn tight_bounds_are_reached_or_the_best_mesh_is_handed_over() {
    hold_tight_bounds(&generate(Kind::Uniform, 6, 1));
}

#[test]
#[ignore = "long: a quarter of a minute for the same of more points"]
fn tight_bounds_among_more_points() {
    hold_tight_bounds(&generate(Kind::Uniform, 12, 1));
}

fn hold_tight_bounds(points: &[DVec2]) {
    for (min, max, possible) in [(44.5, 89.0, true), (51.3, 72.1, false)] {
        let bounds = AngleBounds::new(min, max).unwrap();
        match compact().bounds(bounds).triangulate(points) {
            Ok(made) => {
                assert!(possible);
                hold(&made, points, bounds);
            }
            Err(Error::Unreached { mesh, certificate }) => {
                assert!(!possible && certificate.out_of_bounds > 0);
                let (inputs, min_edge) = (Some(points), certificate.min_edge_bound);
                let options = CertifyOptions { bounds, inputs, min_edge, ..CertifyOptions::default() };
                assert_eq!(*certificate, certify(&mesh, &options));
            }
            Err(error) => panic!("{error}"),
        }
    }
}

#[test]
fn the_mesh_does_not_depend_on_the_number_of_threads() {
    let points = generate(Kind::Uniform, 300, 2);
    let run = |threads| bits(&compact().threads(threads).triangulate(&points).unwrap());
    let one = run(1);
    assert!(one == run(2) && one == run(8));
}

#[test]
fn without_time_the_templates_mesh_is_left() {
    let points = generate(Kind::Clusters, 100, 2);
    let made = compact().budget(Duration::ZERO).triangulate(&points).unwrap();
    hold(&made, &points, AngleBounds::EXTENDED);
    assert_eq!(made.mesh.triangles.len(), triangulate(&points).unwrap().mesh.triangles.len());
    let ample = compact().budget(Duration::from_secs(3600)).triangulate(&points).unwrap();
    hold(&ample, &points, AngleBounds::EXTENDED);
    assert!(ample.mesh.triangles.len() < made.mesh.triangles.len() / 5);
    assert_eq!((made.start, ample.start), (Start::Templates, Start::Coarse));
}

#[test]
fn a_budget_that_ends_early_leaves_a_verified_mesh() {
    let points = generate(Kind::Uniform, 100, 4);
    let templates = triangulate(&points).unwrap().mesh.triangles.len();
    for effort in [Effort::Standard, Effort::Best] {
        for micros in [100, 1_000, 10_000, 50_000] {
            let budget = Duration::from_micros(micros);
            let made = compact().effort(effort).budget(budget).triangulate(&points).unwrap();
            hold(&made, &points, AngleBounds::EXTENDED);
            assert!(made.mesh.triangles.len() <= templates);
            // Nothing but the end of the budget keeps vertices that the first pass takes.
            assert!(made.budget_spent || made.mesh.triangles.len() < templates / 5);
        }
    }
}

#[test]
fn effort_pays() {
    let points = generate(Kind::Uniform, 40, 3);
    let count = |effort| compact().effort(effort).triangulate(&points).unwrap().mesh.triangles.len();
    let [fast, standard, best] = [Effort::Fast, Effort::Standard, Effort::Best].map(count);
    assert!(fast > standard && standard > best, "{fast} {standard} {best}");
}
