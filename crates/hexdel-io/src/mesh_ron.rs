//! Meshes in Rusty Object Notation (`.ron`).
//!
//! The text is that of a [`TriMesh`] with further fields beside its own:
//!
//! ```text
//! (
//!     vertices: [(0.0, 0.0), ..],
//!     triangles: [(0, 1, 2), ..],
//!     input_indices: Some([Some(0), None, ..]),  if known
//!     vertex_markers: Some([..]),                likewise
//!     regions: Some([..]),                       likewise
//!     certificate: Some(..),                     if there is one
//! )
//! ```
//!
//! so that `ron::from_str::<TriMesh>` reads it as well.

use std::io::{self, BufRead, BufWriter, Write};

use hexdel_geom::{DVec2, TriMesh, VertexId};
use ron::Options;
use ron::error::SpannedError;
use ron::ser::PrettyConfig;
use serde::Serialize;

use crate::error::ReadError;
use crate::view::MeshView;

#[derive(Serialize)]
struct Document<'a> {
    vertices: &'a [DVec2],
    triangles: &'a [[VertexId; 3]],
    #[serde(skip_serializing_if = "Option::is_none")]
    input_indices: Option<&'a [Option<u32>]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    vertex_markers: Option<&'a [i32]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    regions: Option<&'a [f64]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<&'a dyn erased_serde::Serialize>,
}

/// Writes a mesh.
pub(crate) fn write_ron(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let document = Document {
        vertices: &view.mesh.vertices,
        triangles: &view.mesh.triangles,
        input_indices: view.input_indices,
        vertex_markers: view.vertex_markers,
        regions: view.regions,
        certificate: view.certificate,
    };
    // One item of an array per line, the same line ends on every platform.
    let layout = PrettyConfig::new().depth_limit(2).new_line("\n");
    let mut out = BufWriter::with_capacity(1 << 16, out);
    Options::default().to_io_writer_pretty(&mut out, &document, layout).map_err(io::Error::other)?;
    out.write_all(b"\n")?;
    out.flush()
}

/// Reads a mesh; fields beside those of the mesh are left.
pub(crate) fn read_ron(mut reader: impl BufRead, file: &str) -> Result<TriMesh, ReadError> {
    let mut bytes = Vec::new();
    reader.read_to_end(&mut bytes).map_err(|source| ReadError::Io { file: file.to_owned(), source })?;
    let text = std::str::from_utf8(&bytes).map_err(|e| ReadError::NotUtf8 {
        file: file.to_owned(),
        line: bytes[..e.valid_up_to()].split(|&b| b == b'\n').count() as u64,
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mesh = ron::from_str(text).map_err(|e| malformed(&e, file))?;
    check(&mesh, file)?;
    Ok(mesh)
}

fn malformed(error: &SpannedError, file: &str) -> ReadError {
    ReadError::Ron {
        file: file.to_owned(),
        line: error.span.start.line as u64,
        column: error.span.start.col as u64,
        message: error.code.to_string(),
    }
}

fn check(mesh: &TriMesh, file: &str) -> Result<(), ReadError> {
    let points = mesh.vertices.len();
    if let Some(index) = mesh.vertices.iter().position(|p| !p.is_finite()) {
        let p = mesh.vertices[index];
        let coordinate = if p.x.is_finite() { p.y } else { p.x };
        return Err(ReadError::NonFinite {
            file: file.to_owned(),
            line: 0,
            item: "point",
            index: index as u64,
            found: coordinate.to_string(),
        });
    }
    match mesh.triangles.iter().flatten().find(|v| v.index() >= points) {
        None => Ok(()),
        Some(bad) => Err(ReadError::IndexOutOfRange {
            file: file.to_owned(),
            line: 0,
            index: bad.index() as i64,
            first: 0,
            points: points as u64,
        }),
    }
}
