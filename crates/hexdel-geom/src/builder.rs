//! PSLGs of points, lines and polygons that are given by their coordinates.

use crate::points::{PointsError, coordinate_key};
use crate::pslg::{Polygon, Pslg};
use glam::DVec2;
use rustc_hash::FxHashMap;

/// Gathers points, lines and polygons into a [`Pslg`] by their coordinates: equal coordinates become one point (-0.0
/// being 0.0), equal segments one segment, so that a border of two polygons is there once.
///
/// Whether lines cross or polygons overlap is left to whoever meshes the PSLG.
///
/// ```
/// use hexdel_geom::{DVec2, PslgBuilder};
///
/// let mut builder = PslgBuilder::new();
/// for x in [0.0, 2.0] {
///     let corners = [(x, 0.0), (x + 2.0, 0.0), (x + 2.0, 2.0), (x, 2.0)];
///     builder.polygon([corners.map(DVec2::from)], x)?;
/// }
/// let pslg = builder.finish();
/// assert_eq!((pslg.points.len(), pslg.segments.len(), pslg.polygons.len()), (6, 7, 2));
/// # Ok::<(), hexdel_geom::PointsError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct PslgBuilder {
    pslg: Pslg,
    /// The index of each point, by its coordinates' bits.
    point_of: FxHashMap<[u64; 2], u32>,
    /// The index of each segment, by its ends, the smaller first.
    segment_of: FxHashMap<[u32; 2], u32>,
    marker: Option<i32>,
}

impl PslgBuilder {
    /// Nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The marker of points and segments that are new from now on; of those before the first marker it is 0.
    pub fn mark(&mut self, marker: i32) {
        self.pslg.point_markers.resize(self.pslg.points.len(), 0);
        self.pslg.segment_markers.resize(self.pslg.segments.len(), 0);
        self.marker = Some(marker);
    }

    /// Adds a point, if it is not there, and says which it is.
    ///
    /// # Errors
    ///
    /// [`PointsError::TooMany`].
    pub fn point(&mut self, at: DVec2) -> Result<u32, PointsError> {
        let next = self.pslg.points.len() as u32;
        if let Some(&index) = self.point_of.get(&coordinate_key(at)) {
            return Ok(index);
        }
        if next == u32::MAX {
            return Err(PointsError::TooMany { count: next as usize + 1 });
        }
        self.point_of.insert(coordinate_key(at), next);
        self.pslg.points.push(at);
        self.pslg.point_markers.extend(self.marker);
        Ok(next)
    }

    /// Adds the segments between points in a row, but for those that are there, and says which they are. Points in a row
    /// that are the same have none.
    ///
    /// ```
    /// # use hexdel_geom::{DVec2, PslgBuilder};
    /// let mut builder = PslgBuilder::new();
    /// let [a, b] = [builder.point(DVec2::ZERO)?, builder.point(DVec2::X)?];
    /// assert_eq!(builder.path(&[a, b, b, a]), [0, 0]);
    /// # Ok::<(), hexdel_geom::PointsError>(())
    /// ```
    ///
    /// # Panics
    ///
    /// If there is no such point.
    pub fn path(&mut self, points: &[u32]) -> Vec<u32> {
        let count = self.pslg.points.len();
        assert!(points.iter().all(|&p| (p as usize) < count), "points of the builder");
        let pairs = points.windows(2).filter(|pair| pair[0] != pair[1]);
        pairs.map(|pair| self.segment([pair[0], pair[1]])).collect()
    }

    fn segment(&mut self, [a, b]: [u32; 2]) -> u32 {
        let next = self.pslg.segments.len() as u32;
        let segment = *self.segment_of.entry([a.min(b), a.max(b)]).or_insert(next);
        if segment == next {
            self.pslg.segments.push([a, b]);
            self.pslg.segment_markers.extend(self.marker);
        }
        segment
    }

    /// Adds a polygon with an attribute: its outer ring and those of its holes, which are closed if they are not. What
    /// has no area has no polygon, but points and segments.
    ///
    /// # Errors
    ///
    /// [`PointsError::TooMany`].
    pub fn polygon<R>(
        &mut self,
        rings: impl IntoIterator<Item = R>,
        attribute: f64,
    ) -> Result<(), PointsError>
    where
        R: IntoIterator<Item = DVec2>,
    {
        let rings = rings.into_iter().map(|ring| ring.into_iter().map(|p| self.point(p)).collect());
        let rings = rings.collect::<Result<Vec<Vec<u32>>, _>>()?;
        self.polygon_of(rings, attribute);
        Ok(())
    }

    /// The same of rings of points that are there.
    ///
    /// # Panics
    ///
    /// If there is no such point.
    pub fn polygon_of(&mut self, rings: Vec<Vec<u32>>, attribute: f64) {
        let mut polygon = Polygon { attribute, ..Polygon::default() };
        for mut ring in rings {
            if ring.first() != ring.last() {
                ring.push(ring[0]);
            }
            polygon.rings.push(self.path(&ring));
        }
        if polygon.rings.first().is_some_and(|outer| outer.len() > 2) {
            self.pslg.polygons.push(polygon);
        }
    }

    /// What was gathered.
    pub fn finish(self) -> Pslg {
        self.pslg
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, side: f64) -> [DVec2; 4] {
        [(x, 0.0), (x + side, 0.0), (x + side, side), (x, side)].map(DVec2::from)
    }

    #[test]
    fn rings_are_closed_and_borders_shared() {
        let mut builder = PslgBuilder::new();
        builder.polygon([square(0.0, 2.0)], 1.0).unwrap();
        builder.mark(7);
        let closed = square(2.0, 2.0).into_iter().chain([DVec2::new(2.0, 0.0)]);
        builder.polygon([closed], 2.0).unwrap();
        let pslg = builder.finish();
        assert_eq!(pslg.check_layout(), Ok(()));
        let rings: Vec<_> = pslg.polygons.iter().map(|p| p.rings[0].clone()).collect();
        assert_eq!(rings, [[0, 1, 2, 3], [4, 5, 6, 1]]);
        assert_eq!(pslg.point_markers, [0, 0, 0, 0, 7, 7]);
        assert_eq!(pslg.segment_markers, [0, 0, 0, 0, 7, 7, 7]);
    }

    #[test]
    fn what_has_no_area_has_no_polygon() {
        let mut builder = PslgBuilder::new();
        builder.polygon([[DVec2::ZERO, DVec2::X, DVec2::ZERO]], 1.0).unwrap();
        builder.polygon([[DVec2::Y; 3]], 1.0).unwrap();
        builder.polygon([[]], 1.0).unwrap();
        let pslg = builder.finish();
        assert_eq!((pslg.points.len(), pslg.segments.len(), pslg.polygons.len()), (3, 1, 0));
    }

    #[test]
    fn zero_has_one_sign() {
        let mut builder = PslgBuilder::new();
        assert_eq!([DVec2::ZERO, -DVec2::ZERO].map(|p| builder.point(p)), [Ok(0), Ok(0)]);
    }
}
