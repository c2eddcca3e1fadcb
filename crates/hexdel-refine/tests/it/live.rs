//! What a grid keeps whose points come and go.

use hexdel_classify::{Domain, KeptDual, Touched};
use hexdel_geom::{DVec2, Unwatched};
use hexdel_grid::{Address, Grid, Hex, Lattice, TileId};
use hexdel_refine::{Refiner, RuleSet};
use proptest::prelude::*;
use std::collections::BTreeMap;

fn lattice() -> Lattice {
    Lattice::new(DVec2::ZERO, 1.0)
}

fn refined(points: &[DVec2]) -> Refiner {
    let mut refiner = Refiner::new(lattice(), RuleSet::extended());
    refiner.insert(points, &Unwatched).expect("the points are far enough apart");
    refiner.begin_changes();
    refiner
}

/// What differs between grids: all but empty tiles.
fn planes(grid: &Grid) -> Vec<(u8, Hex, u64, u64, [u64; 2])> {
    let of = |level: u8| {
        let all = grid.tiles().placed(level);
        all.map(move |(first, t)| (level, first, t.subdivided, t.needed, t.marks))
    };
    let mut all: Vec<_> = (0..grid.tiles().levels() as u8).flat_map(of).collect();
    all.retain(|t| (t.2, t.3, t.4) != (0, 0, [0; 2]));
    all.sort_unstable();
    all
}

fn saved_and_restored(refiner: &Refiner, points: &[Option<DVec2>]) -> Refiner {
    let tiles = planes(refiner.grid()).into_iter().map(|t| (t.0, t.1, t.2));
    let level = |i: usize| refiner.occupant(i).level;
    let sites: Vec<_> =
        points.iter().enumerate().map(|(i, p)| (p.unwrap_or_default(), p.map(|_| level(i)))).collect();
    Refiner::restored(lattice(), RuleSet::extended(), tiles, &sites).expect("it is a legal grid")
}

/// How many hexagons are subdivided: each is worth six triangles.
fn size(refiner: &Refiner) -> usize {
    refiner.grid().subdivided().count()
}

/// A mesh by places: of each tile its vertices and triangles.
#[derive(Clone, Debug, Default, PartialEq)]
struct Copy {
    vertices: BTreeMap<(u8, TileId), (u64, Vec<DVec2>)>,
    triangles: BTreeMap<(u8, TileId), Vec<[Address; 3]>>,
}

impl Copy {
    fn follow(&mut self, dual: &mut KeptDual, refiner: &Refiner, touched: &Touched) {
        let grid = refiner.grid();
        for &at in &touched.vertices {
            let places = dual.places(at.0, at.1);
            let positions = dual.positions(grid, at, |level, id| refiner.occupants_of(level, id));
            self.vertices.remove(&at);
            if places != 0 {
                self.vertices.insert(at, (places, positions));
            }
        }
        for &at in &touched.triangles {
            let triangles = dual.triangles(grid, at);
            self.triangles.remove(&at);
            if !triangles.is_empty() {
                let named = triangles.into_iter().map(|t| t.map(|v| dual.address(grid, v)));
                self.triangles.insert(at, named.collect());
            }
        }
    }

    fn anew(refiner: &mut Refiner) -> (KeptDual, Self) {
        let (mut dual, touched) = KeptDual::new(refiner.grid_mut(), DOMAIN);
        let mut copy = Self::default();
        copy.follow(&mut dual, refiner, &touched);
        (dual, copy)
    }
}

const DOMAIN: Domain = Domain { base_level: 0, radius: 12 };

#[derive(Clone, Debug)]
enum Call {
    Insert(f64, f64),
    Near(usize, f64, f64),
    Remove(usize),
}

fn call() -> impl Strategy<Value = Call> {
    prop_oneof![
        5 => (-1.0..1.0, -1.0..1.0).prop_map(|(x, y)| Call::Insert(x, y)),
        2 => (0..100_usize, 0.0..6.3, 1.0..6.0).prop_map(|(i, a, e)| Call::Near(i, a, e)),
        4 => (0..100_usize).prop_map(Call::Remove),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn points_come_and_go(calls in prop::collection::vec(call(), 1..60)) {
        let mut refiner = refined(&[]);
        let (mut dual, mut copy) = Copy::anew(&mut refiner);
        let mut points: Vec<Option<DVec2>> = Vec::new();
        for call in &calls {
            let there: Vec<usize> = (0..points.len()).filter(|&i| points[i].is_some()).collect();
            let pick = |i: usize| there.get(i % there.len().max(1)).copied();
            let (gone, new) = match *call {
                Call::Insert(x, y) => (None, Some(DVec2::new(x, y))),
                Call::Near(i, a, e) => {
                    let at = pick(i).and_then(|i| points[i]).unwrap_or_default();
                    (None, Some(at + DVec2::from_angle(a) * 10_f64.powf(-e)))
                }
                Call::Remove(i) => (pick(i), None),
            };
            let near = |p: DVec2| points.iter().flatten().any(|q| q.distance(p) < 1e-9);
            let new = new.filter(|&p| !near(p));
            let before = planes(refiner.grid());
            refiner.exchange(gone.as_slice(), new.as_slice()).unwrap();
            prop_assert_eq!(refiner.violation(), None);
            let changes = refiner.take_changes();
            let after = planes(refiner.grid());
            refiner.revert(&changes);
            prop_assert!(planes(refiner.grid()) == before, "not reverted");
            refiner.forget_from(points.len());
            refiner.exchange(gone.as_slice(), new.as_slice()).unwrap();
            let changes = refiner.take_changes();
            let changed = refiner.differences(&changes);
            let touched = dual.update(refiner.grid_mut(), &changed);
            copy.follow(&mut dual, &refiner, &touched);
            prop_assert!(copy == Copy::anew(&mut refiner).1, "another mesh");
            prop_assert!(planes(refiner.grid()) == after, "not the same again");
            if let Some(i) = gone {
                points[i] = None;
            }
            points.extend(new.map(Some));
            let again = saved_and_restored(&refiner, &points);
            prop_assert!(planes(again.grid()) == after, "not as it was saved");
        }
        let left: Vec<DVec2> = points.iter().copied().flatten().collect();
        let once = refined(&left);
        let (one, all) = (size(&refiner) as f64, size(&once) as f64);
        prop_assert!((one - all).abs() <= 0.1 * all + 20.0, "{one} one by one, {all} at once");
    }
}

#[test]
fn points_that_go_leave_hardly_a_trace() {
    let mut x = 12_345_u64;
    let mut unit = || {
        x = x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (x >> 11) as f64 / (1_u64 << 53) as f64
    };
    let all: Vec<DVec2> = (0..600).map(|_| DVec2::new(unit(), unit())).collect();
    let mut refiner = refined(&all[..300]);
    for &point in &all[300..] {
        refiner.exchange(&[], &[point]).expect("there is room");
    }
    let near = |a: usize, b: usize| (a as f64 / b as f64 - 1.0).abs() < 0.03;
    assert!(near(size(&refiner), size(&refined(&all))));
    for i in 300..600 {
        refiner.exchange(&[i], &[]).expect("there is room");
    }
    assert!(near(size(&refiner), size(&refined(&all[..300]))));
    refiner.exchange(&(0..300).collect::<Vec<_>>(), &[]).expect("there is room");
    assert_eq!(size(&refiner), 0);
}
