//! A mesh that points are put into and taken out of.

use crate::convert::{GraphArrays, indices_out, points_in, points_out, triangles_out};
use crate::errors;
use crate::mesh::{json, set_edges};
use crate::options::{Made, Options};
use crate::watch::{Watch, run};
use glam::DVec2;
use hexdel::{AnySession, Method, Outcome, PointId, SessionError, Size};
use numpy::{IntoPyArray, PyArray1, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Arc, Mutex, PoisonError};

/// A session and how it works.
#[pyclass(frozen, module = "hexdel._hexdel")]
pub(crate) struct RawSession {
    session: Arc<Mutex<AnySession>>,
    threads: Option<usize>,
    /// Told by functions of sizes that failed, and asked by them whether to go on.
    watch: Arc<Watch>,
}

#[pymethods]
impl RawSession {
    /// The mesh of points or a PSLG as a session.
    #[staticmethod]
    fn of_graph(py: Python<'_>, graph: GraphArrays<'_>, options: Options<'_>) -> PyResult<Self> {
        let graph = graph.graph()?;
        let watch = Arc::new(Watch::default());
        let kind = if graph.segments.is_empty() { Made::InSession } else { Made::OfGraph };
        let mesher = options.mesher(py, &graph.points, kind, &watch)?;
        let made = run(py, options.threads, &watch, None, move || AnySession::new(&graph, &mesher))?;
        Self::of(py, made, options.threads, watch)
    }

    /// Points in a domain that grows by itself, and the whole mesh as new.
    #[staticmethod]
    fn begin<'py>(
        py: Python<'py>,
        points: PyReadonlyArray2<'_, f64>,
        options: Options<'_>,
    ) -> PyResult<(Self, Bound<'py, PyDict>)> {
        let points = points_in(&points)?;
        let watch = Arc::new(Watch::default());
        let mesher = options.mesher(py, &points, Made::InSession, &watch)?;
        let begun = run(py, options.threads, &watch, None, move || AnySession::begin(&points, &mesher))?;
        let (made, outcome) = begun.map_err(|error| errors::of_session(py, &error))?;
        Ok((Self::of(py, Ok(made), options.threads, watch)?, outcome_out(py, outcome)?))
    }

    /// A hexagonal domain without points.
    #[staticmethod]
    fn empty(py: Python<'_>, centre: (f64, f64), radius: f64, options: Options<'_>) -> PyResult<Self> {
        let watch = Arc::new(Watch::default());
        let (centre, method) = (DVec2::from(centre), options.method());
        let corners = [centre - radius, centre + radius];
        let size = options.size(py, &corners, Made::InSession, &watch)?;
        let made = run(py, options.threads, &watch, None, move || {
            let mut session = AnySession::empty(centre, radius, method)?;
            if size.is_some() {
                session.set_size(size)?;
            }
            Ok::<_, SessionError>(session)
        })?;
        Self::of(py, made, options.threads, watch)
    }

    /// A saved session.
    #[staticmethod]
    fn of_text(py: Python<'_>, text: String, threads: Option<usize>) -> PyResult<Self> {
        let watch = Arc::new(Watch::default());
        let made = run(py, threads, &watch, None, move || AnySession::from_ron(&text))?;
        Self::of(py, made, threads, watch)
    }

    /// The session as text.
    fn text(&self, py: Python<'_>) -> PyResult<String> {
        self.ask(py, AnySession::to_ron)?.map_err(|error| errors::of_session(py, &error))
    }

    fn insert<'py>(
        &self,
        py: Python<'py>,
        points: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let points = points_in(&points)?;
        self.change(py, move |session| session.insert_all(&points))
    }

    fn remove<'py>(&self, py: Python<'py>, ids: PyReadonlyArray1<'_, u64>) -> PyResult<Bound<'py, PyDict>> {
        let ids: Vec<PointId> = ids.as_array().iter().map(|&id| PointId(id)).collect();
        self.change(py, move |session| session.remove(&ids))
    }

    fn set_size<'py>(&self, py: Python<'py>, options: Options<'_>) -> PyResult<Bound<'py, PyDict>> {
        let (centre, radius) = self.ask(py, AnySession::domain)?;
        let corners = [centre - radius, centre + radius];
        let size: Option<Size> = options.size(py, &corners, Made::InSession, &self.watch)?;
        self.change(py, move |session| session.set_size(size))
    }

    fn refine_box<'py>(
        &self,
        py: Python<'py>,
        low: (f64, f64),
        high: (f64, f64),
        halvings: u8,
    ) -> PyResult<Bound<'py, PyDict>> {
        self.change(py, move |session| session.refine_box(low.into(), high.into(), halvings))
    }

    fn grow<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.change(py, AnySession::grow)
    }

    fn renew<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.change(py, AnySession::renew)
    }

    fn undo<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.change(py, AnySession::undo)
    }

    /// What of a PSLG has no effect or was mended, in words.
    fn warnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.ask(py, |session| session.warnings().iter().map(ToString::to_string).collect())
    }

    /// Numbers of points, vertices and triangles.
    fn counts(&self, py: Python<'_>) -> PyResult<[usize; 3]> {
        self.ask(py, AnySession::counts)
    }

    /// Centre and radius of the domain.
    fn domain(&self, py: Python<'_>) -> PyResult<(f64, f64, f64)> {
        let (centre, radius) = self.ask(py, AnySession::domain)?;
        Ok((centre.x, centre.y, radius))
    }

    /// The points that are there: their numbers and places.
    fn points<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let points = self.ask(py, AnySession::points)?;
        let (ids, places): (Vec<i64>, Vec<DVec2>) =
            points.into_iter().map(|(id, p)| (id.0 as i64, p)).unzip();
        Ok((ids.into_pyarray(py).into_any(), points_out(py, places)?.into_any()))
    }

    /// The mesh as it stands: its arrays.
    fn mesh<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (made, check, regions) = self.ask(py, |session| {
            let made = session.mesh();
            let regions = session.region_attributes(&made);
            (made, session.check(), regions)
        })?;
        let dict = PyDict::new(py);
        let mut inputs = vec![None; made.mesh.vertices.len()];
        let last = made.points.last().map_or(0, |(id, _)| id.0 as usize + 1);
        let mut vertices = vec![None; last];
        for (id, v) in &made.points {
            inputs[v.index()] = Some(id.0 as usize);
            vertices[id.0 as usize] = Some(v.index());
        }
        dict.set_item("input_of_vertex", indices_out(py, inputs.into_iter()))?;
        dict.set_item("vertex_of_input", indices_out(py, vertices.into_iter()))?;
        if !made.vertex_markers.is_empty() {
            set_edges(&dict, &made.edges)?;
            dict.set_item("vertex_markers", made.vertex_markers.into_pyarray(py))?;
            let region = made.region_of_triangle.iter().map(|r| r.map(|r| r as usize));
            dict.set_item("region_of_triangle", indices_out(py, region))?;
            dict.set_item("regions", regions.into_pyarray(py))?;
        }
        dict.set_item("certificate", json(&check.certificate)?)?;
        dict.set_item("holds", check.holds())?;
        dict.set_item("vertex_serials", serials(py, &made.vertex_serials))?;
        dict.set_item("triangle_serials", serials(py, &made.triangle_serials))?;
        dict.set_item("vertices", points_out(py, made.mesh.vertices)?)?;
        dict.set_item("triangles", triangles_out(py, made.mesh.triangles)?)?;
        Ok(dict)
    }

    /// A copy that goes its own way.
    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let session = self.ask(py, AnySession::clone)?;
        // Functions of sizes keep the watch that they have.
        Ok(Self { session: Arc::new(Mutex::new(session)), threads: self.threads, watch: self.watch.clone() })
    }

    /// Whether the method is that of templates.
    fn method(&self, py: Python<'_>) -> PyResult<&'static str> {
        self.ask(py, |session| match session {
            AnySession::Templates(_) => Method::Templates,
            _ => Method::Compact,
        })
        .map(|method| if method == Method::Templates { "templates" } else { "compact" })
    }
}

impl RawSession {
    fn of(
        py: Python<'_>,
        made: Result<AnySession, SessionError>,
        threads: Option<usize>,
        watch: Arc<Watch>,
    ) -> PyResult<Self> {
        let session = made.map_err(|error| errors::of_session(py, &error))?;
        Ok(Self { session: Arc::new(Mutex::new(session)), threads, watch })
    }

    /// Asks the session without the GIL.
    fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&AnySession) -> T + Send + 'static,
    ) -> PyResult<T> {
        let session = self.session.clone();
        run(py, self.threads, &Watch::default(), None, move || {
            question(&session.lock().unwrap_or_else(PoisonError::into_inner))
        })
    }

    /// Changes the session without the GIL. A call that a signal or a function of sizes
    /// interrupts is taken back; until that is done, the next one waits.
    fn change<'py>(
        &self,
        py: Python<'py>,
        call: impl FnOnce(&mut AnySession) -> Result<Outcome, SessionError> + Send + 'static,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (session, watch, stop) = (self.session.clone(), self.watch.clone(), Arc::new(Watch::default()));
        let stopped = stop.clone();
        let changed = run(py, self.threads, &stop, None, move || {
            let mut session = session.lock().unwrap_or_else(PoisonError::into_inner);
            // Functions of sizes fail through the watch that they were made with.
            watch.reset();
            let outcome = call(&mut session);
            let failure = watch.failure();
            watch.reset();
            if outcome.is_ok() && (failure.is_some() || stopped.is_stopped()) {
                // There is something to undo: the call that has just succeeded.
                let _ = session.undo();
            }
            failure.map_or(Ok(outcome), Err)
        })?;
        outcome_out(py, changed?.map_err(|error| errors::of_session(py, &error))?)
    }
}

fn serials<'py>(py: Python<'py>, serials: &[u64]) -> Bound<'py, PyArray1<i64>> {
    serials.iter().map(|&s| s as i64).collect::<Vec<i64>>().into_pyarray(py)
}

fn outcome_out(
    py: Python<'_>,
    Outcome { points, delta, remeshed, domain, .. }: Outcome,
) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    let ids: Vec<u64> = points.iter().map(|id| id.0).collect();
    dict.set_item("points", serials(py, &ids))?;
    dict.set_item("remeshed", remeshed)?;
    dict.set_item("domain", domain.map(|(centre, radius)| ((centre.x, centre.y), radius)))?;
    dict.set_item("vertices_removed", serials(py, &delta.vertices_removed))?;
    dict.set_item("triangles_removed", serials(py, &delta.triangles_removed))?;
    for (name, moved) in
        [("vertices_added", &delta.vertices_added), ("vertices_moved", &delta.vertices_moved)]
    {
        let (ids, places): (Vec<u64>, Vec<DVec2>) = moved.iter().copied().unzip();
        dict.set_item(name, (serials(py, &ids), points_out(py, places)?))?;
    }
    let (ids, corners): (Vec<u64>, Vec<[u64; 3]>) = delta.triangles_added.iter().copied().unzip();
    let count = corners.len();
    let corners = serials(py, &corners.into_flattened()).reshape([count, 3])?;
    dict.set_item("triangles_added", (serials(py, &ids), corners))?;
    Ok(dict)
}
