//! Stereolithography, `.stl`, in text: triangles with their normals, at height 0.
//!
//! Corners are counter-clockwise as seen from above, so that all normals point up. The format
//! knows no vertices and no data.

use std::io::{self, Write};

use crate::text::TextWriter;
use crate::topology::counter_clockwise;
use crate::view::MeshView;

/// Writes a mesh.
pub(crate) fn write_stl(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.text("solid hexdel\n");
    for t in 0..view.mesh.triangles.len() {
        text.text("facet normal 0 0 1\n outer loop\n");
        for corner in counter_clockwise(view.mesh, t) {
            let p = view.mesh.vertices[corner.index()];
            text.text("  vertex ").number(p.x).text(" ").number(p.y).text(" 0\n");
        }
        text.text(" endloop\nendfacet\n").breathe()?;
    }
    text.text("endsolid hexdel\n").finish()
}
