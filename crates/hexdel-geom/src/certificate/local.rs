//! The certificate's questions about single triangles and edges, for those
//! who change a few triangles of a certified mesh.

use glam::DVec2;

use super::triangles::{Fit, check_angles_at};
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
    keeps_bounds_at(corners, bounds, [true; 3])
}

/// The same where the lower bound counts at the corners marked in `lower` only:
/// at others the angle is the input's.
///
/// ```
/// use hexdel_geom::{AngleBounds, DVec2, keeps_bounds_at};
///
/// let sliver = [DVec2::ZERO, DVec2::new(1.0, -0.1), DVec2::new(1.0, 0.1)];
/// assert!(keeps_bounds_at(sliver, AngleBounds::EXTENDED, [false, true, true]));
/// assert!(!keeps_bounds_at(sliver, AngleBounds::EXTENDED, [true; 3]));
/// ```
pub fn keeps_bounds_at(corners: [DVec2; 3], bounds: AngleBounds, lower: [bool; 3]) -> bool {
    let [a, b, c] = corners;
    corners.iter().all(|p| p.is_finite())
        && orient2d(a, b, c) > 0.0
        && !matches!(check_angles_at(corners, bounds, lower), Fit::Outside { .. })
}
