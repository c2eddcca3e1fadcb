//! Numbers with twice the precision: an unevaluated sum of two doubles.
//!
//! The algorithms and their error bounds are those of Joldes, Muller and
//! Popescu, "Tight and rigorous error bounds for basic building blocks of
//! double-word arithmetic", 2017, with Dekker's product, as a fused
//! multiply-add is no part of every platform's baseline. Bounds are relative,
//! in units of `u^2 = 2^-106`, and hold short of overflow and underflow.

/// `hi + lo`, with `|lo|` at most half an ulp of `hi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Double {
    pub(crate) hi: f64,
    pub(crate) lo: f64,
}

impl Double {
    /// `a - b`, exactly.
    #[inline]
    pub(crate) fn difference(a: f64, b: f64) -> Self {
        two_sum(a, -b)
    }

    /// The product, to 7 units.
    #[inline]
    pub(crate) fn times(self, y: Self) -> Self {
        let Self { hi, lo } = two_product(self.hi, y.hi);
        fast_two_sum(hi, lo + (self.hi * y.lo + self.lo * y.hi))
    }

    /// The sum, to 4 units; zero only if it is exactly zero.
    #[inline]
    pub(crate) fn plus(self, y: Self) -> Self {
        let s = two_sum(self.hi, y.hi);
        let t = two_sum(self.lo, y.lo);
        let v = fast_two_sum(s.hi, s.lo + t.hi);
        fast_two_sum(v.hi, t.lo + v.lo)
    }

    #[inline]
    pub(crate) fn negated(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

/// `a + b`, exactly (Knuth).
#[inline]
fn two_sum(a: f64, b: f64) -> Double {
    let hi = a + b;
    let b_part = hi - a;
    let a_part = hi - b_part;
    Double { hi, lo: (a - a_part) + (b - b_part) }
}

/// `a + b`, exactly, if `a` is zero or has no smaller exponent (Dekker).
#[inline]
fn fast_two_sum(a: f64, b: f64) -> Double {
    let hi = a + b;
    Double { hi, lo: b - (hi - a) }
}

/// `a * b`, exactly (Dekker).
#[inline]
fn two_product(a: f64, b: f64) -> Double {
    let hi = a * b;
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    Double { hi, lo: al * bl - (((hi - ah * bh) - al * bh) - ah * bl) }
}

/// Two parts of 26 bits each (Veltkamp).
#[inline]
fn halves(a: f64) -> (f64, f64) {
    // 2^27 + 1
    let c = 134_217_729.0 * a;
    let high = c - (c - a);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_what_doubles_lose() {
        let d = Double::difference(1.0, 1e-20);
        assert_eq!(d, Double { hi: 1.0, lo: -1e-20 });
        // (1 - e)(1 + e) - 1 = -e^2 is lost in doubles.
        let e = 2f64.powi(-40);
        let product = Double::difference(1.0, e).times(Double::difference(1.0, -e));
        let rest = product.plus(Double { hi: -1.0, lo: 0.0 });
        assert_eq!(rest, Double { hi: -e * e, lo: 0.0 });
        assert_eq!(product.plus(product.negated()), Double { hi: 0.0, lo: 0.0 });
    }
}
