//! A raster as sizes: no cell larger than its neighbours and the gradation
//! allow, interpolated between the centres of cells.

use super::SizeError;
use hexdel_geom::{DVec2, Raster};

/// The smoothed raster.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Field {
    columns: usize,
    rows: usize,
    /// Centre of the cell in the south-west.
    low: DVec2,
    cell: f64,
    slope: f64,
    /// Row by row from the south.
    values: Vec<f64>,
}

impl Field {
    pub(super) fn new(raster: &Raster, slope: f64) -> Result<Self, SizeError> {
        let mut field = Self {
            columns: raster.columns,
            rows: raster.rows,
            low: raster.low,
            cell: raster.cell,
            slope,
            values: raster.values.iter().map(|v| v.unwrap_or(f64::INFINITY)).collect(),
        };
        field.check()?;
        field.smooth();
        Ok(field)
    }

    pub(super) fn check(&self) -> Result<(), SizeError> {
        let wrong = |i: usize, found: f64| SizeError::RasterValue {
            row: i / self.columns.max(1),
            column: i % self.columns.max(1),
            found,
        };
        if let Some(i) = self.values.iter().position(|v| v.is_nan() || *v <= 0.0) {
            return Err(wrong(i, self.values[i]));
        }
        let sound = self.columns.checked_mul(self.rows) == Some(self.values.len())
            && self.low.is_finite()
            && self.cell > 0.0
            && self.slope > 0.0;
        if sound && self.values.iter().any(|v| v.is_finite()) { Ok(()) } else { Err(wrong(0, f64::NAN)) }
    }

    pub(super) fn least(&self) -> f64 {
        self.values.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Lowers each cell to what its eight neighbours allow, by sweeps in both
    /// directions: the chamfer distance (Borgefors, "Distance transformations
    /// in digital images", 1986). Two sweeps do where nothing blocks the way.
    fn smooth(&mut self) {
        let (straight, diagonal) = (self.slope * self.cell, self.slope * self.cell * 2_f64.sqrt());
        let (columns, rows) = (self.columns as isize, self.rows as isize);
        let before = [(-1, 0, straight), (-1, -1, diagonal), (0, -1, straight), (1, -1, diagonal)];
        for sign in [1, -1] {
            for i in 0..columns * rows {
                let i = if sign == 1 { i } else { columns * rows - 1 - i };
                let (x, y) = (i % columns, i / columns);
                for (dx, dy, step) in before {
                    let (x, y) = (x + sign * dx, y + sign * dy);
                    if (0..columns).contains(&x) && (0..rows).contains(&y) {
                        let near = self.values[(y * columns + x) as usize] + step;
                        self.values[i as usize] = self.values[i as usize].min(near);
                    }
                }
            }
        }
    }

    /// The size at `p`; outside of the raster that of its nearest place, and
    /// the distance from there.
    pub(super) fn at(&self, p: DVec2) -> f64 {
        let last = DVec2::new((self.columns - 1) as f64, (self.rows - 1) as f64);
        let place = (p - self.low) / self.cell;
        let inside = place.clamp(DVec2::ZERO, last);
        let (column, row) = (inside.x.floor(), inside.y.floor());
        let (u, v) = (inside.x - column, inside.y - row);
        let value = |dx: usize, dy: usize| {
            let (x, y) = (column as usize + dx, row as usize + dy);
            self.values[y.min(self.rows - 1) * self.columns + x.min(self.columns - 1)]
        };
        let south = value(0, 0) * (1.0 - u) + value(1, 0) * u;
        let north = value(0, 1) * (1.0 - u) + value(1, 1) * u;
        south * (1.0 - v) + north * v + self.slope * self.cell * place.distance(inside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn raster(values: &[Option<f64>]) -> Raster {
        Raster { columns: 3, rows: 2, low: DVec2::ONE, cell: 2.0, values: values.to_vec() }
    }

    #[test]
    fn values_are_smoothed_and_interpolated() {
        let field = Field::new(&raster(&[Some(1.0), None, Some(9.0), None, None, None]), 0.5).unwrap();
        assert_eq!(field.at(DVec2::ONE), 1.0);
        assert_eq!(field.at(DVec2::new(3.0, 1.0)), 2.0);
        assert_eq!(field.at(DVec2::new(2.0, 1.0)), 1.5);
        assert_eq!(field.at(DVec2::new(5.0, 1.0)), 3.0);
        assert_eq!(field.at(DVec2::new(1.0, 3.0)), 2.0);
        // Outside, from the nearest place on.
        assert_eq!(field.at(DVec2::new(-3.0, 1.0)), 3.0);
    }

    #[test]
    fn a_bad_cell_is_named() {
        let bad = Field::new(&raster(&[Some(1.0), None, None, None, Some(-2.0), None]), 0.5);
        assert_eq!(bad, Err(SizeError::RasterValue { row: 1, column: 1, found: -2.0 }));
        assert!(Field::new(&raster(&[None; 6]), 0.5).is_err());
    }
}
