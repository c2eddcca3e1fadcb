//! Meshes that grow to a size.

use hexdel_geom::{AngleBounds, CertifyOptions, DVec2, Unwatched, certify};
use hexdel_grow::{Grown, Input, Options, Size, grow};
use proptest::prelude::*;

/// An equilateral triangle with sides of one.
const EQUILATERAL: f64 = 0.433_012_701_892_219_3;

/// Edges of a length that grows with the distance from a point.
#[derive(Clone, Copy, Debug)]
struct Graded {
    centre: DVec2,
    least: f64,
    gradation: f64,
}

impl Graded {
    fn at(&self, p: DVec2) -> f64 {
        self.least + self.gradation * p.distance(self.centre)
    }
}

impl Size for Graded {
    fn aim(&self, at: DVec2) -> f64 {
        self.at(at)
    }

    fn excess(&self, [a, b, c]: [DVec2; 3]) -> f64 {
        let edge =
            |p: DVec2, q: DVec2| p.distance(q) / self.at(p).min(self.at(q)).min(self.at(0.5 * (p + q)));
        edge(a, b).max(edge(b, c)).max(edge(c, a))
    }
}

/// Triangles of up to an area.
#[derive(Clone, Copy, Debug)]
struct Area(f64);

impl Size for Area {
    fn aim(&self, _: DVec2) -> f64 {
        (self.0 / EQUILATERAL).sqrt()
    }

    fn excess(&self, [a, b, c]: [DVec2; 3]) -> f64 {
        (0.5 * (b - a).perp_dot(c - a) / self.0).sqrt()
    }
}

const SQUARE: [DVec2; 4] =
    [DVec2::new(0.0, 0.0), DVec2::new(2.0, 0.0), DVec2::new(2.0, 2.0), DVec2::new(0.0, 2.0)];

/// A square with points in it, grown; held to bounds, points and size from scratch.
fn grown_in_square(inner: &[DVec2], size: &dyn Size) -> Grown {
    let points: Vec<DVec2> = SQUARE.iter().chain(inner).copied().collect();
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0]];
    let input =
        Input { points: &points, segments: &segments, inside: true, size: Some(size), ..Input::default() };
    let grown = grow(&input, &Options::new(30.0), &Unwatched).unwrap();
    let bounds = AngleBounds::new(30.0, 90.0).unwrap();
    let options = CertifyOptions { bounds, inputs: Some(&points), ..CertifyOptions::default() };
    let certificate = certify(&grown.mesh, &options);
    assert!(grown.left.is_empty() && certificate.holds(), "{:?}", certificate.violations);
    for t in &grown.mesh.triangles {
        let corners = t.map(|v| grown.mesh.vertices[v.index()]);
        assert!(size.excess(corners) <= 1.0, "{corners:?} exceeds its size {}-fold", size.excess(corners));
    }
    grown
}

/// Triangles over those of a mesh of equilateral ones with the longest edges allowed.
fn share(grown: &Grown, size: &dyn Size) -> f64 {
    let ideal = grown.mesh.triangles.iter().map(|t| {
        let [a, b, c] = t.map(|v| grown.mesh.vertices[v.index()]);
        0.5 * (b - a).perp_dot(c - a) / (EQUILATERAL * size.aim((a + b + c) / 3.0).powi(2))
    });
    grown.mesh.triangles.len() as f64 / ideal.sum::<f64>()
}

#[test]
fn edges_are_as_short_as_wanted_and_triangles_few() {
    for (least, gradation, most) in [(0.05, 0.0, 1.7), (0.02, 0.1, 1.85), (0.01, 0.3, 2.3)] {
        let size = Graded { centre: DVec2::new(0.7, 0.4), least, gradation };
        let share = share(&grown_in_square(&[], &size), &size);
        assert!(share < most, "{share:.2} times as many triangles as equilateral ones");
    }
}

#[test]
fn areas_are_as_small_as_wanted_and_triangles_few() {
    let share = share(&grown_in_square(&[DVec2::new(0.3, 1.1)], &Area(1e-3)), &Area(1e-3));
    assert!(share < 1.5, "{share:.2} times as many triangles as equilateral ones");
}

#[test]
fn vertices_for_size_are_limited() {
    let size = Graded { centre: DVec2::ZERO, least: 0.01, gradation: 0.0 };
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0]];
    let input =
        Input { points: &SQUARE, segments: &segments, inside: true, size: Some(&size), ..Input::default() };
    let mut options = Options::new(30.0);
    options.most_for_size = 500;
    let grown = grow(&input, &options, &Unwatched).unwrap();
    assert_eq!(grown.stats.for_size, 500);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    /// Sizes finer and coarser than the distances of points.
    #[test]
    fn any_points_and_sizes(
        inner in prop::collection::vec((0.05..1.95_f64, 0.05..1.95_f64), 0..30),
        centre in (0.0..2.0_f64, 0.0..2.0_f64),
        least in 0.01..0.5_f64,
        gradation in 0.0..0.5_f64,
    ) {
        let mut inner: Vec<DVec2> = inner.into_iter().map(DVec2::from).collect();
        inner.dedup();
        grown_in_square(&inner, &Graded { centre: centre.into(), least, gradation });
    }
}
