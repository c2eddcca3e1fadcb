//! A bounded line reader and the fields of a line, with errors that name both.
//!
//! Nothing here trusts the file: memory is bounded by [`MAX_LINE`] whatever the
//! file holds. What the fields mean is left to the formats.

use std::io::{BufRead, Read};

use hexdel_geom::DVec2;

use crate::error::ReadError;
use crate::promised::PREFIX;

/// The longest line accepted, in bytes. A row of coordinates takes about 60, so
/// this leaves room for tens of thousands of attributes per point.
pub(crate) const MAX_LINE: usize = 1 << 20;

/// What some editors put before a text in UTF-8.
pub(crate) const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The longest quotation from a file in an error, in characters.
const MAX_QUOTE: usize = 40;

/// The longest message of a parser in an error, in characters.
const MAX_MESSAGE: usize = 240;

/// Where a `#` begins a comment.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Comments {
    /// Anywhere in a line, as in Triangle's files.
    Anywhere,
    /// As the first character that is no space: tables have text columns.
    WholeLine,
    /// Nowhere: the format has names in which a `#` may stand.
    Nowhere,
}

/// Reads the lines of a file that hold more than comments.
pub(crate) struct Lines<R> {
    reader: R,
    file: String,
    comments: Comments,
    buffer: Vec<u8>,
    /// Number of the line in `buffer`, from 1; 0 before the first.
    number: u64,
    /// Comments so far that are ours, with their lines.
    notes: Vec<(u64, String)>,
}

impl<R: BufRead> Lines<R> {
    pub(crate) fn new(reader: R, file: &str, comments: Comments) -> Self {
        Self { reader, file: file.to_owned(), comments, buffer: Vec::new(), number: 0, notes: Vec::new() }
    }

    pub(crate) fn file(&self) -> &str {
        &self.file
    }

    /// The number of the line last read.
    pub(crate) fn number(&self) -> u64 {
        self.number
    }

    /// The comments read so far that say what a mesh was made to keep, with their lines.
    pub(crate) fn notes(&self) -> impl ExactSizeIterator<Item = (u64, &str)> {
        self.notes.iter().map(|(line, note)| (*line, note.as_str()))
    }

    /// The next line with something on it, trimmed, without comment.
    pub(crate) fn next_row(&mut self) -> Result<Option<Row<'_>>, ReadError> {
        while self.fill()? {
            let text = self.buffer.trim_ascii_start();
            let is_comment = self.comments != Comments::Nowhere && text.starts_with(b"#");
            if !text.is_empty() && !is_comment {
                return self.row().map(Some);
            }
            // A comment must be text as well: a binary file is not to be taken
            // for one of comments only.
            let comment = self.text()?.trim_ascii_start().trim_start_matches(['#', ' ']).trim_ascii_end();
            if comment.starts_with(PREFIX) {
                let note = (self.number, comment.to_owned());
                self.notes.push(note);
            }
        }
        Ok(None)
    }

    /// The next such line, which is one of `expected` rows of a section, after `found` of them.
    pub(crate) fn due_row(
        &mut self,
        section: &'static str,
        found: u64,
        expected: u64,
    ) -> Result<Row<'_>, ReadError> {
        let (file, line) = (self.file.clone(), self.number);
        self.next_row()?.ok_or(ReadError::Truncated { file, line, section, expected, found })
    }

    /// Passes over a line, whatever is on it.
    pub(crate) fn skip_line(&mut self) -> Result<(), ReadError> {
        if self.fill()? { self.text().map(drop) } else { Ok(()) }
    }

    fn row(&self) -> Result<Row<'_>, ReadError> {
        let whole = self.text()?;
        let mut text = whole;
        if self.comments == Comments::Anywhere
            && let Some(at) = text.find('#')
        {
            text = &text[..at];
        }
        let indent = whole.len() - whole.trim_ascii_start().len();
        Ok(Row { file: &self.file, line: self.number, text: text.trim_ascii(), indent })
    }

    fn text(&self) -> Result<&str, ReadError> {
        std::str::from_utf8(&self.buffer)
            .map_err(|_| ReadError::NotUtf8 { file: self.file.clone(), line: self.number })
    }

    /// Reads one line without its end into the buffer; false at the end of file.
    fn fill(&mut self) -> Result<bool, ReadError> {
        self.buffer.clear();
        let mut bounded = self.reader.by_ref().take(MAX_LINE as u64 + 1);
        let read = bounded.read_until(b'\n', &mut self.buffer);
        let length = read.map_err(|source| ReadError::Io { file: self.file.clone(), source })?;
        if length == 0 {
            return Ok(false);
        }
        self.number += 1;
        if length > MAX_LINE {
            return Err(ReadError::LineTooLong {
                file: self.file.clone(),
                line: self.number,
                limit: MAX_LINE,
            });
        }
        if self.number == 1 && self.buffer.starts_with(BYTE_ORDER_MARK) {
            self.buffer.drain(..BYTE_ORDER_MARK.len());
        }
        Ok(true)
    }
}

/// One line.
#[derive(Clone, Copy)]
pub(crate) struct Row<'a> {
    pub(crate) file: &'a str,
    pub(crate) line: u64,
    pub(crate) text: &'a str,
    /// Where the text starts in the line, in bytes.
    indent: usize,
}

impl<'a> Row<'a> {
    /// The fields between white space.
    pub(crate) fn fields(self) -> Fields<'a> {
        Fields { row: self, rest: self.text, commas: false }
    }

    /// The fields between white space and commas.
    pub(crate) fn fields_with_commas(self) -> Fields<'a> {
        Fields { row: self, rest: self.text, commas: true }
    }

    /// Where a part of this row starts in the line, in bytes from 1, or the end of the
    /// row if there is none; 0 for what is no part of it.
    pub(crate) fn column_of(&self, part: Option<&str>) -> u64 {
        let at = match part {
            None => Some(self.text.len()),
            Some(part) => part.as_ptr().addr().checked_sub(self.text.as_ptr().addr()),
        };
        let within = at.filter(|at| at + part.map_or(0, str::len) <= self.text.len());
        within.map_or(0, |at| (self.indent + at + 1) as u64)
    }

    /// The number in `field`.
    pub(crate) fn number(&self, field: Option<&str>, expected: &'static str) -> Result<f64, ReadError> {
        let number = field.and_then(|text| text.parse().ok());
        number.ok_or_else(|| self.malformed(expected, field))
    }

    /// The position whose coordinates are the two `fields`.
    pub(crate) fn position(
        &self,
        fields: [Option<&str>; 2],
        item: &'static str,
        index: u64,
    ) -> Result<DVec2, ReadError> {
        self.position_by(fields, item, index, |text| text.parse().ok())
    }

    /// The same with numbers of another kind.
    pub(crate) fn position_by(
        &self,
        fields: [Option<&str>; 2],
        item: &'static str,
        index: u64,
        parse: impl Fn(&str) -> Option<f64>,
    ) -> Result<DVec2, ReadError> {
        let number = |axis: usize, expected| {
            fields[axis].and_then(&parse).ok_or_else(|| self.malformed(expected, fields[axis]))
        };
        let (x, y) = (number(0, "the x coordinate")?, number(1, "the y coordinate")?);
        match [x, y].iter().position(|c| !c.is_finite()) {
            None => Ok(DVec2::new(x, y)),
            Some(axis) => Err(ReadError::NonFinite {
                file: self.file.to_owned(),
                line: self.line,
                column: self.column_of(fields[axis]),
                item,
                index,
                found: clip(fields[axis].unwrap_or_default()),
            }),
        }
    }

    pub(crate) fn malformed(&self, expected: &'static str, found: Option<&str>) -> ReadError {
        ReadError::Malformed {
            file: self.file.to_owned(),
            line: self.line,
            column: self.column_of(found),
            expected,
            found: found.map_or_else(|| "end of line".to_owned(), quote),
        }
    }
}

/// The fields of a line that are still to be read.
#[derive(Clone, Copy)]
pub(crate) struct Fields<'a> {
    pub(crate) row: Row<'a>,
    rest: &'a str,
    /// Whether commas separate as well as white space.
    commas: bool,
}

impl<'a> Fields<'a> {
    /// The next field as it stands, if there is one.
    pub(crate) fn text(&mut self) -> Option<&'a str> {
        let separates = |c: char| c.is_ascii_whitespace() || self.commas && c == ',';
        let rest = self.rest.trim_start_matches(separates);
        let (field, rest) = rest.split_at(rest.find(separates).unwrap_or(rest.len()));
        self.rest = rest;
        (!field.is_empty()).then_some(field)
    }

    /// The next field, which stays to be read.
    pub(crate) fn peek(&self) -> Option<&'a str> {
        let mut copy = *self;
        copy.text()
    }

    /// The next field as an integer.
    pub(crate) fn integer<T: std::str::FromStr>(&mut self, expected: &'static str) -> Result<T, ReadError> {
        let field = self.text();
        let integer = field.and_then(|text| text.parse().ok());
        integer.ok_or_else(|| self.row.malformed(expected, field))
    }

    /// The next field as an integer, `default` at the end of the line.
    pub(crate) fn integer_or<T: std::str::FromStr>(
        &mut self,
        default: T,
        expected: &'static str,
    ) -> Result<T, ReadError> {
        if self.peek().is_none() {
            return Ok(default);
        }
        self.integer(expected)
    }

    /// The next field as a number.
    pub(crate) fn number(&mut self, expected: &'static str) -> Result<f64, ReadError> {
        let field = self.text();
        self.row.number(field, expected)
    }

    /// The next three fields as a position in the plane z = 0.
    pub(crate) fn flat_position(&mut self, item: &'static str, index: u64) -> Result<DVec2, ReadError> {
        let position = self.position(item, index)?;
        let z = self.text();
        match z.and_then(|text| text.parse::<f64>().ok()) {
            Some(0.0) => Ok(position),
            _ => Err(self.row.malformed("the z coordinate 0 of a plane mesh", z)),
        }
    }

    /// The next two fields as a position.
    pub(crate) fn position(&mut self, item: &'static str, index: u64) -> Result<DVec2, ReadError> {
        let fields = [self.text(), self.text()];
        self.row.position(fields, item, index)
    }

    /// Checks that nothing is left.
    pub(crate) fn end(mut self) -> Result<(), ReadError> {
        match self.text() {
            None => Ok(()),
            extra => Err(self.row.malformed("end of line", extra)),
        }
    }
}

/// `text` in quotation marks, cut to a readable length.
pub(crate) fn quote(text: &str) -> String {
    format!("\"{}\"", clip(text))
}

/// `text` cut to a readable length.
pub(crate) fn clip(text: &str) -> String {
    match text.char_indices().nth(MAX_QUOTE) {
        Some((end, _)) => format!("{}..", &text[..end]),
        None => text.to_owned(),
    }
}

/// A parser's message, which may quote the file at any length: cut likewise, on one
/// line.
pub(crate) fn clip_message(mut message: String) -> String {
    if let Some((end, _)) = message.char_indices().nth(MAX_MESSAGE) {
        message.truncate(end);
        message.push_str("..");
    }
    message.replace(char::is_control, " ")
}
