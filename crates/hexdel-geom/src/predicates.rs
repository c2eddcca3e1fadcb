//! Geometric predicates with exact signs.
//!
//! Adaptive-precision arithmetic (Shewchuk, "Adaptive Precision
//! Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997),
//! from the crate `robust`, in terms of [`DVec2`].
//!
//! The signs are exact as long as no intermediate product overflows or
//! underflows. Products of two coordinate differences ([`orient2d`]) or four
//! ([`incircle`]), and their rounding errors, must be normal numbers:
//! coordinates and differences with magnitudes between about 1e-60 and 1e70
//! are safe for both. Beyond that the caller rescales by a power of two, as
//! the certificate does for itself.

use glam::DVec2;
use robust::Coord;

fn coord(p: DVec2) -> Coord<f64> {
    Coord { x: p.x, y: p.y }
}

/// Positive if `a`, `b`, `c` turn counter-clockwise, negative if clockwise,
/// zero if collinear; the magnitude approximates twice the triangle's area.
///
/// # Guarantees
///
/// The sign is exact within the range named in the [module docs](self).
/// Coordinates that are not finite give an unspecified result, not a panic.
#[inline]
pub fn orient2d(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// Positive if `d` is strictly inside the circle through the counter-clockwise
/// `a`, `b`, `c`, negative if strictly outside, zero if the four are
/// cocircular. For clockwise `a`, `b`, `c` the sign is the opposite.
///
/// # Guarantees
///
/// As for [`orient2d`].
#[inline]
pub fn incircle(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> f64 {
    robust::incircle(coord(a), coord(b), coord(c), coord(d))
}

/// Whether edge `a`-`c` is locally Delaunay between the triangles `a b c` and
/// `a c d`: `d` is not strictly inside the circle through `a`, `b`, `c`.
/// True where a triangle is not finite or not counter-clockwise; that is
/// another complaint.
///
/// ```text
///       c
///     / | \
///    d  |  b
///     \ | /
///       a
/// ```
#[inline]
pub(crate) fn locally_delaunay(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    // Two acute angles opposite the edge sum to less than 180 degrees.
    if surely_acute(a - b, c - b) && surely_acute(a - d, c - d) {
        return true;
    }
    // Positions that are not finite compare as false.
    !(incircle(a, b, c, d) > 0.0 && orient2d(a, b, c) > 0.0 && orient2d(a, c, d) > 0.0)
}

/// Whether the vectors, each a rounded difference of two points, enclose an
/// acute angle for certain.
///
/// Each component is within a factor `1 +- u` of the true difference (u =
/// 2^-53), each product within `(1 +- u)^3`, their sum within one more: the
/// error is below `4.1 u (|x1 x2| + |y1 y2|)`; 8 u covers the rounding of the
/// bound as well.
#[inline]
fn surely_acute(u: DVec2, w: DVec2) -> bool {
    let (x, y) = (u.x * w.x, u.y * w.y);
    x + y > 4.0 * f64::EPSILON * (x.abs() + y.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_where_rounding_lies() {
        // Collinear but for the last bit.
        let (a, b) = (DVec2::splat(0.5), DVec2::splat(12.0));
        let c = DVec2::new(24.0, 24.0);
        assert_eq!(orient2d(a, b, c), 0.0);
        assert!(orient2d(a, b, DVec2::new(24.0, 24.0_f64.next_up())) > 0.0);
        assert!(orient2d(a, b, DVec2::new(24.0, 24.0_f64.next_down())) < 0.0);
    }

    #[test]
    fn incircle_of_a_square() {
        let [a, b, c] = [DVec2::ZERO, DVec2::X, DVec2::ONE];
        assert_eq!(incircle(a, b, c, DVec2::Y), 0.0);
        assert!(incircle(a, b, c, DVec2::new(0.0, 1.0_f64.next_down())) > 0.0);
        assert!(incircle(a, b, c, DVec2::new(0.0, 1.0_f64.next_up())) < 0.0);
        assert!(locally_delaunay(a, b, c, DVec2::Y));
        assert!(!locally_delaunay(
            a,
            b,
            c,
            DVec2::new(0.0, 1.0_f64.next_down())
        ));
    }

    #[test]
    fn not_finite_does_not_panic() {
        let nan = DVec2::splat(f64::NAN);
        let inf = DVec2::splat(f64::INFINITY);
        let _ = (
            orient2d(nan, inf, DVec2::X),
            incircle(DVec2::X, nan, inf, DVec2::Y),
        );
    }
}
