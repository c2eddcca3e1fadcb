//! Segments become edges.
//!
//! Where all records of a segment have been placed, its vertices are neighbours
//! already, and nothing is left to do but to mark the edges. Where one has been
//! left out, edges are flipped until the two vertices beside it are neighbours.

use super::rules::Scene;
use crate::error::PslgError;
use crate::net::trace::Trace;
use crate::net::{Kind, Net};
use hexdel_geom::DVec2;

/// Free vertices exactly on a segment that are taken out of its way.
const IN_THE_WAY: usize = 16;

/// Makes all pieces unions of edges. Returns how many edges had to be flipped
/// for.
///
/// # Errors
///
/// [`PslgError::NotRecovered`].
pub(super) fn connect(net: &mut Net, scene: &Scene<'_>, vertex_of_site: &[u32]) -> Result<usize, PslgError> {
    let mut inner: Vec<(u32, f64, u32)> = (0..net.vertex_count())
        .filter_map(|v| match net.vertex(v).kind {
            Kind::Along { piece, t } => Some((piece, t, v)),
            _ => None,
        })
        .collect();
    inner.sort_by(|x, y| x.0.cmp(&y.0).then(x.1.total_cmp(&y.1)));
    let (mut next, mut flipped) = (0, 0);
    for (i, piece) in scene.pieces.iter().enumerate() {
        let i = i as u32;
        let own = inner[next..].iter().take_while(|entry| entry.0 == i).map(|entry| entry.2);
        let [first, last] = piece.ends.map(|s| vertex_of_site[s as usize]);
        let chain: Vec<u32> = std::iter::once(first).chain(own).chain([last]).collect();
        next += chain.len() - 2;
        for pair in chain.windows(2) {
            let at = |at| PslgError::NotRecovered { segment: piece.segment as usize, at };
            flipped += usize::from(link(net, pair[0], pair[1], i).map_err(at)?);
        }
    }
    Ok(flipped)
}

/// Makes two vertices neighbours. Returns whether they were not.
fn link(net: &mut Net, a: u32, b: u32, piece: u32) -> Result<bool, DVec2> {
    for _ in 0..IN_THE_WAY {
        match net.trace(a, b) {
            Trace::Vertex { vertex, crossed } if vertex == b => {
                let flips = !crossed.is_empty();
                return if net.recover(a, b, crossed, piece) { Ok(flips) } else { Err(net.at(a)) };
            }
            Trace::Vertex { vertex, .. } if net.vertex(vertex).kind == Kind::Free && net.remove(vertex) => {}
            Trace::Vertex { vertex, .. } => return Err(net.at(vertex)),
            Trace::Blocked([p, q]) => return Err(net.at(p).midpoint(net.at(q))),
            Trace::Lost => return Err(net.at(a)),
        }
    }
    Err(net.at(a))
}
