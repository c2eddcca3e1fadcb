//! Numbers with twice the precision: an unevaluated sum of two doubles.
//!
//! A lattice point deep in the hierarchy is the sum of an origin and a large
//! multiple of a small spacing. Evaluated in plain `f64` it would carry an
//! error of the size of the *domain's* last place; evaluated here it is off by
//! the *result's* last place only. The predicates decide with it what plain
//! doubles leave open.
//!
//! The algorithms and their error bounds are those of Joldes, Muller and
//! Popescu, "Tight and rigorous error bounds for basic building blocks of
//! double-word arithmetic", 2017, with Dekker's product, as a fused
//! multiply-add is no part of every platform's baseline. Bounds are relative,
//! in units of `u^2 = 2^-106`, and hold short of overflow and underflow.

use std::ops::{Add, Mul, Neg, Sub};

/// `hi + lo`, with `|lo|` at most half an ulp of `hi`.
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

    /// `a + b`, exactly (Knuth).
    #[inline]
    pub fn sum(a: f64, b: f64) -> Self {
        let hi = a + b;
        let b_part = hi - a;
        let a_part = hi - b_part;
        Self { hi, lo: (a - a_part) + (b - b_part) }
    }

    /// `a - b`, exactly.
    #[inline]
    pub fn difference(a: f64, b: f64) -> Self {
        Self::sum(a, -b)
    }

    /// `a * b`, exactly (Dekker), unless the split overflows (`|a|` or `|b|`
    /// above 1e300) or the low part underflows.
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        let hi = a * b;
        let ((ah, al), (bh, bl)) = (halves(a), halves(b));
        Self { hi, lo: al * bl - (((hi - ah * bh) - al * bh) - ah * bl) }
    }

    /// This number times `b`, to 3 units.
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

/// `a + b`, exactly, if `a` is zero or has no smaller exponent (Dekker).
#[inline]
fn fast_sum(a: f64, b: f64) -> Double {
    let hi = a + b;
    Double { hi, lo: b - (hi - a) }
}

/// Two parts of 26 bits each (Veltkamp).
#[inline]
fn halves(a: f64) -> (f64, f64) {
    // 2^27 + 1
    let c = 134_217_729.0 * a;
    let high = c - (c - a);
    (high, a - high)
}

impl From<f64> for Double {
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Add for Double {
    type Output = Self;

    /// The sum, to 4 units; zero only if it is exactly zero.
    #[inline]
    fn add(self, y: Self) -> Self {
        let s = Self::sum(self.hi, y.hi);
        let t = Self::sum(self.lo, y.lo);
        let v = fast_sum(s.hi, s.lo + t.hi);
        fast_sum(v.hi, t.lo + v.lo)
    }
}

impl Neg for Double {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Double {
    type Output = Self;
    #[inline]
    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

impl Mul for Double {
    type Output = Self;

    /// The product, to 7 units.
    #[inline]
    fn mul(self, y: Self) -> Self {
        let Self { hi, lo } = Self::product(self.hi, y.hi);
        fast_sum(hi, lo + (self.hi * y.lo + self.lo * y.hi))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn keeps_what_doubles_lose() {
        let d = Double::difference(1.0, 1e-20);
        assert_eq!(d, Double { hi: 1.0, lo: -1e-20 });
        // (1 - e)(1 + e) - 1 = -e^2 is lost in doubles.
        let e = 2f64.powi(-40);
        let product = Double::difference(1.0, e) * Double::difference(1.0, -e);
        assert_eq!(product - Double::from(1.0), Double { hi: -e * e, lo: 0.0 });
        assert_eq!(product - product, Double { hi: 0.0, lo: 0.0 });
        assert_eq!((Double::sum(1.0, 1e-20) - Double::from(1.0)).value(), 1e-20);
        let u = f64::EPSILON;
        assert_eq!(Double::product(1.0 + u, 1.0 - u), Double { hi: 1.0, lo: -u * u });
    }

    #[test]
    fn the_constant_squares_to_three_quarters() {
        let c = Double::HALF_SQRT_3;
        assert!((c * c - Double::from(0.75)).value().abs() < 1e-31);
        assert!((c.times(c.hi) + c.times(c.lo) - Double::from(0.75)).value().abs() < 1e-31);
    }

    /// The value of a sum of two integers.
    fn integer(d: Double) -> i128 {
        d.hi as i128 + d.lo as i128
    }

    proptest! {
        #[test]
        fn products_are_exact_at_any_scale(
            a in 1u64 << 52..1 << 53,
            b in 1u64 << 52..1 << 53,
            scales in [-300..300, -300..300],
        ) {
            let [s, t] = scales.map(|k| 2f64.powi(k));
            let p = Double::product(a as f64 * s, b as f64 * t);
            let unscaled = Double { hi: p.hi / s / t, lo: p.lo / s / t };
            prop_assert_eq!(integer(unscaled), i128::from(a) * i128::from(b));
        }

        /// Four units of these sums are below one half.
        #[test]
        fn sums_and_differences_are_exact_to_four_units(
            hi in [1i128 << 52..1 << 53, 1i128 << 52..1 << 53],
            lo in [-1i128 << 46..1 << 46, -1i128 << 46..1 << 46],
        ) {
            let [a, b] = [0, 1].map(|i| Double { hi: (hi[i] << 47) as f64, lo: lo[i] as f64 });
            prop_assert_eq!(integer(a + b), integer(a) + integer(b));
            prop_assert_eq!(integer(a - b), integer(a) - integer(b));
        }
    }
}
