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
        let mut words = [0_u64; 4];
        for (word, rows) in [(0, 4..8), (3, 0..4)] {
            let tiles = &around[word / 3 * 2];
            words[word] = quarter(tiles, rows.start);
        }
        words[1] = quarter(&around[1], 0);
        words[2] = quarter(&around[1], 4);
        Self(words)
    }

    /// The bits of the tile in the middle, bit `8 row + column`.
    #[inline]
    pub fn centre(self) -> u64 {
        let mut bits = 0;
        for row in 0..8 {
            let word = self.0[1 + row / 4];
            bits |= (word >> (16 * (row % 4) + 4) & 0xff) << (8 * row);
        }
        bits
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

    /// Whether no hexagon is in the set.
    #[inline]
    pub fn is_empty(self) -> bool {
        self.0 == [0; 4]
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

    /// The hexagons of the tile and of the `n` layers around it.
    pub fn with_margin(n: i64) -> Self {
        debug_assert!((0..=Self::MARGIN).contains(&n));
        let row = (0xffff_u64 >> (8 - 2 * n)) & 0xffff;
        let row = row << (Self::MARGIN - n) & 0xffff;
        let mut words = [0; 4];
        for r in Self::MARGIN - n..Self::MARGIN + 8 + n {
            words[r as usize / 4] |= row << (16 * (r % 4));
        }
        Self(words)
    }

    /// The 8 x 8 hexagons of the tile and margin that start at `corner`, bit
    /// `8 row + column`.
    #[inline]
    pub fn cut(self, corner: Hex) -> u64 {
        let (column, first) = ((corner.q + Self::MARGIN) as usize, (corner.r + Self::MARGIN) as usize);
        debug_assert!(column <= 8 && first <= 8);
        let mut bits = 0;
        for row in 0..8 {
            let r = first + row;
            bits |= (self.0[r / 4] >> (16 * (r % 4) + column) & 0xff) << (8 * row);
        }
        bits
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

/// Four window rows from three tiles side by side, starting at their row
/// `first`.
#[inline]
fn quarter(tiles: &[u64; 3], first: usize) -> u64 {
    let mut word = 0;
    for i in 0..4 {
        let shift = 8 * (first + i);
        let row = (tiles[0] >> shift & 0xf0) >> 4
            | (tiles[1] >> shift & 0xff) << 4
            | (tiles[2] >> shift & 0x0f) << 12;
        word |= row << (16 * i);
    }
    word
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
    fn centre_and_cut_agree() {
        let bits = 0x0123_4567_89ab_cdef;
        let w = Window::from_centre(bits);
        assert_eq!(w.centre(), bits);
        assert_eq!(w.cut(Hex::ORIGIN), bits);
        assert_eq!(w.count(), bits.count_ones());
        for at in w.iter() {
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
