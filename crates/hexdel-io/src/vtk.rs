//! VTK's legacy format, `.vtk`, in text, for programs that do not read `.vtu`.
//!
//! Point and cell data have the names that they have in [`.vtu`](crate::vtu); what the mesh was
//! made to keep is left.

use std::io::{self, Write};

use hexdel_geom::TriangleId;

use crate::angles::angle_range_deg;
use crate::text::TextWriter;
use crate::view::MeshView;
use crate::vtu::VTK_TRIANGLE;

/// Writes a mesh.
pub(crate) fn write_vtk(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let (vertices, triangles) = (&view.mesh.vertices, &view.mesh.triangles);
    let mut text = TextWriter::new(out);
    text.text("# vtk DataFile Version 3.0\nhexdel\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS ");
    text.integer(vertices.len()).text(" double\n");
    for p in vertices {
        text.number(p.x).text(" ").number(p.y);
        text.text(" 0\n").breathe()?;
    }
    text.text("CELLS ").integer(triangles.len()).text(" ").integer(4 * triangles.len()).text("\n");
    for corners in triangles {
        text.text("3");
        for corner in corners {
            text.text(" ").integer(corner.index());
        }
        text.text("\n").breathe()?;
    }
    text.text("CELL_TYPES ").integer(triangles.len()).text("\n");
    for _ in triangles {
        text.integer(VTK_TRIANGLE).text("\n").breathe()?;
    }
    point_data(&mut text, view)?;
    cell_data(&mut text, view)?;
    text.finish()
}

fn point_data(text: &mut TextWriter<'_>, view: &MeshView<'_>) -> io::Result<()> {
    if view.input_indices.is_none() && view.vertex_markers.is_none() && view.heights.is_none() {
        return Ok(());
    }
    text.text("POINT_DATA ").integer(view.mesh.vertices.len()).text("\n");
    if let Some(indices) = view.input_indices {
        scalars(text, "input_index long", indices, |text, index| {
            text.integer(index.map_or(-1, i64::from));
        })?;
    }
    if let Some(markers) = view.vertex_markers {
        scalars(text, "marker int", markers, |text, marker| {
            text.integer(*marker);
        })?;
    }
    if let Some(heights) = view.heights {
        scalars(text, "height double", heights, |text, height| {
            text.number(*height);
        })?;
    }
    Ok(())
}

fn cell_data(text: &mut TextWriter<'_>, view: &MeshView<'_>) -> io::Result<()> {
    let count = view.mesh.triangles.len();
    text.text("CELL_DATA ").integer(count).text("\n");
    let range = |t| angle_range_deg(view.measured(TriangleId::new(t)));
    for (k, name) in ["min_angle double", "max_angle double"].into_iter().enumerate() {
        scalars(text, name, 0..count, |text, t| {
            text.number(range(t)[k]);
        })?;
    }
    if let Some(regions) = view.regions {
        scalars(text, "region double", regions, |text, region| {
            text.number(*region);
        })?;
    }
    Ok(())
}

/// Writes an array of a name and type, a value per line.
fn scalars<T>(
    text: &mut TextWriter<'_>,
    name_and_type: &str,
    items: impl IntoIterator<Item = T>,
    mut write: impl FnMut(&mut TextWriter<'_>, T),
) -> io::Result<()> {
    text.text("SCALARS ").text(name_and_type).text(" 1\nLOOKUP_TABLE default\n");
    for item in items {
        write(text, item);
        text.text("\n").breathe()?;
    }
    Ok(())
}
