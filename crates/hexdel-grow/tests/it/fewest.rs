//! What the search for few Steiner points promises.

use std::f64::consts::TAU;

use hexdel_geom::{DVec2, Monitor, Phase, Unwatched, point_on_segment, quality};
use hexdel_grow::{GrowError, Grown, Input, Kind, Options, Role, fewest, grow};
use proptest::prelude::*;
use web_time::Instant;

/// A star-shaped polygon: radii at equal angles.
fn star(radii: &[f64]) -> (Vec<DVec2>, Vec<[u32; 2]>) {
    let n = radii.len() as u32;
    let point = |(i, r): (usize, &f64)| {
        let (sin, cos) = libm::sincos(TAU * i as f64 / f64::from(n));
        *r * DVec2::new(cos, sin)
    };
    (radii.iter().enumerate().map(point).collect(), (0..n).map(|i| [i, (i + 1) % n]).collect())
}

fn polygon<'a>(points: &'a [DVec2], segments: &'a [[u32; 2]]) -> Input<'a> {
    Input { points, segments, inside: true, ..Input::default() }
}

fn options(min_deg: f64, steps: u64) -> Options {
    let mut options = Options::new(min_deg);
    options.steps = steps;
    options
}

fn area(grown: &Grown) -> f64 {
    let double = |t: &[hexdel_geom::VertexId; 3]| {
        let [a, b, c] = t.map(|v| grown.mesh.vertices[v.index()]);
        (b - a).perp_dot(c - a)
    };
    grown.mesh.triangles.iter().map(double).sum::<f64>() / 2.0
}

/// Points and segments are in the mesh, triangles that are not listed are good, and nothing of the polygon is missing.
#[track_caller]
fn hold(made: &Grown, input: &Input<'_>, min_deg: f64) {
    for (p, v) in input.points.iter().zip(&made.mesh.vertices) {
        assert_eq!(p, v);
    }
    let n = input.points.len();
    let polygon: f64 = (0..n).map(|i| input.points[i].perp_dot(input.points[(i + 1) % n])).sum::<f64>() / 2.0;
    assert!((area(made) - polygon).abs() < 1e-9 * polygon);
    let mut length = vec![0.0; input.segments.len()];
    for (ends, segment) in &made.edges {
        let [a, b] = ends.map(|v| made.mesh.vertices[v.index()]);
        length[*segment as usize] += a.distance(b);
        let [p, q] = input.segments[*segment as usize].map(|v| input.points[v as usize]);
        for x in [a, b] {
            let s = (x - p).dot(q - p) / (q - p).length_squared();
            assert!(x.distance(point_on_segment(p, q, s.clamp(0.0, 1.0))) < 1e-12);
        }
    }
    for (segment, length) in input.segments.iter().zip(length) {
        let [p, q] = segment.map(|v| input.points[v as usize]);
        assert!((p.distance(q) - length).abs() < 1e-9);
    }
    for (t, ids) in made.mesh.triangles.iter().enumerate().filter(|(t, _)| !made.left.contains(&(*t as u32)))
    {
        let angles = quality::angles_deg(ids.map(|v| made.mesh.vertices[v.index()]));
        for (v, angle) in ids.iter().zip(angles) {
            let is_corner = made.kinds[v.index()] == Kind::Fixed;
            assert!(angle <= 90.0 + 1e-9 && (angle >= min_deg - 1e-9 || is_corner), "{t}: {angle}");
        }
    }
}

#[test]
fn points_of_a_square_grid_take_no_steiner_point() {
    let points: Vec<DVec2> = (0..12).map(|i| DVec2::new(f64::from(i % 4), f64::from(i / 4))).collect();
    let rim = [[0, 3], [3, 11], [11, 8], [8, 0]];
    let rim: Vec<[u32; 2]> = rim
        .iter()
        .flat_map(|&[a, b]: &[i32; 2]| {
            let step = (b - a).signum() * if (b - a).abs() % 4 == 0 { 4 } else { 1 };
            (0..(b - a) / step).map(move |k| [a + k * step, a + (k + 1) * step].map(|v| v as u32))
        })
        .collect();
    let made = fewest(&polygon(&points, &rim), &Options::new(0.0), &Unwatched).unwrap();
    assert!(made.left.is_empty());
    assert_eq!(made.mesh.vertices.len(), 12);
}

#[test]
fn an_octagon_takes_one_steiner_point() {
    let points =
        [(1.0, 0.0), (2.0, 0.0), (3.0, 1.0), (3.0, 2.0), (2.0, 3.0), (1.0, 3.0), (0.0, 2.0), (0.0, 1.0)];
    let points = points.map(|(x, y)| DVec2::new(x, y));
    let segments: Vec<[u32; 2]> = (0..8).map(|i| [i, (i + 1) % 8]).collect();
    let input = polygon(&points, &segments);
    let made = fewest(&input, &Options::new(0.0), &Unwatched).unwrap();
    hold(&made, &input, 0.0);
    assert!(made.left.is_empty());
    assert!(made.mesh.vertices.len() <= 9, "{}", made.mesh.vertices.len());
}

#[test]
fn a_search_takes_far_fewer_points_than_growth() {
    let radii: Vec<f64> = (0..40).map(|i| 1.0 + 0.6 * libm::sin(f64::from(i * i))).collect();
    let (points, segments) = star(&radii);
    let input = polygon(&points, &segments);
    let grown = grow(&input, &Options::new(1.0), &Unwatched).unwrap();
    let made = fewest(&input, &Options::new(0.0), &Unwatched).unwrap();
    hold(&made, &input, 0.0);
    assert!(made.left.is_empty());
    let steiner = |made: &Grown| made.mesh.vertices.len() - points.len();
    assert!(2 * steiner(&made) < steiner(&grown), "{} {}", steiner(&made), steiner(&grown));
}

#[test]
fn without_time_the_first_triangulation_comes_back_with_what_is_wrong() {
    let (points, segments) = star(&[1.0, 0.2, 1.0, 0.3, 1.0, 0.25, 1.0]);
    let input = polygon(&points, &segments);
    let made = fewest(&input, &Options::new(0.0).with_deadline(Some(Instant::now())), &Unwatched).unwrap();
    hold(&made, &input, 0.0);
    assert!(!made.left.is_empty());
}

#[test]
fn rounds_go_on_until_the_deadline() {
    let (points, segments) = star(&[1.0, 0.2, 1.0, 0.3, 1.0, 0.25, 1.0]);
    let input = polygon(&points, &segments);
    let (start, time) = (Instant::now(), std::time::Duration::from_millis(300));
    let limit = Options::new(0.0).with_deadline(Some(start + time));
    let made = fewest(&input, &limit, &Unwatched).unwrap();
    assert!(start.elapsed() >= time && made.left.is_empty());
}

#[test]
fn a_search_can_be_cancelled() {
    struct Never;
    impl Monitor for Never {
        fn progress(&self, _: Phase, _: u64, _: u64) {}
        fn cancelled(&self) -> bool {
            true
        }
    }
    let (points, segments) = star(&[1.0, 0.2, 1.0, 0.3, 1.0]);
    let made = fewest(&polygon(&points, &segments), &Options::new(0.0), &Never);
    assert!(matches!(made, Err(GrowError::Cancelled(_))));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn polygons_keep_their_points_segments_and_bounds(
        radii in prop::collection::vec(0.2_f64..1.0, 5..30),
        min_deg in prop::sample::select(vec![0.0, 20.0, 30.0]),
    ) {
        let (points, segments) = star(&radii);
        let input = polygon(&points, &segments);
        let made = fewest(&input, &options(min_deg, 8), &Unwatched).unwrap();
        hold(&made, &input, min_deg);
        let again = fewest(&input, &options(min_deg, 8), &Unwatched).unwrap();
        prop_assert_eq!(made.mesh, again.mesh);
    }

    /// Neither growth nor a search divides a segment that is to stay whole.
    #[test]
    fn whole_segments_stay_whole(radii in prop::collection::vec(0.2_f64..1.0, 5..30)) {
        let (points, segments) = star(&radii);
        let roles: Vec<Role> = (0..segments.len()).map(|i| if i % 3 == 0 { Role::Whole } else { Role::Border }).collect();
        let input = Input { roles: &roles, ..polygon(&points, &segments) };
        for made in [
            fewest(&input, &options(0.0, 8), &Unwatched).unwrap(),
            grow(&input, &Options::new(25.0), &Unwatched).unwrap(),
        ] {
            hold(&made, &input, 0.0);
            for i in (0..segments.len()).step_by(3) {
                prop_assert_eq!(made.edges.iter().filter(|(_, segment)| *segment as usize == i).count(), 1);
            }
        }
    }
}
