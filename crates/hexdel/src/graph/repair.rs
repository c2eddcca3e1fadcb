//! A graph as given or repaired, and errors in the numbers of the one given.

use super::Tolerance;
use crate::error::Error;
use hexdel_geom::{DVec2, Pslg};
use hexdel_pslg::{
    Feature, LooseEnd, Near, PslgError, Repair, RepairReport, ValidateError, drop_repeated, repair,
    repair_nearly_on,
};

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
        let (graph, report) = match tolerance {
            // Of polygons, what is twice is a border of two.
            None if !given.polygons.is_empty() => return Ok(Self { graph: given.clone(), report: None }),
            None => {
                let dropped = drop_repeated(given).map(|(graph, report)| (graph, Some(report)));
                let (graph, report) = dropped.unwrap_or_else(|| (given.clone(), None));
                return Ok(Self { graph, report });
            }
            Some(Tolerance::Relative) => repair_nearly_on(given, relative(given))?,
            Some(Tolerance::Absolute(tolerance)) if tolerance.is_finite() && tolerance >= 0.0 => {
                repair(given, tolerance)?
            }
            Some(Tolerance::Absolute(tolerance)) => return Err(Error::InvalidTolerance { tolerance }),
        };
        Ok(Self { graph, report: Some(report) })
    }

    /// A graph that is not valid as given, with the borders of its polygons divided where they
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
            PslgError::TooClose { items, at, distance, spacing } => {
                PslgError::TooClose { items: items.map(item), at, distance, spacing }
            }
            PslgError::TooMany { limit, at, near } => {
                let near = near.map(|near| Near { items: near.items.map(item), ..near });
                PslgError::TooMany { limit, at, near }
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
    pub(super) fn segment(&self, segment: usize) -> usize {
        let report = self.report.as_ref();
        report.and_then(|r| r.sources.get(segment)?.first()).map_or(segment, |&s| s as usize)
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
