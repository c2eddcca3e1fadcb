//! Gmsh's `.msh` in text: reading versions 2 and 4.1.
//!
//! Points, lines and triangles are taken, other elements refused. The first physical
//! group of an element is its marker or region; the node data `marker` and
//! `input_index` and the element data `region`, as written here, go before them. All
//! other sections are left. Nodes and elements may be numbered in any way; vertices
//! are in the order of the file, edges and triangles in the order of their numbers.
//!
//! The crate `mshio` reads version 4.1 only, from a slice of the whole file.

use std::collections::HashMap;
use std::io::BufRead;

use hexdel_geom::{MarkedEdge, TriMesh, VertexId};
use rustc_hash::FxHashSet;

use crate::data::MeshData;
use crate::error::ReadError;
use crate::lines::{Comments, quote};
use crate::msh_out::{LINE, POINT, TRIANGLE};
use crate::promised::{NotPromised, PREFIX, Promised};
use crate::tags::{Sorted, Tags};
use crate::tokens::Tokens;

/// The most items, so that 32-bit ids reach all of them.
const MAX_ITEMS: u64 = u32::MAX as u64;

/// Reads a mesh.
pub(crate) fn read_msh(reader: impl BufRead, file: &str) -> Result<MeshData, ReadError> {
    let mut msh = Msh::new(Tokens::new(reader, file, Comments::Nowhere));
    while let Some(line) = msh.tokens.line_text()? {
        let Some(section) = line.strip_prefix('$') else {
            let found = quote(line);
            return Err(msh.tokens.malformed("a section, \"$..\"", Some(found)));
        };
        let section = section.to_owned();
        let read = msh.section(&section);
        // What was found in a section before comes first.
        msh.tokens.settle()?;
        read?;
    }
    msh.finish()
}

struct Msh<R> {
    tokens: Tokens<R>,
    /// 2 or 4, once it is known.
    version: u32,
    /// The groups of curves and surfaces, by dimension and number.
    groups: HashMap<(u64, i64), i32>,
    mesh: TriMesh,
    nodes: Tags,
    /// Vertices with the group of a point element.
    points: Vec<(u32, i32)>,
    edges: Sorted<MarkedEdge>,
    triangles: Sorted<([VertexId; 3], i32)>,
    markers: Option<Vec<(u64, f64)>>,
    inputs: Option<Vec<(u64, f64)>>,
    regions: Option<Vec<(u64, f64)>>,
    /// The rows of the section of that name, with the line of its end.
    exempt: Option<(Vec<(u64, f64)>, u64)>,
    promised: Option<Promised>,
}

impl<R: BufRead> Msh<R> {
    fn new(tokens: Tokens<R>) -> Self {
        Self {
            tokens,
            version: 0,
            groups: HashMap::new(),
            mesh: TriMesh::default(),
            nodes: Tags::default(),
            points: Vec::new(),
            edges: Sorted::default(),
            triangles: Sorted::default(),
            markers: None,
            inputs: None,
            regions: None,
            exempt: None,
            promised: None,
        }
    }

    fn section(&mut self, section: &str) -> Result<(), ReadError> {
        match (section, self.version) {
            ("MeshFormat", _) => self.format()?,
            (_, 0) => return Err(self.tokens.malformed("$MeshFormat as the first section", None)),
            ("Entities", 4) => self.entities()?,
            ("Nodes", 2) => self.nodes22()?,
            ("Nodes", _) => self.nodes41()?,
            ("Elements", 2) => self.elements22()?,
            ("Elements", _) => self.elements41()?,
            ("PhysicalNames", _) => return self.names(section),
            ("NodeData" | "ElementData", _) => return self.data(section),
            _ => return self.skip_to_end(section),
        }
        self.end(section)
    }

    fn format(&mut self) -> Result<(), ReadError> {
        let version: f64 = self.tokens.parse("the version of the format")?;
        self.version = match version {
            4.1 => 4,
            2.0..3.0 => 2,
            _ => return Err(self.tokens.unsupported(format!("version {version} of the format"))),
        };
        match self.tokens.parse("0 for text or 1 for binary")? {
            0 => {}
            1 => return Err(self.tokens.unsupported("the binary variant of the format".to_owned())),
            _ => return Err(self.tokens.malformed("0 for text or 1 for binary", None)),
        }
        self.tokens.parse::<u32>("the size of numbers")?;
        Ok(())
    }

    /// Among the names of groups, the one that says what the mesh was made to keep.
    fn names(&mut self, section: &str) -> Result<(), ReadError> {
        loop {
            let Some(line) = self.tokens.line_text()? else {
                return Err(self.tokens.malformed("the end of the section", None));
            };
            if line.strip_prefix("$End") == Some(section) {
                return Ok(());
            }
            let name = line.split('"').nth(1).filter(|name| name.starts_with(PREFIX)).map(str::to_owned);
            if let Some(name) = name {
                self.promise(&name)?;
            }
        }
    }

    /// What the name of a group says that the mesh was made to keep.
    fn promise(&mut self, name: &str) -> Result<(), ReadError> {
        let promised = name
            .parse()
            .map_err(|fault: NotPromised| self.tokens.malformed(fault.expected, Some(fault.found)))?;
        if self.promised.replace(promised).is_some() {
            return Err(self
                .tokens
                .malformed("one name of a group that begins with \"hexdel: \"", Some(quote(name))));
        }
        Ok(())
    }

    fn entities(&mut self) -> Result<(), ReadError> {
        const COUNT: &str = "a number of entities";
        let mut counts = [0; 4];
        for count in &mut counts {
            *count = self.tokens.count(COUNT, "entities", MAX_ITEMS)?;
        }
        for (dimension, count) in (0..).zip(counts) {
            for index in 0..count {
                self.tokens.item("entities", index, count)?;
                let tag: i64 = self.tokens.parse("the number of an entity")?;
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    self.tokens.parse::<f64>("a coordinate")?;
                }
                let groups: u64 = self.tokens.parse("a number of groups")?;
                for i in 0..groups {
                    let group = self.tokens.parse("the number of a group")?;
                    if i == 0 {
                        self.groups.insert((dimension, tag), group);
                    }
                }
                if dimension > 0 {
                    let bounds: u64 = self.tokens.parse(COUNT)?;
                    for _ in 0..bounds {
                        self.tokens.parse::<i64>("the number of an entity")?;
                    }
                }
            }
        }
        Ok(())
    }

    fn nodes22(&mut self) -> Result<(), ReadError> {
        let count = self.tokens.count("the number of nodes", "nodes", MAX_ITEMS)?;
        for index in 0..count {
            self.tokens.item("nodes", index, count)?;
            self.node_tag()?;
            self.node()?;
        }
        Ok(())
    }

    fn nodes41(&mut self) -> Result<(), ReadError> {
        let blocks: u64 = self.tokens.parse("the number of blocks")?;
        let count = self.tokens.count("the number of nodes", "nodes", MAX_ITEMS)?;
        self.tokens.parse::<u64>("the smallest number of a node")?;
        self.tokens.parse::<u64>("the largest number of a node")?;
        // A file may have several sections.
        let before = self.mesh.vertices.len();
        for block in 0..blocks {
            self.tokens.item("blocks of nodes", block, blocks)?;
            let dimension: usize = self.tokens.parse("the dimension of an entity")?;
            self.tokens.parse::<i64>("the number of an entity")?;
            let parametric: u32 = self.tokens.parse("0 or 1 for parametric nodes")?;
            let rest = count - (self.mesh.vertices.len() - before) as u64;
            let here = self.tokens.count("the number of nodes of the block", "announced nodes", rest)?;
            for index in 0..here {
                self.tokens.item("nodes", index, here)?;
                self.node_tag()?;
            }
            for index in 0..here {
                self.tokens.item("nodes", index, here)?;
                self.node()?;
                for _ in 0..if parametric == 1 { dimension.min(3) } else { 0 } {
                    self.tokens.parse::<f64>("a parameter")?;
                }
            }
        }
        self.complete("nodes", count, self.mesh.vertices.len() - before)
    }

    /// Blocks together must have what the section announces.
    fn complete(&self, section: &'static str, expected: u64, found: usize) -> Result<(), ReadError> {
        if found as u64 == expected {
            return Ok(());
        }
        let (file, line) = (self.tokens.file().to_owned(), self.tokens.line());
        Err(ReadError::Length { file, line, array: section, expected, found: found as u64 })
    }

    fn node_tag(&mut self) -> Result<(), ReadError> {
        let tag = self.tokens.parse("the number of a node")?;
        if self.nodes.add(tag) {
            return Ok(());
        }
        Err(self.tokens.malformed("a node number that is not in use", None))
    }

    fn node(&mut self) -> Result<(), ReadError> {
        let index = self.nodes.tag(self.mesh.vertices.len());
        let position = self.tokens.position(index, true);
        // A vertex in the place of one with a fault, so that numbers stay right.
        let position = self.tokens.note(position)?.unwrap_or_default();
        self.mesh.vertices.push(position);
        Ok(())
    }

    fn elements22(&mut self) -> Result<(), ReadError> {
        let count = self.tokens.count("the number of elements", "elements", MAX_ITEMS)?;
        for index in 0..count {
            self.tokens.item("elements", index, count)?;
            let tag = self.tokens.parse("the number of an element")?;
            let kind = self.tokens.parse("the type of an element")?;
            let tags: u64 = self.tokens.parse("the number of an element's tags")?;
            let mut group = 0;
            for i in 0..tags {
                let value = self.tokens.parse("a tag")?;
                if i == 0 {
                    group = value;
                }
            }
            self.element(tag, kind, group)?;
        }
        Ok(())
    }

    fn elements41(&mut self) -> Result<(), ReadError> {
        let blocks: u64 = self.tokens.parse("the number of blocks")?;
        let count = self.tokens.count("the number of elements", "elements", MAX_ITEMS)?;
        self.tokens.parse::<u64>("the smallest number of an element")?;
        self.tokens.parse::<u64>("the largest number of an element")?;
        let mut done = 0;
        for block in 0..blocks {
            self.tokens.item("blocks of elements", block, blocks)?;
            let dimension: u64 = self.tokens.parse("the dimension of an entity")?;
            let entity: i64 = self.tokens.parse("the number of an entity")?;
            let kind = self.tokens.parse("the type of an element")?;
            let here = self.tokens.count(
                "the number of elements of the block",
                "announced elements",
                count - done,
            )?;
            let group = self.groups.get(&(dimension, entity)).copied().unwrap_or(0);
            for index in 0..here {
                self.tokens.item("elements", index, here)?;
                let tag = self.tokens.parse("the number of an element")?;
                self.element(tag, kind, group)?;
            }
            done += here;
        }
        self.complete("elements", count, done as usize)
    }

    fn element(&mut self, tag: u64, kind: u64, group: i32) -> Result<(), ReadError> {
        match kind {
            POINT => {
                if let Some([vertex]) = self.corners()? {
                    self.points.push((vertex.index() as u32, group));
                }
            }
            LINE => {
                if let Some(ends) = self.corners()? {
                    self.edges.push(tag, MarkedEdge { ends, marker: group });
                }
            }
            TRIANGLE => {
                if let Some(corners) = self.corners()? {
                    self.triangles.push(tag, (corners, group));
                }
            }
            _ => return Err(self.tokens.unsupported(format!("an element of type {kind}"))),
        }
        Ok(())
    }

    /// So many vertices; none where there is a fault in one.
    fn corners<const N: usize>(&mut self) -> Result<Option<[VertexId; N]>, ReadError> {
        let mut corners = Some([VertexId::new(0); N]);
        for i in 0..N {
            let vertex = self.vertex();
            match (self.tokens.note(vertex)?, &mut corners) {
                (Some(vertex), Some(corners)) => corners[i] = vertex,
                _ => corners = None,
            }
        }
        Ok(corners)
    }

    fn vertex(&mut self) -> Result<VertexId, ReadError> {
        let tag: u64 = self.tokens.parse("the number of a node")?;
        match self.nodes.index(tag) {
            Some(index) => Ok(VertexId::new(index)),
            None => Err(self.tokens.malformed("the number of an existing node", None)),
        }
    }

    /// Reads the data that are known here, and skips others.
    fn data(&mut self, section: &str) -> Result<(), ReadError> {
        let mut name = String::new();
        let texts: u64 = self.tokens.parse("the number of names")?;
        for i in 0..texts {
            let text = self.tokens.line_text()?.unwrap_or_default().trim_matches('"').to_owned();
            if i == 0 {
                name = text;
            }
            self.tokens.item("names", i, texts)?;
        }
        let reals: u64 = self.tokens.parse("the number of real tags")?;
        for _ in 0..reals {
            self.tokens.parse::<f64>("a real tag")?;
        }
        let integers: u64 = self.tokens.parse("the number of integer tags")?;
        let [mut components, mut count] = [1, 0];
        for i in 0..integers {
            let value: u64 = self.tokens.parse("an integer tag")?;
            match i {
                1 => components = value,
                2 => count = value,
                _ => {}
            }
        }
        let known = matches!(
            (section, name.as_str()),
            ("NodeData", "marker" | "input_index") | ("ElementData", "region" | "exempt")
        );
        if !known || components != 1 {
            return self.skip_to_end(section);
        }
        let mut rows = Vec::new();
        for index in 0..count {
            self.tokens.item("data", index, count)?;
            rows.push((self.tokens.parse("the number of an item")?, self.tokens.parse("a number")?));
        }
        match name.as_str() {
            "marker" => self.markers = Some(rows),
            "region" => self.regions = Some(rows),
            "exempt" => {
                if self.exempt.replace((rows, self.tokens.line())).is_some() {
                    return Err(self.tokens.malformed("one section of element data \"exempt\"", None));
                }
            }
            _ => self.inputs = Some(rows),
        }
        self.end(section)
    }

    fn end(&mut self, section: &str) -> Result<(), ReadError> {
        match self.tokens.word()?.and_then(|word| word.strip_prefix("$End")) {
            Some(end) if end == section => Ok(()),
            _ => Err(self.tokens.malformed("the end of the section", None)),
        }
    }

    fn skip_to_end(&mut self, section: &str) -> Result<(), ReadError> {
        loop {
            match self.tokens.line_text()? {
                None => return Err(self.tokens.malformed("the end of the section", None)),
                Some(line) if line.strip_prefix("$End") == Some(section) => return Ok(()),
                Some(_) => {}
            }
        }
    }

    fn finish(self) -> Result<MeshData, ReadError> {
        let mut data = MeshData { mesh: self.mesh, ..MeshData::default() };
        let (vertices, file) = (data.mesh.vertices.len(), self.tokens.file());
        let (tags, triangles) = self.triangles.sorted();
        if let Some(mut promised) = self.promised {
            promised.exempt = exempt(self.exempt.as_ref(), &tags, file)?;
            data.promised = Some(promised);
        }
        if let Some(rows) = self.regions {
            let of_tag: HashMap<u64, usize> = tags.iter().enumerate().map(|(i, &tag)| (tag, i)).collect();
            data.regions = Some(column(&rows, triangles.len(), |tag| of_tag.get(&tag).copied()));
        } else if triangles.iter().any(|&(_, group)| group != 0) {
            data.regions = Some(triangles.iter().map(|&(_, group)| f64::from(group)).collect());
        }
        data.mesh.triangles = triangles.into_iter().map(|(corners, _)| corners).collect();
        let (_, edges) = self.edges.sorted();
        data.marked_edges = (!edges.is_empty()).then_some(edges);
        let node_column = |rows: &[_]| column(rows, vertices, |tag| self.nodes.index(tag));
        if let Some(rows) = &self.markers {
            let integers = node_column(rows).into_iter().map(|m| integer(m, file));
            data.vertex_markers = Some(integers.collect::<Result<_, _>>()?);
        } else if self.points.iter().any(|&(_, group)| group != 0) {
            let mut markers = vec![0; vertices];
            for (vertex, group) in self.points {
                markers[vertex as usize] = group;
            }
            data.vertex_markers = Some(markers);
        }
        if let Some(rows) = &self.inputs {
            // As a float can be cast: -1 is none, as is what is no index.
            let index =
                |number: f64| (number >= 0.0 && number <= f64::from(u32::MAX)).then_some(number as u32);
            let mut indices = vec![None; vertices];
            for (vertex, number) in rows {
                if let Some(vertex) = self.nodes.index(*vertex) {
                    indices[vertex] = index(*number);
                }
            }
            data.input_indices = Some(indices);
        }
        Ok(data)
    }
}

/// The triangles, by position among those of the numbers given, that a section has with 1.
fn exempt(section: Option<&(Vec<(u64, f64)>, u64)>, tags: &[u64], file: &str) -> Result<Vec<u32>, ReadError> {
    let Some((rows, line)) = section else { return Ok(Vec::new()) };
    let mut seen = FxHashSet::default();
    let marked = rows.iter().filter(|(_, value)| *value != 0.0).map(|&(tag, value)| {
        let triangle = tags.binary_search(&tag).ok().map(|t| t as u32);
        triangle.filter(|&t| value == 1.0 && seen.insert(t)).ok_or_else(|| ReadError::Malformed {
            file: file.to_owned(),
            line: *line,
            column: 0,
            expected: "0, or 1 for triangles that are exempt, each once",
            found: format!("{value} for element {tag}"),
        })
    });
    marked.collect()
}

/// The numbers of a section of data by item, 0 where there is none.
fn column(rows: &[(u64, f64)], count: usize, index: impl Fn(u64) -> Option<usize>) -> Vec<f64> {
    let mut numbers = vec![0.0; count];
    for &(tag, number) in rows {
        if let Some(index) = index(tag) {
            numbers[index] = number;
        }
    }
    numbers
}

fn integer(number: f64, file: &str) -> Result<i32, ReadError> {
    let integer = number as i32;
    if f64::from(integer) == number {
        return Ok(integer);
    }
    Err(ReadError::Unsupported { file: file.to_owned(), line: 0, what: format!("the marker {number}") })
}
