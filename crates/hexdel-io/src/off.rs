//! The Object File Format of Geomview, `.off`: vertices and triangles, counted from 0.
//!
//! Colours and normals (`COFF`, `NOFF`, ..) are left; a face must be a triangle. The
//! format has no place for markers and regions.

use std::io::{self, BufRead, Write};

use hexdel_geom::{TriMesh, VertexId};

use crate::data::MeshData;
use crate::error::ReadError;
use crate::lines::{Comments, Fields, Lines, Row};
use crate::mend::Faults;
use crate::text::TextWriter;
use crate::view::MeshView;

/// The most items reserved on the word of a header, about a megabyte.
const MAX_RESERVE: u64 = 1 << 16;

/// The most vertices or triangles, so that 32-bit ids reach all of them.
const MAX_ITEMS: u64 = u32::MAX as u64;

/// Writes a mesh.
pub(crate) fn write_off(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.text("OFF\n").integer(view.mesh.vertices.len()).text(" ");
    text.integer(view.mesh.triangles.len()).text(" 0\n");
    for p in &view.mesh.vertices {
        text.number(p.x).text(" ").number(p.y);
        text.text(" 0\n").breathe()?;
    }
    for corners in &view.mesh.triangles {
        text.text("3");
        for corner in corners {
            text.text(" ").integer(corner.index());
        }
        text.text("\n").breathe()?;
    }
    text.finish()
}

/// Reads a mesh.
pub(crate) fn read_off(reader: impl BufRead, file: &str) -> Result<MeshData, ReadError> {
    let mut lines = Lines::new(reader, file, Comments::Anywhere);
    let (plain, [vertices, triangles]) = header(&mut lines)?;
    let mut mesh = TriMesh::default();
    mesh.vertices.reserve(vertices.min(MAX_RESERVE) as usize);
    let mut faults = Faults::default();
    for index in 0..vertices {
        let Some(row) = faults.note(lines.due_row("vertices", index, vertices))? else { break };
        let mut fields = row.fields();
        let vertex = fields.flat_position("point", index);
        let vertex = vertex.and_then(|vertex| if plain { fields.end().map(|()| vertex) } else { Ok(vertex) });
        mesh.vertices.extend(faults.note(vertex)?);
    }
    mesh.triangles.reserve(triangles.min(MAX_RESERVE) as usize);
    for index in 0..triangles {
        let Some(row) = faults.note(lines.due_row("faces", index, triangles))? else { break };
        let corners = triangle(&mut row.fields(), vertices);
        mesh.triangles.extend(faults.note(corners)?);
    }
    faults.take()?;
    match lines.next_row()? {
        None => Ok(MeshData::new(mesh)),
        Some(row) => Err(row.malformed("the end of the file", row.fields().text())),
    }
}

/// Whether vertices are coordinates only, and the numbers of vertices and faces.
fn header<R: BufRead>(lines: &mut Lines<R>) -> Result<(bool, [u64; 2]), ReadError> {
    let mut fields = lines.due_row("header lines", 0, 1)?.fields();
    let word = fields.peek();
    let keyword = word.filter(|word| word.ends_with("OFF"));
    // Normals, colours, texture coordinates, in this order, each if its letter is
    // there.
    let plain = keyword.is_none_or(|word| word == "OFF");
    match keyword {
        None => {}
        Some("OFF" | "COFF" | "NOFF" | "CNOFF" | "STOFF" | "STCOFF" | "STNOFF" | "STCNOFF") => {
            fields.text();
            if fields.peek() == Some("BINARY") {
                return Err(unsupported(fields.row, "binary OFF"));
            }
            if fields.peek().is_none() {
                fields = lines.due_row("header lines", 0, 1)?.fields();
            }
        }
        Some(_) => return Err(unsupported(fields.row, "OFF of other than three dimensions")),
    }
    let mut count = |expected, section| {
        let count: u64 = fields.integer(expected)?;
        if count > MAX_ITEMS {
            let (file, line) = (fields.row.file.to_owned(), fields.row.line);
            return Err(ReadError::TooMany { file, line, section, limit: MAX_ITEMS });
        }
        Ok(count)
    };
    let counts = [count("the number of vertices", "vertices")?, count("the number of faces", "faces")?];
    // The number of edges is not used by anyone, and may be missing.
    fields.integer_or(0i64, "the number of edges")?;
    fields.end()?;
    Ok((plain, counts))
}

fn triangle(fields: &mut Fields<'_>, vertices: u64) -> Result<[VertexId; 3], ReadError> {
    let corners: u64 = fields.integer("the number of corners")?;
    if corners != 3 {
        return Err(unsupported(fields.row, &format!("a face of {corners} corners")));
    }
    let mut corner = || {
        let field = fields.peek();
        let index: i64 = fields.integer("the index of a point")?;
        match u64::try_from(index) {
            Ok(i) if i < vertices => Ok(VertexId::new(i as usize)),
            _ => Err(ReadError::IndexOutOfRange {
                file: fields.row.file.to_owned(),
                line: fields.row.line,
                column: fields.row.column_of(field),
                index,
                first: 0,
                points: vertices,
            }),
        }
    };
    // A colour may follow.
    Ok([corner()?, corner()?, corner()?])
}

fn unsupported(row: Row<'_>, what: &str) -> ReadError {
    ReadError::Unsupported { file: row.file.to_owned(), line: row.line, what: what.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<MeshData, ReadError> {
        read_off(text.as_bytes(), "f")
    }

    #[test]
    fn headers_of_all_sorts() {
        let body = "0 0 0\n1 0 0\n0 1 0 # c\n3 0 1 2 0.5 0.5 0.5\n";
        for head in ["OFF\n3 1 3\n", "OFF 3 1 3\n", "# a\n3 1\n", "COFF\n\n3 1 0\n"] {
            let data = read(&format!("{head}{body}")).unwrap();
            assert_eq!(data.mesh.triangles, [[0, 1, 2].map(VertexId::new)], "{head}");
        }
        let coloured = "COFF\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n";
        assert_eq!(read(coloured).unwrap().mesh.vertices.len(), 3);
    }

    #[test]
    fn faults_have_lines() {
        for (text, message) in [
            ("", "f:0: file ends after 0 of 1 header lines"),
            ("OFF\n", "f:1: file ends after 0 of 1 header lines"),
            ("OFF BINARY\n", "f:1: binary OFF cannot be read"),
            ("4OFF\n", "f:1: OFF of other than three dimensions cannot be read"),
            ("OFF\n1", "f:2: expected the number of faces, found end of line"),
            ("OFF\n1000000000000 1 1", "f:2: more than 4294967295 vertices"),
            ("OFF\n4000000000 1 1\n0 0 0", "f:3: file ends after 1 of 4000000000 vertices"),
            ("OFF\n1 0 0\n0 0 1", "f:3: expected the z coordinate 0 of a plane mesh, found \"1\""),
            ("OFF\n1 0 0\n0 0 0 1", "f:3: expected end of line, found \"1\""),
            ("OFF\n1 1 0\n0 0 0\n4 0 0 0 0", "f:4: a face of 4 corners cannot be read"),
            ("OFF\n1 1 0\n0 0 0\n3 0 0 1", "f:4: no point 1, there are 1 counted from 0"),
            ("OFF\n1 1 0\n0 0 0\n3 0 0", "f:4: expected the index of a point, found end of line"),
            ("OFF\n1 0 0\n0 0 0\n3 0 0 0", "f:4: expected the end of the file, found \"3\""),
            (
                "OFF\n3 2 0\n0 x 0\n1 0 0\n0 y 0\n3 0 1 7\n3 0 1 8\n",
                "f:3: expected the y coordinate, found \"x\"\nf:5: expected the y coordinate, found \"y\"",
            ),
            (
                "OFF\n1 2 0\n0 0 0\n3 0 0 7\n3 0 0 8\n",
                "f:4: no point 7, there are 1 counted from 0\nf:5: no point 8, there are 1 counted from 0",
            ),
            ("OFF\n3 0 0\n0 x 0\n", "f:3: expected the y coordinate, found \"x\""),
        ] {
            assert_eq!(read(text).unwrap_err().to_string(), message);
        }
    }
}
