//! Checks and duals of meshes, whoever made them.

use crate::convert::{indices_out, mesh_in, points_in, points_out, rows_in, rows_out};
use crate::errors;
use crate::mesh::json;
use crate::watch::{Watch, run};
use glam::DVec2;
use hexdel::geom::{CertifyOptions, SegmentCheck, Voronoi, VoronoiEdge, certify, check_segments};
use hexdel::{AngleBounds, TriangleId};
use numpy::{IntoPyArray, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The certificate of a mesh as text, whether it holds, the segments that are no edges.
#[pyfunction]
#[pyo3(signature = (vertices, triangles, *, points, segments, bounds, min_edge, delaunay, disk, violations, threads))]
#[expect(clippy::too_many_arguments, reason = "they are keywords, one for each demand")]
pub(crate) fn check(
    py: Python<'_>,
    vertices: PyReadonlyArray2<'_, f64>,
    triangles: PyReadonlyArray2<'_, u32>,
    points: Option<PyReadonlyArray2<'_, f64>>,
    segments: PyReadonlyArray2<'_, u32>,
    bounds: (f64, f64),
    min_edge: Option<f64>,
    delaunay: bool,
    disk: bool,
    violations: usize,
    threads: Option<usize>,
) -> PyResult<(String, bool, Vec<usize>)> {
    let mesh = mesh_in(&vertices, &triangles)?;
    let points = points.map(|points| points_in(&points)).transpose()?;
    let segments = rows_in::<u32, 2>(&segments)?;
    let bounds = AngleBounds::new(bounds.0, bounds.1)
        .map_err(|error| errors::plain(py, "bounds", &error.to_string()))?;
    let found = run(py, threads, &Watch::default(), None, move || {
        let options = CertifyOptions {
            bounds,
            inputs: points.as_deref(),
            min_edge,
            require_delaunay: delaunay,
            require_disk: disk,
            max_violations: violations,
        };
        let segments = points
            .as_deref()
            .filter(|_| !segments.is_empty())
            .map_or_else(SegmentCheck::default, |points| check_segments(&mesh, points, &segments));
        (certify(&mesh, &options), segments)
    })?;
    let (certificate, segments) = found;
    let missing: Vec<usize> = segments.missing.iter().map(|missing| missing.segment).collect();
    Ok((json(&certificate)?, certificate.holds() && missing.is_empty(), missing))
}

/// The Voronoi dual of a mesh: its arrays.
#[pyfunction]
pub(crate) fn dual<'py>(
    py: Python<'py>,
    vertices: PyReadonlyArray2<'_, f64>,
    triangles: PyReadonlyArray2<'_, u32>,
    threads: Option<usize>,
) -> PyResult<Bound<'py, PyDict>> {
    let mesh = mesh_in(&vertices, &triangles)?;
    let found = run(py, threads, &Watch::default(), None, move || {
        let dual = Voronoi::new(&mesh)?;
        let mut offsets: Vec<i64> = vec![0];
        let mut corners: Vec<DVec2> = Vec::new();
        for v in 0..mesh.vertices.len() {
            corners.extend(dual.cell(hexdel::VertexId::new(v)));
            offsets.push(corners.len() as i64);
        }
        let summary = dual.summary();
        Ok::<_, hexdel::geom::VoronoiError>((
            dual.circumcentres,
            dual.edges,
            dual.areas,
            offsets,
            corners,
            summary,
        ))
    })?;
    let (centres, edges, areas, offsets, corners, summary) =
        found.map_err(|error| errors::plain(py, "dual", &error.to_string()))?;
    let dict = PyDict::new(py);
    dict.set_item("edges", rows_out(py, edges.iter().map(|e| e.ends.map(|v| v.index() as i32)).collect())?)?;
    let side = |i: usize| edges.iter().map(move |e| e.triangles[i].map(TriangleId::index));
    dict.set_item("edge_triangles", (indices_out(py, side(0)), indices_out(py, side(1))))?;
    let numbers = |of: fn(&VoronoiEdge) -> f64| edges.iter().map(of).collect::<Vec<f64>>().into_pyarray(py);
    dict.set_item("lengths", numbers(|e| e.length))?;
    dict.set_item("weights", numbers(|e| e.weight))?;
    dict.set_item("dual_lengths", numbers(VoronoiEdge::dual_length))?;
    dict.set_item("circumcenters", points_out(py, centres)?)?;
    dict.set_item("areas", areas.into_pyarray(py))?;
    dict.set_item("cell_offsets", offsets.into_pyarray(py))?;
    dict.set_item("cell_corners", points_out(py, corners)?)?;
    dict.set_item("summary", json(&summary)?)?;
    Ok(dict)
}
