//! Shewchuk's Triangle formats: writing `.node`, `.ele`, `.edge`, `.neigh` and `.poly`.
//!
//! Everything is numbered from 0, or from 1 where a mesh is to be. Meshes whose vertices know their input point
//! carry its index as the one attribute, -1 for Steiner points, unless there are attributes of
//! their own; triangles carry the attribute of their region, vertices a marker, if the mesh has them. What a mesh
//! was made to keep is a comment at the end of the `.ele` file.

use std::io::{self, Write};

use hexdel_geom::{DVec2, Pslg, Region};

use crate::second_order::Midpoints;
use crate::text::TextWriter;
use crate::topology::{EdgeMarkers, Edges};
use crate::view::MeshView;

/// Writes the vertices of a mesh, and the midpoints of elements of second order.
pub(crate) fn write_node(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let midpoints = view.second_order.then(|| Midpoints::new(view));
    write_nodes(out, view, midpoints.as_ref())
}

fn write_nodes(out: &mut dyn Write, view: &MeshView<'_>, midpoints: Option<&Midpoints>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    let first = view.first_number as usize;
    let of_vertices = Attributes::of(view);
    text.integer(view.mesh.vertices.len() + midpoints.map_or(0, Midpoints::count)).text(" 2 ");
    text.integer(of_vertices.count()).text(" ");
    text.integer(u32::from(view.vertex_markers.is_some())).text("\n");
    for (i, &p) in view.mesh.vertices.iter().enumerate() {
        position_row(&mut text, first + i, p);
        of_vertices.write(&mut text, [i, i]);
        end_with_marker(&mut text, view.vertex_markers.map(|markers| &markers[i]))?;
    }
    for (i, ends, p, marker) in midpoints.iter().flat_map(|m| m.nodes(&view.mesh.vertices)) {
        position_row(&mut text, first + i, p);
        of_vertices.write(&mut text, ends.map(|v| v as usize));
        end_with_marker(&mut text, view.vertex_markers.map(|_| &marker))?;
    }
    text.finish()
}

/// The attributes of vertices in a file.
enum Attributes<'a> {
    None,
    /// The index of the input point.
    Input(&'a [Option<u32>]),
    /// Their own, so many for each.
    Own(&'a [f64], usize),
}

impl<'a> Attributes<'a> {
    fn of(view: &MeshView<'a>) -> Self {
        match (view.vertex_attributes, view.input_indices) {
            (Some((all, per_vertex)), _) => Self::Own(all, per_vertex),
            (None, Some(indices)) => Self::Input(indices),
            (None, None) => Self::None,
        }
    }

    fn count(&self) -> usize {
        match self {
            Self::None => 0,
            Self::Input(_) => 1,
            Self::Own(_, per_vertex) => *per_vertex,
        }
    }

    /// Writes those of a vertex, or of the midpoint between two.
    fn write(&self, text: &mut TextWriter<'_>, [a, b]: [usize; 2]) {
        match self {
            Self::None => {}
            Self::Input(indices) => {
                let index = indices[a].filter(|_| a == b).map_or(-1, i64::from);
                text.text(" ").integer(index);
            }
            Self::Own(all, n) => {
                for (x, y) in all[a * n..(a + 1) * n].iter().zip(&all[b * n..(b + 1) * n]) {
                    text.text(" ").number(x.midpoint(*y));
                }
            }
        }
    }
}

/// Writes the triangles of a mesh, with six nodes each if of second order.
pub(crate) fn write_ele(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let midpoints = view.second_order.then(|| Midpoints::new(view));
    let mut text = TextWriter::new(out);
    text.integer(view.mesh.triangles.len()).text(if midpoints.is_some() { " 6 " } else { " 3 " });
    text.integer(u32::from(view.regions.is_some())).text("\n");
    let first = view.first_number as usize;
    for (i, corners) in view.mesh.triangles.iter().enumerate() {
        text.integer(first + i);
        for corner in corners {
            text.text(" ").integer(first + corner.index());
        }
        for node in midpoints.iter().flat_map(|m| m.of(*corners)) {
            text.text(" ").integer(first + node);
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
    let markers = EdgeMarkers::new(view.marked_edges.unwrap_or(&[]));
    text.integer(edges.iter().count()).text(" 1\n");
    for (i, edge) in edges.iter().enumerate() {
        let marker = markers.of(edge.ends).unwrap_or(i32::from(edge.triangles == 1));
        text.integer(i + view.first_number as usize);
        for end in edge.ends {
            text.text(" ").integer(end + view.first_number);
        }
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
        let first = i64::from(view.first_number);
        text.integer(t + view.first_number as usize);
        for neighbour in edges.neighbours(t, corners) {
            text.text(" ").integer(neighbour.map_or(-1, |n| first + i64::from(n)));
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
    let first = view.first_number;
    let segment = |text: &mut TextWriter<'_>, i: usize, ends: [u32; 2], marker: i32| {
        text.integer(first as usize + i);
        for end in ends {
            text.text(" ").integer(first + end);
        }
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
    seed_sections(&mut text, view.seeds.0, view.seeds.1, first as usize)?;
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
    seed_sections(&mut text, &pslg.holes, &pslg.regions, 0)?;
    if pslg.regions.is_empty() {
        text.text("0\n");
    }
    text.finish()
}

/// Holes and, if there are any, regions.
fn seed_sections(
    text: &mut TextWriter<'_>,
    holes: &[DVec2],
    regions: &[Region],
    first: usize,
) -> io::Result<()> {
    text.integer(holes.len()).text("\n");
    for (i, &hole) in holes.iter().enumerate() {
        position_row(text, first + i, hole);
        text.text("\n").breathe()?;
    }
    if regions.is_empty() {
        return Ok(());
    }
    text.integer(regions.len()).text("\n");
    for (i, region) in regions.iter().enumerate() {
        position_row(text, first + i, region.point);
        text.text(" ").number(region.attribute);
        // Triangle takes the attribute for the area if there is no area.
        text.text(" ").number(region.max_area.unwrap_or(-1.0));
        text.text("\n").breathe()?;
    }
    Ok(())
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
