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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_keeps_bounds_if_it_is_finite_counter_clockwise_and_within_them() {
        let [a, b, c] = [DVec2::ZERO, DVec2::X, DVec2::Y];
        let (fit, tight) = (AngleBounds::new(45.0, 90.0).unwrap(), AngleBounds::new(45.1, 90.0).unwrap());
        assert!(keeps_bounds([a, b, c], fit) && !keeps_bounds([a, b, c], tight));
        assert!(!keeps_bounds([a, c, b], fit) && !keeps_bounds([a, b, 2.0 * b], AngleBounds::at_least(0.0)));
        for coordinate in [f64::NAN, f64::INFINITY] {
            assert!(!keeps_bounds([a, b, DVec2::new(0.0, coordinate)], AngleBounds::at_least(0.0)));
        }
        // The lower bound counts at b and c, where angles are too small, or at a alone.
        assert!(!keeps_bounds_at([a, b, c], tight, [false, true, true]));
        assert!(keeps_bounds_at([a, b, c], tight, [true, false, false]));
    }
}
