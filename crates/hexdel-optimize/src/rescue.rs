//! What is done where search has given up: more vertices, then search again.
//!
//! A mesh that is too coarse around fixed vertices has no solution near it, and
//! no single change leads to one. Splitting every edge around the spot keeps
//! the angles but for the rim of the region, and a finer mesh has one: the grid
//! itself, fine enough, is within the bounds. Removals take back what was too
//! much.

use crate::decimate::{PASSES, decimate};
use crate::flip::flip_patch;
use crate::repair::{load_rings, repair, step};
use crate::work::Work;

/// Rings around a bad triangle that are refined and how often, in turn.
const TRIES: [(usize, usize); 7] = [(1, 1), (2, 1), (3, 1), (2, 2), (4, 1), (3, 2), (5, 2)];

/// The steps of repair after refinement.
const STEPS: [usize; 9] = [0, 1, 3, 4, 5, 6, 7, 10, 15];

/// Tries to settle each bad triangle of the mesh for which there is hope; what does not
/// lower their number is undone. Projection sweeps visit about `allowance` triangles for
/// each of them.
pub(crate) fn rescue(work: &mut Work, allowance: u64) {
    work.hopeful_only = true;
    let mut left = hopeful(work);
    let many = left.len();
    work.allowance = work.visits().saturating_add(allowance.saturating_mul(many as u64));
    for (rings, times) in TRIES {
        for t in left {
            if work.is_bad(t) && work.visits() < work.allowance {
                refine_and_repair(work, t, (rings, times));
            }
        }
        left = hopeful(work);
        if left.is_empty() {
            break;
        }
    }
    if left.len() < many {
        for &pass in &PASSES[1..] {
            decimate(work, pass);
        }
    }
}

/// Bad triangles for which there is hope.
fn hopeful(work: &Work) -> Vec<u32> {
    let mut bad = work.bad();
    bad.retain(|&t| !work.is_hopeless(t));
    bad
}

/// Refines around `t`, repairs within the allowance, and keeps that if fewer are bad.
fn refine_and_repair(work: &mut Work, t: u32, (rings, times): (usize, usize)) {
    let before = (work.mesh.clone(), work.failed.clone(), work.bad().len());
    let corners = work.mesh.tri[t as usize].v;
    for _ in 0..times {
        split_around(work, &corners, rings);
    }
    for s in STEPS {
        repair(work, step(s));
    }
    if work.bad().len() >= before.2 {
        work.mesh = before.0;
        work.failed = before.1;
    }
}

/// Splits all edges up to `rings` rings around `corners`, and flips to the
/// Delaunay triangulation.
fn split_around(work: &mut Work, corners: &[u32], rings: usize) {
    load_rings(work, corners, rings);
    let mut edges: Vec<(u32, u32)> = Vec::new();
    for &t in work.patch.triangles() {
        let v = work.mesh.tri[t as usize].v;
        edges.extend((0..3).map(|k| (v[k].min(v[(k + 1) % 3]), v[k].max(v[(k + 1) % 3]))));
    }
    edges.sort_unstable();
    edges.dedup();
    let mut made = Vec::new();
    let mut verts: Vec<u32> = corners.to_vec();
    for (a, b) in edges {
        if let Some((t, k)) = work.mesh.side(a, b) {
            verts.extend(work.mesh.split_edge(t, k, &mut made));
        }
    }
    load_rings(work, &verts, 1);
    flip_patch(&mut work.mesh, &work.patch);
    load_rings(work, &verts, 2);
    work.commit();
}
