//! Why a PSLG is no input, and why one could not be meshed.

use crate::geometry::nearest_places;
use crate::validate::Validated;
use hexdel_geom::{AngleBounds, Cancelled, DVec2, PointsError, Pslg, PslgLayoutError, orient2d};
use hexdel_optimize::OptimizeError;
use thiserror::Error;

/// Why a PSLG is no planar straight-line graph.
///
/// Points and segments are counted from 0, as given.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ValidateError {
    /// The arrays do not fit together, or an index is out of range.
    #[error(transparent)]
    Layout(#[from] PslgLayoutError),
    /// There are no points, or one is not finite.
    #[error(transparent)]
    Points(#[from] PointsError),
    /// A coordinate is so large that its square leaves the range of numbers.
    #[error("point {index} at ({}, {}) is out of range: coordinates may be up to {limit:e}", point.x, point.y)]
    OutOfRange {
        /// Index of the point.
        index: usize,
        /// The point.
        point: DVec2,
        /// The largest coordinate supported.
        limit: f64,
    },
    /// All points lie so close together that products of their distances leave
    /// the range of numbers.
    #[error("the points are within {extent:e} of each other, less than {limit:e}: scale them up")]
    TooSmall {
        /// The longer side of the rectangle around them.
        extent: f64,
        /// The smallest extent supported.
        limit: f64,
    },
    /// A segment could not be followed from one end to the other: around it
    /// points are so close that exact arithmetic leaves the range of numbers.
    #[error("segment {segment} could not be followed near ({}, {}): points are too close there", at.x, at.y)]
    NotFollowed {
        /// Index of the segment.
        segment: usize,
        /// Where.
        at: DVec2,
    },
    /// A hole or the point of a region is not finite.
    #[error("{item} {index} at ({}, {}) is not finite", point.x, point.y)]
    NotFinite {
        /// "hole" or "region".
        item: &'static str,
        /// Its index.
        index: usize,
        /// The point.
        point: DVec2,
    },
    /// A ring of a polygon is not closed.
    #[error("ring {ring} of polygon {polygon} ends at ({}, {}): rings must be closed", at.x, at.y)]
    OpenRing {
        /// Index of the polygon.
        polygon: usize,
        /// Index of the ring.
        ring: usize,
        /// Where it ends.
        at: DVec2,
    },
    /// The two ends of a segment are the same point.
    #[error("segment {segment} has no length: both ends are at ({}, {})", at.x, at.y)]
    ZeroLength {
        /// Index of the segment.
        segment: usize,
        /// Where it is.
        at: DVec2,
    },
    /// Two segments have the same ends.
    #[error("segments {} and {} are the same, from ({}, {}) to ({}, {})",
        segments[0], segments[1], ends[0].x, ends[0].y, ends[1].x, ends[1].y)]
    Duplicate {
        /// Their indices.
        segments: [usize; 2],
        /// Their ends.
        ends: [DVec2; 2],
    },
    /// Two segments on one line share more than a point.
    #[error("segments {} and {} overlap from ({}, {}) to ({}, {})",
        segments[0], segments[1], ends[0].x, ends[0].y, ends[1].x, ends[1].y)]
    Overlap {
        /// Their indices.
        segments: [usize; 2],
        /// The ends of a part that they share.
        ends: [DVec2; 2],
    },
    /// Two segments cross where neither ends.
    #[error("segments {} and {} cross at ({}, {})", segments[0], segments[1], at.x, at.y)]
    Crossing {
        /// Their indices.
        segments: [usize; 2],
        /// Where, up to rounding.
        at: DVec2,
    },
}

/// Why a valid PSLG could not be meshed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PslgError {
    /// Two parts of the input are closer than their coordinates can resolve:
    /// vertices between them would be rounded by more than angles bear.
    #[error("{} are too close at ({}, {}): {}hexagons of {spacing:e} cannot separate them",
        both(*items), at.x, at.y, apart(*distance))]
    TooClose {
        /// The two parts.
        items: [Feature; 2],
        /// Where.
        at: DVec2,
        /// How far apart they are; `None` if that is not known, or they meet elsewhere.
        /// Repair within this distance makes them one.
        distance: Option<f64>,
        /// Spacing of the finest hexagons that the coordinates resolve there.
        spacing: f64,
    },
    /// The budget of triangles is used up, or would be.
    #[error("the mesh would need more than {limit} triangles{}{}", around(*at), narrows(near.as_ref()))]
    TooMany {
        /// The limit.
        limit: usize,
        /// Where the size is smallest, if it is known.
        at: Option<DVec2>,
        /// What is so close there that it asks for them, if that is known.
        near: Option<Near>,
    },
    /// The inside was asked for, and nothing is enclosed by segments.
    #[error("the segments enclose no area outside the holes{}", listed(loose, *count))]
    NothingEnclosed {
        /// The first five points where only one segment ends.
        loose: Vec<LooseEnd>,
        /// How many there are.
        count: usize,
    },
    /// The convex hull was asked for, but all points are in a line, or so nearly that the hull has no area to
    /// mesh. The other domains have one.
    #[error("the convex hull is too flat to mesh: {}", flat(*farthest, *ends, *distance))]
    FlatHull {
        /// The point farthest from the line.
        farthest: Feature,
        /// The points at the ends of the line.
        ends: [Feature; 2],
        /// How far from the line that point is; 0 if all of them are on it.
        distance: f64,
    },
    /// The PSLG has polygons, of which meshes know nothing.
    #[error("polygons must be converted to holes and regions first, by `Validated::seeded`")]
    NotSeeded,
    /// Away from segments the method does not keep the bounds asked for.
    #[error(
        "the method cannot keep angles between {} and {} degrees away from segments, only {} to {}",
        asked.min_deg(), asked.max_deg(), kept.min_deg(), kept.max_deg()
    )]
    BoundsBeyondMethod {
        /// The bounds asked for.
        asked: AngleBounds,
        /// The bounds the method keeps.
        kept: AngleBounds,
    },
    /// A bound on the triangles' area is not a positive number.
    #[error("the largest area must be positive and finite, got {area:?}")]
    InvalidArea {
        /// The bound.
        area: f64,
    },
    /// A length of edges is not a positive number.
    #[error("the size at ({}, {}) must be positive, got {length:?}", at.x, at.y)]
    InvalidSize {
        /// Where.
        at: DVec2,
        /// The length.
        length: f64,
    },
    /// A segment could not be made a union of edges within the budget.
    #[error("{item} could not be recovered near ({}, {})", at.x, at.y)]
    NotRecovered {
        /// The segment, or the hull that it is an edge of.
        item: Feature,
        /// Where.
        at: DVec2,
    },
    /// The optimiser refused the mesh it was given: a defect of the library.
    #[error("the optimiser refused the mesh: {0}")]
    Refused(Box<OptimizeError>),
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Two parts of the input that are near each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// The two parts.
    pub items: [Feature; 2],
    /// How far apart they are; repair within this distance makes them one.
    pub distance: f64,
}

impl PslgError {
    /// Too many triangles, for whatever reason.
    pub(crate) fn too_many(limit: usize, at: impl Into<Option<DVec2>>) -> Self {
        Self::TooMany { limit, at: at.into(), near: None }
    }

    /// A tolerance for `repair` that makes one of the two parts of the input that keep it from
    /// being meshed, if that is why.
    pub fn repair_within(&self) -> Option<f64> {
        match self {
            // Edges of the hull end at points, which may be far apart.
            Self::TooClose { items: [Feature::Hull, Feature::Hull], .. } => None,
            // What coordinates do not resolve is as good as one.
            Self::TooClose { distance, spacing, .. } => Some(distance.unwrap_or(0.0).max(*spacing)),
            Self::TooMany { near, .. } => near.map(|near| near.distance),
            _ => None,
        }
    }

    /// With the distance of what is too close in it.
    pub(crate) fn measured(self, pslg: &Pslg) -> Self {
        match self {
            Self::TooClose { items, at, distance: None, spacing } => {
                Self::TooClose { items, at, distance: between(items, pslg), spacing }
            }
            other => other,
        }
    }
}

/// How far two parts of a PSLG are from each other, if they do not meet.
pub(crate) fn between(items: [Feature; 2], pslg: &Pslg) -> Option<f64> {
    let ends = |item| match item {
        Feature::Point(i) => Some([pslg.points[i]; 2]),
        Feature::Segment(i) => Some(pslg.segments[i].map(|p| pslg.points[p as usize])),
        Feature::Hull | Feature::Box | Feature::Crossing => None,
    };
    let [first, second] = [ends(items[0])?, ends(items[1])?];
    let [a, b] = nearest_places(first, second);
    let off = |p: DVec2, [c, d]: [DVec2; 2]| orient2d(c, d, p).abs() / c.distance(d);
    let distance = match a.distance(b) {
        // Of what is nearer than the last place predicates tell the distance.
        0.0 if first.contains(&a) && second[0] != second[1] => off(a, second),
        0.0 if second.contains(&b) && first[0] != first[1] => off(b, first),
        distance => distance,
    };
    Some(distance).filter(|&distance| distance > 0.0)
}

fn apart(distance: Option<f64>) -> String {
    distance.map_or_else(String::new, |distance| format!("they are {distance:e} apart, and "))
}

fn flat(farthest: Feature, [a, b]: [Feature; 2], distance: f64) -> String {
    match distance {
        0.0 => format!("all points are on the line through {a} and {b}"),
        _ => format!("{farthest} is farthest from the line through {a} and {b}, {distance:e} away"),
    }
}

fn narrows(near: Option<&Near>) -> String {
    near.map_or_else(String::new, |Near { items, distance }| {
        format!(", where {} are {distance:e} apart", both(*items))
    })
}

fn both(items: [Feature; 2]) -> String {
    match items {
        [Feature::Hull, Feature::Hull] => "two edges of the convex hull".to_owned(),
        [a, b] => format!("{a} and {b}"),
    }
}

/// A point where only one segment ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LooseEnd {
    /// Index of the point.
    pub point: usize,
    /// Where it is.
    pub at: DVec2,
}

/// Loose ends that are told one by one.
const TOLD: usize = 5;

impl PslgError {
    /// Nothing is enclosed: where segments end loose.
    pub(crate) fn nothing_enclosed(input: &Validated) -> Self {
        let mut ends = vec![0_u32; input.points.sites().len()];
        let segments = input.pieces.iter().filter(|piece| matches!(piece.feature(), Feature::Segment(_)));
        segments.flat_map(|piece| piece.ends).for_each(|site| ends[site as usize] += 1);
        let loose = || (0..ends.len()).filter(|&site| ends[site] == 1);
        let told = |site: usize| LooseEnd {
            point: input.points.input_of_site()[site] as usize,
            at: input.points.sites()[site],
        };
        Self::NothingEnclosed { loose: loose().take(TOLD).map(told).collect(), count: loose().count() }
    }
}

/// Where the finest triangles are, as the end of a sentence.
fn around(at: Option<DVec2>) -> String {
    at.map_or_else(String::new, |at| format!("; the finest around ({}, {})", at.x, at.y))
}

/// The points at which segments end loose, as the end of a sentence.
fn listed(loose: &[LooseEnd], count: usize) -> String {
    if loose.is_empty() {
        return String::new();
    }
    let ends: Vec<String> =
        loose.iter().map(|end| format!("point {} at ({}, {})", end.point, end.at.x, end.at.y)).collect();
    let more = match count.saturating_sub(loose.len()) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    format!("; loose ends: {}{more}", ends.join(", "))
}

/// A point or segment of the input, by index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// A point.
    Point(usize),
    /// A segment.
    Segment(usize),
    /// An edge of the convex hull that is no segment.
    Hull,
    /// A side or corner of the box around the PSLG.
    Box,
    /// A point that repair made where segments cross.
    Crossing,
}

impl std::fmt::Display for Feature {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Point(i) => write!(f, "point {i}"),
            Self::Segment(i) => write!(f, "segment {i}"),
            Self::Hull => write!(f, "the convex hull"),
            Self::Box => write!(f, "the box around the PSLG"),
            Self::Crossing => write!(f, "a crossing of segments"),
        }
    }
}
