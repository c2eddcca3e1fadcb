//! From addresses to coordinates and back.

use crate::axial::{Address, Hex};
use glam::DVec2;
use hexdel_geom::double_double::Double;

/// Where the grid lies in the plane: its origin and the spacing of level 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Centre of the hexagon `(0, 0)` of every level, in input units.
    origin: DVec2,
    /// Distance of neighbouring centres at level 0; positive and finite.
    spacing: f64,
}

/// A point's hexagon on one level, and where in it the point lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Located {
    /// The hexagon whose closed cell holds the point.
    pub hex: Hex,
    /// The point minus the hexagon's centre, in units of the level's spacing.
    pub offset: DVec2,
}

/// Largest component along the lattice directions: `1/2` on the boundary of
/// the unit lattice's cell.
fn hexagonal_norm(v: DVec2) -> f64 {
    let (half, tall) = (0.5 * v.x, Double::HALF_SQRT_3.hi * v.y);
    v.x.abs().max((half + tall).abs()).max((half - tall).abs())
}

impl Lattice {
    /// The lattices with a hexagon centred on `origin` and level 0 spaced
    /// `spacing` apart, both in input units.
    pub const fn new(origin: DVec2, spacing: f64) -> Self {
        Self { origin, spacing }
    }

    /// Centre of the hexagon `(0, 0)` of every level.
    pub const fn origin(&self) -> DVec2 {
        self.origin
    }

    /// Distance of neighbouring centres at `level`: `s_0 / 2^level`, exactly.
    #[inline]
    pub fn spacing(&self, level: u8) -> f64 {
        self.spacing * f64::from_bits((1023 - u64::from(level)) << 52)
    }

    /// The centre of a hexagon, in input units.
    ///
    /// # Guarantees
    ///
    /// Each coordinate is within one unit in its last place of the exact
    /// value, however deep the level.
    pub fn position(&self, at: Address) -> DVec2 {
        let (x, y) = self.exact(at.level, at.hex);
        DVec2::new(x.value(), y.value())
    }

    /// The centre of a hexagon to double-double precision.
    pub fn exact(&self, level: u8, hex: Hex) -> (Double, Double) {
        let (x, y) = self.relative(level, hex);
        (x + self.origin.x.into(), y + self.origin.y.into())
    }

    /// The centre of a hexagon relative to the lattice's origin.
    fn relative(&self, level: u8, hex: Hex) -> (Double, Double) {
        let s = self.spacing(level);
        let x = Double::product(0.5 * s, (2 * hex.q + hex.r) as f64);
        let y = Double::HALF_SQRT_3.times(hex.r as f64).times(s);
        (x, y)
    }

    /// The hexagon of `level` whose cell holds `point`.
    ///
    /// A point on an edge or a corner is given one of the cells that share it,
    /// always the same one.
    ///
    /// # Guarantees
    ///
    /// The offset is exact to a few units in its last place as long as the
    /// address stays below `2^50`.
    pub fn locate(&self, level: u8, point: DVec2) -> Located {
        let s = self.spacing(level);
        let x = Double::sum(point.x, -self.origin.x);
        let y = Double::sum(point.y, -self.origin.y);
        // A guess: multiplying by reciprocals is cheaper, and near enough.
        let per_s = 1.0 / s;
        let r = y.value() * per_s / Double::HALF_SQRT_3.hi;
        let q = x.value() * per_s - 0.5 * r;
        let mut hex = nearest(q, r);
        // The first guess misses by the rounding of a large quotient at most,
        // so one or two steps settle it; the third is for a point on an edge.
        for _ in 0..3 {
            let offset = self.offset(level, hex, x, y);
            if hexagonal_norm(offset) <= 0.5 {
                return Located { hex, offset };
            }
            let step = nearest(offset.x - offset.y / SQRT_3, offset.y / Double::HALF_SQRT_3.hi);
            if step == Hex::ORIGIN {
                return Located { hex, offset };
            }
            hex = hex + step;
        }
        Located { hex, offset: self.offset(level, hex, x, y) }
    }

    /// The hexagon of the level below `level` whose cell holds a point that lies
    /// at `at` on `level`: the same that [`locate`](Self::locate) finds, in a
    /// fraction of its time. The offset is good to a millionth, where `at` is
    /// what either of the two found.
    #[inline]
    pub fn locate_below(&self, level: u8, at: &Located, point: DVec2) -> Located {
        // Each level doubles the error of the offset, which was rounded in its
        // last place sixteen levels ago at most.
        const NEAR_EDGE: f64 = 1e-6;
        let scaled = 2.0 * at.offset;
        let step = nearest(scaled.x - scaled.y / SQRT_3, scaled.y / Double::HALF_SQRT_3.hi);
        let centre = DVec2::new(step.q as f64 + 0.5 * step.r as f64, Double::HALF_SQRT_3.hi * step.r as f64);
        let offset = scaled - centre;
        if level % 16 == 15 || hexagonal_norm(offset) > 0.5 - NEAR_EDGE {
            return self.locate(level + 1, point);
        }
        Located { hex: at.hex.scaled() + step, offset }
    }

    /// From the centre of `hex` to the point `(x, y)` relative to the origin,
    /// in units of the level's spacing.
    fn offset(&self, level: u8, hex: Hex, x: Double, y: Double) -> DVec2 {
        let (s, (cx, cy)) = (self.spacing(level), self.relative(level, hex));
        DVec2::new((x - cx).value() / s, (y - cy).value() / s)
    }
}

const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// The lattice point nearest to fractional axial coordinates.
fn nearest(q: f64, r: f64) -> Hex {
    // Half away from zero and cut off: `round` is a call into a library where
    // the processor is not known to have it.
    let round = |x: f64| (x + 0.5_f64.copysign(x)) as i64;
    let (rq, rr, rs) = (round(q), round(r), round(-q - r));
    let (dq, dr, ds) = ((rq as f64 - q).abs(), (rr as f64 - r).abs(), (rs as f64 + q + r).abs());
    // Without branches: each is as likely as the next.
    let q_is_worst = dq > dr && dq > ds;
    let r_is_worse = !q_is_worst && dr > ds;
    Hex::new(if q_is_worst { -rr - rs } else { rq }, if r_is_worse { -rq - rs } else { rr })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_hexagon_holds_its_own_centre() {
        let lattice = Lattice::new(DVec2::new(0.3, -7.1), 1.7);
        for level in [0, 1, 5, 20] {
            for hex in Hex::new(11, -5).disc(4) {
                let at = lattice.locate(level, lattice.position(Address::new(level, hex)));
                assert_eq!(at.hex, hex);
            }
        }
    }

    #[test]
    fn deep_levels_resolve_what_the_point_resolves() {
        // 45 levels down, next to a corner of the domain whose own
        // coordinates are small: the grid is as fine as the coordinates are.
        let lattice = Lattice::new(DVec2::new(0.5, 0.25), 1.0);
        let p = DVec2::new(1.234e-15, -3.21e-16);
        let at = lattice.locate(45, p);
        let back = lattice.position(Address::new(45, at.hex)) + at.offset * lattice.spacing(45);
        assert!((back - p).length() < 1e-27, "{back} {p}");
        assert!(hexagonal_norm(at.offset) <= 0.5 + 1e-12);
    }

    #[test]
    fn points_are_found_from_the_level_above() {
        let lattice = Lattice::new(DVec2::new(0.1, -0.3), 5.0);
        for i in 0..2000 {
            // Some on edges and corners of many levels.
            let p = match i % 4 {
                0 => lattice.position(Address::new(9, Hex::new(i % 37 - 17, i % 53 - 20))) * 0.5,
                1 => DVec2::new(0.1 + 5.0 / 64.0 * (i % 29) as f64, -0.3),
                _ => DVec2::new(i as f64 * 0.00137 - 1.0, (i * 7 % 1000) as f64 * 0.0011 - 1.0),
            };
            let mut at = lattice.locate(0, p);
            for level in 0..44 {
                at = lattice.locate_below(level, &at, p);
                let exact = lattice.locate(level + 1, p);
                assert_eq!(at.hex, exact.hex, "level {level}");
                assert!((at.offset - exact.offset).length() < 1e-6);
            }
        }
    }

    #[test]
    fn offsets_stay_within_the_cell() {
        let lattice = Lattice::new(DVec2::ZERO, 1.0);
        for i in 0..1000 {
            let p = DVec2::new(f64::from(i) * 0.0137 - 5.0, f64::from(i * 7 % 1000) * 0.011 - 4.0);
            for level in 0..12 {
                assert!(hexagonal_norm(lattice.locate(level, p).offset) <= 0.5 + 1e-12);
            }
        }
    }
}
