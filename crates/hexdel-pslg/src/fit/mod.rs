//! Brings the angles around segments within their bounds.
//!
//! Two phases. The first visits bad triangles and moves what is around them,
//! flipping edges on the way; nearly all end there. The second, for what is
//! left, also tries to collapse and divide edges and to insert vertices, and
//! keeps what works best. No change is kept that does not lower the sum of the
//! squares of what angles are past their bounds by.
//!
//! | module | what |
//! |---|---|
//! | [`judge`] | what is wrong with a triangle |
//! | [`levenberg`] | moving vertices by damped least squares |
//! | [`patch`] | what may change around a bad triangle; flips |
//! | [`edits`] | changes of connectivity to try |

pub(crate) mod edits;
pub(crate) mod judge;
pub(crate) mod levenberg;
pub(crate) mod patch;

use crate::net::{Kind, NONE, Net};
use crate::options::Deadline;
use edits::{Edit, edits};
use hexdel_geom::monitor::{Cancelled, Monitor, Phase, check};
use judge::{FAR_RING, Judge, is_starved};
use levenberg::Levenberg;
use patch::Patch;
use rustc_hash::{FxHashSet, FxHasher};
use std::hash::{Hash, Hasher};

/// The first phase: edges around a bad triangle that move, and how far from
/// points and segments.
const SWEEPS: [(u32, u32); 4] = [(0, 1), (1, 1), (1, 2), (2, 2)];

/// The second phase: the farthest ring that moves, and how many edits may
/// follow each other.
const SEARCHES: [(u32, u32); 5] = [(2, 1), (3, 1), (3, 2), (3, 2), (4, 2)];

/// Edits that are worked out after a first look at all.
const CANDIDATES: usize = 12;

/// Edits from which a second one is tried.
const BRANCHES: usize = 4;

/// Searches of depth two that may be in vain: each takes some tens of milliseconds,
/// and PSLGs that come out take less than ten.
const VAIN: usize = 16;

/// Bad triangles in a patch from which on no search of depth two is tried: of 82
/// with so many one settled.
const CROWD: usize = 10;

/// Searches in vain that one which settles its patch makes good.
const SETTLED: usize = 4;

/// Counts each vertex's edges to the nearest point or segment.
pub(crate) fn count_rings(net: &mut Net) {
    for v in 0..net.vertex_count() {
        let bound = matches!(net.vertex(v).kind, Kind::Site(_) | Kind::Along { .. });
        net.set_ring(v, if bound { 0 } else { NONE });
    }
    let mut front: Vec<u32> = (0..net.vertex_count()).filter(|&v| net.vertex(v).ring == 0).collect();
    let mut star = Vec::new();
    // Nobody asks how far away a vertex is beyond the widest patch.
    for ring in 1..=6 {
        let mut next = Vec::new();
        for v in front {
            net.star(v, &mut star);
            for w in star.iter().flat_map(|&t| net.tri(t).v).collect::<Vec<_>>() {
                if net.vertex(w).ring == NONE {
                    net.set_ring(w, ring);
                    next.push(w);
                }
            }
        }
        front = next;
    }
}

/// Triangles with an angle out of bounds.
pub(crate) fn bad_triangles(net: &Net, judge: Judge<'_>) -> Vec<u32> {
    net.alive().filter(|&t| judge.penalty(net, t) > 0.0).collect()
}

/// Optimises until all triangles keep their bounds, the sweeps are used up or the
/// time is over.
/// Triangles that are `excused`, because their surroundings have no room, get a
/// part of the effort only.
///
/// # Errors
///
/// [`Cancelled`], if the monitor asks for it.
pub(crate) fn optimise(
    net: &mut Net,
    judge: Judge<'_>,
    excused: &dyn Fn(&Net, u32) -> bool,
    deadline: &Deadline,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let mut solver = Levenberg::default();
    count_rings(net);
    feed(net);
    for (reach, ring) in SWEEPS {
        count_rings(net);
        let bad = bad_triangles(net, judge);
        for (i, &t) in bad.iter().enumerate() {
            watch(monitor, i, bad.len())?;
            if deadline.is_over() {
                break;
            }
            mend(net, judge, t, reach, ring, &mut solver);
        }
    }
    count_rings(net);
    let mut patience = Patience::new();
    for (sweep, (ring, depth)) in SEARCHES.into_iter().enumerate() {
        count_rings(net);
        let bad = bad_triangles(net, judge);
        for (i, &t) in bad.iter().enumerate() {
            watch(monitor, i, bad.len())?;
            if !net.tri(t).alive() || judge.penalty(net, t) == 0.0 || (sweep > 0 && excused(net, t)) {
                continue;
            }
            if deadline.is_over() {
                break;
            }
            let patch = Patch::around(net, t, 2, ring);
            if depth > 1 && !patience.has_hope(net, judge, t, &patch, ring) {
                continue;
            }
            let settled = search(net, judge, t, &patch, depth, &mut solver);
            if depth > 1 {
                patience.note(settled);
            }
            net.commit();
        }
    }
    count_rings(net);
    Ok(())
}

/// How long deep searches go on. Where several features crowd a spot none may settle
/// it, and each takes as long as thousands of ordinary triangles.
struct Patience {
    left: usize,
    /// Patches that have been searched, as they were.
    tried: FxHashSet<u64>,
}

impl Patience {
    fn new() -> Self {
        Self { left: VAIN, tried: FxHashSet::default() }
    }

    /// Whether a search around a triangle is worth its time: not in a crowd, nor where
    /// it would be the same as one before.
    fn has_hope(&mut self, net: &Net, judge: Judge<'_>, t: u32, patch: &Patch, ring: u32) -> bool {
        let bad = patch.tris.iter().filter(|&&t| judge.penalty(net, t) > 0.0).count();
        if self.left == 0 || bad >= CROWD {
            return false;
        }
        let mut hasher = FxHasher::default();
        (t, ring, patch.movable.len()).hash(&mut hasher);
        for &s in &patch.tris {
            (s, net.tri(s).v).hash(&mut hasher);
            net.corners(s).iter().for_each(|p| p.to_array().map(f64::to_bits).hash(&mut hasher));
        }
        self.tried.insert(hasher.finish())
    }

    fn note(&mut self, settled: bool) {
        self.left = if settled { self.left + SETTLED } else { self.left - 1 };
    }
}

/// Takes out free vertices near segments that have too few triangles.
fn feed(net: &mut Net) {
    let mut stack: Vec<u32> =
        (0..net.vertex_count()).rev().filter(|&v| net.vertex(v).ring <= FAR_RING + 1).collect();
    let mut star = Vec::new();
    while let Some(v) = stack.pop() {
        if net.vertex(v).kind != Kind::Free || !is_starved(net, v) {
            continue;
        }
        net.star(v, &mut star);
        let around: Vec<u32> = star.iter().flat_map(|&t| net.tri(t).v).filter(|&w| w != v).collect();
        if net.remove(v) {
            stack.extend(around);
        }
    }
}

fn watch(monitor: &dyn Monitor, done: usize, total: usize) -> Result<(), Cancelled> {
    if done.is_multiple_of(64) {
        monitor.progress(Phase::Optimize, done as u64, total as u64);
        check(monitor)?;
    }
    Ok(())
}

/// Moves and flips around a bad triangle, if that makes things better.
fn mend(net: &mut Net, judge: Judge<'_>, t: u32, reach: u32, ring: u32, solver: &mut Levenberg) {
    if !net.tri(t).alive() || judge.penalty(net, t) == 0.0 {
        return;
    }
    let patch = Patch::around(net, t, reach, ring);
    let before = judge.sum(net, &patch.tris);
    let mark = net.mark();
    if patch.improve(net, judge, solver) >= before {
        net.rollback(mark);
    }
    net.commit();
}

/// Tries edits around a bad triangle and keeps the best, if it is any good. Whether
/// all of the patch is in order then.
fn search(
    net: &mut Net,
    judge: Judge<'_>,
    t: u32,
    patch: &Patch,
    depth: u32,
    solver: &mut Levenberg,
) -> bool {
    let before = judge.sum(net, &patch.tris);
    let mut best: (f64, Vec<Edit>) = (before, Vec::new());
    let first = ranked(net, judge, t, patch, &[], solver);
    for edit in first.iter().take(CANDIDATES) {
        if consider(net, judge, patch, vec![*edit], &mut best, solver) {
            break;
        }
    }
    if depth > 1 && best.0 > 0.0 {
        'outer: for &edit in first.iter().take(BRANCHES) {
            for next in ranked(net, judge, t, patch, &[edit], solver).into_iter().take(CANDIDATES) {
                if consider(net, judge, patch, vec![edit, next], &mut best, solver) {
                    break 'outer;
                }
            }
        }
    }
    if best.0 < before {
        let left = carry_out(net, judge, patch, &best.1, true, solver);
        debug_assert!(left.is_some_and(|left| left == best.0), "the same edits do the same");
    }
    best.0 == 0.0
}

/// Works an edit out and remembers it if it is the best so far. Whether it is
/// perfect.
fn consider(
    net: &mut Net,
    judge: Judge<'_>,
    patch: &Patch,
    list: Vec<Edit>,
    best: &mut (f64, Vec<Edit>),
    solver: &mut Levenberg,
) -> bool {
    let mark = net.mark();
    if let Some(left) = carry_out(net, judge, patch, &list, true, solver)
        && left < best.0
    {
        *best = (left, list);
    }
    net.rollback(mark);
    best.0 == 0.0
}

/// All edits around a triangle that can follow some others, the most promising
/// first.
fn ranked(
    net: &mut Net,
    judge: Judge<'_>,
    t: u32,
    patch: &Patch,
    done: &[Edit],
    solver: &mut Levenberg,
) -> Vec<Edit> {
    let mark = net.mark();
    let Some(grown) = apply_all(net, patch, done) else {
        net.rollback(mark);
        return Vec::new();
    };
    let centre = if net.tri(t).alive() { t } else { grown.tris[0] };
    let possible = edits(net, centre, &grown.tris);
    net.rollback(mark);
    let mut scored: Vec<(f64, Edit)> = Vec::new();
    for edit in possible {
        let list: Vec<Edit> = done.iter().copied().chain([edit]).collect();
        let mark = net.mark();
        let left = carry_out(net, judge, patch, &list, false, solver);
        net.rollback(mark);
        scored.extend(left.map(|left| (left, edit)));
        // No other can be better.
        if left == Some(0.0) {
            break;
        }
    }
    // Stable: equals stay in the order they are listed in.
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    scored.into_iter().map(|(_, edit)| edit).collect()
}

/// Makes edits, and moves vertices a little or thoroughly. Returns the penalty
/// of what the patch has become.
fn carry_out(
    net: &mut Net,
    judge: Judge<'_>,
    patch: &Patch,
    list: &[Edit],
    thoroughly: bool,
    solver: &mut Levenberg,
) -> Option<f64> {
    let patch = apply_all(net, patch, list)?;
    if !thoroughly {
        solver.run(net, judge, &patch.movable, &patch.tris, 4);
        return Some(judge.sum(net, &patch.tris));
    }
    solver.run(net, judge, &patch.movable, &patch.tris, 12);
    if judge.sum(net, &patch.tris) > 0.0 {
        patch.flip(net, judge);
        solver.run(net, judge, &patch.movable, &patch.tris, 14);
    }
    Some(judge.sum(net, &patch.tris))
}

/// Makes edits one after the other; `None` if one is not possible.
fn apply_all(net: &mut Net, patch: &Patch, list: &[Edit]) -> Option<Patch> {
    let mark = net.mark();
    let first_new = net.vertex_count();
    if !list.iter().all(|edit| edit.apply(net)) {
        return None;
    }
    let patch = patch.after(net, &net.touched(mark), first_new);
    let starved = patch.tris.iter().flat_map(|&t| net.tri(t).v).any(|v| is_starved(net, v));
    (!starved).then_some(patch)
}
