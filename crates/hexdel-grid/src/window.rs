//! Sixteen by sixteen hexagons as one 256-bit word.
//!
//! A tile of the store with a margin of [`Window::MARGIN`] hexagons on each
//! side. Every question that depends on hexagons at most four steps away is
//! answered for all 64 hexagons of the tile at once by shifts and boolean
//! operations on the window.
//!
//! ```text
//!   row 15  . . . . n n n n n n n n . . . .
//!           . . . . n n n n n n n n . . . .
//!           w w w w # # # # # # # # e e e e      # the tile (rows and columns
//!           w w w w # # # # # # # # e e e e        4 to 11), q to the right,
//!           . . . . s s s s s s s s . . . .        r upwards
//!   row 0   . . . . s s s s s s s s . . . .
//! ```
//!
//! Rows are dealt to the four words of the window in turn: word `k` holds rows
//! `k`, `k + 4`, `k + 8` and `k + 12`, sixteen bits each. To look one row up is
//! then to take the next word, and no shift ever crosses from word to word.
//!
//! A shift by one hexagon drags bits over the window's edge into another row.
//! Each shift therefore makes one more layer of the margin meaningless; after
//! four, the tile itself is still right.

use crate::axial::{Direction, Hex};
use std::ops::{BitAnd, BitAndAssign, BitOr, BitOrAssign, Not};

/// A set of hexagons within a 16 x 16 window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Window([u64; 4]);

impl Window {
    /// No hexagon.
    pub const EMPTY: Self = Self([0; 4]);

    /// Every hexagon.
    pub const FULL: Self = Self([u64::MAX; 4]);

    /// Hexagons on each side of the tile: how far a question may look.
    pub const MARGIN: i64 = 4;

    /// Places a tile's bits (bit `8 row + column`) and those of its neighbours
    /// into a window. `around[row][column]` holds the 3 x 3 tiles, south-west
    /// first.
    #[inline]
    pub fn gather(around: &[[u64; 3]; 3]) -> Self {
        // Of the tiles beside, four columns are seen: both sides' in one byte
        // per row.
        const FIRST_FOUR: u64 = 0x0f0f_0f0f_0f0f_0f0f;
        let beside = |[west, _, east]: [u64; 3]| west >> 4 & FIRST_FOUR | (east & FIRST_FOUR) << 4;
        let [south, level, north] = *around;
        let sides = stacked([beside(south), beside(level), beside(north)]);
        let middle = stacked([south[1], level[1], north[1]]);
        let word = |k| {
            const LOW: u64 = 0x000f_000f_000f_000f;
            let beside = lanes(sides, k);
            lanes(middle, k) << 4 | beside & LOW | (beside & LOW << 4) << 8
        };
        Self([word(0), word(1), word(2), word(3)])
    }

    /// The bits of the tile in the middle, bit `8 row + column`.
    #[inline]
    pub fn centre(self) -> u64 {
        // Rows 4 to 7 are the second lane of each word, 8 to 11 the third.
        let rows = |k: usize| (self.0[k] >> 20 & 0xff | self.0[k] >> 4 & 0xff_0000_0000) << (8 * k);
        rows(0) | rows(1) | rows(2) | rows(3)
    }

    /// The hexagons whose neighbour in direction `d` is in this set.
    #[expect(
        clippy::inline_always,
        reason = "directions are known where it counts: then these are a few shifts"
    )]
    #[inline(always)]
    #[must_use]
    pub fn at(self, d: Direction) -> Self {
        match d.index() {
            0 => self.seen_east(),
            1 => self.seen_above(),
            2 => self.seen_above().seen_west(),
            3 => self.seen_west(),
            4 => self.seen_below(),
            _ => self.seen_below().seen_east(),
        }
    }

    /// [`at`](Self::at) for all six directions.
    #[inline]
    #[must_use]
    pub fn each_way(self) -> [Self; 6] {
        let (above, below) = (self.seen_above(), self.seen_below());
        [self.seen_east(), above, above.seen_west(), self.seen_west(), below, below.seen_east()]
    }

    /// The neighbours in direction `d` of the hexagons in this set.
    #[expect(clippy::inline_always, reason = "as above")]
    #[inline(always)]
    #[must_use]
    pub fn moved(self, d: Direction) -> Self {
        self.at(d.opposite())
    }

    /// This set and all its lattice neighbours.
    #[inline]
    #[must_use]
    pub fn dilated(self) -> Self {
        let (east, west) = (self.seen_east(), self.seen_west());
        self | east | west | (self | west).seen_above() | (self | east).seen_below()
    }

    /// The hexagons with another one of this set at most `N` steps away.
    #[must_use]
    pub fn others_within<const N: usize>(self) -> Self {
        if N == 1 {
            let [a, b, c, d, e, f] = self.each_way();
            return a | b | c | d | e | f;
        }
        // Row by row: `N` steps away in row `r` are columns -N to N - r. Of a
        // hexagon's own row, all but itself; of those above and below, with
        // the lines shifted on from row to row, outermost first.
        let (mut right, mut left) = ([self; Self::MARGIN as usize], [self; Self::MARGIN as usize]);
        for k in 1..=N {
            right[k] = right[k - 1] | right[k - 1].seen_east();
            left[k] = left[k - 1] | left[k - 1].seen_west();
        }
        let (mut above, mut below) = (Self::EMPTY, Self::EMPTY);
        for r in (1..=N).rev() {
            above = (above | right[N - r] | left[N]).seen_above();
            below = (below | left[N - r] | right[N]).seen_below();
        }
        above | below | right[N - 1].seen_east() | left[N - 1].seen_west()
    }

    /// Whether no hexagon is in the set.
    #[inline]
    pub fn is_empty(self) -> bool {
        self.0[0] | self.0[1] | self.0[2] | self.0[3] == 0
    }

    /// Whether at least two hexagons are in the set.
    #[inline]
    pub fn holds_several(self) -> bool {
        // The lowest of each word is left away; what is left, and what two
        // words have, is more than one.
        let (mut any, mut more) = (false, false);
        for word in self.0 {
            more |= word & word.wrapping_sub(1) != 0 || any && word != 0;
            any |= word != 0;
        }
        more
    }

    /// How many hexagons are in the set.
    #[inline]
    pub fn count(self) -> u32 {
        self.0.iter().map(|w| w.count_ones()).sum()
    }

    /// This set without the hexagons of `other`.
    #[inline]
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        self & !other
    }

    /// Whether the hexagon at `at`, relative to the tile's first, is in the
    /// set.
    #[inline]
    pub fn contains(self, at: Hex) -> bool {
        let i = Self::index(at);
        self.0[i / 64] >> (i % 64) & 1 == 1
    }

    /// Adds the hexagon at `at`, relative to the tile's first.
    #[inline]
    pub fn insert(&mut self, at: Hex) {
        let i = Self::index(at);
        self.0[i / 64] |= 1 << (i % 64);
    }

    /// Removes the hexagon at `at`, relative to the tile's first.
    #[inline]
    pub fn remove(&mut self, at: Hex) {
        let i = Self::index(at);
        self.0[i / 64] &= !(1 << (i % 64));
    }

    /// The members, relative to the tile's first hexagon: word by word, that is
    /// every fourth row and then the next ones, and from west to east in a row.
    #[inline]
    pub fn iter(self) -> impl Iterator<Item = Hex> {
        let Self(mut words) = self;
        let mut k = 0;
        std::iter::from_fn(move || {
            while words[k] == 0 {
                if k == 3 {
                    return None;
                }
                k += 1;
            }
            let b = i64::from(words[k].trailing_zeros());
            words[k] &= words[k] - 1;
            Some(Hex::new(b % 16 - Self::MARGIN, b / 16 * 4 + k as i64 - Self::MARGIN))
        })
    }

    /// The neighbours of the hexagon at `at` that are in the set, bit `i` for
    /// direction `i`; `at` may lie up to three hexagons beyond the tile.
    #[inline]
    pub fn ring_of(self, at: Hex) -> u8 {
        debug_assert!(Self::with_margin(3).contains(at), "{at:?} lies too near the edge");
        let (column, row) = ((at.q + Self::MARGIN) as usize, (at.r + Self::MARGIN) as usize);
        // The row's bits from one column before `at` on.
        let from = |row: usize| self.0[row % 4] >> (16 * (row / 4) + column - 1);
        let (below, level, above) = (from(row - 1), from(row), from(row + 1));
        let bits = level >> 2 & 1 | above & 2 | above << 2 & 4 | level << 3 & 8 | below << 3 & 0x10;
        (bits | below << 3 & 0x20) as u8
    }

    /// The hexagons of the tile and of the `n` layers around it.
    #[inline]
    pub const fn with_margin(n: i64) -> Self {
        debug_assert!(0 <= n && n <= Self::MARGIN);
        let row = ((1 << (8 + 2 * n)) - 1_u64) << (Self::MARGIN - n);
        let mut words = [0; 4];
        let mut r = Self::MARGIN - n;
        while r < Self::MARGIN + 8 + n {
            words[r as usize % 4] |= row << (16 * (r / 4));
            r += 1;
        }
        Self(words)
    }

    /// The hexagons of the tile with even coordinates as 4 x 4 bits, bit
    /// `4 row + column`.
    #[inline]
    pub fn even_centre(self) -> u16 {
        // Rows 4 and 8 are lanes of the first word, rows 6 and 10 of the third.
        let row = |k: usize, lane: u32| compress(self.0[k] >> (16 * lane + 4) & 0x55) as u16;
        row(0, 1) | row(2, 1) << 4 | row(0, 2) << 8 | row(2, 2) << 12
    }

    #[inline]
    fn index(at: Hex) -> usize {
        debug_assert!(
            (-4..12).contains(&at.q) && (-4..12).contains(&at.r),
            "{at:?} is outside of the window"
        );
        let (column, row) = ((at.q + Self::MARGIN) as usize, (at.r + Self::MARGIN) as usize);
        64 * (row % 4) + 16 * (row / 4) + column
    }

    /// The hexagons whose eastern neighbour is in this set.
    #[inline]
    fn seen_east(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([a >> 1, b >> 1, c >> 1, d >> 1])
    }

    /// The hexagons whose western neighbour is in this set.
    #[inline]
    fn seen_west(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([a << 1, b << 1, c << 1, d << 1])
    }

    /// Of each column, what the row above holds.
    #[inline]
    fn seen_above(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([b, c, d, a >> 16])
    }

    /// Of each column, what the row below holds.
    #[inline]
    fn seen_below(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([d << 16, a, b, c])
    }
}

/// The sixteen rows that three tiles show, south first, as two words: byte `k`
/// of the first holds row `k`, or `k + 4` from byte 4 on; the second holds the
/// rows that lie four above those.
#[inline]
const fn stacked([south, middle, north]: [u64; 3]) -> [u64; 2] {
    const LOW: u64 = 0xffff_ffff;
    [south >> 32 | middle & !LOW, middle & LOW | north << 32]
}

/// Rows `k`, `k + 4`, `k + 8` and `k + 12`, eight bits each, sixteen apart.
#[inline]
const fn lanes([even, odd]: [u64; 2], k: usize) -> u64 {
    const ROWS: u64 = 0x0000_00ff_0000_00ff;
    even >> (8 * k) & ROWS | (odd >> (8 * k) & ROWS) << 16
}

/// Bit `2 i` to bit `i`, for eight bits.
#[inline]
fn compress(x: u64) -> u64 {
    let x = (x | x >> 1) & 0x33;
    (x | x >> 2) & 0x0f
}

/// The positions of the ones of a word, ascending.
#[inline]
pub fn ones(mut word: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        (word != 0).then(|| {
            let i = word.trailing_zeros();
            word &= word - 1;
            i
        })
    })
}

macro_rules! bitwise {
    ($op:ident, $f:ident, $assign:ident, $g:ident) => {
        impl $op for Window {
            type Output = Self;
            #[inline]
            fn $f(self, o: Self) -> Self {
                let ([a, b, c, d], [e, f, g, h]) = (self.0, o.0);
                Self([a.$f(e), b.$f(f), c.$f(g), d.$f(h)])
            }
        }
        impl $assign for Window {
            #[inline]
            fn $g(&mut self, o: Self) {
                *self = self.$f(o);
            }
        }
    };
}
bitwise!(BitAnd, bitand, BitAndAssign, bitand_assign);
bitwise!(BitOr, bitor, BitOrAssign, bitor_assign);

impl Not for Window {
    type Output = Self;
    #[inline]
    fn not(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([!a, !b, !c, !d])
    }
}

impl FromIterator<Hex> for Window {
    fn from_iter<I: IntoIterator<Item = Hex>>(hexagons: I) -> Self {
        let mut set = Self::EMPTY;
        for at in hexagons {
            set.insert(at);
        }
        set
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn single(q: i64, r: i64) -> Window {
        Window::from_iter([Hex::new(q, r)])
    }

    #[test]
    fn shifts_follow_the_lattice_for_every_hexagon_of_the_tile() {
        for at in Window::with_margin(3).iter() {
            for d in Direction::ALL {
                let moved = single(at.q, at.r).moved(d);
                assert_eq!(moved.iter().collect::<Vec<_>>(), [at.neighbour(d)]);
                assert_eq!(moved.at(d), single(at.q, at.r));
            }
            let disc: Window = at.disc(1).collect();
            assert_eq!(single(at.q, at.r).dilated(), disc);
        }
    }

    #[test]
    fn others_are_found_at_every_distance() {
        for at in Window::with_margin(0).iter() {
            let set = single(at.q, at.r);
            let near = [set.others_within::<1>(), set.others_within::<2>(), set.others_within::<3>()];
            for (n, near) in (1..).zip(near) {
                let expected: Window = at.disc(n).filter(|&h| h != at).collect();
                assert_eq!(near, expected);
            }
        }
    }

    #[test]
    fn gather_places_nine_tiles() {
        for at in Window::with_margin(4).iter() {
            let (tq, tr) = (at.q.div_euclid(8) + 1, at.r.div_euclid(8) + 1);
            let bit = 8 * at.r.rem_euclid(8) + at.q.rem_euclid(8);
            let mut around = [[0; 3]; 3];
            around[tr as usize][tq as usize] = 1 << bit;
            assert_eq!(Window::gather(&around), single(at.q, at.r));
        }
        assert_eq!(Window::gather(&[[u64::MAX; 3]; 3]), Window::FULL);
    }

    #[test]
    fn rings_agree_with_neighbours() {
        let set = Window([0x0123_4567_89ab_cdef, 0xdead_beef_0bad_cafe, 0x5bd1_e995_9e37_79b9, 0x1357_9bdf]);
        for at in Window::with_margin(3).iter() {
            for d in Direction::ALL {
                assert_eq!(set.ring_of(at) >> d.index() & 1 == 1, set.contains(at.neighbour(d)));
            }
        }
    }

    #[test]
    fn several_are_more_than_one() {
        assert!(!Window::EMPTY.holds_several());
        for at in Window::FULL.iter() {
            let mut set = single(at.q, at.r);
            assert!(!set.holds_several());
            set.insert(Hex::new(at.r, 3));
            set.insert(Hex::new(-2, at.q));
            assert_eq!(set.holds_several(), set.count() > 1);
        }
    }

    #[test]
    fn the_centre_is_the_tile() {
        let bits = 0x0123_4567_89ab_cdef;
        let w = Window::gather(&[[u64::MAX; 3], [u64::MAX, bits, u64::MAX], [u64::MAX; 3]]);
        assert_eq!(w.centre(), bits);
        let inside = w & Window::with_margin(0);
        assert_eq!((inside.count(), inside.centre()), (bits.count_ones(), bits));
        for at in inside.iter() {
            assert!(bits >> (8 * at.r + at.q) & 1 == 1);
        }
    }

    #[test]
    fn margins_grow_by_layers() {
        for n in 0..=4 {
            let side = (8 + 2 * n) as u32;
            assert_eq!(Window::with_margin(n).count(), side * side);
            assert!(Window::with_margin(n).contains(Hex::new(-n, 7 + n)));
        }
    }

    #[test]
    fn even_places_are_the_scaled_centres() {
        for at in Window::FULL.iter() {
            let inside = (0..8).contains(&at.q) && (0..8).contains(&at.r);
            let even = inside && at.q % 2 == 0 && at.r % 2 == 0;
            let expected = if even { 1 << (2 * at.r + at.q / 2) } else { 0 };
            assert_eq!(single(at.q, at.r).even_centre(), expected);
        }
    }
}
