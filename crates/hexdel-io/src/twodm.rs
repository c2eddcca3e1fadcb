//! The mesh format of SMS, `.2dm`: nodes, elements and node strings.
//!
//! | card | is |
//! |---|---|
//! | `ND` | a node: its number, x, y and its height |
//! | `E3T` | a triangle: its number, its nodes, its material, which is the region |
//! | `NS` | nodes along a boundary, the last negative, then a number: the marker |
//!
//! Written are node strings for the edges of the boundary with a marker other than 0, with the mesh on
//! the left; those with marker 1 if no edges have markers. Materials are 1 if there are no regions.
//! When read, a string without a number gets that of its place, from 1. Other elements
//! are refused, other cards left: they are about names, solvers and display.

use std::io::{self, BufRead, Write};
use std::mem::take;

use crate::boundary::runs;
use crate::data::MeshData;
use crate::error::ReadError;
use crate::lines::{Comments, Fields, Lines, Row, quote};
use crate::mend::Faults;
use crate::numbered::{NumberedMesh, Reference};
use crate::text::TextWriter;
use crate::topology::counter_clockwise;
use crate::view::MeshView;

/// Nodes in a card of a string, as SMS has it.
const IN_CARD: usize = 10;

/// Writes a mesh whose regions are integers.
pub(crate) fn write_2dm(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.text("MESH2D\nNUM_MATERIALS_PER_ELEM 1\n");
    for t in 0..view.mesh.triangles.len() {
        text.text("E3T ").integer(t + 1);
        for corner in counter_clockwise(view.mesh, t) {
            text.text(" ").integer(corner.index() + 1);
        }
        text.text(" ").integer(view.regions.map_or(1, |regions| regions[t] as i32));
        text.text("\n").breathe()?;
    }
    for (i, p) in view.mesh.vertices.iter().enumerate() {
        text.text("ND ").integer(i + 1).text(" ").number(p.x).text(" ").number(p.y).text(" ");
        text.number(view.heights.map_or(0.0, |heights| heights[i])).text("\n").breathe()?;
    }
    for run in runs(view).iter().filter(|run| run.marker != 0) {
        node_string(&mut text, &run.vertices, run.marker)?;
    }
    text.finish()
}

fn node_string(text: &mut TextWriter<'_>, vertices: &[u32], marker: i32) -> io::Result<()> {
    let last = vertices.len() - 1;
    for (i, &v) in vertices.iter().enumerate() {
        if i % IN_CARD == 0 {
            text.text(if i == 0 { "NS" } else { "\nNS" });
        }
        text.text(if i == last { " -" } else { " " }).integer(u64::from(v) + 1);
    }
    text.text(" ").integer(marker).text("\n").breathe()
}

/// Reads a mesh. Materials that are all 1 are no regions, and heights that are all 0 none.
pub(crate) fn read_2dm(reader: impl BufRead, file: &str) -> Result<MeshData, ReadError> {
    let mut lines = Lines::new(reader, file, Comments::WholeLine);
    let mut cards = Cards::default();
    match lines.next_row()? {
        Some(row) if row.fields().text() == Some("MESH2D") => {}
        Some(row) => return Err(row.malformed("MESH2D as the first card", row.fields().text())),
        None => return Err(ReadError::MissingSection { file: file.to_owned(), line: 0, section: "cards" }),
    }
    let mut faults = Faults::default();
    while let Some(row) = faults.note(lines.next_row())?.flatten() {
        faults.note(cards.card(row))?;
    }
    faults.take()?;
    cards.finish(lines.number(), file)
}

/// What has been read.
#[derive(Default)]
struct Cards {
    mesh: NumberedMesh,
    materials: Vec<f64>,
    /// The nodes so far of a string that goes on in the next card.
    string: Vec<Reference>,
    /// Strings so far.
    strings: i32,
}

impl Cards {
    fn card(&mut self, row: Row<'_>) -> Result<(), ReadError> {
        let mut fields = row.fields();
        let card = fields.text().unwrap_or_default();
        match card {
            "ND" => self.mesh.node(&mut fields, 1.0),
            "E3T" => {
                fields.integer::<u64>("the number of an element")?;
                self.mesh.triangle(&mut fields)?;
                let material = if fields.peek().is_some() { fields.number("a material")? } else { 1.0 };
                self.materials.push(material);
                Ok(())
            }
            "NS" => self.node_string(fields),
            // Elements of all other sorts: E2L, E6T, E4Q, E8Q, E9Q ..
            _ if is_element(card) => {
                let (file, line) = (row.file.to_owned(), row.line);
                Err(ReadError::Unsupported { file, line, what: format!("an element {}", quote(card)) })
            }
            _ => Ok(()),
        }
    }

    fn node_string(&mut self, mut fields: Fields<'_>) -> Result<(), ReadError> {
        while fields.peek().is_some() {
            let node: i64 = fields.integer("the number of a node")?;
            self.string.push((node.unsigned_abs(), fields.row.line));
            if node < 0 {
                self.strings = self.strings.saturating_add(1);
                let marker = fields.integer_or(self.strings, "the number of the node string")?;
                self.mesh.string(&take(&mut self.string), marker);
                break;
            }
        }
        Ok(())
    }

    fn finish(self, line: u64, file: &str) -> Result<MeshData, ReadError> {
        if !self.string.is_empty() {
            let (file, expected) = (file.to_owned(), "a negative number that ends the node string");
            let found = "the end of the file".to_owned();
            return Err(ReadError::Malformed { file, line, column: 0, expected, found });
        }
        let mut data = self.mesh.finish(file)?;
        data.regions = Some(self.materials).filter(|materials| materials.iter().any(|&m| m != 1.0));
        Ok(data)
    }
}

fn is_element(card: &str) -> bool {
    let mut letters = card.chars();
    card.len() == 3 && letters.next() == Some('E') && letters.next().is_some_and(|c| c.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel_geom::{MarkedEdge, VertexId};

    fn read(text: &str) -> Result<MeshData, ReadError> {
        read_2dm(text.as_bytes(), "f")
    }

    #[test]
    fn cards_in_any_order() {
        let text = "MESH2D\nMESHNAME \"a b\"\nE3T 7 30 10 20 2\nND 30 0 0 1.5\nNS 10 20\nNS -30 9\n\
                    ND 10 1 0 0\nND 20 0 1 -2e0\nNS 30 -10\nBEGPARAMDEF\nGM \"Mesh\"\nENDPARAMDEF\n";
        let data = read(text).unwrap();
        assert_eq!(data.mesh.triangles, [[0, 1, 2].map(VertexId::new)]);
        assert_eq!(data.heights, Some(vec![1.5, 0.0, -2.0]));
        assert_eq!(data.regions, Some(vec![2.0]));
        let edge = |a, b, marker| MarkedEdge { ends: [a, b].map(VertexId::new), marker };
        assert_eq!(data.marked_edges, Some(vec![edge(1, 2, 9), edge(2, 0, 9), edge(0, 1, 2)]));
    }

    #[test]
    fn faults_have_lines() {
        for (text, message) in [
            ("", "f:0: file ends before the number of cards"),
            ("MESH3D\n", "f:1: expected MESH2D as the first card, found \"MESH3D\""),
            ("MESH2D\nND x 0 0 0\n", "f:2: expected the number of a node, found \"x\""),
            ("MESH2D\nND 1 0 0\n", "f:2: expected the third coordinate of a node, found end of line"),
            ("MESH2D\nND 1 0 0 inf\n", "f:2: expected the third coordinate of a node, found \"inf\""),
            ("MESH2D\nND 1 NaN 0 0\n", "f:2: coordinate NaN of point 1 is not finite"),
            (
                "MESH2D\nND 1 0 0 0\nND 1 0 0 0\n",
                "f:3: expected a node number that is not in use, found \"1\"",
            ),
            ("MESH2D\nE4Q 1 1 2 3 4 1\n", "f:2: an element \"E4Q\" cannot be read"),
            (
                "MESH2D\nE3T 1 1 2 3 1\nE3T 2 1 1 9 1\nND 1 0 0 0\n",
                "f:2: expected the number of an existing node, found \"2\"\n\
                 f:3: expected the number of an existing node, found \"9\"",
            ),
            ("MESH2D\nE3T 1 1 2\n", "f:2: expected the number of a node, found end of line"),
            ("MESH2D\nE3T 1 1 2 3 a\n", "f:2: expected a material, found \"a\""),
            ("MESH2D\nNS 4 -5\n", "f:2: expected the number of an existing node, found \"4\""),
            (
                "MESH2D\nNS 4 5\n",
                "f:2: expected a negative number that ends the node string, found the end of the file",
            ),
            ("MESH2D\nNS 4 -5 b\n", "f:2: expected the number of the node string, found \"b\""),
        ] {
            assert_eq!(read(text).unwrap_err().to_string(), message, "{text}");
        }
    }
}
