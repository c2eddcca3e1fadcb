//! How many edges each vertex is away from points and segments, which decides the
//! bounds of its triangles; and vertices near them that no motion can mend.

use crate::judge::FAR_RING;
use crate::net::{Kind, NONE, Net};

/// Rings that are counted: nobody asks how far away a vertex is beyond.
const MOST_RINGS: u32 = FAR_RING + 1;

/// Triangles that a free vertex must have. Four angles of 90 degrees at most
/// are four right angles, and rounding decides whether the edges around are
/// Delaunay.
const LEAST_DEGREE: usize = 5;

/// Counts each vertex's edges to the nearest point or segment.
pub(crate) fn count_rings(net: &mut Net) {
    for v in 0..net.vertex_count() {
        let bound = matches!(net.vertex(v).kind, Kind::Site(_) | Kind::Along { .. });
        net.set_ring(v, if bound { 0 } else { NONE });
    }
    let mut front: Vec<u32> = (0..net.vertex_count()).filter(|&v| net.vertex(v).ring == 0).collect();
    let mut star = Vec::new();
    for ring in 1..=MOST_RINGS {
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

/// Takes out free vertices near points and segments that have too few triangles.
/// Needs rings.
pub(crate) fn remove_starved(net: &mut Net) {
    let mut stack: Vec<u32> =
        (0..net.vertex_count()).rev().filter(|&v| net.vertex(v).ring <= MOST_RINGS).collect();
    let mut star = Vec::new();
    while let Some(v) = stack.pop() {
        if net.vertex(v).kind != Kind::Free || net.degree(v) >= LEAST_DEGREE {
            continue;
        }
        net.star(v, &mut star);
        let around: Vec<u32> = star.iter().flat_map(|&t| net.tri(t).v).filter(|&w| w != v).collect();
        if net.remove(v) {
            stack.extend(around);
        }
    }
}
