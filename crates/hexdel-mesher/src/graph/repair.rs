//! A PSLG as given or repaired, and errors in the numbers of the one given.

use super::Tolerance;
use crate::error::Error;
use hexdel_geom::{DVec2, PointsError, Pslg};
use hexdel_pslg::{
    Extent, Feature, LooseEnd, Near, PslgError, Repair, RepairReport, ValidateError, drop_repeated, repair,
    repair_nearly_on,
};

/// The tolerance over the PSLG's size; a hundredth of the width of the thinnest
/// hair that coordinates of that size resolve angles in would still do.
const OF_SIZE: f64 = 1e-9;

/// The tolerance over the largest coordinate, for small PSLGs far from the
/// origin: meshes need distances of about `2e-11` of it.
const OF_COORDINATE: f64 = 1e-10;

/// A PSLG to be meshed.
pub(crate) struct Repaired {
    pub(crate) graph: Pslg,
    /// What was done, if anything was asked for or segments were dropped.
    pub(crate) report: Option<RepairReport>,
}

impl Repaired {
    pub(super) fn new(given: &Pslg, tolerance: Option<Tolerance>, extent: Extent) -> Result<Self, Error> {
        let (graph, report) = match tolerance {
            // Of polygons, what is twice is a border of two.
            None if !given.polygons.is_empty() => return Ok(Self { graph: given.clone(), report: None }),
            None => {
                let dropped = drop_repeated(given).map(|(graph, report)| (graph, Some(report)));
                let (graph, report) = dropped.unwrap_or_else(|| (given.clone(), None));
                return Ok(Self { graph, report });
            }
            Some(Tolerance::Relative) => repair_nearly_on(given, relative(given), extent)?,
            Some(Tolerance::Absolute(tolerance)) if tolerance.is_finite() && tolerance >= 0.0 => {
                repair(given, tolerance)?
            }
            Some(Tolerance::Absolute(tolerance)) => return Err(Error::InvalidTolerance { tolerance }),
        };
        Ok(Self { graph, report: Some(report) })
    }

    /// A PSLG that is not valid as given, with the borders of its polygons divided where they
    /// meet those of others, or lines: that is how maps are drawn. Whatever else is wrong stays so.
    pub(super) fn divided(given: &Pslg) -> Result<Self, Error> {
        let owners = Owners::of(given);
        let Ok((graph, report)) = repair(given, 0.0) else {
            return Ok(Self { graph: given.clone(), report: None });
        };
        for done in &report.repairs {
            match *done {
                Repair::DividedAtCrossing { segments, at } if !owners.differ(segments) => {
                    return Err(ValidateError::Crossing { segments: segments.map(|s| s as usize), at }.into());
                }
                // Lines that are there twice are dropped wherever they are.
                Repair::MergedSegments { segments, ends }
                    if !owners.differ(segments) && !owners.of_segment(segments[0]).is_empty() =>
                {
                    return Err(
                        ValidateError::Overlap { segments: segments.map(|s| s as usize), ends }.into()
                    );
                }
                _ => {}
            }
        }
        Ok(Self { graph, report: Some(report) })
    }

    /// Takes over the holes and regions that polygons have become.
    pub(super) fn seed(&mut self, seeded: &Pslg) {
        self.graph.polygons.clear();
        self.graph.holes.clone_from(&seeded.holes);
        self.graph.regions.clone_from(&seeded.regions);
    }

    /// An error of validation in the numbers of the PSLG given.
    pub(super) fn as_given(&self, error: ValidateError) -> Error {
        self.names(|names| names.of_validation(error).into())
    }

    /// An error of meshing in the numbers of the PSLG given.
    pub(super) fn error_as_given(&self, error: PslgError) -> Error {
        self.names(|names| names.of_meshing(error).into())
    }

    fn names<T>(&self, with: impl FnOnce(&Names<'_>) -> T) -> T {
        let (points, segments) = (self.graph.points.len(), self.graph.segments.len());
        // What comes after those of the PSLG is its box.
        let point = |p: usize| match self.point(p) {
            _ if p >= points => Feature::Box,
            Some(given) => Feature::Point(given),
            None => Feature::Crossing,
        };
        let segment = |s: usize| if s >= segments { Feature::Box } else { Feature::Segment(self.segment(s)) };
        with(&Names { point: &point, segment: &segment })
    }

    /// The first point given that a point of the PSLG is.
    fn point(&self, point: usize) -> Option<usize> {
        match &self.report {
            None => Some(point),
            Some(report) => report.point_of_input.iter().position(|&p| p as usize == point),
        }
    }

    /// The first segment given that a segment of the PSLG is a part of.
    pub(super) fn segment(&self, segment: usize) -> usize {
        let report = self.report.as_ref();
        report.and_then(|r| r.sources.get(segment)?.first()).map_or(segment, |&s| s as usize)
    }
}

/// What the points and segments of a PSLG made on the way are of the one that its author knows.
pub struct Names<'a> {
    /// The name of a point.
    pub point: &'a dyn Fn(usize) -> Feature,
    /// The name of a segment.
    pub segment: &'a dyn Fn(usize) -> Feature,
}

impl Names<'_> {
    fn item(&self, item: Feature) -> Feature {
        match item {
            Feature::Point(p) => (self.point)(p),
            Feature::Segment(s) => (self.segment)(s),
            other => other,
        }
    }

    /// The number of a point, its own if it has no other.
    fn point(&self, p: usize) -> usize {
        if let Feature::Point(named) = (self.point)(p) { named } else { p }
    }

    fn segment(&self, s: usize) -> usize {
        if let Feature::Segment(named) = (self.segment)(s) { named } else { s }
    }

    /// An error of validation with the numbers that are known.
    pub(crate) fn of_validation(&self, error: ValidateError) -> ValidateError {
        use ValidateError as V;
        let both = |segments: [usize; 2]| segments.map(|s| self.segment(s));
        match error {
            V::ZeroLength { segment, at } => V::ZeroLength { segment: self.segment(segment), at },
            V::Duplicate { segments, ends } => V::Duplicate { segments: both(segments), ends },
            V::Overlap { segments, ends } => V::Overlap { segments: both(segments), ends },
            V::Crossing { segments, at } => V::Crossing { segments: both(segments), at },
            V::NotFollowed { segment, at } => V::NotFollowed { segment: self.segment(segment), at },
            V::OutOfRange { index, point, limit } => V::OutOfRange { index: self.point(index), point, limit },
            other => other,
        }
    }

    /// An error of meshing with the numbers that are known.
    pub fn of_meshing(&self, error: PslgError) -> PslgError {
        let both = |items: [Feature; 2]| items.map(|item| self.item(item));
        match error {
            PslgError::TooClose { items, at, distance, spacing } => {
                PslgError::TooClose { items: both(items), at, distance, spacing }
            }
            PslgError::TooMany { limit, at, near } => {
                let near = near.map(|near| Near { items: both(near.items), ..near });
                PslgError::TooMany { limit, at, near }
            }
            PslgError::NothingEnclosed { loose, count } => {
                let given = |end: LooseEnd| LooseEnd { point: self.point(end.point), ..end };
                PslgError::NothingEnclosed { loose: loose.into_iter().map(given).collect(), count }
            }
            PslgError::FlatHull { farthest, ends, distance } => {
                PslgError::FlatHull { farthest: self.item(farthest), ends: both(ends), distance }
            }
            PslgError::NotRecovered { item, at } => PslgError::NotRecovered { item: self.item(item), at },
            other => other,
        }
    }

    /// An error of a whole mesh with the numbers that are known.
    pub fn of_mesh(&self, error: Error) -> Error {
        match error {
            Error::Segments(error) => Error::Segments(self.of_validation(error)),
            Error::Pslg(error) => Error::Pslg(self.of_meshing(error)),
            Error::TooClose { a, b, points, distance, least } => {
                Error::TooClose { a: self.point(a), b: self.point(b), points, distance, least }
            }
            Error::OutOfRange { index, point, limit } => {
                Error::OutOfRange { index: self.point(index), point, limit }
            }
            Error::Points(PointsError::NotFinite { index, point }) => {
                Error::Points(PointsError::NotFinite { index: self.point(index), point })
            }
            other => other,
        }
    }
}

/// The polygons whose border each segment is a part of.
struct Owners {
    /// Segments and polygons, sorted.
    all: Vec<[u32; 2]>,
}

impl Owners {
    fn of(graph: &Pslg) -> Self {
        let polygons = graph.polygons.iter().zip(0_u32..);
        let mut all: Vec<[u32; 2]> =
            polygons.flat_map(|(p, i)| p.rings.iter().flatten().map(move |&segment| [segment, i])).collect();
        all.sort_unstable();
        all.dedup();
        Self { all }
    }

    fn of_segment(&self, segment: u32) -> &[[u32; 2]] {
        let [first, end] = [segment, segment + 1].map(|s| self.all.partition_point(|owner| owner[0] < s));
        &self.all[first..end]
    }

    /// Whether no polygon has both segments, and one of them is of a polygon.
    fn differ(&self, segments: [u32; 2]) -> bool {
        let [a, b] = segments.map(|s| self.of_segment(s));
        let shared = a.iter().any(|x| b.iter().any(|y| x[1] == y[1]));
        !(shared || a.is_empty() && b.is_empty())
    }
}

fn relative(graph: &Pslg) -> f64 {
    let start = (DVec2::INFINITY, DVec2::NEG_INFINITY, 0.0_f64);
    let (min, max, largest) = graph
        .points
        .iter()
        .fold(start, |(min, max, largest), &p| (min.min(p), max.max(p), largest.max(p.abs().max_element())));
    let tolerance = (OF_SIZE * (max - min).max_element()).max(OF_COORDINATE * largest);
    // Of points that are not finite repair says so.
    if tolerance.is_finite() { tolerance.max(0.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The box has no number in the PSLG given.
    #[test]
    fn sides_of_the_box_are_called_so() {
        let graph =
            Pslg { segments: vec![[0, 1]], ..Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y]) };
        let repaired = Repaired { graph, report: None };
        let items = |items: [Feature; 2]| PslgError::TooClose {
            items,
            at: DVec2::ZERO,
            distance: None,
            spacing: 1e-9,
        };
        for (found, told) in [
            ([Feature::Point(2), Feature::Segment(1)], "point 2 and the box around the PSLG are too close"),
            ([Feature::Point(3), Feature::Segment(0)], "the box around the PSLG and segment 0 are too close"),
            ([Feature::Hull; 2], "two edges of the convex hull are too close"),
        ] {
            let text = repaired.error_as_given(items(found)).to_string();
            assert!(text.starts_with(told), "{text}");
        }
    }

    /// A mesh made anew of what a session has left counts from 0, the session does not.
    #[test]
    fn errors_of_all_kinds_have_the_numbers_that_are_known() {
        let (point, segment) = (|p: usize| Feature::Point(10 + p), |s: usize| Feature::Segment(s / 2));
        let names = Names { point: &point, segment: &segment };
        let points = [DVec2::ZERO, DVec2::X];
        let (at, ends) = (DVec2::ZERO, points);
        for (error, told) in [
            (
                Error::TooClose { a: 1, b: 2, points, distance: 1.0, least: 2.0 },
                "points 11 at (0.0, 0.0) and 12 at",
            ),
            (Error::OutOfRange { index: 3, point: at, limit: 1.0 }, "point 13 at"),
            (Error::Points(PointsError::NotFinite { index: 4, point: at }), "point 14 at"),
            (Error::Segments(ValidateError::Crossing { segments: [4, 7], at }), "segments 2 and 3 cross"),
            (Error::Segments(ValidateError::Overlap { segments: [4, 7], ends }), "segments 2 and 3 overlap"),
            (Error::Segments(ValidateError::ZeroLength { segment: 5, at }), "segment 2 has no length"),
            (
                Error::Pslg(PslgError::TooMany {
                    limit: 5,
                    at: None,
                    near: Some(Near { items: [Feature::Point(0), Feature::Segment(9)], distance: 1.0 }),
                }),
                "the mesh would need more than 5 triangles, where point 10 and segment 4 are",
            ),
            (
                Error::Pslg(PslgError::NothingEnclosed { loose: vec![LooseEnd { point: 2, at }], count: 1 }),
                "the segments enclose no area outside the holes; loose ends: point 12",
            ),
            (
                Error::Pslg(PslgError::FlatHull {
                    farthest: Feature::Point(1),
                    ends: [0, 2].map(Feature::Point),
                    distance: 1e-13,
                }),
                "the convex hull is too flat to mesh: point 11 is farthest from the line through point 10 and \
                 point 12, 1e-13 away",
            ),
        ] {
            let text = names.of_mesh(error).to_string();
            assert!(text.starts_with(told), "{text}");
        }
    }
}
