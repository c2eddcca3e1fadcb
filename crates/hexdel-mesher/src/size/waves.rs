//! How long edges may be in water: a part of the length of a long wave at its depth.
//!
//! A wave much longer than the water is deep travels at `sqrt(g depth)`, whatever its length, and so is
//! `sqrt(g depth) T` long if it takes the time `T` to pass. A model of it needs some elements in each of these lengths.
//! Tides are such waves, and so are tsunamis.

use super::{Part, Size, SizeError};
use hexdel_geom::Raster;

/// The acceleration of a fall, metres in a second squared.
pub const GRAVITY: f64 = 9.81;

/// The period of the lunar tide `M2`, seconds: half of the time from one moonrise to the next, in the mean.
pub const TIDE: f64 = 44_714.16;

/// Elements in a wavelength, unless said otherwise.
pub const PER_WAVELENGTH: f64 = 30.0;

/// Edges of `sqrt(g depth) T / N`, no shorter and no longer than two lengths. Depths are metres, and so are lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct WaveRule {
    /// The time `T` that a wave takes to pass, seconds.
    pub period: f64,
    /// Elements `N` in the length of a wave.
    pub per_wavelength: f64,
    /// The shortest length asked for, which is that of dry land and of shallow water.
    pub min: f64,
    /// The longest.
    pub max: f64,
}

impl WaveRule {
    /// A rule; `max` may be infinite.
    ///
    /// # Errors
    ///
    /// [`SizeError::Rule`], [`SizeError::Range`].
    pub fn new(period: f64, per_wavelength: f64, [min, max]: [f64; 2]) -> Result<Self, SizeError> {
        for (what, found) in [
            ("the period", period),
            ("the number of elements in a wavelength", per_wavelength),
            ("the shortest edge", min),
        ] {
            if !(found > 0.0 && found.is_finite()) {
                return Err(SizeError::Rule { what, found });
            }
        }
        if max.is_nan() || max < min {
            return Err(SizeError::Range { min, max });
        }
        Ok(Self { period, per_wavelength, min, max })
    }

    /// The length at a depth in metres, positive under water.
    ///
    /// ```
    /// use hexdel::WaveRule;
    /// let tide = WaveRule::new(44_714.16, 30.0, [500.0, 20e3])?;
    /// assert!((tide.at(10.0) - 14_762.4).abs() < 0.1);
    /// assert_eq!([tide.at(-3.0), tide.at(0.001), tide.at(4000.0)], [500.0, 500.0, 20e3]);
    /// # Ok::<(), hexdel::SizeError>(())
    /// ```
    pub fn at(&self, depth: f64) -> f64 {
        let length = (GRAVITY * depth.max(0.0)).sqrt() * self.period / self.per_wavelength;
        length.clamp(self.min, self.max)
    }
}

impl Size {
    /// No more than a rule says of the depths in a raster, metres, positive under water, smoothed to the gradation. Dry
    /// cells have the shortest length of the rule. Cells without a depth ask for nothing.
    ///
    /// ```
    /// use hexdel::{DVec2, Raster, Size, Sizing, WaveRule};
    /// let depths = Raster { columns: 2, rows: 1, low: DVec2::ZERO, cell: 1e5, values: vec![Some(-5.0), Some(100.0)] };
    /// let size = Size::unlimited().and_depths(&depths, &WaveRule::new(3600.0, 30.0, [200.0, 5e3])?)?;
    /// assert_eq!(size.at(DVec2::ZERO), 200.0);
    /// assert!((size.at(DVec2::new(1e5, 0.0)) - 3758.5).abs() < 0.1);
    /// # Ok::<(), hexdel::SizeError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SizeError::RasterValue`] if no cell has a depth.
    pub fn and_depths(self, depths: &Raster, rule: &WaveRule) -> Result<Self, SizeError> {
        let lengths = depths.values.iter().map(|depth| depth.map(|depth| rule.at(depth))).collect();
        let raster = Raster { values: lengths, ..depths.clone() };
        let sized = self.and_raster(&raster)?;
        // Between cells and around the raster as well.
        Ok(if rule.max.is_finite() { sized.with(Part::Constant(rule.max)) } else { sized })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::DVec2;
    use hexdel_optimize::Sizing;

    #[test]
    fn the_length_is_that_of_a_long_wave_by_its_elements() {
        let rule = WaveRule::new(44_714.16, 100.0, [1.0, f64::INFINITY]).unwrap();
        // 4,000 metres deep: 198 m/s, 8,857 km long.
        assert!((rule.at(4000.0) - 88_574.0).abs() < 1.0, "{}", rule.at(4000.0));
        // Four times the depth, twice the length.
        assert!((rule.at(40.0) - 2.0 * rule.at(10.0)).abs() < 1e-9);
    }

    #[test]
    fn numbers_that_make_no_rule_are_named() {
        let text = |period, elements, range| WaveRule::new(period, elements, range).unwrap_err().to_string();
        assert_eq!(text(0.0, 30.0, [1.0, 2.0]), "the period must be positive and finite, got 0.0");
        assert_eq!(
            text(1.0, f64::NAN, [1.0, 2.0]),
            "the number of elements in a wavelength must be positive and finite, got NaN"
        );
        assert_eq!(text(1.0, 30.0, [-1.0, 2.0]), "the shortest edge must be positive and finite, got -1.0");
        assert_eq!(
            text(1.0, 30.0, [3.0, 2.0]),
            "the longest edge must be at least the shortest, 3.0, got 2.0"
        );
    }

    #[test]
    fn dry_cells_have_the_shortest_length_and_unknown_ones_none() {
        let values = vec![Some(-8.0), Some(0.0), None, Some(1000.0), None];
        let depths = Raster { columns: 5, rows: 1, low: DVec2::ZERO, cell: 1e6, values };
        let rule = WaveRule::new(1000.0, 10.0, [50.0, 4000.0]).unwrap();
        let size = Size::unlimited().and_depths(&depths, &rule).unwrap();
        let at = |i: f64| size.at(DVec2::new(1e6 * i, 0.0));
        assert_eq!(
            [at(0.0), at(1.0), at(2.0), at(3.0), at(4.0), at(9.0)],
            [50.0, 50.0, 4000.0, 4000.0, 4000.0, 4000.0]
        );
        let none = Raster { values: vec![None; 5], ..depths };
        assert!(matches!(Size::unlimited().and_depths(&none, &rule), Err(SizeError::RasterValue { .. })));
    }

    /// A cell of 50 m beside deep water: half a metre longer with each metre away.
    #[test]
    fn the_gradation_limits_what_is_beside_shallow_water() {
        let values = vec![Some(0.0), Some(1000.0), Some(1000.0)];
        let depths = Raster { columns: 3, rows: 1, low: DVec2::ZERO, cell: 1000.0, values };
        let rule = WaveRule::new(1000.0, 10.0, [50.0, 4000.0]).unwrap();
        let size = Size::unlimited().with_gradation(0.2).unwrap().and_depths(&depths, &rule).unwrap();
        assert_eq!([0.0, 1000.0, 2000.0].map(|x| size.at(DVec2::new(x, 0.0))), [50.0, 250.0, 450.0]);
    }
}
