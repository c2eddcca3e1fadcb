//! The Voronoi cells of a mesh as a discretisation by vertices of MODFLOW 6, `.disv`.
//!
//! Each vertex of the mesh that has triangles is the centre of a cell; the line between the
//! centres of neighbours crosses their common face at a right angle, as the model wants it.
//! Everything is counted from 1, in the order of the mesh; corners are clockwise. There is one
//! layer, from 0 to 1: replace it by your own.

use std::io::{self, Write};

use hexdel_geom::Voronoi;

use crate::dual::Cells;
use crate::text::TextWriter;
use crate::view::MeshView;

/// Writes the package.
pub(crate) fn write_disv(out: &mut dyn Write, view: &MeshView<'_>, dual: &Voronoi<'_>) -> io::Result<()> {
    let cells = Cells::of(view, dual);
    let mut text = TextWriter::new(out);
    text.text(
        "# Voronoi cells of a triangle mesh. There is one layer, from 0 to 1: replace it by your own.\n",
    );
    text.text("BEGIN OPTIONS\nEND OPTIONS\n\nBEGIN DIMENSIONS\n  NLAY 1\n  NCPL ");
    text.integer(cells.vertices.len()).text("\n  NVERT ").integer(cells.corners.len());
    text.text(
        "\nEND DIMENSIONS\n\nBEGIN GRIDDATA\n  TOP\n    CONSTANT 1.0\n  BOTM LAYERED\n    CONSTANT 0.0\n",
    );
    text.text("END GRIDDATA\n\nBEGIN VERTICES\n");
    for (i, p) in cells.corners.iter().enumerate() {
        text.text("  ").integer(i + 1).text(" ").number(p.x).text(" ").number(p.y);
        text.text("\n").breathe()?;
    }
    text.text("END VERTICES\n\nBEGIN CELL2D\n");
    for (i, (vertex, ring)) in cells.iter().enumerate() {
        let centre = view.mesh.vertices[vertex];
        text.text("  ").integer(i + 1).text(" ").number(centre.x).text(" ").number(centre.y);
        text.text(" ").integer(ring.len());
        for corner in ring.iter().rev() {
            text.text(" ").integer(corner + 1);
        }
        text.text("\n").breathe()?;
    }
    text.text("END CELL2D\n").finish()
}
