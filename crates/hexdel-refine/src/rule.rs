//! What a rule is, and the two sets of rules.

use crate::coarse::{self, Start};
use crate::{extended, simple, triangle};
use hexdel_classify::{Classes, View};
use hexdel_grid::Window;

/// A tile and its margin, as rules see it.
#[derive(Clone, Debug)]
pub struct Situation {
    /// What the grid stores.
    pub view: View,
    /// What the fins make of it.
    pub classes: Classes,
}

impl Situation {
    /// Classifies a view.
    pub fn of(view: View) -> Self {
        Self { view, classes: Classes::of(view.subdivided) }
    }

    /// Whether an input point lies in the tile itself.
    pub fn holds_points(&self) -> bool {
        !(self.view.occupied() & Window::with_margin(0)).is_empty()
    }
}

/// A reason to subdivide hexagons.
///
/// Both answers must be right for the tile itself, and may depend on hexagons
/// up to [`Window::MARGIN`] steps away. Where there are neither subdivided nor
/// occupied hexagons a rule asks for nothing: it is not even asked. More subdivided hexagons may make a
/// rule ask for more or less; what it asked for once stays subdivided.
pub trait Rule: Sync {
    /// A short name, for reports.
    fn name(&self) -> &'static str;

    /// The hexagons of this level that must be subdivided.
    fn must_subdivide(&self, situation: &Situation) -> Window {
        let _ = situation;
        Window::EMPTY
    }

    /// The hexagons of this level that must exist: their parents must be
    /// subdivided. May look one step less far.
    fn must_exist(&self, situation: &Situation) -> Window {
        let _ = situation;
        Window::EMPTY
    }
}

/// Rules that are obeyed together.
#[derive(Clone)]
pub struct RuleSet {
    rules: Vec<&'static dyn Rule>,
    /// Those of them that ask for all occupied hexagons that any rule asks for.
    about_points: Vec<&'static dyn Rule>,
}

impl RuleSet {
    /// Rules of one's own. Refinement ends if they ask for nothing around a
    /// single subdivided lattice hexagon; otherwise it may be
    /// [`RefineError::Unbounded`](crate::RefineError::Unbounded).
    pub fn new(rules: Vec<&'static dyn Rule>) -> Self {
        Self { about_points: rules.clone(), rules }
    }

    /// These rules and one more.
    #[must_use]
    pub fn with(mut self, rule: &'static dyn Rule) -> Self {
        self.rules.push(rule);
        self.about_points.push(rule);
        self
    }

    /// The rules of section 4.1: angles between 30 and 120 degrees.
    pub fn simple() -> Self {
        Self { rules: simple::RULES.to_vec(), about_points: simple::ABOUT_POINTS.to_vec() }
    }

    /// The rules of sections 4.1 and 5.2 and the triangle rule: angles between
    /// 43.89 and 90 degrees.
    pub fn extended() -> Self {
        let rules = simple::RULES.iter().chain(extended::RULES).chain(triangle::RULES);
        // A hexagon that has fins or is a top, and what other rules ask for is
        // nothing else, is asked for by one of these if it is occupied.
        let about_points = simple::ABOUT_POINTS.iter().chain(extended::ABOUT_POINTS);
        Self { rules: rules.copied().collect(), about_points: about_points.copied().collect() }
    }

    /// The rules of a coarse start for a mesh optimiser: hexagons have legal
    /// classes, angles are not bounded yet.
    pub fn coarse(start: Start) -> Self {
        let rules = coarse::rules(start);
        Self { about_points: rules.clone(), rules }
    }

    /// These rules without the one of that name.
    #[must_use]
    pub fn without(mut self, name: &str) -> Self {
        self.rules.retain(|rule| rule.name() != name);
        self.about_points.retain(|rule| rule.name() != name);
        self
    }

    /// The rules, in the order they are asked.
    pub fn iter(&self) -> impl Iterator<Item = &'static dyn Rule> {
        self.rules.iter().copied()
    }

    /// The hexagons of a tile that some rule wants subdivided and that are not.
    pub fn must_subdivide(&self, situation: &Situation) -> u64 {
        let asked = self.iter().fold(Window::EMPTY, |set, rule| set | rule.must_subdivide(situation));
        asked.without(situation.view.subdivided).centre()
    }

    /// The occupied hexagons of a tile among those: fewer rules are asked.
    pub fn must_subdivide_occupied(&self, situation: &Situation) -> u64 {
        let rules = self.about_points.iter();
        let asked = rules.fold(Window::EMPTY, |set, rule| set | rule.must_subdivide(situation));
        (asked & situation.view.occupied()).centre()
    }

    /// Whether no rule wants a hexagon of the tile subdivided that is not.
    pub fn hold(&self, situation: &Situation) -> bool {
        let open = Window::with_margin(0).without(situation.view.subdivided);
        // Of those about classes the last object most often; the very last
        // takes the longest.
        let (others, last) = self.rules.split_at(self.rules.len().saturating_sub(1));
        let mut likeliest = others.iter().rev().chain(last);
        likeliest.all(|rule| (rule.must_subdivide(situation) & open).is_empty())
    }

    /// The hexagons that some rule wants to exist.
    pub fn must_exist(&self, situation: &Situation) -> Window {
        self.iter().fold(Window::EMPTY, |set, rule| set | rule.must_exist(situation))
    }
}

impl std::fmt::Debug for RuleSet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.iter().map(Rule::name)).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_grid::Hex;

    #[test]
    fn rules_about_points_ask_for_all_occupied_hexagons_that_any_rule_asks_for() {
        let mut asked = 0;
        for seed in 0..4000_u64 {
            // A place of the window, by multiplication and its high bits.
            let place = |i: u64| {
                let mixed = (seed * 64 + i + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
                Hex::new((mixed % 16) as i64 - 4, (mixed / 16 % 16) as i64 - 4)
            };
            let inside = |h: &Hex| (-4..12).contains(&h.q) && (-4..12).contains(&h.r);
            let disc = |i: u64| place(i).disc(((seed + i) % 3) as u32);
            let holes: Window = (0..3).flat_map(disc).filter(inside).collect();
            let subdivided = if seed % 2 == 0 { holes } else { !holes };
            let [occupied1, occupied2] =
                [10, 20].map(|k| (k..k + 4).map(place).collect::<Window>().without(subdivided));
            let view = View { subdivided, occupied1, occupied2: occupied2.without(occupied1) };
            let situation = Situation::of(view);
            for rules in [RuleSet::simple(), RuleSet::extended(), RuleSet::coarse(Start::Among)] {
                let expected = rules.must_subdivide(&situation) & view.occupied().centre();
                assert_eq!(rules.must_subdivide_occupied(&situation), expected, "{rules:?}, {seed}");
                asked += expected.count_ones();
            }
        }
        assert!(asked > 1000);
    }
}
