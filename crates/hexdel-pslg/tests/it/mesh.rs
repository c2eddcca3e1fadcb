//! Meshes of small PSLGs: bounds, extents, holes, regions, markers, errors.

use crate::support::{self, append, chain};
use hexdel_geom::certificate::{Promises, check_promises, features};
use hexdel_geom::{AngleBounds, DVec2, Monitor, Phase, Pslg, Region, Unwatched, check_segments};
use hexdel_pslg::{
    Extent, Feature, Options, PslgError, PslgMesh, Reason, SegmentMethod, mesh, repair, validate,
};
use std::sync::atomic::{AtomicBool, Ordering};

fn made(pslg: &Pslg, options: &Options) -> PslgMesh {
    let valid = validate(pslg).expect("the graph is planar");
    mesh(&valid, options, &Unwatched).expect("the graph can be meshed")
}

fn square(at: f64, side: f64) -> Pslg {
    chain(&[(at, at), (at + side, at), (at + side, at + side), (at, at + side)], true)
}

fn area(mesh: &PslgMesh, t: usize) -> f64 {
    let [a, b, c] = mesh.mesh.corners(hexdel_geom::TriangleId::new(t));
    0.5 * (b - a).perp_dot(c - a)
}

#[test]
fn families_keep_their_bounds() {
    for name in support::FAMILIES {
        for seed in 1000..1004 {
            let pslg = support::family(name, seed);
            let made = made(&pslg, &Options::new());
            assert!(made.holds(), "{name} {seed}: {:?}", made.failed);
            assert_eq!(support::check(&pslg, &made), Ok(()), "{name} {seed}");
            let least = made.certificate.min_angle_deg;
            assert!(
                made.certificate.disk && (least > 29.999_999 || !made.exempt.is_empty()),
                "{name} {seed}: {least}"
            );
        }
    }
}

/// Points close together on a side of the hull. A lower bound of 0 asks for nothing of
/// thin triangles, but vertices between the points still lie between them.
#[test]
fn without_a_lower_bound_no_vertices_coincide() {
    let points = [(0, 0), (100, 0), (45, 0), (52, 0), (53, 0), (99, -92), (85, -51)];
    let pslg = Pslg::from_points(points.map(|(x, y)| DVec2::new(f64::from(x), f64::from(y))).to_vec());
    let mut options = Options::new().extent(Extent::Hull).near(AngleBounds::new(0.0, 90.0).unwrap());
    options.far = options.near;
    let made = made(&pslg, &options);
    assert!(made.holds(), "{:?}", made.certificate.violations);
    assert!(made.certificate.min_angle_deg > 0.0);
}

/// A monitor that takes its time.
struct Slow;

impl Monitor for Slow {
    fn progress(&self, _: Phase, _: u64, _: u64) {}

    fn cancelled(&self) -> bool {
        std::thread::sleep(std::time::Duration::from_millis(100));
        false
    }
}

/// Where there is no time for a grid the input itself is what is triangulated.
#[test]
fn without_time_for_a_mesh_there_is_one_of_the_input_alone() {
    let mut pslg = support::family("letter R", 3);
    // The frame of points is no part of what segments enclose.
    for (extent, points) in [(Extent::Hexagon, true), (Extent::Hull, true), (Extent::Inside, false)] {
        if !points {
            pslg.points.truncate(pslg.points.len() - 6);
        }
        let options = Options::new().extent(extent).budget(Some(std::time::Duration::ZERO));
        let made = mesh(&validate(&pslg).unwrap(), &options, &Slow).unwrap();
        assert!(made.budget_spent && !made.failed.is_empty(), "{extent:?}");
        assert_eq!(support::check(&pslg, &made), Ok(()), "{extent:?}");
        // Seven vertices more at most, on a disk with one hole at most.
        let triangles = made.mesh.triangles.len();
        assert!(triangles < 2 * (pslg.points.len() + 7), "{extent:?}: {triangles}");
        let few = made.edges_of_segment.iter().all(|&n| n == 1);
        assert!(few, "{extent:?}: {:?}", made.edges_of_segment);
    }
}

/// Two edges from points and segments the bounds of the plain mesh hold, seen
/// from outside: by the edges of the result alone.
#[test]
fn two_rings_away_the_plain_bounds_hold() {
    let pslg = support::family("letter R", 7);
    let far = |options: Options| {
        let made = made(&pslg, &options);
        let segments = check_segments(&made.mesh, &pslg.points, &pslg.segments);
        let features = features(&made.mesh, &pslg.points, &[], &segments.edges, false);
        let far = Some((AngleBounds::EXTENDED, &features[..]));
        let found = check_promises(&made.mesh, &Promises { far, ..Promises::default() });
        assert!(found.holds(), "{options:?}");
        found.far
    };
    assert!(far(Options::new().compact(None)) > 200);
    assert!(far(Options::new().max_area(0.01)) > 100);
    assert!(far(Options::new()) > 0);
}

#[test]
fn random_graphs_give_valid_meshes_or_errors() {
    let (mut meshed, mut mended) = (0, 0);
    for seed in 0..60 {
        let mut graph = support::random_graph(seed);
        graph.holes.clear();
        if validate(&graph).is_err() {
            let (better, report) = repair(&graph, 1e-6).unwrap();
            assert!(report.complete, "{seed}");
            graph = better;
            mended += 1;
        }
        let options = Options::new().retries(0).max_triangles(100_000);
        match mesh(&validate(&graph).unwrap(), &options, &Unwatched) {
            Ok(made) => {
                assert_eq!(support::check(&graph, &made), Ok(()), "{seed}");
                meshed += 1;
            }
            Err(error) => {
                assert!(matches!(error, PslgError::TooClose { .. } | PslgError::TooMany { .. }), "{error}");
            }
        }
    }
    assert!(meshed > 50 && mended > 10, "{meshed} {mended}");
}

#[test]
fn any_number_of_threads_makes_the_same_mesh() {
    let pslg = support::family("letter R", 5);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| made(&pslg, &Options::new()))
    };
    let (a, b) = (with(1), with(4));
    assert_eq!(a.mesh, b.mesh);
    assert_eq!(a.edges, b.edges);
}

#[test]
fn holes_and_the_outside_are_carved() {
    let mut pslg = square(0.0, 4.0);
    append(&mut pslg, &square(1.0, 1.0));
    pslg.holes.push(DVec2::splat(1.5));
    let inside = made(&pslg, &Options::new().extent(Extent::Inside));
    assert!(inside.holds());
    let total: f64 = (0..inside.mesh.triangles.len()).map(|t| area(&inside, t)).sum();
    assert!((total - 15.0).abs() < 1e-9, "{total}");
    assert_eq!(inside.certificate.boundary_loops, 2);
    assert_eq!(inside.certificate.euler_characteristic, 0);
    assert!(inside.edges.iter().all(|e| e.boundary && e.segment.is_some() && e.marker == 1));
    let hexagon = made(&pslg, &Options::new());
    assert_eq!(hexagon.certificate.euler_characteristic, 0);
}

#[test]
fn the_hull_is_a_boundary() {
    let mut pslg = chain(&[(0.0, 0.0), (3.0, 1.0)], false);
    pslg.points.extend([DVec2::new(4.0, -1.0), DVec2::new(1.0, 3.0), DVec2::new(2.0, 1.5)]);
    let hull = made(&pslg, &Options::new().extent(Extent::Hull));
    assert!(hull.holds(), "{:?}", hull.failed);
    // Corners (0, 0), (4, -1), (3, 1), (1, 3).
    let total: f64 = (0..hull.mesh.triangles.len()).map(|t| area(&hull, t)).sum();
    assert!((total - 7.5).abs() < 1e-9, "{total}");
    assert!(hull.edges.iter().any(|e| e.boundary && e.segment.is_none()));
    assert!(hull.edges.iter().any(|e| !e.boundary && e.segment == Some(0)));
}

#[test]
fn points_nearly_in_line_on_the_hull_are_no_gap() {
    let turn = DVec2::from_angle(0.3);
    let mut pslg = square(0.0, 1.0);
    pslg.points.extend((1..5).map(|i| DVec2::new(0.2 * f64::from(i), 0.0)));
    pslg.segments[0] = [0, 4];
    pslg.segments.extend([[4, 5], [5, 6], [6, 7], [7, 1]]);
    for p in &mut pslg.points {
        *p = turn.rotate(*p);
    }
    let hull = made(&pslg, &Options::new().extent(Extent::Hull));
    assert!(hull.holds(), "{:?}", hull.failed);
}

/// A corner of the hull so flat that the edge beyond it is a hair's breadth away.
#[test]
fn corners_of_the_hull_are_not_cut_off() {
    let points = [(0.0, 0.0), (1.0, 0.0), (1.0 + 1e-7, 5e-8), (0.5, 1.0)];
    let pslg = Pslg::from_points(points.map(|(x, y)| DVec2::new(x, y)).to_vec());
    let hull = made(&pslg, &Options::new().extent(Extent::Hull));
    assert!(hull.vertex_of_point.iter().all(Option::is_some), "{:?}", hull.vertex_of_point);
    assert!(hull.holds(), "{:?}", hull.failed);
}

/// Has no patience: what begins to work is cancelled.
struct AtOnce;

impl Monitor for AtOnce {
    fn progress(&self, _: Phase, _: u64, _: u64) {}

    fn cancelled(&self) -> bool {
        true
    }
}

fn hull_at_once(points: &[DVec2]) -> PslgError {
    let valid = validate(&Pslg::from_points(points.to_vec())).expect("points are a graph");
    let options = Options::new().extent(Extent::Hull);
    let paper = options.clone().method(SegmentMethod::Paper);
    let [plain, paper] =
        [options, paper].map(|options| mesh(&valid, &options, &AtOnce).expect_err("there is no patience"));
    assert_eq!(plain, paper);
    plain
}

#[test]
fn flat_hulls_are_refused_at_once() {
    let zigzag =
        |height: f64| [0.0, height, 0.0, height].into_iter().zip(0..4).map(|(y, x)| (f64::from(x), y));
    let points = |pairs: &mut dyn Iterator<Item = (f64, f64)>| -> Vec<DVec2> {
        pairs.map(|(x, y)| DVec2::new(x, y)).collect()
    };
    let error = hull_at_once(&points(&mut zigzag(1e-13)));
    let PslgError::FlatHull { farthest, ends, distance } = error else { panic!("{error}") };
    assert!([Feature::Point(1), Feature::Point(2)].contains(&farthest), "{farthest}");
    assert_eq!(ends, [Feature::Point(0), Feature::Point(3)]);
    assert!((distance - 2e-13 / 3.0).abs() < 1e-25, "{distance:e}");

    // Turned, rounding is all that keeps points from a line.
    let turn = DVec2::from_angle(0.3);
    let turned: Vec<DVec2> = (0..300).map(|i| 5.0 + turn * (0.01 * f64::from(i))).collect();
    // The three of a triangle have no two sides apart.
    let triangle = points(&mut [(0.0, 0.0), (3.0, 0.0), (1.0, 1e-7)].into_iter());
    for (points, most) in [(turned, 1e-14), (triangle, 1e-7), (points(&mut zigzag(1e-7)), 1e-7)] {
        let error = hull_at_once(&points);
        let PslgError::FlatHull { ends, distance, .. } = error else { panic!("{error}") };
        let [a, b] = ends.map(|end| if let Feature::Point(i) = end { points[i] } else { panic!("{end}") });
        let off = |p: &DVec2| ((b - a).perp_dot(*p - a) / a.distance(b)).abs();
        let farthest = points.iter().map(off).fold(0.0, f64::max);
        assert!(distance > 0.0 && distance <= most, "{distance:e}");
        assert!((farthest - distance).abs() < 1e-14, "{farthest:e} {distance:e}");
    }

    let exact = hull_at_once(&points(&mut zigzag(0.0)));
    assert!(matches!(exact, PslgError::FlatHull { distance: 0.0, .. }), "{exact}");
    // This one is thin, and a mesh.
    let thin = hull_at_once(&points(&mut zigzag(1e-5)));
    assert!(matches!(thin, PslgError::Cancelled(_)), "{thin}");
}

#[test]
fn regions_have_attributes_and_areas() {
    let mut pslg = square(0.0, 2.0);
    pslg.points.extend([DVec2::new(1.0, 0.0), DVec2::new(1.0, 2.0)]);
    pslg.segments.push([4, 5]);
    let region = |x, attribute, max_area| Region { point: DVec2::new(x, 1.0), attribute, max_area };
    pslg.regions = vec![region(0.5, 7.0, None), region(1.5, 8.0, Some(0.004))];
    let made = made(&pslg, &Options::new().extent(Extent::Inside).max_area(0.1));
    assert!(made.holds());
    for (t, region) in made.region_of_triangle.iter().enumerate() {
        let [a, b, c] = made.mesh.corners(hexdel_geom::TriangleId::new(t));
        let right = (a + b + c).x > 3.0;
        assert_eq!(*region, Some(u32::from(right)));
        assert!(area(&made, t) <= if right { 0.004 } else { 0.1 });
    }
    // The bottom and the top are divided by the ends of the middle.
    assert_eq!(validate(&pslg).unwrap().divided().len(), 2);
}

#[test]
fn markers_follow_triangles_habits() {
    let mut pslg = square(0.0, 1.0);
    pslg.points.push(DVec2::new(0.4, 0.5));
    pslg.point_markers = vec![0, 5, 0, 0, 0];
    pslg.segment_markers = vec![3, 0, 0, 0];
    let made = made(&pslg, &Options::new().extent(Extent::Inside));
    let marker = |point: usize| made.vertex_markers[made.vertex_of_point[point].unwrap().index()];
    assert_eq!([0, 1, 2, 4].map(marker), [3, 5, 1, 0]);
    for e in &made.edges {
        assert_eq!(e.marker, if e.segment == Some(0) { 3 } else { 1 });
    }
    let of_first = made.edges.iter().filter(|e| e.segment == Some(0)).count();
    assert_eq!(made.edges_of_segment[0] as usize, of_first);
}

#[test]
fn a_hole_or_region_on_a_vertex_of_the_mesh_counts() {
    // The centre of the input is where the grid has a vertex.
    let mut pslg = square(-2.0, 4.0);
    append(&mut pslg, &square(-1.0, 2.0));
    pslg.holes.push(DVec2::ZERO);
    let options = Options::new().extent(Extent::Inside);
    let carved = made(&pslg, &options.clone().max_area(0.01));
    let total: f64 = (0..carved.mesh.triangles.len()).map(|t| area(&carved, t)).sum();
    assert!((total - 12.0).abs() < 1e-9, "{total}");

    pslg.holes.clear();
    pslg.regions.push(Region { point: DVec2::ZERO, attribute: 7.0, max_area: Some(0.005) });
    let divided = made(&pslg, &options);
    let of_region = divided.region_of_triangle.iter().zip(0..).filter(|(region, _)| region.is_some());
    let total: f64 = of_region.map(|(_, t)| area(&divided, t)).inspect(|a| assert!(*a <= 0.005)).sum();
    assert!((total - 4.0).abs() < 1e-9, "{total}");
}

#[test]
fn holes_that_touch_in_a_point_share_its_vertex() {
    let mut pslg = square(0.0, 8.0);
    append(&mut pslg, &chain(&[(2.0, 2.0), (4.0, 2.5), (4.0, 4.0), (2.5, 4.0)], true));
    append(&mut pslg, &chain(&[(4.0, 4.0), (6.0, 4.5), (6.0, 6.0), (4.5, 6.0)], true));
    pslg.holes = vec![DVec2::splat(3.0), DVec2::splat(5.0)];
    let made = made(&pslg, &Options::new().extent(Extent::Inside));
    assert!(made.failed.is_empty(), "{:?}", made.failed);
    assert_eq!(support::check(&pslg, &made), Ok(()));
    assert_eq!(made.vertex_of_point[6], made.vertex_of_point[8]);
}

#[test]
fn narrow_corners_are_exempt_and_named() {
    let pslg = chain(&[(1.0, 0.0), (0.0, 0.0), (0.92, 0.39)], false);
    let made = made(&pslg, &Options::new());
    assert!(made.holds(), "{:?}", made.failed);
    assert_eq!(made.exempt.len(), 1);
    let Reason::Sector { point: 1, angle_deg } = made.exempt[0].reason else {
        panic!("{:?}", made.exempt);
    };
    assert!((angle_deg - 22.97).abs() < 0.1);
}

#[test]
fn narrow_corners_spoil_triangles_at_their_point_only() {
    for angle in [0.1_f64, 0.5, 2.0, 5.0] {
        let (s, c) = angle.to_radians().sin_cos();
        for far in [DVec2::new(c, s), DVec2::new(c, s) * 0.7] {
            let pslg = chain(&[(1.0, 0.0), (0.0, 0.0), far.into()], false);
            let made = made(&pslg, &Options::new());
            assert!(made.holds(), "{angle}: {:?}", made.failed);
            assert_eq!(support::check(&pslg, &made), Ok(()));
            assert!(made.certificate.triangles < 600, "{angle}: {}", made.certificate.triangles);
            assert!(is_at_points(&made, &[1]), "{angle}: {:?}", made.exempt);
        }
    }
}

/// A segment with a narrow corner at either end, which both have a fan.
fn two_narrow_corners(length: f64, corner_deg: f64) -> Pslg {
    let mut pslg = Pslg::from_points(vec![DVec2::ZERO, DVec2::X]);
    pslg.segments = vec![[0, 1]];
    for (site, side) in [(0, -1.0), (1, 1.0)] {
        for turn in [-0.5, 0.5] {
            let (sin, cos) = libm::sincos((7.0 + turn * corner_deg).to_radians());
            pslg.segments.push([site, pslg.points.len() as u32]);
            pslg.points.push(pslg.points[site as usize] + length * DVec2::new(side * cos, sin));
        }
    }
    pslg
}

#[test]
fn two_fans_on_a_segment_leave_room_between_them() {
    for (length, corner_deg) in [(30.0, 5.0), (30.0, 2.0), (30.0, 0.5)] {
        let pslg = two_narrow_corners(length, corner_deg);
        let made = made(&pslg, &Options::new().extent(Extent::Hull));
        assert!(made.holds(), "{corner_deg}: {:?}", made.failed);
        assert_eq!(support::check(&pslg, &made), Ok(()), "{corner_deg}");
    }
}

#[test]
fn higher_bounds_have_fans_at_wider_corners() {
    let near = AngleBounds::new(43.8978, 90.0).expect("ordered");
    // There is a corner of 10 degrees in the letter.
    let letter = support::family("letter R", 0);
    let wedge = |angle_deg| support::wedge(angle_deg, 3);
    for pslg in [letter, wedge(8.0), wedge(12.0), wedge(19.0), wedge(22.0), wedge(30.0)] {
        let made = made(&pslg, &Options::new().near(near));
        assert!(made.holds(), "{:?}", made.failed);
        assert_eq!(support::check(&pslg, &made), Ok(()));
        assert_eq!(made.retries, 0);
    }
}

#[test]
fn needles_in_a_frame_spoil_triangles_at_their_point_only() {
    let inside = Options::new().extent(Extent::Inside);
    for name in support::NEEDLES {
        for (angle, seeds) in [(0.1, 0..1), (0.3, 1..2), (1.0, 2..4)] {
            for seed in seeds {
                let pslg = support::needle(name, angle, seed);
                let made = made(&pslg, &inside);
                let what = format!("{name}, {angle} degrees, {seed}");
                assert!(made.holds(), "{what}: {:?}", made.failed);
                assert_eq!(support::check(&pslg, &made), Ok(()), "{what}");
                assert!(is_at_points(&made, &[4, 5, 6, 7, 0]), "{what}: {:?}", made.exempt);
                assert_eq!(made.retries, 0, "{what}");
            }
        }
    }
}

/// Whether all exempt triangles have a corner at one of these points.
fn is_at_points(made: &PslgMesh, points: &[usize]) -> bool {
    made.exempt.iter().all(|e| {
        let corners = made.mesh.triangles[e.triangle.index()];
        points.iter().any(|&p| made.vertex_of_point[p].is_some_and(|v| corners.contains(&v)))
    })
}

#[test]
fn no_part_of_the_plane_ends_at_a_fan() {
    // A splinter in a square: a hole, a region, and what encloses it.
    let mut pslg = square(-2.0, 4.0);
    append(&mut pslg, &chain(&[(-1.0, 0.0), (1.0, 0.05), (1.0, 0.1)], true));
    pslg.regions.push(Region { point: DVec2::splat(1.5), attribute: 1.0, max_area: None });
    let splinter = Region { point: DVec2::new(0.99, 0.075), attribute: 2.0, max_area: None };
    pslg.regions.push(splinter);
    let whole = made(&pslg, &Options::new().extent(Extent::Inside));
    assert!(whole.holds() && is_at_points(&whole, &[4]), "{:?} {:?}", whole.failed, whole.exempt);
    let of = |made: &PslgMesh, region| {
        let inside = made.region_of_triangle.iter().zip(0..).filter(|(r, _)| **r == Some(region));
        inside.map(|(_, t)| area(made, t)).sum::<f64>()
    };
    assert!((of(&whole, 0) - 15.95).abs() < 1e-9 && (of(&whole, 1) - 0.05).abs() < 1e-9);
    pslg.holes.push(splinter.point);
    let without = made(&pslg, &Options::new().extent(Extent::Inside));
    assert!(without.holds(), "{:?}", without.failed);
    assert!((of(&without, 0) - 15.95).abs() < 1e-9 && of(&without, 1) == 0.0);
    assert_eq!(without.certificate.boundary_loops, 2);
}

#[test]
fn many_segments_may_end_in_a_point() {
    for n in [12, 18, 40] {
        let pslg = support::rays(n, 3);
        let made = made(&pslg, &Options::new());
        assert!(made.holds() && is_at_points(&made, &[0]), "{n}: {:?}", made.failed);
        assert_eq!(support::check(&pslg, &made), Ok(()));
    }
}

#[test]
fn what_coordinates_cannot_resolve_is_an_error() {
    let pslg = chain(&[(0.0, 0.0), (1.0, 0.0), (1.0 - 1e-13, 1e-13), (0.0, 1.0)], true);
    let refused = mesh(&validate(&pslg).unwrap(), &Options::new(), &Unwatched);
    assert!(matches!(refused, Err(PslgError::TooClose { .. })), "{refused:?}");
    let open = chain(&[(0.0, 0.0), (1.0, 0.0), (0.5, 1.0)], false);
    let refused = mesh(&validate(&open).unwrap(), &Options::new().extent(Extent::Inside), &Unwatched);
    assert!(matches!(refused.err(), Some(PslgError::NothingEnclosed { count: 2, .. })));
    let refused = mesh(&validate(&open).unwrap(), &Options::new().max_triangles(100), &Unwatched);
    assert!(matches!(refused, Err(PslgError::TooMany { .. })));
}

/// A rhombus of 12 degrees in a rectangle.
fn needle() -> Pslg {
    let mut pslg = chain(&[(0.0, 0.0), (8.0, 0.0), (8.0, 6.0), (0.0, 6.0)], true);
    let (h, length) = (0.105_104_235_265_676_46, 1.0);
    append(&mut pslg, &chain(&[(2.0, 3.0), (2.0 + length, 3.0 + h), (7.0, 3.0), (3.0, 3.0 - h)], true));
    pslg
}

#[test]
fn no_triangle_is_larger_than_allowed_and_not_told() {
    for extent in [Extent::Inside, Extent::Hull] {
        for limit in [0.05, 0.3] {
            let made = made(&needle(), &Options::new().extent(extent).max_area(limit));
            let large: Vec<usize> =
                (0..made.mesh.triangles.len()).filter(|&t| area(&made, t) > limit).collect();
            let told = |t: &usize| made.failed.iter().any(|f| f.triangle.index() == *t);
            assert!(large.iter().all(told), "{extent:?} {limit}: {large:?}");
            assert!(made.holds(), "{extent:?} {limit}: {:?}", made.failed);
        }
    }
}

/// Stops when the mesh is there and optimisation begins.
struct UntilOptimised(AtomicBool);

impl Monitor for UntilOptimised {
    fn progress(&self, phase: Phase, _: u64, _: u64) {
        self.0.fetch_or(phase == Phase::Optimize, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

#[test]
fn what_is_no_better_does_not_cost_the_mesh() {
    // Bounds that are too tight for what is beside the tips.
    let bounds = AngleBounds::new(46.0, 90.0).unwrap();
    let valid = validate(&needle()).unwrap();
    let run = |retries, limit, monitor: &dyn Monitor| {
        let options = Options::new().extent(Extent::Inside).near(bounds).compact(None);
        mesh(&valid, &options.retries(retries).max_triangles(limit), monitor)
    };
    let (mut little, mut enough) = (1, 200_000);
    while enough - little > 1 {
        let limit = usize::midpoint(little, enough);
        match run(0, limit, &UntilOptimised(AtomicBool::new(false))) {
            Err(PslgError::Cancelled(_)) => enough = limit,
            Err(PslgError::TooMany { .. }) => little = limit,
            Ok(_) => panic!("nothing was optimised"),
            Err(error) => panic!("{error}"),
        }
    }
    let first = run(0, enough, &Unwatched).unwrap();
    assert!(!first.failed.is_empty());
    // Finer hexagons are more than the limit allows.
    assert_eq!(run(1, enough, &Unwatched).unwrap().mesh, first.mesh);
}
