//! Sixteen by sixteen hexagons as one 256-bit word.
//!
//! A tile of the store with a margin of [`Window::MARGIN`] hexagons on each
//! side. Every question that depends on hexagons at most four steps away is
//! answered for all 64 hexagons of the tile at once by shifts and boolean
//! operations on the window.
//!
//! ```text
//!   row 15  . . . . n n n n n n n n . . . .      bit 16 * row + column
//!           . . . . n n n n n n n n . . . .
//!           w w w w # # # # # # # # e e e e      # the tile (rows and columns
//!           w w w w # # # # # # # # e e e e        4 to 11), q to the right,
//!           . . . . s s s s s s s s . . . .        r upwards
//!   row 0   . . . . s s s s s s s s . . . .
//! ```
//!
//! A shift by one hexagon drags bits over the window's edge into the next row.
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
        let [south, middle, north] = around;
        Self([
            quarter(south.map(|tile| tile >> 32)),
            quarter(*middle),
            quarter(middle.map(|tile| tile >> 32)),
            quarter(*north),
        ])
    }

    /// The bits of the tile in the middle, bit `8 row + column`.
    #[inline]
    pub fn centre(self) -> u64 {
        gather_rows(self.0[1] >> 4) | gather_rows(self.0[2] >> 4) << 32
    }

    /// The window whose tile in the middle holds `bits` and all else nothing.
    #[inline]
    pub fn from_centre(bits: u64) -> Self {
        let none = [0; 3];
        Self::gather(&[none, [0, bits, 0], none])
    }

    /// The hexagons whose neighbour in direction `d` is in this set.
    #[inline]
    #[must_use]
    pub fn at(self, d: Direction) -> Self {
        match d.index() {
            0 => self.down::<1>(),
            1 => self.down::<16>(),
            2 => self.down::<15>(),
            3 => self.up::<1>(),
            4 => self.up::<16>(),
            _ => self.up::<15>(),
        }
    }

    /// The neighbours in direction `d` of the hexagons in this set.
    #[inline]
    #[must_use]
    pub fn moved(self, d: Direction) -> Self {
        self.at(d.opposite())
    }

    /// This set and all its lattice neighbours.
    #[inline]
    #[must_use]
    pub fn dilated(self) -> Self {
        let east = self | self.down::<1>();
        let west = self | self.up::<1>();
        east | west | east.down::<15>() | west.up::<15>()
    }

    /// The hexagons with another one of this set at most `n` steps away.
    #[must_use]
    pub fn others_within(self, n: usize) -> Self {
        let [east, up, west, down] = [0, 1, 3, 4].map(Direction::new);
        // Row by row: `n` steps away in row `r` are columns -n to n - r. Of a
        // hexagon's own row, all but itself; of those above and below, with
        // the lines shifted on from row to row, outermost first.
        let (mut right, mut left) = ([self; Self::MARGIN as usize], [self; Self::MARGIN as usize]);
        for k in 1..=n {
            right[k] = right[k - 1] | right[k - 1].at(east);
            left[k] = left[k - 1] | left[k - 1].at(west);
        }
        let (mut above, mut below) = (Self::EMPTY, Self::EMPTY);
        for r in (1..=n).rev() {
            above = (above | right[n - r] | left[n]).at(up);
            below = (below | left[n - r] | right[n]).at(down);
        }
        above | below | right[n - 1].at(east) | left[n - 1].at(west)
    }

    /// Whether no hexagon is in the set.
    #[inline]
    pub fn is_empty(self) -> bool {
        self.0[0] | self.0[1] | self.0[2] | self.0[3] == 0
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

    /// The members, row by row, relative to the tile's first hexagon.
    pub fn iter(self) -> impl Iterator<Item = Hex> {
        let base = Hex::new(-Self::MARGIN, -Self::MARGIN);
        self.0.into_iter().enumerate().flat_map(move |(w, word)| {
            ones(word).map(move |b| base + Hex::new(i64::from(b % 16), w as i64 * 4 + i64::from(b / 16)))
        })
    }

    /// The neighbours of the hexagon at `at` that are in the set, bit `i` for
    /// direction `i`; `at` may lie up to three hexagons beyond the tile.
    #[inline]
    pub fn ring_of(self, at: Hex) -> u8 {
        debug_assert!(Self::with_margin(3).contains(at), "{at:?} lies too near the edge");
        let (column, row) = ((at.q + Self::MARGIN) as usize, (at.r + Self::MARGIN) as usize);
        // The row's bits from one column before `at` on.
        let from = |row: usize| self.0[row / 4] >> (16 * (row % 4) + column - 1);
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
            words[r as usize / 4] |= row << (16 * (r % 4));
            r += 1;
        }
        Self(words)
    }

    /// The 8 x 8 hexagons of the tile and margin that start at `corner`, bit
    /// `8 row + column`.
    #[inline]
    pub fn cut(self, corner: Hex) -> u64 {
        let (column, first) = ((corner.q + Self::MARGIN) as usize, (corner.r + Self::MARGIN) as usize);
        debug_assert!(column <= 8 && first <= 8);
        let rows = |from: usize| {
            let (word, shift) = (from / 4, 16 * (from % 4));
            let next = self.0.get(word + 1).map_or(0, |next| next << 1 << (63 - shift));
            gather_rows((self.0[word] >> shift | next) >> column)
        };
        rows(first) | rows(first + 4) << 32
    }

    /// Spreads 8 x 8 hexagons to their scaled centres one level finer: the
    /// whole window, `(column, row)` of `bits` at `(2 column, 2 row)`.
    #[inline]
    pub fn scaled(bits: u64) -> Self {
        let mut words = [0; 4];
        for (i, word) in words.iter_mut().enumerate() {
            let pair = bits >> (16 * i);
            *word = spread(pair & 0xff) | spread(pair >> 8 & 0xff) << 32;
        }
        Self(words)
    }

    /// The inverse of [`scaled`](Self::scaled) for the tile: its hexagons with
    /// even coordinates as 4 x 4 bits, bit `4 row + column`.
    #[inline]
    pub fn even_centre(self) -> u16 {
        let mut bits = 0;
        for row in 0..4 {
            let word = self.0[1 + row / 2];
            bits |= (compress(word >> (32 * (row % 2) + 4) & 0x55) as u16) << (4 * row);
        }
        bits
    }

    #[inline]
    fn index(at: Hex) -> usize {
        debug_assert!(
            (-4..12).contains(&at.q) && (-4..12).contains(&at.r),
            "{at:?} is outside of the window"
        );
        ((at.r + Self::MARGIN) * 16 + at.q + Self::MARGIN) as usize
    }

    #[inline]
    fn down<const N: u32>(self) -> Self {
        let [a, b, c, d] = self.0;
        let m = 64 - N;
        Self([a >> N | b << m, b >> N | c << m, c >> N | d << m, d >> N])
    }

    #[inline]
    fn up<const N: u32>(self) -> Self {
        let [a, b, c, d] = self.0;
        let m = 64 - N;
        Self([a << N, b << N | a >> m, c << N | b >> m, d << N | c >> m])
    }
}

/// Four window rows from the lower four rows of three tiles side by side.
#[inline]
const fn quarter(tiles: [u64; 3]) -> u64 {
    const FOUR: u64 = 0x000f_000f_000f_000f;
    let [west, middle, east] = [spread_rows(tiles[0]), spread_rows(tiles[1]), spread_rows(tiles[2])];
    west >> 4 & FOUR | middle << 4 | (east & FOUR) << 12
}

/// The lower four bytes of a word, each to the low byte of sixteen bits.
#[inline]
const fn spread_rows(tile: u64) -> u64 {
    let x = tile & 0xffff_ffff;
    let x = (x | x << 16) & 0x0000_ffff_0000_ffff;
    (x | x << 8) & 0x00ff_00ff_00ff_00ff
}

/// The inverse of [`spread_rows`].
#[inline]
const fn gather_rows(window: u64) -> u64 {
    let x = window & 0x00ff_00ff_00ff_00ff;
    let x = (x | x >> 8) & 0x0000_ffff_0000_ffff;
    (x | x >> 16) & 0xffff_ffff
}

/// Bit `i` of eight to bit `2 i`.
#[inline]
fn spread(x: u64) -> u64 {
    let x = (x | x << 4) & 0x0f0f;
    let x = (x | x << 2) & 0x3333;
    (x | x << 1) & 0x5555
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
                Self(std::array::from_fn(|i| self.0[i].$f(o.0[i])))
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
        Self(self.0.map(|w| !w))
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
            for n in 1..=3 {
                let near = single(at.q, at.r).others_within(n as usize);
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
    fn centre_and_cut_agree() {
        let bits = 0x0123_4567_89ab_cdef;
        let w = Window::from_centre(bits);
        assert_eq!(w.centre(), bits);
        assert_eq!(w.cut(Hex::ORIGIN), bits);
        assert_eq!(w.count(), bits.count_ones());
        for at in w.iter() {
            assert!(bits >> (8 * at.r + at.q) & 1 == 1);
        }
        for corner in Window::with_margin(4).iter().filter(|c| c.q <= 4 && c.r <= 4) {
            for at in Window::with_margin(0).iter() {
                let bit = Window::FULL.without(w).cut(corner) >> (8 * at.r + at.q) & 1 == 1;
                assert_eq!(bit, !w.contains(corner + at));
            }
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
    fn scaling_doubles_addresses() {
        for bit in 0..64 {
            let w = Window::scaled(1 << bit);
            let at = Hex::new(2 * (bit % 8) - 4, 2 * (bit / 8) - 4);
            assert_eq!(w.iter().collect::<Vec<_>>(), [at]);
            let inner = (0..8).contains(&at.q) && (0..8).contains(&at.r);
            let expected = if inner { 1 << (2 * at.r + at.q / 2) } else { 0 };
            assert_eq!(w.even_centre(), expected);
        }
    }
}
