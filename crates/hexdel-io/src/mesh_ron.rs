//! Meshes in Rusty Object Notation (`.ron`).
//!
//! The text is that of a [`TriMesh`](hexdel_geom::TriMesh) with further fields beside
//! its own:
//!
//! ```text
//! (
//!     vertices: [(0.0, 0.0), ..],
//!     triangles: [(0, 1, 2), ..],
//!     input_indices: Some([Some(0), None, ..]),  if known
//!     vertex_markers: Some([..]),                likewise
//!     heights: Some([..]),                       likewise
//!     regions: Some([..]),                       likewise
//!     marked_edges: Some([(ends: (0, 1), marker: 1), ..]),
//!     promised: Some(..),                        likewise
//!     certificate: Some(..),                     if there is one
//! )
//! ```
//!
//! so that `ron::from_str::<TriMesh>` reads it as well. The text is parsed as a whole,
//! which takes memory for it beside the mesh.

use std::io::{self, BufWriter, Write};

use hexdel_geom::{DVec2, MarkedEdge, VertexId};
use ron::Options;
use ron::error::SpannedError;
use ron::ser::PrettyConfig;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::data::{MeshData, MeshDocument};
use crate::error::ReadError;
use crate::json::Source;
use crate::lines::clip_message;
use crate::promised::Promised;
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
    heights: Option<&'a [f64]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    regions: Option<&'a [f64]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    marked_edges: Option<&'a [MarkedEdge]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    promised: Option<&'a Promised>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<&'a dyn erased_serde::Serialize>,
}

/// Writes a mesh.
pub(crate) fn write_ron(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    to_ron(
        out,
        &Document {
            vertices: &view.mesh.vertices,
            triangles: &view.mesh.triangles,
            input_indices: view.input_indices,
            vertex_markers: view.vertex_markers,
            heights: view.heights,
            regions: view.regions,
            marked_edges: view.marked_edges,
            promised: view.promised,
            certificate: view.certificate,
        },
    )
}

/// Writes anything, one item of its arrays per line.
pub(crate) fn to_ron(out: &mut dyn Write, document: &impl Serialize) -> io::Result<()> {
    // The same line ends on every platform.
    let layout = PrettyConfig::new().depth_limit(2).new_line("\n");
    let mut out = BufWriter::with_capacity(1 << 16, out);
    Options::default().to_io_writer_pretty(&mut out, document, layout).map_err(io::Error::other)?;
    out.write_all(b"\n")?;
    out.flush()
}

/// Reads a mesh; fields beside those above are left.
pub(crate) fn read_ron(source: &Source<'_>) -> Result<MeshData, ReadError> {
    parse_ron::<MeshDocument>(source)?.data(source.file)
}

/// Parses a text.
pub(crate) fn parse_ron<T: DeserializeOwned>(source: &Source<'_>) -> Result<T, ReadError> {
    let text = std::str::from_utf8(source.bytes).map_err(|e| ReadError::NotUtf8 {
        file: source.file.to_owned(),
        line: source.bytes[..e.valid_up_to()].split(|&b| b == b'\n').count() as u64,
    })?;
    ron::from_str(text).map_err(|e| malformed(&e, source.file))
}

fn malformed(error: &SpannedError, file: &str) -> ReadError {
    ReadError::Ron {
        file: file.to_owned(),
        line: error.span.start.line as u64,
        column: error.span.start.col as u64,
        message: clip_message(error.code.to_string()),
    }
}
