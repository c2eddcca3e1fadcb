//! Measures of one triangle.
//!
//! Plain floating-point formulas on three corners; statistics and promises
//! over a mesh are the certificate's. Angles come from a portable arc tangent,
//! so they are the same bits on every platform.

use glam::DVec2;

/// The angles at the three corners, radians.
///
/// Signed: positive for a counter-clockwise triangle, where they sum to pi;
/// negative for a clockwise one. Zeros and pis (or a zero for coincident
/// corners) for a degenerate one.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, quality};
///
/// let angles = quality::angles_deg([DVec2::ZERO, DVec2::X, DVec2::Y]);
/// assert_eq!(angles, [90.0, 45.0, 45.0]);
/// ```
pub fn angles_rad(corners: [DVec2; 3]) -> [f64; 3] {
    let [a, b, c] = corners;
    [angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)]
}

/// The angles at the three corners, degrees. Signed as [`angles_rad`].
pub fn angles_deg(corners: [DVec2; 3]) -> [f64; 3] {
    angles_rad(corners).map(f64::to_degrees)
}

/// The angles at the three corners, degrees, 0 to 180 whatever the orientation; zeros for coincident
/// corners.
///
/// For display: accurate to a few units in the last place for triangles of any size, and the same on
/// every platform. No verdict on a mesh rests on them, that is the certificate's business.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, quality};
///
/// let clockwise = [DVec2::ZERO, DVec2::Y, DVec2::X].map(|p| p * 1e-200);
/// assert_eq!(quality::unsigned_angles_deg(clockwise), [90.0, 45.0, 45.0]);
/// ```
pub fn unsigned_angles_deg(corners: [DVec2; 3]) -> [f64; 3] {
    // Halved before the subtraction and scaled after it, no difference overflows
    // and no product under- or overflows that matters.
    let [a, b, c] = corners.map(|p| p * 0.5);
    let sides = [b - a, c - b, a - c];
    let scale = sides.iter().map(|s| s.abs().max_element()).fold(0.0, f64::max);
    if scale == 0.0 {
        return [0.0; 3];
    }
    let [ab, bc, ca] = sides.map(|s| s / scale);
    [unsigned_angle(ab, -ca), unsigned_angle(bc, -ab), unsigned_angle(ca, -bc)]
}

/// Circumradius over twice the inradius: 1 for the equilateral triangle,
/// larger for every other, infinite for a degenerate one. The orientation
/// does not matter.
///
/// With sides a, b, c and area A the circumradius is `abc / 4A`, the inradius
/// `2A / (a + b + c)`.
pub fn aspect_ratio(corners: [DVec2; 3]) -> f64 {
    let [a, b, c] = corners;
    let sides = [b - a, c - b, a - c];
    let longest = sides.iter().flat_map(|s| [s.x.abs(), s.y.abs()]).fold(0.0, f64::max);
    let [ab, bc, ca] = sides.map(|s| s / longest);
    let ratio = aspect_of([ab, bc, ca].map(DVec2::length), ab.perp_dot(-ca));
    // Coincident corners are 0 / 0.
    if ratio.is_nan() { f64::INFINITY } else { ratio }
}

/// [`aspect_ratio`] from the side lengths and twice the area.
#[inline]
pub(crate) fn aspect_of(sides: [f64; 3], twice_area: f64) -> f64 {
    let [a, b, c] = sides;
    let inv = 1.0 / twice_area;
    0.25 * (a * b * inv) * (c * (a + b + c) * inv)
}

/// Length of the shortest side.
pub fn shortest_edge(corners: [DVec2; 3]) -> f64 {
    let [a, b, c] = corners;
    a.distance(b).min(b.distance(c)).min(c.distance(a))
}

/// What rounding the corners alone may do to an angle, degrees: no more than the
/// certificate grants, which is `ulp(x) (1/|ab| + 1/|ac|)` radians at least for
/// the largest coordinate `x`, and `ulp(x) >= eps |x| / 2`.
pub fn rounding_deg([a, b, c]: [DVec2; 3]) -> f64 {
    let largest = a.abs().max(b.abs()).max(c.abs()).max_element();
    let longest_sq = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    (largest * f64::EPSILON / longest_sq.sqrt()).to_degrees()
}

/// Signed angle from `u` to `w`, radians.
fn angle(u: DVec2, w: DVec2) -> f64 {
    libm::atan2(u.perp_dot(w), u.dot(w))
}

/// Unsigned angle between two directions, degrees.
fn unsigned_angle(u: DVec2, v: DVec2) -> f64 {
    libm::atan2(u.perp_dot(v).abs(), u.dot(v)).to_degrees()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn equilateral_is_the_best() {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::new(0.5, 0.75_f64.sqrt())];
        assert!((aspect_ratio(corners) - 1.0).abs() < 1e-14);
        assert!(angles_deg(corners).iter().all(|a| (a - 60.0).abs() < 1e-12));
        assert!((shortest_edge(corners) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn right_isosceles() {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y];
        // R = sqrt 2 / 2, rho = 1 - sqrt 2 / 2.
        let expected = 0.5_f64.sqrt() / (2.0 - 2.0_f64.sqrt());
        assert!((aspect_ratio(corners) - expected).abs() < 1e-14);
        let [a, b, c] = corners;
        assert_eq!(angles_deg([a, c, b]), [-90.0, -45.0, -45.0]);
        assert!((aspect_ratio([a, c, b]) - expected).abs() < 1e-14);
    }

    #[test]
    fn degenerate_is_infinite() {
        assert_eq!(aspect_ratio([DVec2::ZERO, DVec2::X, DVec2::X * 3.0]), f64::INFINITY);
        assert_eq!(aspect_ratio([DVec2::X; 3]), f64::INFINITY);
        let tiny = [DVec2::ZERO, DVec2::X, DVec2::Y].map(|p| p * 1e-200);
        assert!((aspect_ratio(tiny) - 1.207_106_781_186_547_5).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn angles_sum_to_pi(v in prop::array::uniform6(-1.0..1.0f64)) {
            let corners = [DVec2::new(v[0], v[1]), DVec2::new(v[2], v[3]), DVec2::new(v[4], v[5])];
            let angles = angles_rad(corners);
            prop_assert!((angles.iter().sum::<f64>().abs() - PI).abs() < 1e-9);
            // R / 2 rho = 1 / (8 sin(A/2) sin(B/2) sin(C/2)).
            let product: f64 = angles.iter().map(|a| (a.abs() / 2.0).sin()).product();
            prop_assume!(product > 1e-6);
            prop_assert!((aspect_ratio(corners) * 8.0 * product - 1.0).abs() < 1e-6);
        }
    }
}
