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

use crate::double_double::Double;

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
pub fn locally_delaunay(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> bool {
    // Two acute angles opposite the edge sum to less than 180 degrees.
    if surely_acute(a - b, c - b) && surely_acute(a - d, c - d) {
        return true;
    }
    if let Some(delaunay) = decided_by_angles([a, b, c, d]) {
        return delaunay;
    }
    // Positions that are not finite compare as false.
    !(incircle(a, b, c, d) > 0.0 && orient2d(a, b, c) > 0.0 && orient2d(a, c, d) > 0.0)
}

/// Decides, in double-double arithmetic, all but the quadrilaterals that are
/// cocircular to more than 28 digits or exactly: `Some(true)` if the edge is
/// Delaunay, `None` if the exact test has to find out.
///
/// With the angles `beta` at `b` and `delta` at `d` the in-circle determinant
/// is the negative of
///
/// ```text
///   |ba| |bc| |da| |dc| sin(beta + delta) = cross_b dot_d + dot_b cross_d.
/// ```
///
/// Products are good to 7 `u^2`, sums to 4 `u^2` (u = 2^-53), so crosses and
/// dots are good to 11 `u^2` of `m`, the sum of the magnitudes of their terms,
/// the two products to `(11 + 11 + 7) u^2 m_b m_d`, and their sum to 4 more:
/// 33 `u^2`, with terms of third order and the rounding of the bound below
/// `64 u^2 = 2^-100`.
fn decided_by_angles([a, b, c, d]: [DVec2; 4]) -> Option<bool> {
    let at_b = Corner::new(b, c, a);
    let at_d = Corner::new(d, a, c);
    if at_b.is_exactly_right() && at_d.is_exactly_right() {
        return Some(true);
    }
    let sum = (at_b.cross * at_d.dot + at_b.dot * at_d.cross).hi;
    let magnitude = at_b.cross_terms * at_d.dot_terms + at_b.dot_terms * at_d.cross_terms;
    // 2^4 (2^-52)^2 = 2^-100
    let error = 16.0 * f64::EPSILON * f64::EPSILON * magnitude;
    // Where the sum of the angles exceeds 180 degrees it takes both triangles
    // to be counter-clockwise, which is for the exact test to say.
    (sum > error && at_b.cross.hi > 0.0 && at_d.cross.hi > 0.0).then_some(true)
}

/// Cross and dot product of two vectors from a common origin.
struct Corner {
    cross: Double,
    dot: Double,
    /// Sums of the magnitudes of the terms.
    cross_terms: f64,
    dot_terms: f64,
    /// Whether the components of the vectors are doubles.
    exact: bool,
}

impl Corner {
    fn new(origin: DVec2, to: DVec2, and: DVec2) -> Self {
        let [ux, uy] = [(to.x, origin.x), (to.y, origin.y)].map(|(p, q)| Double::difference(p, q));
        let [wx, wy] = [(and.x, origin.x), (and.y, origin.y)].map(|(p, q)| Double::difference(p, q));
        let (left, right) = (ux * wy, uy * wx);
        let (x, y) = (ux * wx, uy * wy);
        Self {
            cross: left - right,
            dot: x + y,
            cross_terms: left.hi.abs() + right.hi.abs(),
            dot_terms: x.hi.abs() + y.hi.abs(),
            exact: [ux, uy, wx, wy].iter().all(|c| c.lo == 0.0),
        }
    }

    /// Products of doubles are exact and a sum is zero only if it is exactly.
    fn is_exactly_right(&self) -> bool {
        self.exact && self.dot.hi == 0.0
    }
}

/// Whether the vectors, each a rounded difference of two points, enclose an
/// acute angle for certain.
///
/// Each component is within a factor `1 +- u` of the true difference (u =
/// 2^-53), each product within `(1 +- u)^3`, their sum within one more: the
/// error is below `4.1 u (|x1 x2| + |y1 y2|)`; 8 u covers the rounding of the
/// bound as well.
#[inline]
pub(crate) fn surely_acute(u: DVec2, w: DVec2) -> bool {
    let (x, y) = (u.x * w.x, u.y * w.y);
    x + y > 4.0 * f64::EPSILON * (x.abs() + y.abs())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

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
        assert!(!locally_delaunay(a, b, c, DVec2::new(0.0, 1.0_f64.next_down())));
    }

    /// All on a circle of radius 5, but for `a`, which is 8e-32 outside, so that the angles at `b` and `d` sum to
    /// more than 180 degrees. Double-double arithmetic cannot tell.
    #[test]
    fn what_double_doubles_cannot_tell_is_left_to_the_exact_test() {
        let [b, c, d] = [DVec2::new(3.0, -4.0), DVec2::new(5.0, 0.0), DVec2::new(4.0, 3.0)];
        assert!(locally_delaunay(DVec2::new(-5.0, 0.0), b, c, d));
        let a = DVec2::new(-5.0, 0.5_f64.powi(50));
        assert_eq!(decided_by_angles([a, b, c, d]), None);
        assert!(!locally_delaunay(a, b, c, d));
    }

    proptest! {
        /// Cocircular but for rounding, and but for a displacement.
        #[test]
        fn the_short_cuts_are_exact(
            turns in prop::array::uniform4(0.05..1.5f64),
            center in (-9.0..9.0f64, -9.0..9.0f64),
            off in -1e-13..1e-13f64,
            grid in 0_i32..3,
        ) {
            let mut turn = 0.0;
            let quad = turns.map(|t| {
                turn += t;
                let p = DVec2::new(center.0 + libm::cos(turn), center.1 + libm::sin(turn));
                // Coarse coordinates make exact differences likely.
                if grid == 0 { (p * 8.0).round() } else { p }
            });
            let [a, b, c, d] = quad;
            let d = if grid == 2 { d + DVec2::new(off, 0.0) } else { d };
            prop_assume!(orient2d(a, b, c) > 0.0 && orient2d(a, c, d) > 0.0);
            prop_assert_eq!(locally_delaunay(a, b, c, d), incircle(a, b, c, d) <= 0.0);
        }

        #[test]
        fn rectangles_are_cocircular(v in prop::array::uniform4(-50_i8..50), scale in -40_i32..40) {
            let [x, y, i, j] = v.map(|k| f64::from(k) * 2f64.powi(scale));
            let (u, w) = (DVec2::new(i, j), DVec2::new(-j, i) * 3.0);
            let a = DVec2::new(x, y);
            prop_assert_eq!(incircle(a, a + u, a + u + w, a + w), 0.0);
            prop_assert!(locally_delaunay(a, a + u, a + u + w, a + w));
        }
    }

    /// What is not counter-clockwise is for others to complain about, also where the circle is a
    /// line and the fourth point on its left.
    #[test]
    fn flat_triangles_are_locally_delaunay() {
        let [a, c] = [DVec2::ZERO, DVec2::new(2.0, 0.0)];
        for (b, d) in [(DVec2::X, DVec2::ONE), (DVec2::new(1.0, -1.0), DVec2::X)] {
            assert!(incircle(a, b, c, d) > 0.0 && orient2d(a, b, c) * orient2d(a, c, d) == 0.0);
            assert!(locally_delaunay(a, b, c, d), "{b} {d}");
        }
    }

    /// The exact test has nothing to do for what is a few last places from a circle, whatever its size.
    #[test]
    fn angles_decide_all_but_the_cocircular() {
        for scale in [-40, 0, 40].map(|k| 2f64.powi(k)) {
            // The angle at b is obtuse. Ten last places of 5 are 2^-47.
            let decided = |down: f64| {
                let quad = [(4.0, 3.0), (0.0, 5.0), (-4.0, 3.0), (0.0, -5.0 - down)];
                decided_by_angles(quad.map(|(x, y)| scale * DVec2::new(x, y)))
            };
            let off = 2f64.powi(-47);
            assert_eq!([-off, 0.0, off].map(decided), [None, None, Some(true)], "{scale:e}");
        }
        let [a, c] = [DVec2::ZERO, DVec2::X];
        let (flat, below) = (DVec2::new(3.0, 0.0), DVec2::new(0.5, -1.0));
        assert_eq!(decided_by_angles([a, below, c, flat]), None);
        assert_eq!(decided_by_angles([a, flat, c, -below]), None);
        // Two right angles.
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        assert_eq!(decided_by_angles(square), Some(true));
    }

    #[test]
    fn angles_are_surely_acute_up_to_rounding() {
        for scale in [-40, 0, 40].map(|k| 2f64.powi(k)) {
            let acute = |w: DVec2| surely_acute(scale * DVec2::ONE, scale * w);
            assert!(acute(DVec2::X) && acute(DVec2::new(2f64.powi(-40) - 1.0, 1.0)), "{scale:e}");
            // Right, obtuse, and acute by less than the differences may be off.
            let excess = [0.0, -0.5, f64::EPSILON];
            assert!(excess.into_iter().all(|x| !acute(DVec2::new(x - 1.0, 1.0))), "{scale:e}");
        }
    }

    #[test]
    fn not_finite_does_not_panic() {
        let nan = DVec2::splat(f64::NAN);
        let inf = DVec2::splat(f64::INFINITY);
        let _ = (orient2d(nan, inf, DVec2::X), incircle(DVec2::X, nan, inf, DVec2::Y));
    }
}
