//! Points inside polygons.
//!
//! A polygon is its rings, inside is what a ray leaves an odd number of times. All of
//! it is up to rounding: a point too close to a ring to tell is not promised on either
//! side, so points are searched for where there is room.

use hexdel_geom::DVec2;

/// Horizontal lines that are tried through a polygon.
const LINES: usize = 8;

/// Points inside a polygon of closed rings, those with most room first: midpoints
/// along horizontal lines that pass no vertex. None if there is no inside.
///
/// # Complexity
///
/// `O(n log n)` for `n` vertices.
pub(crate) fn interior_points(rings: &[Vec<DVec2>]) -> Vec<DVec2> {
    let mut heights: Vec<f64> = rings.iter().flatten().map(|p| p.y).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup();
    let mut gaps: Vec<[f64; 2]> = heights.windows(2).map(|w| [w[0], w[1]]).collect();
    gaps.sort_by(|a, b| (b[1] - b[0]).total_cmp(&(a[1] - a[0])));
    gaps.truncate(LINES);

    let mut found = Vec::new();
    for [low, high] in gaps {
        let y = low.midpoint(high);
        if low < y && y < high {
            let spans = crossings(rings, y);
            found.extend(spans.chunks_exact(2).filter_map(|span| candidate(span, y, high - low)));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.truncate(LINES);
    found.into_iter().map(|(_, p)| p).collect()
}

/// The middle of a span, with how much room there is.
fn candidate(span: &[f64], y: f64, height: f64) -> Option<(f64, DVec2)> {
    let x = span[0].midpoint(span[1]);
    let strictly_inside = span[0] < x && x < span[1];
    strictly_inside.then(|| (height.min(span[1] - span[0]), DVec2::new(x, y)))
}

/// Where the rings cross a horizontal line, in order.
fn crossings(rings: &[Vec<DVec2>], y: f64) -> Vec<f64> {
    let edges = rings.iter().flat_map(|ring| ring.windows(2));
    let mut crossings: Vec<f64> = edges.filter_map(|e| crossing(e[0], e[1], y)).collect();
    crossings.sort_by(f64::total_cmp);
    crossings
}

/// Where an edge crosses a horizontal line. Its upper end is not part of it, so that
/// rings cross twice or not at all.
fn crossing(a: DVec2, b: DVec2, y: f64) -> Option<f64> {
    if (a.y <= y) == (b.y <= y) {
        return None;
    }
    // Halved, no difference overflows.
    let part = (y * 0.5 - a.y * 0.5) / (b.y * 0.5 - a.y * 0.5);
    Some(a.x * (1.0 - part) + b.x * part)
}

/// Whether a point lies inside the closed rings.
pub(crate) fn covers(rings: &[Vec<DVec2>], p: DVec2) -> bool {
    let edges = rings.iter().flat_map(|ring| ring.windows(2));
    edges.filter_map(|e| crossing(e[0], e[1], p.y)).filter(|&x| x < p.x).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(corners: &[(f64, f64)]) -> Vec<DVec2> {
        corners.iter().chain(corners.first()).map(|&(x, y)| DVec2::new(x, y)).collect()
    }

    #[test]
    fn points_are_inside() {
        let comb =
            ring(&[(0.0, 0.0), (9.0, 0.0), (9.0, 5.0), (6.0, 0.5), (5.0, 5.0), (3.0, 0.5), (0.0, 5.0)]);
        let holed = vec![
            ring(&[(0.0, 0.0), (9.0, 1.0), (8.0, 9.0), (1.0, 8.0)]),
            ring(&[(1.0, 2.0), (8.0, 2.0), (4.0, 7.5)]),
        ];
        let tiny = ring(&[(1e6, 1e6), (1e6 + 1e-9, 1e6), (1e6, 1e6 + 1e-9)]);
        let huge = ring(&[(-f64::MAX, -f64::MAX), (f64::MAX, -f64::MAX), (0.0, f64::MAX)]);
        for rings in [vec![comb], holed, vec![tiny], vec![huge]] {
            let points = interior_points(&rings);
            assert!(!points.is_empty(), "{rings:?}");
            assert!(points.iter().all(|&p| covers(&rings, p)), "{rings:?} {points:?}");
        }
    }

    #[test]
    fn nothing_is_inside_of_nothing() {
        for rings in [vec![], vec![vec![]], vec![ring(&[(0.0, 0.0), (1.0, 1.0)])]] {
            assert!(interior_points(&rings).is_empty(), "{rings:?}");
            assert!(!covers(&rings, DVec2::splat(0.5)));
        }
    }
}
