//! No single operation on a mesh within the bounds leaves it, or anything but a
//! manifold of the same area.

use super::Work;
use crate::constraints::Rules;
use crate::decimate::{PASSES, try_remove};
use crate::mesh::{Around, Mesh, Motion, Vertices};
use crate::patch::Swept;
use crate::refill::Refills;
use crate::shake::shake_at;
use crate::spread::Reach;
use hexdel_geom::{AngleBounds, DVec2};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// Vertices on each side of the rhombus.
const SIDE: u32 = 9;

/// A rhombus of equilateral triangles. Its corners and the vertices of `fixed` stay,
/// those on the sides slide.
fn rhombus(fixed: &[u32]) -> Mesh {
    let across = DVec2::new(0.5, 0.75_f64.sqrt());
    let place = |i: u32| (i % SIDE, i / SIDE);
    let ends = |i: u32| {
        let (x, y) = place(i);
        (x == 0 || x == SIDE - 1, y == 0 || y == SIDE - 1)
    };
    let motion = |i: u32| match ends(i) {
        (true, true) => Motion::Fixed,
        _ if fixed.contains(&i) => Motion::Fixed,
        (true, false) => Motion::Along(across),
        (false, true) => Motion::Along(DVec2::X),
        (false, false) => Motion::Free,
    };
    let sector = |i: u32| match ends(i) {
        (true, true) if [0, SIDE * SIDE - 1].contains(&i) => PI / 3.0,
        (true, true) => 2.0 * PI / 3.0,
        (false, false) => TAU,
        _ => PI,
    };
    let all = || 0..SIDE * SIDE;
    let at = |i: u32| DVec2::X * f64::from(place(i).0) + across * f64::from(place(i).1);
    let vertices = Vertices {
        pos: all().map(at).collect(),
        motion: all().map(motion).collect(),
        sector: all().map(sector).collect(),
        outside: vec![0; (SIDE * SIDE) as usize],
        around: Around::default(),
    };
    let first = all().filter(|&i| place(i).0 < SIDE - 1 && place(i).1 < SIDE - 1);
    let tris: Vec<[u32; 3]> =
        first.flat_map(|i| [[i, i + 1, i + SIDE], [i + 1, i + SIDE + 1, i + SIDE]]).collect();
    Mesh::build(vertices, &tris, &vec![0; tris.len()]).expect("a rhombus is a manifold")
}

fn area(mesh: &Mesh) -> f64 {
    mesh.live().map(|t| mesh.measure(t).cross).sum()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn every_operation_leaves_a_valid_mesh(
        fixed in prop::collection::vec(0..SIDE * SIDE, 0..12),
        operations in prop::collection::vec((any::<bool>(), 0..SIDE * SIDE, 0..PASSES.len()), 1..60),
        seed in any::<u64>(),
    ) {
        let (rules, refills) = (Rules::new(AngleBounds::EXTENDED, None), Refills::new());
        let mesh = rhombus(&fixed);
        let (whole, failed) = (area(&mesh), vec![0; mesh.pos.len()]);
        let mut work = Work::new(mesh, &rules, &refills, failed, seed);
        for (shakes, v, pass) in operations {
            if !work.mesh.alive(v) || work.mesh.is_fixed(v) {
                continue;
            }
            let before = work.mesh.live().count();
            let removed = !shakes && try_remove(&mut work, v, PASSES[pass]);
            if shakes {
                shake_at(&mut work, v);
            }
            prop_assert_eq!(work.mesh.validate(), Ok(()));
            prop_assert!(work.bad().is_empty());
            prop_assert!((area(&work.mesh) - whole).abs() < 1e-9 * whole);
            prop_assert!(work.mesh.live().count() <= before - usize::from(removed));
        }
    }
}

/// The middle of the rhombus.
const MIDDLE: u32 = SIDE * SIDE / 2;

fn reach(rings: u8) -> Reach {
    Reach { rings, most: 60, stall: 1.0, hope: [f64::INFINITY; 4] }
}

#[test]
fn motion_spreads_as_far_as_it_may_and_can_be_taken_back() {
    let (rules, refills) = (Rules::new(AngleBounds::EXTENDED, None), Refills::new());
    for (by, rings) in [(0.3, 1), (0.6, 3)] {
        let mut mesh = rhombus(&[]);
        mesh.pos[MIDDLE as usize].x += by;
        let before = mesh.pos.clone();
        let failed = vec![0; mesh.pos.len()];
        let mut work = Work::new(mesh, &rules, &refills, failed, 1);
        assert!(!work.bad().is_empty());
        assert_eq!(work.spread(&[MIDDLE], reach(rings)), Swept::Settled);
        assert!(work.bad().is_empty() && work.changes_hold());
        let steps = |v: u32| {
            let ([x, y], [p, q]) = ([v % SIDE, v / SIDE], [MIDDLE % SIDE, MIDDLE / SIDE]);
            let (dx, dy) = (i64::from(x) - i64::from(p), i64::from(y) - i64::from(q));
            if dx * dy < 0 { dx.abs().max(dy.abs()) } else { (dx + dy).abs() }
        };
        let moved: Vec<u32> =
            (0..SIDE * SIDE).filter(|&v| work.mesh.pos[v as usize] != before[v as usize]).collect();
        assert!(!moved.is_empty() && moved.iter().all(|&v| steps(v) < i64::from(rings)), "{moved:?}");
        assert!(rings == 1 || moved.len() > 1, "one vertex alone does not settle it");
        work.mesh.rollback();
        assert_eq!(work.mesh.pos, before);
    }
}

#[test]
fn motion_moves_nothing_that_must_stay() {
    let (rules, refills) = (Rules::new(AngleBounds::EXTENDED, None), Refills::new());
    let all: Vec<u32> = (0..SIDE * SIDE).collect();
    let mut mesh = rhombus(&all);
    mesh.pos[MIDDLE as usize].x += 0.3;
    let before = mesh.pos.clone();
    let failed = vec![0; mesh.pos.len()];
    let mut work = Work::new(mesh, &rules, &refills, failed, 1);
    assert_eq!(work.spread(&[MIDDLE], reach(3)), Swept::Settled, "no triangle has a vertex that moves");
    assert!(!work.bad().is_empty(), "what is bad stays bad");
    assert_eq!(work.mesh.pos, before);
}
