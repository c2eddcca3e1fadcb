//! That units neither overlap nor leave gaps.
//!
//! Each unit stands for a region of lattice triangles: one, or, for the stars of a run of
//! `MovedCenter3`, all that have one of the run as a corner. The border of what it emits must
//! be the *chains* of its region's border edges:
//!
//! ```text
//!   a leaf and another, or a subdivided one   two subdivided ones, m joined between
//!       v(a) -> v(b)                              a' -> m -> b'
//! ```
//!
//! A chain depends on the two hexagons alone, so that the regions on both sides of an edge
//! have it in opposite directions and fit.

use super::pattern::{CENTRE, Unit};
use hexdel_classify::dual::local::{self, LocalTriangle, Place};
use hexdel_classify::{Class, Classes};
use hexdel_grid::{Direction, Hex};
use std::collections::BTreeSet;

/// Checks one unit in one pattern. `Err` says what does not fit.
pub(crate) fn check(unit: Unit, classes: &Classes) -> Result<(), String> {
    match unit {
        Unit::Triangle { .. } => {
            let corners = unit.anchors();
            let mut tops = corners.iter().filter_map(|&at| top(classes, at));
            if let Some(first) = tops.next() {
                // Covered by the stars of one run.
                return if tops.all(|top| top == first) { Ok(()) } else { Err(fault("two runs", classes)) };
            }
            let mut emitted = Vec::new();
            unit.triangles(classes, |t| emitted.push(t));
            // Where all are subdivided the next level's triangles take over.
            let whole = emitted.is_empty() && corners.iter().all(|&at| classes.subdivided.contains(at));
            if whole { Ok(()) } else { fits(classes, &[corners], &emitted) }
        }
        Unit::Star { middle } => {
            let run = run_with(classes, middle);
            let mut emitted = Vec::new();
            for &at in &run {
                local::of_star(classes, at, |t| emitted.push(t));
            }
            fits(classes, &region(&run), &emitted)
        }
    }
}

/// The top of a `MovedCenter3`.
fn top(classes: &Classes, at: Hex) -> Option<Hex> {
    let middle = Direction::ALL.into_iter().find(|d| classes.middle[d.index()].contains(at))?;
    Some(at.neighbour(middle.opposite()))
}

/// The run around the centre of which the one in direction `middle` is part.
fn run_with(classes: &Classes, middle: Direction) -> Vec<Hex> {
    let under = |by: usize| classes.under_of(CENTRE) >> middle.turned(by).index() & 1 == 1;
    let (mut first, mut last) = (0, 0);
    while last < 5 && under(last + 1) {
        last += 1;
    }
    while first + last < 5 && under(6 - (first + 1)) {
        first += 1;
    }
    (6 - first..=6 + last).map(|by| CENTRE.neighbour(middle.turned(by % 6))).collect()
}

/// All lattice triangles with a corner in a run, counter-clockwise.
fn region(run: &[Hex]) -> Vec<[Hex; 3]> {
    let around = |at: Hex| Direction::ALL.map(|d| [at, at.neighbour(d), at.neighbour(d.turned(1))]);
    let mut all: Vec<[Hex; 3]> = run.iter().flat_map(|&at| around(at)).collect();
    let key = |t: &[Hex; 3]| {
        let mut sorted = *t;
        sorted.sort_unstable();
        sorted
    };
    all.sort_by_key(key);
    all.dedup_by_key(|t| key(t));
    all
}

/// Whether the border of what is emitted is the chains of the region's border.
fn fits(classes: &Classes, region: &[[Hex; 3]], emitted: &[LocalTriangle]) -> Result<(), String> {
    let sides = |t: &[Hex; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
    let inside: BTreeSet<(Hex, Hex)> = region.iter().flat_map(sides).collect();
    let border = inside.iter().filter(|&&(a, b)| !inside.contains(&(b, a)));
    let expected: BTreeSet<(Place, Place)> = border.flat_map(|&(a, b)| chain(classes, a, b)).collect();
    if expected
        .iter()
        .any(|(a, _)| matches!(a, Place::Leaf(at) if classes.class_of(*at) == Class::MovedCenter3))
    {
        return Err(fault("two runs", classes));
    }
    let edges = emitted.iter().flat_map(|t| [0, 1, 2].map(|i| (t.places[i], t.places[(i + 1) % 3])));
    let mut found = BTreeSet::new();
    if !edges.clone().all(|edge| found.insert(edge)) {
        return Err(fault("an edge twice", classes));
    }
    let open: BTreeSet<_> = found.iter().copied().filter(|&(a, b)| !found.contains(&(b, a))).collect();
    if open == expected { Ok(()) } else { Err(fault("a border that does not fit", classes)) }
}

/// The edges that stand for the border between two neighbours.
fn chain(classes: &Classes, a: Hex, b: Hex) -> Vec<(Place, Place)> {
    let subdivided = |at| classes.subdivided.contains(at);
    let place = |at: Hex| if subdivided(at) { Place::Finer(at.scaled()) } else { Place::Leaf(at) };
    if subdivided(a) && subdivided(b) {
        let joined = Place::Finer(a + b);
        vec![(place(a), joined), (joined, place(b))]
    } else {
        vec![(place(a), place(b))]
    }
}

fn fault(what: &str, classes: &Classes) -> String {
    format!("{what}: {:?}", classes.subdivided.iter().map(|h| (h.q, h.r)).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_classify::View;
    use hexdel_grid::Window;
    use hexdel_refine::extended::TopWithFins;
    use hexdel_refine::{Rule, Situation};

    #[test]
    fn a_missing_triangle_and_one_too_many_are_found() {
        let classes = Classes::of(Window::EMPTY);
        let unit = Unit::Triangle { up: true };
        let mut emitted = Vec::new();
        unit.triangles(&classes, |t| emitted.push(t));
        let region = [unit.anchors()];
        fits(&classes, &region, &emitted).unwrap();
        assert!(fits(&classes, &region, &[]).is_err());
        assert!(fits(&classes, &region, &[emitted[0], emitted[0]]).is_err());
    }

    #[test]
    fn a_run_is_found_from_each_of_it() {
        let classes = Classes::of(CENTRE.ring(2).collect());
        for middle in Direction::ALL {
            let run: BTreeSet<Hex> = run_with(&classes, middle).into_iter().collect();
            assert_eq!(run, CENTRE.ring(1).collect());
            check(Unit::Star { middle }, &classes).unwrap();
        }
    }

    #[test]
    fn two_runs_at_one_triangle_are_found() {
        // Two three-finned hexagons side by side, fins outwards: each is the other's top.
        let (x, y) = (CENTRE, CENTRE.neighbour(Direction::new(0)));
        let fins = [2, 3, 4].map(|d| x.neighbour(Direction::new(d)));
        let others = [5, 0, 1].map(|d| y.neighbour(Direction::new(d)));
        let classes = Classes::of(fins.into_iter().chain(others).collect());
        assert_eq!([x, y].map(|at| top(&classes, at)), [Some(y), Some(x)]);
        assert!(Unit::Triangle { up: true }.anchors().starts_with(&[x, y]));
        assert!(check(Unit::Triangle { up: true }, &classes).unwrap_err().contains("two runs"));
        // No legal pattern has it: a top has no fins.
        let situation = Situation::of(View { subdivided: classes.subdivided, ..View::default() });
        assert!(TopWithFins.must_subdivide(&situation).contains(x));
    }
}
