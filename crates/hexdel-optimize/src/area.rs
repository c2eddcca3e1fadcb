//! Triangles larger or longer than allowed are divided, one side after the other,
//! each division kept only where every angle around holds.

use hexdel_geom::DVec2;

use crate::decimate::{PATIENT, Pass, settle_by_rings};
use crate::sizing::{Sizing, edge_fits, triangle_fits};
use crate::work::Work;

/// How far the division of a triangle may move what is around it.
const DIVISION: Pass = Pass { rings: 3, refills: 1, max_cost: 0.0, near: 0.05, patience: PATIENT };

/// The same for edges that have withstood that: their triangles' other sides are
/// divided, too, and all around must be as short as wanted.
const LAST: Pass = Pass { rings: 6, near: 0.3, ..DIVISION };

/// Divides edges longer than wanted that [`divide_large`] has left.
pub(crate) fn divide_left(work: &mut Work, sizing: &dyn Sizing) {
    let long: Vec<u32> = work.mesh.live().filter(|&t| !triangle_fits(sizing, corners(work, t))).collect();
    for t in long {
        if work.mesh.tri[t as usize].alive() && !triangle_fits(sizing, corners(work, t)) {
            divide(work, t, |_| true, LAST);
        }
    }
}

/// Divides what is too large, or has an edge longer than wanted, where the bounds
/// allow it.
pub(crate) fn divide_large(work: &mut Work, sizing: Option<&dyn Sizing>) {
    let excess = |work: &Work, t: u32| excess(work, sizing, t);
    let large: Vec<u32> = work.mesh.live().filter(|&t| excess(work, t).is_some()).collect();
    for t in large {
        // A division next to it may have helped.
        if work.mesh.tri[t as usize].alive()
            && let Some(excess) = excess(work, t)
        {
            let is_long = |[a, b]: [DVec2; 2]| match excess {
                Excess::Area => true,
                Excess::Length(sizing) => !edge_fits(sizing, a, b),
            };
            divide(work, t, is_long, DIVISION);
        }
    }
}

/// What is too much about a triangle.
enum Excess<'a> {
    Area,
    /// Sides longer than this.
    Length(&'a dyn Sizing),
}

fn excess<'a>(work: &Work, sizing: Option<&'a dyn Sizing>, t: u32) -> Option<Excess<'a>> {
    let corners = corners(work, t);
    if !work.rules.is_small(corners) {
        return Some(Excess::Area);
    }
    sizing.filter(|sizing| !triangle_fits(*sizing, corners)).map(Excess::Length)
}

fn corners(work: &Work, t: u32) -> [DVec2; 3] {
    work.mesh.tri[t as usize].v.map(|v| work.mesh.pos[v as usize])
}

/// Divides the longest side of `t` that can be, of those that are to be.
fn divide(work: &mut Work, t: u32, is_to_be: impl Fn([DVec2; 2]) -> bool, pass: Pass) {
    let (verts, at) = (work.mesh.tri[t as usize].v, corners(work, t));
    let mut sides = [0, 1, 2].map(|k| (at[(k + 1) % 3].distance_squared(at[(k + 2) % 3]), k));
    sides.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, k) in sides {
        if !is_to_be([at[(k + 1) % 3], at[(k + 2) % 3]]) {
            continue;
        }
        let mut made = Vec::new();
        let Some(middle) = work.mesh.split_edge(t, k, &mut made) else { continue };
        let mut verts = verts.to_vec();
        verts.push(middle);
        if settle_by_rings(work, &verts, pass) {
            work.commit();
            return;
        }
        work.mesh.rollback();
    }
}
