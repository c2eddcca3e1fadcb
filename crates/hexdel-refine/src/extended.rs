//! The rules of section 5.2.
//!
//! Where the paper's rule on the rings of occupied hexagons subdivides the
//! moved hexagon and, through rule 5, the occupied one as well, the rule here
//! subdivides the occupied one only: what else must follow is found by the
//! other rules, and is often nothing.

use crate::rule::{Rule, Situation};
use hexdel_grid::{Direction, Window};

/// The rules of this module, in the paper's order.
pub static RULES: &[&dyn Rule] = &[
    &SubdivideClass,
    &MovedInRing,
    &OccupiedRings,
    &FixedBesideFins,
    &TopOfTwoRuns,
    &TopWithFins,
    &TwoFinsBesideRun,
];

/// Those of them that ask for occupied hexagons whether they have fins or not.
pub static ABOUT_POINTS: &[&dyn Rule] = &[&MovedInRing, &OccupiedRings];

/// Whether there is a `MovedCenter3` at most `N` hexagons beyond the tile: where
/// else one lies does not matter to a rule that looks no farther.
#[inline]
fn has_three_finned<const N: i64>(s: &Situation) -> bool {
    !(s.classes.moved3 & const { Window::with_margin(N) }).is_empty()
}

/// Subdivide any hexagon of type SUBDIVIDE: its fins are not consecutive, or
/// more than three.
pub struct SubdivideClass;

impl Rule for SubdivideClass {
    fn name(&self) -> &'static str {
        "class subdivide"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        s.classes.irregular
    }
}

/// No moved hexagon lies in the 1-ring of an `Occupied1` or in the 1- or 2-ring
/// of an `Occupied2`: such an occupied hexagon is subdivided.
///
/// ```text
///     .  .  .  .         o: Occupied2. None of the hexagons r (1-ring, shifted
///    .  R  R  R  .       with the point) and R (2-ring) has fins or is the top
///   .  R  r  r  R  .     of a three-finned one, so nothing is subdivided up to
///  .  R  r  o  r  R  .   the third ring.
/// ```
pub struct MovedInRing;

impl Rule for MovedInRing {
    fn name(&self) -> &'static str {
        "moved in ring"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        if s.view.subdivided.is_empty() || !s.holds_points() {
            return Window::EMPTY;
        }
        let moved = s.view.subdivided.dilated() | s.classes.moved4();
        let near = moved.dilated();
        s.view.occupied1 & near | s.view.occupied2 & near.dilated()
    }
}

/// The shifted ring of an `Occupied2` lies in no ring of another occupied
/// hexagon: `Occupied2` are four steps apart, and three from `Occupied1`.
pub struct OccupiedRings;

impl Rule for OccupiedRings {
    fn name(&self) -> &'static str {
        "rings of two occupied"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        if !s.holds_points() {
            return Window::EMPTY;
        }
        let (one, two) = (s.view.occupied1, s.view.occupied2);
        let mut close = Window::EMPTY;
        if !(one | two).holds_several() {
            return close;
        }
        if !one.is_empty() {
            close = one & one.others_within::<1>();
        }
        if !two.is_empty() {
            close |= two & two.others_within::<3>();
        }
        if !one.is_empty() && !two.is_empty() {
            close |= one & two.others_within::<2>() | two & one.others_within::<2>();
        }
        close
    }
}

/// The full hexagons beside the fins of a `MovedCenter1`, `2` or `3` are of
/// type FIXED. Seen from the finer side: a hexagon that is moved, and one that
/// is subdivided or has fins, has six full neighbours, so that it lies beside
/// no semi-hexagon.
pub struct FixedBesideFins;

impl Rule for FixedBesideFins {
    fn name(&self) -> &'static str {
        "fixed beside fins"
    }

    fn must_exist(&self, s: &Situation) -> Window {
        let moved = s.view.subdivided.dilated() | s.classes.moved4() | s.view.occupied2.dilated();
        moved.dilated()
    }
}

/// Subdivide a `MovedCenter4` that is the top of more than one run of
/// `MovedCenter3`.
pub struct TopOfTwoRuns;

impl Rule for TopOfTwoRuns {
    fn name(&self) -> &'static str {
        "top of two runs"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        let c = &s.classes;
        if !has_three_finned::<1>(s) {
            return Window::EMPTY;
        }
        // Runs start where there is none before; five in a run have one start.
        let (mut one, mut more) = (Window::EMPTY, Window::EMPTY);
        let mut gaps = Window::EMPTY;
        let mut two_gaps = Window::EMPTY;
        for d in 0..6 {
            let start = c.under[(d + 1) % 6].without(c.under[d]);
            more |= one & start;
            one |= start;
            two_gaps |= gaps.without(c.under[d]);
            gaps |= !c.under[d];
        }
        c.moved4() & (more | one.without(two_gaps))
    }
}

/// A top has no fins of its own, or there is no template for it: subdivide the
/// `MovedCenter3` below it. (Implied by the paper's definition of the class.)
pub struct TopWithFins;

impl Rule for TopWithFins {
    fn name(&self) -> &'static str {
        "top with fins"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        if !has_three_finned::<0>(s) {
            return Window::EMPTY;
        }
        let finned = s.classes.finned().each_way();
        let below = |d: usize| s.classes.middle[d] & finned[(d + 3) % 6];
        below(0) | below(1) | below(2) | below(3) | below(4) | below(5)
    }
}

/// A run of two or more `MovedCenter3` does not end at a `MovedCenter2`
/// (paper, Fig. 6): the hexagon after that one is subdivided, which makes it
/// part of the run.
///
/// ```text
///      *  *  *  *  x        * subdivided, 3 the run, 2 beside it:
///       3  3  2  .          subdivide x
/// ```
pub struct TwoFinsBesideRun;

impl Rule for TwoFinsBesideRun {
    fn name(&self) -> &'static str {
        "two fins beside run"
    }

    fn must_subdivide(&self, s: &Situation) -> Window {
        let c = &s.classes;
        if c.moved2.is_empty() || !has_three_finned::<2>(s) {
            return Window::EMPTY;
        }
        let [a, b, c0, d, e, f] = c.with_next();
        if (a | b | c0 | d | e | f).is_empty() {
            return Window::EMPTY;
        }
        beyond_run::<0>(a, c.moved2)
            | beyond_run::<1>(b, c.moved2)
            | beyond_run::<2>(c0, c.moved2)
            | beyond_run::<3>(d, c.moved2)
            | beyond_run::<4>(e, c.moved2)
            | beyond_run::<5>(f, c.moved2)
    }
}

/// What lies beyond a `MovedCenter2` at an end of the runs of two, of which
/// `first` are those with their middle fin in direction `D`.
#[inline]
fn beyond_run<const D: usize>(first: Window, moved2: Window) -> Window {
    // Around the top at -D, the next lies at D + 2, the one before at D - 2;
    // the hexagon beyond it in the same direction again.
    let (next, before) = const { (Direction::new(D + 2), Direction::new(D + 4)) };
    // The first of the two, and the second as its neighbour sees it: its
    // middle fin is one direction on.
    let (second, after) = (first.moved(next), const { Direction::new(D + 3) });
    (first & moved2.at(before)).moved(before).moved(before)
        | (second & moved2.at(after)).moved(after).moved(after)
}
