//! A graph as given or repaired, and errors in the numbers of the one given.

use super::Tolerance;
use crate::error::Error;
use hexdel_geom::{DVec2, Pslg};
use hexdel_pslg::{Feature, LooseEnd, PslgError, RepairReport, ValidateError, drop_repeated, repair};

/// The tolerance over the graph's size; a hundredth of the width of the thinnest
/// hair that coordinates of that size resolve angles in would still do.
const OF_SIZE: f64 = 1e-9;

/// The tolerance over the largest coordinate, for small graphs far from the
/// origin: meshes need distances of about `2e-11` of it.
const OF_COORDINATE: f64 = 1e-10;

/// A graph to be meshed.
pub(crate) struct Repaired {
    pub(crate) graph: Pslg,
    /// What was done, if anything was asked for or segments were dropped.
    pub(crate) report: Option<RepairReport>,
}

impl Repaired {
    pub(super) fn new(given: &Pslg, tolerance: Option<Tolerance>) -> Result<Self, Error> {
        let tolerance = match tolerance {
            None => {
                let dropped = drop_repeated(given).map(|(graph, report)| (graph, Some(report)));
                let (graph, report) = dropped.unwrap_or_else(|| (given.clone(), None));
                return Ok(Self { graph, report });
            }
            Some(Tolerance::Relative) => relative(given),
            Some(Tolerance::Absolute(tolerance)) if tolerance.is_finite() && tolerance >= 0.0 => tolerance,
            Some(Tolerance::Absolute(tolerance)) => return Err(Error::InvalidTolerance { tolerance }),
        };
        let (graph, report) = repair(given, tolerance)?;
        Ok(Self { graph, report: Some(report) })
    }

    /// An error of validation in the numbers of the graph given.
    pub(super) fn as_given(&self, error: ValidateError) -> Error {
        use ValidateError as V;
        let both = |segments: [usize; 2]| segments.map(|s| self.segment(s));
        let error = match error {
            V::ZeroLength { segment, at } => V::ZeroLength { segment: self.segment(segment), at },
            V::Duplicate { segments, ends } => V::Duplicate { segments: both(segments), ends },
            V::Overlap { segments, ends } => V::Overlap { segments: both(segments), ends },
            V::Crossing { segments, at } => V::Crossing { segments: both(segments), at },
            V::NotFollowed { segment, at } => V::NotFollowed { segment: self.segment(segment), at },
            V::OutOfRange { index, point, limit } => {
                V::OutOfRange { index: self.point(index).unwrap_or(index), point, limit }
            }
            other => other,
        };
        error.into()
    }

    /// An error of meshing in the numbers of the graph given.
    pub(super) fn error_as_given(&self, error: PslgError) -> Error {
        let item = |item| match item {
            Feature::Point(p) => self.point(p).map_or(Feature::Crossing, Feature::Point),
            Feature::Segment(s) => Feature::Segment(self.segment(s)),
            other => other,
        };
        let error = match error {
            PslgError::TooClose { items, at, spacing } => {
                PslgError::TooClose { items: items.map(item), at, spacing }
            }
            PslgError::NothingEnclosed { loose, count } => {
                let given =
                    |end: LooseEnd| LooseEnd { point: self.point(end.point).unwrap_or(end.point), ..end };
                PslgError::NothingEnclosed { loose: loose.into_iter().map(given).collect(), count }
            }
            PslgError::NotRecovered { item: part, at } => PslgError::NotRecovered { item: item(part), at },
            other => other,
        };
        error.into()
    }

    /// The first point given that a point of the graph is.
    fn point(&self, point: usize) -> Option<usize> {
        match &self.report {
            None => Some(point),
            Some(report) => report.point_of_input.iter().position(|&p| p as usize == point),
        }
    }

    /// The first segment given that a segment of the graph is a part of.
    fn segment(&self, segment: usize) -> usize {
        let report = self.report.as_ref();
        report.and_then(|r| r.sources.get(segment)?.first()).map_or(segment, |&s| s as usize)
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
