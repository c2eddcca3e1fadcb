//! Removal of vertices, one at a time, each kept only where every angle holds.
//!
//! Small neighbourhoods go first: what is finest is what is most likely in
//! excess. Within that order the cost of the cheapest refill says whether an
//! attempt is worth its time, and passes raise the cost they accept.

use crate::mesh::Motion;
use crate::patch::Sweeps;
use crate::refill::MAX_CORNERS;
use crate::work::{Effort, Scratch, Work};

/// How hard one pass tries.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pass {
    /// Rings around the hole that may move in the end.
    pub(crate) rings: u8,
    /// Refills tried for each vertex.
    pub(crate) refills: usize,
    /// Refills that cost more are not tried.
    pub(crate) max_cost: f64,
    /// Energy below which Newton steps finish a patch, square radians.
    pub(crate) near: f64,
}

/// Energy after a ring has moved above which more rings seldom help, square
/// radians; measured: 0.3 gives up 2 % of the removals and saves a sixth of the
/// time that 1.0 takes.
const HOPELESS: f64 = 0.3;

/// The first pass has so many likely removals that flips do not pay.
const FIRST: Effort = Effort { sweeps: Sweeps { most: 30, stall: 0.4 }, turns: 1, near: 0.0, steps: 0 };

const REMOVAL: Effort = Effort { sweeps: Sweeps { most: 30, stall: 0.6 }, turns: 3, near: 0.0, steps: 6 };

/// The passes, each given a new partition of the mesh: cheap and likely
/// removals first. With the costs of `refill`, four of five attempts at 0.5
/// succeed while the mesh is fine; on a coarse one, one of ten. One ring is
/// enough for half of the removals from a fine start.
pub(crate) const PASSES: [Pass; 13] = [
    pass(1, 1, 0.5, 0.0),
    pass(2, 1, 0.5, 0.0),
    pass(2, 1, 0.5, 0.0),
    pass(2, 1, 0.5, 0.0),
    pass(2, 1, 0.6, 0.01),
    pass(3, 1, 0.5, 0.01),
    pass(3, 2, 0.6, 0.01),
    pass(4, 2, 0.6, 0.01),
    pass(4, 2, 0.6, 0.01),
    pass(4, 3, 0.7, 0.01),
    pass(5, 2, 0.6, 0.01),
    pass(5, 3, 0.7, 0.01),
    pass(5, 3, 0.7, 0.01),
];

const fn pass(rings: u8, refills: usize, max_cost: f64, near: f64) -> Pass {
    Pass { rings, refills, max_cost, near }
}

/// Tries every vertex once; returns how many were removed.
pub(crate) fn decimate(work: &mut Work, pass: Pass) -> usize {
    let mut order: Vec<(f64, u32)> = (0..work.mesh.pos.len() as u32)
        .filter(|&v| work.mesh.alive(v) && !work.mesh.is_fixed(v) && work.failed[v as usize] < pass.rings)
        .map(|v| (work.mesh.shortest_edge(v), v))
        .collect();
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut removed = 0;
    for (_, v) in order {
        removed += usize::from(work.mesh.alive(v) && try_remove(work, v, pass));
    }
    removed
}

/// Removes `v` unless it is known that this fails.
pub(crate) fn try_remove(work: &mut Work, v: u32, pass: Pass) -> bool {
    if work.failed[v as usize] >= pass.rings {
        return false;
    }
    let before = work.stats.removals[0];
    let done = remove(work, v, pass);
    if !done && work.stats.removals[0] > before {
        work.failed[v as usize] = pass.rings;
    }
    done
}

/// Removes `v` if a refill of its hole can be brought inside the bounds.
fn remove(work: &mut Work, v: u32, pass: Pass) -> bool {
    let mut s = std::mem::take(&mut work.scratch);
    let closed = work.mesh.ring(v, &mut s.tris, &mut s.ring);
    if matches!(work.mesh.motion[v as usize], Motion::On(_)) {
        let done = split_ring(work, v, &mut s, closed) && remove_from_segment(work, &mut s, pass);
        work.scratch = s;
        return done;
    }
    let slides = matches!(work.mesh.motion[v as usize], Motion::Along(_));
    let mut done = false;
    if (3..=MAX_CORNERS).contains(&s.ring.len())
        && closed != slides
        && work.rules.can_cover(&work.mesh, &s.tris, s.ring.len() - 2)
    {
        work.refills.choose(&work.mesh, work.rules, (&s.tris, &s.ring), closed, pass.refills, &mut s.chosen);
        for &(cost, index) in &s.chosen {
            if cost > pass.max_cost || !work.refills.triangles(&work.mesh, &s.ring, closed, index, &mut s.new)
            {
                continue;
            }
            s.made.clear();
            work.mesh.replace(&s.tris, &s.new, &mut s.made);
            work.stats.removals[0] += 1;
            done = settle(work, &s.ring, pass);
            if done {
                work.stats.removals[1] += 1;
                work.commit();
                break;
            }
            work.mesh.rollback();
        }
    }
    work.scratch = s;
    done
}

/// Moves ever more rings around `verts` until everything changed holds.
pub(crate) fn settle(work: &mut Work, verts: &[u32], pass: Pass) -> bool {
    work.load(verts);
    let effort = if pass.rings == 1 { FIRST } else { Effort { near: pass.near, ..REMOVAL } };
    for ring in 1..=pass.rings {
        if ring > 1 {
            work.grow();
        }
        let state = work.solve(effort);
        if state.solved {
            return work.changes_hold();
        }
        if state.energy > HOPELESS {
            return false;
        }
    }
    false
}

/// Turns the ring around a vertex on a segment so that it starts at a
/// neighbour on the segment; `false` where the segment does not go through it.
fn split_ring(work: &Work, v: u32, s: &mut Scratch, closed: bool) -> bool {
    s.split = s.ring.len() - 1;
    if !closed {
        return s.ring.len() <= MAX_CORNERS;
    }
    // The side from `v` to the ring's vertex `i` is opposite the next one.
    let stays = |i: &usize| {
        let tri = work.mesh.tri[s.tris[*i] as usize];
        tri.is_bound((tri.corner(v) + 2) % 3)
    };
    let bound: Vec<usize> = (0..s.tris.len()).filter(stays).collect();
    let [first, second] = *bound else { return false };
    s.tris.rotate_left(first);
    s.ring.rotate_left(first);
    s.split = second - first;
    // Both halves have the two neighbours on the segment.
    let halves = [s.split + 1, s.ring.len() - s.split + 1];
    halves.iter().all(|n| (3..=MAX_CORNERS).contains(n))
}

/// Removes the vertex in the middle of a split ring: each side of the segment
/// is refilled, and the two neighbours on it are joined.
fn remove_from_segment(work: &mut Work, s: &mut Scratch, pass: Pass) -> bool {
    let n = s.ring.len();
    let one_sided = s.split == n - 1;
    let mut far: Vec<u32> = s.ring[s.split..].to_vec();
    far.push(s.ring[0]);
    let mut sides = vec![(s.tris[..s.split].to_vec(), s.ring[..=s.split].to_vec())];
    if !one_sided {
        sides.push((s.tris[s.split..].to_vec(), far));
    }
    let (mut cost, mut all) = (0.0, Vec::new());
    for (tris, ring) in &sides {
        if !work.rules.can_cover(&work.mesh, tris, ring.len() - 2) {
            return false;
        }
        work.refills.choose(&work.mesh, work.rules, (tris, ring), false, 1, &mut s.chosen);
        let Some(&(least, index)) = s.chosen.first() else { return false };
        cost += least;
        if !work.refills.triangles(&work.mesh, ring, false, index, &mut s.new) {
            return false;
        }
        all.append(&mut s.new);
    }
    // Each side of the segment is held against what a whole hole may cost.
    if cost > pass.max_cost * sides.len() as f64 {
        return false;
    }
    s.made.clear();
    work.mesh.replace_bound(&s.tris, &all, &[[s.ring[0], s.ring[s.split]]], &mut s.made);
    work.stats.removals[0] += 1;
    if settle(work, &s.ring, pass) {
        work.stats.removals[1] += 1;
        work.commit();
        return true;
    }
    work.mesh.rollback();
    false
}
