//! Powers of two that bring coordinates into a range where products of
//! differences neither overflow nor underflow.
//!
//! Multiplying by a power of two is exact (short of subnormal results), so a
//! computation in the scaled frame is the computation in the original one.

use glam::DVec2;

/// Magnitude of the largest finite coordinate, 0 if there is none.
pub(crate) fn max_abs(points: &[DVec2]) -> f64 {
    points.iter().flat_map(|p| [p.x.abs(), p.y.abs()]).filter(|c| c.is_finite()).fold(0.0, f64::max)
}

/// `2^exponent`; the exponent is clamped to the normal range, -1022 to 1023.
pub(crate) fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent.clamp(-1022, 1023) + 1023) as u64) << 52)
}

/// The power of two that brings a magnitude of `max_abs` to between
/// `2^target` and `2^(target + 1)`; 1 for a magnitude of 0.
pub(crate) fn scale_to(max_abs: f64, target: i32) -> f64 {
    if max_abs == 0.0 {
        return 1.0;
    }
    let exponent = ((max_abs.to_bits() >> 52) & 0x7ff) as i32 - 1023;
    power_of_two(target - exponent)
}

/// The gap between the magnitude of `x` and the next larger double.
pub(crate) fn ulp(x: f64) -> f64 {
    let x = x.abs();
    if x == f64::MAX { x - x.next_down() } else { x.next_up() - x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scales_reach_the_target() {
        for (m, target) in [(1.0, 0), (3.5e300, 0), (1e-300, 500), (5e-324, 0), (f64::MAX, 500)] {
            let scaled: f64 = m * scale_to(m, target);
            if m > 1e-290 {
                assert!(scaled >= power_of_two(target) && scaled < power_of_two(target + 1));
            }
            assert!(scaled > 0.0 && scaled.is_finite());
        }
        assert_eq!(scale_to(0.0, 7), 1.0);
    }

    #[test]
    fn ulp_is_the_gap() {
        assert_eq!(ulp(1.0), f64::EPSILON);
        assert_eq!(ulp(-2.0), 2.0 * f64::EPSILON);
        assert!(ulp(f64::MAX).is_finite() && ulp(0.0) > 0.0);
    }
}
