//! The certificate's questions about single triangles and edges, for those
//! who change a few triangles of a certified mesh.

use glam::DVec2;

use super::triangles::{Fit, check_angles};
use crate::bounds::AngleBounds;
use crate::predicates::orient2d;

/// Whether [`certify`](super::certify) would find nothing wrong with the shape
/// of a triangle: finite, counter-clockwise, its angles within the bounds up
/// to tolerance and rounding.
///
/// Coordinates are to be in the range of [`predicates`](crate::predicates).
///
/// ```
/// use hexdel_geom::{AngleBounds, DVec2, keeps_bounds};
///
/// let right = [DVec2::ZERO, DVec2::X, DVec2::Y];
/// assert!(keeps_bounds(right, AngleBounds::EXTENDED));
/// assert!(!keeps_bounds([DVec2::ZERO, DVec2::Y, DVec2::X], AngleBounds::EXTENDED));
/// ```
pub fn keeps_bounds(corners: [DVec2; 3], bounds: AngleBounds) -> bool {
    let [a, b, c] = corners;
    corners.iter().all(|p| p.is_finite())
        && orient2d(a, b, c) > 0.0
        && !matches!(check_angles(corners, bounds), Fit::Outside { .. })
}
