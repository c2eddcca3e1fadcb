//! Every operation of the grid against a naive reference, for every sequence
//! of operations in a small world.

use hexdel_geom::DVec2;
use hexdel_grid::{Address, Direction, Grid, Hex, HexKind, Lattice, Neighbour};
use std::collections::BTreeSet;

/// The grid as plain sets, each operation written as the paper says it.
#[derive(Clone, Default, PartialEq, Debug)]
struct Naive(BTreeSet<(u8, Hex)>);

impl Naive {
    fn full(&self, level: u8, h: Hex) -> bool {
        level == 0 || {
            let (a, b) = h.parents();
            self.0.contains(&(level - 1, a)) && b.is_none_or(|b| self.0.contains(&(level - 1, b)))
        }
    }

    fn subdivide(&mut self, level: u8, h: Hex) {
        if self.0.contains(&(level, h)) {
            return;
        }
        loop {
            let missing = h.disc(1).find(|&n| !self.full(level, n));
            let Some(n) = missing else { break };
            let (a, b) = n.parents();
            self.subdivide(level - 1, a);
            if let Some(b) = b {
                self.subdivide(level - 1, b);
            }
        }
        self.0.insert((level, h));
    }

    fn balanced(&self) -> bool {
        self.0.iter().all(|&(k, h)| h.disc(1).all(|n| self.full(k, n)))
    }

    /// Merging is allowed exactly when the result is balanced again and no
    /// subdivided hexagon stops existing.
    fn merge(&mut self, level: u8, h: Hex) -> bool {
        let mut after = self.clone();
        let there = after.0.remove(&(level, h));
        let fine = there && after.balanced();
        if fine {
            *self = after;
        }
        fine
    }
}

fn world() -> Vec<Address> {
    let levels = [(0, 1), (1, 2), (2, 2)];
    levels.into_iter().flat_map(|(k, n)| Hex::ORIGIN.disc(n).map(move |h| Address::new(k, h))).collect()
}

fn grid() -> Grid {
    Grid::new(Lattice::new(DVec2::ZERO, 1.0))
}

fn assert_same(grid: &Grid, naive: &Naive) {
    let ours: BTreeSet<_> = grid.subdivided().map(|a| (a.level, a.hex)).collect();
    assert_eq!(ours, naive.0);
    assert_eq!(grid.unbalanced(), None);
    for level in 0..4 {
        for h in Hex::ORIGIN.disc(7) {
            let at = Address::new(level, h);
            assert_eq!(grid.exists(at), naive.full(level, h), "{at:?}");
            let fins = Direction::ALL
                .into_iter()
                .filter(|d| naive.0.contains(&(level, h.neighbour(*d))))
                .fold(0, |m, d| m | 1 << d.index());
            assert_eq!(grid.fins(at), fins);
            if grid.kind(at) == HexKind::Leaf {
                check_neighbours(grid, at, fins);
            }
        }
    }
}

fn check_neighbours(grid: &Grid, at: Address, fins: u8) {
    for d in Direction::ALL {
        match grid.neighbour(at, d).expect("a leaf has neighbours") {
            Neighbour::Same(n) => {
                assert_eq!(grid.neighbour(n, d.opposite()), Some(Neighbour::Same(at)));
            }
            Neighbour::Finer(n) => {
                assert_eq!(fins >> d.index() & 1, 1);
                assert_eq!(grid.kind(n), HexKind::Leaf);
                assert_eq!(grid.neighbour(n, d.opposite()), Some(Neighbour::Coarser(at)));
            }
            Neighbour::Coarser(n) => assert_eq!(grid.kind(n), HexKind::Leaf),
        }
    }
}

#[test]
fn every_pair_and_triple_of_subdivisions_matches() {
    let world = world();
    for &a in &world {
        for &b in &world {
            let (mut grid, mut naive) = (grid(), Naive::default());
            for at in [a, b] {
                grid.subdivide(at);
                naive.subdivide(at.level, at.hex);
            }
            assert_same(&grid, &naive);
        }
    }
}

#[test]
fn merges_match_after_every_pair_of_subdivisions() {
    let world = world();
    for &a in &world {
        for &b in &world {
            let (mut grid, mut naive) = (grid(), Naive::default());
            for at in [a, b] {
                grid.subdivide(at);
                naive.subdivide(at.level, at.hex);
            }
            for at in &world {
                assert_eq!(
                    grid.merge(*at).is_ok(),
                    naive.merge(at.level, at.hex),
                    "{at:?} after {a:?} {b:?}"
                );
            }
            assert_same(&grid, &naive);
        }
    }
}

#[test]
fn all_that_was_subdivided_can_be_merged_finest_first() {
    let mut grid = grid();
    grid.subdivide(Address::new(9, Hex::new(301, -77)));
    assert!(grid.subdivided().count() > 50);
    let mut all: Vec<_> = grid.subdivided().collect();
    all.sort_by(|a, b| b.cmp(a));
    for at in all {
        grid.merge(at).unwrap();
    }
    assert_eq!(grid.subdivided().count(), 0);
}

#[test]
fn points_are_found_in_the_leaf_or_semi_hexagon_that_holds_them() {
    let mut grid = grid();
    grid.subdivide(Address::new(3, Hex::new(2, 1)));
    for i in 0..40 {
        for j in 0..40 {
            let p = DVec2::new(f64::from(i) * 0.05 - 1.0, f64::from(j) * 0.05 - 1.0);
            let (level, found, kind) = grid.locate(p);
            let s = grid.lattice().spacing(level);
            let back = grid.lattice().position(Address::new(level, found.hex)) + found.offset * s;
            assert!((back - p).length() < 1e-14);
            assert!(matches!(kind, HexKind::Leaf | HexKind::Semi { .. }));
        }
    }
}

#[test]
fn addresses_reach_past_forty_five_levels() {
    let lattice = Lattice::new(DVec2::new(0.5, 0.5), 4.0);
    let mut grid = Grid::new(lattice);
    let p = DVec2::new(1e-14, 2e-14);
    let at = Address::new(46, lattice.locate(46, p).hex);
    grid.subdivide(at);
    assert!(grid.is_subdivided(at));
    assert_eq!(grid.unbalanced(), None);
    assert_eq!(grid.locate(p).0, 47);
}

#[test]
fn split_counters_count_scalings_since_the_join() {
    assert_eq!(Grid::split_counter(Address::new(3, Hex::new(1, 0))), 0);
    assert_eq!(Grid::split_counter(Address::new(3, Hex::new(4, 2))), 1);
    assert_eq!(Grid::split_counter(Address::new(3, Hex::new(0, 0))), 3);
}
