//! Nodes that a file gives numbers and heights, and the elements and boundaries that go by these.
//!
//! Numbers may have gaps and any order, and what refers to a node may come before it. Vertices,
//! triangles and edges are in the order of the file.

use hexdel_geom::{DVec2, MarkedEdge, TriMesh, VertexId};

use crate::data::MeshData;
use crate::error::ReadError;
use crate::lines::{Fields, quote};
use crate::mend::Faults;
use crate::tags::Tags;

/// The most nodes or elements, so that 32-bit ids reach all of them.
const MAX_ITEMS: usize = u32::MAX as usize;

/// A number of a node, with its line.
pub(crate) type Reference = (u64, u64);

/// What was read of a mesh.
#[derive(Default)]
pub(crate) struct NumberedMesh {
    tags: Tags,
    vertices: Vec<DVec2>,
    heights: Vec<f64>,
    /// Three nodes each, with the line.
    triangles: Vec<([u64; 3], u64)>,
    /// Pairs of nodes, with their marker.
    edges: Vec<([Reference; 2], i32)>,
}

impl NumberedMesh {
    /// Reads a node: its number, x, y, and a third coordinate that is `up` times its height.
    pub(crate) fn node(&mut self, fields: &mut Fields<'_>, up: f64) -> Result<(), ReadError> {
        let field = fields.peek();
        let number = fields.integer("the number of a node")?;
        let position = fields.position("point", number)?;
        let third = fields.text();
        let height = fields.row.number(third, "the third coordinate of a node")?;
        if !height.is_finite() {
            return Err(fields.row.malformed("the third coordinate of a node", third));
        }
        Self::room("nodes", self.vertices.len(), fields)?;
        if !self.tags.add(number) {
            return Err(fields.row.malformed("a node number that is not in use", field));
        }
        self.vertices.push(position);
        self.heights.push(up * height);
        Ok(())
    }

    /// Reads the three nodes of a triangle.
    pub(crate) fn triangle(&mut self, fields: &mut Fields<'_>) -> Result<(), ReadError> {
        let mut corner = || fields.integer("the number of a node");
        let corners = [corner()?, corner()?, corner()?];
        Self::room("elements", self.triangles.len(), fields)?;
        self.triangles.push((corners, fields.row.line));
        Ok(())
    }

    fn room(section: &'static str, count: usize, fields: &Fields<'_>) -> Result<(), ReadError> {
        if count < MAX_ITEMS {
            return Ok(());
        }
        let (file, line) = (fields.row.file.to_owned(), fields.row.line);
        Err(ReadError::TooMany { file, line, section, limit: MAX_ITEMS as u64 })
    }

    /// Adds the edges between nodes that follow on each other.
    pub(crate) fn string(&mut self, nodes: &[Reference], marker: i32) {
        self.edges.extend(nodes.windows(2).map(|ends| ([ends[0], ends[1]], marker)));
    }

    /// The mesh. Heights that are all 0 are none.
    pub(crate) fn finish(self, file: &str) -> Result<MeshData, ReadError> {
        let vertex = |(number, line): Reference| match self.tags.index(number) {
            Some(index) => Ok(VertexId::new(index)),
            None => Err(ReadError::Malformed {
                file: file.to_owned(),
                line,
                column: 0,
                expected: "the number of an existing node",
                found: quote(&number.to_string()),
            }),
        };
        let mut faults = Faults::default();
        let mut triangles = Vec::with_capacity(self.triangles.len());
        for ([a, b, c], line) in self.triangles {
            let corners = || Ok([vertex((a, line))?, vertex((b, line))?, vertex((c, line))?]);
            triangles.extend(faults.note(corners())?);
        }
        let mut edges = Vec::with_capacity(self.edges.len());
        for ([a, b], marker) in self.edges {
            let edge = || Ok(MarkedEdge { ends: [vertex(a)?, vertex(b)?], marker });
            edges.extend(faults.note(edge())?);
        }
        faults.take()?;
        let mut data = MeshData::new(TriMesh { vertices: self.vertices, triangles });
        data.marked_edges = Some(edges).filter(|edges| !edges.is_empty());
        data.heights = Some(self.heights).filter(|heights| heights.iter().any(|&z| z != 0.0));
        Ok(data)
    }
}
