//! ADCIRC's grid, `fort.14`: nodes with depths, elements, open and land boundaries.
//!
//! Depths are positive downwards, so they are the negated heights of vertices; without heights
//! they are 0. **An edge of the boundary with a negative marker is open**; each such marker
//! makes open boundaries of its own. All others are land, mainland (`IBTYPE` 0) around the mesh
//! and islands (`IBTYPE` 1) around holes. Boundaries go with the mesh on the left, as ADCIRC
//! wants them: around the mesh counter-clockwise.
//!
//! When read, the open boundaries get the markers -1, -2, .. and those of land 1, 2, .. in their
//! order. Of boundaries with two nodes in a row, as weirs have, the first is taken. What stands
//! after the numbers of a row is a comment.

use std::io::{self, BufRead, Write};

use crate::boundary::{Run, runs};
use crate::data::MeshData;
use crate::error::ReadError;
use crate::lines::{Comments, Lines, Row};
use crate::mend::Faults;
use crate::numbered::{NumberedMesh, Reference};
use crate::text::TextWriter;
use crate::topology::counter_clockwise;
use crate::view::MeshView;

/// `IBTYPE` of the mainland, and of islands.
const MAINLAND: i32 = 0;
const ISLAND: i32 = 1;

/// The types of islands, which are closed even if the first node is not repeated.
const ISLANDS: [i64; 3] = [1, 11, 21];

/// Writes a mesh.
pub(crate) fn write_fort14(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.text("hexdel\n").integer(view.mesh.triangles.len()).text(" ");
    text.integer(view.mesh.vertices.len()).text("\n");
    for (i, p) in view.mesh.vertices.iter().enumerate() {
        text.integer(i + 1).text(" ").number(p.x).text(" ").number(p.y).text(" ");
        text.number(view.heights.map_or(0.0, |heights| -heights[i])).text("\n").breathe()?;
    }
    for t in 0..view.mesh.triangles.len() {
        text.integer(t + 1).text(" 3");
        for corner in counter_clockwise(view.mesh, t) {
            text.text(" ").integer(corner.index() + 1);
        }
        text.text("\n").breathe()?;
    }
    let (open, land): (Vec<Run>, Vec<Run>) = runs(view).into_iter().partition(|run| run.marker < 0);
    boundaries(&mut text, "open", &open)?;
    boundaries(&mut text, "land", &land)?;
    text.finish()
}

fn boundaries(text: &mut TextWriter<'_>, kind: &str, runs: &[Run]) -> io::Result<()> {
    let is_open = kind == "open";
    let total: usize = runs.iter().map(|run| nodes(run).len()).sum();
    text.integer(runs.len()).text(" = Number of ").text(kind).text(" boundaries\n");
    text.integer(total).text(" = Total number of ").text(kind).text(" boundary nodes\n");
    for (i, run) in runs.iter().enumerate() {
        text.integer(nodes(run).len());
        if !is_open {
            text.text(" ").integer(if is_island(run) { ISLAND } else { MAINLAND });
        }
        text.text(" = Number of nodes for ").text(kind).text(" boundary ").integer(i + 1).text("\n");
        for &node in nodes(run) {
            text.integer(u64::from(node) + 1).text("\n").breathe()?;
        }
    }
    Ok(())
}

/// Whether it is all the land around a hole.
fn is_island(run: &Run) -> bool {
    run.around_hole && run.is_closed() && run.marker >= 0
}

/// The nodes that are listed. Islands are closed without the first node again.
fn nodes(run: &Run) -> &[u32] {
    if is_island(run) { &run.vertices[..run.vertices.len() - 1] } else { &run.vertices }
}

/// Reads a mesh. Depths that are all 0 are no heights.
pub(crate) fn read_fort14(reader: impl BufRead, file: &str) -> Result<MeshData, ReadError> {
    let mut lines = Lines::new(reader, file, Comments::Nowhere);
    lines.skip_line()?;
    let (mut mesh, mut faults) = (NumberedMesh::default(), Faults::default());
    let mut counts = lines.due_row("header lines", 0, 1)?.fields();
    let elements: u64 = counts.integer("the number of elements")?;
    let nodes: u64 = counts.integer("the number of nodes")?;
    for index in 0..nodes {
        let Some(row) = faults.note(lines.due_row("nodes", index, nodes))? else { break };
        faults.note(mesh.node(&mut row.fields(), -1.0))?;
    }
    for index in 0..elements {
        let Some(row) = faults.note(lines.due_row("elements", index, elements))? else { break };
        faults.note(element(&mut mesh, row))?;
    }
    faults.take()?;
    for is_open in [true, false] {
        read_boundaries(&mut lines, &mut mesh, is_open)?;
    }
    mesh.finish(file)
}

fn element(mesh: &mut NumberedMesh, row: Row<'_>) -> Result<(), ReadError> {
    let mut fields = row.fields();
    fields.integer::<u64>("the number of an element")?;
    let corners: u64 = fields.integer("the number of corners")?;
    if corners != 3 {
        let (file, line) = (row.file.to_owned(), row.line);
        return Err(ReadError::Unsupported { file, line, what: format!("an element of {corners} nodes") });
    }
    mesh.triangle(&mut fields)
}

/// Reads all boundaries of a kind; none if the file ends before them.
fn read_boundaries<R: BufRead>(
    lines: &mut Lines<R>,
    mesh: &mut NumberedMesh,
    is_open: bool,
) -> Result<(), ReadError> {
    let count = match lines.next_row()? {
        Some(row) => row.fields().integer("the number of boundaries")?,
        None => 0_u32,
    };
    if count == 0 {
        // The number of their nodes, 0, may be missing where the file ends.
        return lines.next_row().map(drop);
    }
    // That total is not used by anyone.
    lines.due_row("numbers of boundary nodes", 0, 1)?;
    for index in 1..=count {
        let (found, expected) = (u64::from(index) - 1, u64::from(count));
        let mut fields = lines.due_row("boundaries", found, expected)?.fields();
        let length: u64 = fields.integer("the number of nodes of a boundary")?;
        let kind = if is_open { 0 } else { fields.integer::<i64>("the type of a boundary")? };
        let mut nodes: Vec<Reference> = Vec::new();
        for index in 0..length {
            let row = lines.due_row("boundary nodes", index, length)?;
            nodes.push((row.fields().integer("the number of a node")?, row.line));
        }
        if ISLANDS.contains(&kind) && nodes.first().map(|n| n.0) != nodes.last().map(|n| n.0) {
            nodes.extend(nodes.first().copied());
        }
        // Each of them took a line, so that there are not so many.
        let marker = index as i32;
        mesh.string(&nodes, if is_open { -marker } else { marker });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::{MarkedEdge, VertexId};

    fn read(text: &str) -> Result<MeshData, ReadError> {
        read_fort14(text.as_bytes(), "f")
    }

    /// A square of two triangles around no hole.
    const SQUARE: &str = "\n2 4 ! a comment\n1 0 0 5.0\n2 1 0 -2\n3 1 1 0\n4 0 1 0\n1 3 1 2 3\n2 3 1 3 4\n";

    #[test]
    fn boundaries_become_marked_edges() {
        let edge = |a, b, marker| MarkedEdge { ends: [a, b].map(VertexId::new), marker };
        let data = read(SQUARE).unwrap();
        assert_eq!(data.heights, Some(vec![-5.0, 2.0, 0.0, 0.0]));
        assert_eq!((data.mesh.triangles.len(), data.marked_edges), (2, None));
        let text = format!(
            "{SQUARE}1 = open\n2 = nodes\n2 = nodes of 1\n1\n2\n2 = land\n7\n3 20\n2\n3\n4\n2 24\n4 7 1.0 0.5\n1 8 1.0 0.5\n"
        );
        let edges = read(&text).unwrap().marked_edges.unwrap();
        assert_eq!(edges, [edge(0, 1, -1), edge(1, 2, 1), edge(2, 3, 1), edge(3, 0, 2)]);
        // Islands are closed.
        let island = format!("{SQUARE}0\n0\n1\n4\n4 1\n1\n4\n3\n2\n");
        assert_eq!(read(&island).unwrap().marked_edges.unwrap().len(), 4);
    }

    #[test]
    fn faults_have_lines() {
        let faults = [
            ("a", "f:1: file ends after 0 of 1 header lines"),
            ("a\n2 x\n", "f:2: expected the number of nodes, found \"x\""),
            ("a\n0 4000000000\n1 0 0 0\n", "f:3: file ends after 1 of 4000000000 nodes"),
            ("a\n0 1\n1 0 0\n", "f:3: expected the third coordinate of a node, found end of line"),
            ("a\n1 1\n1 0 0 0\n1 4 1 1 1 1\n", "f:4: an element of 4 nodes cannot be read"),
            (
                "a\n2 1\n1 0 0 0\n1 3 1 1 5\n2 3 1 1 6\n",
                "f:4: expected the number of an existing node, found \"5\"\n\
                 f:5: expected the number of an existing node, found \"6\"",
            ),
            ("a\n0 0\nnone\n", "f:3: expected the number of boundaries, found \"none\""),
            ("a\n0 0\n1\n1\n", "f:4: file ends after 0 of 1 boundaries"),
            ("a\n0 0\n1\n1\n2\n7\n", "f:6: file ends after 1 of 2 boundary nodes"),
            ("a\n0 0\n0\n0\n1\n1\n1\n", "f:7: expected the type of a boundary, found end of line"),
            ("a\n0 1\n1 0 0 0\n1\n2\n2\n1\n3\n", "f:8: expected the number of an existing node, found \"3\""),
        ];
        for (text, message) in faults {
            assert_eq!(read(text).unwrap_err().to_string(), message, "{text}");
        }
    }
}
