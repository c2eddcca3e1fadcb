//! Segments by the paper's own method: conforming, never turned over, bounded,
//! and with angles like the paper's.

use crate::support;
use hexdel_geom::{DVec2, Monitor, Pslg, Region, TriangleId, Unwatched, quality};
use hexdel_pslg::{Extent, Options, PslgError, PslgMesh, Reason, SegmentMethod, mesh, repair, validate};
use std::sync::atomic::{AtomicU32, Ordering};

fn paper() -> Options {
    Options::new().method(SegmentMethod::Paper)
}

fn made(pslg: &Pslg, options: &Options) -> PslgMesh {
    let valid = validate(pslg).expect("the graph is planar");
    let made = mesh(&valid, options, &Unwatched).expect("the graph can be meshed");
    assert!(made.holds(), "{:?}", made.failed.iter().find(|f| f.reason != Reason::Template));
    made
}

/// A polygon with points along its sides, about `step` apart.
fn sampled(pslg: &mut Pslg, corners: &[(f64, f64)], step: f64) {
    let first = pslg.points.len() as u32;
    for (i, &(x, y)) in corners.iter().enumerate() {
        let (from, (x, y)) = (DVec2::new(x, y), corners[(i + 1) % corners.len()]);
        let to = DVec2::new(x, y);
        let n = (from.distance(to) / step).round().max(1.0);
        pslg.points.extend((0..n as u32).map(|k| from.lerp(to, f64::from(k) / n)));
    }
    let n = pslg.points.len() as u32 - first;
    pslg.segments.extend((0..n).map(|i| [first + i, first + (i + 1) % n]));
}

/// The letters I, M and R, each sampled finer than the one before.
fn letters() -> Pslg {
    let arc = |x: f64, y: f64, r: f64| {
        (0..=12).map(move |i| {
            let angle = DVec2::from_angle((f64::from(i) / 12.0 - 0.5) * std::f64::consts::PI);
            (x + r * angle.x, y + r * angle.y)
        })
    };
    let mut pslg = Pslg::default();
    let bar = [(0.0, 0.0), (1.0, 0.0), (1.0, 0.3), (0.7, 0.3), (0.7, 1.7), (1.0, 1.7), (1.0, 2.0)];
    let i = bar.into_iter().chain([(0.0, 2.0), (0.0, 1.7), (0.3, 1.7), (0.3, 0.3), (0.0, 0.3)]);
    sampled(&mut pslg, &i.collect::<Vec<_>>(), 0.3);
    let left = [(1.4, 0.0), (1.75, 0.0), (1.75, 1.3), (2.15, 0.6), (2.55, 1.3), (2.55, 0.0)];
    let m =
        left.into_iter().chain([(2.9, 0.0), (2.9, 2.0), (2.55, 2.0), (2.15, 1.2), (1.75, 2.0), (1.4, 2.0)]);
    sampled(&mut pslg, &m.collect::<Vec<_>>(), 0.2);
    let leg = [(3.3, 0.0), (3.65, 0.0), (3.65, 0.8), (3.9, 0.8), (4.4, 0.0), (4.8, 0.0)];
    let bowl: Vec<_> = leg.into_iter().chain(arc(4.2, 1.425, 0.575)).chain([(3.3, 2.0)]).collect();
    sampled(&mut pslg, &bowl, 0.1);
    let inner: Vec<_> =
        [(3.65, 1.15)].into_iter().chain(arc(4.15, 1.4, 0.25)).chain([(3.65, 1.65)]).collect();
    sampled(&mut pslg, &inner, 0.1);
    pslg
}

/// The paper's own letters have angles from 13.7 to 133.4 degrees.
#[test]
fn letters_are_like_the_papers() {
    let pslg = letters();
    let made = made(&pslg, &paper());
    assert_eq!(support::check(&pslg, &made), Ok(()));
    let c = &made.certificate;
    assert!(c.min_angle_deg > 12.0 && c.max_angle_deg < 146.0, "{} {}", c.min_angle_deg, c.max_angle_deg);
    assert!(c.triangles > 5_000 && c.triangles < 60_000, "{}", c.triangles);
}

#[test]
fn lines_at_all_angles_are_straight_rows_of_edges() {
    for i in 0..90 {
        let turn = DVec2::from_angle(f64::from(i) * 0.0703);
        let at = DVec2::new(f64::from(i) * 0.013, f64::from(i) * -0.007);
        let mut pslg = Pslg::from_points(vec![at - turn * 3.0, at + turn * 3.0]);
        pslg.segments.push([0, 1]);
        // A frame, so that the lattice does not turn and move along.
        pslg.points.extend((0..6).map(|k| DVec2::from_angle(1.05 * f64::from(k)) * 4.0));
        let made = made(&pslg, &paper());
        assert_eq!(support::check(&pslg, &made), Ok(()), "{i}");
        let c = &made.certificate;
        assert!(
            c.min_angle_deg > 13.7 && c.max_angle_deg < 146.0,
            "{i}: {} {}",
            c.min_angle_deg,
            c.max_angle_deg
        );
        assert!(made.edges_of_segment[0] > 2);
    }
}

#[test]
fn families_conform() {
    for name in support::FAMILIES.into_iter().filter(|n| *n != "letter R") {
        for seed in 500..504 {
            let pslg = support::family(name, seed);
            let made = made(&pslg, &paper());
            assert_eq!(support::check(&pslg, &made), Ok(()), "{name} {seed}");
            assert!(made.certificate.disk && made.certificate.min_angle_deg > 8.0, "{name} {seed}");
        }
    }
}

/// One hexagon away from points and segments the bounds hold, seen from outside.
#[test]
fn one_hexagon_away_the_plain_bounds_hold() {
    for seed in 0..6 {
        let pslg = support::family("convex", seed);
        let made = made(&pslg, &paper());
        let mut ring = vec![u32::MAX; made.mesh.vertices.len()];
        for v in made.edges.iter().flat_map(|e| e.ends).chain(made.vertex_of_point.iter().flatten().copied())
        {
            ring[v.index()] = 0;
        }
        for t in &made.mesh.triangles {
            if t.iter().any(|v| ring[v.index()] == 0) {
                for v in t {
                    ring[v.index()] = ring[v.index()].min(1);
                }
            }
        }
        let away = |t: &[hexdel_geom::VertexId; 3]| t.iter().all(|v| ring[v.index()] > 1);
        let angles = (0..made.mesh.triangles.len())
            .filter(|&t| away(&made.mesh.triangles[t]))
            .flat_map(|t| quality::angles_deg(made.mesh.corners(TriangleId::new(t))));
        let (least, most, count) =
            angles.fold((180.0_f64, 0.0_f64, 0), |(l, m, n), a| (l.min(a), m.max(a), n + 1));
        assert!(count > 300 && least > 43.8978 && most < 90.0 + 1e-9, "{seed}: {least} {most} {count}");
    }
}

#[test]
fn points_beside_segments_are_kept_apart() {
    for i in 1..12 {
        let gap = 0.5_f64.powi(i);
        let mut pslg = Pslg::from_points(vec![
            DVec2::new(-1.0, 0.1),
            DVec2::new(1.0, -0.2),
            DVec2::new(0.1, gap),
            DVec2::new(0.3, -0.9),
        ]);
        pslg.segments.push([0, 1]);
        let made = made(&pslg, &paper());
        assert_eq!(support::check(&pslg, &made), Ok(()), "{gap}");
        assert!(made.certificate.min_angle_deg > 10.0, "{gap}: {}", made.certificate.min_angle_deg);
    }
}

#[test]
fn many_segments_may_meet_in_a_point() {
    for n in [3, 7, 12, 24] {
        let mut pslg = Pslg::from_points(vec![DVec2::new(0.01, 0.02)]);
        for i in 0..n {
            pslg.points.push(DVec2::from_angle(0.2 + std::f64::consts::TAU * f64::from(i) / f64::from(n)));
            pslg.segments.push([0, i + 1]);
        }
        let made = made(&pslg, &paper());
        assert_eq!(support::check(&pslg, &made), Ok(()), "{n}");
    }
}

#[test]
fn narrow_corners_conform_or_are_errors() {
    for angle in [20.0_f64, 5.0, 1.0, 0.1, 1e-3, 1e-7, 1e-12] {
        let (s, c) = angle.to_radians().sin_cos();
        let mut pslg = Pslg::from_points(vec![DVec2::X, DVec2::ZERO, DVec2::new(c, s)]);
        pslg.segments = vec![[0, 1], [1, 2]];
        match mesh(&validate(&pslg).unwrap(), &paper().max_triangles(200_000), &Unwatched) {
            Ok(made) => {
                assert_eq!(support::check(&pslg, &made), Ok(()), "{angle}");
                assert!(made.holds() && angle >= 0.1, "{angle}");
            }
            Err(error) => {
                let typed = matches!(error, PslgError::TooMany { .. } | PslgError::TooClose { .. });
                assert!(typed && angle < 1.0, "{angle}: {error}");
            }
        }
    }
}

#[test]
fn random_graphs_give_valid_meshes_or_errors() {
    let mut meshed = 0;
    for seed in 0..60 {
        let mut graph = support::random_graph(seed);
        graph.holes.clear();
        if validate(&graph).is_err() {
            graph = repair(&graph, 1e-6).unwrap().0;
        }
        match mesh(&validate(&graph).unwrap(), &paper().max_triangles(40_000), &Unwatched) {
            Ok(made) => {
                assert_eq!(support::check(&graph, &made), Ok(()), "{seed}");
                assert!(made.holds(), "{seed}");
                meshed += 1;
            }
            Err(error) => {
                assert!(matches!(error, PslgError::TooClose { .. } | PslgError::TooMany { .. }), "{error}");
            }
        }
    }
    assert!(meshed > 45, "{meshed}");
}

#[test]
fn extents_regions_and_areas_are_as_with_the_other_method() {
    let mut pslg = Pslg::default();
    sampled(&mut pslg, &[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)], 4.0);
    sampled(&mut pslg, &[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0)], 1.0);
    pslg.holes.push(DVec2::splat(1.5));
    pslg.regions.push(Region { point: DVec2::splat(3.0), attribute: 2.0, max_area: None });
    pslg.segment_markers = vec![7; 8];
    let inside = made(&pslg, &paper().extent(Extent::Inside).max_area(0.01));
    let area = |t| {
        let [a, b, c] = inside.mesh.corners(TriangleId::new(t));
        0.5 * (b - a).perp_dot(c - a)
    };
    let areas: Vec<f64> = (0..inside.mesh.triangles.len()).map(area).collect();
    assert!((areas.iter().sum::<f64>() - 15.0).abs() < 1e-9);
    assert!(areas.iter().all(|&a| a <= 0.01));
    assert!(inside.region_of_triangle.iter().all(|r| *r == Some(0)));
    assert!(inside.edges.iter().all(|e| e.boundary && e.marker == 7));
    let hull = made(&letters(), &paper().extent(Extent::Hull));
    assert!(hull.certificate.disk && hull.edges.iter().any(|e| e.boundary && e.segment.is_none()));
    let refused = mesh(
        &validate(&Pslg::from_points(vec![DVec2::ZERO, DVec2::X])).unwrap(),
        &paper().extent(Extent::Inside),
        &Unwatched,
    );
    let none = PslgError::NothingEnclosed { loose: Vec::new(), count: 0 };
    assert_eq!(refused.err(), Some(none));
}

#[test]
fn any_number_of_threads_makes_the_same_mesh() {
    let pslg = support::family("star36", 5);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| made(&pslg, &paper()))
    };
    let (a, b) = (with(1), with(4));
    assert_eq!(a.mesh, b.mesh);
    assert_eq!(a.edges, b.edges);
}

/// Gives up after so many questions.
struct CancelAfter(AtomicU32);

impl Monitor for CancelAfter {
    fn cancelled(&self) -> bool {
        self.0.fetch_sub(1, Ordering::Relaxed) == 0
    }
}

#[test]
fn work_can_be_cancelled_at_any_time() {
    let pslg = support::family("square", 3);
    let valid = validate(&pslg).unwrap();
    let mut cancelled = 0;
    for after in (0..200).step_by(3) {
        match mesh(&valid, &paper(), &CancelAfter(AtomicU32::new(after))) {
            Err(PslgError::Cancelled(_)) => cancelled += 1,
            other => assert!(other.is_ok(), "{:?}", other.err()),
        }
    }
    assert!(cancelled > 4, "{cancelled}");
}
