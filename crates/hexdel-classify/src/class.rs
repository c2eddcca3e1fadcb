//! The classes of full hexagons (paper, section 5.1, and the table missing
//! from its Fig. 5).
//!
//! A *fin* of a hexagon is a lattice neighbour that is subdivided. The class of
//! a hexagon without an input point is read off its fins:
//!
//! ```text
//!    1 fin          2 in a row       3 in a row         anything else
//!      *                * *              * * *            *     *
//!     (h)               (h)               (h)               (h)      ...
//!                                      g   t   g'            *
//!  MovedCenter1     MovedCenter2     MovedCenter3        Subdivide
//! ```
//!
//! A hexagon without fins is `MovedCenter4` when it is the top `t` of a
//! `MovedCenter3`, the hexagon opposite to its middle fin. `g` and `g'`, before
//! and after the fins counter-clockwise, are its right and left neighbours; a
//! `MovedCenter3` around the same top beside it makes a run with it.

use hexdel_grid::{Direction, Grid, Hex, TileId, Window};

/// What a full hexagon is, as far as its fins and the input points tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Subdivided: no vertex of its own; its scaled centre stands for it.
    Subdivided,
    /// Holds an input point so near to the centre that the ring around it may stay: inside the
    /// dodecagon of [`ring_may_stay`](crate::relocate::ring_may_stay), which has the corners of
    /// the paper's half-size hexagon and is a seventh larger.
    Occupied1,
    /// Holds any other input point: the ring is shifted with it.
    Occupied2,
    /// One fin.
    MovedCenter1,
    /// Two consecutive fins.
    MovedCenter2,
    /// Three consecutive fins.
    MovedCenter3,
    /// No fins, top neighbour of at least one [`MovedCenter3`](Self::MovedCenter3).
    MovedCenter4,
    /// Fins in any other arrangement: must be subdivided.
    Subdivide,
    /// No fins, beside an [`Occupied2`](Self::Occupied2).
    MovedCenterInRing,
    /// No fins, beside an [`Occupied1`](Self::Occupied1) or two steps from an
    /// [`Occupied2`](Self::Occupied2).
    FixedCenterInRing,
    /// No fins, none of the above.
    FixedCenterRegular,
}

/// What a tile and its margin hold, as the grid stores it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct View {
    /// The subdivided hexagons.
    pub subdivided: Window,
    /// The hexagons of class [`Class::Occupied1`].
    pub occupied1: Window,
    /// The hexagons of class [`Class::Occupied2`].
    pub occupied2: Window,
}

impl View {
    /// The plane of [`Tile::marks`](hexdel_grid::Tile::marks) that holds the
    /// hexagons of class [`Class::Occupied1`]; the next one holds
    /// [`Class::Occupied2`].
    pub const OCCUPIED1: usize = 0;

    /// The plane that holds the hexagons of class [`Class::Occupied2`].
    pub const OCCUPIED2: usize = 1;

    /// Reads a tile and its margin.
    pub fn of(grid: &Grid, level: u8, id: TileId) -> Self {
        let planes =
            |t: &hexdel_grid::Tile| [t.subdivided, t.marks[Self::OCCUPIED1], t.marks[Self::OCCUPIED2]];
        let [subdivided, occupied1, occupied2] = grid.tiles().windows(level, id, planes);
        Self { subdivided, occupied1, occupied2 }
    }

    /// Whether nothing is subdivided or occupied.
    #[inline]
    pub fn is_empty(&self) -> bool {
        (self.subdivided | self.occupied1 | self.occupied2).is_empty()
    }

    /// The hexagons that hold an input point.
    #[inline]
    pub fn occupied(&self) -> Window {
        self.occupied1 | self.occupied2
    }
}

/// The classes that fins make, for a whole window.
///
/// Fins are right for the tile and a margin of three hexagons, everything about
/// tops for a margin of two.
#[derive(Clone, Debug, Default)]
pub struct Classes {
    /// The subdivided hexagons.
    pub subdivided: Window,
    /// `fins[d]`: the hexagons that are not subdivided and have a fin in
    /// direction `d`.
    pub fins: [Window; 6],
    /// Exactly one fin.
    pub moved1: Window,
    /// Exactly two fins, consecutive.
    pub moved2: Window,
    /// Exactly three fins, consecutive.
    pub moved3: Window,
    /// Any other fins.
    pub irregular: Window,
    /// `middle[d]`: the `moved3` whose middle fin lies in direction `d`.
    pub middle: [Window; 6],
    /// `under[d]`: the hexagons whose neighbour in direction `d` is a `moved3`
    /// that has them as its top.
    pub under: [Window; 6],
}

/// Hexagons by how their fins follow each other.
struct Rows {
    moved1: Window,
    moved2: Window,
    moved3: Window,
    irregular: Window,
}

impl Rows {
    #[expect(
        clippy::inline_always,
        reason = "called, it would wait for the fins to be written before it reads them"
    )]
    #[inline(always)]
    fn of(fins: &[Window; 6]) -> Self {
        let f = |d: usize| fins[d % 6];
        // starts: fins with none before them, counter-clockwise. Exactly one
        // start means that all fins are consecutive (six fins have none).
        let (mut one, mut more) = (Window::EMPTY, Window::EMPTY);
        let (mut two_in_row, mut three, mut four) = (Window::EMPTY, Window::EMPTY, Window::EMPTY);
        for d in 0..6 {
            let start = f(d + 1).without(f(d));
            more |= one & start;
            one |= start;
            let pair = f(d) & f(d + 1);
            let triple = pair & f(d + 2);
            two_in_row |= pair;
            three |= triple;
            four |= triple & f(d + 3);
        }
        let any = fins.iter().fold(Window::EMPTY, |a, b| a | *b);
        let row = one.without(more);
        let moved1 = row.without(two_in_row);
        let moved2 = (row & two_in_row).without(three);
        let moved3 = (row & three).without(four);
        let irregular = any.without(moved1 | moved2 | moved3);
        Self { moved1, moved2, moved3, irregular }
    }
}

/// For each direction the hexagons that have a fin there.
#[inline]
fn fins(subdivided: Window) -> [Window; 6] {
    let [a, b, c, d, e, f] = subdivided.each_way();
    let open = !subdivided;
    [a & open, b & open, c & open, d & open, e & open, f & open]
}

/// The hexagons of class [`Class::Subdivide`]: [`Classes::irregular`], alone.
pub fn irregular(subdivided: Window) -> Window {
    Rows::of(&fins(subdivided)).irregular
}

/// Whether fins, bit `i` for direction `i`, are in a row of at most three, or
/// none.
#[inline]
pub const fn is_regular(fins: u8) -> bool {
    // A bit for each of the 64 arrangements.
    const REGULAR: u64 = {
        let (mut set, mut d) = (1, 0);
        while d < 6 {
            let mut length = 1;
            while length <= 3 {
                let row = (1_u32 << length) - 1;
                set |= 1_u64 << ((row << d | row << d >> 6) & 63);
                length += 1;
            }
            d += 1;
        }
        set
    };
    REGULAR >> (fins & 63) & 1 == 1
}

impl Classes {
    /// Classifies all hexagons of a window by their fins.
    ///
    /// Hexagons that do not exist count as plain ones: no rule depends on
    /// them, since whatever has fins has six neighbours.
    pub fn of(subdivided: Window) -> Self {
        if subdivided.is_empty() {
            return Self::default();
        }
        let fins = fins(subdivided);
        let Rows { moved1, moved2, moved3, irregular } = Rows::of(&fins);
        let f = |d: usize| fins[d % 6];
        let (mut middle, mut under) = ([Window::EMPTY; 6], [Window::EMPTY; 6]);
        if !moved3.is_empty() {
            let of = |d: usize| moved3 & f(d + 5) & f(d) & f(d + 1);
            middle = [of(0), of(1), of(2), of(3), of(4), of(5)];
            let under_of = |d: usize| Window::at(middle[d], Direction::new(d));
            under = [under_of(0), under_of(1), under_of(2), under_of(3), under_of(4), under_of(5)];
        }
        Self { subdivided, fins, moved1, moved2, moved3, irregular, middle, under }
    }

    /// The hexagons with at least one fin.
    pub fn finned(&self) -> Window {
        self.moved1 | self.moved2 | self.moved3 | self.irregular
    }

    /// The hexagons that are the top of at least one `moved3`, whether they
    /// have fins themselves or not.
    pub fn tops(&self) -> Window {
        self.under.into_iter().fold(Window::EMPTY, |a, b| a | b)
    }

    /// The hexagons of class [`Class::MovedCenter4`].
    pub fn moved4(&self) -> Window {
        self.tops().without(self.finned() | self.subdivided)
    }

    /// The `moved3` hexagons with another of their run beside them: on the
    /// clockwise side, and on the counter-clockwise side.
    pub fn in_run(&self) -> (Window, Window) {
        if self.moved3.is_empty() {
            return (Window::EMPTY, Window::EMPTY);
        }
        let [a, b, c, d, e, f] = self.with_next();
        let moved = |set: Window, by: usize| set.moved(Direction::new(by));
        let before = moved(a, 2) | moved(b, 3) | moved(c, 4) | moved(d, 5) | moved(e, 0) | moved(f, 1);
        (before, a | b | c | d | e | f)
    }

    /// For each direction `d`, the `moved3` with their middle fin there whose
    /// run goes on on the counter-clockwise side.
    #[inline]
    pub fn with_next(&self) -> [Window; 6] {
        // Around a top at -d, the next counter-clockwise lies at d + 2.
        let of = |d: usize| self.middle[d] & self.middle[(d + 1) % 6].at(Direction::new(d + 2));
        [of(0), of(1), of(2), of(3), of(4), of(5)]
    }

    /// The fins of one hexagon, bit `i` for direction `i`.
    #[inline]
    pub fn fins_of(&self, at: Hex) -> u8 {
        mask(&self.fins, at)
    }

    /// The directions in which a hexagon has a `moved3` that it is the top of.
    #[inline]
    pub fn under_of(&self, at: Hex) -> u8 {
        mask(&self.under, at)
    }

    /// The class of one hexagon by its fins alone: never occupied or in a ring.
    pub fn class_of(&self, at: Hex) -> Class {
        let in_set = [
            (self.subdivided, Class::Subdivided),
            (self.moved1, Class::MovedCenter1),
            (self.moved2, Class::MovedCenter2),
            (self.moved3, Class::MovedCenter3),
            (self.irregular, Class::Subdivide),
            (self.moved4(), Class::MovedCenter4),
        ];
        in_set.into_iter().find(|(set, _)| set.contains(at)).map_or(Class::FixedCenterRegular, |(_, c)| c)
    }
}

#[inline]
fn mask(sets: &[Window; 6], at: Hex) -> u8 {
    (0..6).fold(0, |m, d| m | u8::from(sets[d].contains(at)) << d)
}

/// The direction of the middle fin of the hexagon at `at`, up to two hexagons
/// beyond the tile; `None` if it is no [`Class::MovedCenter3`].
#[inline]
pub fn middle_fin(subdivided: Window, at: Hex) -> Option<Direction> {
    match single_run(subdivided.ring_of(at)) {
        Some((first, 3)) if !subdivided.contains(at) => Some(first.turned(1)),
        _ => None,
    }
}

/// Whether a hexagon, up to two beyond the tile, is a
/// [`Class::MovedCenter3`] with its middle fin in direction `d`.
#[inline]
pub fn has_middle_fin(subdivided: Window, at: Hex, d: Direction) -> bool {
    // Three in a row, the middle one in direction `d`: of two such rounds, six.
    let fins = (0b1000_1110_0011 >> (6 - d.index()) & 63) as u8;
    subdivided.ring_of(at) == fins && !subdivided.contains(at)
}

/// Where a cyclic run of set bits among six starts and how long it is; `None`
/// if there is none, more than one, or all six are set.
#[inline]
pub fn single_run(mask: u8) -> Option<(Direction, usize)> {
    let after_another = mask << 1 | mask >> 5;
    let starts = mask & !after_another;
    starts
        .is_power_of_two()
        .then(|| (Direction::new(starts.trailing_zeros() as usize), mask.count_ones() as usize))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The table of section 5.1 for one hexagon, from its fins as a mask.
    fn by_table(fins: u8) -> Class {
        match (single_run(fins), fins.count_ones()) {
            (_, 0) => Class::FixedCenterRegular,
            (Some(_), 1) => Class::MovedCenter1,
            (Some(_), 2) => Class::MovedCenter2,
            (Some(_), 3) => Class::MovedCenter3,
            _ => Class::Subdivide,
        }
    }

    #[test]
    fn every_arrangement_of_fins_has_the_class_of_the_table() {
        for fins in 0..64_u8 {
            for centre in [Hex::new(0, 0), Hex::new(7, 7), Hex::new(3, 5)] {
                let set: Window = Direction::ALL
                    .into_iter()
                    .filter(|d| fins >> d.index() & 1 == 1)
                    .map(|d| centre.neighbour(d))
                    .collect();
                let classes = Classes::of(set);
                assert_eq!(classes.class_of(centre), by_table(fins), "fins {fins:06b}");
                assert_eq!(classes.fins_of(centre), fins);
                assert_eq!(is_regular(fins), by_table(fins) != Class::Subdivide);
                assert_eq!(irregular(set).contains(centre), !is_regular(fins));
                let middle = Direction::ALL.into_iter().find(|d| classes.middle[d.index()].contains(centre));
                assert_eq!(middle_fin(set, centre), middle);
                for d in Direction::ALL {
                    assert_eq!(has_middle_fin(set, centre, d), middle == Some(d));
                }
            }
        }
    }

    #[test]
    fn a_blossom_is_six_in_a_run_around_a_top() {
        let centre = Hex::new(4, 4);
        let set: Window = centre.ring(2).collect();
        let classes = Classes::of(set);
        assert_eq!(classes.under_of(centre), 0b11_1111);
        assert_eq!(classes.class_of(centre), Class::MovedCenter4);
        let (before, after) = classes.in_run();
        for h in centre.neighbours() {
            assert_eq!(classes.class_of(h), Class::MovedCenter3);
            assert!(before.contains(h) && after.contains(h));
        }
    }

    #[test]
    fn neighbours_in_a_run_share_the_fin_between_them() {
        let set = Window::from_iter([(2, 4), (3, 4), (3, 3), (4, 2)].map(|(q, r)| Hex::new(q, r)));
        let classes = Classes::of(set);
        let (before, after) = classes.in_run();
        assert_eq!((before & Window::with_margin(0)).count(), (after & Window::with_margin(0)).count());
        for h in after.iter().filter(|h| Window::with_margin(2).contains(*h)) {
            let d = (0..6).find(|&d| classes.middle[d].contains(h)).unwrap();
            let next = h.neighbour(Direction::new(d + 2));
            assert!(before.contains(next));
            assert!(set.contains(h.neighbour(Direction::new(d + 1))));
            assert_eq!(h.distance(next), 1);
        }
    }
}
