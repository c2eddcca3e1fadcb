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
}

impl RuleSet {
    /// The rules of section 4.1: angles between 30 and 120 degrees.
    pub fn simple() -> Self {
        Self { rules: simple::RULES.to_vec() }
    }

    /// The rules of sections 4.1 and 5.2 and the triangle rule: angles between
    /// 43.9 and 90 degrees.
    pub fn extended() -> Self {
        let rules = simple::RULES.iter().chain(extended::RULES).chain(triangle::RULES);
        Self { rules: rules.copied().collect() }
    }

    /// The rules of a coarse start for a mesh optimiser: hexagons have legal
    /// classes, angles are not bounded yet.
    pub fn coarse(start: Start) -> Self {
        Self { rules: coarse::rules(start) }
    }

    /// These rules without the one of that name.
    #[must_use]
    pub fn without(mut self, name: &str) -> Self {
        self.rules.retain(|rule| rule.name() != name);
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
