//! Meshes in JSON.
//!
//! The same members as in RON, see [`mesh_ron`](crate::mesh_ron):
//!
//! ```text
//! {"vertices": [[0.0, 0.0], ..],
//!  "triangles": [[0, 1, 2], ..],
//!  "input_indices": [0, null, ..],                      if known
//!  "vertex_markers": [1, ..],                           likewise
//!  "heights": [2.5, ..],                                likewise
//!  "regions": [1.0, ..],                                likewise
//!  "marked_edges": [{"ends": [0, 1], "marker": 1}, ..], likewise
//!  "promised": {"near": .., "far": .., "domain": "inside", "exempt": [3, ..]},
//!  "certificate": {..}}                                 if there is one
//! ```
//!
//! Written and read as a stream.

use std::io::{self, BufRead, Write};

use hexdel_geom::VertexId;

use crate::data::{MeshData, MeshDocument};
use crate::error::ReadError;
use crate::json::{json_error, skip_byte_order_mark};
use crate::text::TextWriter;
use crate::view::MeshView;

/// Writes a mesh.
pub(crate) fn write_json(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.text("{\"vertices\": [");
    text.rows(&view.mesh.vertices, |text, p| {
        text.position(*p);
    })?;
    text.text("],\n\"triangles\": [");
    text.rows(&view.mesh.triangles, |text, corners| indices(text, corners))?;
    if let Some(inputs) = view.input_indices {
        text.text("],\n\"input_indices\": [");
        text.rows(inputs, |text, index| {
            match index {
                Some(index) => text.integer(*index),
                None => text.text("null"),
            };
        })?;
    }
    if let Some(markers) = view.vertex_markers {
        text.text("],\n\"vertex_markers\": [");
        text.rows(markers, |text, marker| {
            text.integer(*marker);
        })?;
    }
    if let Some(heights) = view.heights {
        text.text("],\n\"heights\": [");
        text.rows(heights, |text, height| {
            text.number(*height);
        })?;
    }
    if let Some(regions) = view.regions {
        text.text("],\n\"regions\": [");
        text.rows(regions, |text, region| {
            text.number(*region);
        })?;
    }
    if let Some(edges) = view.marked_edges {
        text.text("],\n\"marked_edges\": [");
        text.rows(edges, |text, edge| {
            text.text("{\"ends\": ");
            indices(text, &edge.ends);
            text.text(", \"marker\": ").integer(edge.marker).text("}");
        })?;
    }
    text.text("]");
    if let Some(promised) = view.promised {
        let promised = serde_json::to_string(promised).map_err(io::Error::other)?;
        text.text(",\n\"promised\": ").text(&promised);
    }
    if let Some(certificate) = view.certificate {
        let certificate = serde_json::to_string(certificate).map_err(io::Error::other)?;
        text.text(",\n\"certificate\": ").text(&certificate);
    }
    text.text("}\n").finish()
}

fn indices(text: &mut TextWriter<'_>, vertices: &[VertexId]) {
    for (i, vertex) in vertices.iter().enumerate() {
        text.text(if i == 0 { "[" } else { ", " }).integer(vertex.index());
    }
    text.text("]");
}

/// Reads a mesh; other members are left.
pub(crate) fn read_json(mut reader: impl BufRead, file: &str) -> Result<MeshData, ReadError> {
    skip_byte_order_mark(&mut reader).map_err(|source| ReadError::Io { file: file.to_owned(), source })?;
    let document: MeshDocument = serde_json::from_reader(reader).map_err(|error| {
        if error.is_io() {
            ReadError::Io { file: file.to_owned(), source: error.into() }
        } else {
            json_error(&error, file)
        }
    })?;
    document.data(file)
}
