//! Wavefront's `.obj`: vertices (`v`) and triangles (`f`).
//!
//! Counted from 1, negative indices from the end. Texture coordinates, normals, groups,
//! materials, lines and points are left; a face must be a triangle. The format has no
//! place for markers and regions that other programs would know.

use std::io::{self, BufRead, Write};

use hexdel_geom::{TriMesh, VertexId};

use crate::data::MeshData;
use crate::error::ReadError;
use crate::lines::{Comments, Fields, Lines};
use crate::mend::Faults;
use crate::text::TextWriter;
use crate::view::MeshView;

/// The most vertices or triangles, so that 32-bit ids reach all of them.
const MAX_ITEMS: usize = u32::MAX as usize;

/// Statements without a bearing on the triangles.
const LEFT: [&str; 13] =
    ["vt", "vn", "vp", "g", "o", "s", "l", "p", "mtllib", "usemtl", "mg", "lod", "usemap"];

/// Writes a mesh.
pub(crate) fn write_obj(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    for p in &view.mesh.vertices {
        text.text("v ").number(p.x).text(" ").number(p.y);
        text.text(" 0\n").breathe()?;
    }
    for corners in &view.mesh.triangles {
        text.text("f");
        for corner in corners {
            text.text(" ").integer(corner.index() + 1);
        }
        text.text("\n").breathe()?;
    }
    text.finish()
}

/// Reads a mesh.
pub(crate) fn read_obj(reader: impl BufRead, file: &str) -> Result<MeshData, ReadError> {
    let mut lines = Lines::new(reader, file, Comments::Anywhere);
    let mut mesh = TriMesh::default();
    // Faces may come before their vertices.
    let (mut unresolved, mut faults) = (None, Faults::default());
    while let Some(row) = faults.note(lines.next_row())?.flatten() {
        let mut fields = row.fields();
        match fields.text() {
            Some("v") => {
                let index = mesh.vertices.len() as u64 + 1;
                mesh.vertices.extend(faults.note(fields.flat_position("point", index))?);
            }
            Some("f") => {
                let Some(corners) = faults.note(triangle(&mut fields, mesh.vertices.len()))? else {
                    continue;
                };
                let largest = corners.iter().max().map_or(0, |v| v.index());
                if largest >= mesh.vertices.len() {
                    unresolved = unresolved.max(Some((largest, row.line)));
                }
                mesh.triangles.push(corners);
            }
            Some(word) if LEFT.contains(&word) => {}
            word => {
                faults.note::<()>(Err(row.malformed("a statement of OBJ", word)))?;
            }
        }
        if mesh.vertices.len().max(mesh.triangles.len()) > MAX_ITEMS {
            let (file, line, limit) = (row.file.to_owned(), row.line, MAX_ITEMS as u64);
            return Err(ReadError::TooMany { file, line, section: "vertices or triangles", limit });
        }
    }
    faults.take()?;
    match unresolved {
        Some((index, line)) if index >= mesh.vertices.len() => Err(ReadError::IndexOutOfRange {
            file: file.to_owned(),
            line,
            column: 0,
            index: index as i64 + 1,
            first: 1,
            points: mesh.vertices.len() as u64,
        }),
        _ => Ok(MeshData::new(mesh)),
    }
}

/// The corners of a face, counted from 0, possibly of vertices still to come.
fn triangle(fields: &mut Fields<'_>, vertices: usize) -> Result<[VertexId; 3], ReadError> {
    let mut corner = || {
        let field = fields.text();
        // "7/1/2" is a vertex with its texture coordinate and normal.
        let number = field.and_then(|text| text.split('/').next()?.parse::<i64>().ok());
        let from_0 = match number {
            None | Some(0) => return Err(fields.row.malformed("the index of a vertex, from 1", field)),
            Some(index @ 1..) => index - 1,
            Some(index) => index.saturating_add(vertices as i64),
        };
        match usize::try_from(from_0) {
            Ok(index) if index < MAX_ITEMS => Ok(VertexId::new(index)),
            _ => Err(ReadError::IndexOutOfRange {
                file: fields.row.file.to_owned(),
                line: fields.row.line,
                column: fields.row.column_of(field),
                index: number.unwrap_or(0),
                first: 1,
                points: vertices as u64,
            }),
        }
    };
    let corners = [corner()?, corner()?, corner()?];
    match fields.text() {
        None => Ok(corners),
        Some(_) => Err(ReadError::Unsupported {
            file: fields.row.file.to_owned(),
            line: fields.row.line,
            what: "a face of more than 3 corners".to_owned(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<MeshData, ReadError> {
        read_obj(text.as_bytes(), "f")
    }

    #[test]
    fn indices_of_all_sorts() {
        let data =
            read("# cube\no a\nf 1/1 2//5 3/1/1\nv 0 0 0\nv 1 0 -0.0\nvn 0 0 1\nv 0 1 0\nf -3 -2 -1 # c\n");
        assert_eq!(data.unwrap().mesh.triangles, [[0, 1, 2].map(VertexId::new); 2]);
    }

    #[test]
    fn faults_have_lines() {
        for (text, message) in [
            ("v 0 0", "f:1: expected the z coordinate 0 of a plane mesh, found end of line"),
            ("v 0 0 1", "f:1: expected the z coordinate 0 of a plane mesh, found \"1\""),
            ("v 0 nan 0", "f:1: coordinate nan of point 1 is not finite"),
            ("v 0 0 0\nf 1 1", "f:2: expected the index of a vertex, from 1, found end of line"),
            ("v 0 0 0\nf 1 0 1", "f:2: expected the index of a vertex, from 1, found \"0\""),
            ("v 0 0 0\nf 1 1 1 1", "f:2: a face of more than 3 corners cannot be read"),
            ("v 0 0 0\nf 1 1 -2", "f:2: no point -2, there are 1 counted from 1"),
            ("f 1 1 2\nv 0 0 0", "f:1: no point 2, there are 1 counted from 1"),
            ("f 1 1 9223372036854775807", "f:1: no point 9223372036854775807, there are 0 counted from 1"),
            ("f 1 1 -9223372036854775808", "f:1: no point -9223372036854775808, there are 0 counted from 1"),
            (
                "v 0 x 0\nf 1 1 1\nv 0 y 0\n",
                "f:1: expected the y coordinate, found \"x\"\nf:3: expected the y coordinate, found \"y\"",
            ),
            ("curv 0 1", "f:1: expected a statement of OBJ, found \"curv\""),
        ] {
            assert_eq!(read(text).unwrap_err().to_string(), message);
        }
    }
}
