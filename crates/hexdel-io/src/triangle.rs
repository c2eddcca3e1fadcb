//! Shewchuk's Triangle formats: reading `.node`, `.poly` and `.ele`.
//!
//! Each file is a sequence of sections, a header that counts rows and the rows,
//! numbered consecutively from 0 or 1:
//!
//! ```text
//! 4 2 1 1          points: count, dimension 2, attributes, markers (0 or 1)
//! 1 0.0 0.0 7.5 1  index, x, y, attributes, marker
//! ...
//! 4 1              segments: count, markers
//! 1 1 2 1          index, end points, marker
//! ...
//! 1                holes: count
//! 1 0.5 0.5        index, x, y
//! 1                regions: count (the section may be missing)
//! 1 0.1 0.1 3 0.01 index, x, y, attribute, largest area (may be missing)
//! ```
//!
//! Counts are taken as claims: rows are read until they fulfil it, memory grows
//! with the rows that are there. What Triangle reads all the same is forgiven where the
//! caller wants it ([`Mends`]): more fields than announced, or fewer of those that have a
//! default, commas, integers with a point. A largest area that is not positive means
//! none, as in Triangle.

use std::io::BufRead;

use hexdel_geom::{Pslg, Region, TriMesh, VertexId};

use crate::data::MeshData;
use crate::error::ReadError;
use crate::lines::{Comments, Fields, Lines, quote};
use crate::mend::{Faults, Mends};
use crate::promised::{NotPromised, Promised};

/// The most items reserved on the word of a header, about a megabyte of points.
const MAX_RESERVE: u64 = 1 << 16;

/// The most points or triangles, so that 32-bit ids reach all of them.
const MAX_ITEMS: u64 = u32::MAX as u64;

/// How the points of a file are counted.
#[derive(Clone, Copy)]
pub(crate) struct PointRange {
    /// Index of the first point: 0 or 1, `None` if there are no points.
    first: Option<u64>,
    count: u64,
}

/// Reads a `.node` file.
pub(crate) fn read_node(
    reader: impl BufRead,
    file: &str,
    mends: &mut Mends,
) -> Result<(Pslg, PointRange), ReadError> {
    let mut lines = Lines::new(reader, file, Comments::Anywhere);
    let mut pslg = Pslg::default();
    let range = point_section(&mut lines, &mut pslg, mends)?;
    end_of_file(&mut lines, "points")?;
    Ok((pslg, range))
}

/// What a `.poly` file holds, with the lines of its holes and regions.
pub(crate) struct Poly {
    pub(crate) pslg: Pslg,
    pub(crate) range: PointRange,
    pub(crate) hole_lines: Vec<u64>,
    pub(crate) region_lines: Vec<u64>,
}

/// Reads a `.poly` file. `points_beside` is asked for the points if it has none.
pub(crate) fn read_poly(
    reader: impl BufRead,
    file: &str,
    mends: &mut Mends,
    points_beside: impl FnOnce(u64, &mut Mends) -> Result<(Pslg, PointRange), ReadError>,
) -> Result<Poly, ReadError> {
    let mut lines = Lines::new(reader, file, Comments::Anywhere);
    let mut pslg = Pslg::default();
    let mut range = point_section(&mut lines, &mut pslg, mends)?;
    if range.count == 0 {
        (pslg, range) = points_beside(lines.number(), mends)?;
    }
    segment_section(&mut lines, &mut pslg, range, mends)?;
    let hole_lines = hole_section(&mut lines, &mut pslg, mends)?;
    let region_lines = region_section(&mut lines, &mut pslg, mends)?;
    end_of_file(&mut lines, "regions")?;
    Ok(Poly { pslg, range, hole_lines, region_lines })
}

/// Reads the triangles of an `.ele` file to the points of its `.node` file. The first
/// attribute of a triangle is that of its region, others are left; what the points
/// carry is taken over, see [`input_indices`].
pub(crate) fn read_ele(
    reader: impl BufRead,
    file: &str,
    points: Pslg,
    range: PointRange,
) -> Result<MeshData, ReadError> {
    let mut lines = Lines::new(reader, file, Comments::Anywhere);
    let mends = &mut Mends::new(true);
    let input_indices = input_indices(&points);
    let mut mesh = TriMesh { vertices: points.points, triangles: Vec::new() };
    let mut regions = Vec::new();
    let (section, mut header) = Section::begin(&mut lines, "triangles", MAX_ITEMS, mends)?;
    let found = header.peek();
    let corners = header.integer_or(3u64, "3 corners per triangle")?;
    if corners != 3 {
        return Err(header.row.malformed("3 corners per triangle", found));
    }
    let attributes = header.integer_or(0u64, "the number of attributes")?;
    header.end()?;
    mesh.triangles.reserve(section.reserve());
    section.rows(&mut lines, mends, |fields, _, _| {
        let mut corner = || range.index(fields).map(|v| VertexId::new(v as usize));
        mesh.triangles.push([corner()?, corner()?, corner()?]);
        for i in 0..attributes {
            let attribute = fields.number("an attribute")?;
            if i == 0 {
                regions.push(attribute);
            }
        }
        Ok(())
    })?;
    end_of_file(&mut lines, "triangles")?;
    let vertex_markers = (!points.point_markers.is_empty()).then_some(points.point_markers);
    let regions = (attributes > 0).then_some(regions);
    let promised = promised(&lines, mesh.triangles.len())?;
    Ok(MeshData { input_indices, vertex_markers, regions, promised, ..MeshData::new(mesh) })
}

/// What comments say that the mesh was made to keep.
fn promised<R: BufRead>(lines: &Lines<R>, triangles: usize) -> Result<Option<Promised>, ReadError> {
    if lines.notes().len() == 0 {
        return Ok(None);
    }
    Promised::of_lines(lines.notes(), triangles).map(Some).map_err(|fault| {
        let NotPromised { line, expected, found } = fault;
        ReadError::Malformed { file: lines.file().to_owned(), line, column: 0, expected, found }
    })
}

/// The only attribute of vertices, if it can be what is written here: the index of
/// the input point, no two the same, or -1.
fn input_indices(points: &Pslg) -> Option<Vec<Option<u32>>> {
    if points.attributes_per_point != 1 {
        return None;
    }
    let index = |&number: &f64| match number {
        -1.0 => Some(None),
        _ => (f64::from(number as u32) == number).then_some(Some(number as u32)),
    };
    let indices: Vec<Option<u32>> = points.point_attributes.iter().map(index).collect::<Option<_>>()?;
    let mut distinct: Vec<u32> = indices.iter().copied().flatten().collect();
    distinct.sort_unstable();
    distinct.windows(2).all(|w| w[0] < w[1]).then_some(indices)
}

/// Attributes of a point, at most, of which those that a row lacks are filled in. Rows of more
/// must have them all: memory grows with what is in the file, whatever a header claims.
const MOST_FILLED_IN: usize = 16;

fn point_section<R: BufRead>(
    lines: &mut Lines<R>,
    pslg: &mut Pslg,
    mends: &mut Mends,
) -> Result<PointRange, ReadError> {
    let (section, mut header) = Section::begin(lines, "points", MAX_ITEMS, mends)?;
    let found = header.peek();
    let dimension = header.integer_or(2u64, "dimension 2")?;
    if dimension != 2 {
        return Err(header.row.malformed("dimension 2", found));
    }
    let attributes = header.integer_or(0usize, "the number of attributes")?;
    let markers = marker_column(&mut header)?;
    end(header, mends)?;

    pslg.attributes_per_point = attributes;
    pslg.points.reserve(section.reserve());
    let count = section.count;
    let first = section.rows(lines, mends, |fields, index, mends| {
        let point = fields.position("point", index)?;
        let read = pslg.point_attributes.len();
        for _ in 0..attributes {
            match attribute(fields, attributes, mends) {
                Ok(attribute) => pslg.point_attributes.push(attribute),
                Err(error) => {
                    pslg.point_attributes.truncate(read);
                    return Err(error);
                }
            }
        }
        pslg.points.push(point);
        push_marker(fields, markers, &mut pslg.point_markers, mends)
    })?;
    Ok(PointRange { first, count })
}

fn segment_section<R: BufRead>(
    lines: &mut Lines<R>,
    pslg: &mut Pslg,
    range: PointRange,
    mends: &mut Mends,
) -> Result<(), ReadError> {
    let (section, mut header) = Section::begin(lines, "segments", u64::MAX, mends)?;
    let markers = marker_column(&mut header)?;
    end(header, mends)?;
    pslg.segments.reserve(section.reserve());
    section.rows(lines, mends, |fields, _, mends| {
        let ends = [range.index(fields)?, range.index(fields)?];
        pslg.segments.push(ends);
        push_marker(fields, markers, &mut pslg.segment_markers, mends)
    })?;
    Ok(())
}

/// Reads the holes; their lines.
fn hole_section<R: BufRead>(
    lines: &mut Lines<R>,
    pslg: &mut Pslg,
    mends: &mut Mends,
) -> Result<Vec<u64>, ReadError> {
    let (section, header) = Section::begin(lines, "holes", u64::MAX, mends)?;
    end(header, mends)?;
    let mut at = Vec::new();
    section.rows(lines, mends, |fields, index, _| {
        pslg.holes.push(fields.position("hole", index)?);
        at.push(fields.row.line);
        Ok(())
    })?;
    Ok(at)
}

/// Reads the regions, if there are any; their lines.
fn region_section<R: BufRead>(
    lines: &mut Lines<R>,
    pslg: &mut Pslg,
    mends: &mut Mends,
) -> Result<Vec<u64>, ReadError> {
    let mut at = Vec::new();
    let (section, header) = match Section::begin(lines, "regions", u64::MAX, mends) {
        Err(ReadError::MissingSection { .. }) => return Ok(at),
        begun => begun?,
    };
    end(header, mends)?;
    section.rows(lines, mends, |fields, index, _| {
        let point = fields.position("region", index)?;
        let attribute = fields.number("the attribute of a region")?;
        let max_area = match fields.text() {
            None => None,
            area => {
                let area = fields.row.number(area, "the largest area of a region")?;
                (area > 0.0).then_some(area)
            }
        };
        pslg.regions.push(Region { point, attribute, max_area });
        at.push(fields.row.line);
        Ok(())
    })?;
    Ok(at)
}

fn marker_column(header: &mut Fields<'_>) -> Result<bool, ReadError> {
    const EXPECTED: &str = "0 or 1 boundary markers";
    let found = header.peek();
    match header.integer_or(0u64, EXPECTED)? {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(header.row.malformed(EXPECTED, found)),
    }
}

/// An attribute of a point that is to have so many, 0 where it is missing.
fn attribute(fields: &mut Fields<'_>, count: usize, mends: &mut Mends) -> Result<f64, ReadError> {
    if count <= MOST_FILLED_IN && fields.peek().is_none() {
        let missing = || fields.row.malformed("an attribute", None);
        mends.forgive("missing attributes are read as 0", missing)?;
        return Ok(0.0);
    }
    fields.number("an attribute")
}

/// The marker of a point or segment, 0 where it is missing.
fn push_marker(
    fields: &mut Fields<'_>,
    present: bool,
    markers: &mut Vec<i32>,
    mends: &mut Mends,
) -> Result<(), ReadError> {
    const EXPECTED: &str = "a boundary marker";
    if !present {
        return Ok(());
    }
    let marker = match fields.peek() {
        None => {
            let missing = || fields.row.malformed(EXPECTED, None);
            mends.forgive("missing markers are read as 0", missing)?;
            0
        }
        Some(text) => match whole(text) {
            Some(marker) => {
                let fault = || fields.row.malformed(EXPECTED, Some(text));
                mends.forgive("markers with a decimal point are read as integers", fault)?;
                fields.text();
                marker
            }
            None => fields.integer(EXPECTED)?,
        },
    };
    markers.push(marker);
    Ok(())
}

/// The integer that is written with a decimal point or an exponent.
fn whole(text: &str) -> Option<i32> {
    let number: f64 = text.parse().ok().filter(|_| text.parse::<i32>().is_err())?;
    let marker = number as i32;
    (f64::from(marker) == number && text.contains(['.', 'e', 'E'])).then_some(marker)
}

/// Checks that a row ends; what Triangle does not look at is left.
fn end(fields: Fields<'_>, mends: &mut Mends) -> Result<(), ReadError> {
    match fields.end() {
        Ok(()) => Ok(()),
        Err(fault) => mends.forgive("fields beyond those announced are ignored", || fault),
    }
}

fn end_of_file<R: BufRead>(lines: &mut Lines<R>, section: &'static str) -> Result<(), ReadError> {
    let Some(row) = lines.next_row()? else {
        return Ok(());
    };
    Err(ReadError::TrailingRow {
        file: row.file.to_owned(),
        line: row.line,
        column: row.column_of(row.fields().text()),
        section,
        found: quote(row.fields().text().unwrap_or_default()),
    })
}

impl PointRange {
    /// The number of the first point, 0 if there is none.
    pub(crate) fn first_number(self) -> u32 {
        u32::from(self.first == Some(1))
    }

    /// Reads the index of a point and counts it from 0.
    fn index(self, fields: &mut Fields<'_>) -> Result<u32, ReadError> {
        let field = fields.peek();
        let index: i64 = fields.integer("the index of a point")?;
        let first = self.first.unwrap_or(0);
        let from_0 = u64::try_from(index).ok().and_then(|i| i.checked_sub(first));
        match from_0.filter(|&i| i < self.count) {
            Some(i) => Ok(i as u32),
            None => Err(ReadError::IndexOutOfRange {
                file: fields.row.file.to_owned(),
                line: fields.row.line,
                column: fields.row.column_of(field),
                index,
                first,
                points: self.count,
            }),
        }
    }
}

/// A header's claim of how many rows follow.
struct Section {
    name: &'static str,
    count: u64,
}

impl Section {
    /// Reads the count of a header; the fields are those after it.
    fn begin<'l, R: BufRead>(
        lines: &'l mut Lines<R>,
        name: &'static str,
        limit: u64,
        mends: &mut Mends,
    ) -> Result<(Self, Fields<'l>), ReadError> {
        let (file, last_line) = (lines.file().to_owned(), lines.number());
        let Some(row) = lines.next_row()? else {
            return Err(ReadError::MissingSection {
                file,
                // Blank lines and comments at the end are not what is missing
                // something, the row before them is.
                line: last_line,
                section: name,
            });
        };
        let mut fields = mends.fields(row)?;
        let count = fields.integer(count_of(name))?;
        if count > limit {
            return Err(ReadError::TooMany { file, line: row.line, section: name, limit });
        }
        Ok((Self { name, count }, fields))
    }

    /// How many items to reserve memory for.
    fn reserve(&self) -> usize {
        self.count.min(MAX_RESERVE) as usize
    }

    /// Reads all rows, numbered from 0 or 1, which is returned. `read` gets each
    /// row without its number, and the number.
    fn rows<R: BufRead>(
        self,
        lines: &mut Lines<R>,
        mends: &mut Mends,
        mut read: impl FnMut(&mut Fields<'_>, u64, &mut Mends) -> Result<(), ReadError>,
    ) -> Result<Option<u64>, ReadError> {
        let (mut first, mut faults) = (None, Faults::default());
        for done in 0..self.count {
            let Some(row) = faults.note(lines.next_row())?.flatten() else {
                faults.take()?;
                return Err(ReadError::Truncated {
                    file: lines.file().to_owned(),
                    line: lines.number(),
                    section: self.name,
                    expected: self.count,
                    found: done,
                });
            };
            let mut fields = mends.fields(row)?;
            let number = row_number(&mut fields, first.map(|first| first + done), self.refers(), mends);
            let Some(index) = faults.note(number)? else {
                first.get_or_insert(0);
                continue;
            };
            first.get_or_insert(index);
            faults.note(read(&mut fields, index, mends).and_then(|()| end(fields, mends)))?;
        }
        faults.take()?;
        Ok(first)
    }

    /// Whether others refer to the rows by their numbers.
    fn refers(&self) -> bool {
        self.name == "points"
    }
}

/// Reads the number of a row, which must be the one that is due, 0 or 1 in the
/// first row.
fn row_number(
    fields: &mut Fields<'_>,
    due: Option<u64>,
    refers: bool,
    mends: &mut Mends,
) -> Result<u64, ReadError> {
    let field = fields.peek();
    let found: i64 = fields.integer("the number of the row")?;
    match (u64::try_from(found), due) {
        (Ok(found @ (0 | 1)), None) => return Ok(found),
        (Ok(found), Some(due)) if found == due => return Ok(found),
        _ => {}
    }
    let due = due.unwrap_or(0);
    let fault = ReadError::NonConsecutive {
        file: fields.row.file.to_owned(),
        line: fields.row.line,
        column: fields.row.column_of(field),
        expected: due,
        found,
    };
    if refers {
        return Err(fault);
    }
    mends.forgive("rows are read in the order of the file", || fault)?;
    Ok(due)
}

fn count_of(section: &str) -> &'static str {
    match section {
        "points" => "the number of points",
        "segments" => "the number of segments",
        "holes" => "the number of holes",
        "triangles" => "the number of triangles",
        _ => "the number of regions",
    }
}
