//! That closing a level ends: rules ask for nothing around a single subdivided lattice
//! hexagon.
//!
//! When a demand lies too far outside, the engine subdivides the smallest lattice hexagon
//! around all that hangs together near it (`hexdel-refine/src/engine/region.rs`). What a rule
//! sees from a hexagon then is the part of one lattice hexagon within four steps. All such
//! parts are enumerated: bounds on `q`, `r` and `q + r` that lie farther than four steps away
//! make no difference.

use super::lemmas::Fault;
use super::pattern::CENTRE;
use hexdel_classify::View;
use hexdel_grid::{Hex, Window};
use hexdel_refine::{RuleSet, Situation};
use rayon::prelude::*;

/// Farthest bound that is told from none: one step more than rules see.
const REACH: i64 = Window::MARGIN + 1;

/// Asks the rules about the hexagon in the middle of every view of a lattice hexagon; returns
/// how many views there are.
pub(crate) fn check(rules: &RuleSet) -> Result<u64, Fault> {
    let strips = |axis: fn(Hex) -> i64| -> Vec<Window> {
        let near: Vec<Hex> = CENTRE.disc(REACH as u32).collect();
        let all = (-REACH..=REACH).flat_map(|low| (low..=REACH).map(move |high| low..=high));
        all.map(|range| near.iter().copied().filter(|&h| range.contains(&axis(h - CENTRE))).collect())
            .collect()
    };
    let (columns, rows, diagonals) = (strips(|h| h.q), strips(|h| h.r), strips(|h| h.q + h.r));
    let parts = columns.par_iter().map(|&column| {
        let mut views = 0;
        for view in rows.iter().flat_map(|&row| diagonals.iter().map(move |&d| column & row & d)) {
            if view.is_empty() || view.contains(CENTRE) {
                continue;
            }
            views += 1;
            let s = Situation::of(View { subdivided: view, ..View::default() });
            if let Some(rule) = rules.iter().find(|rule| rule.must_subdivide(&s).contains(CENTRE)) {
                return Err(Fault(format!("\"{}\" asks beside the lattice hexagon {view:?}", rule.name())));
            }
        }
        Ok(views)
    });
    parts.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_asked_beside_a_lattice_hexagon() {
        for rules in [RuleSet::extended(), RuleSet::simple()] {
            assert!(check(&rules).unwrap() > 10_000);
        }
    }
}
