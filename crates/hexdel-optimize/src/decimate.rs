//! Removal of vertices, one at a time, each kept only where every angle holds.
//!
//! Small neighbourhoods go first: what is finest is what is most likely in
//! excess. Within that order the cost of the cheapest refill says whether an
//! attempt is worth its time, and passes raise the cost they accept.

use crate::mesh::Motion;
use crate::patch::{Sweeps, Swept};
use crate::refill::MAX_CORNERS;
use crate::repair::load_rings;
use crate::segment::SegmentHole;
use crate::spread::Reach;
use crate::work::{Effort, Work};

/// How hard one pass tries.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pass {
    /// Rings around the hole that may move in the end.
    pub(crate) rings: u8,
    /// Refills tried for each vertex.
    pub(crate) refills: usize,
    /// Refills that cost more, times [`tightness`](crate::refill::tightness), are
    /// not tried.
    pub(crate) max_cost: f64,
    /// Energy below which Newton steps finish a patch, square radians.
    pub(crate) near: f64,
    /// When to give up.
    pub(crate) patience: Patience,
}

/// Energies that sweeps find above which an attempt seldom succeeds, as of [`Reach`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patience([f64; 4]);

/// While most attempts succeed.
pub(crate) const PATIENT: Patience = Patience([0.3, 0.1, 0.03, 0.01]);

/// When few succeed, with more rings to move: what the second sweep finds says less, as
/// the outer rings have not moved yet.
pub(crate) const LATE: Patience = Patience([0.6, 0.1, 0.03, 0.01]);

/// Where work is [`patient`](Work::patient).
const THOROUGH: Patience = Patience([f64::INFINITY, 1.0, 0.3, 0.1]);

/// Energy below which Newton steps then finish a patch at least, square radians.
const THOROUGH_NEAR: f64 = 0.01;

/// Sweeps of an attempt, at most.
const SWEEPS: usize = 30;

/// Share of the energy that must be gone after some sweeps for more to follow.
const STALL: f64 = 0.6;

/// What follows where they stall.
const FINISH: Effort = Effort {
    sweeps: Sweeps { most: SWEEPS, stall: STALL, hope: f64::INFINITY },
    turns: 3,
    near: 0.0,
    steps: 6,
};

/// The passes, each given a new partition of the mesh: cheap and likely
/// removals first. With the costs of `refill`, four of five attempts at 0.5
/// succeed while the mesh is fine; on a coarse one, one of ten. One ring is
/// enough for half of the removals from a fine start.
pub(crate) const PASSES: [Pass; 12] = [
    early(1, 0.5, 0.0),
    early(2, 0.5, 0.0),
    early(2, 0.5, 0.0),
    early(2, 0.6, 0.01),
    late(3, 2, 0.6),
    late(4, 2, 0.8),
    late(5, 2, 0.8),
    late(6, 4, 0.8),
    late(6, 4, 0.8),
    late(6, 4, 0.8),
    late(6, 4, 0.8),
    late(6, 4, 0.8),
];

const fn early(rings: u8, max_cost: f64, near: f64) -> Pass {
    Pass { rings, refills: 1, max_cost, near, patience: PATIENT }
}

const fn late(rings: u8, refills: usize, max_cost: f64) -> Pass {
    Pass { rings, refills, max_cost, near: 0.01, patience: LATE }
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
    if matches!(work.mesh.motion[v as usize], Motion::On(_)) {
        return remove_from_segment(work, v, pass);
    }
    let mut s = std::mem::take(&mut work.scratch);
    let closed = work.mesh.ring(v, &mut s.tris, &mut s.ring);
    let slides = matches!(work.mesh.motion[v as usize], Motion::Along(_));
    let mut done = false;
    if (3..=MAX_CORNERS).contains(&s.ring.len())
        && closed != slides
        && work.rules.can_cover(&work.mesh, &s.tris, s.ring.len() - 2)
    {
        work.refills.choose(&work.mesh, work.rules, (&s.tris, &s.ring), closed, pass.refills, &mut s.chosen);
        for &(cost, index) in &s.chosen {
            if cost > pass.max_cost * work.rules.tightness()
                || !work.refills.triangles(&work.mesh, &s.ring, closed, index, &mut s.new)
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

/// Takes `v` out by the refill of least cost, whatever becomes of the angles; false
/// where the topology forbids all.
pub(crate) fn drop_vertex(work: &mut Work, v: u32) -> bool {
    if let Some(hole) = SegmentHole::of(&work.mesh, v) {
        let Some(refill) = hole.refill(&work.mesh, work.rules, work.refills) else { return false };
        hole.fill(&mut work.mesh, &refill);
        work.mesh.commit();
        return true;
    }
    let s = &mut work.scratch;
    let closed = work.mesh.ring(v, &mut s.tris, &mut s.ring);
    let slides = matches!(work.mesh.motion[v as usize], Motion::Along(_));
    if !(3..=MAX_CORNERS).contains(&s.ring.len()) || closed == slides {
        return false;
    }
    work.refills.choose(&work.mesh, work.rules, (&s.tris, &s.ring), closed, 1, &mut s.chosen);
    let refilled = s
        .chosen
        .first()
        .is_some_and(|&(_, index)| work.refills.triangles(&work.mesh, &s.ring, closed, index, &mut s.new));
    if refilled {
        work.mesh.replace(&s.tris, &s.new, &mut Vec::new());
        work.mesh.commit();
    }
    refilled
}

/// Moves `verts` and what they push until everything changed holds.
///
/// Where areas are limited, more divisions succeed afterwards if rings move one after the
/// other.
pub(crate) fn settle(work: &mut Work, verts: &[u32], pass: Pass) -> bool {
    if work.rules.limits_areas() {
        return settle_by_rings(work, verts, pass);
    }
    let (near, Patience(hope)) =
        if work.patient { (pass.near.max(THOROUGH_NEAR), THOROUGH) } else { (pass.near, pass.patience) };
    match work.spread(verts, Reach { rings: pass.rings, most: SWEEPS, stall: STALL, hope }) {
        Swept::Settled => work.changes_hold(),
        Swept::Stalled if near > 0.0 => work.finish(Effort { near, ..FINISH }).solved && work.changes_hold(),
        Swept::Stalled | Swept::Hopeless => false,
    }
}

/// Moves and flips ever more rings around `verts` until everything changed holds.
pub(crate) fn settle_by_rings(work: &mut Work, verts: &[u32], pass: Pass) -> bool {
    let near = pass.near.max(THOROUGH_NEAR);
    for rings in 1..=usize::from(pass.rings) {
        load_rings(work, verts, rings);
        if work.solve(Effort { near, ..FINISH }).solved {
            return work.changes_hold();
        }
    }
    false
}

/// Removes `v` from its segment if both sides can be brought inside the bounds.
fn remove_from_segment(work: &mut Work, v: u32, pass: Pass) -> bool {
    let Some(hole) = SegmentHole::of(&work.mesh, v) else { return false };
    let Some(refill) = hole.refill(&work.mesh, work.rules, work.refills) else { return false };
    if refill.cost > pass.max_cost * work.rules.tightness() {
        return false;
    }
    hole.fill(&mut work.mesh, &refill);
    work.stats.removals[0] += 1;
    if settle(work, hole.ring(), pass) {
        work.stats.removals[1] += 1;
        work.commit();
        return true;
    }
    work.mesh.rollback();
    false
}
