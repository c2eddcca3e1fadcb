//! Double-double arithmetic, as little as the lattice needs.
//!
//! A lattice point deep in the hierarchy is the sum of an origin and a large
//! multiple of a small spacing. Evaluated in plain `f64` it would carry an
//! error of the size of the *domain's* last place; evaluated here it is off by
//! the *result's* last place only, which is what lets two sites `1e-15` of the
//! domain apart still have an exact grid around them.
//!
//! References: T. J. Dekker, "A floating-point technique for extending the
//! available precision", 1971; D. E. Knuth, TAOCP 2, section 4.2.2.

use std::ops::{Add, Sub};

/// The unevaluated sum `hi + lo` with `|lo| <= ulp(hi) / 2`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Double {
    /// The nearest `f64`.
    pub hi: f64,
    /// What `hi` misses.
    pub lo: f64,
}

impl Double {
    /// `sqrt(3) / 2` to 106 bits.
    pub const HALF_SQRT_3: Self = Self { hi: 0.866_025_403_784_438_6, lo: 5.017_542_110_903_451_4e-17 };

    /// `a + b`, exactly.
    #[inline]
    pub fn sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        let t = hi - a;
        Self { hi, lo: (a - (hi - t)) + (b - t) }
    }

    /// `a * b`, exactly unless the split overflows (`|a|` or `|b|` above 1e300)
    /// or the low part underflows.
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        let hi = a * b;
        let ((ah, al), (bh, bl)) = (split(a), split(b));
        Self { hi, lo: ((ah * bh - hi) + ah * bl + al * bh) + al * bl }
    }

    /// This number times `b`, to about 104 bits.
    #[inline]
    #[must_use]
    pub fn times(self, b: f64) -> Self {
        let p = Self::product(self.hi, b);
        Self::sum(p.hi, p.lo + self.lo * b)
    }

    /// The nearest `f64`.
    #[inline]
    pub fn value(self) -> f64 {
        self.hi + self.lo
    }
}

/// The upper and lower 26 bits of a number's mantissa.
#[inline]
fn split(a: f64) -> (f64, f64) {
    // 2^27 + 1: Veltkamp's constant for a mantissa of 53 bits.
    let t = 134_217_729.0 * a;
    let hi = t - (t - a);
    (hi, a - hi)
}

impl From<f64> for Double {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Add for Double {
    type Output = Self;
    #[inline]
    fn add(self, o: Self) -> Self {
        let s = Self::sum(self.hi, o.hi);
        let t = Self::sum(self.lo, o.lo);
        let u = Self::sum(s.hi, s.lo + t.hi);
        Self::sum(u.hi, u.lo + t.lo)
    }
}

impl Sub for Double {
    type Output = Self;
    #[inline]
    fn sub(self, o: Self) -> Self {
        self + Self { hi: -o.hi, lo: -o.lo }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_products_keep_what_f64_loses() {
        let s = Double::sum(1.0, 1e-20);
        assert_eq!((s.hi, s.lo), (1.0, 1e-20));
        let e = f64::EPSILON;
        let p = Double::product(1.0 + e, 1.0 - e);
        assert_eq!((p.hi, p.lo), (1.0, -e * e));
        assert_eq!((s - Double::from(1.0)).value(), 1e-20);
    }

    #[test]
    fn the_constant_squares_to_three_quarters() {
        let c = Double::HALF_SQRT_3;
        let square = c.times(c.hi) + c.times(c.lo);
        assert!((square - Double::from(0.75)).value().abs() < 1e-31);
    }
}
