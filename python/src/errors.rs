//! Errors of the library as exceptions: which class they become, with what kind, item,
//! index and place, is said here; the text with the way out is made by
//! `hexdel/_errors.py`.

use glam::DVec2;
use hexdel::io::{ReadError, WriteError};
use hexdel::{Error, Fault, SessionError, SizeError, TriMesh};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::any::Any;

/// The exception of a fault, with the message and, if the work led to one, the mesh.
fn raise(py: Python<'_>, fault: Fault, message: &str, mesh: Option<&TriMesh>) -> PyErr {
    let made = || -> PyResult<PyErr> {
        let details = PyDict::new(py);
        details.set_item("kind", fault.kind)?;
        details.set_item("message", message)?;
        details.set_item("item", fault.item)?;
        details.set_item("index", fault.index)?;
        details.set_item("location", fault.location.map(|p| (p.x, p.y)))?;
        details.set_item("least", fault.least)?;
        details.set_item("file", None::<String>)?;
        details.set_item("line", fault.line)?;
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

/// A failure that only the kind and a message tell of.
pub(crate) fn plain(py: Python<'_>, kind: &'static str, message: &str) -> PyErr {
    raise(py, Fault::new(kind), message, None)
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
    raise(py, Fault::new("callable").at(at), &message, None)
}

/// Why points or a PSLG were not meshed.
pub(crate) fn of_mesh(py: Python<'_>, error: &Error) -> PyErr {
    let mesh = match error {
        Error::Unreached { mesh, .. } | Error::NotCertified { mesh, .. } | Error::DualEdges { mesh, .. } => {
            Some(&**mesh)
        }
        _ => None,
    };
    raise(py, error.fault(), &error.to_string(), mesh)
}

/// Why a size is none.
pub(crate) fn of_size(py: Python<'_>, error: &SizeError) -> PyErr {
    raise(py, error.fault(), &error.to_string(), None)
}

/// Why a session did not do what was asked.
pub(crate) fn of_session(py: Python<'_>, error: &SessionError) -> PyErr {
    match error {
        SessionError::Mesh(error) => of_mesh(py, error),
        _ => raise(py, error.fault(), &error.to_string(), None),
    }
}

/// Why a file was not read.
pub(crate) fn of_reading(py: Python<'_>, error: &ReadError) -> PyErr {
    raise(py, Fault::of_reading(error), &error.to_string(), None)
}

/// Why a file was not written.
pub(crate) fn of_writing(py: Python<'_>, error: &WriteError) -> PyErr {
    plain(py, "file", &error.to_string())
}

/// Something that does not happen.
pub(crate) fn impossible(what: &str) -> PyErr {
    PyRuntimeError::new_err(what.to_owned())
}
