//! What is read: a mesh and the data that goes with it, all owned.

use hexdel_geom::{DVec2, MarkedEdge, TriMesh, VertexId};
use serde::Deserialize;

use crate::error::ReadError;
use crate::promised::Promised;
use crate::view::MeshView;

/// A mesh that was read, with what its file knows about it.
///
/// What a format does not carry, or a file does not have, is `None`; each array has
/// one entry per vertex or triangle. See [`MeshView`] for what they mean.
///
/// # Examples
///
/// ```
/// use hexdel_io::{MeshFormat, read_mesh_from, write_mesh_to};
///
/// let off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
/// let data = read_mesh_from(off.as_bytes(), MeshFormat::Off, "a.off")?;
/// assert_eq!(data.mesh.vertices.len(), 3);
/// let mut obj = Vec::new();
/// write_mesh_to(&mut obj, MeshFormat::Obj, &data.view(), "a.obj")?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct MeshData {
    /// The mesh.
    pub mesh: TriMesh,
    /// For each vertex the index of the input point it is.
    pub input_indices: Option<Vec<Option<u32>>>,
    /// A marker of each vertex.
    pub vertex_markers: Option<Vec<i32>>,
    /// The height of each vertex, upwards.
    pub heights: Option<Vec<f64>>,
    /// The attribute of each triangle's region.
    pub regions: Option<Vec<f64>>,
    /// The edges that have markers.
    pub marked_edges: Option<Vec<MarkedEdge>>,
    /// What it was made to keep.
    pub promised: Option<Promised>,
}

impl MeshData {
    /// A mesh alone.
    pub fn new(mesh: TriMesh) -> Self {
        Self { mesh, ..Self::default() }
    }

    /// All of it, to be written.
    pub fn view(&self) -> MeshView<'_> {
        MeshView {
            input_indices: self.input_indices.as_deref(),
            vertex_markers: self.vertex_markers.as_deref(),
            heights: self.heights.as_deref(),
            regions: self.regions.as_deref(),
            marked_edges: self.marked_edges.as_deref(),
            promised: self.promised.as_ref(),
            ..MeshView::new(&self.mesh)
        }
    }

    /// Checks what serde does not: finite positions, indices in range, complete
    /// arrays.
    fn check(self, file: &str) -> Result<Self, ReadError> {
        let vertices = &self.mesh.vertices;
        if let Some(index) = vertices.iter().position(|p| !p.is_finite()) {
            let p = vertices[index];
            let found = if p.x.is_finite() { p.y } else { p.x }.to_string();
            let (file, index) = (file.to_owned(), index as u64);
            return Err(ReadError::NonFinite { file, line: 0, column: 0, item: "point", index, found });
        }
        if let Some((index, bad)) = self.heights.iter().flatten().enumerate().find(|(_, z)| !z.is_finite()) {
            let (file, index, found) = (file.to_owned(), index as u64, bad.to_string());
            return Err(ReadError::NonFinite { file, line: 0, column: 0, item: "point", index, found });
        }
        let ends = self.marked_edges.iter().flatten().flat_map(|edge| &edge.ends);
        if let Some(bad) =
            self.mesh.triangles.iter().flatten().chain(ends).find(|v| v.index() >= vertices.len())
        {
            return Err(ReadError::IndexOutOfRange {
                file: file.to_owned(),
                line: 0,
                column: 0,
                index: bad.index() as i64,
                first: 0,
                points: vertices.len() as u64,
            });
        }
        let triangles = self.mesh.triangles.len();
        if let Some(wrong) = self.promised.as_ref().and_then(|promised| promised.wrong_triangle(triangles)) {
            let expected = "existing triangles as exempt, each once";
            let (file, found) = (file.to_owned(), wrong.to_string());
            return Err(ReadError::Malformed { file, line: 0, column: 0, expected, found });
        }
        for (array, expected, found) in [
            ("input indices", vertices.len(), self.input_indices.as_ref().map(Vec::len)),
            ("vertex markers", vertices.len(), self.vertex_markers.as_ref().map(Vec::len)),
            ("heights", vertices.len(), self.heights.as_ref().map(Vec::len)),
            ("regions", triangles, self.regions.as_ref().map(Vec::len)),
        ] {
            if let Some(found) = found
                && found != expected
            {
                let (expected, found) = (expected as u64, found as u64);
                return Err(ReadError::Length { file: file.to_owned(), line: 0, array, expected, found });
            }
        }
        Ok(self)
    }
}

/// The members of a mesh in JSON and RON; others are left.
#[derive(Deserialize)]
pub(crate) struct MeshDocument {
    vertices: Vec<DVec2>,
    triangles: Vec<[VertexId; 3]>,
    #[serde(default)]
    input_indices: Option<Vec<Option<u32>>>,
    #[serde(default)]
    vertex_markers: Option<Vec<i32>>,
    #[serde(default)]
    heights: Option<Vec<f64>>,
    #[serde(default)]
    regions: Option<Vec<f64>>,
    #[serde(default)]
    marked_edges: Option<Vec<MarkedEdge>>,
    #[serde(default)]
    promised: Option<Promised>,
}

impl MeshDocument {
    pub(crate) fn data(self, file: &str) -> Result<MeshData, ReadError> {
        let data = MeshData {
            mesh: TriMesh { vertices: self.vertices, triangles: self.triangles },
            input_indices: self.input_indices,
            vertex_markers: self.vertex_markers,
            heights: self.heights,
            regions: self.regions,
            marked_edges: self.marked_edges,
            promised: self.promised,
        };
        data.check(file)
    }
}
