//! That closing a level ends: rules ask for nothing around a single subdivided lattice
//! hexagon.
//!
//! When a demand lies too far outside, the engine subdivides the smallest lattice hexagon
//! around all that hangs together near it (`hexdel-refine/src/engine/region.rs`). What a rule
//! sees from a hexagon then is the part of one lattice hexagon within four steps. All such
//! parts are enumerated: bounds on `q`, `r` and `q + r` that lie farther than four steps away
//! make no difference.
//!
//! How far closing goes without that is measured beside it: [`closures`].

use super::closure::closed;
use super::lemmas::Fault;
use super::pattern::CENTRE;
use hexdel_classify::View;
use hexdel_grid::{Hex, Window};
use hexdel_refine::{RuleSet, Situation};
use rayon::prelude::*;
use std::collections::BTreeMap;

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

/// How many rows closing goes beyond the smallest lattice hexagon around what it begins with.
#[derive(Clone, Debug)]
pub(crate) struct Closures {
    /// What it begins with.
    pub(crate) name: &'static str,
    /// How many sets end so many rows beyond.
    pub(crate) by_rows: BTreeMap<i64, u64>,
}

/// Closes all sets of three kinds, without any limit.
pub(crate) fn closures(rules: &RuleSet) -> Result<Vec<Closures>, Fault> {
    let below = |high: i64| Window::FULL.iter().filter(move |h| h.r <= high);
    let last = |rows: i64, from: i64, to: i64| {
        below(CENTRE.r)
            .filter(move |h| h.r > CENTRE.r - rows && (from..to).contains(&h.q))
            .collect::<Vec<_>>()
    };
    let kinds = [
        ("any set within two steps of a hexagon", Window::EMPTY, CENTRE.disc(2).collect()),
        ("a straight front, in its last row any of 14", below(CENTRE.r).collect(), last(1, -3, 11)),
        ("a straight front, in its last two rows any of 8 each", below(CENTRE.r).collect(), last(2, 0, 8)),
    ];
    kinds.into_iter().map(|(name, all, free)| of_kind(name, all, &free, rules)).collect()
}

/// Closes a set with each choice of the hexagons that are free.
fn of_kind(name: &'static str, all: Window, free: &[Hex], rules: &RuleSet) -> Result<Closures, Fault> {
    let fixed = all.without(free.iter().copied().collect());
    let rows = (0..1_u32 << free.len()).into_par_iter().map(|mask| {
        let chosen: Window =
            free.iter().enumerate().filter(|(i, _)| mask >> i & 1 == 1).map(|(_, &at)| at).collect();
        rows_beyond(fixed | chosen, rules).ok_or_else(|| Fault(format!("{name}: {chosen:?} does not settle")))
    });
    let rows: Vec<i64> = rows.collect::<Result<_, _>>()?;
    let mut by_rows = BTreeMap::new();
    for row in rows {
        *by_rows.entry(row).or_insert(0) += 1;
    }
    Ok(Closures { name, by_rows })
}

/// Rows beyond the hull of a set that its closure reaches, the most over all six sides.
fn rows_beyond(set: Window, rules: &RuleSet) -> Option<i64> {
    let grid = closed(set, rules, |_| true)?;
    let sides = [|h: Hex| h.q, |h: Hex| h.r, |h: Hex| h.q + h.r];
    let beyond = sides.into_iter().flat_map(|x| {
        [1, -1].map(|sign| {
            let before = set.iter().map(|h| sign * x(h)).max();
            grid.subdivided()
                .map(|at| sign * x(at.hex))
                .max()
                .zip(before)
                .map_or(0, |(after, before)| after - before)
        })
    });
    beyond.max()
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

    #[test]
    fn rows_beyond_the_hull_are_counted() {
        let rules = RuleSet::extended();
        assert_eq!(rows_beyond(Window::EMPTY, &rules), Some(0));
        assert_eq!(rows_beyond(CENTRE.disc(1).collect(), &rules), Some(0));
        let found = of_kind("a disc", Window::EMPTY, &CENTRE.disc(1).collect::<Vec<_>>(), &rules).unwrap();
        assert_eq!(found.by_rows.values().sum::<u64>(), 128);
    }
}
