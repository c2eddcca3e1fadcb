use proptest::prelude::*;

use super::*;
use crate::certificate::{CertifyOptions, certify};

fn mesh(vertices: &[[f64; 2]], triangles: &[[usize; 3]]) -> TriMesh {
    TriMesh {
        vertices: vertices.iter().map(|&p| p.into()).collect(),
        triangles: triangles.iter().map(|t| t.map(VertexId::new)).collect(),
    }
}

fn wide() -> AngleBounds {
    AngleBounds::new(0.0, 180.0).unwrap()
}

fn is_delaunay(mesh: &TriMesh, bounds: AngleBounds) -> bool {
    certify(mesh, &CertifyOptions { bounds, ..CertifyOptions::default() }).holds()
}

/// A rectangular grid, rotated so that no rectangle is exactly cocircular,
/// with all diagonals the same way.
fn rotated_grid(n: usize, width: f64, height: f64) -> TriMesh {
    let (sin, cos) = libm::sincos(0.3);
    let at = |i: usize| {
        let p = DVec2::new((i % n) as f64 * width, (i / n) as f64 * height);
        DVec2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y)
    };
    let cells = (0..n * (n - 1)).filter(|i| i % n + 1 < n);
    let triangles = cells.flat_map(|i| [[i, i + 1, i + n + 1], [i, i + n + 1, i + n]]);
    TriMesh {
        vertices: (0..n * n).map(at).collect(),
        triangles: triangles.map(|t| t.map(VertexId::new)).collect(),
    }
}

#[test]
fn nothing_to_do() {
    let mut m = mesh(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], &[[0, 1, 2]]);
    let before = m.clone();
    let report = restore_delaunay(&mut m, AngleBounds::EXTENDED, |_| true);
    assert_eq!(report, Ok(FlipReport::default()));
    assert_eq!(m, before);
    assert_eq!(restore_delaunay(&mut TriMesh::default(), wide(), |_| true), Ok(FlipReport::default()));
}

#[test]
fn rectangles_are_flipped() {
    let mut m = rotated_grid(40, 1.0, 1.0);
    let vertices = m.vertices.clone();
    let report = restore_delaunay(&mut m, AngleBounds::EXTENDED, |_| false).unwrap();
    assert!(report.found > 0 && report.flips > 0);
    assert_eq!(report.nudges, 0);
    assert_eq!(m.vertices, vertices);
    assert!(is_delaunay(&m, AngleBounds::EXTENDED));
}

/// A flat triangle and a slender one on a common edge, in whatever place and order: that edge is found.
#[test]
fn a_bad_edge_is_found_wherever_it_is() {
    for turn in 0..36 {
        for (first, second) in (0..3).flat_map(|i| (0..3).map(move |k| (i, k))) {
            let direction = DVec2::from_angle(f64::from(turn) * 10_f64.to_radians());
            let (middle, aside) = (1000.0 * direction, DVec2::from_angle(f64::from(turn)));
            let [a, c] = [middle - aside, middle + aside];
            let [b, d] = [middle - 0.3 * aside.perp(), middle + 1.2 * aside.perp()];
            let mut triangles = [[2, 0, 3], [3, 1, 2]];
            triangles[0].rotate_left(first);
            triangles[1].rotate_left(second);
            let mut m = mesh(&[b, d, a, c].map(Into::into), &triangles);
            let report = restore_delaunay(&mut m, wide(), |_| false);
            assert_eq!(report.map(|r| r.flips), Ok(1), "turn {turn}, {triangles:?}");
        }
    }
}

/// Kites of two right triangles with legs 1 and 0.98, four around a vertex of
/// a rotated lattice: flipping would make angles of about 91 degrees.
fn kite(turn: f64) -> TriMesh {
    let (sin, cos) = libm::sincos(turn);
    let turned = |x: f64, y: f64| [cos * x - sin * y + 0.7, sin * x + cos * y - 0.3];
    let (p, q) = (1.0, 0.98);
    // The foot of the right angle over the hypotenuse from (0, 0).
    let length = f64::hypot(p, q);
    let (along, height) = (p * p / length, p * q / length);
    let vertices = [turned(0.0, 0.0), turned(along, -height), turned(length, 0.0), turned(along, height)];
    mesh(&vertices, &[[0, 1, 2], [0, 2, 3]])
}

#[test]
fn kites_are_nudged() {
    let mut nudged = 0;
    for i in 0..200 {
        let mut m = kite(f64::from(i) * 0.1);
        let before = m.clone();
        let report = restore_delaunay(&mut m, AngleBounds::EXTENDED, |v| v.index() == 1).unwrap();
        assert_eq!(report.flips, 0);
        assert_eq!(report.nudges, report.found);
        nudged += report.nudges;
        assert!(is_delaunay(&m, AngleBounds::EXTENDED));
        assert_eq!(m.triangles, before.triangles);
        for v in [0, 2, 3] {
            assert_eq!(m.vertices[v], before.vertices[v]);
        }
        assert!(m.vertices[1].distance(before.vertices[1]) < 1e-14);
    }
    assert!(nudged > 20, "some kites round to the wrong side: {nudged}");
}

#[test]
fn a_fixed_kite_is_an_error() {
    let stuck = (0..200).map(|i| kite(f64::from(i) * 0.1)).find_map(|mut m| {
        let ends = [m.vertices[0], m.vertices[2]];
        restore_delaunay(&mut m, AngleBounds::EXTENDED, |_| false).err().map(|e| (e, ends))
    });
    let (DelaunayError::Stuck { ends, .. }, expected) = stuck.unwrap() else { panic!() };
    assert_eq!(ends, expected);
}

/// Rectangles that may not be flipped: bounds are chosen so that nothing fits,
/// hence the nudges have to agree all over the lattice.
#[test]
fn a_lattice_of_kites_is_nudged() {
    // Two columns of kites glued to a strip: each has its own free apex.
    for turn in 0..20 {
        let (sin, cos) = libm::sincos(f64::from(turn) * 0.37);
        let turned = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        let (along, height) = (1.0 / f64::hypot(1.0, 0.98), 0.98 / f64::hypot(1.0, 0.98));
        for k in 0..20 {
            let x = f64::from(k) * f64::hypot(1.0, 0.98);
            vertices.extend([turned(x, 0.0), turned(x + along, -height), turned(x + along, height)]);
            let i = 3 * k as usize;
            triangles.extend([[i, i + 1, i + 3], [i, i + 3, i + 2]]);
        }
        vertices.push(turned(20.0 * f64::hypot(1.0, 0.98), 0.0));
        let mut m = mesh(&vertices, &triangles);
        let report = restore_delaunay(&mut m, AngleBounds::EXTENDED, |_| true).unwrap();
        assert!(report.found > 0 && report.flips == 0);
        let certificate = certify(&m, &CertifyOptions { require_disk: false, ..Default::default() });
        assert!(certificate.delaunay && certificate.out_of_bounds == 0);
    }
}

#[test]
fn broken_meshes_are_errors() {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut m = mesh(&square, &[[0, 1, 2], [0, 2, 7]]);
    let err = restore_delaunay(&mut m, wide(), |_| true).unwrap_err();
    assert_eq!(err.to_string(), "triangle 1 has corners 0, 2, 7: not three vertices of the mesh");
    let mut m = mesh(&square, &[[0, 1, 2], [0, 1, 3]]);
    let err = restore_delaunay(&mut m, wide(), |_| true).unwrap_err();
    assert!(matches!(err, DelaunayError::Overlap { .. }));
    let mut m = mesh(&[[f64::NAN, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &[[0, 1, 2], [0, 2, 3]]);
    assert!(restore_delaunay(&mut m, wide(), |_| true).is_ok());
}

proptest! {
    /// A fan over a convex chain, about as far from Delaunay as can be.
    #[test]
    fn any_triangulation_is_restored(mut raw in prop::collection::vec((-1.0..1.0f64, 0.2..1.0f64), 4..40)) {
        raw.sort_by(|p, q| p.0.total_cmp(&q.0));
        raw.dedup_by(|p, q| p.0 == q.0);
        // A strip between two x-monotone chains: y = 0 and the points above.
        let n = raw.len();
        let below = raw.iter().map(|p| [p.0, 0.0]);
        let above = raw.iter().map(|p| [p.0, p.1]);
        let vertices: Vec<_> = below.chain(above).collect();
        let triangles: Vec<_> =
            (0..n - 1).flat_map(|i| [[i, i + 1, n + i + 1], [i, n + i + 1, n + i]]).collect();
        let mut m = mesh(&vertices, &triangles);
        let area = |m: &TriMesh| -> f64 {
            m.triangles.iter().map(|t| {
                let [a, b, c] = t.map(|v| m.vertices[v.index()]);
                (b - a).perp_dot(c - a)
            }).sum()
        };
        let before = area(&m);
        let report = restore_delaunay(&mut m, wide(), |_| false).unwrap();
        prop_assert!(is_delaunay(&m, wide()));
        prop_assert!((area(&m) - before).abs() < 1e-12);
        prop_assert_eq!(restore_delaunay(&mut m, wide(), |_| false).unwrap(), FlipReport::default());
        prop_assert!(report.flips >= report.found || report.found == 0 || report.flips > 0);
    }
}

/// Hexagons cut into kites from their centres, the kites along their axes.
///
/// Four right angles of kites meet at the midpoint of each edge. They sum to
/// 360 degrees whatever moves, so on average the two right angles of a kite
/// sum to 180: none of these hypotenuses can get slack but from the boundary.
fn kite_tiling(n: i32, turn: f64, at: DVec2) -> TriMesh {
    let (sin, cos) = libm::sincos(turn);
    let mut mesh = TriMesh::default();
    let mut ids = std::collections::BTreeMap::new();
    let mut vertex = |mesh: &mut TriMesh, p: DVec2| {
        let key = [(p.x * 1e6).round() as i64, (p.y * 1e6).round() as i64];
        *ids.entry(key).or_insert_with(|| {
            mesh.vertices.push(DVec2::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y) + at);
            VertexId::new(mesh.vertices.len() - 1)
        })
    };
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let (i, j) = (f64::from(i), f64::from(j));
        let center = DVec2::new(2.0 * i + j, 3f64.sqrt() * j);
        // Midpoints of edges and corners of the hexagon by turns.
        let rim = |k: i32| {
            let (sin, cos) = libm::sincos(f64::from(k % 12) * std::f64::consts::FRAC_PI_6);
            center + DVec2::new(cos, sin) * if k % 2 == 0 { 1.0 } else { 2.0 / 3f64.sqrt() }
        };
        for k in 0..12 {
            let triangle = [center, rim(k), rim(k + 1)].map(|p| vertex(&mut mesh, p));
            mesh.triangles.push(triangle);
        }
    }
    mesh
}

#[test]
fn one_stuck_edge_leaves_the_others_to_be_repaired() {
    let spoilt = |all: &mut dyn Iterator<Item = f64>| {
        let is_stuck =
            |m: &TriMesh| restore_delaunay(&mut m.clone(), AngleBounds::EXTENDED, |_| false).is_err();
        all.map(kite).find(is_stuck).unwrap()
    };
    let mut m = spoilt(&mut (0..100).map(|i| f64::from(i) * 0.1));
    let second = spoilt(&mut (100..200).map(|i| f64::from(i) * 0.1));
    let first = m.vertices.len();
    m.vertices.extend(second.vertices.iter().map(|v| v + DVec2::new(100.0, 0.0)));
    let moved = |t: &[VertexId; 3]| t.map(|v| VertexId::new(first + v.index()));
    m.triangles.extend(second.triangles.iter().map(moved));
    let result = restore_delaunay(&mut m, AngleBounds::EXTENDED, |v| v.index() >= first);
    let Err(DelaunayError::Stuck { edge, .. }) = result else { panic!("{result:?}") };
    assert!(edge.iter().all(|v| v.index() < first));
    let ids = |t: &[VertexId; 3]| t.map(|v| VertexId::new(v.index() - first));
    let triangles = m.triangles.iter().filter(|t| t[0].index() >= first).map(ids).collect();
    let second = TriMesh { vertices: m.vertices.split_off(first), triangles };
    assert!(is_delaunay(&second, AngleBounds::EXTENDED));
}

#[test]
fn interlocking_kites_end_in_an_error() {
    let bounds = AngleBounds::new(30.0, 90.0).unwrap();
    for turn in 0..4 {
        let mut m = kite_tiling(12, f64::from(turn) * 0.7, DVec2::new(3.3, -7.1) * f64::from(turn));
        let before = m.clone();
        let result = restore_delaunay(&mut m, bounds, |v| v.index() % 7 != 0);
        assert!(matches!(result, Err(DelaunayError::Stuck { .. })), "{result:?}");
        assert_eq!(m.triangles, before.triangles);
        for (v, (p, q)) in m.vertices.iter().zip(&before.vertices).enumerate() {
            assert!(p == q || (v % 7 != 0 && p.distance(*q) < 1e-10));
        }
        // The same tiling is no obstacle where the bounds permit to flip.
        let report = restore_delaunay(&mut m, wide(), |_| false).unwrap();
        assert!(report.flips >= report.found);
    }
}
