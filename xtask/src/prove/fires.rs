//! When a rule certainly asks for something, however a pattern goes on.
//!
//! A pattern is undecided beyond some hexagons. The product's rules are asked
//! about it as if all that is undecided were unsubdivided; where one asks for a
//! hexagon, it is *certain* to do so if it does because of what is decided: see
//! [`support`](super::support).
//!
//! Nothing is concluded from a rule's silence. Rules on occupied hexagons never end a
//! pattern.

use super::pattern::Plan;
use super::support::{Cause, causes};
use hexdel_classify::{Classes, View};
use hexdel_grid::{Direction, Hex, Window};
use hexdel_refine::{Rule, RuleSet, Situation, triangle};

/// The rules, and a table of fins.
pub(crate) struct Fires {
    pub(crate) rules: RuleSet,
    causes: Vec<Cause>,
    /// `dead[known][fins]`: whether a hexagon that is not subdivided must be
    /// subdivided for its fins alone, of which only those in `known` are
    /// decided. Made by the product's classification.
    dead: Vec<[bool; 64]>,
}

impl Fires {
    /// Prepares a set of rules.
    pub(crate) fn new(rules: RuleSet) -> Self {
        let irregular: Vec<bool> = (0..64).map(|fins| is_irregular(&rules, fins)).collect();
        let dead = (0..64_u8).map(|known| {
            std::array::from_fn(|fins| {
                (0..64_u8).filter(|f| f & known == fins as u8 & known).all(|f| irregular[usize::from(f)])
            })
        });
        Self { dead: dead.collect(), causes: causes(), rules }
    }

    /// Whether some rule certainly asks for a hexagon that is decided not to be
    /// subdivided, `at` being the last one decided.
    pub(crate) fn certainly(&self, plan: &Plan, depth: usize, at: Hex, subdivided: Window) -> bool {
        let known = &plan.known[depth];
        self.for_fins(known[0], at, subdivided) || self.asked(known, subdivided)
    }

    /// The rule on fins alone, asked before a hexagon's fins are complete.
    fn for_fins(&self, known: Window, at: Hex, subdivided: Window) -> bool {
        at.disc(1).filter(|&h| known.contains(h) && !subdivided.contains(h)).any(|h| {
            let (mut decided, mut fins) = (0_usize, 0_usize);
            for d in Direction::ALL {
                let beside = h.neighbour(d);
                decided |= usize::from(known.contains(beside)) << d.index();
                fins |= usize::from(subdivided.contains(beside)) << d.index();
            }
            self.dead[decided][fins & decided]
        })
    }

    fn asked(&self, known: &[Window; 3], subdivided: Window) -> bool {
        let situation = Situation::of(View { subdivided, ..View::default() });
        let candidates = known[0].without(subdivided) & Window::with_margin(0);
        self.rules.iter().any(|rule| {
            let asked = rule.must_subdivide(&situation) & candidates;
            !asked.is_empty() && asked.iter().any(|v| self.is_certain(rule, &situation.classes, known, v))
        })
    }

    /// Whether a rule asks for `v` because of what is decided.
    fn is_certain(&self, rule: &dyn Rule, classes: &Classes, known: &[Window; 3], v: Hex) -> bool {
        if rule.name() == "triangle" {
            return Direction::ALL.into_iter().any(|d| {
                let corners = [v, v.neighbour(d), v.neighbour(d.turned(1))];
                corners.iter().all(|&at| known[2].contains(at))
                    && triangle::victim_of(classes, corners) == Some(v)
            });
        }
        self.causes.iter().any(|cause| cause.certain(rule, known[0], classes.subdivided, v))
    }
}

/// Whether the rules subdivide a hexagon for its fins alone.
fn is_irregular(rules: &RuleSet, fins: u8) -> bool {
    let centre = Hex::new(4, 4);
    let fins = Direction::ALL.into_iter().filter(|d| fins >> d.index() & 1 == 1);
    let subdivided = fins.map(|d| centre.neighbour(d)).collect();
    let situation = Situation::of(View { subdivided, ..View::default() });
    let by_class = rules.iter().find(|rule| rule.name() == "class subdivide");
    by_class.is_some_and(|rule| rule.must_subdivide(&situation).contains(centre))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prove::pattern::Unit;

    /// A generator of bits, good enough to vary what must not matter.
    struct Bits(u64);

    impl Bits {
        fn next(&mut self) -> u64 {
            self.0 ^= self.0 << 13;
            self.0 ^= self.0 >> 7;
            self.0 ^= self.0 << 17;
            self.0
        }

        fn window(&mut self, dense: bool) -> Window {
            let bits: Vec<bool> =
                (0..256).map(|_| self.next() >> 32 & if dense { 1 } else { 3 } == 1).collect();
            Window::FULL.iter().zip(bits).filter(|(_, b)| *b).map(|(at, _)| at).collect()
        }
    }

    /// What is certain stays so, whatever is decided beyond.
    #[test]
    fn certain_demands_survive_every_continuation() {
        let mut bits = Bits(0x9e37_79b9_7f4a_7c15);
        let mut seen = std::collections::BTreeMap::new();
        for name in ["top with fins", "top of two runs", "two fins beside run", "triangle", "class subdivide"]
        {
            let all = RuleSet::extended();
            let only = all
                .iter()
                .map(hexdel_refine::Rule::name)
                .filter(|n| *n != name)
                .fold(all.clone(), RuleSet::without);
            let fires = Fires::new(only);
            for unit in Unit::representatives() {
                let plan = Plan::new(unit);
                let mut certain = 0;
                for round in 0..15_000 {
                    let depth = 15 + (bits.next() % (plan.order.len() as u64 - 15)) as usize;
                    let known = plan.known[depth];
                    // Patterns out of straight fronts, where the rules are
                    // not drowned in irregular hexagons.
                    let noise = if round % 2 == 0 { Window::EMPTY } else { sparse(&mut bits) };
                    let wanted = fronts(&mut bits).without(noise) | noise & sparse(&mut bits);
                    let pattern = (wanted & known[0]) | (plan.given & known[0]);
                    if certain >= 30 || !fires.certainly(&plan, depth, plan.order[depth - 1], pattern) {
                        continue;
                    }
                    certain += 1;
                    for i in 0..60 {
                        let beyond = if i % 3 == 0 { fronts(&mut bits) } else { bits.window(i % 3 == 1) };
                        let whole = pattern | beyond.without(known[0]);
                        let s = Situation::of(View { subdivided: whole, ..View::default() });
                        let tile = known[0].without(whole) & Window::with_margin(0);
                        let asks = fires.rules.iter().any(|r| !(r.must_subdivide(&s) & tile).is_empty());
                        assert!(asks, "{name} {unit:?} {pattern:?}");
                    }
                }
                *seen.entry(name).or_insert(0) += certain;
            }
        }
        assert!(seen.values().all(|n| *n > 5), "{seen:?}");
    }

    fn sparse(bits: &mut Bits) -> Window {
        bits.window(false) & bits.window(false) & bits.window(true)
    }

    /// Half planes, two or three of them.
    fn fronts(bits: &mut Bits) -> Window {
        let mut set = Window::EMPTY;
        for _ in 0..2 + bits.next() % 2 {
            let d = Direction::new((bits.next() % 6) as usize).step();
            let e = Direction::new((bits.next() % 6) as usize).step();
            let (a, b) = ((bits.next() % 5) as i64, (bits.next() % 5) as i64);
            let side = |at: Hex, d: Hex| (at.q - 3) * d.q + (at.r - 3) * d.r;
            set |= Window::FULL.iter().filter(|&at| side(at, d) >= a && side(at, e) >= b - 3).collect();
        }
        set
    }
}
