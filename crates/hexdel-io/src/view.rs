//! What is written: a mesh and the data that goes with it, all borrowed.

use std::fmt;

use hexdel_geom::TriMesh;

use crate::error::WriteError;
use crate::picture::Picture;

/// A mesh to be written, with what is known about it.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, TriMesh, VertexId};
/// use hexdel_io::{MeshFormat, MeshView, write_mesh_to};
///
/// let mesh = TriMesh {
///     vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
///     triangles: vec![[0, 1, 2].map(VertexId::new)],
/// };
/// let view = MeshView::new(&mesh).with_input_indices(&[None, Some(0), Some(1)]);
/// let mut svg = Vec::new();
/// write_mesh_to(&mut svg, MeshFormat::Svg, &view, "a.svg")?;
/// assert!(svg.starts_with(b"<svg"));
/// # Ok::<(), hexdel_io::WriteError>(())
/// ```
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct MeshView<'a> {
    /// The mesh.
    pub mesh: &'a TriMesh,
    /// For each vertex the index of the input point it is, `None` for a Steiner
    /// point. Kept by `.node`, `.vtu` and `.ron`, drawn as a dot in pictures.
    pub input_indices: Option<&'a [Option<u32>]>,
    /// What was certified of the mesh. Kept by `.ron`.
    pub certificate: Option<&'a dyn erased_serde::Serialize>,
    /// How pictures look and what else is on them.
    pub picture: Picture<'a>,
}

impl<'a> MeshView<'a> {
    /// A mesh alone.
    pub fn new(mesh: &'a TriMesh) -> Self {
        Self { mesh, input_indices: None, certificate: None, picture: Picture::default() }
    }

    /// With the index of the input point that each vertex is.
    #[must_use]
    pub fn with_input_indices(self, input_indices: &'a [Option<u32>]) -> Self {
        Self { input_indices: Some(input_indices), ..self }
    }

    /// With a certificate, anything that serde serialises.
    #[must_use]
    pub fn with_certificate(self, certificate: &'a dyn erased_serde::Serialize) -> Self {
        Self { certificate: Some(certificate), ..self }
    }

    /// With options for pictures.
    #[must_use]
    pub fn with_picture(self, picture: Picture<'a>) -> Self {
        Self { picture, ..self }
    }

    /// The index of the input point that `vertex` is.
    pub(crate) fn input_index(&self, vertex: usize) -> Option<u32> {
        self.input_indices.and_then(|indices| indices[vertex])
    }

    /// Checks what every format relies on, so that no writer can fail half-way
    /// for another reason than the system's.
    pub(crate) fn check(&self, file: &str) -> Result<(), WriteError> {
        let vertices = &self.mesh.vertices;
        if let Some(indices) = self.input_indices
            && indices.len() != vertices.len()
        {
            return Err(WriteError::Length {
                file: file.to_owned(),
                array: "input indices",
                expected: vertices.len(),
                found: indices.len(),
            });
        }
        if let Some(index) = vertices.iter().position(|p| !p.is_finite()) {
            return Err(WriteError::NonFinite {
                file: file.to_owned(),
                item: "vertex",
                index,
                x: vertices[index].x,
                y: vertices[index].y,
            });
        }
        for (index, corners) in self.mesh.triangles.iter().enumerate() {
            let count = vertices.len();
            if let Some(bad) = corners.iter().find(|v| v.index() >= count) {
                return Err(WriteError::IndexOutOfRange {
                    file: file.to_owned(),
                    item: "triangle",
                    index,
                    target: bad.index(),
                    count,
                });
            }
        }
        Ok(())
    }
}

impl fmt::Debug for MeshView<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MeshView")
            .field("vertices", &self.mesh.vertices.len())
            .field("triangles", &self.mesh.triangles.len())
            .field("input_indices", &self.input_indices.is_some())
            .field("certificate", &self.certificate.is_some())
            .field("picture", &self.picture)
            .finish()
    }
}
