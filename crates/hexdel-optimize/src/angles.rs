//! Angle bounds as polynomial tests, and how far a corner is outside of them.
//!
//! With `u` and `w` the two sides of a corner, `cross = u x w` and
//! `dot = u . w`, the corner's cotangent is `dot / cross`. `cross` is the same
//! for all three corners (twice the area), so a triangle keeps the bounds iff
//! it is positively oriented and its largest and smallest dot product lie
//! between `cross * cot(max)` and `cross * cot(min)`: three comparisons, no
//! trigonometry. Only corners outside are turned into an angle, by a
//! polynomial that uses nothing but the four operations, so that the result
//! is the same on every platform.

use hexdel_geom::{AngleBounds, DVec2, quality};

/// Distance inside the promised bounds that a solved triangle keeps, degrees.
///
/// A certificate computes angles from the same coordinates with an error of a
/// few units in the last place of 90 degrees, 1e-14 each, amplified by the
/// cancellation of coordinate differences; 1e-7 leaves nine decimal digits of
/// a coordinate for that.
pub(crate) const STRICT_DEG: f64 = 1e-7;

/// Distance outside the promised bounds up to which a triangle that was
/// never moved counts as inside, degrees: the lattice's right angles are exact
/// but for rounding. A tenth of what a certificate tolerates (1e-9).
pub(crate) const LOOSE_DEG: f64 = 1e-10;

/// Distance outside the promised bounds that a certificate surely tolerates,
/// degrees: what was made elsewhere may use it up.
const GRANTED_DEG: f64 = 0.99 * hexdel_geom::ANGLE_TOLERANCE_DEG;

/// Distance inside the promised bounds that the solver aims at, degrees, so
/// that it arrives inside after finitely many steps.
const SLACK_DEG: f64 = 0.05;

/// Cotangent of an angle from which on it counts as a right one: 90 - 1e-6 degrees.
const NEARLY_RIGHT: f64 = 1.75e-8;

/// The cotangents of one pair of bounds.
#[derive(Clone, Copy, Debug)]
struct Cot {
    min: f64,
    max: f64,
}

/// Sine and cosine of one angle.
#[derive(Clone, Copy, Debug)]
struct SinCos {
    sin: f64,
    cos: f64,
}

/// The bounds in all the forms the solver needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    strict: Cot,
    loose: Cot,
    target: Cot,
    lower: SinCos,
    upper: SinCos,
    /// Cotangent of the largest angle that a certificate tolerates.
    tolerated: f64,
    /// The promised bounds, radians.
    pub(crate) min_rad: f64,
    pub(crate) max_rad: f64,
    /// Whether a triangle may be past the bounds by what a certificate grants.
    grants: bool,
    /// Whether a mesh inside the bounds may be other than Delaunay: two
    /// angles opposite an edge can exceed a half-turn.
    pub(crate) check_delaunay: bool,
}

fn sin_cos(angle: f64) -> SinCos {
    let (sin, cos) = libm::sincos(angle);
    SinCos { sin, cos }
}

fn cot(angle: f64) -> f64 {
    if angle <= 0.0 {
        f64::INFINITY
    } else if angle >= std::f64::consts::PI {
        f64::NEG_INFINITY
    } else {
        let a = sin_cos(angle);
        a.cos / a.sin
    }
}

impl Limits {
    pub(crate) fn new(bounds: AngleBounds) -> Self {
        let (lo, hi) = (bounds.min_deg().to_radians(), bounds.max_deg().to_radians());
        let inset = |deg: f64| {
            let d = deg.to_radians();
            Cot { min: cot(lo + d), max: cot(hi - d) }
        };
        let slack = SLACK_DEG.to_radians();
        Self {
            strict: inset(STRICT_DEG),
            loose: inset(-LOOSE_DEG),
            target: inset(SLACK_DEG),
            lower: sin_cos(lo + slack),
            upper: sin_cos(hi - slack),
            tolerated: cot(hi + hexdel_geom::ANGLE_TOLERANCE_DEG.to_radians()),
            min_rad: lo,
            max_rad: hi,
            grants: true,
            check_delaunay: bounds.max_deg() > 90.0,
        }
    }

    /// The same without tolerance for triangles that were never moved.
    ///
    /// Right angles on both sides of an edge leave it to rounding whether the
    /// edge is Delaunay.
    pub(crate) fn without_tolerance(self) -> Self {
        Self { loose: self.strict, grants: false, ..self }
    }

    /// Whether the triangle keeps the bounds with the solver's margin.
    #[inline]
    pub(crate) fn strict(&self, m: &Measure) -> bool {
        m.within(self.strict)
    }

    /// Whether the triangle keeps the bounds as a certificate sees them.
    #[inline]
    pub(crate) fn loose(&self, m: &Measure) -> bool {
        m.within(self.loose)
    }

    /// Whether the triangle, with such corners, is past the bounds by no more
    /// than a certificate grants: its tolerance, and what rounding does.
    #[cold]
    pub(crate) fn granted(&self, m: &Measure, corners: [DVec2; 3]) -> bool {
        let d = (GRANTED_DEG + quality::rounding_deg(corners)).to_radians();
        self.grants && m.within(Cot { min: cot(self.min_rad - d), max: cot(self.max_rad + d) })
    }

    /// Whether the triangle has no residual.
    #[inline]
    pub(crate) fn on_target(&self, m: &Measure) -> bool {
        m.within(self.target)
    }

    /// Signed distance of corner `i` outside the target, radians: negative
    /// below the lower bound, positive above the upper, zero inside.
    #[inline]
    pub(crate) fn residual(&self, m: &Measure, i: usize) -> f64 {
        let (cross, dot) = (m.cross, m.dot[i]);
        let low = self.lower.sin * dot - self.lower.cos * cross;
        if cross <= 0.0 {
            // An inverted corner's angle is in (-pi, 0]; beyond a half-turn
            // below the bound the distance is capped.
            let along = self.lower.cos * dot + self.lower.sin * cross;
            return if low > 0.0 { -angle(low, along) } else { -std::f64::consts::PI };
        }
        if low > 0.0 {
            return -angle(low, self.lower.cos * dot + self.lower.sin * cross);
        }
        let high = self.upper.cos * cross - self.upper.sin * dot;
        if high > 0.0 {
            return angle(high, self.upper.cos * dot + self.upper.sin * cross);
        }
        0.0
    }

    /// The corner farthest below the target and the one farthest above, each
    /// with the sine of its distance times its sides' lengths, negative.
    #[inline]
    pub(crate) fn outside(&self, m: &Measure) -> (Excess, Excess) {
        let (mut max, mut min) = (0, 0);
        for k in 1..3 {
            if m.dot[k] > m.dot[max] {
                max = k;
            }
            if m.dot[k] < m.dot[min] {
                min = k;
            }
        }
        let low = self.lower.cos * m.cross - self.lower.sin * m.dot[max];
        let high = self.upper.sin * m.dot[min] - self.upper.cos * m.cross;
        ((low < 0.0).then_some((max, low)), (high < 0.0 && m.cross > 0.0).then_some((min, high)))
    }

    /// Factors of cross and dot product in the lower test.
    #[inline]
    pub(crate) fn lower_turn(&self) -> DVec2 {
        DVec2::new(self.lower.cos, -self.lower.sin)
    }

    /// Factors of cross and dot product in the upper test.
    #[inline]
    pub(crate) fn upper_turn(&self) -> DVec2 {
        DVec2::new(-self.upper.cos, self.upper.sin)
    }

    /// Sum of the squared residuals of a triangle, square radians.
    pub(crate) fn energy(&self, m: &Measure) -> f64 {
        if self.on_target(m) {
            return 0.0;
        }
        (0..3).map(|i| self.residual(m, i)).map(|r| r * r).sum()
    }
}

/// A corner outside the target, and the sine of its distance times its sides'
/// lengths, negative.
type Excess = Option<(usize, f64)>;

/// Where a triangle lies: near segments or not (bit 3), and at which corners its
/// angle is the input's (bits 0 to 2).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Place(u8);

/// The bits of corners whose angle is the input's.
const EXCUSED: u8 = 7;

/// The cotangent of 60 degrees, which is inside all bounds that a mesh can keep.
const COT_INSIDE: f64 = 0.577_350_269_189_625_8;

impl Place {
    /// `bound` are the sides that lie on segments: bit `i` that opposite
    /// corner `i`.
    pub(crate) fn new(near: bool, bound: u8) -> Self {
        // Corner i is between the two other sides.
        let between = match bound {
            0b110 => 1,
            0b101 => 2,
            0b011 => 4,
            0b111 => 7,
            _ => 0,
        };
        Self(between | u8::from(near) << 3)
    }

    /// Near segments, and between two that leave no room for the lower bound.
    pub(crate) fn in_wedge() -> Self {
        Self(8 | EXCUSED)
    }

    #[inline]
    pub(crate) fn is_near(self) -> bool {
        self.0 & 8 != 0
    }

    /// The triangle as the bounds see it: a corner whose angle is the input's
    /// is inside unless it is past the upper bound by more than rounding.
    #[inline]
    pub(crate) fn view(self, m: Measure, limits: &Limits) -> Measure {
        if self.0 & EXCUSED == 0 || m.cross <= 0.0 { m } else { self.excuse(m, limits) }
    }

    #[cold]
    fn excuse(self, mut m: Measure, limits: &Limits) -> Measure {
        let least = m.cross * limits.tolerated;
        for k in (0..3).filter(|k| self.0 >> k & 1 == 1) {
            if m.dot[k] >= least {
                m.dot[k] = m.cross * COT_INSIDE;
            }
        }
        m
    }
}

/// Cross product (twice the signed area) and the dot products at the corners
/// of a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measure {
    pub(crate) cross: f64,
    pub(crate) dot: [f64; 3],
}

impl Measure {
    #[inline]
    pub(crate) fn of(a: DVec2, b: DVec2, c: DVec2) -> Self {
        let (u, v, w) = (b - a, c - b, a - c);
        Self { cross: u.perp_dot(-w), dot: [-u.dot(w), -v.dot(u), -w.dot(v)] }
    }

    /// Whether the angle at corner `k` is a right one up to rounding, or larger.
    #[inline]
    pub(crate) fn is_nearly_right(&self, k: usize) -> bool {
        self.dot[k] <= NEARLY_RIGHT * self.cross
    }

    #[inline]
    #[allow(clippy::needless_bitwise_bool, reason = "all seven are cheaper than one mistaken guess")]
    fn within(&self, cot: Cot) -> bool {
        let [a, b, c] = self.dot;
        let (least, most) = (self.cross * cot.max, self.cross * cot.min);
        (self.cross > 0.0)
            & (a <= most)
            & (b <= most)
            & (c <= most)
            & (a >= least)
            & (b >= least)
            & (c >= least)
    }
}

/// `atan2(s, c)` for `s >= 0`, to 2e-5 radians: the series of Hastings,
/// "Approximations for Digital Computers" (1955), sheet 11.
#[inline]
fn angle(s: f64, c: f64) -> f64 {
    let poly = |x: f64| {
        let y = x * x;
        x * (0.999_866 + y * (-0.330_299_5 + y * (0.180_141 + y * (-0.085_133 + y * 0.020_835_1))))
    };
    if s <= c {
        poly(s / c)
    } else if s >= c.abs() {
        std::f64::consts::FRAC_PI_2 - poly(c / s)
    } else {
        std::f64::consts::PI - poly(s / -c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residuals_are_the_angles_outside_the_target() {
        let limits = Limits::new(AngleBounds::EXTENDED);
        for deg in [-170.0, -60.0, -1.0, 1.0, 30.0, 43.9, 60.0, 89.9, 90.5, 120.0, 175.0f64] {
            let t = deg.to_radians();
            let m = Measure::of(DVec2::ZERO, DVec2::X * 2.0, DVec2::new(t.cos(), t.sin()));
            let lo = (AngleBounds::EXTENDED.min_deg() + SLACK_DEG).to_radians();
            let hi = (90.0 - SLACK_DEG).to_radians();
            let want = if t < lo { (t - lo).max(-std::f64::consts::PI) } else { (t - hi).max(0.0) };
            assert!((limits.residual(&m, 0) - want).abs() < 3e-5, "{deg}: {}", limits.residual(&m, 0));
        }
    }

    #[test]
    fn right_angles_are_loosely_but_not_strictly_inside() {
        let limits = Limits::new(AngleBounds::EXTENDED);
        let m = Measure::of(DVec2::ZERO, DVec2::X, DVec2::Y);
        assert!(limits.loose(&m) && !limits.strict(&m));
        let inverted = Measure::of(DVec2::ZERO, DVec2::Y, DVec2::X);
        assert!(!limits.loose(&inverted));
    }
}
