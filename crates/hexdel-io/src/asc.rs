//! Rasters in the ASCII grid format of ESRI (`.asc`).
//!
//! A header of lines `name value` (`ncols`, `nrows`, `xllcorner` or
//! `xllcenter`, `yllcorner` or `yllcenter`, `cellsize`, and perhaps
//! `NODATA_value`), then the values row by row, the northernmost first.

use std::io::BufRead;
use std::path::Path;

use hexdel_geom::DVec2;

use crate::error::ReadError;
use crate::lines::{Comments, Lines, Row};

/// Square cells with a number each.
#[derive(Clone, Debug, PartialEq)]
pub struct Raster {
    /// Cells in a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// Centre of the cell in the south-west.
    pub low: DVec2,
    /// Length of a cell's side.
    pub cell: f64,
    /// Row by row from the south, each from the west; none where there is no
    /// value.
    pub values: Vec<Option<f64>>,
}

impl Raster {
    /// The value at a place, interpolated between the centres of the cells around it that have one; none if no
    /// cell there has, or outside of the raster.
    pub fn at(&self, place: DVec2) -> Option<f64> {
        let last = DVec2::new(self.columns as f64 - 1.0, self.rows as f64 - 1.0);
        let place = (place - self.low) / self.cell;
        // Cells reach half their side beyond their centres.
        if !(place.cmpge(DVec2::splat(-0.5)).all() && place.cmple(last + 0.5).all()) {
            return None;
        }
        let inside = place.clamp(DVec2::ZERO, last);
        let [column, row] = [inside.x as usize, inside.y as usize];
        let (u, v) = (inside.x - column as f64, inside.y - row as f64);
        let corners =
            [(0, 0, (1.0 - u) * (1.0 - v)), (1, 0, u * (1.0 - v)), (0, 1, (1.0 - u) * v), (1, 1, u * v)];
        let known =
            corners.into_iter().filter(|(.., weight)| *weight > 0.0).filter_map(|(dx, dy, weight)| {
                Some((weight, self.values[(row + dy) * self.columns + column + dx]?))
            });
        let [sum, total] =
            known.fold([0.0; 2], |[sum, total], (weight, value)| [sum + weight * value, total + weight]);
        (total > 0.0).then(|| sum / total)
    }

    /// A raster of other cells, from `low` to `high` and of the side `cell`, with the values at the places here that the
    /// centres of its cells are taken to. At most 2^28 cells: larger ones are made otherwise.
    #[must_use]
    pub fn resampled(&self, [low, high]: [DVec2; 2], cell: f64, to_here: impl Fn(DVec2) -> DVec2) -> Self {
        let count = |extent: f64, cell: f64| (extent / cell).ceil().max(0.0) as usize + 1;
        let extent = high - low;
        let mut cell = cell;
        while count(extent.x, cell).saturating_mul(count(extent.y, cell)) > MOST_CELLS {
            cell *= 2.0;
        }
        let (columns, rows) = (count(extent.x, cell), count(extent.y, cell));
        let centre = |i: usize| low + cell * DVec2::new((i % columns) as f64, (i / columns) as f64);
        let values = (0..columns * rows).map(|i| self.at(to_here(centre(i)))).collect();
        Self { columns, rows, low, cell, values }
    }
}

/// Most cells that are read.
const MOST_CELLS: usize = 1 << 28;

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
            if self.values.len() > MOST_CELLS {
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
    fn values_are_interpolated_between_cells_that_have_one() {
        let raster = Raster {
            columns: 2,
            rows: 2,
            low: DVec2::ONE,
            cell: 2.0,
            values: [1.0, 3.0, 5.0, 7.0].map(Some).to_vec(),
        };
        let at = |raster: &Raster, x, y| raster.at(DVec2::new(x, y));
        assert_eq!(
            (at(&raster, 2.0, 1.0), at(&raster, 2.0, 2.0), at(&raster, 3.0, 3.0)),
            (Some(2.0), Some(4.0), Some(7.0))
        );
        // A cell reaches half its side beyond its centre.
        assert_eq!(
            (at(&raster, 0.1, 0.0), at(&raster, -0.1, 1.0), at(&raster, 1.0, 4.1)),
            (Some(1.0), None, None)
        );
        assert_eq!(at(&raster, f64::NAN, 1.0), None);
        let holed = Raster { values: vec![Some(1.0), None, None, None], ..raster.clone() };
        assert_eq!((at(&holed, 2.0, 1.0), at(&holed, 3.0, 3.0)), (Some(1.0), None));
        let single = Raster { columns: 1, rows: 1, values: vec![Some(4.0)], ..raster };
        assert_eq!(at(&single, 1.5, 0.5), Some(4.0));
    }

    #[test]
    fn rasters_are_resampled_where_their_places_are_taken_to() {
        let raster = Raster {
            columns: 3,
            rows: 1,
            low: DVec2::ZERO,
            cell: 1.0,
            values: [1.0, 2.0, 3.0].map(Some).to_vec(),
        };
        // Ten times as large, and moved.
        let found = raster.resampled([DVec2::new(100.0, 0.0), DVec2::new(125.0, 4.0)], 5.0, |p| {
            (p - DVec2::new(100.0, 0.0)) / 10.0
        });
        assert_eq!((found.columns, found.rows, found.low, found.cell), (6, 2, DVec2::new(100.0, 0.0), 5.0));
        assert_eq!(found.values[..6], [1.0, 1.5, 2.0, 2.5, 3.0, 3.0].map(Some));
        assert_eq!(found.values[6..9], [Some(1.0), Some(1.5), Some(2.0)]);
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
