//! Meshes that would be too large are refused before the work.
//!
//! Between two segments that run side by side without a common end hexagons are a part
//! of their distance wide all the way, so that a strip takes triangles in proportion to
//! its length over its width. Whatever else there is takes few by comparison.

use crate::carve::Carving;
use crate::error::{Near, PslgError};
use crate::geometry::{distance_sq, nearest_places};
use crate::net::{NONE, Net};
use crate::sizing::{LEAF_TRIANGLES, RHO};
use crate::validate::Validated;
use hexdel_geom::DVec2;
use hexdel_grid::{Grid, Lattice};

/// Parts of a segment in which the distance of another counts as the larger one of its ends.
const PARTS: u32 = 16;

/// An error if strips between segments alone take more triangles than allowed.
pub(crate) fn refuse_too_many(
    input: &Validated,
    carving: Option<&Carving<'_>>,
    lattice: &Lattice,
    limit: usize,
) -> Result<(), PslgError> {
    let mut triangles = 0.0;
    let mut worst: Option<(f64, Near, DVec2)> = None;
    for [p, q] in neighbours(&input.plane) {
        let pair = [p, q].map(|i| input.pieces[i as usize]);
        if pair[0].ends.iter().any(|end| pair[1].ends.contains(end)) {
            continue;
        }
        let [e, f] = pair.map(|piece| piece.ends.map(|site| input.points.sites()[site as usize]));
        let nearest = nearest_places(e, f);
        if carving.is_some_and(|carving| carving.parts(nearest[0], nearest[1])) {
            continue;
        }
        let of_strip = LEAF_TRIANGLES * leaves(lattice, e, f);
        triangles += of_strip;
        if worst.as_ref().is_none_or(|worst| of_strip > worst.0) {
            let near =
                Near { items: pair.map(|piece| piece.feature()), distance: nearest[0].distance(nearest[1]) };
            worst = Some((of_strip, near, nearest[0].midpoint(nearest[1])));
        }
    }
    match worst {
        Some((_, near, at)) if triangles > limit as f64 => {
            Err(PslgError::TooMany { limit, at, near: Some(near) })
        }
        _ => Ok(()),
    }
}

/// The leaves in the strip along one segment that see the other, too, at least.
fn leaves(lattice: &Lattice, [a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> f64 {
    let step = a.distance(b) / f64::from(PARTS);
    let away = |k: u32| distance_sq(a.lerp(b, f64::from(k) / f64::from(PARTS)), c, d).sqrt();
    let of_part = |k: u32| {
        let width = away(k).max(away(k + 1));
        // A strip that is no longer than wide has nothing to say.
        if width >= step {
            return 0.0;
        }
        let mut spacing = lattice.spacing(0);
        let mut level = 0;
        while 2.0 * RHO * spacing > width && level < Grid::MAX_LEVELS {
            spacing *= 0.5;
            level += 1;
        }
        // Rows of hexagons between the segments, of 0.87 spacings each.
        step * width / (0.87 * spacing * spacing)
    };
    (0..PARTS).map(of_part).sum()
}

/// Pairs of pieces that are sides of one triangle, or of two beside each other.
fn neighbours(plane: &Net) -> Vec<[u32; 2]> {
    let sides = |t: u32| plane.tri(t).s.into_iter().filter(|&piece| piece != NONE);
    let mut pairs = Vec::new();
    for t in plane.alive() {
        let beside = (0..3).filter(|&i| plane.tri(t).s[i] == NONE).filter_map(|i| plane.beyond(t, i));
        let all: Vec<u32> = sides(t).chain(beside.flat_map(|(n, _)| sides(n).collect::<Vec<_>>())).collect();
        for (i, &p) in all.iter().enumerate() {
            pairs.extend(all[..i].iter().filter(|&&q| q != p).map(|&q| [p.min(q), p.max(q)]));
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs
}
