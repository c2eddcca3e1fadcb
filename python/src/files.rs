//! Files, pictures, test points.

use crate::convert::{GraphArrays, indices_out, points_out, rows_out, sound_mesh_in, triangles_out};
use crate::errors;
use crate::watch::{Watch, run};
use hexdel::geom::VertexId;
use hexdel::io::{self, MarkedEdge, MeshData, MeshFormat, PointFormat};
use hexdel::plot::Picture;
use hexdel::{DVec2, Pslg, generate};
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use std::io::Cursor;
use std::path::PathBuf;

/// Does what knows no monitor on another thread, so that other threads of Python go on.
fn aside<T: Send + 'static>(py: Python<'_>, work: impl FnOnce() -> T + Send + 'static) -> PyResult<T> {
    run(py, None, &Watch::default(), None, work)
}

/// Whether the extension of a file is that of meshes that are read, of PSLGs that are
/// read. `.poly`, `.json`, `.ron`, `.2dm` and `.14` may be either.
#[pyfunction]
pub(crate) fn formats(path: PathBuf) -> (bool, bool) {
    let mesh = MeshFormat::from_path(&path).is_some_and(MeshFormat::is_read);
    (mesh, PointFormat::from_path(&path).is_some())
}

/// Whether a file of a format that may hold either holds a mesh.
#[pyfunction]
pub(crate) fn holds_mesh(path: PathBuf) -> PyResult<bool> {
    let Some(format) = MeshFormat::from_path(&path) else { return Ok(false) };
    Ok(io::holds_mesh(&std::fs::read(&path)?, format))
}

/// Reads a mesh: its arrays.
#[pyfunction]
pub(crate) fn read_mesh(py: Python<'_>, path: PathBuf) -> PyResult<Bound<'_, PyDict>> {
    let read = aside(py, move || io::read_mesh_data(&path))?;
    let MeshData { mesh, input_indices, vertex_markers, heights, regions, marked_edges, .. } =
        read.map_err(|error| errors::of_reading(py, &error))?;
    let dict = PyDict::new(py);
    dict.set_item("vertices", points_out(py, mesh.vertices)?)?;
    dict.set_item("triangles", triangles_out(py, mesh.triangles)?)?;
    let inputs = input_indices.map(|i| indices_out(py, i.into_iter().map(|i| i.map(|i| i as usize))));
    dict.set_item("input_of_vertex", inputs)?;
    dict.set_item("vertex_markers", vertex_markers.map(|m| m.into_pyarray(py)))?;
    dict.set_item("heights", heights.map(|z| z.into_pyarray(py)))?;
    dict.set_item("regions", regions.map(|r| r.into_pyarray(py)))?;
    if let Some(edges) = marked_edges {
        let ends = edges.iter().map(|e| e.ends.map(|v| v.index() as i32)).collect();
        dict.set_item("segment_edges", rows_out(py, ends)?)?;
        let markers: Vec<i32> = edges.iter().map(|e| e.marker).collect();
        dict.set_item("segment_edge_markers", markers.into_pyarray(py))?;
    }
    Ok(dict)
}

/// Reads points or a PSLG: its arrays, with holes and regions in place of polygons.
/// Columns of tables go by name or number.
#[pyfunction]
pub(crate) fn read_graph(
    py: Python<'_>,
    path: PathBuf,
    columns: Option<String>,
) -> PyResult<Bound<'_, PyDict>> {
    let columns: Option<io::Columns> = columns
        .map(|text| {
            text.parse().map_err(|error: io::ColumnsError| errors::plain(py, "option", &error.to_string()))
        })
        .transpose()?;
    let read = aside(py, move || io::PointReader::new().columns(columns).read(&path))?;
    let file = read.map_err(|error| errors::of_reading(py, &error))?;
    let mut warnings: Vec<String> = file.warnings.iter().map(ToString::to_string).collect();
    let mut graph = file.pslg;
    if !graph.polygons.is_empty() {
        let prepared = aside(py, move || hexdel::Mesher::new().prepared_pslg(&graph))?;
        let prepared = prepared.map_err(|error| errors::of_mesh(py, &error))?;
        warnings.extend(prepared.warnings.iter().map(ToString::to_string));
        graph = prepared.graph;
    }
    let dict = graph_out(py, graph)?;
    dict.set_item("warnings", warnings)?;
    dict.set_item("columns", file.columns.map(|columns| columns.to_string()))?;
    Ok(dict)
}

/// The PSLG in a text of a format, by the format's name.
pub(crate) fn parsed(py: Python<'_>, text: &str, format: &str, name: &str) -> PyResult<Pslg> {
    let format = PointFormat::from_name(format)
        .ok_or_else(|| errors::plain(py, "file", &format!("there is no format {format:?}")))?;
    let read = py.detach(|| io::read_points_from(Cursor::new(text.as_bytes()), format, name));
    read.map_err(|error| errors::of_reading(py, &error))
}

fn graph_out(py: Python<'_>, graph: Pslg) -> PyResult<Bound<'_, PyDict>> {
    let dict = PyDict::new(py);
    let segments = graph.segments.iter().map(|s| s.map(|i| i as i32)).collect();
    dict.set_item("segments", rows_out(py, segments)?)?;
    let regions: Vec<f64> = graph
        .regions
        .iter()
        .flat_map(|r| [r.point.x, r.point.y, r.attribute, r.max_area.unwrap_or(-1.0)])
        .collect();
    dict.set_item("regions", regions.into_pyarray(py).reshape([graph.regions.len(), 4])?)?;
    let columns = graph.attributes_per_point;
    let attributes: Bound<'_, PyArray1<f64>> = graph.point_attributes.into_pyarray(py);
    dict.set_item("point_attributes", attributes.reshape([graph.points.len(), columns])?)?;
    dict.set_item("points", points_out(py, graph.points)?)?;
    dict.set_item("holes", points_out(py, graph.holes)?)?;
    dict.set_item("point_markers", graph.point_markers.into_pyarray(py))?;
    dict.set_item("segment_markers", graph.segment_markers.into_pyarray(py))?;
    Ok(dict)
}

/// A mesh to be written, every array that is known.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct MeshArrays<'py> {
    vertices: PyReadonlyArray2<'py, f64>,
    triangles: PyReadonlyArray2<'py, u32>,
    input_of_vertex: Option<PyReadonlyArray1<'py, i32>>,
    vertex_markers: Option<PyReadonlyArray1<'py, i32>>,
    heights: Option<PyReadonlyArray1<'py, f64>>,
    regions: Option<PyReadonlyArray1<'py, f64>>,
    segment_edges: Option<PyReadonlyArray2<'py, u32>>,
    segment_edge_markers: Option<PyReadonlyArray1<'py, i32>>,
}

impl MeshArrays<'_> {
    fn data(&self) -> PyResult<MeshData> {
        let mut data = MeshData::new(sound_mesh_in(&self.vertices, &self.triangles)?);
        let index = |i: &i32| u32::try_from(*i).ok();
        data.input_indices = self.input_of_vertex.as_ref().map(|a| a.as_array().iter().map(index).collect());
        data.vertex_markers = self.vertex_markers.as_ref().map(|a| a.as_array().to_vec());
        data.heights = self.heights.as_ref().map(|a| a.as_array().to_vec());
        data.regions = self.regions.as_ref().map(|a| a.as_array().to_vec());
        if let (Some(edges), Some(markers)) = (&self.segment_edges, &self.segment_edge_markers) {
            let ends = crate::convert::rows_in::<u32, 2>(edges)?;
            let ends = ends.into_iter().map(|e| e.map(|v| VertexId::new(v as usize)));
            let edge = |(ends, marker): ([VertexId; 2], &i32)| MarkedEdge { ends, marker: *marker };
            data.marked_edges = Some(ends.zip(markers.as_array().iter()).map(edge).collect());
        }
        Ok(data)
    }
}

/// Writes a mesh in the format of the file's extension. What the format has no place
/// for, in words.
#[pyfunction]
pub(crate) fn write_mesh(
    py: Python<'_>,
    path: PathBuf,
    mesh: MeshArrays<'_>,
    second_order: bool,
    epsg: Option<u16>,
) -> PyResult<Vec<&'static str>> {
    let data = mesh.data()?;
    let written = aside(py, move || {
        let mut view = data.view().with_second_order(second_order);
        view.epsg = epsg;
        let lost = MeshFormat::from_path(&path).map(|format| view.lost_in(format)).unwrap_or_default();
        io::write_mesh(&path, &view).map(|()| lost)
    })?;
    written.map_err(|error| errors::of_writing(py, &error))
}

/// Writes points or a PSLG in the format of the file's extension. What the format has
/// no place for, in words.
#[pyfunction]
pub(crate) fn write_graph(
    py: Python<'_>,
    path: PathBuf,
    graph: GraphArrays<'_>,
) -> PyResult<Vec<&'static str>> {
    let graph = graph.graph()?;
    let written = aside(py, move || {
        let lost = PointFormat::from_path(&path).map(|format| format.lost(&graph)).unwrap_or_default();
        io::write_points(&path, &graph).map(|()| lost)
    })?;
    written.map_err(|error| errors::of_writing(py, &error))
}

/// Writes the Voronoi dual of a mesh in the format of the file's extension.
#[pyfunction]
pub(crate) fn write_dual(
    py: Python<'_>,
    path: PathBuf,
    vertices: PyReadonlyArray2<'_, f64>,
    triangles: PyReadonlyArray2<'_, u32>,
) -> PyResult<()> {
    let mesh = sound_mesh_in(&vertices, &triangles)?;
    let written = aside(py, move || {
        let dual = hexdel::geom::Voronoi::new(&mesh)?;
        Ok::<_, hexdel::geom::VoronoiError>(io::write_dual(&path, &io::MeshView::new(&mesh), &dual))
    })?;
    let written = written.map_err(|error| errors::plain(py, "dual", &error.to_string()))?;
    written.map_err(|error| errors::of_writing(py, &error))
}

/// A picture of a mesh, SVG or PNG.
#[pyfunction]
pub(crate) fn picture<'py>(
    py: Python<'py>,
    mesh: MeshArrays<'_>,
    format: &str,
    pixels: f64,
    bounds: (f64, f64),
) -> PyResult<Bound<'py, PyBytes>> {
    let data = mesh.data()?;
    let format = if format == "png" { MeshFormat::Png } else { MeshFormat::Svg };
    let mut picture = Picture::default();
    picture.size_px = pixels;
    picture.bounds_deg = [bounds.0, bounds.1];
    let written = aside(py, move || {
        let mut bytes = Vec::new();
        let view = data.view().with_picture(picture);
        io::write_mesh_to(&mut bytes, format, &view, "the picture").map(|()| bytes)
    })?;
    let bytes = written.map_err(|error| errors::of_writing(py, &error))?;
    Ok(PyBytes::new(py, &bytes))
}

/// Test points of a kind.
#[pyfunction]
pub(crate) fn generate_points<'py>(
    py: Python<'py>,
    kind: &str,
    count: usize,
    seed: u64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let kind: generate::Kind = kind
        .parse()
        .map_err(|error: generate::UnknownKind| errors::plain(py, "option", &error.to_string()))?;
    let points: Vec<DVec2> = aside(py, move || generate::generate(kind, count, seed))?;
    points_out(py, points)
}
