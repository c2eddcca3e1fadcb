//! A file as a sequence of words, wherever its lines end.
//!
//! For formats whose sections count their items: [`Tokens`] reads words and numbers
//! across lines, with errors that name the line, on top of [`Lines`], which bounds
//! memory. What the words mean is left to the formats.

use std::io::BufRead;
use std::str::FromStr;

use hexdel_geom::DVec2;

use crate::error::ReadError;
use crate::lines::{Comments, Lines, clip, quote};
use crate::mend::Faults;

/// The words of a file.
pub(crate) struct Tokens<R> {
    lines: Lines<R>,
    /// The row that is being read.
    row: String,
    /// How much of it has been read, bytes.
    done: usize,
    faults: Faults,
    /// Whether the name of another section was found where a number was due.
    is_beyond: bool,
}

impl<R: BufRead> Tokens<R> {
    pub(crate) fn new(reader: R, file: &str, comments: Comments) -> Self {
        let lines = Lines::new(reader, file, comments);
        Self { lines, row: String::new(), done: 0, faults: Faults::default(), is_beyond: false }
    }

    /// The number of the line last read.
    pub(crate) fn line(&self) -> u64 {
        self.lines.number()
    }

    pub(crate) fn file(&self) -> &str {
        self.lines.file()
    }

    /// The next word, `None` at the end of the file.
    pub(crate) fn word(&mut self) -> Result<Option<&str>, ReadError> {
        if !self.goes_on()? {
            return Ok(None);
        }
        let start = self.row.len() - self.rest().len();
        let length = self.row[start..].find(|c: char| c.is_ascii_whitespace());
        let end = length.map_or(self.row.len(), |length| start + length);
        self.done = end;
        Ok(Some(&self.row[start..end]))
    }

    /// Takes the rest of the line, or the next line if nothing is left of it; `None`
    /// at the end of the file.
    pub(crate) fn line_text(&mut self) -> Result<Option<&str>, ReadError> {
        if !self.goes_on()? {
            return Ok(None);
        }
        let start = self.row.len() - self.rest().len();
        self.done = self.row.len();
        Ok(Some(&self.row[start..]))
    }

    fn rest(&self) -> &str {
        self.row[self.done..].trim_ascii_start()
    }

    fn next_row(&mut self) -> Result<bool, ReadError> {
        self.row.clear();
        self.done = 0;
        let Some(row) = self.lines.next_row()? else {
            return Ok(false);
        };
        self.row.push_str(row.text);
        Ok(true)
    }

    /// What an item came to that was read to its last word: nothing, where there is a fault in it.
    ///
    /// An error only if reading cannot go on, as at the end of the file.
    pub(crate) fn note<T>(&mut self, item: Result<T, ReadError>) -> Result<Option<T>, ReadError> {
        let item = self.faults.note(item)?;
        if item.is_none() && (self.is_beyond || !self.goes_on()?) {
            // What is left of the file is no items: faults found there would be those of the reading.
            self.settle()?;
        }
        Ok(item)
    }

    /// The faults that were noted, if there are any.
    pub(crate) fn settle(&mut self) -> Result<(), ReadError> {
        self.faults.take()
    }

    /// Whether there is another word.
    fn goes_on(&mut self) -> Result<bool, ReadError> {
        while self.rest().is_empty() {
            if !self.next_row()? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The next word as a number or anything else that is parsed.
    pub(crate) fn parse<T: FromStr>(&mut self, expected: &'static str) -> Result<T, ReadError> {
        let parsed = match self.word()? {
            None => Err(None),
            Some(word) => word.parse().map_err(|_| Some((is_name(word), quote(word)))),
        };
        if let Err(Some((is_name, _))) = parsed {
            self.is_beyond |= is_name;
        }
        parsed.map_err(|found| found.map(|(_, word)| word)).map_err(|found| self.malformed(expected, found))
    }

    /// The next two words as a position, three if `heights`, of which the last
    /// must be 0.
    ///
    /// All of them are read whatever they are, so that what follows can be.
    pub(crate) fn position(&mut self, index: u64, heights: bool) -> Result<DVec2, ReadError> {
        let x = self.coordinate("the x coordinate", index);
        let y = self.coordinate("the y coordinate", index);
        let z = if heights { self.height() } else { Ok(()) };
        let position = DVec2::new(x?, y?);
        z.map(|()| position)
    }

    fn height(&mut self) -> Result<(), ReadError> {
        match self.parse("the z coordinate")? {
            0.0 => Ok(()),
            _ => Err(self.malformed("the z coordinate 0 of a plane mesh", None)),
        }
    }

    fn coordinate(&mut self, expected: &'static str, index: u64) -> Result<f64, ReadError> {
        let coordinate: f64 = self.parse(expected)?;
        if coordinate.is_finite() {
            return Ok(coordinate);
        }
        let word = self.row[..self.done].split_ascii_whitespace().next_back();
        Err(ReadError::NonFinite {
            file: self.file().to_owned(),
            line: self.line(),
            column: 0,
            item: "point",
            index,
            found: clip(word.unwrap_or_default()),
        })
    }

    /// A section's claim of how many items follow, at most `limit`.
    pub(crate) fn count(
        &mut self,
        expected: &'static str,
        section: &'static str,
        limit: u64,
    ) -> Result<u64, ReadError> {
        let count = self.parse(expected)?;
        if count > limit {
            return Err(ReadError::TooMany {
                file: self.file().to_owned(),
                line: self.line(),
                section,
                limit,
            });
        }
        Ok(count)
    }

    /// Checks that the file goes on where item `found` of `expected` is due.
    pub(crate) fn item(&mut self, section: &'static str, found: u64, expected: u64) -> Result<(), ReadError> {
        if self.goes_on()? {
            return Ok(());
        }
        let (file, line) = (self.file().to_owned(), self.line());
        // What was found before comes first.
        self.settle()?;
        Err(ReadError::Truncated { file, line, section, expected, found })
    }

    /// What was found is a quotation, by default the last word.
    pub(crate) fn malformed(&self, expected: &'static str, found: Option<String>) -> ReadError {
        let last = || self.row[..self.done].split_ascii_whitespace().next_back().map(quote);
        let found = found.or_else(last).unwrap_or_else(|| "the end of the file".to_owned());
        ReadError::Malformed { file: self.file().to_owned(), line: self.line(), column: 0, expected, found }
    }

    pub(crate) fn unsupported(&self, what: String) -> ReadError {
        ReadError::Unsupported { file: self.file().to_owned(), line: self.line(), what }
    }
}

/// Whether a word looks like the name of a section.
fn is_name(word: &str) -> bool {
    word.starts_with(|c: char| c == '$' || c.is_ascii_uppercase())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_cross_lines() {
        let mut tokens = Tokens::new(&b"a b\n\n # c\n 1\t2 # d\n\"e # f\" g\n"[..], "f", Comments::Anywhere);
        assert_eq!(tokens.word().unwrap(), Some("a"));
        assert_eq!(tokens.word().unwrap(), Some("b"));
        assert_eq!(tokens.parse::<u8>("n").unwrap(), 1);
        assert_eq!(tokens.line(), 4);
        assert_eq!(tokens.line_text().unwrap(), Some("2"));
        assert_eq!(tokens.line_text().unwrap(), Some("\"e"));
        assert_eq!(tokens.word().unwrap(), None);
        let error = tokens.parse::<u8>("n").unwrap_err().to_string();
        assert_eq!(error, "f:5: expected n, found the end of the file");
        let mut tokens = Tokens::new(&b"# a\nb"[..], "f", Comments::Nowhere);
        assert_eq!(tokens.line_text().unwrap(), Some("# a"));
        let error = tokens.parse::<u8>("n").unwrap_err().to_string();
        assert_eq!(error, "f:2: expected n, found \"b\"");
    }
}
