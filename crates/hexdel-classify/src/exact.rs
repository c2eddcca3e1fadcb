//! Angle bounds in integer arithmetic.
//!
//! In axial coordinates the lattice's metric is rational: with `u`, `w` the two
//! edge vectors at a corner,
//!
//! ```text
//!   2 u.w = 2 uq wq + 2 ur wr + uq wr + ur wq  =: D
//!   u x w = sqrt(3)/2 (uq wr - ur wq)          =: sqrt(3)/2 X
//! ```
//!
//! so the angle's tangent is `sqrt(3) X / D`. The smallest angle of section 5.4
//! has tangent `5 / (3 sqrt 3)`, hence `angle >= 43.89 degrees` is `9 X >= 5 D`:
//! no rounding, no tolerance. All templates of [`crate::relocate`] are multiples
//! of `1 / Offset::UNIT` of a lattice step.

use hexdel_grid::Hex;
use std::ops::{Add, Neg, Sub};

/// A vector on the lattice in units of `1 / UNIT` of a step, axial coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Offset {
    /// Along direction 0.
    pub q: i64,
    /// Along direction 1.
    pub r: i64,
}

impl Offset {
    /// Units per lattice step: a common multiple of the templates' denominators
    /// 5, 6, 9, 10, 12 and 156.
    pub const UNIT: i64 = 4680;

    /// No offset.
    pub const ZERO: Self = Self { q: 0, r: 0 };

    /// `numerator / denominator` of a lattice vector.
    ///
    /// # Panics
    ///
    /// If the result is no multiple of `1 / UNIT`, or out of range.
    #[inline]
    pub const fn fraction(of: Hex, numerator: i64, denominator: i64) -> Self {
        const fn exact(x: i64, numerator: i64, denominator: i64) -> i64 {
            let product = x as i128 * numerator as i128 * Offset::UNIT as i128;
            let quotient = product / denominator as i128;
            assert!(quotient * denominator as i128 == product, "no multiple of 1 / UNIT");
            assert!(quotient as i64 as i128 == quotient, "out of range");
            quotient as i64
        }
        Self { q: exact(of.q, numerator, denominator), r: exact(of.r, numerator, denominator) }
    }

    /// A hexagon's centre.
    #[inline]
    pub const fn of(hex: Hex) -> Self {
        Self { q: hex.q * Self::UNIT, r: hex.r * Self::UNIT }
    }

    /// The vector in units of a lattice step, Cartesian.
    #[inline]
    pub fn cartesian(self) -> hexdel_geom::DVec2 {
        const HALF_SQRT_3: f64 = hexdel_geom::double_double::Double::HALF_SQRT_3.hi;
        let unit = Self::UNIT as f64;
        hexdel_geom::DVec2::new(
            (2 * self.q + self.r) as f64 / (2.0 * unit),
            self.r as f64 * HALF_SQRT_3 / unit,
        )
    }

    /// Twice the scalar product, in units of `UNIT^-2`.
    #[inline]
    pub const fn dot2(self, w: Self) -> i64 {
        2 * (self.q * w.q + self.r * w.r) + self.q * w.r + self.r * w.q
    }

    /// The determinant: the cross product over `sqrt(3)/2`.
    #[inline]
    pub const fn det(self, w: Self) -> i64 {
        self.q * w.r - self.r * w.q
    }
}

impl Add for Offset {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        Self { q: self.q + o.q, r: self.r + o.r }
    }
}

impl Sub for Offset {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        Self { q: self.q - o.q, r: self.r - o.r }
    }
}

impl Neg for Offset {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { q: -self.q, r: -self.r }
    }
}

/// Angle bounds whose tangents are rational multiples of `sqrt(3)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExactBounds {
    /// `(x, d)`: an angle is large enough if `x X >= d D`.
    min: (i64, i64),
    /// `(x, d)`: an angle is small enough if `x X >= -d D`.
    max: (i64, i64),
}

impl ExactBounds {
    /// 43.89 to 90 degrees: `sqrt(3) X / D >= 5 / (3 sqrt 3)`, and `D >= 0`.
    pub const EXTENDED: Self = Self { min: (9, 5), max: (0, -1) };

    /// 30 to 120 degrees: `sqrt(3) X / D >= 1 / sqrt(3)`, and
    /// `sqrt(3) X >= -sqrt(3) D`.
    pub const SIMPLE: Self = Self { min: (3, 1), max: (1, -1) };

    /// Whether a counter-clockwise triangle keeps the bounds.
    #[inline]
    pub const fn hold(&self, corners: [Offset; 3]) -> bool {
        let [a, b, c] = corners;
        self.hold_at(a, b, c) && self.hold_at(b, c, a) && self.hold_at(c, a, b)
    }

    /// Whether the angle at `a` of the counter-clockwise triangle `a b c` keeps the
    /// bounds.
    #[inline]
    pub const fn hold_at(&self, a: Offset, b: Offset, c: Offset) -> bool {
        let (u, w) = (Offset { q: b.q - a.q, r: b.r - a.r }, Offset { q: c.q - a.q, r: c.r - a.r });
        let (x, d) = (u.det(w), u.dot2(w));
        x > 0 && self.min.0 * x >= self.min.1 * d && self.max.0 * x >= self.max.1 * d
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::AngleBounds;

    fn angles_deg(t: [Offset; 3]) -> [f64; 3] {
        let p = t.map(Offset::cartesian);
        std::array::from_fn(|i| {
            let (u, w) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            u.perp_dot(w).atan2(u.dot(w)).to_degrees()
        })
    }

    #[test]
    fn integers_agree_with_angles() {
        let cases =
            [(ExactBounds::EXTENDED, AngleBounds::EXTENDED), (ExactBounds::SIMPLE, AngleBounds::SIMPLE)];
        let points: Vec<_> = (0..400_i64)
            .map(|i| Offset { q: i * 7919 % 9001 - 4500, r: i * 104_729 % 8999 - 4500 })
            .collect();
        for (exact, bounds) in cases {
            for t in points.windows(3).map(|w| [w[0], w[1], w[2]]) {
                let inside = angles_deg(t).iter().all(|a| (bounds.min_deg()..=bounds.max_deg()).contains(a));
                assert_eq!(exact.hold(t), inside, "{t:?} {:?}", angles_deg(t));
            }
        }
    }

    #[test]
    #[should_panic(expected = "no multiple")]
    fn a_fraction_that_is_not_exact_is_refused() {
        let _ = Offset::fraction(Hex::new(1, 0), 1, 7);
    }

    #[test]
    fn the_bounds_themselves_are_inside() {
        let corner = |q, r| Offset { q, r };
        // Half of an equilateral triangle: 30, 60, 90 degrees.
        let half = [corner(0, 0), corner(2, 0), corner(0, 1)];
        assert!(ExactBounds::SIMPLE.hold([corner(0, 0), corner(1, 0), corner(0, 2)]));
        assert!(!ExactBounds::EXTENDED.hold(half));
        // The extreme triangle of section 5.4: legs 5 and 3 sqrt(3).
        let extreme = [Offset::ZERO, corner(-3, 6), corner(-3 - 5, 6)];
        assert!(!ExactBounds::EXTENDED.hold([extreme[0], extreme[2], extreme[1]]));
        assert!(ExactBounds::EXTENDED.hold(extreme), "{:?}", angles_deg(extreme));
    }
}
