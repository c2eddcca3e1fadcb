//! Medit's `.mesh`, in text: vertices, edges and triangles with references.
//!
//! Counted from 1. References are integers: the markers of vertices and edges and the
//! regions of triangles, 0 being none. `Corners`, `Ridges` and their kin are left; a
//! file with other cells than triangles is refused.

use std::io::{self, BufRead, Write};

use hexdel_geom::{DVec2, MarkedEdge, TriMesh, VertexId};

use crate::data::MeshData;
use crate::error::{ReadError, WriteError};
use crate::lines::Comments;
use crate::mend::Faults;
use crate::text::TextWriter;
use crate::tokens::Tokens;
use crate::view::MeshView;

/// The most items, so that 32-bit ids reach all of them.
const MAX_ITEMS: u64 = u32::MAX as u64;

/// Sections of integers that are left, and how many make an item.
const LISTS: [(&str, u32); 6] = [
    ("Corners", 1),
    ("RequiredVertices", 1),
    ("Ridges", 1),
    ("RequiredEdges", 1),
    ("RequiredTriangles", 1),
    // Dimension, triangle, orientation, reference: BAMG's.
    ("SubDomainFromMesh", 4),
];

/// Finds a region that is no integer and hence no reference, nor a material of `.2dm`.
pub(crate) fn check_regions(view: &MeshView<'_>, format: &'static str, file: &str) -> Result<(), WriteError> {
    let fits = |region: f64| f64::from(region as i32) == region;
    match view.regions.unwrap_or(&[]).iter().position(|&region| !fits(region)) {
        None => Ok(()),
        Some(index) => Err(WriteError::Unrepresentable {
            file: file.to_owned(),
            format,
            item: "region of triangle",
            index,
            found: view.regions.unwrap_or(&[])[index],
        }),
    }
}

/// Writes a mesh whose regions are integers.
pub(crate) fn write_medit(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    // Version 2 has doubles.
    text.text("MeshVersionFormatted 2\nDimension 2\nVertices\n");
    text.integer(view.mesh.vertices.len()).text("\n");
    for (i, p) in view.mesh.vertices.iter().enumerate() {
        text.number(p.x).text(" ").number(p.y).text(" ");
        text.integer(view.vertex_markers.map_or(0, |markers| markers[i])).text("\n").breathe()?;
    }
    if let Some(edges) = view.marked_edges {
        text.text("Edges\n").integer(edges.len()).text("\n");
        for edge in edges {
            for end in edge.ends {
                text.integer(end.index() + 1).text(" ");
            }
            text.integer(edge.marker).text("\n").breathe()?;
        }
    }
    text.text("Triangles\n").integer(view.mesh.triangles.len()).text("\n");
    for (i, corners) in view.mesh.triangles.iter().enumerate() {
        for corner in corners {
            text.integer(corner.index() + 1).text(" ");
        }
        text.integer(view.regions.map_or(0, |regions| regions[i] as i32)).text("\n").breathe()?;
    }
    text.text("End\n").finish()
}

/// Reads a mesh. References that are all 0 are none.
pub(crate) fn read_medit(reader: impl BufRead, file: &str) -> Result<MeshData, ReadError> {
    let mut tokens = Tokens::new(reader, file, Comments::Anywhere);
    if !matches!(tokens.word()?, Some("MeshVersionFormatted" | "MeshVersionUnformatted")) {
        return Err(tokens.malformed("MeshVersionFormatted", None));
    }
    tokens.parse::<u32>("the version of the format")?;
    let mut parts = Parts::default();
    while let Some(word) = tokens.word()? {
        let word = word.to_owned();
        match word.as_str() {
            "End" => break,
            "Dimension" => match tokens.parse("dimension 2 or 3")? {
                2 => parts.heights = false,
                3 => parts.heights = true,
                _ => return Err(tokens.malformed("dimension 2 or 3", None)),
            },
            "Vertices" => parts.vertices(&mut tokens)?,
            "Edges" => parts.edges(&mut tokens)?,
            "Triangles" => parts.triangles(&mut tokens)?,
            "Quadrilaterals" | "Tetrahedra" | "Hexahedra" => {
                if tokens.parse::<u64>("a number of cells")? > 0 {
                    return Err(tokens.unsupported(format!("a section {word}")));
                }
            }
            other => match LISTS.iter().find(|(name, _)| *name == other) {
                Some(&(_, columns)) => skip(&mut tokens, columns)?,
                None => return Err(tokens.malformed("a section of a Medit file", None)),
            },
        }
    }
    parts.finish(&mut tokens)
}

/// What has been read.
#[derive(Default)]
struct Parts {
    heights: bool,
    vertices: Vec<DVec2>,
    markers: Vec<i32>,
    edges: Vec<MarkedEdge>,
    triangles: Vec<[VertexId; 3]>,
    regions: Vec<f64>,
    /// Indices of vertices, from 1, that were not there yet, with their lines.
    ahead: Vec<(u32, u64)>,
}

impl Parts {
    fn vertices<R: BufRead>(&mut self, tokens: &mut Tokens<R>) -> Result<(), ReadError> {
        let count = tokens.count("the number of vertices", "vertices", MAX_ITEMS)?;
        for index in 0..count {
            tokens.item("vertices", index, count)?;
            let position = tokens.position(index + 1, self.heights);
            let marker = tokens.parse::<i32>("a reference");
            self.vertices.extend(tokens.note(position)?);
            self.markers.extend(tokens.note(marker)?);
        }
        Ok(())
    }

    fn edges<R: BufRead>(&mut self, tokens: &mut Tokens<R>) -> Result<(), ReadError> {
        let count = tokens.count("the number of edges", "edges", MAX_ITEMS)?;
        for index in 0..count {
            tokens.item("edges", index, count)?;
            let ends = self.corners(tokens);
            let marker = tokens.parse::<i32>("a reference");
            let (ends, marker) = (tokens.note(ends)?, tokens.note(marker)?);
            self.edges.extend(ends.zip(marker).map(|(ends, marker)| MarkedEdge { ends, marker }));
        }
        Ok(())
    }

    fn triangles<R: BufRead>(&mut self, tokens: &mut Tokens<R>) -> Result<(), ReadError> {
        let count = tokens.count("the number of triangles", "triangles", MAX_ITEMS)?;
        for index in 0..count {
            tokens.item("triangles", index, count)?;
            let corners = self.corners(tokens);
            let region = tokens.parse::<i32>("a reference").map(f64::from);
            self.triangles.extend(tokens.note(corners)?);
            self.regions.extend(tokens.note(region)?);
        }
        Ok(())
    }

    /// So many vertices, all of which are read whatever they are.
    fn corners<R: BufRead, const N: usize>(
        &mut self,
        tokens: &mut Tokens<R>,
    ) -> Result<[VertexId; N], ReadError> {
        let mut all = Ok([VertexId::new(0); N]);
        for i in 0..N {
            match (self.vertex(tokens), &mut all) {
                (Ok(vertex), Ok(corners)) => corners[i] = vertex,
                (Err(error), Ok(_)) => all = Err(error),
                (_, Err(_)) => {}
            }
        }
        all
    }

    /// A vertex, which may be still to come.
    fn vertex<R: BufRead>(&mut self, tokens: &mut Tokens<R>) -> Result<VertexId, ReadError> {
        let index: u32 = tokens.parse("the index of a vertex, from 1")?;
        let Some(from_0) = index.checked_sub(1) else {
            return Err(tokens.malformed("the index of a vertex, from 1", None));
        };
        if index as usize > self.vertices.len() {
            self.ahead.push((index, tokens.line()));
        }
        Ok(VertexId::new(from_0 as usize))
    }

    fn finish<R: BufRead>(self, tokens: &mut Tokens<R>) -> Result<MeshData, ReadError> {
        tokens.settle()?;
        let points = self.vertices.len() as u64;
        let mut faults = Faults::default();
        for &(index, line) in self.ahead.iter().filter(|ahead| u64::from(ahead.0) > points) {
            let (file, index) = (tokens.file().to_owned(), i64::from(index));
            let missing = ReadError::IndexOutOfRange { file, line, column: 0, index, first: 1, points };
            faults.note::<()>(Err(missing))?;
        }
        faults.take()?;
        Ok(MeshData {
            mesh: TriMesh { vertices: self.vertices, triangles: self.triangles },
            vertex_markers: self.markers.iter().any(|&m| m != 0).then_some(self.markers),
            regions: self.regions.iter().any(|&r| r != 0.0).then_some(self.regions),
            marked_edges: (!self.edges.is_empty()).then_some(self.edges),
            ..MeshData::default()
        })
    }
}

fn skip<R: BufRead>(tokens: &mut Tokens<R>, columns: u32) -> Result<(), ReadError> {
    let count: u64 = tokens.parse("the number of items")?;
    for index in 0..count {
        tokens.item("items", index, count)?;
        for _ in 0..columns {
            tokens.parse::<i64>("an integer")?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<MeshData, ReadError> {
        read_medit(text.as_bytes(), "f")
    }

    #[test]
    fn sections_in_any_order() {
        let text = "MeshVersionFormatted 1\n# c\nDimension\n3\nTriangles 1 1 2 3 0 Corners 2 1 2\nSubDomainFromMesh 2 3 1 1 0 3 1 -1 7\n\
                    Vertices 3\n0 0 0 5\n1 0 0 0\n0 1 0 0\nTetrahedra 0\nEnd\nwhatever";
        let data = read(text).unwrap();
        assert_eq!(data.mesh.triangles, [[0, 1, 2].map(VertexId::new)]);
        assert_eq!(data.vertex_markers, Some(vec![5, 0, 0]));
        assert_eq!(data.regions, None);
    }

    #[test]
    fn faults_have_lines() {
        for (text, message) in [
            ("", "f: expected MeshVersionFormatted, found the end of the file"),
            ("Vertices", "f:1: expected MeshVersionFormatted, found \"Vertices\""),
            ("Dimension 4", "f:2: expected dimension 2 or 3, found \"4\""),
            ("Vertices 1000000000000", "f:2: more than 4294967295 vertices"),
            ("Vertices 2\n0 0 0", "f:3: file ends after 1 of 2 vertices"),
            ("Vertices 1\n0 0", "f:3: expected a reference, found the end of the file"),
            (
                "Dimension 3 Vertices 1\n0 0 1 0",
                "f:3: expected the z coordinate 0 of a plane mesh, found \"1\"",
            ),
            (
                "Vertices 3\n0 x 0\n0 0 0\ny z w\nEnd",
                "f:3: expected the y coordinate, found \"x\"\nf:5: expected the x coordinate, found \"y\"\n\
                 f:5: expected a reference, found \"w\"",
            ),
            (
                "Vertices 3\n0 x\n0 0 0\n1 0 0\nTriangles 1 2 3\n",
                "f:3: expected the y coordinate, found \"x\"\nf:6: expected a reference, found \"Triangles\"",
            ),
            (
                "Vertices 1 0 0 0\nTriangles 2\n1 2 3 0\n1 7 8 0",
                "f:4: no point 2, there are 1 counted from 1\nf:4: no point 3, there are 1 counted from 1\n\
                 f:5: no point 7, there are 1 counted from 1\nf:5: no point 8, there are 1 counted from 1",
            ),
            ("Vertices 1\n0 inf 0", "f:3: coordinate inf of point 1 is not finite"),
            (
                "Triangles 1 1 2 3 0",
                "f:2: no point 1, there are 0 counted from 1\nf:2: no point 2, there are 0 counted from 1\n\
                 f:2: no point 3, there are 0 counted from 1",
            ),
            ("Triangles 1 1 0 3 0", "f:2: expected the index of a vertex, from 1, found \"0\""),
            ("Edges 1 1 -1", "f:2: expected the index of a vertex, from 1, found \"-1\""),
            ("Quadrilaterals 1\n1 2 3 4 0", "f:2: a section Quadrilaterals cannot be read"),
            ("Ridges 99999999999\n1", "f:3: file ends after 1 of 99999999999 items"),
            ("Faces 1", "f:2: expected a section of a Medit file, found \"Faces\""),
        ] {
            let is_headed = !["f: ", "f:1"].iter().any(|start| message.starts_with(start));
            let head = if is_headed { "MeshVersionFormatted 2\n" } else { "" };
            assert_eq!(read(&format!("{head}{text}")).unwrap_err().to_string(), message);
        }
    }
}
