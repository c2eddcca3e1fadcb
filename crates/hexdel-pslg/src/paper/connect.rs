//! Segments become edges.
//!
//! Where all records of a segment have been placed, its vertices are neighbours
//! already, and nothing is left to do but to mark the edges. Where one has been
//! left out, edges are flipped until the two vertices beside it are neighbours.

use super::rules::Scene;
use crate::error::PslgError;
use crate::net::{Kind, Net};

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
            let at = |at| PslgError::NotRecovered { item: piece.feature(), at };
            flipped += usize::from(net.link(pair[0], pair[1], i).map_err(at)?);
        }
    }
    Ok(flipped)
}
