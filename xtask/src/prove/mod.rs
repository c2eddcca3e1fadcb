//! `cargo xtask prove`: every triangle of the relocated dual keeps 43.9 to 90
//! degrees, by enumeration.
mod closure;
mod fires;
mod lemmas;
mod pattern;
mod regions;
mod search;

use crate::Outcome;
use hexdel_refine::RuleSet;

pub(crate) fn run(without: &[String], reduced: bool) -> Outcome {
    let rules = without.iter().fold(RuleSet::extended(), |r, n| r.without(n));
    let fires = fires::Fires::new(rules);
    let units = if reduced { pattern::Unit::representatives() } else { pattern::Unit::all() };
    let mut found = search::Found::default();
    for unit in units {
        let t = std::time::Instant::now();
        let f = search::search(unit, &fires);
        println!("{unit:?}: steps {} refused {} {:?}", f.steps, f.refused, t.elapsed());
        found.merge(f);
    }
    for (name, k) in &found.kinds {
        println!("{name}: {} {} {} {:?} {:?} {:?}", k.patterns, k.orbits, k.triangles, k.range_deg, k.least.map(|w| w.angle_deg), k.greatest.map(|w| w.angle_deg));
    }
    println!("refused {} counter {} undecided {} unprotected {}", found.refused, found.counterexamples.len(), found.undecided.len(), found.unprotected.len());
    for w in found.counterexamples.iter().chain(&found.undecided).take(12) {
        println!("{:?} {} {:?}", w.unit, w.angle_deg, w.subdivided.iter().map(|h| (h.q, h.r)).collect::<Vec<_>>());
    }
    Ok(())
}
#[test]
fn tmp() {
    for r in regions::all() { println!("{r:?}"); }
    let t = std::time::Instant::now();
    println!("{:?} {:?}", lemmas::check(&RuleSet::extended(), 1), t.elapsed());
}
