//! Text tables of points: CSV, TSV, XYZ and their relatives.
//!
//! The delimiter is the first of `;`, tab and `,` that the first row of numbers
//! contains, otherwise white space. A first row without any number is a header;
//! if it names columns `x` and `y` (in upper or lower case) those are read,
//! otherwise the first two are. Further columns are left. Fields may stand in
//! quotation marks, which hide delimiters but not line ends. Lines that begin
//! with `#` are comments. A decimal comma is not understood: it would make two
//! readings of `1,5;2,5`, and is reported as a malformed number.

use std::io::BufRead;

use hexdel_geom::{DVec2, Pslg};

use crate::error::ReadError;
use crate::lines::{Comments, Lines, Row};

/// The most points, so that 32-bit indices reach all of them.
const MAX_POINTS: usize = u32::MAX as usize;

/// Reads a table of points.
pub(crate) fn read_table(reader: impl BufRead, file: &str) -> Result<Pslg, ReadError> {
    let mut lines = Lines::new(reader, file, Comments::WholeLine);
    let mut points = Vec::new();
    let Some(columns) = first_rows(&mut lines, &mut points)? else {
        return Ok(Pslg::default());
    };
    while let Some(row) = lines.next_row()? {
        if points.len() >= MAX_POINTS {
            return Err(ReadError::TooMany {
                file: row.file.to_owned(),
                line: row.line,
                section: "points",
                limit: MAX_POINTS as u64,
            });
        }
        points.push(columns.point(row, points.len() as u64)?);
    }
    Ok(Pslg::from_points(points))
}

/// Reads the header, if there is one, and the first point; `None` if there is no
/// point.
fn first_rows<R: BufRead>(
    lines: &mut Lines<R>,
    points: &mut Vec<DVec2>,
) -> Result<Option<Columns>, ReadError> {
    let Some(mut row) = lines.next_row()? else {
        return Ok(None);
    };
    let mut header = None;
    if !has_number(row.text) {
        header = Some(row.text.to_owned());
        let Some(next) = lines.next_row()? else {
            return Ok(None);
        };
        row = next;
    }
    let columns = Columns::find(header.as_deref(), row.text);
    points.push(columns.point(row, 0)?);
    Ok(Some(columns))
}

/// Whether any field is a number, whatever the delimiter.
fn has_number(text: &str) -> bool {
    text.split([',', ';', '\t', ' ']).any(|field| unquote(field).parse::<f64>().is_ok())
}

/// Where x and y stand in a row.
struct Columns {
    /// `None` is white space.
    delimiter: Option<char>,
    x: usize,
    y: usize,
}

impl Columns {
    fn find(header: Option<&str>, first_row: &str) -> Self {
        let delimiter = [';', '\t', ','].into_iter().find(|&d| first_row.contains(d));
        let column = |name| split(header?, delimiter).position(|field| field.eq_ignore_ascii_case(name));
        let (x, y) = column("x").zip(column("y")).unwrap_or((0, 1));
        Self { delimiter, x, y }
    }

    fn point(&self, row: Row<'_>, index: u64) -> Result<DVec2, ReadError> {
        let field = |at| split(row.text, self.delimiter).nth(at);
        row.position([field(self.x), field(self.y)], "point", index)
    }
}

/// The fields of a row, trimmed and out of their quotation marks.
fn split(text: &str, delimiter: Option<char>) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let text = rest?;
        let (field, after) = match delimiter {
            Some(delimiter) => cut(text, |c| c == delimiter),
            None => cut(text, |c| c.is_ascii_whitespace()),
        };
        rest = match delimiter {
            Some(_) => after,
            None => after.map(str::trim_ascii_start),
        };
        Some(unquote(field))
    })
}

/// Cuts `text` at the first delimiter outside of quotation marks.
fn cut(text: &str, is_delimiter: impl Fn(char) -> bool) -> (&str, Option<&str>) {
    let mut quoted = false;
    let end = text.char_indices().find(|&(_, c)| {
        quoted ^= c == '"';
        !quoted && is_delimiter(c)
    });
    match end {
        Some((at, c)) => (&text[..at], Some(&text[at + c.len_utf8()..])),
        None => (text, None),
    }
}

fn unquote(field: &str) -> &str {
    let field = field.trim_ascii();
    let inner = field.strip_prefix('"').and_then(|f| f.strip_suffix('"'));
    inner.map_or(field, str::trim_ascii)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Vec<[f64; 2]> {
        let pslg = read_table(text.as_bytes(), "t").unwrap();
        pslg.points.into_iter().map(Into::into).collect()
    }

    #[test]
    fn delimiters_are_found_out() {
        for text in [
            "1,2\n3,4",
            "1;2\n3;4",
            "1\t2\n3\t4\n",
            "1 2\n  3   4  ",
            "1, 2,\n3, 4,",
            "1.0 2e0 9 9\r\n\r\n3 4 9",
            "x,y\n1,2\n3,4",
            "# two points\nlength width\n1 2\n# not 5 6\n3 4",
            "name,x,y\n\"A, a #1\",1,2\nB,3,4",
            "Y;X\n2;1\n4;3",
            "\"1\",\"2\"\n\" 3 \",4",
        ] {
            assert_eq!(read(text), [[1.0, 2.0], [3.0, 4.0]], "{text:?}");
        }
    }

    #[test]
    fn no_rows_are_no_points() {
        for text in ["", "\n\n", "# comment\n", "x,y\n"] {
            assert!(read(text).is_empty(), "{text:?}");
        }
    }

    #[test]
    fn an_empty_field_is_not_skipped() {
        let error = read_table(&b"1,2\n,3,4\n"[..], "t").unwrap_err();
        assert_eq!(error.to_string(), "t:2: expected the x coordinate, found \"\"");
        let error = read_table(&b"1,5;2,5\n"[..], "t").unwrap_err();
        assert_eq!(error.to_string(), "t:1: expected the x coordinate, found \"1,5\"");
    }
}
