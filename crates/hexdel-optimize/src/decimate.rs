//! Removal of vertices, one at a time, each kept only where every angle holds.

use crate::mesh::Motion;
use crate::refill::MAX_CORNERS;
use crate::work::Work;

/// How hard one pass tries.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pass {
    /// Rings around the hole that may move in the end.
    pub(crate) rings: u8,
    /// Refills tried for each vertex.
    pub(crate) refills: usize,
    /// Refills that cost more are not tried.
    pub(crate) max_cost: f64,
    pub(crate) steps: usize,
    pub(crate) turns: usize,
    pub(crate) give_up: f64,
}

/// Tries every vertex once.
pub(crate) fn decimate(work: &mut Work, pass: Pass) -> usize {
    let mut order: Vec<(f64, u32)> = Vec::new();
    for v in 0..work.mesh.pos.len() as u32 {
        if work.mesh.alive(v) && !work.mesh.is_fixed(v) && work.failed[v as usize] < pass.rings {
            order.push((work.mesh.shortest_edge(v), v));
        }
    }
    order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut removed = 0;
    for (_, v) in order {
        if work.mesh.alive(v) && work.failed[v as usize] < pass.rings {
            if remove(work, v, pass) {
                removed += 1;
            } else {
                work.failed[v as usize] = pass.rings;
            }
        }
    }
    removed
}

/// Removes `v` if a refill of its hole can be brought inside the bounds.
pub(crate) fn remove(work: &mut Work, v: u32, pass: Pass) -> bool {
    let mut s = std::mem::take(&mut work.scratch);
    let closed = work.mesh.ring(v, &mut s.tris, &mut s.ring);
    let corners = s.ring.len();
    let sliding = matches!(work.mesh.motion[v as usize], Motion::Along(_));
    let mut done = false;
    if corners <= MAX_CORNERS && corners >= 3 && closed != sliding {
        work.refills.choose(&work.mesh, work.limits, &s.ring, closed, pass.refills, &mut s.chosen);
        for &(cost, index) in &s.chosen {
            if cost > pass.max_cost || !work.refills.triangles(&work.mesh, &s.ring, closed, index, &mut s.new) {
                continue;
            }
            s.made.clear();
            work.mesh.replace(&s.tris, &s.new, &mut s.made);
            work.stats.removals[0] += 1;
            if settle(work, &s.ring, pass) {
                work.stats.removals[1] += 1;
                work.commit();
                done = true;
                break;
            }
            work.mesh.rollback();
        }
    }
    work.scratch = s;
    done
}

/// Moves ever more rings around `verts` until everything holds.
fn settle(work: &mut Work, verts: &[u32], pass: Pass) -> bool {
    work.load(verts);
    for ring in 1..=pass.rings {
        if ring > 1 {
            work.grow();
        }
        let state = work.solve(pass.turns, pass.steps);
        if state.solved {
            return work.changes_hold();
        }
        if state.energy > pass.give_up {
            return false;
        }
    }
    false
}
