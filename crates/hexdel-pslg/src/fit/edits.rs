//! Changes of connectivity that an optimiser may try.

use crate::net::{Kind, NONE, Net};

/// A change near a bad triangle. Edges are named by their ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Edit {
    Flip([u32; 2]),
    /// The first vertex goes into the second.
    Collapse([u32; 2]),
    Split([u32; 2]),
    Centre([u32; 3]),
}

/// All edits at the triangles around a triangle's corners that lie in `tris`,
/// in a fixed order.
pub(crate) fn edits(net: &Net, t: u32, tris: &[u32]) -> Vec<Edit> {
    let mut near = vec![t];
    let mut star = Vec::new();
    for v in net.tri(t).v {
        net.star(v, &mut star);
        for &s in &star {
            if !near.contains(&s) && tris.binary_search(&s).is_ok() {
                near.push(s);
            }
        }
    }
    let mut edges: Vec<[u32; 2]> = near.iter().flat_map(|&t| [0, 1, 2].map(|i| net.tri(t).edge(i))).collect();
    for edge in &mut edges {
        edge.sort_unstable();
    }
    edges.sort_unstable();
    edges.dedup();
    let inner = |&[a, b]: &[u32; 2]| {
        net.find_edge(a, b).is_none_or(|(t, _)| tris.binary_search(&t).is_ok())
            && net.find_edge(b, a).is_none_or(|(t, _)| tris.binary_search(&t).is_ok())
    };
    edges.retain(inner);
    let mut all = Vec::new();
    for &[a, b] in &edges {
        all.extend([Edit::Flip([a, b]), Edit::Collapse([a, b]), Edit::Collapse([b, a]), Edit::Split([a, b])]);
    }
    all.extend(near.iter().take(4).map(|&t| Edit::Centre(net.tri(t).v)));
    all
}

impl Edit {
    /// Makes the change; `false`, with nothing changed, if it is not possible.
    pub(crate) fn apply(self, net: &mut Net) -> bool {
        match self {
            Self::Flip([a, b]) => net.find_edge(a, b).is_some_and(|(t, i)| net.flip(t, i)),
            Self::Collapse([a, b]) => collapse(net, a, b),
            Self::Split([a, b]) => split(net, a, b),
            Self::Centre(corners) => centre(net, corners),
        }
    }
}

fn collapse(net: &mut Net, from: u32, to: u32) -> bool {
    let Some((t, i)) = net.find_either(from, to) else { return false };
    let piece = net.tri(t).s[i];
    let may = match net.vertex(from).kind {
        Kind::Free => true,
        Kind::Along { piece: p, .. } => p == piece,
        _ => false,
    };
    let mut star = Vec::new();
    net.star(from, &mut star);
    if !may || !is_simple(net, from, to, &star) {
        return false;
    }
    let mapped = |v: [u32; 3]| v.map(|v| if v == from { to } else { v });
    let new: Vec<[u32; 3]> =
        star.iter().map(|&t| net.tri(t).v).filter(|v| !v.contains(&to)).map(mapped).collect();
    let pieces: Vec<(u32, u32)> = star
        .iter()
        .flat_map(|&t| {
            let tri = net.tri(t);
            let i = tri.corner(from).unwrap_or(0);
            [(tri.v[(i + 1) % 3], tri.s[(i + 2) % 3]), (tri.v[(i + 2) % 3], tri.s[(i + 1) % 3])]
        })
        .collect();
    let piece_of = |a: u32, b: u32| {
        let other = if a == to { b } else { a };
        pieces.iter().find(|p| p.0 == other).map_or(NONE, |p| p.1)
    };
    net.replace(&star, &new, piece_of);
    net.retire(from);
    true
}

/// Whether nothing but the triangles at the edge is between its ends (the link
/// condition), and the vertex keeps a fan.
fn is_simple(net: &Net, from: u32, to: u32, star: &[u32]) -> bool {
    let shared = star.iter().filter(|&&t| net.tri(t).corner(to).is_some()).count();
    let mut around = Vec::new();
    net.star(to, &mut around);
    let mut common: Vec<u32> = around
        .iter()
        .flat_map(|&t| net.tri(t).v)
        .filter(|&v| v != from && v != to && star.iter().any(|&t| net.tri(t).corner(v).is_some()))
        .collect();
    common.sort_unstable();
    common.dedup();
    common.len() == shared && star.len() > shared
}

fn split(net: &mut Net, a: u32, b: u32) -> bool {
    let Some((t, i)) = net.find_either(a, b) else { return false };
    let piece = net.tri(t).s[i];
    let (at, kind) = if piece == NONE {
        if net.tri(t).n[i] == NONE {
            return false;
        }
        (net.at(a).midpoint(net.at(b)), Kind::Free)
    } else {
        let t = 0.5 * (parameter(net, a, piece) + parameter(net, b, piece));
        (net.along(piece, t), Kind::Along { piece, t })
    };
    if at == net.at(a) || at == net.at(b) {
        return false;
    }
    let v = net.split_edge(t, i, at, kind);
    number(net, v);
    true
}

fn centre(net: &mut Net, [a, b, c]: [u32; 3]) -> bool {
    let Some((t, _)) = net.find_edge(a, b).filter(|&(t, _)| net.tri(t).corner(c).is_some()) else {
        return false;
    };
    let at = (net.at(a) + net.at(b) + net.at(c)) / 3.0;
    let v = net.split_triangle(t, at, Kind::Free);
    number(net, v);
    true
}

/// Counts a new vertex's edges to the nearest constrained one.
fn number(net: &mut Net, v: u32) {
    let mut star = Vec::new();
    net.star(v, &mut star);
    let rings = star.iter().flat_map(|&t| net.tri(t).v).filter(|&w| w != v).map(|w| net.vertex(w).ring);
    let ring = match net.vertex(v).kind {
        Kind::Free => rings.min().unwrap_or(0).saturating_add(1),
        _ => 0,
    };
    net.set_ring(v, ring);
}

/// Where on a piece one of its vertices lies, as a fraction of its length.
pub(crate) fn parameter(net: &Net, v: u32, piece: u32) -> f64 {
    match net.vertex(v).kind {
        Kind::Along { piece: p, t } if p == piece => t,
        _ if net.at(v) == net.lines[piece as usize][0] => 0.0,
        _ => 1.0,
    }
}
