//! Shewchuk's Triangle formats: writing `.node`, `.ele`, `.edge`, `.neigh` and `.poly`.
//!
//! Everything is numbered from 0. Meshes whose vertices know their input point
//! carry its index as the one attribute, -1 for Steiner points; triangles carry the
//! attribute of their region, vertices a marker, if the mesh has them. What a mesh was
//! made to keep is a comment at the end of the `.ele` file.

use std::io::{self, Write};

use hexdel_geom::{DVec2, Pslg};

use crate::second_order::Midpoints;
use crate::text::TextWriter;
use crate::topology::Edges;
use crate::view::MeshView;

/// Writes the vertices of a mesh, and the midpoints of elements of second order.
pub(crate) fn write_node(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let midpoints = view.second_order.then(|| Midpoints::new(view));
    write_nodes(out, view, midpoints.as_ref())
}

fn write_nodes(out: &mut dyn Write, view: &MeshView<'_>, midpoints: Option<&Midpoints>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    let attributes = u32::from(view.input_indices.is_some());
    text.integer(view.mesh.vertices.len() + midpoints.map_or(0, Midpoints::count)).text(" 2 ");
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
    for (i, p, marker) in midpoints.iter().flat_map(|m| m.nodes(&view.mesh.vertices)) {
        position_row(&mut text, i, p);
        if view.input_indices.is_some() {
            text.text(" -1");
        }
        end_with_marker(&mut text, view.vertex_markers.map(|_| &marker))?;
    }
    text.finish()
}

/// Writes the triangles of a mesh, with six nodes each if of second order.
pub(crate) fn write_ele(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let midpoints = view.second_order.then(|| Midpoints::new(view));
    let mut text = TextWriter::new(out);
    text.integer(view.mesh.triangles.len()).text(if midpoints.is_some() { " 6 " } else { " 3 " });
    text.integer(u32::from(view.regions.is_some())).text("\n");
    for (i, corners) in view.mesh.triangles.iter().enumerate() {
        text.integer(i);
        for corner in corners {
            text.text(" ").integer(corner.index());
        }
        for node in midpoints.iter().flat_map(|m| m.of(*corners)) {
            text.text(" ").integer(node);
        }
        if let Some(regions) = view.regions {
            text.text(" ").number(regions[i]);
        }
        text.text("\n").breathe()?;
    }
    if let Some(promised) = view.promised {
        for line in promised.to_string().lines() {
            text.text("# ").text(line).text("\n").breathe()?;
        }
    }
    text.finish()
}

/// Writes all edges of a mesh, with the markers of those that have one; of others it
/// is 1 on the boundary and 0 inside.
pub(crate) fn write_edge(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    let edges = Edges::new(view.mesh);
    let mut marked: Vec<([u32; 2], i32)> = Vec::new();
    for edge in view.marked_edges.unwrap_or(&[]) {
        let [a, b] = edge.ends.map(|v| v.index() as u32);
        marked.push(([a.min(b), a.max(b)], edge.marker));
    }
    marked.sort_unstable();
    text.integer(edges.iter().count()).text(" 1\n");
    for (i, edge) in edges.iter().enumerate() {
        let found = marked.binary_search_by_key(&edge.ends, |(ends, _)| *ends);
        let marker = found.map_or(i32::from(edge.triangles == 1), |at| marked[at].1);
        text.integer(i).text(" ").integer(edge.ends[0]);
        text.text(" ").integer(edge.ends[1]);
        end_with_marker(&mut text, Some(&marker))?;
    }
    text.finish()
}

/// Writes the neighbours of each triangle, opposite to its corners, -1 for none.
pub(crate) fn write_neigh(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    let edges = Edges::new(view.mesh);
    text.integer(view.mesh.triangles.len()).text(" 3\n");
    for (t, &corners) in view.mesh.triangles.iter().enumerate() {
        text.integer(t);
        for neighbour in edges.neighbours(t, corners) {
            text.text(" ").integer(neighbour.map_or(-1, i64::from));
        }
        text.text("\n").breathe()?;
    }
    text.finish()
}

/// Writes the vertices of a mesh and its marked edges as segments, or those of its
/// boundary with marker 1 if none are known.
pub(crate) fn write_mesh_poly(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    write_nodes(out, view, None)?;
    let mut text = TextWriter::new(out);
    let segment = |text: &mut TextWriter<'_>, i: usize, ends: [u32; 2], marker: i32| {
        text.integer(i).text(" ").integer(ends[0]);
        text.text(" ").integer(ends[1]);
        end_with_marker(text, Some(&marker))
    };
    if let Some(marked) = view.marked_edges {
        text.integer(marked.len()).text(" 1\n");
        for (i, edge) in marked.iter().enumerate() {
            segment(&mut text, i, edge.ends.map(|v| v.index() as u32), edge.marker)?;
        }
    } else {
        let edges = Edges::new(view.mesh);
        let boundary = || edges.iter().filter(|edge| edge.triangles == 1);
        text.integer(boundary().count()).text(" 1\n");
        for (i, edge) in boundary().enumerate() {
            segment(&mut text, i, edge.ends, 1)?;
        }
    }
    text.text("0\n").finish()
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
