//! Bounds as polynomial tests.
//!
//! With the sides `u`, `w` of a corner, `dot = u . w` and `cross = u x w`, its cotangent is `dot / cross`.

use hexdel_geom::DVec2;

/// Distance inside the lower bound, and inside a right angle, that motion aims at, degrees: it arrives inside after
/// finitely many steps.
const MARGIN_DEG: f64 = 0.1;

/// How far past a right angle a corner may be, as a cotangent: half of what a certificate tolerates (1e-9 degrees).
const LOOSE: f64 = 1e-11;

/// A cross product up to this part of the squared lengths of its factors may have the wrong sign or be zero: their
/// components are differences of coordinates, each off by 2^-53 of itself.
const SURE: f64 = 1e-15;

/// Lower bounds, degrees: below the one nothing is refined for, above the other refinement does not end.
pub(crate) const RANGE_DEG: [f64; 2] = [1.0, 43.6];

/// The lower bound and a right angle in all the forms needed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) lo_deg: f64,
    /// Cotangents: of the bounds,
    pub(crate) lo: f64,
    pub(crate) hi: f64,
    /// and of what motion aims at.
    aim_lo: f64,
    aim_hi: f64,
    /// Sine and cosine of the lower bound, and of its double.
    once: DVec2,
    twice: DVec2,
    /// Cotangent of the least angle of triangles that are not urgent.
    pub(crate) urgent: f64,
    /// The most triangles around a vertex.
    pub(crate) most_around: usize,
}

/// A corner that is not where motion aims at, as a violation `g > 0` and its derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Push {
    pub(crate) g: f64,
    /// By the dot product,
    pub(crate) by_dot: f64,
    /// and by the cross product.
    pub(crate) by_cross: f64,
    /// Whether it is out of the bounds themselves.
    pub(crate) is_out: bool,
}

fn cot(deg: f64) -> f64 {
    1.0 / libm::tan(deg.to_radians())
}

impl Limits {
    pub(crate) fn new(lo_deg: f64, urgent_deg: f64) -> Self {
        let sin_cos = |deg: f64| {
            let (sin, cos) = libm::sincos(deg.to_radians());
            DVec2::new(sin, cos)
        };
        Self {
            lo_deg,
            lo: cot(lo_deg),
            hi: -LOOSE,
            aim_lo: cot(lo_deg + MARGIN_DEG),
            aim_hi: libm::tan(MARGIN_DEG.to_radians()),
            once: sin_cos(lo_deg),
            twice: sin_cos(2.0 * lo_deg),
            urgent: cot(urgent_deg),
            most_around: (360.0 / lo_deg) as usize,
        }
    }

    /// How a corner is to be pushed, if at all.
    #[inline]
    pub(crate) fn push(&self, dot: f64, cross: f64) -> Option<Push> {
        let g = self.aim_hi * cross - dot;
        if g > 0.0 {
            return Some(Push { g, by_dot: -1.0, by_cross: self.aim_hi, is_out: dot < self.hi * cross });
        }
        let g = dot - self.aim_lo * cross;
        (g > 0.0).then_some(Push { g, by_dot: 1.0, by_cross: -self.aim_lo, is_out: dot > self.lo * cross })
    }

    /// Whether a corner of the outline of a cavity is too narrow for two angles of the bound, and how much so.
    #[inline]
    pub(crate) fn too_narrow_for_two(&self, dot: f64, cross: f64) -> bool {
        self.twice.y * cross < self.twice.x * dot
    }

    /// Whether a corner is below the lower bound by more than rounding.
    #[inline]
    pub(crate) fn too_narrow(&self, dot: f64, cross: f64) -> bool {
        self.once.y * cross - self.once.x * dot < -1e-12 * dot
    }
}

/// Whether a triangle with two sides that have this cross product is surely counter-clockwise.
#[inline]
pub(crate) fn surely_turns_left(u: DVec2, w: DVec2) -> bool {
    u.perp_dot(w) > SURE * (u.length_squared() + w.length_squared())
}

/// Dot products at the three corners of a triangle and its cross product.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shape {
    pub(crate) dots: [f64; 3],
    pub(crate) cross: f64,
    /// Squared length of the shortest side.
    pub(crate) shortest_sq: f64,
}

impl Shape {
    #[inline]
    pub(crate) fn of([a, b, c]: [DVec2; 3]) -> Self {
        let (u, v, w) = (b - a, c - b, a - c);
        Self {
            dots: [-u.dot(w), -v.dot(u), -w.dot(v)],
            cross: u.perp_dot(v),
            shortest_sq: u.length_squared().min(v.length_squared()).min(w.length_squared()),
        }
    }
}
