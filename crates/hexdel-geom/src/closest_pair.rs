//! The closest two of a set of points.
//!
//! Divide and conquer over the points sorted by x, merging by y (Shamos and
//! Hoey, "Closest-point problems", 1975): the worst case is the common case,
//! whatever the input looks like.

use crate::par::prelude::*;
use glam::DVec2;

use crate::scale::{max_abs, scale_to};

/// Two points and their distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClosestPair {
    /// Index of the first point.
    pub a: usize,
    /// Index of the second point, larger than `a`.
    pub b: usize,
    /// Their distance, in the units of the points; 0 if they coincide.
    pub distance: f64,
}

/// The closest pair among `points`; `None` if fewer than two are finite.
///
/// Of several pairs at the same (rounded, squared) distance the one with the
/// smallest indices is returned. Points with a coordinate that is not finite
/// are never part of a pair.
///
/// Distances below `2^-1000` times the largest coordinate are all held to be
/// equally close.
///
/// # Complexity
///
/// `O(n log n)`, for every input.
///
/// # Panics
///
/// In debug builds, if there are more than `u32::MAX` points.
pub fn closest_pair(points: &[DVec2]) -> Option<ClosestPair> {
    debug_assert!(u32::try_from(points.len()).is_ok());
    // With the largest coordinate at 2^500 squares stay finite, and the
    // square of a distance of 2^-500 is still normal.
    let scale = scale_to(max_abs(points), 500);
    let mut sorted: Vec<Point> = points
        .iter()
        .enumerate()
        .filter(|(_, p)| p.is_finite())
        .map(|(i, &p)| Point { at: p * scale + DVec2::ZERO, index: i as u32 })
        .collect();
    sorted.par_sort_unstable_by(|p, q| {
        p.at.x.total_cmp(&q.at.x).then(p.at.y.total_cmp(&q.at.y)).then(p.index.cmp(&q.index))
    });
    // Coincident points would crowd a strip of width zero.
    let mut best = Best::NONE;
    for pair in sorted.windows(2).filter(|w| w[0].at == w[1].at) {
        best.offer(pair[0], pair[1]);
    }
    if best.distance_sq > 0.0 {
        let mut scratch = Vec::with_capacity(sorted.len());
        conquer(&mut sorted, &mut scratch, &mut best);
    }
    (best.a != best.b).then(|| {
        let (a, b) = (best.a as usize, best.b as usize);
        ClosestPair { a, b, distance: (points[a] * scale).distance(points[b] * scale) / scale }
    })
}

#[derive(Clone, Copy)]
struct Point {
    /// Scaled position, without negative zeros.
    at: DVec2,
    /// Position in the input.
    index: u32,
}

/// The closest pair so far.
struct Best {
    /// Infinite until there is a pair.
    distance_sq: f64,
    /// Smaller index of the pair; equal to `b` until there is one.
    a: u32,
    b: u32,
}

impl Best {
    const NONE: Self = Self { distance_sq: f64::INFINITY, a: 0, b: 0 };

    #[inline]
    fn offer(&mut self, p: Point, q: Point) {
        let distance_sq = p.at.distance_squared(q.at);
        if distance_sq > self.distance_sq {
            return;
        }
        let (a, b) = (p.index.min(q.index), p.index.max(q.index));
        if distance_sq < self.distance_sq || (a, b) < (self.a, self.b) {
            *self = Self { distance_sq, a, b };
        }
    }

    /// Whether a pair this far apart along one axis may still matter: closer,
    /// or a tie. Once the distance is zero in the scaled frame, only the first
    /// such pair is kept, or a cluster of them could take quadratic time.
    #[inline]
    fn reaches(&self, along_axis: f64) -> bool {
        along_axis * along_axis <= self.distance_sq && self.distance_sq > 0.0
    }
}

/// Up to this many points the pairs are simply all looked at.
const BRUTE_FORCE: usize = 8;

/// Finds the closest pair of `points`, sorted by x, and leaves them sorted by
/// y.
fn conquer(points: &mut [Point], scratch: &mut Vec<Point>, best: &mut Best) {
    if points.len() <= BRUTE_FORCE {
        for (i, &p) in points.iter().enumerate() {
            for &q in &points[i + 1..] {
                best.offer(p, q);
            }
        }
        points.sort_unstable_by(by_y);
        return;
    }
    let middle = points.len() / 2;
    let x = points[middle].at.x;
    let (left, right) = points.split_at_mut(middle);
    conquer(left, scratch, best);
    conquer(right, scratch, best);
    merge_by_y(points, middle, scratch);
    scratch.clear();
    scratch.extend(points.iter().filter(|p| best.reaches(p.at.x - x)));
    // Points of one half are at least the best distance apart, so that a
    // constant number of them fits into the box looked at from each point.
    for (i, &p) in scratch.iter().enumerate() {
        for &q in &scratch[i + 1..] {
            if !best.reaches(q.at.y - p.at.y) {
                break;
            }
            best.offer(p, q);
        }
    }
}

fn by_y(p: &Point, q: &Point) -> std::cmp::Ordering {
    p.at.y.total_cmp(&q.at.y).then(p.index.cmp(&q.index))
}

/// Merges the halves, each sorted by y.
fn merge_by_y(points: &mut [Point], middle: usize, scratch: &mut Vec<Point>) {
    scratch.clear();
    scratch.extend_from_slice(&points[..middle]);
    let (mut i, mut j) = (0, middle);
    // The output never overtakes the right half's unread part.
    while i < scratch.len() {
        let from_left = j == points.len() || by_y(&scratch[i], &points[j]).is_lt();
        points[i + j - middle] = if from_left { scratch[i] } else { points[j] };
        if from_left {
            i += 1;
        } else {
            j += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn brute_force(points: &[DVec2]) -> Option<(f64, usize, usize)> {
        let mut best: Option<(f64, usize, usize)> = None;
        for a in 0..points.len() {
            for b in a + 1..points.len() {
                let d = points[a].distance_squared(points[b]);
                if best.is_none_or(|(e, ..)| d < e) {
                    best = Some((d, a, b));
                }
            }
        }
        best
    }

    fn agrees(points: &[DVec2]) {
        let found = closest_pair(points).map(|p| (p.a, p.b));
        assert_eq!(found, brute_force(points).map(|(_, a, b)| (a, b)));
    }

    #[test]
    fn small_and_odd_inputs() {
        assert_eq!(closest_pair(&[]), None);
        assert_eq!(closest_pair(&[DVec2::ONE]), None);
        assert_eq!(closest_pair(&[DVec2::ONE, DVec2::splat(f64::NAN)]), None);
        let twice = closest_pair(&[DVec2::X, DVec2::Y, DVec2::ONE, DVec2::Y]).unwrap();
        assert_eq!(twice, ClosestPair { a: 1, b: 3, distance: 0.0 });
        let zeros = closest_pair(&[DVec2::X, DVec2::new(-0.0, 0.0), DVec2::ZERO]).unwrap();
        assert_eq!((zeros.a, zeros.b), (1, 2));
    }

    #[test]
    fn lines_and_lattices_tie_to_the_first() {
        let vertical: Vec<DVec2> = (0..1000).map(|i| DVec2::new(2.0, f64::from(i))).collect();
        assert_eq!(closest_pair(&vertical), Some(ClosestPair { a: 0, b: 1, distance: 1.0 }));
        let lattice: Vec<DVec2> =
            (0..900).map(|i| DVec2::new(f64::from(i % 30), f64::from(i / 30))).collect();
        agrees(&lattice);
        let same = vec![DVec2::ONE; 100_000];
        assert_eq!(closest_pair(&same), Some(ClosestPair { a: 0, b: 1, distance: 0.0 }));
    }

    #[test]
    fn extreme_magnitudes() {
        for scale in [1e-300, 1e-160, 1e160, 1e300] {
            let points = [DVec2::ZERO, DVec2::new(1.0, 1.0), DVec2::new(1.5, 1.0)].map(|p| p * scale);
            let pair = closest_pair(&points).unwrap();
            assert_eq!((pair.a, pair.b), (1, 2));
            assert!((pair.distance / scale - 0.5).abs() < 1e-12);
        }
        let mixed = [DVec2::ZERO, DVec2::new(1e-250, 0.0), DVec2::new(3e-251, 0.0), DVec2::ONE];
        assert_eq!(closest_pair(&mixed).map(|p| (p.a, p.b)), Some((0, 2)));
    }

    proptest! {
        #[test]
        fn agrees_with_all_pairs(raw in prop::collection::vec((-1.0..1.0f64, -1.0..1.0f64), 0..200)) {
            agrees(&raw.iter().map(|&(x, y)| DVec2::new(x, y)).collect::<Vec<_>>());
        }

        #[test]
        fn agrees_on_ties(raw in prop::collection::vec((0i8..12, 0i8..40), 0..120)) {
            agrees(&raw.iter().map(|&(x, y)| DVec2::new(x.into(), y.into())).collect::<Vec<_>>());
        }
    }
}
