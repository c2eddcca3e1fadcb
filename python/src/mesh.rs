//! Meshes of points and of PSLGs.

use crate::convert::{GraphArrays, indices_out, points_in, points_out, rows_out, triangles_out};
use crate::errors;
use crate::options::{Made, Options};
use crate::watch::{Watch, run};
use hexdel::{Method, Pslg, PslgTriangulation, Start, Triangulation, VertexId};
use numpy::{IntoPyArray, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// Meshes points. The arrays of the mesh, and what is known about it.
#[pyfunction]
pub(crate) fn mesh_points<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    options: Options<'py>,
) -> PyResult<Bound<'py, PyDict>> {
    let points = points_in(&points)?;
    let watch = Arc::new(Watch::default());
    let mesher = options.mesher(py, &points, Made::OfPoints, &watch)?;
    let monitor = watch.clone();
    let made = run(py, options.threads, &watch, options.progress.as_ref(), move || {
        mesher.triangulate_watched(&points, &*monitor)
    })?;
    made_of_points(py, made.map_err(|error| errors::of_mesh(py, &error))?)
}

fn made_of_points(py: Python<'_>, made: Triangulation) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    // Not by `Triangulation::input_of_vertex`: this is a large part of what a call adds.
    let mut inputs = vec![-1; made.mesh.vertices.len()];
    for (input, vertex) in made.vertex_of_input.iter().enumerate().rev() {
        inputs[vertex.index()] = input as i32;
    }
    dict.set_item("input_of_vertex", inputs.into_pyarray(py))?;
    let vertices = made.vertex_of_input.iter().map(|v| Some(v.index()));
    dict.set_item("vertex_of_input", indices_out(py, vertices))?;
    dict.set_item("certificate", json(&made.certificate)?)?;
    let method = match made.method {
        Method::Templates => "templates",
        Method::Simple => "simple",
        _ => "compact",
    };
    dict.set_item("method", method)?;
    let start = match made.start {
        Start::Templates => "templates",
        Start::Simple => "simple",
        Start::Coarse => "coarse",
        Start::Grown => "grown",
        _ => "other",
    };
    dict.set_item("start", start)?;
    dict.set_item("domain", "hexagon")?;
    dict.set_item("holds", made.certificate.holds())?;
    dict.set_item("size_ratio", made.size_ratio)?;
    dict.set_item("dual_edges", json(&made.dual_edges)?)?;
    dict.set_item("budget_spent", made.budget_spent)?;
    dict.set_item("seconds", json(&made.seconds)?)?;
    dict.set_item("vertices", points_out(py, made.mesh.vertices)?)?;
    dict.set_item("triangles", triangles_out(py, made.mesh.triangles)?)?;
    Ok(dict)
}

/// Meshes a PSLG. The arrays of the mesh, and what is known about it.
#[pyfunction]
pub(crate) fn mesh_graph<'py>(
    py: Python<'py>,
    graph: GraphArrays<'py>,
    options: Options<'py>,
) -> PyResult<Bound<'py, PyDict>> {
    mesh_of_graph(py, graph.graph()?, &options)
}

/// Meshes the PSLG in a text of a format, by the format's name: what arrays have no
/// place for stays.
#[pyfunction]
pub(crate) fn mesh_text<'py>(
    py: Python<'py>,
    text: &str,
    format: &str,
    name: &str,
    options: Options<'py>,
) -> PyResult<Bound<'py, PyDict>> {
    mesh_of_graph(py, crate::files::parsed(py, text, format, name)?, &options)
}

fn mesh_of_graph<'py>(py: Python<'py>, graph: Pslg, options: &Options<'_>) -> PyResult<Bound<'py, PyDict>> {
    let watch = Arc::new(Watch::default());
    let mesher = options.mesher(py, &graph.points, Made::OfGraph, &watch)?;
    let monitor = watch.clone();
    let columns = graph.attributes_per_point;
    let made = run(py, options.threads, &watch, options.progress.as_ref(), move || {
        let made = mesher.triangulate_pslg_watched(&graph, &*monitor)?;
        let attributes = made.vertex_attributes(&graph);
        Ok::<_, hexdel::Error>((made, attributes))
    })?;
    let (made, attributes) = made.map_err(|error| errors::of_mesh(py, &error))?;
    let dict = made_of_graph(py, made)?;
    if let Some(count) = attributes.len().checked_div(columns) {
        dict.set_item("vertex_attributes", attributes.into_pyarray(py).reshape([count, columns])?)?;
    }
    Ok(dict)
}

fn made_of_graph(py: Python<'_>, made: PslgTriangulation) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    let inputs = made.input_of_vertex();
    dict.set_item("input_of_vertex", indices_out(py, inputs.iter().map(|i| i.map(|i| i as usize))))?;
    let vertices = made.vertex_of_input();
    dict.set_item("vertex_of_input", indices_out(py, vertices.iter().map(|v| v.map(VertexId::index))))?;
    set_edges(&dict, &made.edges)?;
    dict.set_item("vertex_markers", made.vertex_markers.clone().into_pyarray(py))?;
    let regions = made.region_of_triangle.iter().map(|r| r.map(|r| r as usize));
    dict.set_item("region_of_triangle", indices_out(py, regions))?;
    if !made.graph.regions.is_empty() {
        dict.set_item("regions", made.region_attributes().into_pyarray(py))?;
    }
    let exceptions = |list: &[hexdel::pslg::Exception]| {
        let entries: Vec<_> = list.iter().map(|e| hexdel::ExceptionEntry::new(e, &made.graph)).collect();
        let texts: Vec<String> = entries.iter().map(ToString::to_string).collect();
        json(&entries).map(|entries| (entries, texts))
    };
    dict.set_item("exempt", exceptions(&made.exempt)?)?;
    dict.set_item("failed", exceptions(&made.failed)?)?;
    let repairs = made.repairs.iter().flat_map(|report| &report.repairs).map(hexdel::RepairEntry::new);
    let repairs: Vec<_> = repairs.collect();
    let texts: Vec<String> = repairs.iter().map(ToString::to_string).collect();
    dict.set_item("repairs", (json(&repairs)?, texts))?;
    let warnings: Vec<String> = made.warnings.iter().map(ToString::to_string).collect();
    dict.set_item("warnings", warnings)?;
    dict.set_item("certificate", json(&made.certificate)?)?;
    dict.set_item("edges_of_segment", made.edges_of_segment.clone().into_pyarray(py))?;
    dict.set_item("segments_missing", made.segments.missing.len())?;
    dict.set_item("domain", made.domain.name())?;
    dict.set_item("method", "compact")?;
    dict.set_item("holds", made.holds())?;
    dict.set_item("size_ratio", made.size_ratio)?;
    dict.set_item("dual_edges", json(&made.dual_edges)?)?;
    dict.set_item("budget_spent", made.budget_spent)?;
    dict.set_item("seconds", json(&made.seconds)?)?;
    dict.set_item("vertices", points_out(py, made.mesh.vertices)?)?;
    dict.set_item("triangles", triangles_out(py, made.mesh.triangles)?)?;
    Ok(dict)
}

/// The edges on segments and the boundary.
pub(crate) fn set_edges(dict: &Bound<'_, PyDict>, edges: &[hexdel::pslg::SegmentEdge]) -> PyResult<()> {
    let py = dict.py();
    let ends = edges.iter().map(|e| e.ends.map(|v| v.index() as i32)).collect();
    dict.set_item("segment_edges", rows_out(py, ends)?)?;
    let segments = edges.iter().map(|e| e.segment.map(|s| s as usize));
    dict.set_item("segment_of_edge", indices_out(py, segments))?;
    let markers: Vec<i32> = edges.iter().map(|e| e.marker).collect();
    dict.set_item("segment_edge_markers", markers.into_pyarray(py))
}

/// What serde makes of something, as text.
pub(crate) fn json(value: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(value).map_err(|error| errors::impossible(&error.to_string()))
}
