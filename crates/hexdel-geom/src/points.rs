//! The validated input: finite points, duplicates merged.
//!
//! Everything later is entitled to sites that are finite and pairwise
//! distinct. What the points mean is left to others.

use crate::par::prelude::*;
use glam::DVec2;
use thiserror::Error;

/// Why a list of points is no input.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PointsError {
    /// There is no point at all.
    #[error("the input has no points")]
    Empty,
    /// A coordinate is infinite or not a number.
    #[error("point {index} at ({}, {}) is not finite", .point.x, .point.y)]
    NotFinite {
        /// Position in the input, from 0.
        index: usize,
        /// The point as given.
        point: DVec2,
    },
    /// More points than a `u32` can number.
    #[error("{count} points are more than {} can number", u32::MAX)]
    TooMany {
        /// Points given.
        count: usize,
    },
}

/// Finite points with exact duplicates merged into sites.
///
/// Two points are duplicates if their coordinates compare equal: bit for bit,
/// except that `-0.0` is `0.0`. Nothing is rounded; a site has the
/// coordinates of its first occurrence as they were given.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, PointSet};
///
/// let p = DVec2::new(1.0, 2.0);
/// let set = PointSet::new(&[p, DVec2::ZERO, p])?;
/// assert_eq!(set.sites(), [p, DVec2::ZERO]);
/// assert_eq!(set.site_of_input(), [0, 1, 0]);
/// # Ok::<(), hexdel_geom::PointsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PointSet {
    /// Pairwise distinct, finite, in order of first occurrence, never empty.
    sites: Vec<DVec2>,
    /// For each input point its site; every site occurs.
    site_of_input: Vec<u32>,
    /// For each site its first input point; strictly increasing.
    input_of_site: Vec<u32>,
}

impl PointSet {
    /// Validates `points` and merges duplicates.
    ///
    /// # Errors
    ///
    /// [`PointsError`], naming the first offending point.
    ///
    /// # Complexity
    ///
    /// `O(n log n)`.
    pub fn new(points: &[DVec2]) -> Result<Self, PointsError> {
        if points.is_empty() {
            return Err(PointsError::Empty);
        }
        if u32::try_from(points.len()).is_err() {
            return Err(PointsError::TooMany { count: points.len() });
        }
        if let Some(index) = points.iter().position(|p| !p.is_finite()) {
            return Err(PointsError::NotFinite { index, point: points[index] });
        }
        let first = first_occurrences(points);
        let mut set = Self {
            sites: Vec::new(),
            site_of_input: Vec::with_capacity(points.len()),
            input_of_site: Vec::new(),
        };
        for (i, &f) in first.iter().enumerate() {
            if f as usize == i {
                set.site_of_input.push(set.sites.len() as u32);
                set.sites.push(points[i]);
                set.input_of_site.push(f);
            } else {
                set.site_of_input.push(set.site_of_input[f as usize]);
            }
        }
        Ok(set)
    }

    /// The distinct points, in order of first occurrence.
    pub fn sites(&self) -> &[DVec2] {
        &self.sites
    }

    /// For each input point the position of its site in [`Self::sites`].
    pub fn site_of_input(&self) -> &[u32] {
        &self.site_of_input
    }

    /// For each site the position of its first occurrence in the input.
    pub fn input_of_site(&self) -> &[u32] {
        &self.input_of_site
    }
}

/// The coordinates as bits, `-0.0` taken for `0.0`: equal exactly for points
/// that compare equal. The order of the keys means nothing.
pub(crate) fn coordinate_key(p: DVec2) -> [u64; 2] {
    // Adding a positive zero turns -0.0 into 0.0 and keeps every other value.
    [(p.x + 0.0).to_bits(), (p.y + 0.0).to_bits()]
}

/// For each point the position of the first point equal to it.
fn first_occurrences(points: &[DVec2]) -> Vec<u32> {
    let mut keys: Vec<([u64; 2], u32)> =
        points.iter().enumerate().map(|(i, &p)| (coordinate_key(p), i as u32)).collect();
    // Positions make the keys distinct, so an unstable sort has one outcome.
    keys.par_sort_unstable();
    let mut first = vec![0; points.len()];
    for run in keys.chunk_by(|a, b| a.0 == b.0) {
        for &(_, i) in run {
            first[i as usize] = run[0].1;
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn names_what_is_wrong() {
        assert_eq!(PointSet::new(&[]), Err(PointsError::Empty));
        let bad = DVec2::new(f64::INFINITY, 3.0);
        let err = PointSet::new(&[DVec2::ZERO, bad]).unwrap_err();
        assert_eq!(err, PointsError::NotFinite { index: 1, point: bad });
        assert_eq!(err.to_string(), "point 1 at (inf, 3) is not finite");
        assert!(PointSet::new(&[DVec2::new(0.0, f64::NAN)]).is_err());
    }

    #[test]
    fn zero_has_one_sign() {
        let set = PointSet::new(&[DVec2::new(-0.0, 1.0), DVec2::new(0.0, 1.0)]).unwrap();
        assert_eq!(set.sites().len(), 1);
        assert!(set.sites()[0].x.is_sign_negative(), "the first occurrence as given");
    }

    proptest! {
        #[test]
        fn merges_exactly_the_equal(raw in prop::collection::vec((-3i8..3, -3i8..3), 1..80)) {
            let points: Vec<DVec2> =
                raw.iter().map(|&(x, y)| DVec2::new(f64::from(x), f64::from(y)) * 0.1).collect();
            let set = PointSet::new(&points).unwrap();
            for (i, p) in points.iter().enumerate() {
                let site = set.site_of_input()[i] as usize;
                prop_assert_eq!(set.sites()[site], *p);
                let first = points.iter().position(|q| q == p).unwrap();
                prop_assert_eq!(set.input_of_site()[site] as usize, first);
            }
            prop_assert!(set.input_of_site().is_sorted_by(|a, b| a < b));
        }
    }
}
