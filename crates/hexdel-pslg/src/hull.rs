//! The convex hull as a boundary of segments.
//!
//! Andrew's monotone chain ("Another efficient algorithm for convex hulls in
//! two dimensions", 1979) with exact orientation; points exactly on the hull
//! divide it. A hull edge that would leave less than a hair's breadth to what
//! is behind it, as along a side whose points are only nearly in line, gives
//! way to it: the extent is then convex up to that. A hull that is no more than
//! that altogether is refused.

use crate::error::{Feature, PslgError};
use crate::net::trace::Trace;
use crate::net::{Kind, NONE, Net};
use crate::validate::{Piece, Validated};
use hexdel_geom::{DVec2, orient2d};
use rustc_hash::FxHashSet;

/// A triangle at the hull flatter than this, height over length, is left
/// outside; a hull flatter than this, width over length, is refused. Points that
/// were meant to be in line are so to some `1e-15` of the coordinates; meshing a
/// gap of a millionth of an edge would take thousands of triangles.
const FLAT: f64 = 1e-6;

/// The mark of hull edges that are no pieces, above all numbers of pieces.
const HULL: u32 = NONE - 1;

/// An error if all sites are in a line but for a hair's breadth, unless segments enclose them.
pub(crate) fn refuse_flat(input: &Validated) -> Result<(), PslgError> {
    let sites = input.points.sites();
    let hull = convex_hull(sites);
    // Of sites exactly in a line there is no hull.
    let among = if hull.is_empty() { (0..sites.len() as u32).collect() } else { hull.clone() };
    let at = |site: u32| sites[site as usize];
    let first_of_most = |measure: &dyn Fn(DVec2) -> f64| {
        let larger = |i: u32, j: u32| if measure(at(j)) > measure(at(i)) { j } else { i };
        among.iter().copied().reduce(larger).expect("a valid graph has a point")
    };
    let a = first_of_most(&|p| p.distance_squared(sites[0]));
    let b = first_of_most(&|p| p.distance_squared(at(a)));
    let length = at(a).distance(at(b));
    let off = |p: DVec2| orient2d(at(a), at(b), p).abs() / length;
    let farthest = first_of_most(&off);
    let distance = off(at(farthest));
    // One point alone is no line.
    if a == b || distance >= FLAT * length || is_closed(input, &hull) {
        return Ok(());
    }
    let point = |site: u32| Feature::Point(input.points.input_of_site()[site as usize] as usize);
    let ends = [a.min(b), a.max(b)].map(point);
    Err(PslgError::FlatHull { farthest: point(farthest), ends, distance })
}

/// Whether all edges of the hull are segments.
fn is_closed(input: &Validated, hull: &[u32]) -> bool {
    let sorted = |[i, j]: [u32; 2]| [i.min(j), i.max(j)];
    let pieces: FxHashSet<[u32; 2]> = input.pieces.iter().map(|piece| sorted(piece.ends)).collect();
    let edges = || hull.iter().zip(hull.iter().cycle().skip(1));
    hull.len() > 2 && edges().all(|(&i, &j)| pieces.contains(&sorted([i, j])))
}

/// The pieces of the input and, where they do not enclose the hull, hull edges.
pub(crate) fn with_hull(input: &Validated) -> Vec<Piece> {
    let mut pieces = input.pieces.clone();
    let Some((plane, ends)) = plane_with_hull(input) else {
        return pieces;
    };
    let mut on_rim: FxHashSet<u32> = ends.iter().map(|edge| edge[0]).collect();
    for edge in ends {
        peel(&plane, input, edge, &mut on_rim, &mut pieces);
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

/// Adds the hull edge, or what is behind it if that is flat. Sites `on_rim` stay there: no triangle
/// goes that reaches one, or the extent would fall to pieces.
fn peel(
    plane: &Net,
    input: &Validated,
    edge: [u32; 2],
    on_rim: &mut FxHashSet<u32>,
    pieces: &mut Vec<Piece>,
) {
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
            Kind::Site(c) if height < FLAT && on_rim.insert(c) => stack.extend([[c, b], [a, c]]),
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
