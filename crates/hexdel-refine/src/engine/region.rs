//! Why closing a level ends, whatever the rules' answers are.
//!
//! Closing only adds hexagons, so it ends if it stays in a bounded region. Mostly it stays
//! within the smallest lattice hexagon around what the level began with, its *hull*, or a row
//! or two beyond; that it always does is not known. Therefore a demand for a hexagon more
//! than [`ROWS_BEYOND`] rows beyond is not met. Instead the hull of all that hangs together
//! near it is subdivided as a whole, after which the rules have nothing to ask for there:
//! around a subdivided lattice hexagon all fronts are straight. Every such step adds hexagons
//! of a bounded region, so there are finitely many.
//!
//! `docs/proof.md` has the argument in full. It needs rules that ask for nothing around a
//! single lattice hexagon; sets for which that is not so end in
//! [`RefineError::Unbounded`].

use super::{RefineError, Refiner};
use hexdel_grid::grid::hex_of;
use hexdel_grid::tiles::SIDE;
use hexdel_grid::window::ones;
use hexdel_grid::{Address, Hex, TileId};
use std::collections::BTreeSet;

/// Rows beyond the hull of what a level began with in which hexagons are subdivided when they
/// are asked for. Two is the most that was ever seen; more costs nothing.
pub(super) const ROWS_BEYOND: i64 = 8;

/// A lattice hexagon: bounds on `q`, `r` and `q + r`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Hull {
    low: [i64; 3],
    high: [i64; 3],
}

impl Hull {
    fn of(hex: Hex) -> Self {
        let axes = [hex.q, hex.r, hex.q + hex.r];
        Self { low: axes, high: axes }
    }

    /// The hull of a whole tile.
    pub(super) fn of_tile(first: Hex) -> Self {
        Self::of(first).with(Self::of(first + Hex::new(SIDE - 1, SIDE - 1)))
    }

    /// The hull of two.
    fn with(self, other: Self) -> Self {
        let each = |i: usize| (self.low[i].min(other.low[i]), self.high[i].max(other.high[i]));
        Self { low: [0, 1, 2].map(|i| each(i).0), high: [0, 1, 2].map(|i| each(i).1) }
    }

    fn grown(self, rows: i64) -> Self {
        Self { low: self.low.map(|x| x - rows), high: self.high.map(|x| x + rows) }
    }

    fn contains(&self, hex: Hex) -> bool {
        self.holds(Self::of(hex))
    }

    /// Whether it contains all of another.
    fn holds(&self, other: Self) -> bool {
        (0..3).all(|i| self.low[i] <= other.low[i] && other.high[i] <= self.high[i])
    }

    /// The first hexagons of all tiles that it meets, row by row, and its hexagons in each.
    fn tiles(self) -> impl Iterator<Item = (Hex, u64)> {
        let tile = |x: i64| x.div_euclid(SIDE);
        let columns = tile(self.low[0])..=tile(self.high[0]);
        let rows = tile(self.low[1])..=tile(self.high[1]);
        let all = rows.flat_map(move |r| columns.clone().map(move |q| Hex::new(SIDE * q, SIDE * r)));
        let inside = move |first: Hex| (0..64).filter(move |&bit| self.contains(first + hex_of(bit)));
        all.map(move |first| (first, inside(first).map(|bit| 1 << bit).sum())).filter(|(_, bits)| *bits != 0)
    }
}

impl Refiner {
    /// Notes that a level has something in a tile that no rule of the level asked for.
    pub(super) fn begin_in(&mut self, level: u8, id: TileId) {
        let hull = Hull::of_tile(self.grid.tiles().first(level, id));
        let k = usize::from(level);
        self.began.resize(self.began.len().max(k + 1), None);
        self.began[k] = Some(self.began[k].map_or(hull, |old| old.with(hull)));
    }

    /// Subdivides what the rules ask for in one round of closing a level, tile by tile; for
    /// hexagons that lie too far out, all within the hull of what hangs together there.
    pub(super) fn subdivide_asked(
        &mut self,
        level: u8,
        asked: Vec<(TileId, u64)>,
    ) -> Result<(), RefineError> {
        let k = usize::from(level);
        if self.began.get(k).is_none_or(Option::is_none) {
            debug_assert!(asked.is_empty(), "a level that is closed began with something");
            for &(id, _) in &asked {
                self.begin_in(level, id);
            }
        }
        let Some(began) = self.began.get(k).copied().flatten() else { return Ok(()) };
        let allowed = began.grown(self.rows_beyond);
        let (mut any, mut refused) = (false, None);
        for (id, bits) in asked {
            let first = self.grid.tiles().first(level, id);
            let mut inside = bits;
            // Mostly the whole tile is allowed.
            let rest = if allowed.holds(Hull::of_tile(first)) { 0 } else { bits };
            for bit in ones(rest).filter(|&bit| !allowed.contains(first + hex_of(bit))) {
                inside &= !(1 << bit);
                refused = refused.or(Some(Address::new(level, first + hex_of(bit))));
            }
            any |= self.subdivide_in(level, id, inside);
            if inside != bits {
                any |= self.fill_around(level, id);
                // What was not met is asked for again, if it still is.
                self.waiting[k].push(id.index(), [true, true, true]);
            }
        }
        // Nothing has changed, so the same would be asked for again.
        refused.filter(|_| !any).map_or(Ok(()), |at| Err(RefineError::Unbounded { at }))
    }

    /// Subdivides the hull of all subdivided hexagons of a level in tiles that hang together
    /// with one; returns whether there was anything to subdivide.
    fn fill_around(&mut self, level: u8, id: TileId) -> bool {
        let (mut seen, mut next) = (BTreeSet::from([id]), vec![id]);
        let mut hull: Option<Hull> = None;
        while let Some(tile) = next.pop() {
            let (first, bits) =
                (self.grid.tiles().first(level, tile), self.grid.tiles().get(level, tile).subdivided);
            for hex in ones(bits).map(|bit| Hull::of(first + hex_of(bit))) {
                hull = Some(hull.map_or(hex, |hull| hull.with(hex)));
            }
            if bits != 0 || tile == id {
                next.extend(self.grid.tiles().around(level, tile).filter(|&beside| seen.insert(beside)));
            }
        }
        let mut any = false;
        for (first, bits) in hull.into_iter().flat_map(Hull::tiles) {
            let (tile, _) = self.grid.tiles_mut().require(level, first);
            any |= self.subdivide_in(level, tile, bits);
        }
        any
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rule::{Rule, RuleSet, Situation};
    use hexdel_geom::{DVec2, Unwatched};
    use hexdel_grid::{Lattice, Window};

    const LEVEL: u8 = 7;

    fn refiner(rules: RuleSet) -> Refiner {
        Refiner::new(Lattice::new(DVec2::ZERO, 1.0), rules).with_coarsening(false)
    }

    #[test]
    fn a_hull_is_the_smallest_lattice_hexagon() {
        let line = Hull::of(Hex::new(-3, 5)).with(Hull::of(Hex::new(6, 5)));
        let count = |hull: Hull| hull.tiles().map(|(_, bits)| bits.count_ones()).sum::<u32>();
        assert_eq!(count(line), 10);
        let disc = Hex::ORIGIN.disc(9).map(Hull::of).reduce(Hull::with).unwrap();
        assert_eq!(count(disc), 1 + 3 * 9 * 10);
        assert_eq!(count(disc.grown(1)), 1 + 3 * 10 * 11);
        assert!(Hex::ORIGIN.disc(9).all(|h| disc.contains(h)));
        assert!(Hex::ORIGIN.ring(10).all(|h| !disc.contains(h)));
        // A tile is held if all its hexagons are contained, and else not.
        let mut held = 0;
        for first in Hex::ORIGIN.disc(9) {
            let all = (0..64).all(|bit| disc.contains(first + hex_of(bit)));
            assert_eq!(disc.holds(Hull::of_tile(first)), all, "{first:?}");
            held += u32::from(all);
        }
        assert!(held > 0);
    }

    /// With so little room that hulls are filled again and again, every rule holds in the
    /// end.
    #[test]
    fn rules_hold_where_hulls_are_filled() {
        let (mut filled, mut random) = (0, 0x9e37_79b9_7f4a_7c15_u64);
        for i in 0..150_u64 {
            let mut pick = || {
                random ^= random << 13;
                random ^= random >> 7;
                random ^= random << 17;
                random >> 33
            };
            let share = 1 + i % 12;
            let seeds: Vec<Hex> =
                Hex::ORIGIN.disc(3 + i as u32 % 9).filter(|_| pick() % 13 < share).collect();
            let closed = |rows_beyond| {
                let mut refiner = refiner(RuleSet::extended());
                refiner.rows_beyond = rows_beyond;
                let seeds = seeds.iter().map(|&hex| Address::new(LEVEL, hex));
                refiner.subdivide_all(seeds, &Unwatched).unwrap();
                assert_eq!(refiner.violation(), None);
                refiner.grid().subdivided().filter(|at| at.level == LEVEL).count()
            };
            // Tiles are wide: as far inside of their hull demands begin to be refused.
            filled += u32::from(closed(-6) != closed(ROWS_BEYOND));
        }
        assert!(filled > 20, "{filled}");
    }

    /// Asks for the neighbours of whatever is subdivided.
    struct Spreads;

    impl Rule for Spreads {
        fn name(&self) -> &'static str {
            "spreads"
        }

        fn must_subdivide(&self, s: &Situation) -> Window {
            s.view.subdivided.dilated()
        }
    }

    #[test]
    fn a_rule_that_never_has_enough_is_an_error() {
        let mut refiner = refiner(RuleSet::new(vec![&Spreads]));
        let seed = [Address::new(LEVEL, Hex::ORIGIN)];
        let error = refiner.subdivide_all(seed, &Unwatched).unwrap_err();
        assert!(matches!(error, RefineError::Unbounded { at } if at.level == LEVEL), "{error}");
    }
}
