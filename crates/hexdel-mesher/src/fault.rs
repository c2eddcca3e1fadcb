//! What errors are about, for programs: a kind, items with their indices, a place.

use crate::error::Error;
use crate::size::SizeError;
use hexdel_geom::{DVec2, PointsError, PslgLayoutError};
#[cfg(feature = "io")]
use hexdel_io::ReadError;
use hexdel_pslg::{Feature, PslgError, ValidateError};

/// What an error is about, as [`Error::fault`] and its like say. Its text says it for people.
///
/// ```
/// use hexdel::{DVec2, triangulate};
///
/// let refused = triangulate(&[DVec2::ZERO, DVec2::new(1e-300, 0.0)]).unwrap_err();
/// let fault = refused.fault();
/// assert_eq!((fault.kind, fault.item), ("too_close", Some("point")));
/// assert_eq!((fault.index, fault.location), (vec![0, 1], Some(DVec2::ZERO)));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Fault {
    /// What is wrong, in a word that stays.
    pub kind: &'static str,
    /// What the index counts: `point`, `segment`, `hole`, `region`.
    pub item: Option<&'static str>,
    /// Indices of the items to blame, from 0 as given.
    pub index: Vec<usize>,
    /// Where it is.
    pub location: Option<DVec2>,
    /// The distance, length or such that would do.
    pub least: Option<f64>,
    /// The line of the file.
    pub line: Option<u64>,
}

impl Fault {
    /// A fault of which nothing is known but its kind.
    ///
    /// ```
    /// assert_eq!(hexdel::Fault::new("cancelled").item, None);
    /// ```
    pub fn new(kind: &'static str) -> Self {
        Self { kind, ..Self::default() }
    }

    /// What is wrong with a file, with the feature `io`.
    ///
    /// ```
    /// use hexdel::io::{PointFormat, PointReader};
    ///
    /// let refused = PointReader::new().read_from("1 2 0 0\n0 0 zero\n".as_bytes(), PointFormat::Node, "a.node");
    /// let fault = hexdel::Fault::of_reading(&refused.unwrap_err());
    /// assert_eq!((fault.kind, fault.line), ("file", Some(2)));
    /// ```
    #[cfg(feature = "io")]
    pub fn of_reading(error: &ReadError) -> Self {
        let kind = if matches!(error, ReadError::Missing { .. }) { "missing_file" } else { "file" };
        Self { line: error.line(), ..Self::new(kind) }
    }

    /// The same with a place.
    #[must_use]
    pub fn at(self, location: DVec2) -> Self {
        Self { location: Some(location), ..self }
    }

    /// The same with what would do.
    #[must_use]
    pub fn least(self, least: f64) -> Self {
        Self { least: Some(least), ..self }
    }

    /// The same with the items to blame.
    ///
    /// ```
    /// let fault = hexdel::Fault::new("crossing").of("segment", [3, 5]);
    /// assert_eq!((fault.item, fault.index), (Some("segment"), vec![3, 5]));
    /// ```
    #[must_use]
    pub fn of(self, item: &'static str, index: impl IntoIterator<Item = usize>) -> Self {
        Self { item: Some(item), index: index.into_iter().collect(), ..self }
    }
}

impl Error {
    /// What the error is about, for programs.
    pub fn fault(&self) -> Fault {
        match self {
            Self::Points(error) => of_points(error),
            Self::OutOfRange { index, point, .. } => {
                Fault::new("out_of_range").of("point", [*index]).at(*point)
            }
            Self::TooClose { a, b, points, least, .. } => {
                Fault::new("too_close").of("point", [*a, *b]).at(points[0]).least(*least)
            }
            Self::DomainTooSmall { least, .. } => Fault::new("domain").least(*least),
            Self::DomainTooLarge { most, .. } => Fault::new("domain").least(*most),
            Self::InvalidRadius { .. } => Fault::new("domain"),
            Self::BoundsBeyondMethod { .. } => Fault::new("bounds"),
            Self::NoGrading { .. } => Fault::new("no_grading"),
            Self::NoDualEdge { .. } => Fault::new("dual_edge"),
            Self::Overlap { at, .. } => Fault::new("overlaps").at(*at),
            Self::Segments(error) => of_segments(error),
            Self::Pslg(error) => of_graph(error),
            Self::InvalidTolerance { .. } => Fault::new("tolerance"),
            Self::NotForPoints { .. } | Self::NotForGraphs { .. } => Fault::new("option"),
            Self::TooManyVertices { .. } => Fault::new("too_many"),
            Self::Size(error) => error.fault(),
            Self::Threads { .. } => Fault::new("threads"),
            Self::Cancelled(_) => Fault::new("cancelled"),
            Self::Unreached { .. } => Fault::new("unreached"),
            Self::NotCertified { .. } | Self::DualEdges { .. } => Fault::new("not_certified"),
            Self::Delaunay(_) | Self::Optimize(_) | Self::Refine(_) | Self::Dual(_) => Fault::new("internal"),
        }
    }
}

impl SizeError {
    /// What the error is about, for programs.
    pub fn fault(&self) -> Fault {
        match self {
            Self::BelowResolution { least, .. } => Fault::new("size").least(*least),
            Self::TooMany { .. } => Fault::new("too_many"),
            Self::Unreached { at, .. } => Fault::new("size_unreached").at(*at),
            _ => Fault::new("size"),
        }
    }
}

fn of_points(error: &PointsError) -> Fault {
    match error {
        PointsError::Empty => Fault::new("empty"),
        PointsError::NotFinite { index, point } => Fault::new("not_finite").of("point", [*index]).at(*point),
        _ => Fault::new("too_many"),
    }
}

fn of_segments(error: &ValidateError) -> Fault {
    use ValidateError as V;
    let segment = |kind, index: &usize, at: &DVec2| Fault::new(kind).of("segment", [*index]).at(*at);
    let pair = |kind, indices: &[usize; 2], at: &DVec2| Fault::new(kind).of("segment", *indices).at(*at);
    match error {
        V::Layout(PslgLayoutError::SegmentEnd { segment, .. }) => {
            Fault::new("segment_end").of("segment", [*segment])
        }
        V::Layout(_) => Fault::new("length"),
        V::Points(error) => of_points(error),
        V::OutOfRange { index, point, .. } => Fault::new("out_of_range").of("point", [*index]).at(*point),
        V::NotFollowed { segment: index, at } => segment("too_close", index, at),
        V::NotFinite { item, index, point } => Fault::new("not_finite").of(item, [*index]).at(*point),
        V::ZeroLength { segment: index, at } => segment("zero_length", index, at),
        V::Duplicate { segments, ends } => pair("duplicate", segments, &ends[0]),
        V::Overlap { segments, ends } => pair("overlap", segments, &ends[0]),
        V::Crossing { segments, at } => pair("crossing", segments, at),
        _ => Fault::new("input"),
    }
}

fn of_graph(error: &PslgError) -> Fault {
    let point = |item: &Feature| if let Feature::Point(i) = item { Some(*i) } else { None };
    let segment = |item: &Feature| if let Feature::Segment(i) = item { Some(*i) } else { None };
    match error {
        PslgError::TooClose { items, at, .. } => {
            let fault = Fault { least: error.repair_within(), ..Fault::new("too_close").at(*at) };
            let points: Vec<usize> = items.iter().filter_map(point).collect();
            if points.is_empty() {
                fault.of("segment", items.iter().filter_map(segment))
            } else {
                fault.of("point", points)
            }
        }
        PslgError::TooMany { at, .. } => {
            Fault { location: *at, least: error.repair_within(), ..Fault::new("too_many") }
        }
        PslgError::FlatHull { farthest, ends, .. } => {
            Fault::new("flat_hull").of("point", [*farthest, ends[0], ends[1]].iter().filter_map(point))
        }
        PslgError::NothingEnclosed { .. } => Fault::new("nothing_enclosed"),
        PslgError::BoundsBeyondMethod { .. } => Fault::new("bounds"),
        PslgError::InvalidArea { .. } => Fault::new("area"),
        PslgError::InvalidSize { at, .. } => Fault::new("size").at(*at),
        PslgError::NotRecovered { item: Feature::Segment(i), at } => {
            Fault::new("not_recovered").of("segment", [*i]).at(*at)
        }
        PslgError::NotRecovered { at, .. } => Fault::new("not_recovered").at(*at),
        PslgError::Cancelled(_) => Fault::new("cancelled"),
        _ => Fault::new("internal"),
    }
}
