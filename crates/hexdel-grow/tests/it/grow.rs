//! What growth promises, on points and PSLGs.

use std::time::Instant;

use hexdel_geom::{
    AngleBounds, CertifyOptions, DVec2, Monitor, TriMesh, Unwatched, certify, orient2d, point_on_segment,
};
use hexdel_grow::{GrowError, Grown, Input, Options, Role, grow};
use proptest::prelude::*;

/// Uniform points in the unit square.
fn uniform(count: usize, seed: u64) -> Vec<DVec2> {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut draw = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / 2_f64.powi(53)
    };
    (0..count).map(|_| DVec2::new(draw(), draw())).collect()
}

/// Points and a hexagon around them.
fn in_hexagon(mut points: Vec<DVec2>) -> (Vec<DVec2>, Vec<[u32; 2]>) {
    let count = points.len() as u32;
    let corner = |i: u32| {
        let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::FRAC_PI_3);
        DVec2::splat(0.5) + DVec2::new(cos, sin)
    };
    points.extend((0..6).map(corner));
    (points, (0..6).map(|i| [count + i, count + (i + 1) % 6]).collect())
}

fn grown(input: &Input<'_>, min_deg: f64) -> Grown {
    grow(input, &Options::new(min_deg), &Unwatched).unwrap()
}

/// Holds a mesh to its bounds, from scratch; of a PSLG the lower one only as far as `left` says.
#[track_caller]
fn hold(grown: &Grown, input: &Input<'_>, min_deg: f64) {
    let bounds = AngleBounds::new(min_deg, 90.0).unwrap();
    let options = CertifyOptions { bounds, inputs: Some(input.points), ..CertifyOptions::default() };
    let certificate = certify(&grown.mesh, &options);
    assert!(grown.left.is_empty() && certificate.holds(), "{:?}", certificate.violations);
}

fn area(mesh: &TriMesh) -> f64 {
    let double = |t: &[hexdel_geom::VertexId; 3]| {
        let [a, b, c] = t.map(|v| mesh.vertices[v.index()]);
        (b - a).perp_dot(c - a)
    };
    mesh.triangles.iter().map(double).sum::<f64>() / 2.0
}

#[test]
fn uniform_points_grow_within_the_bounds_with_few_triangles() {
    let (points, segments) = in_hexagon(uniform(2000, 1));
    let input = Input { points: &points, segments: &segments, ..Input::default() };
    for (min_deg, most) in [(30.0, 6.4), (36.0, 8.6), (40.0, 11.8), (42.0, 19.0), (43.0, 34.0)] {
        let grown = grown(&input, min_deg);
        hold(&grown, &input, min_deg);
        let per_point = grown.mesh.triangles.len() as f64 / 2000.0;
        assert!(per_point <= most, "{per_point:.2} triangles a point at {min_deg}");
        assert_eq!(grown.mesh.vertices[..2000], points[..2000]);
    }
}

#[test]
fn same_input_same_bytes() {
    let (points, segments) = in_hexagon(uniform(500, 7));
    let input = Input { points: &points, segments: &segments, ..Input::default() };
    let [one, two] = [0; 2].map(|_| grown(&input, 41.0));
    assert_eq!(one.mesh, two.mesh);
    assert_eq!(one.kinds, two.kinds);
}

#[test]
fn bounds_and_segments_that_cannot_be_are_named() {
    let (points, segments) = in_hexagon(uniform(5, 1));
    let input = Input { points: &points, segments: &segments, ..Input::default() };
    for asked in [0.0, -1.0, 43.7, f64::NAN, f64::INFINITY] {
        let error = grow(&input, &Options::new(asked), &Unwatched).unwrap_err();
        assert!(matches!(error, GrowError::Bound { kept: [1.0, 43.6], .. }), "{error}");
    }
    let input = Input { points: &points[..9], segments: &segments, ..Input::default() };
    let error = grow(&input, &Options::new(30.0), &Unwatched).unwrap_err();
    assert_eq!(error, GrowError::NoSuchPoint { segment: 3, point: 9, points: 9 });
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    /// Clusters of all sizes, near pairs among them, all within the hexagon.
    #[test]
    fn clustered_points_grow_within_the_bounds(n in 1_usize..60, seed in any::<u64>(), shrink in 2_i32..20) {
        let mut points = uniform(n, seed);
        let centre = points[0];
        points.extend(uniform(n, seed ^ 1).into_iter().map(|p| centre + (p - 0.5) * 2_f64.powi(-shrink)));
        points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        points.dedup();
        let (points, segments) = in_hexagon(points);
        let input = Input { points: &points, segments: &segments, ..Input::default() };
        hold(&grown(&input, 40.0), &input, 40.0);
    }
}

/// A square with a square hole and a segment that ends in it.
fn plate() -> (Vec<DVec2>, Vec<[u32; 2]>) {
    let points = [
        (0.0, 0.0),
        (4.0, 0.0),
        (4.0, 4.0),
        (0.0, 4.0),
        (1.0, 1.0),
        (2.0, 1.0),
        (2.0, 2.0),
        (1.0, 2.0),
        (3.0, 3.5),
    ]
    .map(DVec2::from);
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [6, 8]];
    (points.to_vec(), segments.to_vec())
}

#[test]
fn a_plate_with_a_hole_keeps_its_segments() {
    let (points, segments) = plate();
    let holes = [DVec2::new(1.5, 1.5)];
    let input =
        Input { points: &points, segments: &segments, holes: &holes, inside: true, ..Input::default() };
    let made = grown(&input, 30.0);
    assert!(made.left.is_empty() && (area(&made.mesh) - 15.0).abs() < 1e-12);
    for (segment, &[a, b]) in segments.iter().enumerate() {
        let [a, b] = [a, b].map(|v| points[v as usize]);
        let edges = made.edges.iter().filter(|e| e.1 as usize == segment);
        let mut length = 0.0;
        for (ends, _) in edges {
            let [p, q] = ends.map(|v| made.mesh.vertices[v.index()]);
            length += p.distance(q);
            for p in [p, q] {
                let t = (p - a).dot(b - a) / (b - a).length_squared();
                assert_eq!(point_on_segment(a, b, t.clamp(0.0, 1.0)), p);
            }
        }
        assert!((length - a.distance(b)).abs() < 1e-12, "segment {segment}");
    }
}

#[test]
fn a_narrow_corner_is_exempt_at_its_tip_only() {
    let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0)].map(DVec2::from);
    let segments = [[0, 1], [1, 2], [2, 0]];
    let input = Input { points: &points, segments: &segments, inside: true, ..Input::default() };
    let made = grown(&input, 30.0);
    assert!(made.left.is_empty() && made.stats.tips == 1, "{:?}", made.stats);
    // Within half a degree of 14, one triangle; all others keep the bounds.
    let bounds = AngleBounds::new(30.0, 90.0).unwrap();
    let certificate = certify(&made.mesh, &CertifyOptions { bounds, ..CertifyOptions::default() });
    assert_eq!(certificate.out_of_bounds, 1);
    assert!((certificate.min_angle_deg - 14.036).abs() < 1e-3 && certificate.max_angle_deg <= 90.0 + 1e-9);
}

/// A hole where two parts touch in a point: it is two vertices there.
#[test]
fn holes_that_touch_themselves_make_copies() {
    let points =
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)].map(DVec2::from);
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [2, 4], [4, 5], [5, 6], [6, 2]];
    let input = Input { points: &points, segments: &segments, inside: true, ..Input::default() };
    let made = grown(&input, 30.0);
    assert!(made.left.is_empty());
    assert_eq!(made.point_of_vertex.iter().filter(|p| **p == Some(2)).count(), 2);
}

#[test]
fn whole_segments_are_not_divided_and_inner_ones_are_no_border() {
    let (points, segments) = plate();
    let roles = [
        Role::Border,
        Role::Border,
        Role::Border,
        Role::Border,
        Role::Inner,
        Role::Inner,
        Role::Inner,
        Role::Inner,
        Role::Whole,
    ];
    let holes = [DVec2::new(1.5, 1.5)];
    let input = Input {
        points: &points,
        segments: &segments,
        roles: &roles,
        holes: &holes,
        inside: true,
        ..Input::default()
    };
    assert!(matches!(grow(&input, &Options::new(30.0), &Unwatched), Err(GrowError::NothingEnclosed)));
    let input = Input { holes: &[], ..input };
    let made = grown(&input, 20.0);
    for segment in 4..9 {
        assert_eq!(made.edges.iter().filter(|e| e.1 == segment).count(), 1, "segment {segment}");
    }
    assert!((area(&made.mesh) - 16.0).abs() < 1e-12);
}

/// Zigzags of any shape: valid, conforming, and nothing turned over, whatever is left.
#[test]
fn random_outlines_are_meshed() {
    let mut left = 0;
    for seed in 0..40 {
        let spokes = uniform(24, seed);
        let ring: Vec<DVec2> = spokes
            .iter()
            .zip(0..)
            .map(|(p, i)| {
                let (sin, cos) = libm::sincos(f64::from(i) * std::f64::consts::TAU / 24.0);
                (0.2 + p.x) * DVec2::new(cos, sin)
            })
            .collect();
        let segments: Vec<[u32; 2]> = (0..24).map(|i| [i, (i + 1) % 24]).collect();
        let input = Input { points: &ring, segments: &segments, inside: true, ..Input::default() };
        let made = grown(&input, 30.0);
        for t in &made.mesh.triangles {
            let [a, b, c] = t.map(|v| made.mesh.vertices[v.index()]);
            assert!(orient2d(a, b, c) > 0.0);
        }
        let exact: f64 = (0..24).map(|i| ring[i].perp_dot(ring[(i + 1) % 24])).sum::<f64>() / 2.0;
        assert!((area(&made.mesh) - exact).abs() < 1e-12);
        left += made.left.len();
    }
    assert!(left <= 1, "{left} triangles left of 40 outlines");
}

#[test]
fn bad_input_is_named() {
    let run = |points: &[DVec2], segments: &[[u32; 2]]| {
        let input = Input { points, segments, inside: true, ..Input::default() };
        grow(&input, &Options::new(30.0), &Unwatched).err()
    };
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(DVec2::from);
    assert_eq!(run(&square, &[[0, 1]]), Some(GrowError::NothingEnclosed));
    let crossing = run(&square, &[[0, 2], [1, 3]]);
    assert!(matches!(crossing, Some(GrowError::NotAnEdge { .. })), "{crossing:?}");
    let twice = [square[0], square[1], square[0], square[3]];
    assert_eq!(run(&twice, &[[0, 1]]), Some(GrowError::SamePoints { same: 1 }));
    let far = [square[0], DVec2::new(1e80, 0.0), square[2]];
    assert_eq!(run(&far, &[]), Some(GrowError::OutOfRange { index: 1, point: far[1] }));
}

#[test]
fn growth_stops_when_asked_to() {
    struct Never;
    impl Monitor for Never {
        fn cancelled(&self) -> bool {
            true
        }
    }
    let (points, segments) = in_hexagon(uniform(50, 3));
    let input = Input { points: &points, segments: &segments, ..Input::default() };
    let stopped = grow(&input, &Options::new(30.0), &Never);
    assert!(matches!(stopped, Err(GrowError::Cancelled(_))));
    let late = Options::new(30.0).with_deadline(Some(Instant::now()));
    assert!(matches!(grow(&input, &late, &Unwatched), Err(GrowError::OutOfTime)));
}
