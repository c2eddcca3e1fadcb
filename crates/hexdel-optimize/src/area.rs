//! Triangles larger than allowed are divided, one side after the other, each
//! division kept only where every angle around holds.

use crate::decimate::{PATIENT, Pass, settle};
use crate::work::Work;

/// How far the division of a triangle may move what is around it.
const DIVISION: Pass = Pass { rings: 3, refills: 1, max_cost: 0.0, near: 0.05, patience: PATIENT };

/// Divides what is too large where the bounds allow it.
pub(crate) fn divide_large(work: &mut Work) {
    let large: Vec<u32> = work.mesh.live().filter(|&t| is_large(work, t)).collect();
    for t in large {
        // A division next to it may have helped.
        if work.mesh.tri[t as usize].alive() && is_large(work, t) {
            divide(work, t);
        }
    }
}

fn is_large(work: &Work, t: u32) -> bool {
    !work.rules.is_small(work.mesh.tri[t as usize].v.map(|v| work.mesh.pos[v as usize]))
}

/// Divides the longest side of `t` that can be.
fn divide(work: &mut Work, t: u32) {
    let corners = work.mesh.tri[t as usize].v;
    let at = corners.map(|v| work.mesh.pos[v as usize]);
    let mut sides = [0, 1, 2].map(|k| (at[(k + 1) % 3].distance_squared(at[(k + 2) % 3]), k));
    sides.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, k) in sides {
        let mut made = Vec::new();
        let Some(middle) = work.mesh.split_edge(t, k, &mut made) else { continue };
        let mut verts = corners.to_vec();
        verts.push(middle);
        if settle(work, &verts, DIVISION) {
            work.commit();
            return;
        }
        work.mesh.rollback();
    }
}
