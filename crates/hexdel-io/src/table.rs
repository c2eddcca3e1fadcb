//! Text tables of points: CSV, TSV, XYZ and their relatives.
//!
//! The delimiter is the first of `;`, tab and `,` that the first row of numbers
//! contains, otherwise white space. A first row without any number is a header, and
//! its names tell which columns are x and y ([`columns`](crate::columns)). Without one
//! the first two are, unless the first counts rows. Further columns are left. Fields
//! may stand in quotation marks, which hide delimiters but not line ends. Lines that
//! begin with `#` are comments. Decimal commas are understood where the delimiter is `;` or
//! a tab; elsewhere they would make two readings of a row.

use std::borrow::Cow;
use std::io::BufRead;

use hexdel_geom::Pslg;

use crate::columns::{
    Column, Columns, TakenColumn, TakenColumns, by_names, heights_by_name, names_degrees, names_depths,
    names_id,
};
use crate::error::ReadError;
use crate::lines::{Comments, Lines, Row};
use crate::mend::Faults;
use crate::shapes::{Features, Place};

/// The most points, so that 32-bit indices reach all of them.
const MAX_POINTS: usize = u32::MAX as usize;

/// What a header without names, or a first column that counts, comes to.
const COUNTS_ROWS: &str =
    "the first column looks like row numbers, and nothing says which columns are x and y";

/// Reads a table of points.
pub(crate) fn read_table(
    reader: impl BufRead,
    file: &str,
    asked: Option<&Columns>,
) -> Result<(Features, Option<TakenColumns>), ReadError> {
    let mut lines = Lines::new(reader, file, Comments::WholeLine);
    let (mut points, mut faults) = (Vec::new(), Faults::default());
    let Some(mut table) = Table::begin(&mut lines, asked, &mut points, &mut faults)? else {
        return Ok((Pslg::default().into(), None));
    };
    while let Some(row) = faults.note(lines.next_row())?.flatten() {
        if points.len() >= MAX_POINTS {
            return Err(ReadError::TooMany {
                file: row.file.to_owned(),
                line: row.line,
                section: "points",
                limit: MAX_POINTS as u64,
            });
        }
        let point = table.point(row, points.len() as u64);
        points.extend(faults.note(point)?);
    }
    faults.take()?;
    table.check_count(points.len(), file)?;
    Ok((Features::points(&points), Some(table.taken)))
}

/// How the rows of a table are read.
struct Table {
    /// `None` is white space.
    delimiter: Option<char>,
    /// Places of x and y in a row.
    columns: [usize; 2],
    /// The place of heights.
    heights: Option<usize>,
    /// Whether each row must have a height.
    needs_heights: bool,
    /// The number of columns in the header, which no row may have more of.
    names: Option<usize>,
    taken: TakenColumns,
    /// What the first column would be counting, as long as it is.
    counting: Option<Counting>,
}

/// A first column of integers, each one more than the last.
struct Counting {
    last: i64,
    /// The first row, with its line.
    row: String,
    line: u64,
}

impl Table {
    /// Reads the header, if there is one, and the first point; `None` if there is no
    /// point.
    fn begin<R: BufRead>(
        lines: &mut Lines<R>,
        asked: Option<&Columns>,
        points: &mut Vec<Place>,
        faults: &mut Faults,
    ) -> Result<Option<Self>, ReadError> {
        let Some(mut row) = lines.next_row()? else {
            return Ok(None);
        };
        let mut header = None;
        if is_header(row.text, asked) {
            header = Some((row.text.to_owned(), row.line));
            let Some(next) = lines.next_row()? else {
                return Ok(None);
            };
            row = next;
        }
        let header = header.as_ref().map(|(text, line)| (text.as_str(), *line));
        let mut table = Self::find(header, row, asked)?;
        points.extend(faults.note(table.read(row, 0))?);
        table.taken.decimal_commas |= table.has_decimal_comma(row);
        Ok(Some(table))
    }

    /// Finds the columns of x and y.
    fn find(header: Option<(&str, u64)>, row: Row<'_>, asked: Option<&Columns>) -> Result<Self, ReadError> {
        let delimiter = delimiter_of(row.text);
        let fields: Vec<&str> = split(row.text, delimiter).collect();
        let names = header.map(|(text, line)| (names_of(text, delimiter, fields.len()), text, line));
        let mut counting = None;
        let at = |column| place(column, names.as_ref().map(|n| (&n.0[..], n.2)), &fields, row);
        let columns = match (asked, &names) {
            (Some(asked), _) => [at(&asked.x)?, at(&asked.y)?],
            (None, Some((names, text, line))) => by_names(names).map_err(|fault| ReadError::Columns {
                file: row.file.to_owned(),
                line: *line,
                fault,
                header: clip_header(text),
                likely: likely(names, &fields, delimiter),
            })?,
            (None, None) => {
                counting = counted(&fields, delimiter, row);
                [0, 1]
            }
        };
        let heights = match (asked, &names) {
            (Some(asked), _) => asked.z.as_ref().map(at).transpose()?,
            (None, Some((names, ..))) => heights_by_name(names),
            (None, None) => None,
        };
        let taken = |column: usize| TakenColumn {
            number: column + 1,
            name: names.as_ref().and_then(|n| n.0.get(column)).map(|name| (*name).to_owned()),
        };
        let (x, y, z) = (taken(columns[0]), taken(columns[1]), heights.map(taken));
        let depths = z.as_ref().and_then(|z| names_depths(z.name.as_ref()?)) == Some(true);
        let named = |column: &TakenColumn| column.name.as_deref().is_some_and(names_degrees);
        let degrees = named(&x) && named(&y);
        let taken = TakenColumns { x, y, z, depths, degrees, decimal_commas: false };
        let needs_heights = asked.is_some_and(|asked| asked.z.is_some());
        // Who names columns by number has seen the rows.
        let by_number = matches!(
            asked,
            Some(Columns { x: Column::Number(_), y: Column::Number(_), z: None | Some(Column::Number(_)) })
        );
        let names = names.filter(|_| !by_number).map(|(names, ..)| names.len());
        Ok(Self { delimiter, columns, heights, needs_heights, names, taken, counting })
    }

    /// Reads a point, and what else a row tells.
    fn point(&mut self, row: Row<'_>, index: u64) -> Result<Place, ReadError> {
        if let Some(counting) = &mut self.counting {
            let next: Option<i64> =
                split(row.text, self.delimiter).next().and_then(|field| field.parse().ok());
            match next.filter(|_| next == counting.last.checked_add(1)) {
                Some(next) => counting.last = next,
                None => self.counting = None,
            }
        }
        if !self.taken.decimal_commas {
            self.taken.decimal_commas = self.has_decimal_comma(row);
        }
        self.read(row, index)
    }

    fn read(&self, row: Row<'_>, index: u64) -> Result<Place, ReadError> {
        if let Some(names) = self.names {
            // Half of a number may be beyond the names, or names of rows before them.
            let beyond = split(row.text, self.delimiter).skip(names).find(|field| !field.is_empty());
            if beyond.is_some() {
                let expected = match self.delimiter {
                    Some(',') => {
                        "as many fields as the header has (decimal commas are read where ; or a tab separates)"
                    }
                    _ => "as many fields as the header has",
                };
                return Err(row.malformed(expected, beyond));
            }
        }
        let fields = self.columns.map(|at| split(row.text, self.delimiter).nth(at));
        let read = row.position_by(fields, "point", index, |field| number(field, self.delimiter));
        let at = read.map_err(|error| self.with_hint(error, row))?;
        Ok(Place { at, height: self.height(row)? })
    }

    /// The height in a row, if there is one, or an error if there must be.
    fn height(&self, row: Row<'_>) -> Result<Option<f64>, ReadError> {
        let Some(place) = self.heights else {
            return Ok(None);
        };
        let field = split(row.text, self.delimiter).nth(place);
        let height = field.and_then(|field| number(field, self.delimiter)).filter(|z| z.is_finite());
        if height.is_none() && self.needs_heights {
            return Err(row.malformed("a height", field));
        }
        Ok(height.map(|z| if self.taken.depths { -z } else { z }))
    }

    /// The error with a word on decimal commas, where they may be the fault.
    fn with_hint(&self, error: ReadError, row: Row<'_>) -> ReadError {
        let is_half = |field: &str| {
            let words = field.split_ascii_whitespace().filter(|word| word.parse::<f64>().is_ok()).count();
            words > 1 || field.contains(',') && with_point(field).parse::<f64>().is_ok()
        };
        if self.takes_commas() || !split(row.text, self.delimiter).any(is_half) {
            return error;
        }
        match error {
            ReadError::Malformed { file, line, column, found, .. } => {
                let expected = "a coordinate (decimal commas are read where ; or a tab separates)";
                ReadError::Malformed { file, line, column, expected, found }
            }
            other => other,
        }
    }

    fn takes_commas(&self) -> bool {
        takes_commas(self.delimiter)
    }

    fn has_decimal_comma(&self, row: Row<'_>) -> bool {
        let has = |at: usize| split(row.text, self.delimiter).nth(at).is_some_and(|f| f.contains(','));
        self.takes_commas() && self.columns.into_iter().any(has)
    }

    /// Refuses a table whose first column counts, if there are others to take.
    fn check_count(&self, points: usize, file: &str) -> Result<(), ReadError> {
        match &self.counting {
            Some(counting) if points > 1 => Err(ReadError::Columns {
                file: file.to_owned(),
                line: counting.line,
                fault: COUNTS_ROWS,
                header: clip_header(&counting.row),
                likely: Some(["2".to_owned(), "3".to_owned()]),
            }),
            _ => Ok(()),
        }
    }
}

/// Whether the first row is one of names: none of its fields is a number, or, of columns
/// asked for by number, neither of those two.
fn is_header(text: &str, asked: Option<&Columns>) -> bool {
    let delimiter = delimiter_of(text);
    let is_number = |field: &str| number(field, delimiter).is_some();
    let fields: Vec<&str> = split(text, delimiter).collect();
    if !fields.iter().any(|field| is_number(field)) {
        // A row of spaces and commas may have numbers in the fields of commas.
        return delimiter.is_none()
            || !text.split([',', ';', '\t', ' ']).all(|word| is_number(unquote(word)));
    }
    match asked {
        Some(Columns { x: Column::Number(x), y: Column::Number(y), .. }) => {
            let field = |n: &usize| fields.get(n.checked_sub(1)?);
            [x, y].into_iter().all(|n| field(n).is_some_and(|field| !is_number(field)))
        }
        Some(_) => by_asked_names(&fields, asked),
        None => by_names(&fields).is_ok(),
    }
}

/// Whether the names asked for are fields of a row.
fn by_asked_names(fields: &[&str], asked: Option<&Columns>) -> bool {
    asked.is_some_and(|asked| {
        [&asked.x, &asked.y].into_iter().all(|column| match column {
            Column::Name(name) => fields.iter().any(|field| field.eq_ignore_ascii_case(name)),
            Column::Number(_) => true,
        })
    })
}

/// The place of a column that was asked for.
fn place(
    column: &Column,
    names: Option<(&[&str], u64)>,
    fields: &[&str],
    row: Row<'_>,
) -> Result<usize, ReadError> {
    let found = match (column, names) {
        (Column::Number(number), _) => number.checked_sub(1).filter(|&at| at < fields.len()),
        (Column::Name(name), Some((names, _))) => names
            .iter()
            .position(|n| *n == name)
            .or_else(|| names.iter().position(|n| n.eq_ignore_ascii_case(name))),
        (Column::Name(_), None) => None,
    };
    found.ok_or_else(|| ReadError::NoColumn {
        file: row.file.to_owned(),
        line: names.map_or(row.line, |n| n.1),
        column: column.to_string(),
        header: match names {
            Some((names, _)) => clip_header(&names.join(", ")),
            None => format!("{} columns and no header", fields.len()),
        },
    })
}

/// The names of a header, as many as there are fields where that is possible: units
/// between white space belong to the name before.
fn names_of(text: &str, delimiter: Option<char>, fields: usize) -> Vec<&str> {
    let names: Vec<&str> = split(text, delimiter).collect();
    if delimiter.is_some() || names.len() <= fields {
        return names;
    }
    names.into_iter().filter(|name| !name.starts_with(['[', '('])).collect()
}

/// Two columns of numbers that are no ids: likely to be meant.
fn likely(names: &[&str], fields: &[&str], delimiter: Option<char>) -> Option<[String; 2]> {
    let is_likely = |i: &usize| {
        number(fields[*i], delimiter).is_some() && names.get(*i).is_some_and(|name| !names_id(name))
    };
    let mut all = (0..fields.len()).filter(is_likely);
    let [x, y] = [all.next()?, all.next()?];
    let by_number = [x, y].iter().any(|&i| names[i].contains(',') || names[i].is_empty());
    Some([x, y].map(|i| if by_number { (i + 1).to_string() } else { names[i].to_owned() }))
}

/// The count that a first column may be, where others could be x and y.
fn counted(fields: &[&str], delimiter: Option<char>, row: Row<'_>) -> Option<Counting> {
    let others = fields.len() > 2 && fields[1..3].iter().all(|field| number(field, delimiter).is_some());
    let last = fields.first().and_then(|field| field.parse::<i64>().ok()).filter(|_| others)?;
    Some(Counting { last, row: row.text.to_owned(), line: row.line })
}

fn delimiter_of(text: &str) -> Option<char> {
    [';', '\t', ','].into_iter().find(|&d| cut(text, |c| c == d).1.is_some())
}

fn takes_commas(delimiter: Option<char>) -> bool {
    matches!(delimiter, Some(';' | '\t'))
}

/// The number in a field, with a decimal comma where the delimiter is no comma.
fn number(field: &str, delimiter: Option<char>) -> Option<f64> {
    let field = if takes_commas(delimiter) { with_point(field) } else { Cow::Borrowed(field) };
    field.parse().ok()
}

/// A number with its only comma, if it has no point, as a point.
fn with_point(field: &str) -> Cow<'_, str> {
    if field.matches(',').count() == 1 && !field.contains('.') {
        Cow::Owned(field.replace(',', "."))
    } else {
        Cow::Borrowed(field)
    }
}

/// A header at a length to read.
fn clip_header(text: &str) -> String {
    const MOST: usize = 120;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("\"{}..\"", &text[..end]),
        None => format!("\"{text}\""),
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
        let (read, _) = read_table(text.as_bytes(), "t", None).unwrap();
        read.pslg.points.into_iter().map(Into::into).collect()
    }

    fn refused(text: &str) -> String {
        read_table(text.as_bytes(), "t", None).unwrap_err().to_string()
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
            "# two points\nX [m]  Y [m]\n1 2\n# not 5 6\n3 4",
            "name,x,y\n\"A, a #1\",1,2\nB,3,4",
            "Y;X\n2;1\n4;3",
            "\"1\",\"2\"\n\" 3 \",4",
            "\"x\",\"y\",\"a,b\"\n1,2,\"5,6\"\n3,4,7",
            "x,y,2019\n1,2,9\n3,4,9",
            "1,0;2,0\n3,0;4",
            "1,0\t2,0\n3,0\t4,0",
            "id;Hochwert;Rechtswert\n1;2,0;1,0\n2;4,0;3,0",
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
    fn columns_that_were_taken_are_told() {
        for (text, asked, told) in [
            ("1,2\n3,4", None, "x = column 1, y = column 2"),
            ("name,lat,lon\nA,1,2", None, "x = lon (column 3), y = lat (column 2)"),
            ("id;x;y\n1;1,5;2", None, "x = x (column 2), y = y (column 3), with decimal commas"),
            ("a,b,c\n1,2,3", Some("C,A"), "x = c (column 3), y = a (column 1)"),
            ("a,b,c\n1,2,3", Some("3,b"), "x = c (column 3), y = b (column 2)"),
            ("1 2 3\n2 2 3", Some("1,3"), "x = column 1, y = column 3"),
            ("point 1,b,c\n1,2,3", Some("2,3"), "x = b (column 2), y = c (column 3)"),
        ] {
            let asked = asked.map(|asked: &str| asked.parse().unwrap());
            let (_, taken) = read_table(text.as_bytes(), "t", asked.as_ref()).unwrap();
            assert_eq!(taken.unwrap().to_string(), told, "{text:?}");
        }
    }

    #[test]
    fn heights_are_a_column() {
        let heights = |text: &str, asked: Option<&str>| {
            let asked = asked.map(|asked| asked.parse().unwrap());
            let (read, taken) = read_table(text.as_bytes(), "t", asked.as_ref())?;
            read.heights("t").map(|heights| (heights, taken.unwrap().to_string()))
        };
        let told = "x = x (column 1), y = y (column 2), z = z (column 3)".to_owned();
        assert_eq!(heights("x,y,z\n1,2,3\n4,5,-6", None).unwrap(), (Some(vec![3.0, -6.0]), told));
        let told =
            "x = x (column 2), y = y (column 3), z = -depth (column 1), with decimal commas".to_owned();
        assert_eq!(heights("depth;x;y\n3,5;1;2,5", None).unwrap(), (Some(vec![-3.5]), told));
        assert_eq!(heights("1 2 3\n4 5 6", Some("1,2,3")).unwrap().0, Some(vec![3.0, 6.0]));
        assert_eq!(heights("x,y,z\n1,2,0\n4,5,0", None).unwrap().0, None);
        assert_eq!(heights("x,y,z\n1,2,3", Some("x,y")).unwrap().0, None);
        let message = |text, asked| heights(text, asked).unwrap_err().to_string();
        assert_eq!(message("x,y,z\n1,2,3\n4,5,\n4,5,NA\n", None), "t: 1 heights instead of 3");
        assert_eq!(message("x,y,z\n1,2,3\n4,5,NA\n", Some("x,y,z")), "t:3: expected a height, found \"NA\"");
    }

    #[test]
    fn what_does_not_tell_is_refused_with_the_header() {
        let does_not_tell = "the header does not say which columns are x and y";
        for (text, message) in [
            ("a,b\n1,2", format!("t:1: {does_not_tell}: \"a,b\"")),
            ("# c\nfid,where,when\n1,2,3", format!("t:2: {does_not_tell}: \"fid,where,when\"")),
            ("1,500,600\n2,510,620", format!("t:1: {COUNTS_ROWS}: \"1,500,600\"")),
            ("7 0 0\n8 1 0\n9 1 1", format!("t:1: {COUNTS_ROWS}: \"7 0 0\"")),
        ] {
            assert_eq!(refused(text), message);
        }
        // A count that is none, and one beside which there is nothing else to take.
        for text in ["1,2,9\n3,4,9", "1,2\n2,4", "1,2,a\n2,4,b", "0 0 5\n1 0 5\n0 1 5"] {
            assert!(read(text).len() > 1, "{text:?}");
        }
        let columns = |text: &str, asked: &str| {
            let asked = asked.parse().unwrap();
            read_table(text.as_bytes(), "t", Some(&asked)).unwrap_err().to_string()
        };
        assert_eq!(columns("a,b\n1,2", "a,c"), "t:1: no column c, there are \"a, b\"");
        assert_eq!(columns("a,b\n1,2", "1,3"), "t:1: no column 3, there are \"a, b\"");
        let degrees = |text: &str| read_table(text.as_bytes(), "t", None).unwrap().1.unwrap().degrees;
        assert!(degrees("GPS Lat,GPS Long\n1,2\n") && !degrees("x,y\n1,2\n") && !degrees("1,2\n"));
        let zero = Columns { x: Column::Number(0), y: Column::Number(2), z: None };
        for (text, there) in [("a,b\n1,2", "\"a, b\""), ("1,2\n3,4", "2 columns and no header")] {
            let error = read_table(text.as_bytes(), "t", Some(&zero)).unwrap_err();
            assert_eq!(error.to_string(), format!("t:1: no column 0, there are {there}"));
        }
        assert_eq!(columns("1,2\n3,4", "x,y"), "t:1: no column x, there are 2 columns and no header");
    }

    #[test]
    fn likely_columns_are_named() {
        let likely = |text: &str| match read_table(text.as_bytes(), "t", None) {
            Err(ReadError::Columns { likely, .. }) => likely,
            other => panic!("{other:?}"),
        };
        let pair = |x: &str, y: &str| Some([x.to_owned(), y.to_owned()]);
        assert_eq!(likely("OBJECTID,name,a,b\n1,q,2,3"), pair("a", "b"));
        assert_eq!(likely("id,a\n1,2"), None);
        assert_eq!(likely("1 5 6\n2 6 7"), pair("2", "3"));
    }

    #[test]
    fn an_empty_field_is_not_skipped() {
        assert_eq!(refused("1,2\n,3,4\n"), "t:2: expected the x coordinate, found \"\"");
        assert_eq!(refused("1;2\n1.234,5;2\n"), "t:2: expected the x coordinate, found \"1.234,5\"");
    }

    /// As R writes tables: rows have names that the header does not count.
    #[test]
    fn rows_with_more_fields_than_the_header_are_refused() {
        let text = "\"x\" \"y\"\n\"1\" 0.5 0.25\n\"2\" 1.5 2.25\n";
        assert!(refused(text).starts_with("t:2: expected as many fields as the header has, found \"0.25\""));
        let asked = "2,3".parse().unwrap();
        let (read, _) = read_table(text.as_bytes(), "t", Some(&asked)).unwrap();
        assert_eq!(read.pslg.points[1], hexdel_geom::DVec2::new(1.5, 2.25));
    }

    #[test]
    fn decimal_commas_that_could_be_read_in_two_ways_are_named() {
        for text in ["1,5 2,5\n", "x,y\n1,5,2,5\n", "x,y\n\"1,5\",\"2,5\"\n"] {
            assert!(refused(text).contains("decimal commas are read where ; or a tab separates"), "{text:?}");
        }
    }

    #[test]
    fn faults_of_a_kind_are_told_together() {
        assert_eq!(
            refused("x,y\n1,a\n1,2\n1,b\n"),
            "t:2: expected the y coordinate, found \"a\"\nt:4: expected the y coordinate, found \"b\""
        );
        let many = refused(&format!("x,y\n{}", "1,a\n".repeat(9)));
        assert!(many.ends_with("\nand 4 more of this kind") && many.lines().count() == 6, "{many}");
        let endless = refused(&format!("x,y\n{}", "1,a\n".repeat(5000)));
        assert!(endless.ends_with("and at least 995 more of this kind"), "{endless}");
    }
}
