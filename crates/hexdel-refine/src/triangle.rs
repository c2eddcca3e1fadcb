//! The triangle rule, which section 5.2 lacks.
//!
//! Without it, angles down to 33.3 and up to 93.4 degrees remain where two
//! fronts face each other across a strip of two coarse hexagons, and where a
//! top touches a hexagon moved by another front. Since relocations come from a
//! small finite set, whether a triangle keeps the bounds is decided exactly;
//! where it does not, the corner with the most fins is subdivided.
//!
//! ```text
//!     *  *  *           two fronts: the hexagons 1 above and below are pulled
//!      1  1  1          apart, and the triangle between them, one corner moved
//!       1  1  1         up and two down, gets too flat an angle
//!        *  *  *
//! ```

use crate::rule::{Rule, Situation};
use hexdel_classify::relocate::{from_run, towards_one, towards_two};
use hexdel_classify::{Classes, ExactBounds, Offset};
use hexdel_grid::{Direction, Hex, Window};
use std::sync::OnceLock;

/// The rules of this module.
pub static RULES: &[&dyn Rule] = &[&TriangleRule];

/// No triangle of hexagons of the same level breaks the bounds.
pub struct TriangleRule;

impl Rule for TriangleRule {
    fn name(&self) -> &'static str {
        "triangle"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        let mut victims = Window::EMPTY;
        let movement = Movement::of(&s.classes);
        // A pair one step beyond the tile may still have a victim within.
        if (movement.moved & Window::with_margin(1)).is_empty() {
            return victims;
        }
        movement.judge::<0>(&mut victims);
        movement.judge::<1>(&mut victims);
        movement.judge::<2>(&mut victims);
        victims
    }
}

/// The corner that the rule asks for because of one lattice triangle,
/// counter-clockwise: what [`TriangleRule`] does for every triangle of a window.
pub fn victim_of(c: &Classes, corners: [Hex; 3]) -> Option<Hex> {
    let m = Movement::of(c);
    let pairs = [m.foreign::<0>(), m.foreign::<1>(), m.foreign::<2>()];
    let foreign = |a: Hex, b: Hex| {
        let along = Direction::ALL[..3].iter().find(|d| a.neighbour(**d) == b);
        along.is_some_and(|&d| pairs[d.index()].contains(a))
    };
    let [x, y, z] = corners;
    let asked = [(x, y), (y, z), (z, x)].into_iter().any(|(a, b)| foreign(a, b) || foreign(b, a));
    let three = corners.iter().any(|&at| c.moved3.contains(at));
    let breaks = || !ExactBounds::EXTENDED.hold(corners.map(|at| Offset::of(at) + m.template(at).offset()));
    (asked && !three && breaks()).then(|| victim(corners.map(|at| (m.template(at), at))))
}

/// Classes, and what moves.
struct Movement<'a> {
    c: &'a Classes,
    /// All that a template moves, but for `MovedCenter3`.
    moved: Window,
    /// The tops of `MovedCenter3`, whatever else they are.
    tops: Window,
}

impl<'a> Movement<'a> {
    #[inline]
    fn of(c: &'a Classes) -> Self {
        let tops = if c.moved3.is_empty() { Window::EMPTY } else { c.tops() };
        let moved4 = tops.without(c.finned() | c.subdivided);
        Self { c, moved: c.moved1 | c.moved2 | moved4, tops }
    }

    /// The hexagons that are moved by another front than their neighbour in
    /// direction `D`: both are moved, they share no fin, and neither is the top
    /// of a three-finned hexagon beside the other.
    #[inline]
    fn foreign<const D: usize>(&self) -> Window {
        let (c, d) = (self.c, const { Direction::new(D) });
        let pairs = self.moved & self.moved.at(d);
        if pairs.is_empty() {
            return pairs;
        }
        // What is moved is not subdivided: where it has a fin, there is one.
        let foreign = pairs.without(c.fins[(D + 1) % 6] | c.fins[(D + 5) % 6]);
        if c.moved3.is_empty() {
            return foreign;
        }
        let under = |by: usize| c.under[(D + by) % 6];
        foreign.without(under(1) | under(5) | (under(2) | under(4)).at(d))
    }

    /// Adds the victims of all triangles at pairs along direction `D`.
    #[inline]
    fn judge<const D: usize>(&self, victims: &mut Window) {
        let d = const { Direction::new(D) };
        // Those of which a corner lies in the tile.
        let tile = const { Window::with_margin(0) };
        let near = tile | tile.at(d) | tile.at(d.turned(1)) | tile.at(d.turned(5));
        let pairs = self.foreign::<D>() & near;
        if pairs.is_empty() {
            return;
        }
        let step = |by: usize| d.turned(by).step();
        for a in pairs.iter() {
            let b = a + step(0);
            let (of_a, of_b) = (self.template_of_moved(a), self.template_of_moved(b));
            for (third, kept) in [a + step(1), a + step(5)].into_iter().zip(kept(d, of_a, of_b)) {
                let of_third = self.template(third);
                if kept >> of_third.0 & 1 == 0 && !self.c.moved3.contains(third) {
                    victims.insert(victim([(of_a, a), (of_b, b), (of_third, third)]));
                }
            }
        }
    }

    #[inline]
    fn template(&self, at: Hex) -> Template {
        if self.c.subdivided.contains(at) { Template::STAYS } else { self.template_of_moved(at) }
    }

    /// The same for a hexagon that is not subdivided.
    #[inline]
    fn template_of_moved(&self, at: Hex) -> Template {
        match self.c.subdivided.ring_of(at) {
            0 if !self.tops.contains(at) => Template::STAYS,
            0 => Template::OF_TOP[usize::from(self.c.under_of(at))],
            fins => Template::OF_FINS[usize::from(fins)],
        }
    }
}

/// The corner to subdivide of a triangle that breaks the bounds: the one that
/// is moved most.
#[inline]
fn victim([first, second, third]: [(Template, Hex); 3]) -> Hex {
    let ranked = |(template, at): (Template, Hex)| (template.rank(), at);
    ranked(first).max(ranked(second)).max(ranked(third)).1
}

/// Where a vertex goes that is not a `MovedCenter3`: 0 if it stays, 37 if it is
/// a top and stays, otherwise `1 + 6 kind + direction`. Kinds 0 and 1 have one
/// fin or two, the first of them in that direction; kinds 2 to 5 are tops of a
/// run of one to four.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Template(u8);

impl Template {
    const COUNT: usize = 38;

    /// The hexagon stays, or it must be subdivided.
    const STAYS: Self = Self(0);

    /// The top of runs that no template moves it away from.
    const TOP_STAYS: Self = Self(37);

    /// By the fins, bit `i` for direction `i`.
    const OF_FINS: [Self; 64] = Self::of_runs(0, 2, Self::STAYS);

    /// By the `MovedCenter3` that a hexagon without fins is the top of.
    const OF_TOP: [Self; 64] = Self::of_runs(2, 4, Self::TOP_STAYS);

    /// For each set of directions that is one run of at most `longest`, the
    /// kinds from `first` on by its length; `other` for the rest.
    const fn of_runs(first: u8, longest: u8, other: Self) -> [Self; 64] {
        let mut table = [other; 64];
        let mut length = 1;
        while length <= longest {
            let mut d = 0;
            while d < 6 {
                let run = (1_u32 << length) - 1;
                let set = (run << d | run << d >> 6) & 63;
                table[set as usize] = Self(1 + 6 * (first + length - 1) + d);
                d += 1;
            }
            length += 1;
        }
        table
    }

    #[inline]
    fn index(self) -> usize {
        usize::from(self.0)
    }

    /// How much a hexagon is moved, in the order victims are chosen: two fins,
    /// one, a top, not at all.
    #[inline]
    fn rank(self) -> u8 {
        match self.0 {
            0 => 0,
            1..=6 => 2,
            7..=12 => 3,
            _ => 1,
        }
    }

    fn offset(self) -> Offset {
        if self == Self::STAYS || self == Self::TOP_STAYS {
            return Offset::ZERO;
        }
        let (kind, d) = ((self.0 - 1) / 6, Direction::new(usize::from((self.0 - 1) % 6)));
        match usize::from(kind) {
            0 => towards_one(d),
            1 => towards_two(d),
            kind => from_run(d, kind - 1).unwrap_or_default(),
        }
    }
}

/// For the triangles to the left and to the right of two neighbours, `b` in
/// direction `d` of `a`, one of the first three: the templates of the third
/// corner with which they keep the bounds, a bit each.
#[inline]
fn kept(d: Direction, a: Template, b: Template) -> [u64; 2] {
    const PAIRS: usize = Template::COUNT * Template::COUNT;
    static KEPT: [OnceLock<[u64; 2]>; 3 * PAIRS] = [const { OnceLock::new() }; 3 * PAIRS];
    let index = d.index() * PAIRS + a.index() * Template::COUNT + b.index();
    *KEPT[index].get_or_init(|| kept_by(d, a, b))
}

#[cold]
fn kept_by(d: Direction, a: Template, b: Template) -> [u64; 2] {
    let at = |hex, t: Template| Offset::of(hex) + t.offset();
    let (a, b) = (at(Hex::ORIGIN, a), at(d.step(), b));
    let thirds = |turn| (0..Template::COUNT as u8).map(move |t| (t, at(d.turned(turn).step(), Template(t))));
    let bits = |set, (t, keeps)| set | u64::from(keeps) << t;
    let bounds = ExactBounds::EXTENDED;
    [
        thirds(1).map(|(t, third)| (t, bounds.hold([a, b, third]))).fold(0, bits),
        thirds(5).map(|(t, third)| (t, bounds.hold([b, a, third]))).fold(0, bits),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_classify::Class;
    use hexdel_classify::class::middle_fin;
    use hexdel_classify::relocate::relocation;

    /// Windows with discs of subdivided hexagons, or of others.
    fn windows() -> impl Iterator<Item = Window> {
        (0..3000_i64).map(|seed| {
            let centre = |i: i64| Hex::new((seed * 7 + i * 5) % 16 - 4, (seed * 3 + i * 11) % 16 - 4);
            let disc = |i: i64| centre(i).disc(((seed + i) % 3 + 1) as u32);
            let inside = |h: &Hex| Window::with_margin(4).iter().any(|w| w == *h);
            let holes: Window = (0..4).flat_map(disc).filter(inside).collect();
            if seed % 2 == 0 { holes } else { !holes }
        })
    }

    /// Of two hexagons, what is beside both decides.
    #[test]
    fn pairs_are_foreign_that_share_no_fin_and_no_three_finned_hexagon_of_a_top() {
        let mut counts = [0, 0];
        for subdivided in windows() {
            let c = Classes::of(subdivided);
            let m = Movement::of(&c);
            let pairs = [m.foreign::<0>(), m.foreign::<1>(), m.foreign::<2>()];
            let moved = |at: Hex| {
                matches!(c.class_of(at), Class::MovedCenter1 | Class::MovedCenter2 | Class::MovedCenter4)
            };
            for (a, d) in Window::with_margin(1).iter().flat_map(|a| (0..3).map(move |d| (a, d))) {
                let along = Direction::new(d);
                let b = a.neighbour(along);
                if !moved(a) || !moved(b) {
                    assert!(!pairs[d].contains(a), "{a:?} {d}");
                    continue;
                }
                let joins = |turn: usize| {
                    let between = a.neighbour(along.turned(turn));
                    let top = middle_fin(subdivided, between).map(|d| between.neighbour(d.turned(3)));
                    subdivided.contains(between) || top.is_some_and(|top| top == a || top == b)
                };
                let foreign = !joins(1) && !joins(5);
                assert_eq!(pairs[d].contains(a), foreign, "{a:?} {d} in {subdivided:?}");
                counts[usize::from(foreign)] += 1;
            }
        }
        assert!(counts.into_iter().all(|n| n > 1000), "{counts:?}");
    }

    #[test]
    fn templates_are_what_relocates() {
        let mut seen = [false; Template::COUNT];
        for subdivided in windows() {
            let c = Classes::of(subdivided);
            for at in Window::with_margin(1).without(c.moved3).iter() {
                let template = Movement::of(&c).template(at);
                assert_eq!(template.offset(), relocation(subdivided, at));
                seen[usize::from(template.0)] = true;
            }
        }
        assert!(seen.iter().filter(|s| **s).count() >= 18, "{seen:?}");
    }

    #[test]
    fn tables_agree_with_the_triangle_itself() {
        let all = || (0..Template::COUNT as u8).map(Template);
        for d in Direction::ALL.into_iter().take(3) {
            for (a, b) in all().flat_map(|a| all().map(move |b| (a, b))) {
                let [left, right] = kept(d, a, b);
                for third in all() {
                    let place = |hex, t: Template| Offset::of(hex) + t.offset();
                    let (p, q) = (place(Hex::ORIGIN, a), place(d.step(), b));
                    let l = ExactBounds::EXTENDED.hold([p, q, place(d.turned(1).step(), third)]);
                    let r = ExactBounds::EXTENDED.hold([q, p, place(d.turned(5).step(), third)]);
                    assert_eq!((left >> third.0 & 1 == 1, right >> third.0 & 1 == 1), (l, r));
                }
            }
        }
    }
}
