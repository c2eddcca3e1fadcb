//! What a rule's demand rests on, derived and checked.
//!
//! A *cause* of a demand for a hexagon `v` is a set of hexagons around it:
//!
//! | rule | causes |
//! |---|---|
//! | class subdivide | one step around `v` |
//! | top with fins | one step around `v` and around one of its neighbours |
//! | top of two runs | two steps around `v` |
//! | two fins beside run | one step around three hexagons in a row of which `v` is the next, 12 ways |
//! | triangle | two steps around the corners of a lattice triangle at `v` |
//!
//! A demand is *certain* if the product's rule asks for `v` with nothing subdivided outside of
//! a cause, and all of the cause is decided. That this is right, whatever lies outside, is
//! checked for every pattern of every cause.

use super::lemmas::Fault;
use super::pattern::CENTRE;
use hexdel_classify::{Classes, View};
use hexdel_grid::{Direction, Hex, Window};
use hexdel_refine::{Rule, RuleSet, Situation};
use rayon::prelude::*;

/// A set of hexagons that a demand can rest on.
#[derive(Clone, Debug)]
pub(crate) struct Cause {
    rule: &'static str,
    /// Relative to the hexagon that is asked for.
    around: Vec<Hex>,
}

/// All causes but those of the triangle rule, which says itself which triangle it is about.
pub(crate) fn causes() -> Vec<Cause> {
    let discs = |centres: &[Hex], radius| -> Vec<Hex> {
        let mut all: Vec<Hex> = centres.iter().flat_map(|at| at.disc(radius)).chain([Hex::ORIGIN]).collect();
        all.sort_unstable();
        all.dedup();
        all
    };
    let cause = |rule, centres: &[Hex], radius| Cause { rule, around: discs(centres, radius) };
    let mut all =
        vec![cause("class subdivide", &[Hex::ORIGIN], 1), cause("top of two runs", &[Hex::ORIGIN], 2)];
    for d in Direction::ALL {
        all.push(cause("top with fins", &[Hex::ORIGIN, d.step()], 1));
        // The last of the run has its middle fin in direction `d`; the next ones lie along
        // `on`, the one before in direction `back` of it.
        for (on, back) in [(2, 4), (4, 2)] {
            let on = d.turned(on).step();
            let (two, last) = (Hex::ORIGIN - on, Hex::ORIGIN - on - on);
            all.push(cause("two fins beside run", &[two, last, last.neighbour(d.turned(back))], 1));
        }
    }
    all
}

impl Cause {
    /// Whether a rule certainly asks for `v` because of this, given what is decided.
    pub(crate) fn certain(&self, rule: &dyn Rule, known: Window, subdivided: Window, v: Hex) -> bool {
        if rule.name() != self.rule || !self.around.iter().all(|&o| inside(v + o) && known.contains(v + o)) {
            return false;
        }
        let here: Window = self.around.iter().map(|&o| v + o).collect();
        asks(rule, subdivided & here, v)
    }
}

fn inside(at: Hex) -> bool {
    (-Window::MARGIN..8 + Window::MARGIN).contains(&at.q)
        && (-Window::MARGIN..8 + Window::MARGIN).contains(&at.r)
}

fn asks(rule: &dyn Rule, subdivided: Window, v: Hex) -> bool {
    rule.must_subdivide(&Situation::of(View { subdivided, ..View::default() })).contains(v)
}

/// How many patterns were checked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Checked {
    /// Patterns of causes.
    pub(crate) demands: u64,
    /// Patterns of two steps around a hexagon.
    pub(crate) classes: u64,
}

/// Checks every cause, and that the class and the place of a hexagon rest on two steps around
/// it; with `stride` 1 all patterns, otherwise every so manieth.
pub(crate) fn check(rules: &RuleSet, stride: usize) -> Result<Checked, Fault> {
    let fills = fills();
    let mut demands = 0;
    for cause in causes() {
        let Some(rule) = rules.iter().find(|rule| rule.name() == cause.rule) else { continue };
        let around: Vec<Hex> = cause.around.iter().map(|&o| CENTRE + o).filter(|&at| at != CENTRE).collect();
        demands += each_pattern(&around, stride, |pattern, beyond| {
            !asks(rule, pattern, CENTRE) || fills.iter().all(|&f| asks(rule, pattern | f & beyond, CENTRE))
        })
        .ok_or_else(|| Fault(format!("\"{}\" rests on more than {:?}", cause.rule, cause.around)))?;
    }
    let near: Vec<Hex> = CENTRE.disc(2).collect();
    let seen = |set: Window| {
        let c = Classes::of(set);
        (c.class_of(CENTRE), c.fins_of(CENTRE), c.under_of(CENTRE), c.relocation(CENTRE))
    };
    let classes = each_pattern(&near, stride, |pattern, beyond| {
        let here = seen(pattern);
        fills.iter().all(|&f| seen(pattern | f & beyond) == here)
    })
    .ok_or_else(|| Fault("the class of a hexagon rests on more than two steps around it".to_owned()))?;
    Ok(Checked { demands, classes })
}

/// Asks a question about all patterns of some hexagons, with all others of the window; returns
/// how many there are if the answer is always yes.
fn each_pattern(of: &[Hex], stride: usize, question: impl Fn(Window, Window) -> bool + Sync) -> Option<u64> {
    let own: Window = of.iter().copied().chain([CENTRE]).collect();
    let beyond = Window::FULL.without(own);
    let patterns = (0..1_usize << of.len()).into_par_iter().step_by(stride);
    let answers = patterns.map(|mask| {
        let pattern = of.iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1).map(|(_, &at)| at).collect();
        question(pattern, beyond).then_some(1_u64)
    });
    answers.sum()
}

/// What may lie outside: everything, stripes, and two sets without pattern; nothing is what is
/// compared with.
fn fills() -> [Window; 4] {
    let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
    let mut mixed = || -> Window {
        let draw = |_: &Hex| {
            bits ^= bits << 13;
            bits ^= bits >> 7;
            bits ^= bits << 17;
            bits >> 40 & 1 == 1
        };
        Window::FULL.iter().filter(draw).collect()
    };
    [Window::FULL, Window::FULL.iter().filter(|at| at.q & 1 == 0).collect(), mixed(), mixed()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn causes_are_all_that_demands_rest_on() {
        let checked = check(&RuleSet::extended(), 7).unwrap();
        assert!(checked.demands > 40_000 && checked.classes > 50_000, "{checked:?}");
    }

    #[test]
    fn a_cause_that_is_too_small_is_found() {
        // One step around a top does not show the fins of what lies below it.
        let rules = RuleSet::extended();
        let rule = rules.iter().find(|r| r.name() == "top with fins").unwrap();
        let around: Vec<Hex> = CENTRE.disc(1).collect();
        let fills = fills();
        let answer = each_pattern(&around, 1, |pattern, beyond| {
            let with = |f: Window| asks(rule, pattern | f & beyond, CENTRE);
            fills.iter().all(|&f| with(f) == with(Window::EMPTY))
        });
        assert_eq!(answer, None);
    }
}
