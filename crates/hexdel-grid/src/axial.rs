//! Integer addresses of hexagons.
//!
//! A hexagon is a point of a triangular lattice in axial coordinates `(q, r)`:
//! its centre lies at `s (q + r/2, r sqrt(3)/2)` for a lattice of spacing `s`.
//!
//! ```text
//!        2     1            (-1, 1)   (0, 1)
//!         \   /
//!     3 -- hex -- 0    (-1, 0)  hex   (1, 0)
//!         /   \
//!        4     5            (0, -1)   (1, -1)
//! ```

use std::ops::{Add, Neg, Sub};

/// Axial coordinates of a hexagon within its level, or the difference of two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Hex {
    /// Steps along direction 0 (east).
    pub q: i64,
    /// Steps along direction 1 (60 degrees from east).
    pub r: i64,
}

impl Hex {
    /// The lattice's origin.
    pub const ORIGIN: Self = Self::new(0, 0);

    /// The hexagon at `(q, r)`.
    #[inline]
    pub const fn new(q: i64, r: i64) -> Self {
        Self { q, r }
    }

    /// The lattice neighbour in direction `d`.
    #[inline]
    #[must_use]
    pub fn neighbour(self, d: Direction) -> Self {
        self + d.step()
    }

    /// The six lattice neighbours, counter-clockwise from east: the 1-ring.
    pub fn neighbours(self) -> impl Iterator<Item = Self> {
        Direction::ALL.into_iter().map(move |d| self.neighbour(d))
    }

    /// Number of lattice steps from the origin.
    #[inline]
    pub const fn norm(self) -> u64 {
        let s = (self.q + self.r).unsigned_abs();
        let (q, r) = (self.q.unsigned_abs(), self.r.unsigned_abs());
        let m = if q > r { q } else { r };
        if m > s { m } else { s }
    }

    /// Number of lattice steps to `other`.
    #[inline]
    pub fn distance(self, other: Self) -> u64 {
        (self - other).norm()
    }

    /// The `6 n` hexagons exactly `n` steps away, counter-clockwise; for
    /// `n = 0` the hexagon itself.
    pub fn ring(self, n: u32) -> impl Iterator<Item = Self> {
        let n = i64::from(n);
        let sides = Direction::ALL.into_iter().flat_map(move |d| {
            let (corner, along) = (d.step() * n, d.turned(2).step());
            (0..n).map(move |i| self + corner + along * i)
        });
        (n == 0).then_some(self).into_iter().chain(sides)
    }

    /// All hexagons at most `n` steps away, ring by ring.
    pub fn disc(self, n: u32) -> impl Iterator<Item = Self> {
        (0..=n).flat_map(move |i| self.ring(i))
    }

    /// The scaled centre hexagon: the same centre, one level finer.
    #[inline]
    #[must_use]
    pub const fn scaled(self) -> Self {
        Self::new(2 * self.q, 2 * self.r)
    }

    /// One level coarser: the hexagons that must be subdivided for this one to
    /// exist. A scaled centre has one parent; a joined hexagon has two, the
    /// lattice neighbours it lies in the middle of.
    ///
    /// ```
    /// use hexdel_grid::Hex;
    /// assert_eq!(Hex::new(4, 6).parents(), (Hex::new(2, 3), None));
    /// assert_eq!(Hex::new(1, 0).parents(), (Hex::new(0, 0), Some(Hex::new(1, 0))));
    /// ```
    pub const fn parents(self) -> (Self, Option<Self>) {
        let low = Self::new(self.q >> 1, self.r >> 1);
        match (self.q & 1, self.r & 1) {
            (0, 0) => (low, None),
            (1, 0) => (low, Some(Self::new(low.q + 1, low.r))),
            (0, _) => (low, Some(Self::new(low.q, low.r + 1))),
            _ => (Self::new(low.q + 1, low.r), Some(Self::new(low.q, low.r + 1))),
        }
    }
}

impl Add for Hex {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self::new(self.q + o.q, self.r + o.r)
    }
}

impl Sub for Hex {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Self::new(self.q - o.q, self.r - o.r)
    }
}

impl Neg for Hex {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::new(-self.q, -self.r)
    }
}

impl std::ops::Mul<i64> for Hex {
    type Output = Self;
    #[inline]
    fn mul(self, k: i64) -> Self {
        Self::new(self.q * k, self.r * k)
    }
}

/// One of the six lattice directions, counter-clockwise from east.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Direction(u8);

impl Direction {
    /// The six directions, counter-clockwise from east.
    pub const ALL: [Self; 6] = [Self(0), Self(1), Self(2), Self(3), Self(4), Self(5)];

    const STEPS: [Hex; 6] =
        [Hex::new(1, 0), Hex::new(0, 1), Hex::new(-1, 1), Hex::new(-1, 0), Hex::new(0, -1), Hex::new(1, -1)];

    /// The direction `60 i` degrees from east, counter-clockwise.
    #[inline]
    pub const fn new(i: usize) -> Self {
        Self((i % 6) as u8)
    }

    /// 0 to 5, counter-clockwise from east.
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// The lattice vector of one step.
    #[inline]
    pub const fn step(self) -> Hex {
        Self::STEPS[self.0 as usize]
    }

    /// Turned by `60 by` degrees counter-clockwise.
    #[inline]
    #[must_use]
    pub const fn turned(self, by: usize) -> Self {
        Self::new(self.0 as usize + by)
    }

    /// The opposite direction.
    #[inline]
    #[must_use]
    pub const fn opposite(self) -> Self {
        self.turned(3)
    }
}

/// A hexagon: its level and its place in the level's lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Address {
    /// 0 is the coarsest level; each next one halves the spacing.
    pub level: u8,
    /// The place in the level's lattice.
    pub hex: Hex,
}

impl Address {
    /// The hexagon `hex` of `level`.
    pub const fn new(level: u8, hex: Hex) -> Self {
        Self { level, hex }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_turn_counter_clockwise_and_sum_to_zero() {
        for d in Direction::ALL {
            assert_eq!(d.step() + d.opposite().step(), Hex::ORIGIN);
            assert_eq!(d.step() + d.turned(2).step(), d.turned(1).step());
        }
    }

    #[test]
    fn rings_hold_what_their_distance_says() {
        for n in 0..5 {
            let ring: Vec<_> = Hex::new(3, -2).ring(n).collect();
            assert_eq!(ring.len(), if n == 0 { 1 } else { 6 * n as usize });
            assert!(ring.iter().all(|h| h.distance(Hex::new(3, -2)) == u64::from(n)));
            let distinct: std::collections::BTreeSet<_> = ring.iter().collect();
            assert_eq!(distinct.len(), ring.len());
        }
    }

    #[test]
    fn parents_are_the_neighbours_a_hexagon_lies_between() {
        for h in Hex::ORIGIN.disc(6) {
            match h.parents() {
                (a, None) => assert_eq!(a.scaled(), h),
                (a, Some(b)) => {
                    assert_eq!(a.distance(b), 1);
                    assert_eq!(a + b, h);
                }
            }
        }
    }
}
