//! VTK's XML format of unstructured grids (`.vtu`): reading triangles.
//!
//! Taken are triangles, with the cell data `region` and the point data `marker`, `height` and
//! `input_index`, from any number of pieces; lines become marked edges, with the cell
//! data `marker`; single vertices are left, other cells refused. Arrays may be text,
//! base64, or appended, raw or in base64, in either byte order and compressed by zlib;
//! see [`vtu_array`](crate::vtu_array).
//!
//! `quick-xml` cuts the text into tags. `vtkio` holds all arrays of a file whether they
//! are wanted or not, and its faults have no lines.

use std::cell::Cell;
use std::io::{self, BufRead, Read};
use std::rc::Rc;

use hexdel_geom::{AngleBounds, DVec2, MarkedEdge, VertexId};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use crate::data::MeshData;
use crate::error::ReadError;
use crate::lines::clip_message;
use crate::promised::{Promised, PromisedDomain};
use crate::vtu_array::{Appended, Array, Encoding, Values};

/// VTK's numbers of cell types.
const VERTEX: f64 = 1.0;
const LINE: f64 = 3.0;
const TRIANGLE: f64 = 5.0;

/// What field data of exempt triangles must be.
const EXEMPT: &str = "numbers of triangles, each once, as hexdel_exempt";

/// Numbers of field data that are quoted.
const SHOWN: usize = 5;

/// The most items, so that 32-bit ids reach all of them.
const MAX_ITEMS: usize = u32::MAX as usize;

/// Reads a mesh.
pub(crate) fn read_vtu(reader: impl BufRead, file: &str) -> Result<MeshData, ReadError> {
    let line = Rc::new(Cell::new(1));
    let counting = Counting { reader, line: Rc::clone(&line) };
    let mut grid = Grid {
        file: file.to_owned(),
        line,
        encoding: None,
        pieces: Vec::new(),
        fields: Vec::new(),
        place: Vec::new(),
    };
    let appended = grid.tags(Reader::from_reader(counting))?;
    grid.mesh(Appended::new(appended))
}

/// Counts the lines that have been read.
struct Counting<R> {
    reader: R,
    line: Rc<Cell<u64>>,
}

impl<R: BufRead> Read for Counting<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.reader.read(buffer)?;
        self.line.set(self.line.get() + newlines(&buffer[..count]));
        Ok(count)
    }
}

impl<R: BufRead> BufRead for Counting<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.reader.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        // What has been filled is still there.
        if let Ok(buffer) = self.reader.fill_buf() {
            let lines = newlines(&buffer[..amount.min(buffer.len())]);
            self.line.set(self.line.get() + lines);
        }
        self.reader.consume(amount);
    }
}

fn newlines(bytes: &[u8]) -> u64 {
    bytes.iter().map(|&b| u64::from(b == b'\n')).sum()
}

/// The arrays of a piece that are wanted.
#[derive(Default)]
struct Piece {
    arrays: Vec<(Want, Array)>,
}

/// What an array is for.
#[derive(Clone, Copy, PartialEq)]
enum Want {
    Points,
    Connectivity,
    Offsets,
    Types,
    Markers,
    Inputs,
    Heights,
    Regions,
    EdgeMarkers,
    Bounds,
    Domain,
    Exempt,
}

struct Grid {
    file: String,
    line: Rc<Cell<u64>>,
    /// How the arrays are stored, as soon as the file says so.
    encoding: Option<Encoding>,
    pieces: Vec<Piece>,
    /// Field data, with their lines.
    fields: Vec<(Want, Array, u64)>,
    /// The names of the tags around.
    place: Vec<String>,
}

impl Grid {
    /// Reads all tags; the appended data are returned.
    fn tags<R: BufRead>(&mut self, mut reader: Reader<Counting<R>>) -> Result<Vec<u8>, ReadError> {
        let mut buffer = Vec::new();
        // The array whose text is awaited, and how many tags are around that text.
        let mut awaited: Option<(Want, Array, usize)> = None;
        loop {
            buffer.clear();
            let event = reader.read_event_into(&mut buffer).map_err(|error| match error {
                quick_xml::Error::Io(source) => {
                    ReadError::Io { file: self.file.clone(), source: io::Error::new(source.kind(), source) }
                }
                other => self.fault(other.to_string()),
            })?;
            match event {
                Event::Start(tag) if tag.name().as_ref() == "AppendedData" => {
                    return self.appended(&tag, reader.into_inner());
                }
                Event::Start(tag) => {
                    // Within an array stand notes about it at most.
                    if awaited.is_none() {
                        awaited = self.open(&tag)?.map(|(want, array)| (want, array, self.place.len() + 1));
                    }
                    self.place.push(tag.name().as_ref().to_owned());
                }
                Event::Empty(tag) if awaited.is_none() => {
                    if let Some((want, array)) = self.open(&tag)? {
                        self.keep(want, array)?;
                    }
                }
                Event::Text(text) => {
                    if let Some((_, array, depth)) = &mut awaited
                        && *depth == self.place.len()
                    {
                        array.text(text.as_bytes()).map_err(|fault| self.fault(fault))?;
                    }
                }
                Event::End(_) => {
                    let depth = self.place.len();
                    self.place.pop();
                    if let Some((want, array, _)) = awaited.take_if(|(.., of_array)| *of_array == depth) {
                        self.keep(want, array)?;
                    }
                }
                Event::Eof => return self.end(),
                _ => {}
            }
        }
    }

    fn end(&self) -> Result<Vec<u8>, ReadError> {
        if self.encoding.is_none() {
            return Err(self.fault("no VTKFile".to_owned()));
        }
        if !self.place.is_empty() {
            return Err(self.fault("the file ends within a tag".to_owned()));
        }
        Ok(Vec::new())
    }

    /// Looks at a tag that opens; an array that is wanted is returned.
    fn open(&mut self, tag: &BytesStart<'_>) -> Result<Option<(Want, Array)>, ReadError> {
        match tag.name().as_ref() {
            "VTKFile" => {
                let kind = self.attribute(tag, "type")?.unwrap_or_default();
                if kind != "UnstructuredGrid" {
                    return Err(self.fault(format!("expected an UnstructuredGrid, found {kind:?}")));
                }
                let [order, header, compressor] =
                    ["byte_order", "header_type", "compressor"].map(|name| self.attribute(tag, name));
                let encoding = Encoding::new(order?.as_deref(), header?.as_deref(), compressor?.as_deref());
                self.encoding = Some(encoding.map_err(|fault| self.fault(fault))?);
            }
            _ if self.encoding.is_none() => return Err(self.fault("expected a VTKFile".to_owned())),
            "Piece" => self.pieces.push(Piece::default()),
            "DataArray" => {
                let name = self.attribute(tag, "Name")?.unwrap_or_default();
                let Some(want) = self.want(&name) else {
                    return Ok(None);
                };
                let [kind, format, offset, components] =
                    ["type", "format", "offset", "NumberOfComponents"].map(|name| self.attribute(tag, name));
                let components = components?;
                if want == Want::Points && components.as_deref() != Some("3") {
                    return Err(self.fault("expected points of 3 components".to_owned()));
                }
                let array = Array::new(kind?.as_deref(), format?.as_deref(), offset?.as_deref());
                return array.map(|array| Some((want, array))).map_err(|fault| self.fault(fault));
            }
            _ => {}
        }
        Ok(None)
    }

    /// What the array of that name is for, where it stands.
    fn want(&self, name: &str) -> Option<Want> {
        Some(match (self.place.last().map_or("", String::as_str), name) {
            ("Points", _) => Want::Points,
            ("Cells", "connectivity") => Want::Connectivity,
            ("Cells", "offsets") => Want::Offsets,
            ("Cells", "types") => Want::Types,
            ("PointData", "marker") => Want::Markers,
            ("PointData", "input_index") => Want::Inputs,
            ("PointData", "height") => Want::Heights,
            ("CellData", "region") => Want::Regions,
            ("CellData", "marker") => Want::EdgeMarkers,
            ("FieldData", "hexdel_bounds") => Want::Bounds,
            ("FieldData", "hexdel_domain") => Want::Domain,
            ("FieldData", "hexdel_exempt") => Want::Exempt,
            _ => return None,
        })
    }

    fn keep(&mut self, want: Want, array: Array) -> Result<(), ReadError> {
        if matches!(want, Want::Bounds | Want::Domain | Want::Exempt) {
            if self.fields.iter().any(|(w, ..)| *w == want) {
                return Err(self.fault("the file has this field data twice".to_owned()));
            }
            self.fields.push((want, array, self.line.get()));
            return Ok(());
        }
        let fault = match self.pieces.last_mut() {
            Some(piece) if piece.arrays.iter().all(|(w, _)| *w != want) => {
                piece.arrays.push((want, array));
                return Ok(());
            }
            Some(_) => "the Piece has this array twice",
            None => "an array outside a Piece",
        };
        Err(self.fault(fault.to_owned()))
    }

    fn attribute(&self, tag: &BytesStart<'_>, name: &str) -> Result<Option<String>, ReadError> {
        let found = tag.try_get_attribute(name).map_err(|error| self.fault(error.to_string()))?;
        let Some(attribute) = found else {
            return Ok(None);
        };
        // Names and numbers only: nothing in them is ever escaped.
        Ok(Some(attribute.value.into_owned()))
    }

    /// The bytes of the appended data, decoded if they are base64 of which offsets
    /// count the letters.
    fn appended<R: BufRead>(
        &mut self,
        tag: &BytesStart<'_>,
        mut rest: Counting<R>,
    ) -> Result<Vec<u8>, ReadError> {
        let kind = self.attribute(tag, "encoding")?;
        if let Some(encoding) = &mut self.encoding {
            encoding.appended_raw = match kind.as_deref() {
                Some("raw") => true,
                Some("base64") => false,
                _ => return Err(self.fault("appended data neither raw nor base64".to_owned())),
            };
        }
        let at = self.line.get();
        let mut bytes = Vec::new();
        rest.read_to_end(&mut bytes).map_err(|source| ReadError::Io { file: self.file.clone(), source })?;
        // Faults of the arrays are reported where the data begin.
        self.line.set(at);
        match bytes.iter().position(|b| !b.is_ascii_whitespace()) {
            Some(start) if bytes[start] == b'_' => {
                bytes.drain(..=start);
                Ok(bytes)
            }
            _ => Err(self.fault("appended data do not begin with \"_\"".to_owned())),
        }
    }

    fn fault(&self, message: String) -> ReadError {
        ReadError::Xml { file: self.file.clone(), line: self.line.get(), message: clip_message(message) }
    }

    /// Puts the pieces together.
    fn mesh(mut self, mut appended: Appended) -> Result<MeshData, ReadError> {
        let mut data = MeshData::default();
        let mut columns = Columns::default();
        let Some(encoding) = self.encoding.take() else {
            return Err(self.fault("no VTKFile".to_owned()));
        };
        for piece in std::mem::take(&mut self.pieces) {
            self.piece(piece, &encoding, &mut appended, &mut data, &mut columns)?;
        }
        columns.settle(&mut data);
        data.promised = self.promised(&encoding, &mut appended, data.mesh.triangles.len())?;
        Ok(data)
    }

    /// What field data say that a mesh of so many triangles was made to keep.
    fn promised(
        &mut self,
        encoding: &Encoding,
        appended: &mut Appended,
        triangles: usize,
    ) -> Result<Option<Promised>, ReadError> {
        let mut values: Vec<(Want, Vec<f64>)> = Vec::new();
        let mut last = None;
        for (want, array, line) in std::mem::take(&mut self.fields) {
            let found = array.values(encoding, appended).map_err(|fault| self.fault(fault))?;
            values.push((want, (0..found.len()).map(|i| found.get(i)).collect()));
            last = last.max(Some(line));
        }
        let Some(line) = last else { return Ok(None) };
        let of = |want| values.iter().find(|(w, _)| *w == want).map_or(&[][..], |(_, v)| v);
        let fault = |expected, found: &[f64]| {
            let found = found.iter().take(SHOWN).map(ToString::to_string).collect::<Vec<_>>().join(" ");
            let found = if found.is_empty() { "none".to_owned() } else { found };
            ReadError::Malformed { file: self.file.clone(), line, column: 0, expected, found }
        };
        let (bounds, domain) = (of(Want::Bounds), of(Want::Domain));
        let pair = |i: usize| AngleBounds::new(*bounds.get(i)?, *bounds.get(i + 1)?).ok();
        let (Some(near), Some(far), 4) = (pair(0), pair(2), bounds.len()) else {
            return Err(fault("four bounds of angles as hexdel_bounds", bounds));
        };
        let &[number] = domain else { return Err(fault("one number as hexdel_domain", domain)) };
        let Some(domain) = PromisedDomain::of_number(number) else {
            return Err(fault("the number of a domain as hexdel_domain", domain));
        };
        let mut promised = Promised { near, far, domain, exempt: Vec::new() };
        for &t in of(Want::Exempt) {
            let number = Some(t as u32).filter(|&number| f64::from(number) == t);
            promised.exempt.push(number.ok_or_else(|| fault(EXEMPT, &[t]))?);
        }
        match promised.wrong_triangle(triangles) {
            Some(wrong) => Err(fault(EXEMPT, &[f64::from(wrong)])),
            None => Ok(Some(promised)),
        }
    }

    fn piece(
        &self,
        piece: Piece,
        encoding: &Encoding,
        appended: &mut Appended,
        data: &mut MeshData,
        columns: &mut Columns,
    ) -> Result<(), ReadError> {
        let mut arrays: Vec<(Want, Values)> = Vec::new();
        for (want, array) in piece.arrays {
            let values = array.values(encoding, appended).map_err(|fault| self.fault(fault))?;
            arrays.push((want, values));
        }
        let take = |want| arrays.iter().find(|(w, _)| *w == want).map(|(_, values)| values);
        let first = data.mesh.vertices.len();
        if let Some(points) = take(Want::Points) {
            self.points(points, data)?;
        }
        let here = data.mesh.vertices.len() - first;
        self.cells(take, [first, here], data, columns)?;
        columns.points(self, [Want::Markers, Want::Inputs, Want::Heights].map(take), here)
    }

    /// Takes the cells of a piece whose points are those from `first` on, `here` of
    /// them.
    fn cells<'v>(
        &self,
        take: impl Fn(Want) -> Option<&'v Values>,
        [first, here]: [usize; 2],
        data: &mut MeshData,
        columns: &mut Columns,
    ) -> Result<(), ReadError> {
        let Some(types) = take(Want::Types).filter(|types| types.len() > 0) else {
            return Ok(());
        };
        let (Some(connectivity), Some(offsets)) = (take(Want::Connectivity), take(Want::Offsets)) else {
            return Err(self.fault("cells without connectivity or offsets".to_owned()));
        };
        self.same_length("offsets", types.len(), offsets.len())?;
        let [regions, markers] = [take(Want::Regions), take(Want::EdgeMarkers)];
        for (name, column) in [("regions", regions), ("cell markers", markers)] {
            self.same_length(name, types.len(), column.map_or(types.len(), Values::len))?;
        }
        let mut start = 0;
        for cell in 0..types.len() {
            let end = self.integer(offsets.get(cell), "an offset")?;
            let corners = usize::try_from(end).ok().filter(|&end| start <= end && end <= connectivity.len());
            let Some(end) = corners else {
                return Err(
                    self.fault(format!("cell {cell} ends at {end} of {} corners", connectivity.len()))
                );
            };
            let corner = |i: usize| self.corner(connectivity.get(start + i), first, here);
            match (types.get(cell), end - start) {
                (TRIANGLE, 3) => {
                    data.mesh.triangles.push([corner(0)?, corner(1)?, corner(2)?]);
                    columns.regions.push(regions.map(|regions| regions.get(cell)));
                }
                (LINE, 2) => {
                    let marker = markers.map_or(Ok(0), |markers| self.marker(markers.get(cell)))?;
                    columns.edges.push(MarkedEdge { ends: [corner(0)?, corner(1)?], marker });
                }
                (VERTEX, 1) => {}
                (kind, n) => {
                    let (file, what) = (self.file.clone(), format!("a cell of type {kind} with {n} corners"));
                    return Err(ReadError::Unsupported { file, line: self.line.get(), what });
                }
            }
            start = end;
        }
        Ok(())
    }

    fn points(&self, points: &Values, data: &mut MeshData) -> Result<(), ReadError> {
        if !points.len().is_multiple_of(3) {
            return Err(self
                .fault(format!("the number of coordinates must be a multiple of 3, got {}", points.len())));
        }
        for i in 0..points.len() / 3 {
            let [x, y, z] = [0, 1, 2].map(|axis| points.get(3 * i + axis));
            let index = data.mesh.vertices.len();
            if let Some(bad) = [x, y, z].iter().find(|c| !c.is_finite()) {
                return Err(ReadError::NonFinite {
                    file: self.file.clone(),
                    line: self.line.get(),
                    column: 0,
                    item: "point",
                    index: index as u64,
                    found: bad.to_string(),
                });
            }
            if z != 0.0 {
                let what = format!("point {index} at z = {z}, out of the plane,");
                return Err(ReadError::Unsupported { file: self.file.clone(), line: self.line.get(), what });
            }
            if index >= MAX_ITEMS {
                let (file, line) = (self.file.clone(), self.line.get());
                return Err(ReadError::TooMany { file, line, section: "points", limit: MAX_ITEMS as u64 });
            }
            data.mesh.vertices.push(DVec2::new(x, y));
        }
        Ok(())
    }

    fn corner(&self, index: f64, first: usize, count: usize) -> Result<VertexId, ReadError> {
        let index = self.integer(index, "the index of a point")?;
        match usize::try_from(index) {
            Ok(i) if i < count => Ok(VertexId::new(first + i)),
            _ => Err(ReadError::IndexOutOfRange {
                file: self.file.clone(),
                line: self.line.get(),
                column: 0,
                index,
                first: 0,
                points: count as u64,
            }),
        }
    }

    fn integer(&self, number: f64, what: &str) -> Result<i64, ReadError> {
        let integer = number as i64;
        if integer as f64 == number {
            return Ok(integer);
        }
        Err(self.fault(format!("expected {what}, found {number}")))
    }

    fn marker(&self, number: f64) -> Result<i32, ReadError> {
        let integer = self.integer(number, "a marker")?;
        i32::try_from(integer).map_err(|_| self.fault(format!("expected a marker, found {number}")))
    }

    fn same_length(&self, array: &'static str, expected: usize, found: usize) -> Result<(), ReadError> {
        if expected == found {
            return Ok(());
        }
        let (file, line) = (self.file.clone(), self.line.get());
        Err(ReadError::Length { file, line, array, expected: expected as u64, found: found as u64 })
    }
}

/// Data of points and cells, `None` where a piece has none.
#[derive(Default)]
struct Columns {
    markers: Vec<Option<i32>>,
    inputs: Vec<Option<i64>>,
    heights: Vec<Option<f64>>,
    regions: Vec<Option<f64>>,
    edges: Vec<MarkedEdge>,
}

impl Columns {
    fn points(
        &mut self,
        grid: &Grid,
        [markers, inputs, heights]: [Option<&Values>; 3],
        count: usize,
    ) -> Result<(), ReadError> {
        for (name, column) in [("vertex markers", markers), ("input indices", inputs), ("heights", heights)] {
            grid.same_length(name, count, column.map_or(count, Values::len))?;
        }
        for i in 0..count {
            self.markers.push(markers.map(|values| grid.marker(values.get(i))).transpose()?);
            let index = |values: &Values| grid.integer(values.get(i), "an input index");
            self.inputs.push(inputs.map(index).transpose()?);
            let height = heights.map(|values| values.get(i));
            if let Some(bad) = height.filter(|height| !height.is_finite()) {
                return Err(grid.fault(format!("expected a height, found {bad}")));
            }
            self.heights.push(height);
        }
        Ok(())
    }

    fn settle(self, data: &mut MeshData) {
        let some = self.markers.iter().any(Option::is_some);
        data.vertex_markers = some.then(|| self.markers.iter().map(|m| m.unwrap_or(0)).collect());
        let some = self.inputs.iter().any(Option::is_some);
        data.input_indices =
            some.then(|| self.inputs.iter().map(|i| u32::try_from(i.unwrap_or(-1)).ok()).collect());
        let some = self.heights.iter().any(Option::is_some);
        data.heights = some.then(|| self.heights.iter().map(|z| z.unwrap_or(0.0)).collect());
        let some = self.regions.iter().any(Option::is_some);
        data.regions = some.then(|| self.regions.iter().map(|r| r.unwrap_or(0.0)).collect());
        data.marked_edges = (!self.edges.is_empty()).then_some(self.edges);
    }
}
