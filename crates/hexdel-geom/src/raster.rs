//! Rasters: numbers on a grid of square cells, as depths and sizes are given.

use glam::DVec2;

/// Square cells with a number each.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Cells in a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// Centre of the cell in the south-west.
    pub low: DVec2,
    /// Length of a cell's side.
    pub cell: f64,
    /// Row by row from the south, each from the west; none where there is no
    /// value.
    pub values: Vec<Option<f64>>,
}

impl Raster {
    /// Most cells that are read or resampled to.
    pub const MOST_CELLS: usize = 1 << 28;

    /// The value at a place, interpolated between the centres of the cells around it that have one; none if no
    /// cell there has, or outside of the raster.
    pub fn at(&self, place: DVec2) -> Option<f64> {
        let last = DVec2::new(self.columns as f64 - 1.0, self.rows as f64 - 1.0);
        let place = (place - self.low) / self.cell;
        // Cells reach half their side beyond their centres.
        if !(place.cmpge(DVec2::splat(-0.5)).all() && place.cmple(last + 0.5).all()) {
            return None;
        }
        let inside = place.clamp(DVec2::ZERO, last);
        let [column, row] = [inside.x as usize, inside.y as usize];
        let (u, v) = (inside.x - column as f64, inside.y - row as f64);
        let corners =
            [(0, 0, (1.0 - u) * (1.0 - v)), (1, 0, u * (1.0 - v)), (0, 1, (1.0 - u) * v), (1, 1, u * v)];
        let known =
            corners.into_iter().filter(|(.., weight)| *weight > 0.0).filter_map(|(dx, dy, weight)| {
                Some((weight, self.values[(row + dy) * self.columns + column + dx]?))
            });
        let [sum, total] =
            known.fold([0.0; 2], |[sum, total], (weight, value)| [sum + weight * value, total + weight]);
        (total > 0.0).then(|| sum / total)
    }

    /// A raster of other cells, from `low` to `high` and of the side `cell`, with the values at the places here that the
    /// centres of its cells are taken to. At most [`Raster::MOST_CELLS`] cells: larger ones are made otherwise.
    #[must_use]
    pub fn resampled(&self, [low, high]: [DVec2; 2], cell: f64, to_here: impl Fn(DVec2) -> DVec2) -> Self {
        let count = |extent: f64, cell: f64| (extent / cell).ceil().max(0.0) as usize + 1;
        let extent = high - low;
        let mut cell = cell;
        while count(extent.x, cell).saturating_mul(count(extent.y, cell)) > Self::MOST_CELLS {
            cell *= 2.0;
        }
        let (columns, rows) = (count(extent.x, cell), count(extent.y, cell));
        let centre = |i: usize| low + cell * DVec2::new((i % columns) as f64, (i / columns) as f64);
        let values = (0..columns * rows).map(|i| self.at(to_here(centre(i)))).collect();
        Self { columns, rows, low, cell, values }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_interpolated_between_cells_that_have_one() {
        let raster = Raster {
            columns: 2,
            rows: 2,
            low: DVec2::ONE,
            cell: 2.0,
            values: [1.0, 3.0, 5.0, 7.0].map(Some).to_vec(),
        };
        let at = |raster: &Raster, x, y| raster.at(DVec2::new(x, y));
        assert_eq!(
            (at(&raster, 2.0, 1.0), at(&raster, 2.0, 2.0), at(&raster, 3.0, 3.0)),
            (Some(2.0), Some(4.0), Some(7.0))
        );
        // A cell reaches half its side beyond its centre.
        assert_eq!(
            (at(&raster, 0.1, 0.0), at(&raster, -0.1, 1.0), at(&raster, 1.0, 4.1)),
            (Some(1.0), None, None)
        );
        assert_eq!(at(&raster, f64::NAN, 1.0), None);
        let holed = Raster { values: vec![Some(1.0), None, None, None], ..raster.clone() };
        assert_eq!((at(&holed, 2.0, 1.0), at(&holed, 3.0, 3.0)), (Some(1.0), None));
        let single = Raster { columns: 1, rows: 1, values: vec![Some(4.0)], ..raster };
        assert_eq!(at(&single, 1.5, 0.5), Some(4.0));
    }

    #[test]
    fn rasters_are_resampled_where_their_places_are_taken_to() {
        let raster = Raster {
            columns: 3,
            rows: 1,
            low: DVec2::ZERO,
            cell: 1.0,
            values: [1.0, 2.0, 3.0].map(Some).to_vec(),
        };
        // Ten times as large, and moved.
        let found = raster.resampled([DVec2::new(100.0, 0.0), DVec2::new(125.0, 4.0)], 5.0, |p| {
            (p - DVec2::new(100.0, 0.0)) / 10.0
        });
        assert_eq!((found.columns, found.rows, found.low, found.cell), (6, 2, DVec2::new(100.0, 0.0), 5.0));
        assert_eq!(found.values[..6], [1.0, 1.5, 2.0, 2.5, 3.0, 3.0].map(Some));
        assert_eq!(found.values[6..9], [Some(1.0), Some(1.5), Some(2.0)]);
    }
}
