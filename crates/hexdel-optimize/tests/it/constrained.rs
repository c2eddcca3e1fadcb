//! Meshes with segments in them: what must stay stays, and bounds hold by
//! place.

use std::collections::{BTreeMap, BTreeSet};

use hexdel_geom::{AngleBounds, DVec2, TriMesh, Unwatched, VertexId, point_on_segment, quality};
use hexdel_optimize::{
    Constraints, Effort, OptimizeError, Optimized, Options, VertexKind, kinds_of, optimize_constrained,
};

const SIDE: usize = 18;

/// A square of right triangles with a segment along one of its rows, and one
/// along a column that ends on it.
struct Start {
    mesh: TriMesh,
    kinds: Vec<VertexKind>,
    constraints: Constraints<'static>,
}

fn bounds(min: f64) -> AngleBounds {
    AngleBounds::new(min, 90.0).expect("feasible bounds")
}

fn start() -> Start {
    let id = |x: usize, y: usize| VertexId::new(x + y * (SIDE + 1));
    let mut mesh = TriMesh::default();
    // Irrational steps, so that points of the segments are rounded.
    let step = DVec2::new(0.1 * 2f64.sqrt(), 0.1 * 3f64.sqrt() * 0.8);
    for y in 0..=SIDE {
        for x in 0..=SIDE {
            mesh.vertices.push(DVec2::new(x as f64, y as f64) * step);
        }
    }
    for y in 0..SIDE {
        for x in 0..SIDE {
            let [a, b, c, d] = [id(x, y), id(x + 1, y), id(x + 1, y + 1), id(x, y + 1)];
            mesh.triangles.extend(if (x + y) % 2 == 0 {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            });
        }
    }
    let (left, right, foot, head) = (id(2, 5), id(10, 5), id(6, 5), id(6, 11));
    let rows: Vec<Vec<VertexId>> = vec![
        (2..=6).map(|x| id(x, 5)).collect(),
        (6..=10).map(|x| id(x, 5)).collect(),
        (5..=11).map(|y| id(6, y)).collect(),
    ];
    let ends = [left, right, foot, head];
    let mut kinds = kinds_of(&mesh, |v| ends.contains(&v));
    let mut constraints = Constraints { points: ends.to_vec(), near: bounds(30.0), ..Constraints::default() };
    for (segment, row) in rows.iter().enumerate() {
        let ends = [row[0], row[row.len() - 1]].map(|v| mesh.vertices[v.index()]);
        constraints.segments.push(ends);
        constraints.edges.extend(row.windows(2).map(|w| [w[0], w[1]]));
        for (i, v) in row.iter().enumerate().skip(1).take(row.len() - 2) {
            kinds[v.index()] = VertexKind::OnSegment(segment);
            mesh.vertices[v.index()] = point_on_segment(ends[0], ends[1], i as f64 / (row.len() - 1) as f64);
        }
    }
    Start { mesh, kinds, constraints }
}

fn run(start: &Start, effort: Effort) -> Optimized {
    let options = Options::new(bounds(40.0), effort);
    optimize_constrained(start.mesh.clone(), &start.kinds, &start.constraints, &options, &Unwatched)
        .expect("all angles hold")
}

/// The segments of the result, each as its vertices in a row from its start.
fn check_segments(start: &Start, made: &Optimized) {
    let neighbours: BTreeMap<VertexId, Vec<VertexId>> =
        made.edges.iter().fold(BTreeMap::new(), |mut map, &[a, b]| {
            map.entry(a).or_insert_with(Vec::new).push(b);
            map.entry(b).or_insert_with(Vec::new).push(a);
            map
        });
    let mut edges = 0;
    for (segment, &[from, to]) in start.constraints.segments.iter().enumerate() {
        let of = |v: VertexId| made.kinds[v.index()] == VertexKind::OnSegment(segment);
        let position = |v: VertexId| made.mesh.vertices[v.index()];
        let along = |v: VertexId| (position(v) - from).dot((to - from).normalize());
        let mut at =
            made.mesh.vertices.iter().position(|&p| p == from).map(VertexId::new).expect("ends stay");
        while position(at) != to {
            let next = neighbours[&at].iter().copied().filter(|&n| of(n) || position(n) == to);
            let next = next.filter(|&n| along(n) > along(at)).min_by(|&a, &b| along(a).total_cmp(&along(b)));
            at = next.expect("the segment goes on");
            edges += 1;
            let t = along(at) / from.distance(to);
            let off = position(at).distance(point_on_segment(from, to, t));
            assert!(off <= 4.0 * f64::EPSILON, "{off:e}");
        }
    }
    assert_eq!(edges, made.edges.len(), "no edge is on no segment");
}

fn check_angles(start: &Start, made: &Optimized, with_far: bool) {
    let mesh = &made.mesh;
    let mut sources: BTreeSet<VertexId> =
        start.constraints.points.iter().map(|v| made.vertices[v.index()].expect("points stay")).collect();
    let on = |v: &usize| matches!(made.kinds[*v], VertexKind::OnSegment(_));
    sources.extend((0..mesh.vertices.len()).filter(on).map(VertexId::new));
    let touching = mesh.triangles.iter().filter(|t| t.iter().any(|v| sources.contains(v)));
    let near: BTreeSet<VertexId> = touching.flatten().copied().collect();
    let (mut of_near, mut of_far) = (0, 0);
    for t in &mesh.triangles {
        let is_near = t.iter().any(|v| near.contains(v));
        let least = if is_near { 30.0 } else { 40.0 };
        *(if is_near { &mut of_near } else { &mut of_far }) += 1;
        for angle in quality::angles_deg(t.map(|v| mesh.vertices[v.index()])) {
            assert!((least - 1e-9..=90.0 + 1e-9).contains(&angle), "{angle} where {least} is the least");
        }
    }
    assert!(of_near > 0 && (of_far > 0 || !with_far));
}

#[test]
fn segments_stay_and_bounds_hold_by_place() {
    let before = start();
    // The passes of fast effort find nothing in a lattice of right angles.
    for effort in [Effort::Standard, Effort::Best] {
        let made = run(&before, effort);
        check_segments(&before, &made);
        check_angles(&before, &made, false);
        assert!(made.mesh.triangles.len() * 3 < before.mesh.triangles.len() * 2, "{effort:?}");
        assert!(made.edges.len() < before.constraints.edges.len(), "{effort:?}");
        for v in &before.constraints.points {
            let now = made.vertices[v.index()].unwrap();
            assert_eq!(made.mesh.vertices[now.index()], before.mesh.vertices[v.index()]);
        }
    }
}

fn small_at_two_sides(p: DVec2) -> f64 {
    if p.x < 0.85 || p.y > 1.6 { 0.03 } else { f64::INFINITY }
}

#[test]
fn no_triangle_grows_beyond_its_limit() {
    let mut before = start();
    before.constraints.max_area = Some(&small_at_two_sides);
    let largest = |mesh: &TriMesh| {
        let (mut left, mut right) = (0.0_f64, 0.0_f64);
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|v| mesh.vertices[v.index()]);
            let area = 0.5 * (b - a).perp_dot(c - a);
            let side = if small_at_two_sides((a + b + c) / 3.0) < 1.0 { &mut left } else { &mut right };
            *side = side.max(area);
        }
        (left, right)
    };
    let options = Options::new(bounds(40.0), Effort::Standard);
    let (mesh, kinds) = (before.mesh.clone(), &before.kinds);
    let made = optimize_constrained(mesh, kinds, &before.constraints, &options, &Unwatched).unwrap();
    check_segments(&before, &made);
    check_angles(&before, &made, true);
    let (left, right) = largest(&made.mesh);
    assert!(left <= 0.03, "{left}");
    assert!(right > 0.03, "{right}");
}

#[test]
fn constraints_that_do_not_fit_are_named() {
    let options = Options::default();
    let refused = |change: &dyn Fn(&mut Start)| {
        let mut s = start();
        change(&mut s);
        optimize_constrained(s.mesh, &s.kinds, &s.constraints, &options, &Unwatched).unwrap_err()
    };
    let far = [VertexId::new(0), VertexId::new(200)];
    assert_eq!(refused(&|s| s.constraints.edges.push(far)), OptimizeError::NoSuchEdge { edge: far });
    let gone = VertexId::new(1000);
    let missing = refused(&|s| s.constraints.points.push(gone));
    assert_eq!(missing, OptimizeError::NoSuchItem { what: "vertex", index: 1000, count: 361 });
    let missing = refused(&|s| s.constraints.segments.truncate(2));
    assert_eq!(missing, OptimizeError::NoSuchItem { what: "segment", index: 2, count: 2 });
    // A vertex on a segment of which an edge is missing.
    let misplaced = refused(&|s| {
        s.constraints.edges.remove(1);
    });
    assert!(matches!(misplaced, OptimizeError::Misplaced { .. }), "{misplaced}");
}

fn out_of_bounds(mesh: &TriMesh, least: f64) -> usize {
    let out = |t: &&[VertexId; 3]| {
        let angles = quality::angles_deg(t.map(|v| mesh.vertices[v.index()]));
        !angles.iter().all(|a| (least - 1e-9..=90.0 + 1e-9).contains(a))
    };
    mesh.triangles.iter().filter(out).count()
}

#[test]
fn no_effort_leaves_more_triangles_out_of_bounds_than_it_found() {
    for shift in 1..=12 {
        let mut before = start();
        // A pair of points that leaves no room for good angles.
        let pair = [5, 6].map(|x| VertexId::new(x + 13 * (SIDE + 1)));
        for v in pair {
            before.kinds[v.index()] = VertexKind::Fixed;
        }
        before.constraints.near = bounds(42.0);
        before.mesh.vertices[pair[0].index()].x += 0.01 * f64::from(shift);
        let found = out_of_bounds(&before.mesh, 42.0);
        for effort in [Effort::Repair, Effort::Fast, Effort::Standard] {
            let options = Options::new(bounds(42.0), effort);
            let mesh = before.mesh.clone();
            let made = optimize_constrained(mesh, &before.kinds, &before.constraints, &options, &Unwatched);
            let left = match made {
                Ok(made) => out_of_bounds(&made.mesh, 42.0),
                Err(OptimizeError::Unreached { best, .. }) => out_of_bounds(&best.mesh, 42.0),
                Err(error) => panic!("{error}"),
            };
            assert!(left <= found, "{shift} {effort:?}: {left} of {found}");
        }
    }
}
