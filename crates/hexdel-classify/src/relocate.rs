//! The templates: where the vertex of a hexagon goes (paper, section 5.4).
//!
//! `C` is the hexagon's centre, a lattice step has length 1 and direction `d`
//! the unit vector `d`; everything below is relative to `C`.
//!
//! ```text
//!  MovedCenter1      MovedCenter2        MovedCenter4 above a run of n
//!     a                a0  m  a1            h0 h1 h2     MovedCenter3 with
//!     |                  \ | /                \|/        middle fins outwards
//!     C                    C                   C
//!  C + (a-C)/6      C + 2/5 (m-C)       n = 1: C + 2/5 (h0-C)
//!                                       n = 2: 5/4 C - 1/4 mean of h0^, h1^
//!  MovedCenter3, single: C dropped,     n = 3: 7/6 C - 1/6 h1
//!  P0 P1 P2 inserted on the lines to    n = 4: 4/3 C - 1/3 mean of h1^, h2^
//!  the fins; in a run C^ is kept too:   n = 6: stays (blossom)
//!
//!      a0  a1  a2                       h^ is the relocated centre of h.
//!        P0 P1 P2
//!           C^
//!       g0  t  g2
//! ```

use crate::class::{Classes, has_middle_fin, single_run};
use crate::exact::Offset;
use hexdel_geom::DVec2;
use hexdel_grid::{Direction, Hex, Located, Window};
use std::sync::OnceLock;

/// How far a `MovedCenter1` goes towards its fin.
pub fn towards_one(fin: Direction) -> Offset {
    Offset::fraction(fin.step(), 1, 6)
}

/// How far a `MovedCenter2` with fins `fin` and the next one goes towards the
/// joined hexagon between them, which lies half a step from both.
pub fn towards_two(fin: Direction) -> Offset {
    Offset::fraction(fin.step() + fin.turned(1).step(), 2, 10)
}

/// How far a `MovedCenter3` of a run goes towards its top.
pub fn towards_top(middle: Direction) -> Offset {
    Offset::fraction(middle.opposite().step(), 1, 3)
}

/// Where a `MovedCenter4` goes that is the top of `n` consecutive
/// `MovedCenter3`, the first in direction `first`; `None` if no template has
/// this many.
///
/// The mean for `n` = 2 and 4 is that of the relocated centres, two thirds of
/// a step from the top; with the original ones the bounds do not hold.
pub fn from_run(first: Direction, n: usize) -> Option<Offset> {
    let d = |i| first.turned(i).step();
    match n {
        1 => Some(Offset::fraction(d(0), 2, 5)),
        2 => Some(-Offset::fraction(d(0) + d(1), 1, 12)),
        3 => Some(-Offset::fraction(d(1), 1, 6)),
        4 => Some(-Offset::fraction(d(1) + d(2), 1, 9)),
        6 => Some(Offset::ZERO),
        _ => None,
    }
}

/// Where the vertices that a `MovedCenter3` inserts on its three fins go,
/// counter-clockwise; `before` and `after` say whether the run goes on on the
/// clockwise and counter-clockwise side.
pub fn star_points(middle: Direction, before: bool, after: bool) -> [Offset; 3] {
    let fin = |by| middle.turned(by).step();
    if !before && !after {
        return [
            Offset::fraction(fin(5), 2, 5),
            Offset::fraction(fin(0), 3, 5),
            Offset::fraction(fin(1), 2, 5),
        ];
    }
    let top = middle.opposite().step();
    // 25/52 C^ + 27/52 a, with C^ a third of a step towards the top.
    let end = |fin| Offset::fraction(top, 25, 156) + Offset::fraction(fin, 27, 52);
    // 9/20 of the mean of both C^ and 11/20 of the fin between them: seen from
    // the top, 3/20 + 11/20 of the way to that fin.
    let shared = |fin: Hex| Offset::of(top) + Offset::fraction(fin - top, 7, 10);
    [
        if before { shared(fin(5)) } else { end(fin(5)) },
        Offset::fraction(fin(0), 2, 5),
        if after { shared(fin(1)) } else { end(fin(1)) },
    ]
}

/// Whether the point of an occupied hexagon may stay without its ring being
/// shifted: class `Occupied1` rather than `Occupied2`.
///
/// ```text
///     g2----g1        The angle at g1 between p and g0 is smallest where p
///    /  \  /  \       leans away from it. It reaches 43.89 degrees on a line
///   g3---C---g0       through g1 that cuts the axis C g0 at 2/7 of a step;
///    \  /  \  /       the twelve such lines bound a dodecagon around the
///     g4----g5        half-size hexagon, whose corners it has.
/// ```
///
/// The paper asks for the half-size hexagon itself (Fig. 8 left). Its corners
/// are where the bound is attained, but the dodecagon, which also has corners
/// at 2/7 of a step on the axes, keeps it and is a seventh larger.
pub fn ring_may_stay(point: &Located) -> bool {
    ring_norm(point) <= RING_STAYS
}

/// Up to which [`ring_norm`] the ring may stay.
pub const RING_STAYS: f64 = 2.0 / 7.0;

/// How far a point is from its hexagon's centre, in lattice steps, by the norm
/// whose balls are the dodecagon of [`ring_may_stay`].
pub fn ring_norm(point: &Located) -> f64 {
    // tan(alpha - 30 degrees) for tan(alpha) = 5 / (3 sqrt 3).
    const SLOPE: f64 = 0.247_435_829_652_696_96;
    let p = point.offset;
    Direction::ALL[..3].iter().fold(0.0, |norm: f64, d| {
        let u = Offset::of(d.step()).cartesian();
        norm.max(u.dot(p).abs() + SLOPE * u.perp_dot(p).abs())
    })
}

/// How far the ring of an `Occupied2` is shifted: half the way to the corner
/// of the occupied hexagon nearest to the input point.
///
/// Corner `i` lies at `30 + 60 i` degrees, a third of the sum of the two steps
/// beside it.
pub fn ring_shift(point: &Located) -> Offset {
    let corner = nearest_corner(point.offset);
    Offset::fraction(corner.step() + corner.turned(1).step(), 1, 6)
}

/// The corner of the unit cell nearest to a point of it, as the direction just
/// clockwise of it.
fn nearest_corner(offset: DVec2) -> Direction {
    let along = |d: &Direction| {
        let corner = Offset::fraction(d.step() + d.turned(1).step(), 1, 3).cartesian();
        corner.dot(offset)
    };
    let mut best = Direction::ALL[0];
    for d in Direction::ALL {
        if along(&d) > along(&best) {
            best = d;
        }
    }
    best
}

impl Classes {
    /// How far a hexagon's vertex moves by its fins or as a top; zero for one
    /// that stays, is subdivided, or has no template (and must be subdivided).
    ///
    /// For a single `MovedCenter3`, which has no vertex of its own, this is
    /// where it would be in a run.
    pub fn relocation(&self, at: Hex) -> Offset {
        if self.subdivided.contains(at) {
            return Offset::ZERO;
        }
        by_surroundings(self.fins_of(at), || self.under_of(at))
    }
}

/// The same as [`Classes::relocation`], from the subdivided hexagons alone;
/// cheaper for a few hexagons. `at` lies at most two hexagons beyond the tile.
#[inline]
pub fn relocation(subdivided: Window, at: Hex) -> Offset {
    if subdivided.contains(at) {
        return Offset::ZERO;
    }
    let Moves { by_fins, by_tops } = moves();
    match subdivided.ring_of(at) {
        0 => by_tops[usize::from(under(subdivided, at))],
        fins => by_fins[usize::from(fins)],
    }
}

/// The directions in which a hexagon without fins has a `MovedCenter3` that it is
/// the top of.
#[inline]
fn under(subdivided: Window, at: Hex) -> u8 {
    Direction::ALL
        .into_iter()
        .fold(0, |under, d| under | u8::from(has_middle_fin(subdivided, at.neighbour(d), d)) << d.index())
}

/// Where hexagons go: by their fins, and by those beside them that they are the
/// tops of, as sets of directions.
struct Moves {
    by_fins: [Offset; 64],
    by_tops: [Offset; 64],
}

fn moves() -> &'static Moves {
    static MOVES: OnceLock<Moves> = OnceLock::new();
    MOVES.get_or_init(|| Moves {
        by_fins: std::array::from_fn(|fins| by_surroundings(fins as u8, || 0)),
        by_tops: std::array::from_fn(|tops| by_surroundings(0, || tops as u8)),
    })
}

/// By a hexagon's fins and, if it has none, the three-finned hexagons that it
/// is the top of.
#[inline]
fn by_surroundings(fins: u8, under: impl FnOnce() -> u8) -> Offset {
    match (single_run(fins), fins) {
        (Some((d, 1)), _) => towards_one(d),
        (Some((d, 2)), _) => towards_two(d),
        (Some((d, 3)), _) => towards_top(d.turned(1)),
        (None, 0) => single_run(under()).and_then(|(first, n)| from_run(first, n)).unwrap_or_default(),
        _ => Offset::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::ExactBounds;

    #[test]
    fn every_template_turns_with_the_lattice() {
        // Turning axial coordinates by 60 degrees: (q, r) -> (-r, q + r).
        let turn = |o: Offset| Offset { q: -o.r, r: o.q + o.r };
        for d in Direction::ALL {
            let next = d.turned(1);
            assert_eq!(turn(towards_one(d)), towards_one(next));
            assert_eq!(turn(towards_two(d)), towards_two(next));
            assert_eq!(turn(towards_top(d)), towards_top(next));
            for n in 1..=6 {
                assert_eq!(from_run(d, n).map(turn), from_run(next, n));
            }
            for (before, after) in [(false, false), (false, true), (true, false), (true, true)] {
                assert_eq!(star_points(d, before, after).map(turn), star_points(next, before, after));
            }
        }
    }

    #[test]
    fn shared_star_points_are_the_same_seen_from_both() {
        for d in Direction::ALL {
            let [_, _, last] = star_points(d, false, true);
            let [first, _, _] = star_points(d.turned(1), true, false);
            // The next of a run lies two turns on.
            assert_eq!(last, first + Offset::of(d.turned(2).step()));
        }
    }

    #[test]
    fn the_star_of_a_single_three_finned_hexagon_keeps_the_bounds() {
        let d = Direction::new(1);
        let [p0, p1, p2] = star_points(d, false, false);
        let step = |by: usize| Offset::of(d.turned(by).step());
        let half = |a: usize, b: usize| Offset::fraction(d.turned(a).step() + d.turned(b).step(), 1, 2);
        let top = step(3) + from_run(d, 1).unwrap();
        let beside = [step(4) + towards_one(d), step(2) + towards_one(d)];
        let star = [
            [p0, step(5), half(5, 0)],
            [p0, half(5, 0), p1],
            [p1, half(5, 0), step(0)],
            [p1, step(0), half(0, 1)],
            [p1, half(0, 1), p2],
            [p2, half(0, 1), step(1)],
            [p0, p1, p2],
            [p0, p2, top],
            [p0, top, beside[0]],
            [p2, beside[1], top],
            [p0, beside[0], step(5)],
            [p2, step(1), beside[1]],
        ];
        for (i, t) in star.into_iter().enumerate() {
            assert!(ExactBounds::EXTENDED.hold(t), "triangle {i}");
        }
    }

    #[test]
    fn both_ways_to_a_relocation_agree() {
        let mut tops = 0;
        for seed in 0..500_i64 {
            let centre = |i: i64| Hex::new((seed * 7 + i * 5) % 16 - 4, (seed * 3 + i * 11) % 16 - 4);
            let disc = |i: i64| centre(i).disc(((seed + i) % 3 + 1) as u32);
            let inside = |h: &Hex| Window::with_margin(4).iter().any(|w| w == *h);
            let subdivided = !(0..4).flat_map(disc).filter(inside).collect::<Window>();
            let classes = Classes::of(subdivided);
            for at in Window::with_margin(2).iter() {
                assert_eq!(relocation(subdivided, at), classes.relocation(at));
                tops += u32::from(classes.under_of(at) != 0 && classes.fins_of(at) == 0);
            }
        }
        assert!(tops > 0);
    }

    #[test]
    fn the_nearest_corner_is_the_one_a_point_leans_to() {
        for d in Direction::ALL {
            let corner = Offset::fraction(d.step() + d.turned(1).step(), 1, 3).cartesian();
            assert_eq!(nearest_corner(corner * 0.7), d);
            let shift = ring_shift(&Located { hex: Hex::ORIGIN, offset: corner * 0.9 });
            assert!((shift.cartesian() - corner * 0.5).length() < 1e-15);
        }
    }
}
