//! The triangles around a three-finned hexagon (paper, section 5.4).
//!
//! ```text
//!   single                         in a run, the next one counter-clockwise
//!
//!     a0---m01---a1---m12---a2        a0---m01---a1---m12---a2
//!     | \  / \   |   / \  / |         | \  / \   |   / \  / |
//!     |  P0----\-P1-/----P2 |         |  P0    \ P1 /    P2-+-- ..
//!     | / \ \______ ___/ / \|         | /  \     |     /  \ |
//!     g0   \       |    /   g2        g0----.    |    .---- C' (next)
//!       \   \      |   /   /            \     \  |  /     /
//!        `----------t-----'              `-------C--------
//!                                                t (shared)
//! ```
//!
//! `a0 a1 a2` are the scaled centres beyond the fins, `m01` and `m12` the
//! hexagons joined between them, `g0` and `g2` the right and left neighbour,
//! `t` the top. A single one loses its centre; one in a run keeps it, and the
//! point on the fin between two of a run is shared.

use crate::class::{Classes, has_middle_fin, middle_fin};
use crate::exact::Offset;
use crate::relocate::star_points;
use hexdel_grid::{Direction, Hex, Window};
use std::sync::OnceLock;

/// A `MovedCenter3` and its place in a run.
#[derive(Clone, Copy)]
pub(super) struct Star {
    /// The direction of the middle fin.
    pub(super) middle: Direction,
    /// Whether the run goes on on the clockwise side.
    pub(super) before: bool,
    /// Whether the run goes on on the counter-clockwise side.
    pub(super) after: bool,
}

impl Star {
    /// The star of the `MovedCenter3` at `at`; `None` for any other hexagon.
    pub(super) fn of(subdivided: Window, at: Hex) -> Option<Self> {
        let middle = middle_fin(subdivided, at)?;
        let goes_on =
            |turn, by| has_middle_fin(subdivided, at.neighbour(middle.turned(by)), middle.turned(turn));
        Some(Self { middle, before: goes_on(5, 4), after: goes_on(1, 2) })
    }

    pub(super) fn single(self) -> bool {
        !self.before && !self.after
    }

    /// What [`star_points`] says, looked up.
    fn points(self) -> &'static [Offset; 3] {
        static POINTS: OnceLock<[[Offset; 3]; 24]> = OnceLock::new();
        let points = POINTS.get_or_init(|| {
            std::array::from_fn(|i| star_points(Direction::new(i / 4), i & 2 != 0, i & 1 != 0))
        });
        &points[4 * self.middle.index() + 2 * usize::from(self.before) + usize::from(self.after)]
    }
}

/// For each direction, the `MovedCenter3` that insert a vertex on their fin in
/// that direction. The point that two of a run share counts for the first.
pub(super) fn fins_with_vertex(classes: &Classes) -> [Window; 6] {
    let (before, _) = classes.in_run();
    std::array::from_fn(|d| {
        let first = classes.middle[(d + 1) % 6].without(before);
        first | classes.middle[d] | classes.middle[(d + 5) % 6]
    })
}

/// How many triangles the stars of a tile have.
pub(super) fn count(classes: &Classes, (before, after): (Window, Window), exists: u64) -> u32 {
    let three = classes.moved3.centre() & exists;
    let (before, after) = (before.centre(), after.centre());
    let run = three & (before | after);
    let single = (three & !run).count_ones();
    let (first, last) = ((run & !before).count_ones(), (run & !after).count_ones());
    // Six towards the fins, always. Single: two at the ends and four inside. In
    // a run: one at each end of the run, and six around each centre, two of
    // which belong to the one before.
    12 * single + (6 + 4) * run.count_ones() + 2 * first + first + last
}

/// Where the point lies that is inserted between hexagon `hex` and its fin
/// `fin`, relative to `hex`; `None` if `hex` is no `MovedCenter3`.
pub(super) fn point_on_fin(subdivided: Window, hex: Hex, fin: Hex) -> Option<Offset> {
    let star = Star::of(subdivided, hex)?;
    let i = (0..3).find(|&i| star.middle.turned(5 + i).step() == fin - hex)?;
    Some(star.points()[i])
}

/// Where the point lies that is inserted between a subdivided hexagon and one
/// that is not, relative to the window's tile; `None` if there is none.
pub(super) fn inserted_between(subdivided: Window, a: Hex, b: Hex) -> Option<Offset> {
    let between = |(hex, fin)| Some(Offset::of(hex) + point_on_fin(subdivided, hex, fin)?);
    [(a, b), (b, a)].into_iter().find_map(between)
}

/// Ids of the vertices around a star.
pub(super) trait Corners {
    /// The leaf at `at`, relative to the tile's first hexagon.
    fn leaf(&self, at: Hex) -> u32;

    /// The vertex at `at` one level finer, relative to twice the tile's first
    /// hexagon.
    fn finer(&self, at: Hex) -> u32;
}

/// Emits the triangles of the star at `at`.
pub(super) fn emit(star: Star, at: Hex, corners: &impl Corners, mut push: impl FnMut([u32; 3])) {
    let d = |by: usize| star.middle.turned(by).step();
    let fins = [5, 0, 1].map(|by| at + d(by));
    let a = fins.map(|n| corners.finer(n.scaled()));
    let m01 = corners.finer(fins[0] + fins[1]);
    let m12 = corners.finer(fins[1] + fins[2]);
    let p = [0, 1, 2].map(|i| {
        // The first point of one that continues a run is the last of the one
        // before.
        let owner = if i == 0 && star.before { at + d(4) } else { at };
        corners.finer(owner + fins[i])
    });
    let [g0, g2, top] = [4, 2, 3].map(|by| at + d(by));
    // One by one: an array of them would be written, and read again at once.
    push([p[0], a[0], m01]);
    push([p[0], m01, p[1]]);
    push([p[1], m01, a[1]]);
    push([p[1], a[1], m12]);
    push([p[1], m12, p[2]]);
    push([p[2], m12, a[2]]);
    if !star.before {
        push([p[0], corners.leaf(g0), a[0]]);
    }
    if !star.after {
        push([p[2], a[2], corners.leaf(g2)]);
    }
    let (g0, g2, top) = (corners.leaf(g0), corners.leaf(g2), corners.leaf(top));
    if star.single() {
        push([p[0], p[1], p[2]]);
        push([p[0], p[2], top]);
        push([p[0], top, g0]);
        push([p[2], g2, top]);
        return;
    }
    let c = corners.leaf(at);
    push([c, p[0], p[1]]);
    push([c, p[1], p[2]]);
    push([c, p[2], g2]);
    push([c, g2, top]);
    if !star.before {
        push([c, top, g0]);
        push([c, g0, p[0]]);
    }
}
