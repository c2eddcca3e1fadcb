//! The convex hull as a boundary of segments.
//!
//! Andrew's monotone chain ("Another efficient algorithm for convex hulls in
//! two dimensions", 1979) with exact orientation; points exactly on the hull
//! divide it. A hull edge that would leave less than a hair's breadth to what
//! is behind it, as along a side whose points are only nearly in line, gives
//! way to it: the extent is then convex up to that.

use crate::net::trace::Trace;
use crate::net::{Kind, NONE, Net};
use crate::validate::{Piece, Validated};
use hexdel_geom::{DVec2, orient2d};

/// A triangle at the hull flatter than this, height over length, is left
/// outside. Points that were meant to be in line are so to some `1e-15` of the
/// coordinates; meshing a gap of a millionth of an edge would take thousands of
/// triangles.
const FLAT: f64 = 1e-6;

/// The mark of hull edges that are no pieces, above all numbers of pieces.
const HULL: u32 = NONE - 1;

/// The pieces of the input and, where they do not enclose the hull, hull edges.
pub(crate) fn with_hull(input: &Validated) -> Vec<Piece> {
    let mut pieces = input.pieces.clone();
    let Some((plane, ends)) = plane_with_hull(input) else {
        return pieces;
    };
    for edge in ends {
        peel(&plane, input, edge, &mut pieces);
    }
    pieces
}

/// The plane of the input with the edges of its convex hull in it, and those, from site to
/// site; none if there are fewer than three.
pub(crate) fn plane_with_hull(input: &Validated) -> Option<(Net, Vec<[u32; 2]>)> {
    let mut plane = input.plane.clone();
    let hull = convex_hull(input.points.sites());
    if hull.len() < 3 {
        return None;
    }
    let ends: Vec<[u32; 2]> = (0..hull.len()).map(|i| [hull[i], hull[(i + 1) % hull.len()]]).collect();
    // Hull edges cross nothing: all of the input is on one side.
    for &[a, b] in &ends {
        let [v, goal] = [a, b].map(|s| input.vertex_of_site[s as usize]);
        if let Trace::Vertex { vertex, crossed } = plane.trace(v, goal)
            && vertex == goal
        {
            if let Some((t, i)) = plane.find_either(v, goal)
                && plane.tri(t).s[i] != NONE
            {
                continue;
            }
            // What is recovered next must not flip it away again.
            plane.recover(v, goal, crossed, HULL);
        }
    }
    Some((plane, ends))
}

/// Adds the hull edge, or what is behind it if that is flat.
fn peel(plane: &Net, input: &Validated, edge: [u32; 2], pieces: &mut Vec<Piece>) {
    let mut stack = vec![edge];
    while let Some([a, b]) = stack.pop() {
        let [v, w] = [a, b].map(|s| input.vertex_of_site[s as usize]);
        let Some((t, i)) = plane.find_edge(v, w) else { continue };
        if ![NONE, HULL].contains(&plane.tri(t).s[i]) {
            continue;
        }
        let apex = plane.vertex(plane.tri(t).v[i]);
        let [p, q] = [v, w].map(|v| plane.at(v));
        let height = (q - p).perp_dot(apex.at - p) / p.distance_squared(q);
        match apex.kind {
            Kind::Site(c) if height < FLAT => stack.extend([[c, b], [a, c]]),
            _ => pieces.push(Piece { ends: [a, b], segment: NONE }),
        }
    }
}

/// The sites on the hull, counter-clockwise, those on its edges included.
pub(crate) fn convex_hull(sites: &[DVec2]) -> Vec<u32> {
    let mut order: Vec<u32> = (0..sites.len() as u32).collect();
    let at = |i: u32| sites[i as usize];
    order.sort_by(|&i, &j| at(i).x.total_cmp(&at(j).x).then(at(i).y.total_cmp(&at(j).y)));
    let half = |order: &mut dyn Iterator<Item = u32>| {
        let mut chain: Vec<u32> = Vec::new();
        for i in order {
            while let [.., a, b] = chain[..]
                && orient2d(at(a), at(b), at(i)) < 0.0
            {
                chain.pop();
            }
            chain.push(i);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut order.iter().copied());
    let lower: Vec<u32> = hull.clone();
    hull.extend(half(&mut order.iter().rev().copied()));
    // Of sites all in a line, each is on both halves.
    let flat = hull[lower.len()..].iter().skip(1).any(|i| lower.contains(i)) && sites.len() > 1;
    if flat { Vec::new() } else { hull }
}
