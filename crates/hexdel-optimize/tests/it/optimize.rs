//! Whole runs: what is promised of every result, on all kinds of input.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::support::{Rule, Start, points, start};
use hexdel_geom::{AngleBounds, Cancelled, DVec2, Monitor, TriMesh, Unwatched, VertexId};
use hexdel_optimize::{Effort, OptimizeError, Optimized, Options, VertexKind, optimize};
use hexdel_refine::Start as Coarse;
use proptest::prelude::*;

fn area(mesh: &TriMesh) -> f64 {
    let corners = |t: &[VertexId; 3]| t.map(|v| mesh.vertices[v.index()]);
    mesh.triangles
        .iter()
        .map(|t| {
            let [a, b, c] = corners(t);
            0.5 * (b - a).perp_dot(c - a)
        })
        .sum()
}

fn angles(mesh: &TriMesh) -> (f64, f64) {
    let mut range = (f64::INFINITY, f64::NEG_INFINITY);
    for t in &mesh.triangles {
        let p = t.map(|v| mesh.vertices[v.index()]);
        for k in 0..3 {
            let (u, w) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            let a = u.perp_dot(w).atan2(u.dot(w)).to_degrees();
            range = (range.0.min(a), range.1.max(a));
        }
    }
    range
}

/// Everything that holds for any result, whether all angles hold or not.
fn check_mesh(before: &Start, after: &Optimized) {
    let mut sides = BTreeSet::new();
    for t in &after.mesh.triangles {
        for k in 0..3 {
            let side = (t[k], t[(k + 1) % 3]);
            assert!(sides.insert(side), "side {side:?} twice");
        }
    }
    let used: usize = after.mesh.vertices.len();
    let rim = sides.iter().filter(|(a, b)| !sides.contains(&(*b, *a))).count();
    let edges = usize::midpoint(sides.len(), rim);
    assert_eq!(used + after.mesh.triangles.len(), edges + 1, "a disc");
    let (a, b) = (area(&before.mesh), area(&after.mesh));
    assert!((a - b).abs() < 1e-9 * a, "area {a} {b}");
    let mut last = None;
    for (i, kind) in before.kinds.iter().enumerate() {
        let now = after.vertices[i];
        if *kind == VertexKind::Fixed {
            let now = now.expect("fixed vertices stay");
            assert_eq!(after.mesh.vertices[now.index()], before.mesh.vertices[i]);
        }
        if now.is_some() {
            assert!(now > last, "order");
            last = now;
        }
    }
}

fn check(before: &Start, bounds: AngleBounds, effort: Effort) -> Optimized {
    let result = optimize(before.mesh.clone(), &before.kinds, &Options::new(bounds, effort), &Unwatched)
        .expect("all angles hold");
    check_mesh(before, &result);
    let (min, max) = angles(&result.mesh);
    assert!(min >= bounds.min_deg() - 1e-9 && max <= bounds.max_deg() + 1e-9, "{min} {max}");
    result
}

#[test]
fn small_inputs_of_all_kinds_keep_the_bounds() {
    let inputs = [
        points::two_close(),
        points::line(12, 1),
        points::grid(4),
        points::circle(12),
        points::pairs(3, 1e-3, 1),
        points::pairs(2, 1e-6, 1),
        points::clusters(20, 1),
        points::uniform(20, 3),
    ];
    for (i, input) in inputs.iter().enumerate() {
        let before = start(input, Rule::Templates);
        let after = check(&before, AngleBounds::EXTENDED, Effort::Standard);
        assert!(after.finished && after.mesh.triangles.len() < before.mesh.triangles.len(), "input {i}");
    }
}

#[test]
fn other_bounds_are_kept() {
    let before = start(&points::uniform(15, 5), Rule::Templates);
    for (min, max) in [(30.0, 90.0), (40.0, 90.0), (43.9, 86.0), (30.0, 120.0)] {
        check(&before, AngleBounds::new(min, max).unwrap(), Effort::Standard);
    }
}

#[test]
fn more_effort_leaves_fewer_triangles() {
    let before = start(&points::uniform(15, 7), Rule::Templates);
    let count = |e| check(&before, AngleBounds::EXTENDED, e).mesh.triangles.len();
    let (fast, standard, best) = (count(Effort::Fast), count(Effort::Standard), count(Effort::Best));
    assert!(fast > standard && standard > best, "{fast} {standard} {best}");
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let before = start(&points::uniform(150, 9), Rule::Coarse(Coarse::Among));
    let run = |threads| {
        let pool = rayon_pool(threads);
        pool.install(|| {
            match optimize(
                before.mesh.clone(),
                &before.kinds,
                &Options::new(AngleBounds::EXTENDED, Effort::Standard),
                &Unwatched,
            ) {
                Ok(o) => o,
                Err(OptimizeError::Unreached { best, .. }) => *best,
                Err(e) => panic!("{e}"),
            }
        })
    };
    let one = run(1);
    assert_eq!(one, run(2));
    assert_eq!(one, run(8));
}

fn rayon_pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool")
}

/// Gives up at the question numbered `at`, from 0.
struct CancelAt {
    at: usize,
    asked: AtomicUsize,
}

impl Monitor for CancelAt {
    fn cancelled(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.at
    }
}

#[test]
fn the_monitor_stops_the_work_at_once() {
    let before = start(&points::uniform(12, 3), Rule::Templates);
    let options = Options::new(AngleBounds::EXTENDED, Effort::Standard);
    let run = |at| {
        let monitor = CancelAt { at, asked: AtomicUsize::new(0) };
        let result = optimize(before.mesh.clone(), &before.kinds, &options, &monitor);
        (result, monitor.asked.into_inner())
    };
    let (done, questions) = run(usize::MAX);
    assert!(done.expect("nobody stopped it").finished && questions > 10);
    for at in 0..questions {
        let (stopped, asked) = run(at);
        assert_eq!(stopped, Err(OptimizeError::Cancelled(Cancelled)));
        assert_eq!(asked, at + 1);
    }
}

#[test]
fn no_time_means_no_work() {
    let before = start(&points::two_close(), Rule::Templates);
    let options =
        Options::new(AngleBounds::EXTENDED, Effort::Standard).with_budget(std::time::Duration::ZERO);
    let result = match optimize(before.mesh.clone(), &before.kinds, &options, &Unwatched) {
        Ok(o) => o,
        Err(OptimizeError::Unreached { best, .. }) => *best,
        Err(e) => panic!("{e}"),
    };
    assert_eq!(result.mesh.triangles.len(), before.mesh.triangles.len());
}

fn square() -> (TriMesh, Vec<VertexKind>) {
    let vertices =
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.3, 0.2)].map(|(x, y)| DVec2::new(x, y)).to_vec();
    let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]].map(|t| t.map(VertexId::new)).to_vec();
    let mut kinds = vec![VertexKind::Fixed; 5];
    kinds[4] = VertexKind::Free;
    (TriMesh { vertices, triangles }, kinds)
}

#[test]
fn bad_input_is_named() {
    let options = Options::new(AngleBounds::EXTENDED, Effort::Standard);
    let run = |change: &dyn Fn(&mut TriMesh, &mut Vec<VertexKind>)| {
        let (mut mesh, mut kinds) = square();
        change(&mut mesh, &mut kinds);
        optimize(mesh, &kinds, &options, &Unwatched).map(|_| ()).unwrap_err().to_string()
    };
    assert_eq!(run(&|_, k| k.truncate(4)), "4 kinds for 5 vertices");
    assert!(run(&|m, _| m.vertices[2].y = f64::NAN).starts_with("vertex 2 has"));
    assert!(run(&|m, _| m.triangles[1][2] = VertexId::new(9)).starts_with("triangle 1 has corner 9"));
    assert!(run(&|m, _| m.triangles[1][2] = VertexId::new(1)).starts_with("triangle 1 has vertex 1 twice"));
    assert!(run(&|m, _| m.triangles.push(m.triangles[0])).starts_with("two triangles lie on the same side"));
    assert!(
        run(&|m, k| {
            m.vertices.push(DVec2::ZERO);
            k.push(VertexKind::Free);
        })
        .starts_with("vertex 5 at")
    );
    assert!(run(&|_, k| k[0] = VertexKind::Free).starts_with("the kind of vertex 0"));
    assert!(run(&|_, k| k[4] = VertexKind::Sliding(DVec2::X)).starts_with("the kind of vertex 4"));
}

#[test]
fn a_square_is_settled() {
    let (mesh, kinds) = square();
    let bounds = AngleBounds::new(30.0, 90.0).unwrap();
    let result = optimize(mesh, &kinds, &Options::new(bounds, Effort::Standard), &Unwatched).unwrap();
    let (min, max) = angles(&result.mesh);
    assert!(min >= 30.0 && max <= 90.0 + 1e-9, "{min} {max}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn coarse_starts_give_a_valid_mesh(seed in 0u64..1000, n in 2usize..30) {
        let before = start(&points::uniform(n, seed), Rule::Coarse(Coarse::Apart));
        let options = Options::new(AngleBounds::EXTENDED, Effort::Standard);
        let result = match optimize(before.mesh.clone(), &before.kinds, &options, &Unwatched) {
            Ok(o) => o,
            Err(OptimizeError::Unreached { best, .. }) => *best,
            Err(e) => return Err(TestCaseError::fail(e.to_string())),
        };
        check_mesh(&before, &result);
    }
}
