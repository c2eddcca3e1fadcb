//! The enumeration: every legal pattern around a unit, and what its triangles
//! look like.
//!
//! Hexagons are decided one by one, subdivided or not, in the order of a
//! [`Plan`]; a pattern is given up as soon as a rule certainly asks for a
//! hexagon that it has decided not to subdivide. When the patch is complete the
//! places of all corners are known, and every angle is compared with the bounds
//! in integers. A pattern that breaks them is continued beyond the patch until
//! every continuation is given up; if one is not, and closing it under the
//! rules leaves the patch as it is, the bounds are refuted.

use super::closure;
use super::fires::Fires;
use super::pattern::{Plan, Unit};
use super::tiling;
use hexdel_classify::dual::local::{LocalTriangle, Place};
use hexdel_classify::{Classes, ExactBounds, Offset};
use hexdel_grid::Window;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A pattern and one of its triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Witness {
    /// The unit in the middle.
    pub(crate) unit: Unit,
    /// The subdivided hexagons, the patch and what closing it adds.
    pub(crate) subdivided: Window,
    /// The hexagons on which the triangles rest.
    pub(crate) patch: Window,
    /// The triangle's corners.
    pub(crate) corners: [Offset; 3],
    /// Which corner has the angle.
    pub(crate) corner: usize,
    /// The angle, degrees.
    pub(crate) angle_deg: f64,
}

/// The triangles of one kind.
#[derive(Clone, Debug, Default)]
pub(crate) struct Kind {
    /// Legal patterns of the patch.
    pub(crate) patterns: u64,
    /// Those that are least among their images under the unit's symmetries.
    pub(crate) orbits: u64,
    /// Triangles looked at.
    pub(crate) triangles: u64,
    /// The smallest and the largest angle, degrees, over all patterns of the
    /// patch; those that are not legal in any larger one are among them.
    pub(crate) range_deg: Option<(f64, f64)>,
    /// The smallest angle, by a pattern that the rules leave as it is.
    pub(crate) least: Option<Witness>,
    /// The largest one.
    pub(crate) greatest: Option<Witness>,
}

/// What a search found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Found {
    /// By name.
    pub(crate) kinds: BTreeMap<String, Kind>,
    /// Patterns in which the unit was held against the units around it.
    pub(crate) fitted: u64,
    /// Patterns in which units overlap or leave gaps: the proof has failed.
    pub(crate) gaps: Vec<String>,
    /// The least square of an edge's length, in units of `1 / (2 UNIT^2)` of the square of the
    /// spacing of the finest level that the unit shows to have leaves.
    pub(crate) shortest: Option<i64>,
    /// Patterns begun and given up or completed.
    pub(crate) steps: u64,
    /// Patterns whose triangles break the bounds and that no continuation
    /// makes legal.
    pub(crate) refused: u64,
    /// Angles of legal configurations that break the bounds: the proof has
    /// failed.
    pub(crate) counterexamples: Vec<Witness>,
    /// Angles of patterns that break the bounds and could neither be given up nor
    /// closed: the proof has failed as well.
    pub(crate) undecided: Vec<Witness>,
    /// Finer corners without a semi-hexagon beside them, which finer levels
    /// might move: the proof has failed.
    pub(crate) unprotected: Vec<Place>,
}

impl Found {
    /// Whether every triangle of every legal pattern keeps the bounds.
    pub(crate) fn proved(&self) -> bool {
        self.counterexamples.is_empty()
            && self.undecided.is_empty()
            && self.unprotected.is_empty()
            && self.gaps.is_empty()
    }

    /// Adds what another search found.
    pub(crate) fn merge(&mut self, other: Self) {
        self.steps += other.steps;
        self.refused += other.refused;
        self.fitted += other.fitted;
        self.gaps.extend(other.gaps);
        self.shortest = self.shortest.into_iter().chain(other.shortest).min();
        self.counterexamples.extend(other.counterexamples);
        self.undecided.extend(other.undecided);
        self.unprotected.extend(other.unprotected);
        for (name, kind) in other.kinds {
            let mine = self.kinds.entry(name).or_default();
            mine.patterns += kind.patterns;
            mine.orbits += kind.orbits;
            mine.triangles += kind.triangles;
            if let Some((least, greatest)) = kind.range_deg {
                widen(&mut mine.range_deg, least);
                widen(&mut mine.range_deg, greatest);
            }
            keep(&mut mine.least, kind.least, |new, old| new < old);
            keep(&mut mine.greatest, kind.greatest, |new, old| new > old);
        }
    }
}

/// Angles that differ by less are the same one, reached by other sums: the
/// first witness stays.
const SAME_DEG: f64 = 1e-9;

fn widen(range: &mut Option<(f64, f64)>, angle: f64) {
    let (least, greatest) = range.unwrap_or((angle, angle));
    *range = Some((least.min(angle), greatest.max(angle)));
}

fn keep(mine: &mut Option<Witness>, new: Option<Witness>, better: impl Fn(f64, f64) -> bool) {
    if let Some(new) = new
        && mine.is_none_or(|old| better(new.angle_deg, old.angle_deg))
        && mine.is_none_or(|old| (new.angle_deg - old.angle_deg).abs() > SAME_DEG)
    {
        *mine = Some(new);
    }
}

/// Failures of one task after which patterns that break the bounds are closed
/// as they are, but no longer continued: the proof has failed, and what is left
/// to find is the worst.
const ENOUGH: usize = 20;

/// What becomes of a pattern beyond its patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum End {
    /// A legal state of the grid holds it: the pattern and what the rules add
    /// around it.
    Legal(Window),
    /// No legal state does.
    Dead,
    /// Neither was shown.
    Unknown,
}

/// Hexagons decided before the search is split into tasks.
const PREFIX: usize = 9;

/// Enumerates the legal patterns around a unit.
pub(crate) fn search(unit: Unit, fires: &Fires) -> Found {
    let plan = Plan::new(unit);
    let mut start = Search { plan: &plan, fires, found: Found::default() };
    let mut prefixes = Vec::new();
    start.decide(0, PREFIX, plan.given, &mut |_, pattern| prefixes.push(pattern));
    let parts: Vec<Found> = prefixes
        .into_par_iter()
        .map(|pattern| {
            let mut part = Search { plan: &plan, fires, found: Found::default() };
            part.decide(PREFIX, plan.patch, pattern, &mut Search::complete);
            part.found
        })
        .collect();
    let mut found = start.found;
    for part in parts {
        found.merge(part);
    }
    found
}

struct Search<'a> {
    plan: &'a Plan,
    fires: &'a Fires,
    found: Found,
}

impl Search<'_> {
    /// Decides the hexagons from `depth` to `until`, both ways each, and hands
    /// on what is not given up.
    fn decide(
        &mut self,
        depth: usize,
        until: usize,
        pattern: Window,
        then: &mut impl FnMut(&mut Self, Window),
    ) {
        if depth == until {
            then(self, pattern);
            return;
        }
        let at = self.plan.order[depth];
        for subdivided in [false, true] {
            let mut next = pattern;
            if subdivided {
                next.insert(at);
            }
            self.found.steps += 1;
            if !self.fires.certainly(self.plan, depth + 1, at, next) {
                self.decide(depth + 1, until, next, then);
            }
        }
    }

    /// Looks at the triangles of a complete patch.
    fn complete(&mut self, pattern: Window) {
        let (plan, classes) = (self.plan, Classes::of(pattern));
        let (mut triangles, mut broken) = (Vec::new(), None);
        plan.unit.triangles(&classes, |t| triangles.push(t));
        self.found.fitted += 1;
        self.found.gaps.extend(tiling::check(plan.unit, &classes).err());
        for t in &triangles {
            self.found.unprotected.extend(unprotected(&classes, t));
            if broken.is_none() && !ExactBounds::EXTENDED.hold(t.corners) {
                broken = Some(*t);
            }
        }
        if let Some(t) = broken {
            self.refute(pattern, t);
        } else if !triangles.is_empty() {
            self.count(pattern, &classes, &triangles);
        }
    }

    fn count(&mut self, pattern: Window, classes: &Classes, triangles: &[LocalTriangle]) {
        let kind = self.found.kinds.entry(self.plan.unit.kind(classes)).or_default();
        kind.patterns += 1;
        kind.orbits += u64::from(self.plan.is_least(pattern));
        kind.triangles += triangles.len() as u64;
        let lengths = triangles.iter().map(|t| shortest(t, pattern));
        self.found.shortest = self.found.shortest.into_iter().chain(lengths).min();
        let mut closed = None;
        for witness in triangles.iter().flat_map(|t| self.plan.witnesses(pattern, t)) {
            let angle = witness.angle_deg;
            widen(&mut kind.range_deg, angle);
            let less = kind.least.is_none_or(|w| angle < w.angle_deg - SAME_DEG);
            let more = kind.greatest.is_none_or(|w| angle > w.angle_deg + SAME_DEG);
            if !less && !more {
                continue;
            }
            // Only a pattern that the rules leave as it is shows that an
            // angle is attained.
            let all = *closed.get_or_insert_with(|| closure::around(self.plan, pattern, &self.fires.rules));
            let Some(subdivided) = all else { continue };
            let witness = Some(Witness { subdivided, ..witness });
            if less {
                kind.least = witness;
            }
            if more {
                kind.greatest = witness;
            }
        }
    }

    /// Continues a pattern that breaks the bounds until the rules forbid it.
    fn refute(&mut self, pattern: Window, broken: LocalTriangle) {
        let known = self.found.counterexamples.len() + self.found.undecided.len();
        let budget = if known < ENOUGH { Budget::new(50, 200_000) } else { Budget::new(1, 1) };
        match self.end_of(pattern, budget) {
            End::Legal(subdivided) => {
                let broken = self.plan.broken_angles(pattern, &broken);
                self.found.counterexamples.extend(broken.map(|w| Witness { subdivided, ..w }));
            }
            End::Dead => self.found.refused += 1,
            End::Unknown => self.found.undecided.extend(self.plan.broken_angles(pattern, &broken)),
        }
    }

    /// What becomes of a pattern of the patch beyond it.
    fn end_of(&mut self, pattern: Window, mut budget: Budget) -> End {
        let (plan, rules) = (self.plan, &self.fires.rules);
        if let Some(whole) = closure::around(plan, pattern, rules) {
            return End::Legal(whole);
        }
        let mut legal = None;
        let stopped = self.first(plan.patch, pattern, &mut budget, &mut |continued| {
            legal = closure::around(plan, continued, rules);
            legal.is_some()
        });
        match legal {
            Some(whole) => End::Legal(whole),
            None if stopped || budget.open => End::Unknown,
            None => End::Dead,
        }
    }

    /// Continues a pattern to the end of the plan; stops when told to or when
    /// the budget is used up, and says whether it did.
    fn first(
        &mut self,
        depth: usize,
        pattern: Window,
        budget: &mut Budget,
        stop: &mut impl FnMut(Window) -> bool,
    ) -> bool {
        let Some(&at) = self.plan.order.get(depth) else {
            budget.closures = budget.closures.saturating_sub(1);
            budget.open = true;
            return stop(pattern) || budget.closures == 0;
        };
        for subdivided in [false, true] {
            let mut next = pattern;
            if subdivided {
                next.insert(at);
            }
            self.found.steps += 1;
            budget.steps = budget.steps.saturating_sub(1);
            if budget.steps == 0 {
                return true;
            }
            if !self.fires.certainly(self.plan, depth + 1, at, next)
                && self.first(depth + 1, next, budget, stop)
            {
                return true;
            }
        }
        false
    }
}

/// How far a pattern is continued before it is left open.
#[derive(Clone, Copy, Debug)]
struct Budget {
    /// Continuations that are closed under the rules.
    closures: u32,
    /// Hexagons that are decided.
    steps: u64,
    /// Whether a continuation reached the end and was not legal as it is.
    open: bool,
}

impl Budget {
    const fn new(closures: u32, steps: u64) -> Self {
        Self { closures, steps, open: false }
    }
}

impl Plan {
    /// The three angles of a triangle.
    fn witnesses(&self, subdivided: Window, t: &LocalTriangle) -> [Witness; 3] {
        let p = t.corners.map(Offset::cartesian);
        std::array::from_fn(|i| {
            let (u, w) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            Witness {
                unit: self.unit,
                subdivided,
                patch: self.members.iter().copied().collect(),
                corners: t.corners,
                corner: i,
                angle_deg: u.perp_dot(w).atan2(u.dot(w)).to_degrees(),
            }
        })
    }

    /// The angles of a triangle that are beyond the bounds, exactly: of a triangle
    /// that does not hold there is always one.
    fn broken_angles(&self, subdivided: Window, t: &LocalTriangle) -> impl Iterator<Item = Witness> + use<> {
        let [a, b, c] = t.corners;
        let holds = [(a, b, c), (b, c, a), (c, a, b)].map(|(a, b, c)| ExactBounds::EXTENDED.hold_at(a, b, c));
        self.witnesses(subdivided, t).into_iter().filter(move |w| !holds[w.corner])
    }
}

/// The square of a triangle's shortest edge, as [`Found::shortest`] has it. Where something is
/// subdivided, the next level has leaves.
fn shortest(t: &LocalTriangle, subdivided: Window) -> i64 {
    let [a, b, c] = t.corners;
    let scale = if subdivided.is_empty() { 1 } else { 4 };
    [b - a, c - b, a - c].map(|side| scale * side.dot2(side)).into_iter().min().unwrap_or(i64::MAX)
}

/// The finer corners of a triangle, other than inserted points, that lie
/// beside no semi-hexagon.
fn unprotected(classes: &Classes, t: &LocalTriangle) -> Vec<Place> {
    let made = |at| classes.subdivided.contains(at);
    let semi = |at: hexdel_grid::Hex| matches!(at.parents(), (a, Some(b)) if made(a) != made(b));
    let open = |place: &Place| match place {
        Place::Leaf(_) => false,
        Place::Finer(at) => !semi(*at) && !at.neighbours().any(semi),
    };
    t.places.into_iter().filter(open).collect()
}
