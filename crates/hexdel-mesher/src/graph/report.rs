//! The figures of a PSLG's mesh, for a file or a pipe.

use super::result::PslgTriangulation;
use super::warning::Warning;
use crate::triangulation::Seconds;
use hexdel_geom::certificate::DualCheck;
use hexdel_geom::{AngleBounds, Certificate, DVec2, Pslg, Voronoi, VoronoiSummary};
use hexdel_pslg::{Exception, Reason, Repair, SegmentMethod};

/// The figures of a PSLG's mesh.
///
/// Points and segments are counted as in [`PslgTriangulation::graph`], those in
/// `repairs` as given.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct PslgReport<'a> {
    /// How segments came into the mesh.
    pub method: &'static str,
    /// What it covers.
    pub domain: &'static str,
    /// Whether everything that was asked for is so, up to exempt corners.
    pub holds: bool,
    /// All that the certificate says.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub certificate: &'a Certificate,
    /// The bounds of triangles two edges or more away from points and segments.
    pub far_bounds: AngleBounds,
    /// How many of those there are.
    pub far_triangles: usize,
    /// Their smallest angle, degrees.
    pub far_min_angle_deg: Option<f64>,
    /// What its Voronoi dual is like; nothing if the mesh touches itself in a
    /// point.
    pub dual: Option<VoronoiSummary>,
    /// What was found of its edges, if a bound was given.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub dual_edges: Option<&'a DualCheck>,
    /// How many segments there are.
    pub segments: usize,
    /// How many edges they consist of.
    pub segment_edges: u32,
    /// How many edges each consists of; 0 in a hole or outside of the domain.
    pub edges_of_segment: &'a [u32],
    /// Pieces of segments in the domain that are no unions of edges.
    pub segments_missing: usize,
    /// Triangles that only a corner of the input puts out of bounds.
    pub exempt: Vec<ExceptionEntry>,
    /// The longest edge over the length wanted, if a size was given.
    pub size_ratio: Option<f64>,
    /// Triangles out of bounds, or larger or longer than allowed.
    pub failed: Vec<ExceptionEntry>,
    /// What repair did, in order.
    pub repairs: Vec<RepairEntry>,
    /// What is not used of the PSLG, or could have been meant otherwise.
    pub warnings: Vec<WarningEntry>,
    /// How often parts of the grid were refined because bounds were not met.
    pub retries: u32,
    /// Whether the budget ended optimisation before its end.
    pub budget_spent: bool,
    /// How long it took.
    pub seconds: Seconds,
}

/// A triangle that does not keep its bounds, or is larger or longer than
/// allowed.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ExceptionEntry {
    /// Its index.
    pub triangle: usize,
    /// Its centroid.
    pub at: DVec2,
    /// Its smallest angle, degrees.
    pub min_angle_deg: f64,
    /// Its largest angle, degrees.
    pub max_angle_deg: f64,
    /// Why, in a word: "sector", "near sector", "template", "too large",
    /// "too long" or "unsolved".
    pub reason: &'static str,
    /// Of a triangle that is too large: its area and the largest allowed there.
    pub areas: Option<[f64; 2]>,
    /// Of a triangle with an edge that is too long: its length and the largest
    /// allowed there.
    pub lengths: Option<[f64; 2]>,
    /// The corner of the input to blame, if there is one.
    pub corner: Option<Corner>,
}

/// A corner of the input between two segments that is narrower than the bound.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Corner {
    /// The point where the segments meet.
    pub point: u32,
    /// Where it is.
    pub at: DVec2,
    /// The angle between the segments, degrees.
    pub angle_deg: f64,
}

/// One thing that repair did.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct RepairEntry {
    /// What, in words.
    pub what: String,
    /// Where.
    pub at: DVec2,
}

/// Something to know about the PSLG.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct WarningEntry {
    /// What, in words.
    pub what: String,
    /// Where.
    pub at: DVec2,
}

impl WarningEntry {
    fn new(warning: &Warning) -> Self {
        Self { what: warning.to_string(), at: warning.at() }
    }
}

impl<'a> PslgReport<'a> {
    pub(super) fn new(made: &'a PslgTriangulation) -> Self {
        let entries = |list: &[Exception]| list.iter().map(|e| ExceptionEntry::new(e, &made.graph)).collect();
        let repairs = made.repairs.iter().flat_map(|report| &report.repairs);
        Self {
            method: match made.method {
                SegmentMethod::Paper => "paper",
                _ => "conform",
            },
            domain: made.domain.name(),
            holds: made.holds(),
            certificate: &made.certificate,
            far_bounds: made.far_bounds,
            far_triangles: made.places.far,
            far_min_angle_deg: made.places.far_min_deg,
            dual: Voronoi::new(&made.mesh).ok().map(|dual| dual.summary()),
            dual_edges: made.dual_edges.as_ref(),
            segments: made.graph.segments.len(),
            segment_edges: made.edges_of_segment.iter().sum(),
            edges_of_segment: &made.edges_of_segment,
            segments_missing: made.segments.missing.len(),
            exempt: entries(&made.exempt),
            size_ratio: made.size_ratio,
            failed: entries(&made.failed),
            repairs: repairs.map(RepairEntry::new).collect(),
            warnings: made.warnings.iter().map(WarningEntry::new).collect(),
            retries: made.retries,
            budget_spent: made.budget_spent,
            seconds: made.seconds,
        }
    }
}

impl ExceptionEntry {
    /// A triangle out of bounds in the mesh of `graph`.
    ///
    /// # Panics
    ///
    /// If the exception names a point that the PSLG does not have.
    pub fn new(exception: &Exception, graph: &Pslg) -> Self {
        let corner = |point: u32, angle_deg| Corner { point, at: graph.points[point as usize], angle_deg };
        let (reason, corner) = match exception.reason {
            Reason::Sector { point, angle_deg } => ("sector", Some(corner(point, angle_deg))),
            Reason::NearSector { point, angle_deg, .. } => ("near sector", Some(corner(point, angle_deg))),
            Reason::Template => ("template", None),
            Reason::TooLarge { .. } => ("too large", None),
            Reason::TooLong { .. } => ("too long", None),
            _ => ("unsolved", None),
        };
        let areas = match exception.reason {
            Reason::TooLarge { area, limit } => Some([area, limit]),
            _ => None,
        };
        let lengths = match exception.reason {
            Reason::TooLong { length, limit } => Some([length, limit]),
            _ => None,
        };
        let [min_angle_deg, max_angle_deg] = exception.angles_deg;
        let triangle = exception.triangle.index();
        Self { triangle, at: exception.at, min_angle_deg, max_angle_deg, reason, areas, lengths, corner }
    }
}

impl std::fmt::Display for ExceptionEntry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { triangle, at, min_angle_deg, max_angle_deg, .. } = self;
        let DVec2 { x, y } = at;
        write!(f, "triangle {triangle} at ({x}, {y}): {min_angle_deg:.4} to {max_angle_deg:.4} degrees, ")?;
        match (self.reason, self.corner) {
            ("sector", Some(Corner { point, angle_deg, .. })) => {
                write!(f, "segments meet at point {point} at {angle_deg:.4} degrees")
            }
            (_, Some(Corner { point, angle_deg, .. })) => {
                write!(f, "near point {point}, where segments meet at {angle_deg:.4} degrees")
            }
            ("too large", _) => {
                let [area, limit] = self.areas.unwrap_or_default();
                write!(f, "area {area}, allowed {limit}")
            }
            ("too long", _) => {
                let [length, limit] = self.lengths.unwrap_or_default();
                write!(f, "an edge of length {length}, allowed {limit}")
            }
            ("template", _) => write!(f, "as the paper's templates left it"),
            _ => write!(f, "no remedy was found"),
        }
    }
}

impl RepairEntry {
    /// One thing that repair did, in words.
    pub fn new(repair: &Repair) -> Self {
        let (what, at) = match *repair {
            Repair::MergedPoint { point, into, at, distance: 0.0 } => {
                (format!("point {point} was a duplicate of point {into}"), at)
            }
            Repair::MergedPoint { point, into, at, distance } => {
                (format!("point {point} was merged into point {into}, {distance:e} away"), at)
            }
            Repair::DroppedSegment { segment, at } => (format!("segment {segment} had no length"), at),
            Repair::MergedSegments { segments: [a, b], ends } => {
                (format!("segments {a} and {b} overlapped"), ends[0])
            }
            Repair::DividedAtPoint { segment, at, distance: 0.0 } => {
                (format!("segment {segment} was divided at a point"), at)
            }
            Repair::DividedAtPoint { segment, at, distance } => {
                (format!("segment {segment} was bent to a point {distance:e} away"), at)
            }
            Repair::DividedAtCrossing { segments: [a, b], at } => {
                (format!("segments {a} and {b} crossed"), at)
            }
            _ => (format!("{repair:?}"), DVec2::NAN),
        };
        Self { what, at }
    }
}

impl std::fmt::Display for RepairEntry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} at ({}, {})", self.what, self.at.x, self.at.y)
    }
}
