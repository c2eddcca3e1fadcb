//! Errors of the library as they are thrown: JSON with a kind, the library's words, and the
//! items and the place that they are about.

use hexdel::geom::{PointsError, PslgLayoutError};
use hexdel::io::ReadError;
use hexdel::pslg::{Feature, PslgError, ValidateError};
use hexdel::{DVec2, Error, SessionError, SizeError};
use serde::Serialize;
use wasm_bindgen::JsValue;

/// What is known of a failure.
#[derive(Debug, Default, Serialize)]
struct Fault {
    kind: &'static str,
    message: String,
    /// What the index counts: "point", "segment", "hole", "region".
    item: Option<&'static str>,
    /// Indices of the items, from 0.
    index: Vec<usize>,
    location: Option<[f64; 2]>,
    /// The distance, length or such that would do.
    least: Option<f64>,
    line: Option<u64>,
}

impl Fault {
    fn new(kind: &'static str) -> Self {
        Self { kind, ..Self::default() }
    }

    fn of(mut self, item: &'static str, index: impl IntoIterator<Item = usize>) -> Self {
        (self.item, self.index) = (Some(item), index.into_iter().collect());
        self
    }

    fn at(mut self, location: DVec2) -> Self {
        self.location = Some(location.to_array());
        self
    }

    fn least(mut self, least: f64) -> Self {
        self.least = Some(least);
        self
    }

    fn thrown(mut self, message: &str) -> JsValue {
        message.clone_into(&mut self.message);
        // Numbers that are not finite become null.
        serde_json::to_string(&self).unwrap_or_else(|_| message.to_owned()).into()
    }
}

/// A failure that only the kind and a message tell of.
pub(crate) fn plain(kind: &'static str, message: &str) -> JsValue {
    Fault::new(kind).thrown(message)
}

/// Why points or a graph were not meshed.
pub(crate) fn of_mesh(error: &Error) -> JsValue {
    fault_of(error).thrown(&error.to_string())
}

/// Why a size is none.
pub(crate) fn of_size(error: &SizeError) -> JsValue {
    fault_of_size(error).thrown(&error.to_string())
}

/// Why a file was not read.
pub(crate) fn of_reading(error: &ReadError) -> JsValue {
    Fault { line: error.line(), ..Fault::new("file") }.thrown(&error.to_string())
}

/// Why a session did not do what was asked.
pub(crate) fn of_session(error: &SessionError) -> JsValue {
    use SessionError as S;
    let of = |kind, id: &hexdel::PointId| Fault::new(kind).of("point", [id.0 as usize]);
    let fault = match error {
        S::Mesh(error) => fault_of(error),
        S::Size(error) => fault_of_size(error),
        S::NotFinite { at } => Fault::new("not_finite").at(*at),
        S::Outside { at, .. } | S::NotCovered { at } | S::AtRim { at, .. } => Fault::new("outside").at(*at),
        S::NoRoom { at } => Fault::new("no_room").at(*at),
        S::SegmentEnd { id } => of("segment_end", id),
        S::UnknownPoint { id } => of("unknown_point", id),
        S::Duplicate { at, of: id } => of("duplicate", id).at(*at),
        S::TooClose { at, least, .. } => Fault::new("too_close").at(*at).least(*least),
        S::NothingToUndo => Fault::new("nothing_to_undo"),
        S::InvalidDomain { centre, .. } => Fault::new("domain").at(*centre),
        S::NotForSessions { .. } | S::NoSegments | S::CannotSave => Fault::new("option"),
        S::Unreadable { .. } | S::State(_) | S::Points { .. } | S::NotCertified { .. } => Fault::new("file"),
        _ => Fault::new("session"),
    };
    fault.thrown(&error.to_string())
}

fn fault_of(error: &Error) -> Fault {
    match error {
        Error::Points(error) => fault_of_points(error),
        Error::OutOfRange { index, point, .. } => Fault::new("out_of_range").of("point", [*index]).at(*point),
        Error::TooClose { a, b, points, least, .. } => {
            Fault::new("too_close").of("point", [*a, *b]).at(points[0]).least(*least)
        }
        Error::DomainTooSmall { least, .. } => Fault::new("domain").least(*least),
        Error::DomainTooLarge { most, .. } => Fault::new("domain").least(*most),
        Error::InvalidRadius { .. } => Fault::new("domain"),
        Error::BoundsBeyondMethod { .. } => Fault::new("bounds"),
        Error::NoGrading { .. } => Fault::new("no_grading"),
        Error::NoDualEdge { .. } => Fault::new("dual_edge"),
        Error::Overlap { at, .. } => Fault::new("overlaps").at(*at),
        Error::Segments(error) => fault_of_segments(error),
        Error::Pslg(error) => fault_of_graph(error),
        Error::InvalidTolerance { .. } => Fault::new("tolerance"),
        Error::NotForPoints { .. } | Error::NotForGraphs { .. } => Fault::new("option"),
        Error::TooManyVertices { .. } => Fault::new("too_many"),
        Error::Size(error) => fault_of_size(error),
        Error::Cancelled(_) => Fault::new("cancelled"),
        Error::Unreached { .. } => Fault::new("unreached"),
        Error::NotCertified { .. } | Error::DualEdges { .. } => Fault::new("not_certified"),
        Error::Delaunay(_) | Error::Optimize(_) | Error::Refine(_) | Error::Dual(_) => Fault::new("internal"),
        _ => Fault::new("other"),
    }
}

fn fault_of_points(error: &PointsError) -> Fault {
    match error {
        PointsError::Empty => Fault::new("empty"),
        PointsError::NotFinite { index, point } => Fault::new("not_finite").of("point", [*index]).at(*point),
        _ => Fault::new("too_many"),
    }
}

fn fault_of_segments(error: &ValidateError) -> Fault {
    use ValidateError as V;
    match error {
        V::Layout(PslgLayoutError::SegmentEnd { segment, .. }) => {
            Fault::new("segment_end").of("segment", [*segment])
        }
        V::Layout(_) => Fault::new("length"),
        V::Points(error) => fault_of_points(error),
        V::OutOfRange { index, point, .. } => Fault::new("out_of_range").of("point", [*index]).at(*point),
        V::NotFollowed { segment, at } => Fault::new("too_close").of("segment", [*segment]).at(*at),
        V::NotFinite { item, index, point } => Fault::new("not_finite").of(item, [*index]).at(*point),
        V::ZeroLength { segment, at } => Fault::new("zero_length").of("segment", [*segment]).at(*at),
        V::Duplicate { segments, ends } => Fault::new("duplicate").of("segment", *segments).at(ends[0]),
        V::Overlap { segments, ends } => Fault::new("overlap").of("segment", *segments).at(ends[0]),
        V::Crossing { segments, at } => Fault::new("crossing").of("segment", *segments).at(*at),
        _ => Fault::new("input"),
    }
}

fn fault_of_graph(error: &PslgError) -> Fault {
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
            let location = at.map(|at| at.to_array());
            Fault { location, least: error.repair_within(), ..Fault::new("too_many") }
        }
        PslgError::FlatHull { farthest, ends, .. } => {
            Fault::new("flat_hull").of("point", [*farthest, ends[0], ends[1]].iter().filter_map(point))
        }
        PslgError::NothingEnclosed { .. } => Fault::new("nothing_enclosed"),
        PslgError::BoundsBeyondMethod { .. } => Fault::new("bounds"),
        PslgError::InvalidArea { .. } => Fault::new("area"),
        PslgError::InvalidSize { at, .. } => Fault::new("size").at(*at),
        PslgError::NotRecovered { item, at } => {
            Fault::new("not_recovered").of("segment", segment(item)).at(*at)
        }
        PslgError::Cancelled(_) => Fault::new("cancelled"),
        _ => Fault::new("internal"),
    }
}

fn fault_of_size(error: &SizeError) -> Fault {
    match error {
        SizeError::BelowResolution { least, .. } => Fault::new("size").least(*least),
        SizeError::TooMany { .. } => Fault::new("too_many"),
        SizeError::Unreached { at, .. } => Fault::new("size_unreached").at(*at),
        _ => Fault::new("size"),
    }
}
