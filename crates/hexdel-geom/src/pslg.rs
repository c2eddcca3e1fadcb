//! A planar straight-line graph: points, segments, holes and regions as read.
//!
//! The input of constrained triangulation, in the shape that Shewchuk's Triangle
//! made the habit of the field (`.poly` files). [`Pslg`] is plain data: it does
//! not know whether segments cross, points coincide or holes are enclosed. That
//! is for whoever triangulates it; only the array layout is checked here.

use glam::DVec2;
use thiserror::Error;

/// A planar straight-line graph.
///
/// Point and segment indices are 0-based whatever the file they came from. A
/// point set is a PSLG without segments, see [`Pslg::from_points`].
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, Pslg};
///
/// let mut square = Pslg::from_points(vec![
///     DVec2::new(0.0, 0.0),
///     DVec2::new(1.0, 0.0),
///     DVec2::new(1.0, 1.0),
///     DVec2::new(0.0, 1.0),
/// ]);
/// square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
/// assert_eq!(square.check_layout(), Ok(()));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct Pslg {
    /// Positions, in the units of the input.
    pub points: Vec<DVec2>,
    /// The two end points of each segment, as indices of [`Self::points`].
    pub segments: Vec<[u32; 2]>,
    /// One point inside each part of the plane that is to be left empty.
    pub holes: Vec<DVec2>,
    /// Parts of the plane with an attribute and, at will, a size limit.
    pub regions: Vec<Region>,
    /// Areas with an attribute and, at will, a size limit, given by their
    /// borders. If there are any, what none of them covers is outside.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub polygons: Vec<Polygon>,
    /// A marker of each point; empty if there are none.
    pub point_markers: Vec<i32>,
    /// A marker of each segment; empty if there are none.
    pub segment_markers: Vec<i32>,
    /// [`Self::attributes_per_point`] numbers for each point, point by point.
    pub point_attributes: Vec<f64>,
    /// How many numbers each point carries beside its position.
    pub attributes_per_point: usize,
}

/// A part of the plane bounded by segments, named by a point inside.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Region {
    /// A point inside the region.
    pub point: DVec2,
    /// What the triangles of the region are to be labelled with.
    pub attribute: f64,
    /// The largest triangle area wanted, in square units of the input.
    pub max_area: Option<f64>,
}

/// An area given by its border: what lies in its first ring and in none of the
/// others.
///
/// A point lies in a ring if a ray from it crosses the ring's segments an odd
/// number of times. So a ring may touch itself, and neither the order of its
/// segments nor their direction matters. Unlike a [`Region`], a polygon is not
/// divided by other segments that pass through it.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Polygon {
    /// The outer ring, then those of its holes, each as indices of
    /// [`Pslg::segments`]. Rings are closed.
    pub rings: Vec<Vec<u32>>,
    /// What the triangles of the polygon are to be labelled with.
    pub attribute: f64,
    /// The largest triangle area wanted, in square units of the input.
    #[cfg_attr(feature = "serde", serde(default))]
    pub max_area: Option<f64>,
}

/// Why the arrays of a [`Pslg`] do not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum PslgLayoutError {
    /// A segment ends at a point that is not there.
    #[error("segment {segment} ends at point {point}, of {points} points")]
    SegmentEnd {
        /// Index of the segment.
        segment: usize,
        /// The index it names.
        point: u32,
        /// How many points there are.
        points: usize,
    },
    /// A polygon has a segment that is not there.
    #[error("polygon {polygon} has segment {segment}, of {segments} segments")]
    PolygonSegment {
        /// Index of the polygon.
        polygon: usize,
        /// The index it names.
        segment: u32,
        /// How many segments there are.
        segments: usize,
    },
    /// A marker or attribute array has neither one entry per item nor none.
    #[error("{array} has {found} entries instead of {expected}")]
    Length {
        /// Name of the field.
        array: &'static str,
        /// The length that would fit.
        expected: usize,
        /// The length it has.
        found: usize,
    },
}

impl Pslg {
    /// A PSLG of points alone.
    pub fn from_points(points: Vec<DVec2>) -> Self {
        Self { points, ..Self::default() }
    }

    /// The attributes of point `point`, [`Self::attributes_per_point`] of them.
    ///
    /// # Panics
    ///
    /// If the array is shorter than [`Self::check_layout`] demands.
    pub fn attributes(&self, point: usize) -> &[f64] {
        &self.point_attributes[point * self.attributes_per_point..][..self.attributes_per_point]
    }

    /// Checks that the arrays fit together: every segment ends at points of the
    /// PSLG, polygons have segments of the PSLG, marker arrays are empty or
    /// complete, attributes are complete.
    ///
    /// # Errors
    ///
    /// The first [`PslgLayoutError`] in the order of the fields.
    ///
    /// # Complexity
    ///
    /// Linear in the number of segments and of those of polygons.
    pub fn check_layout(&self) -> Result<(), PslgLayoutError> {
        self.layout_errors().next().map_or(Ok(()), Err)
    }

    /// Everything that [`check_layout`](Self::check_layout) would find, one after the other.
    ///
    /// # Complexity
    ///
    /// Linear in the number of segments and of those of polygons, if all are taken.
    pub fn layout_errors(&self) -> impl Iterator<Item = PslgLayoutError> + '_ {
        let (points, segments) = (self.points.len(), self.segments.len());
        let ends = self.segments.iter().enumerate().flat_map(move |(segment, ends)| {
            let missing = ends.iter().filter(move |&&end| end as usize >= points);
            missing.map(move |&point| PslgLayoutError::SegmentEnd { segment, point, points })
        });
        let borders = self.polygons.iter().enumerate().flat_map(move |(polygon, area)| {
            let missing = area.rings.iter().flatten().filter(move |&&s| s as usize >= segments);
            missing.map(move |&segment| PslgLayoutError::PolygonSegment { polygon, segment, segments })
        });
        let markers = |found, expected| if found == 0 { 0 } else { expected };
        let [of_points, of_segments] = [self.point_markers.len(), self.segment_markers.len()];
        // A product beyond usize fits no array, so saturating keeps the verdict.
        let attributes = points.saturating_mul(self.attributes_per_point);
        let lengths = [
            ("point_markers", markers(of_points, points), of_points),
            ("segment_markers", markers(of_segments, segments), of_segments),
            ("point_attributes", attributes, self.point_attributes.len()),
        ];
        let lengths = lengths.into_iter().filter(|(_, expected, found)| expected != found);
        let lengths =
            lengths.map(|(array, expected, found)| PslgLayoutError::Length { array, expected, found });
        ends.chain(borders).chain(lengths)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle() -> Pslg {
        Pslg {
            segments: vec![[0, 1], [1, 2], [2, 0]],
            point_markers: vec![1, 2, 3],
            point_attributes: vec![0.5, 1.5, 2.5, 3.5, 4.5, 5.5],
            attributes_per_point: 2,
            ..Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y])
        }
    }

    #[test]
    fn attributes_are_stored_point_by_point() {
        let pslg = triangle();
        assert_eq!(pslg.check_layout(), Ok(()));
        assert_eq!(pslg.attributes(1), [2.5, 3.5]);
        assert!(Pslg::from_points(vec![DVec2::X]).attributes(0).is_empty());
    }

    #[test]
    fn a_segment_to_a_missing_point_is_named() {
        let mut pslg = triangle();
        pslg.segments[1] = [2, 3];
        assert_eq!(pslg.check_layout(), Err(PslgLayoutError::SegmentEnd { segment: 1, point: 3, points: 3 }));
    }

    #[test]
    fn a_polygon_of_a_missing_segment_is_named() {
        let mut pslg = triangle();
        pslg.polygons = vec![Polygon { rings: vec![vec![0, 1, 2], vec![3]], ..Polygon::default() }];
        let expected = PslgLayoutError::PolygonSegment { polygon: 0, segment: 3, segments: 3 };
        assert_eq!(pslg.check_layout(), Err(expected));
    }

    #[test]
    fn incomplete_arrays_are_named() {
        for (array, spoil) in [
            ("point_markers", (|p| p.point_markers.truncate(2)) as fn(&mut Pslg)),
            ("segment_markers", |p| p.segment_markers = vec![7]),
            ("point_attributes", |p| p.attributes_per_point = usize::MAX),
        ] {
            let mut pslg = triangle();
            spoil(&mut pslg);
            let error = pslg.check_layout();
            assert!(
                matches!(error, Err(PslgLayoutError::Length { array: a, .. }) if a == array),
                "{array}: {error:?}"
            );
        }
    }
}
