//! Shewchuk's Triangle formats: writing `.node`, `.ele` and `.poly`.
//!
//! Everything is numbered from 0. Meshes whose vertices know their input point
//! carry its index as the one attribute, -1 for Steiner points; triangles carry the
//! attribute of their region, vertices a marker, if the mesh has them.

use std::io::{self, Write};

use hexdel_geom::{DVec2, Pslg};

use crate::text::TextWriter;
use crate::view::MeshView;

/// Writes the vertices of a mesh.
pub(crate) fn write_node(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    let attributes = u32::from(view.input_indices.is_some());
    text.integer(view.mesh.vertices.len()).text(" 2 ");
    text.integer(attributes).text(" ");
    text.integer(u32::from(view.vertex_markers.is_some())).text("\n");
    for (i, &p) in view.mesh.vertices.iter().enumerate() {
        position_row(&mut text, i, p);
        if view.input_indices.is_some() {
            let index = view.input_index(i).map_or(-1, i64::from);
            text.text(" ").integer(index);
        }
        end_with_marker(&mut text, view.vertex_markers.map(|markers| &markers[i]))?;
    }
    text.finish()
}

/// Writes the triangles of a mesh.
pub(crate) fn write_ele(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.integer(view.mesh.triangles.len()).text(" 3 ");
    text.integer(u32::from(view.regions.is_some())).text("\n");
    for (i, corners) in view.mesh.triangles.iter().enumerate() {
        text.integer(i);
        for corner in corners {
            text.text(" ").integer(corner.index());
        }
        if let Some(regions) = view.regions {
            text.text(" ").number(regions[i]);
        }
        text.text("\n").breathe()?;
    }
    text.finish()
}

/// Writes points with their attributes and markers.
pub(crate) fn write_points(out: &mut dyn Write, pslg: &Pslg) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    point_section(&mut text, pslg)?;
    text.finish()
}

/// Writes points, segments, holes and regions.
pub(crate) fn write_poly(out: &mut dyn Write, pslg: &Pslg) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    point_section(&mut text, pslg)?;
    segment_section(&mut text, pslg)?;
    text.integer(pslg.holes.len()).text("\n");
    for (i, &hole) in pslg.holes.iter().enumerate() {
        position_row(&mut text, i, hole);
        text.text("\n").breathe()?;
    }
    text.integer(pslg.regions.len()).text("\n");
    for (i, region) in pslg.regions.iter().enumerate() {
        position_row(&mut text, i, region.point);
        text.text(" ").number(region.attribute);
        // Triangle takes the attribute for the area if there is no area.
        text.text(" ").number(region.max_area.unwrap_or(-1.0));
        text.text("\n").breathe()?;
    }
    text.finish()
}

fn point_section(text: &mut TextWriter<'_>, pslg: &Pslg) -> io::Result<()> {
    let markers = &pslg.point_markers;
    text.integer(pslg.points.len()).text(" 2 ");
    text.integer(pslg.attributes_per_point).text(" ");
    text.integer(u32::from(!markers.is_empty())).text("\n");
    for (i, &p) in pslg.points.iter().enumerate() {
        position_row(text, i, p);
        for &attribute in pslg.attributes(i) {
            text.text(" ").number(attribute);
        }
        end_with_marker(text, markers.get(i))?;
    }
    Ok(())
}

fn segment_section(text: &mut TextWriter<'_>, pslg: &Pslg) -> io::Result<()> {
    let markers = &pslg.segment_markers;
    text.integer(pslg.segments.len()).text(" ");
    text.integer(u32::from(!markers.is_empty())).text("\n");
    for (i, [start, end]) in pslg.segments.iter().enumerate() {
        text.integer(i).text(" ").integer(*start);
        text.text(" ").integer(*end);
        end_with_marker(text, markers.get(i))?;
    }
    Ok(())
}

fn end_with_marker(text: &mut TextWriter<'_>, marker: Option<&i32>) -> io::Result<()> {
    if let Some(&marker) = marker {
        text.text(" ").integer(marker);
    }
    text.text("\n").breathe()
}

fn position_row(text: &mut TextWriter<'_>, index: usize, p: DVec2) {
    text.integer(index).text(" ").number(p.x);
    text.text(" ").number(p.y);
}
