//! Rasters in the ASCII grid format of ESRI (`.asc`).
//!
//! A header of lines `name value` (`ncols`, `nrows`, `xllcorner` or
//! `xllcenter`, `yllcorner` or `yllcenter`, `cellsize`, and perhaps
//! `NODATA_value`), then the values row by row, the northernmost first.

use std::io::BufRead;
use std::path::Path;

use hexdel_geom::{DVec2, Raster};

use crate::error::ReadError;
use crate::lines::{Comments, Lines, Row};

/// Longest message, characters: what it quotes may be long.
const MOST_QUOTED: usize = 80;

/// Reads a raster from a file.
///
/// # Errors
///
/// [`ReadError`] with the file, and the line where there is one.
pub fn read_raster(path: &Path) -> Result<Raster, ReadError> {
    let file = path.display().to_string();
    let reader = std::fs::File::open(path).map_err(|source| ReadError::open(path, source))?;
    parse_raster(std::io::BufReader::new(reader), &file)
}

/// Reads a raster; `file` is its name in errors.
///
/// # Errors
///
/// As [`read_raster`].
pub fn parse_raster(reader: impl BufRead, file: &str) -> Result<Raster, ReadError> {
    let mut parser = Parser { file, header: Header::default(), values: Vec::new() };
    let mut lines = Lines::new(reader, file, Comments::Nowhere);
    while let Some(row) = lines.next_row()? {
        parser.line(row)?;
    }
    parser.finish(lines.number())
}

#[derive(Default)]
struct Header {
    columns: Option<usize>,
    rows: Option<usize>,
    /// Whether the number is a cell's corner, and the number.
    x: Option<(bool, f64)>,
    y: Option<(bool, f64)>,
    cell: Option<f64>,
    no_data: Option<f64>,
}

struct Parser<'a> {
    file: &'a str,
    header: Header,
    /// From the north.
    values: Vec<f64>,
}

impl Parser<'_> {
    fn bad(&self, line: u64, message: impl Into<String>) -> ReadError {
        let message: String = message.into();
        let message = if message.len() > MOST_QUOTED {
            message.chars().take(MOST_QUOTED).chain("..".chars()).collect()
        } else {
            message
        };
        ReadError::Raster { file: self.file.to_owned(), line, message }
    }

    fn line(&mut self, Row { text, line, .. }: Row<'_>) -> Result<(), ReadError> {
        let mut words = text.split_whitespace();
        let is_name = |word: &str| word.starts_with(|c: char| c.is_ascii_alphabetic()) && !is_number(word);
        if self.values.is_empty()
            && let Some(name) = words.clone().next().filter(|word| is_name(word))
        {
            let value = words.nth(1).ok_or_else(|| self.bad(line, format!("{name} has no value")))?;
            return match words.next() {
                None => self.entry(name, value, line),
                Some(more) => Err(self.bad(line, format!("{more} is more than a name and a value"))),
            };
        }
        for word in words {
            let value =
                word.parse().map_err(|_| self.bad(line, format!("expected a number, found {word}")))?;
            self.values.push(value);
            if self.values.len() > Raster::MOST_CELLS {
                return Err(self.bad(line, "more cells than are supported"));
            }
        }
        Ok(())
    }

    fn entry(&mut self, name: &str, value: &str, line: u64) -> Result<(), ReadError> {
        let wrong = |what: &str| self.bad(line, format!("{name} must be {what}, got {value}"));
        let number = || value.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(|| wrong("a number"));
        let positive = || value.parse().ok().filter(|n| *n > 0).ok_or_else(|| wrong("a positive integer"));
        match name.to_ascii_lowercase().as_str() {
            "ncols" => self.header.columns = Some(positive()?),
            "nrows" => self.header.rows = Some(positive()?),
            "xllcorner" => self.header.x = Some((true, number()?)),
            "xllcenter" => self.header.x = Some((false, number()?)),
            "yllcorner" => self.header.y = Some((true, number()?)),
            "yllcenter" => self.header.y = Some((false, number()?)),
            "cellsize" => self.header.cell = Some(number()?),
            "nodata_value" => self.header.no_data = Some(value.parse().map_err(|_| wrong("a number"))?),
            _ => return Err(self.bad(line, format!("unknown entry {name} of the header"))),
        }
        Ok(())
    }

    fn finish(self, line: u64) -> Result<Raster, ReadError> {
        let missing = |name: &str| self.bad(line, format!("the header has no {name}"));
        let columns = self.header.columns.ok_or_else(|| missing("ncols"))?;
        let rows = self.header.rows.ok_or_else(|| missing("nrows"))?;
        let cell = self.header.cell.ok_or_else(|| missing("cellsize"))?;
        let (x_is_corner, x) = self.header.x.ok_or_else(|| missing("xllcorner"))?;
        let (y_is_corner, y) = self.header.y.ok_or_else(|| missing("yllcorner"))?;
        if cell <= 0.0 {
            return Err(self.bad(line, format!("cellsize must be positive, got {cell}")));
        }
        let found = self.values.len();
        if columns.checked_mul(rows) != Some(found) {
            return Err(self.bad(line, format!("{found} values, not {columns} times {rows}")));
        }
        let centre = |corner: bool, at: f64| if corner { at + 0.5 * cell } else { at };
        let value = |v: &f64| Some(*v).filter(|v| v.is_finite() && Some(*v) != self.header.no_data);
        Ok(Raster {
            columns,
            rows,
            low: DVec2::new(centre(x_is_corner, x), centre(y_is_corner, y)),
            cell,
            values: self.values.chunks(columns).rev().flatten().map(value).collect(),
        })
    }
}

/// Whether a word is a value, `nan` among them.
fn is_number(word: &str) -> bool {
    word.parse::<f64>().is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Raster, ReadError> {
        parse_raster(text.as_bytes(), "test.asc")
    }

    const HEADER: &str = "ncols 2\nnrows 2\nxllcorner 10\nyllcenter -1\ncellsize 4\nNODATA_value -9999\n";

    #[test]
    fn rows_come_from_the_north() {
        let raster = parse(&format!("{HEADER}1 2\n3 -9999\n")).unwrap();
        assert_eq!(raster.low, DVec2::new(12.0, -1.0));
        assert_eq!(raster.values, [Some(3.0), None, Some(1.0), Some(2.0)]);
    }

    #[test]
    fn values_may_be_broken_into_lines_anywhere() {
        let raster = parse(&format!("{HEADER}1\n2 3\n\nnan")).unwrap();
        assert_eq!(raster.values, [Some(3.0), None, Some(1.0), Some(2.0)]);
    }

    #[test]
    fn lines_are_bounded() {
        let error = parse_raster(std::io::BufReader::new(std::io::repeat(b'0')), "zero");
        assert!(matches!(error, Err(ReadError::LineTooLong { line: 1, .. })));
        assert!(parse(&format!("\u{feff}{HEADER}1 2 3 4")).is_ok());
    }

    #[test]
    fn errors_name_the_line() {
        let of = |text: &str| match parse(text) {
            Err(ReadError::Raster { line, message, .. }) => (line, message),
            other => panic!("{text}: {other:?}"),
        };
        assert_eq!(of(&format!("{HEADER}1 2\n3 x\n")), (8, "expected a number, found x".into()));
        assert_eq!(of(&format!("{HEADER}1 2 3")), (7, "3 values, not 2 times 2".into()));
        assert_eq!(of("ncols 0\n"), (1, "ncols must be a positive integer, got 0".into()));
        assert_eq!(of("ncols\n"), (1, "ncols has no value".into()));
        assert_eq!(of("ncols 2 3\n"), (1, "3 is more than a name and a value".into()));
        assert_eq!(of("colour 2\n"), (1, "unknown entry colour of the header".into()));
        assert_eq!(of("ncols 1\nnrows 1\n").1, "the header has no cellsize");
        let zero = HEADER.replace("cellsize 4", "cellsize 0");
        assert_eq!(of(&format!("{zero}1 2 3 4")).1, "cellsize must be positive, got 0");
    }
}
