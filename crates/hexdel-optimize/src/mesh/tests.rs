//! Any sequence of changes leaves a manifold, and can be taken back.

use super::{Around, Mesh, Motion, Vertices};
use crate::refill::{MAX_CORNERS, Refills};
use hexdel_geom::DVec2;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Squares of a grid of `n` by `n` vertices, each cut in two; its sides slide.
fn grid(n: u32) -> Mesh {
    let place = |i: u32| (i % n, i / n);
    let all = || 0..n * n;
    let sides = |i: u32| {
        let (x, y) = place(i);
        (x == 0 || x == n - 1, y == 0 || y == n - 1)
    };
    let motion = |i| match sides(i) {
        (true, true) => Motion::Fixed,
        (true, false) => Motion::Along(DVec2::Y),
        (false, true) => Motion::Along(DVec2::X),
        (false, false) => Motion::Free,
    };
    let sector = |i| match sides(i) {
        (true, true) => FRAC_PI_2,
        (false, false) => TAU,
        _ => PI,
    };
    let vertices = Vertices {
        pos: all().map(|i| DVec2::new(f64::from(place(i).0), f64::from(place(i).1))).collect(),
        motion: all().map(motion).collect(),
        sector: all().map(sector).collect(),
        outside: vec![0; (n * n) as usize],
        around: Around::default(),
    };
    let corners = all().filter(|&i| place(i).0 < n - 1 && place(i).1 < n - 1);
    let tris: Vec<[u32; 3]> = corners.flat_map(|i| [[i, i + 1, i + n + 1], [i, i + n + 1, i + n]]).collect();
    Mesh::build(vertices, &tris, &vec![0; tris.len()]).expect("a grid is a manifold")
}

/// One change, where it is possible.
fn change(mesh: &mut Mesh, refills: &Refills, kind: u8, at: usize, which: usize) {
    let live: Vec<u32> = mesh.live().collect();
    let (t, k) = (live[at % live.len()], which % 3);
    match kind % 4 {
        0 => {
            mesh.flip(t, k);
        }
        1 => {
            mesh.split_edge(t, k, &mut Vec::new());
        }
        2 => {
            let v = mesh.tri[t as usize].v[k];
            mesh.set_pos(v, mesh.pos[v as usize] + DVec2::new(0.1, -0.2));
        }
        _ => {
            let v = mesh.tri[t as usize].v[k];
            let (mut tris, mut ring, mut new) = (Vec::new(), Vec::new(), Vec::new());
            let closed = mesh.ring(v, &mut tris, &mut ring);
            let fits = (3..=MAX_CORNERS).contains(&ring.len())
                && closed == (mesh.motion[v as usize] == Motion::Free);
            if fits
                && !mesh.is_fixed(v)
                && refills.triangles(mesh, &ring, closed, which % refills.count(ring.len()), &mut new)
            {
                mesh.replace(&tris, &new, &mut Vec::new());
            }
        }
    }
}

proptest! {
    #[test]
    fn every_change_leaves_a_manifold_and_is_undone(
        kept in prop::collection::vec((any::<u8>(), any::<usize>(), any::<usize>()), 0..30),
        undone in prop::collection::vec((any::<u8>(), any::<usize>(), any::<usize>()), 1..30),
    ) {
        let refills = Refills::new();
        let mut mesh = grid(5);
        for (kind, at, which) in kept {
            change(&mut mesh, &refills, kind, at, which);
            prop_assert_eq!(mesh.validate(), Ok(()));
            mesh.commit();
        }
        let before = mesh.clone();
        for (kind, at, which) in undone {
            change(&mut mesh, &refills, kind, at, which);
            prop_assert_eq!(mesh.validate(), Ok(()));
        }
        mesh.rollback();
        prop_assert_eq!(mesh.validate(), Ok(()));
        prop_assert!(mesh.tri == before.tri && mesh.pos == before.pos);
        prop_assert!(mesh.degree == before.degree && mesh.anchor == before.anchor);
    }
}
