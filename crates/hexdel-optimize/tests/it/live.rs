//! A live mesh of one hexagon: what comes and goes leaves little behind.

use hexdel_geom::{AngleBounds, CertifyOptions, DVec2, TriMesh, VertexId, certify};
use hexdel_optimize::kinds_of;
use hexdel_optimize::live::LiveMesh;

fn hexagon() -> LiveMesh {
    let h = 0.5 * 3_f64.sqrt();
    let corners = [(1.0, 0.0), (0.5, h), (-0.5, h), (-1.0, 0.0), (-0.5, -h), (0.5, -h), (0.0, 0.0)];
    let triangles = (0..6).map(|i| [6, i, (i + 1) % 6].map(VertexId::new)).collect();
    let mesh = TriMesh { vertices: corners.map(DVec2::from).to_vec(), triangles };
    let kinds = kinds_of(&mesh, |_| false);
    LiveMesh::new(mesh, &kinds, AngleBounds::EXTENDED).unwrap()
}

fn check(live: &LiveMesh) {
    assert!(certify(&live.snapshot().mesh, &CertifyOptions::default()).holds());
}

#[test]
fn what_was_fine_at_a_side_goes_too() {
    let h = 0.5 * 3_f64.sqrt();
    for distance in [1e-1, 1e-2, 1e-3, 1e-5] {
        for x in [-0.3, 0.0, 0.21] {
            let mut live = hexagon();
            let slot = live.insert(DVec2::new(x, h - distance)).unwrap();
            let fine = live.counts()[1];
            live.release(slot).unwrap();
            check(&live);
            let left = live.counts()[1];
            assert!(left <= 45, "{distance} at {x}: {fine} triangles with it, {left} without");
        }
    }
}

#[test]
fn what_was_fine_for_one_vertex_goes_with_it() {
    let h = 0.5 * 3_f64.sqrt();
    for (p, most) in [((0.31, 0.22), 30), ((-0.1, -0.4), 30), ((0.2, h), 30)] {
        let mut live = hexagon();
        let slot = live.insert(p.into()).unwrap();
        check(&live);
        let fine = live.counts()[1];
        live.release(slot).unwrap();
        check(&live);
        let left = live.counts()[1];
        assert!(left <= most, "{p:?}: {fine} triangles with it, {left} without");
    }
}
