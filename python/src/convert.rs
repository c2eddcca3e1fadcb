//! Arrays in and out.
//!
//! What comes in is copied once, so that meshing can go on without the GIL while
//! Python does with its arrays what it likes. What goes out is handed over: numpy
//! owns the memory that Rust has filled.

use glam::DVec2;
use hexdel::geom::{Region, VertexId};
use hexdel::{Pslg, TriMesh};
use numpy::{
    Element, IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2,
    PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Rows of two numbers as points.
pub(crate) fn points_in(array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<DVec2>> {
    Ok(rows_in::<f64, 2>(array)?.into_iter().map(DVec2::from).collect())
}

/// The rows of an array of `N` columns.
pub(crate) fn rows_in<T: Element + Copy, const N: usize>(
    array: &PyReadonlyArray2<'_, T>,
) -> PyResult<Vec<[T; N]>> {
    let shape = array.shape();
    if shape[1] != N {
        return Err(PyValueError::new_err(format!("expected rows of {N}, got {}", shape[1])));
    }
    let rows = array.as_array();
    Ok(rows.rows().into_iter().map(|row| std::array::from_fn(|i| row[i])).collect())
}

/// A mesh from its arrays. Indices are checked by whoever uses it.
pub(crate) fn mesh_in(
    vertices: &PyReadonlyArray2<'_, f64>,
    triangles: &PyReadonlyArray2<'_, u32>,
) -> PyResult<TriMesh> {
    let corners = rows_in::<u32, 3>(triangles)?;
    Ok(TriMesh {
        vertices: points_in(vertices)?,
        triangles: corners.into_iter().map(|t| t.map(|v| VertexId::new(v as usize))).collect(),
    })
}

/// A mesh whose indices are known to be in range.
pub(crate) fn sound_mesh_in(
    vertices: &PyReadonlyArray2<'_, f64>,
    triangles: &PyReadonlyArray2<'_, u32>,
) -> PyResult<TriMesh> {
    let mesh = mesh_in(vertices, triangles)?;
    let count = mesh.vertices.len();
    match mesh.triangles.iter().position(|t| t.iter().any(|v| v.index() >= count)) {
        None => Ok(mesh),
        Some(t) => Err(PyValueError::new_err(format!("triangle {t} has a corner that is not in the mesh"))),
    }
}

/// A PSLG as Python's side hands it over, every array there.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct GraphArrays<'py> {
    points: PyReadonlyArray2<'py, f64>,
    segments: PyReadonlyArray2<'py, u32>,
    holes: PyReadonlyArray2<'py, f64>,
    /// x, y, attribute, largest area or a number that is not positive.
    regions: PyReadonlyArray2<'py, f64>,
    point_markers: PyReadonlyArray1<'py, i32>,
    segment_markers: PyReadonlyArray1<'py, i32>,
    point_attributes: PyReadonlyArray2<'py, f64>,
}

impl GraphArrays<'_> {
    pub(crate) fn graph(&self) -> PyResult<Pslg> {
        let region = |[x, y, attribute, area]: [f64; 4]| Region {
            point: DVec2::new(x, y),
            attribute,
            max_area: (area > 0.0).then_some(area),
        };
        let attributes = self.point_attributes.as_array();
        Ok(Pslg {
            points: points_in(&self.points)?,
            segments: rows_in(&self.segments)?,
            holes: points_in(&self.holes)?,
            regions: rows_in::<f64, 4>(&self.regions)?.into_iter().map(region).collect(),
            point_markers: self.point_markers.as_array().to_vec(),
            segment_markers: self.segment_markers.as_array().to_vec(),
            attributes_per_point: attributes.ncols(),
            point_attributes: attributes.iter().copied().collect(),
            ..Pslg::default()
        })
    }
}

/// Points as an array of two columns, without a copy.
pub(crate) fn points_out(py: Python<'_>, points: Vec<DVec2>) -> PyResult<Bound<'_, PyArray2<f64>>> {
    let count = points.len();
    let flat: Vec<f64> = bytemuck::allocation::cast_vec(points);
    flat.into_pyarray(py).reshape([count, 2])
}

/// Rows of `N` numbers as an array, without a copy.
pub(crate) fn rows_out<const N: usize>(
    py: Python<'_>,
    rows: Vec<[i32; N]>,
) -> PyResult<Bound<'_, PyArray2<i32>>> {
    let count = rows.len();
    let flat: Vec<i32> = rows.into_flattened();
    flat.into_pyarray(py).reshape([count, N])
}

/// Triangles as rows of indices. The memory stays where it is.
pub(crate) fn triangles_out(
    py: Python<'_>,
    triangles: Vec<[VertexId; 3]>,
) -> PyResult<Bound<'_, PyArray2<i32>>> {
    rows_out(py, triangles.into_iter().map(|t| t.map(|v| v.index() as i32)).collect())
}

/// Indices that may be missing, as -1.
pub(crate) fn indices_out(
    py: Python<'_>,
    indices: impl Iterator<Item = Option<usize>>,
) -> Bound<'_, PyArray1<i32>> {
    let indices: Vec<i32> = indices.map(|i| i.map_or(-1, |i| i as i32)).collect();
    indices.into_pyarray(py)
}
