//! Why one level, and one occupied hexagon, can be looked at alone.
//!
//! A vertex is *touched* by its level's fronts if its hexagon is subdivided,
//! has fins or is a top, and by an input point if its hexagon is occupied or in
//! the shifted ring of an `Occupied2`. Three facts separate these, each checked
//! here by enumeration with the product's rules:
//!
//! 1. **Levels.** Every touched hexagon has six full neighbours. A hexagon
//!    beside a semi-hexagon is therefore not touched: its vertex is its centre,
//!    whatever the finer levels do.
//! 2. **Points and fronts.** All hexagons in the 1-ring of an `Occupied1` and
//!    in the 1- and 2-ring of an `Occupied2` exist and are not touched by
//!    fronts.
//! 3. **Points among each other.** No triangle has corners touched by two
//!    different input points.

use hexdel_classify::dual::local::{Place, position};
use hexdel_classify::{Classes, Offset, View};
use hexdel_grid::{Hex, Window};
use hexdel_refine::{Rule, RuleSet, Situation};
use std::fmt;

const CENTRE: Hex = Hex::new(3, 3);

/// How many cases each fact was checked in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Checked {
    /// Patterns around a hexagon, with and without input points.
    pub(crate) levels: u64,
    /// Patterns that touch a hexagon, times the places of input points.
    pub(crate) fronts: u64,
    /// Pairs of occupied hexagons.
    pub(crate) pairs: u64,
    /// Patterns in which rules that others imply were held against those.
    pub(crate) implied: u64,
}

/// Rules that ask for nothing that another one does not ask for.
pub(crate) const IMPLIED: [(&str, &str); 3] = [
    ("balance", "fixed beside fins"),
    ("adjacent occupied", "rings of two occupied"),
    ("occupied beside finer", "moved in ring"),
];

/// A case in which a fact does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Fault(pub(crate) String);

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Checks the three facts; with `stride` 1 all patterns, otherwise every so
/// manieth.
pub(crate) fn check(rules: &RuleSet, stride: usize) -> Result<Checked, Fault> {
    let mut checked = Checked::default();
    fronts_and_levels(rules, stride, &mut checked)?;
    rings_exist(rules, &mut checked)?;
    pairs(rules, &mut checked)?;
    implied(rules, stride, &mut checked)?;
    Ok(checked)
}

/// That the rules of [`IMPLIED`] follow: whatever two steps around a hexagon hold, it is asked
/// for, or is to exist, by the other one as well.
fn implied(rules: &RuleSet, stride: usize, checked: &mut Checked) -> Result<(), Fault> {
    let disc: Vec<Hex> = CENTRE.disc(2).collect();
    let by = |name: &str| rules.iter().find(|rule| rule.name() == name);
    for mask in (0..1_u32 << disc.len()).step_by(stride) {
        let set: Window =
            disc.iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1).map(|(_, &at)| at).collect();
        let centre = Window::from_iter([CENTRE]);
        // The pattern is what is subdivided, around an occupied hexagon of either class; or it
        // is what is occupied, of either class in turn.
        let rest = set.without(centre);
        let mixed: Window = rest.iter().filter(|at| (at.q + 2 * at.r) % 3 == 0).collect();
        let views = [
            View { subdivided: rest, occupied1: centre, ..View::default() },
            View { subdivided: rest, occupied2: centre, ..View::default() },
            View { occupied1: rest | centre, ..View::default() },
            View { occupied2: rest | centre, ..View::default() },
            View { occupied1: rest.without(mixed) | centre, occupied2: mixed, ..View::default() },
            View { occupied1: mixed, occupied2: rest.without(mixed) | centre, ..View::default() },
        ];
        for s in views.map(Situation::of) {
            checked.implied += 1;
            for (weak, strong) in IMPLIED.map(|(weak, strong)| (by(weak), by(strong))) {
                let (Some(weak), Some(strong)) = (weak, strong) else { continue };
                let asked = weak.must_subdivide(&s).without(strong.must_subdivide(&s))
                    | weak.must_exist(&s).without(strong.must_exist(&s));
                if asked.contains(CENTRE) {
                    return Err(Fault(format!(
                        "\"{}\" does not follow from \"{}\"",
                        weak.name(),
                        strong.name()
                    )));
                }
            }
        }
    }
    Ok(())
}

/// Facts 1 and 2 for what a pattern of the 19 hexagons around one touches.
fn fronts_and_levels(rules: &RuleSet, stride: usize, checked: &mut Checked) -> Result<(), Fault> {
    let disc: Vec<Hex> = CENTRE.disc(2).collect();
    let ring: Window = CENTRE.disc(1).collect();
    let around: Window = disc.iter().copied().collect();
    let in_ring: Vec<&dyn Rule> =
        rules.iter().filter(|r| r.name() == "moved in ring").map(|r| r as _).collect();
    for mask in (0..1_u32 << disc.len()).step_by(stride) {
        let members = disc.iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1);
        let subdivided: Window = members.map(|(_, &at)| at).collect();
        let s = Situation::of(View { subdivided, ..View::default() });
        if !touched(&s.classes, CENTRE) {
            continue;
        }
        checked.levels += 1;
        if !ring.without(rules.must_exist(&s)).is_empty() {
            return Err(Fault(format!("a touched hexagon may lie beside a semi-hexagon: {subdivided:?}")));
        }
        // Each occupied hexagon is asked about on its own: the rule's answer
        // is the marks within a set made from the fronts.
        checked.fronts += 26;
        let one = View { subdivided, occupied1: ring, ..View::default() };
        let two = View { subdivided, occupied2: around, ..View::default() };
        for (view, all) in [(one, ring), (two, around)] {
            let s = Situation { view, classes: s.classes.clone() };
            let asked = in_ring.iter().fold(Window::EMPTY, |set, rule| set | rule.must_subdivide(&s));
            if !all.without(asked).is_empty() {
                return Err(Fault(format!("a ring may hold a hexagon moved by a front: {subdivided:?}")));
            }
        }
    }
    Ok(())
}

/// Whether fronts move, drop or subdivide a hexagon.
fn touched(classes: &Classes, at: Hex) -> bool {
    let place = position(classes, Place::Leaf(at));
    classes.fins_of(at) != 0 || classes.under_of(at) != 0 || place != Some(Offset::of(at))
}

/// Fact 1 for occupied hexagons and shifted rings, and that rings exist.
fn rings_exist(rules: &RuleSet, checked: &mut Checked) -> Result<(), Fault> {
    for (class, reach) in [(1, 1), (2, 2)] {
        let mark = Window::from_iter([CENTRE]);
        let occupied = |c| if c == class { mark } else { Window::EMPTY };
        let needed: Window = CENTRE.disc(reach).collect();
        for subdivided in std::iter::once(Window::EMPTY).chain(needed.iter().map(|h| Window::from_iter([h])))
        {
            checked.levels += 1;
            let view = View { subdivided, occupied1: occupied(1), occupied2: occupied(2) };
            if !needed.without(rules.must_exist(&Situation::of(view))).is_empty() {
                return Err(Fault(format!("a ring of an Occupied{class} may lack a hexagon")));
            }
        }
    }
    Ok(())
}

/// Fact 3, for every legal pair of occupied hexagons near each other.
fn pairs(rules: &RuleSet, checked: &mut Checked) -> Result<(), Fault> {
    let moved = |at: Hex, two: bool| at.disc(u32::from(two));
    for (a_two, b_two) in [(false, false), (false, true), (true, false), (true, true)] {
        for b in CENTRE.disc(6).skip(1) {
            let at = |class| {
                let both = [(CENTRE, a_two), (b, b_two)];
                both.into_iter().filter(|&(_, two)| two == class).map(|(at, _)| at).collect()
            };
            let view = View { occupied1: at(false), occupied2: at(true), ..View::default() };
            let s = Situation::of(view);
            let asked = rules.iter().fold(Window::EMPTY, |set, r| set | r.must_subdivide(&s));
            if asked.contains(CENTRE) {
                continue;
            }
            checked.pairs += 1;
            let close = |x: Hex| moved(b, b_two).any(|y| x.distance(y) <= 1);
            if moved(CENTRE, a_two).any(close) {
                return Err(Fault(format!("two input points may touch one triangle: {CENTRE:?}, {b:?}")));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_facts_hold_for_the_rules_and_not_for_fewer() {
        let rules = RuleSet::extended();
        let checked = check(&rules, 7).unwrap();
        assert!(checked.levels > 50_000 && checked.pairs > 200, "{checked:?}");
        for (name, word) in [
            ("fixed beside fins", "semi-hexagon"),
            ("moved in ring", "front"),
            ("rings of two occupied", "points"),
        ] {
            let fault = check(&rules.clone().without(name), 7).unwrap_err();
            assert!(fault.0.contains(word), "{name}: {fault}");
        }
    }
}
