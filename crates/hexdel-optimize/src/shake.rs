//! Random neutral changes that make removals possible.
//!
//! When no single removal succeeds any more, the mesh is jammed: its degrees
//! fit the angles nowhere else. Moving one vertex to another place nearby, or
//! exchanging one edge, keeps the number of triangles and moves the irregular
//! degrees; now and then that lets a vertex go.

use crate::change::{Action, Change, Finder, apply};
use crate::decimate::{LATE, PATIENT, Pass, settle, try_remove};
use crate::mesh::Motion;
use crate::refill::{Corner, MAX_CORNERS};
use crate::work::Work;

/// Rounds of shakes.
pub(crate) const SHAKES: usize = 110;

/// Shakes tried in one round for each vertex.
const SHARE: f64 = 0.5;

/// Refills and exchanges that cost more are not tried.
const MAX_COST: f64 = 1.0;

const SHAKE: Pass = Pass { rings: 4, refills: 1, max_cost: 0.6, near: 0.0, patience: PATIENT };
const REMOVE: Pass = Pass { rings: 4, refills: 1, max_cost: 0.55, near: 0.01, patience: LATE };

/// One round.
pub(crate) fn shake(work: &mut Work) {
    let vertices = work.mesh.pos.len();
    for _ in 0..(SHARE * vertices as f64) as usize {
        let v = work.random.below(vertices) as u32;
        if work.mesh.alive(v) && !work.mesh.is_fixed(v) {
            shake_at(work, v);
        }
    }
}

/// A random change at `v`, and the removals that it makes possible.
pub(crate) fn shake_at(work: &mut Work, v: u32) {
    work.stats.shakes[0] += 1;
    let changed = if work.random.below(2) == 0 { exchange(work, v) } else { transplant(work, v) };
    if let Some(changed) = changed
        && settle(work, &changed, SHAKE)
    {
        work.stats.shakes[1] += 1;
        work.commit();
        remove_near(work, &changed);
    } else {
        work.mesh.rollback();
    }
}

/// Exchanges a random edge at `v` or opposite of it; the vertices to settle, unless
/// the change is not worth it.
fn exchange(work: &mut Work, v: u32) -> Option<Vec<u32>> {
    let (mut tris, mut ring) = (Vec::new(), Vec::new());
    work.mesh.ring(v, &mut tris, &mut ring);
    let t = tris[work.random.below(tris.len())];
    let k = work.random.below(3);
    let (u, d) = work.mesh.diamond(t, k)?;
    let mut cost = 0.0;
    for (i, w) in d.into_iter().enumerate() {
        let corner = Corner::of(&work.mesh, work.rules, w, if i == 3 { u } else { t });
        let change = |c: Corner| {
            let after = if i == 0 || i == 3 { c.degree + 1 } else { c.degree.saturating_sub(1) };
            c.cost(after) - c.cost(c.degree)
        };
        cost += corner.map_or(0.0, change);
    }
    (cost < MAX_COST && work.mesh.flip(t, k)).then(|| d.to_vec())
}

/// Removes `v` and inserts a vertex somewhere near; the vertices to settle, unless
/// that is not possible.
fn transplant(work: &mut Work, v: u32) -> Option<Vec<u32>> {
    let (mut tris, mut ring, mut new) = (Vec::new(), Vec::new(), Vec::new());
    let is_free = work.mesh.motion[v as usize] == Motion::Free;
    if !is_free || !work.mesh.ring(v, &mut tris, &mut ring) || ring.len() > MAX_CORNERS {
        return None;
    }
    let mut chosen = Vec::new();
    work.refills.choose(&work.mesh, work.rules, (&tris, &ring), true, 4, &mut chosen);
    chosen.retain(|c| c.0 < MAX_COST);
    if chosen.is_empty() {
        return None;
    }
    let (_, refill) = chosen[work.random.below(chosen.len())];
    if !work.refills.triangles(&work.mesh, &ring, true, refill, &mut new) {
        return None;
    }
    work.mesh.replace(&tris, &new, &mut Vec::new());
    let action = insertion_near(work, ring[0])?;
    let mut verts = Vec::new();
    if !apply(&mut work.mesh, (work.rules, work.refills), action, &mut verts) {
        return None;
    }
    let near: Vec<u32> = ring.into_iter().filter(|w| !verts.contains(w)).collect();
    verts.extend(near);
    Some(verts)
}

/// One of the best insertions at a random triangle near `v`.
fn insertion_near(work: &mut Work, v: u32) -> Option<Action> {
    let (mut tris, mut ring) = (Vec::new(), Vec::new());
    work.mesh.ring(v, &mut tris, &mut ring);
    let t = tris[work.random.below(tris.len())];
    let mut changes: Vec<Change> = Vec::new();
    Finder { mesh: &work.mesh, rules: work.rules, refills: work.refills, out: &mut changes }
        .find_insertions(t);
    let best = changes.len().min(3);
    (best > 0).then(|| changes[work.random.below(best)].action)
}

/// Tries to remove what the shake may have loosened: vertices next to those that
/// changed.
fn remove_near(work: &mut Work, changed: &[u32]) {
    work.load(changed);
    let near: Vec<u32> = work.patch.vertices().to_vec();
    for v in near {
        if work.mesh.alive(v) && !work.mesh.is_fixed(v) {
            try_remove(work, v, REMOVE);
        }
    }
}
