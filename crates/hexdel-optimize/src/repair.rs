//! Brings all angles inside the bounds: motion first, then changes of topology
//! near what is left, then more vertices.
//!
//! A step that does not settle its patch is kept only where it lowers the
//! energy by a tenth, so that a bad spot can be worked off in several steps
//! but not wander. Where there are segments, a round of steps is kept only if
//! it leaves no more triangles outside.

use crate::change::{Action, Finder, apply};
use crate::decimate::{PATIENT, Pass, try_remove};
use crate::mesh::{Mesh, Motion};
use crate::patch::{State, Sweeps, Swept};
use crate::spread::Reach;
use crate::work::{Effort, Work};

/// What one round does to each bad triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Step {
    /// Moves up to this many rings around the triangle.
    Move { rings: usize },
    /// Tries so many changes of topology at the triangle, or around it if
    /// `wide`, and moves up to so many rings.
    Search { changes: usize, rings: usize, wide: bool },
    /// Removes vertices of three rings around the triangle; one that has no
    /// corner that can move is split.
    Thin,
    /// Splits the sides of the triangle.
    Refine,
}

/// The rounds, until nothing is bad.
pub(crate) fn step(round: usize) -> Step {
    match round {
        0 => Step::Move { rings: 2 },
        1 | 2 => Step::Move { rings: 3 },
        3 => Step::Search { changes: 10, rings: 2, wide: false },
        4 => Step::Search { changes: 20, rings: 3, wide: false },
        r if r % 4 == 1 => Step::Thin,
        r if r % 8 == 3 && r > 8 => Step::Refine,
        r if r % 4 == 2 => Step::Search { changes: 30, rings: 3, wide: r > 8 },
        _ => Step::Search { changes: 60, rings: 4, wide: true },
    }
}

/// The motions that come before each pass of removals.
pub(crate) const MOVES: [&[usize]; 2] = [&[0, 1], &[2]];

/// The steps of each round of search, after which a mesh is given up.
pub(crate) const SEARCH: [(usize, usize); 7] =
    [(3, 7), (7, 11), (11, 15), (15, 19), (19, 23), (23, 27), (27, 31)];

/// Energy has to fall below this share for an unsolved patch to be kept.
const KEEP_BELOW: f64 = 0.9;

/// Energy up to which a change that is meant to give room is kept: a few
/// corners some degrees outside, which motion and search can settle.
const TOLERATED: f64 = 0.1;

/// How much is done for each bad triangle.
struct Care {
    motion: Effort,
    screen: Effort,
    /// Changes that are worked out after screening.
    finalists: usize,
}

/// Starts of points have a bad triangle for each point, most of which any of several
/// changes settles, and what one round leaves the next one tries.
const CURSORY: Care = Care {
    motion: Effort { sweeps: MOTION, turns: 3, near: 0.3, steps: 4 },
    screen: Effort { sweeps: Sweeps { most: 16, hope: 0.5, ..MOTION }, turns: 1, near: 0.3, steps: 2 },
    finalists: 1,
};

/// Where there are segments bad triangles are few and hard.
const THOROUGH: Care = Care {
    motion: Effort { sweeps: MOTION, turns: 2, near: 0.3, steps: 4 },
    screen: Effort { sweeps: Sweeps { most: 16, ..MOTION }, turns: 2, near: 1.0, steps: 2 },
    finalists: 4,
};

impl Care {
    fn of(mesh: &Mesh) -> &'static Self {
        if mesh.is_constrained() { &THOROUGH } else { &CURSORY }
    }
}

const MOTION: Sweeps = Sweeps { most: 40, stall: 0.7, hope: f64::INFINITY };
const FINISH: Effort =
    Effort { sweeps: Sweeps { most: 40, stall: 0.8, hope: f64::INFINITY }, turns: 3, near: 0.3, steps: 8 };

const THIN: Pass = Pass { rings: 3, refills: 2, max_cost: 0.8, near: 0.05, patience: PATIENT };

/// One round over the bad triangles.
pub(crate) fn repair(work: &mut Work, step: Step) {
    // Vertices of patches that did not settle: what they could not do for one
    // triangle they need not try for the next.
    let mut tried = vec![false; work.mesh.pos.len()];
    for t in work.bad() {
        if work.visits() >= work.allowance {
            return;
        }
        if !work.is_bad(t) || work.hopeful_only && work.is_hopeless(t) {
            continue;
        }
        match step {
            Step::Move { rings } => {
                let free = |v: &&u32| !work.mesh.is_fixed(**v);
                if work.mesh.tri[t as usize].v.iter().filter(free).all(|v| tried[*v as usize]) {
                    continue;
                }
                if !move_rings(work, t, rings) {
                    work.patch.movable().iter().for_each(|v| tried[*v as usize] = true);
                }
            }
            Step::Search { changes, rings, wide } => {
                if !move_rings(work, t, rings) && work.is_bad(t) {
                    try_changes(work, t, changes, rings, wide);
                }
            }
            Step::Thin if has_no_room(&work.mesh, t) => refine(work, t, f64::INFINITY),
            Step::Thin => thin(work, t),
            Step::Refine => refine(work, t, TOLERATED),
        }
    }
}

/// Moves what is bad before pass `pass` of removals.
pub(crate) fn moves(work: &mut Work, pass: usize) {
    let steps = MOVES.get(pass).copied().unwrap_or_default();
    without_loss(work, |work| steps.iter().for_each(|&i| repair(work, step(i))));
}

/// Steps `from..to`, as long as triangles are bad.
pub(crate) fn search(work: &mut Work, (from, to): (usize, usize)) {
    without_loss(work, |work| (from..to).for_each(|i| repair(work, step(i))));
}

/// Does `job` and, in a mesh with segments, takes it back if it leaves more
/// triangles outside than it has found: a patch that does not settle may hand
/// its fault to triangles that were good, and the start of a PSLG has few that
/// are not.
fn without_loss(work: &mut Work, job: impl FnOnce(&mut Work)) {
    if !work.mesh.is_constrained() {
        return job(work);
    }
    let many = work.bad().len();
    if many == 0 {
        return;
    }
    let before = (work.mesh.clone(), work.failed.clone());
    job(work);
    if work.bad().len() > many {
        (work.mesh, work.failed) = before;
    }
}

/// Loads the patch of so many rings around triangle `t`.
pub(crate) fn load_rings(work: &mut Work, verts: &[u32], rings: usize) {
    work.load(verts);
    for _ in 1..rings {
        work.grow();
    }
}

/// Moves up to so many rings around `t`; true when that settled all of it.
///
/// Among segments each ring is given up before the next one moves, as rings have
/// other bounds there.
fn move_rings(work: &mut Work, t: u32, rings: usize) -> bool {
    let corners = work.mesh.tri[t as usize].v;
    let first = if work.mesh.is_constrained() {
        1
    } else {
        let reach =
            Reach { rings: rings as u8, most: MOTION.most, stall: MOTION.stall, hope: [MOTION.hope; 4] };
        let settled = work.spread(&corners, reach) == Swept::Settled;
        if keep_if_solved(work, settled) {
            return true;
        }
        work.mesh.rollback();
        rings
    };
    (first..=rings).any(|r| move_patch(work, &corners, r, r == rings))
}

/// Moves the patch of so many rings; the last one is kept where it comes nearer, too.
fn move_patch(work: &mut Work, corners: &[u32], rings: usize, last: bool) -> bool {
    let motion = Care::of(&work.mesh).motion;
    load_rings(work, corners, rings);
    let before = work.patch.state(work.rules).energy;
    let state = work.solve(if last { motion } else { Effort { near: 0.0, ..motion } });
    if keep_if_solved(work, state.solved) {
        return true;
    }
    if last && state.energy < KEEP_BELOW * before && work.stays_valid() {
        work.commit();
    } else {
        work.mesh.rollback();
    }
    false
}

/// Tries changes of topology near `t`, best first, and keeps the first that
/// settles everything; or else works out those that lower the energy most.
fn try_changes(work: &mut Work, t: u32, most: usize, rings: usize, wide: bool) {
    let corners = work.mesh.tri[t as usize].v;
    let mut changes = Vec::new();
    load_rings(work, &corners, if wide { 2 } else { 1 });
    let around = work.patch.vertices().to_vec();
    Finder { mesh: &work.mesh, rules: work.rules, refills: work.refills, out: &mut changes }.find(t, &around);
    let care = Care::of(&work.mesh);
    let mut ranked: Vec<(f64, Action)> = Vec::new();
    for change in changes.into_iter().take(most) {
        let Some((before, state)) = attempt(work, change.action, corners, 1, care.screen) else {
            continue;
        };
        if keep_if_solved(work, state.solved) {
            return;
        }
        work.mesh.rollback();
        ranked.push((state.energy - before, change.action));
    }
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
    ranked.truncate(care.finalists);
    work_out(work, &ranked, corners, rings);
}

/// Moves ever more rings around each of some changes: kept is the first that settles
/// everything, or else what lowers the energy most.
fn work_out(work: &mut Work, ranked: &[(f64, Action)], corners: [u32; 3], rings: usize) {
    let mut best: Option<(f64, Action, usize)> = None;
    for &(_, action) in ranked {
        for r in 2..=rings.max(2) {
            let Some((before, state)) = attempt(work, action, corners, r, FINISH) else {
                continue;
            };
            if keep_if_solved(work, state.solved) {
                return;
            }
            let valid = work.stays_valid();
            work.mesh.rollback();
            let gain = state.energy - before;
            if valid && state.energy < KEEP_BELOW * before && best.is_none_or(|b| gain < b.0) {
                best = Some((gain, action, r));
            }
        }
    }
    if let Some((_, action, r)) = best
        && attempt(work, action, corners, r, FINISH).is_some()
    {
        work.commit();
    }
}

fn keep_if_solved(work: &mut Work, solved: bool) -> bool {
    work.stats.repairs[0] += 1;
    let solved = solved && work.changes_hold();
    if solved {
        work.stats.repairs[1] += 1;
        work.commit();
    }
    solved
}

/// Makes a change and settles so many rings around it; returns the energy of
/// the same region before and its state after. The change stays in the
/// journal.
fn attempt(
    work: &mut Work,
    action: Action,
    corners: [u32; 3],
    rings: usize,
    effort: Effort,
) -> Option<(f64, State)> {
    let mut verts = Vec::new();
    action.region(&work.mesh, &mut verts);
    let join = |verts: &mut Vec<u32>| {
        for v in corners {
            if !verts.contains(&v) {
                verts.push(v);
            }
        }
    };
    join(&mut verts);
    load_rings(work, &verts, rings);
    let before = work.patch.state(work.rules).energy;
    if !apply(&mut work.mesh, (work.rules, work.refills), action, &mut verts) {
        work.mesh.rollback();
        return None;
    }
    join(&mut verts);
    verts.retain(|&v| work.mesh.alive(v));
    load_rings(work, &verts, rings);
    Some((before, work.solve(effort)))
}

/// Removes vertices near `t`, small neighbourhoods first, as long as `t` is bad.
fn thin(work: &mut Work, t: u32) {
    let corners = work.mesh.tri[t as usize].v;
    load_rings(work, &corners, 3);
    let mut near: Vec<(f64, u32)> =
        work.patch.movable().iter().map(|&v| (work.mesh.shortest_edge(v), v)).collect();
    near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    for (_, v) in near {
        if work.mesh.alive(v) && try_remove(work, v, THIN) && !work.is_bad(t) {
            return;
        }
    }
}

/// Whether `t` joins three vertices that never move.
fn has_no_room(mesh: &Mesh, t: u32) -> bool {
    mesh.tri[t as usize].v.iter().all(|v| mesh.motion[*v as usize] == Motion::Fixed)
}

/// Splits the three sides of `t`; kept if the energy stays below `below` or
/// what it was. New vertices give room to rounds to come.
fn refine(work: &mut Work, t: u32, below: f64) {
    let mut verts = work.mesh.tri[t as usize].v.to_vec();
    load_rings(work, &verts, 3);
    let before = work.patch.state(work.rules).energy;
    let mut made = Vec::new();
    for i in 0..3 {
        let (a, b) = (verts[i], verts[(i + 1) % 3]);
        // The first split replaces `t`: find the side by its ends.
        if let Some((t, k)) = work.mesh.side(a, b) {
            verts.extend(work.mesh.split_edge(t, k, &mut made));
        }
    }
    load_rings(work, &verts, 3);
    if work.solve(FINISH).energy < below.max(before) && work.stays_valid() {
        work.commit();
    } else {
        work.mesh.rollback();
    }
}
