//! Errors of the library as exceptions: which class they become, with what kind, item,
//! index and place, is said here; the text with the way out is made by
//! `hexdel/_errors.py`.

use glam::DVec2;
use hexdel::geom::{PointsError, PslgLayoutError};
use hexdel::io::{ReadError, WriteError};
use hexdel::pslg::{Feature, PslgError, ValidateError};
use hexdel::{Error, SessionError, SizeError, TriMesh};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::any::Any;

/// What is known of a failure.
#[derive(Debug, Default)]
struct Fault {
    kind: &'static str,
    /// What the index counts: "point", "segment", "hole", "region".
    item: Option<&'static str>,
    /// Indices of the items, from 0.
    index: Vec<usize>,
    location: Option<DVec2>,
    /// The distance, length or such that would do.
    least: Option<f64>,
    file: Option<String>,
    line: Option<u64>,
}

impl Fault {
    fn new(kind: &'static str) -> Self {
        Self { kind, ..Self::default() }
    }

    fn points(mut self, index: impl IntoIterator<Item = usize>) -> Self {
        (self.item, self.index) = (Some("point"), index.into_iter().collect());
        self
    }

    fn segments(mut self, index: impl IntoIterator<Item = usize>) -> Self {
        (self.item, self.index) = (Some("segment"), index.into_iter().collect());
        self
    }

    fn at(mut self, location: DVec2) -> Self {
        self.location = Some(location);
        self
    }

    fn least(mut self, least: f64) -> Self {
        self.least = Some(least);
        self
    }

    /// The exception, with the message and, if the work led to one, the mesh.
    fn raise(self, py: Python<'_>, message: &str, mesh: Option<&TriMesh>) -> PyErr {
        let made = || -> PyResult<PyErr> {
            let details = PyDict::new(py);
            details.set_item("kind", self.kind)?;
            details.set_item("message", message)?;
            details.set_item("item", self.item)?;
            details.set_item("index", self.index)?;
            details.set_item("location", self.location.map(|p| (p.x, p.y)))?;
            details.set_item("least", self.least)?;
            details.set_item("file", self.file)?;
            details.set_item("line", self.line)?;
            if let Some(mesh) = mesh {
                let vertices = crate::convert::points_out(py, mesh.vertices.clone())?;
                let triangles = crate::convert::triangles_out(py, mesh.triangles.clone())?;
                details.set_item("mesh", (vertices, triangles))?;
            }
            let make = py.import("hexdel._errors")?.getattr("make")?;
            Ok(PyErr::from_value(make.call1((details,))?))
        };
        made().unwrap_or_else(|error| error)
    }
}

/// A failure that only the kind and a message tell of.
pub(crate) fn plain(py: Python<'_>, kind: &'static str, message: &str) -> PyErr {
    Fault::new(kind).raise(py, message, None)
}

/// Threads that could not be started.
pub(crate) fn threads(py: Python<'_>, threads: usize) -> PyErr {
    plain(py, "threads", &format!("cannot start {threads} threads"))
}

/// A defect of the library.
pub(crate) fn panicked(py: Python<'_>, panic: &(dyn Any + Send)) -> PyErr {
    let message = panic.downcast_ref::<&str>().copied().map(ToOwned::to_owned);
    let message = message.or_else(|| panic.downcast_ref::<String>().cloned());
    plain(py, "internal", &format!("a defect of hexdel: {}", message.unwrap_or_default()))
}

/// A length wanted by the caller's function that is none.
pub(crate) fn bad_length(py: Python<'_>, at: DVec2, length: f64) -> PyErr {
    let message = format!(
        "the size at ({:?}, {:?}) is {length:?}: a callable must return positive numbers",
        at.x, at.y
    );
    Fault::new("callable").at(at).raise(py, &message, None)
}

/// Why points or a PSLG were not meshed.
pub(crate) fn of_mesh(py: Python<'_>, error: &Error) -> PyErr {
    let mesh = match error {
        Error::Unreached { mesh, .. } | Error::NotCertified { mesh, .. } | Error::DualEdges { mesh, .. } => {
            Some(&**mesh)
        }
        _ => None,
    };
    fault_of(error).raise(py, &error.to_string(), mesh)
}

fn fault_of(error: &Error) -> Fault {
    match error {
        Error::Points(error) => fault_of_points(error),
        Error::OutOfRange { index, point, .. } => Fault::new("out_of_range").points([*index]).at(*point),
        Error::TooClose { a, b, points, least, .. } => {
            Fault::new("too_close").points([*a, *b]).at(points[0]).least(*least)
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
        Error::Threads { .. } => Fault::new("threads"),
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
        PointsError::NotFinite { index, point } => Fault::new("not_finite").points([*index]).at(*point),
        _ => Fault::new("too_many"),
    }
}

fn fault_of_segments(error: &ValidateError) -> Fault {
    use ValidateError as V;
    match error {
        V::Layout(PslgLayoutError::SegmentEnd { segment, .. }) => {
            Fault::new("segment_end").segments([*segment])
        }
        V::Layout(_) => Fault::new("length"),
        V::Points(error) => fault_of_points(error),
        V::OutOfRange { index, point, .. } => Fault::new("out_of_range").points([*index]).at(*point),
        V::NotFollowed { segment, at } => Fault::new("too_close").segments([*segment]).at(*at),
        V::NotFinite { item, index, point } => {
            Fault { item: Some(item), index: vec![*index], ..Fault::new("not_finite").at(*point) }
        }
        V::ZeroLength { segment, at } => Fault::new("zero_length").segments([*segment]).at(*at),
        V::Duplicate { segments, ends } => Fault::new("duplicate").segments(*segments).at(ends[0]),
        V::Overlap { segments, ends } => Fault::new("overlap").segments(*segments).at(ends[0]),
        V::Crossing { segments, at } => Fault::new("crossing").segments(*segments).at(*at),
        _ => Fault::new("input"),
    }
}

fn fault_of_graph(error: &PslgError) -> Fault {
    match error {
        PslgError::TooClose { items, at, .. } => {
            let points = items.iter().filter_map(|item| match item {
                Feature::Point(i) => Some(*i),
                _ => None,
            });
            let segments = items.iter().filter_map(|item| match item {
                Feature::Segment(i) => Some(*i),
                _ => None,
            });
            let fault = Fault { least: error.repair_within(), ..Fault::new("too_close").at(*at) };
            let points: Vec<usize> = points.collect();
            if points.is_empty() { fault.segments(segments) } else { fault.points(points) }
        }
        PslgError::TooMany { at, .. } => {
            Fault { location: *at, least: error.repair_within(), ..Fault::new("too_many") }
        }
        PslgError::FlatHull { farthest, ends, .. } => {
            let points = [*farthest, ends[0], ends[1]].into_iter().filter_map(|item| match item {
                Feature::Point(i) => Some(i),
                _ => None,
            });
            Fault::new("flat_hull").points(points.collect::<Vec<_>>())
        }
        PslgError::NothingEnclosed { .. } => Fault::new("nothing_enclosed"),
        PslgError::BoundsBeyondMethod { .. } => Fault::new("bounds"),
        PslgError::InvalidArea { .. } => Fault::new("area"),
        PslgError::InvalidSize { at, .. } => Fault::new("size").at(*at),
        PslgError::NotRecovered { item: Feature::Segment(i), at } => {
            Fault::new("not_recovered").segments([*i]).at(*at)
        }
        PslgError::NotRecovered { at, .. } => Fault::new("not_recovered").at(*at),
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

/// Why a size is none.
pub(crate) fn of_size(py: Python<'_>, error: &SizeError) -> PyErr {
    fault_of_size(error).raise(py, &error.to_string(), None)
}

/// Why a session did not do what was asked.
pub(crate) fn of_session(py: Python<'_>, error: &SessionError) -> PyErr {
    use SessionError as S;
    let of = |id: hexdel::PointId| Fault::new("session").points([id.0 as usize]);
    let fault = match error {
        S::Mesh(error) => return of_mesh(py, error),
        S::Size(error) => return of_size(py, error),
        S::NotFinite { at } => Fault::new("not_finite").at(*at),
        S::Outside { at, .. } | S::NotCovered { at } | S::AtRim { at, .. } => Fault::new("outside").at(*at),
        S::NoRoom { at } => Fault::new("no_room").at(*at),
        S::SegmentEnd { id } => Fault { kind: "segment_end", ..of(*id) },
        S::UnknownPoint { id } => Fault { kind: "unknown_point", ..of(*id) },
        S::Duplicate { at, of: id } => Fault { kind: "duplicate", ..of(*id) }.at(*at),
        S::TooClose { at, least, .. } => Fault::new("too_close").at(*at).least(*least),
        S::NothingToUndo => Fault::new("nothing_to_undo"),
        S::InvalidDomain { centre, .. } => Fault::new("domain").at(*centre),
        S::NotForSessions { .. } | S::NoSegments | S::CannotSave => Fault::new("option"),
        S::Unreadable { .. } | S::State(_) | S::Points { .. } | S::NotCertified { .. } => Fault::new("file"),
        _ => Fault::new("session"),
    };
    fault.raise(py, &error.to_string(), None)
}

/// Why a file was not read.
pub(crate) fn of_reading(py: Python<'_>, error: &ReadError) -> PyErr {
    let kind = if matches!(error, ReadError::Missing { .. }) { "missing_file" } else { "file" };
    Fault { line: error.line(), ..Fault::new(kind) }.raise(py, &error.to_string(), None)
}

/// Why a file was not written.
pub(crate) fn of_writing(py: Python<'_>, error: &WriteError) -> PyErr {
    plain(py, "file", &error.to_string())
}

/// Something that does not happen.
pub(crate) fn impossible(what: &str) -> PyErr {
    PyRuntimeError::new_err(what.to_owned())
}
