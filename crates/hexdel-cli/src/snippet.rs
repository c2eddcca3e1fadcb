//! The place in a file that an error is about, as miette draws it.
//!
//! The file is read again, up to the line at fault; what was read from standard
//! input is gone. Lines too long for a terminal are not shown.

use hexdel_io::ReadError;
use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents,
    SourceCode, SourceSpan, SpanContents,
};
use std::fs::File;
use std::io::{self, BufRead, BufReader, IsTerminal, Read};
use thiserror::Error;

/// Lines before the one at fault.
const BEFORE: u64 = 2;

/// Bytes of the longest line that is shown.
const WIDEST: u64 = 400;

/// Draws the line that an error is about, if there is one.
pub(crate) fn of(error: &ReadError) -> Option<String> {
    let error = match error {
        ReadError::Several { errors, .. } => errors.first()?,
        error => error,
    };
    let (file, line, label, found) = place(error)?;
    let excerpt = Excerpt::read(&file, line)?;
    let span = excerpt.span(error.column(), found.as_deref());
    let pointed = Pointed { excerpt, label: LabeledSpan::new_with_span(Some(label), span) };
    let terminal = io::stderr().is_terminal();
    let theme = if terminal { GraphicalTheme::unicode() } else { GraphicalTheme::none() };
    let handler = GraphicalReportHandler::new_themed(theme).with_context_lines(BEFORE as usize);
    let mut text = String::new();
    handler.render_report(&mut text, &pointed).ok()?;
    // The message comes first and has been said.
    let start = text.lines().position(|line| line.contains(&format!("[{file}:")))?;
    Some(text.lines().skip(start).flat_map(|line| [line, "\n"]).collect())
}

/// File and line, what to say there, and the text at fault.
fn place(error: &ReadError) -> Option<(String, u64, String, Option<String>)> {
    let text = error.to_string();
    let line = error.line()?;
    let mark = format!(":{line}:");
    let file = text[..text.find(&mark)?].to_owned();
    // After the line there may be a column.
    let message =
        text[file.len() + mark.len()..].trim_start_matches(|c: char| c.is_ascii_digit() || c == ':');
    let found = match error {
        ReadError::Malformed { found, .. } | ReadError::TrailingRow { found, .. } => {
            found.strip_prefix('"').and_then(|f| f.strip_suffix('"')).map(str::to_owned)
        }
        ReadError::NonFinite { found, .. } => Some(found.clone()),
        ReadError::IndexOutOfRange { index, .. } => Some(index.to_string()),
        ReadError::NonConsecutive { found, .. } => Some(found.to_string()),
        _ => None,
    };
    Some((file, line, message.trim().to_owned(), found))
}

/// Some lines of a file.
#[derive(Debug)]
struct Excerpt {
    file: String,
    text: String,
    /// The number of the first, from 0.
    first: usize,
    /// Where the line at fault starts in the text.
    at: usize,
}

impl Excerpt {
    fn read(file: &str, line: u64) -> Option<Self> {
        let mut reader = BufReader::new(File::open(file).ok()?);
        let first = line.saturating_sub(BEFORE).max(1);
        let mut excerpt =
            Self { file: file.to_owned(), text: String::new(), first: first as usize - 1, at: 0 };
        for number in 1..=line {
            let mut bytes = Vec::new();
            reader.by_ref().take(WIDEST + 1).read_until(b'\n', &mut bytes).ok()?;
            if bytes.is_empty() || bytes.len() as u64 > WIDEST && !bytes.ends_with(b"\n") {
                return None;
            }
            if number >= first {
                excerpt.at = excerpt.text.len();
                let line = String::from_utf8(bytes).ok()?;
                excerpt.text.push_str(line.trim_end_matches(['\r', '\n']));
                excerpt.text.push('\n');
            }
        }
        // What controls a terminal is no text to print.
        excerpt.text.chars().all(|c| c == '\n' || c == '\t' || !c.is_control()).then_some(excerpt)
    }

    /// The text at fault in the last line, or all of the line. Where its column is not known,
    /// fields are looked for from behind: the number of a row is seldom what is wrong with it.
    fn span(&self, column: Option<u64>, found: Option<&str>) -> SourceSpan {
        let line = self.text[self.at..].trim_end();
        let indent = line.len() - line.trim_start().len();
        let found = found.filter(|f| !f.is_empty());
        if let Some(offset) = column.map(|column| column as usize - 1) {
            let offset = self.skipped(offset).min(line.len());
            let found = found.map(|f| f.strip_suffix("..").unwrap_or(f));
            let length = found
                .filter(|f| line.get(offset..).is_some_and(|rest| rest.starts_with(f)))
                .map_or(0, str::len);
            return (self.at + offset, length).into();
        }
        let field = found.and_then(|f| Some((whole_word(line, f)?, f.len())));
        let (offset, length) = field.unwrap_or((indent, line.len() - indent));
        (self.at + offset, length).into()
    }

    /// An offset in the line as it is here: readers do not count a byte order mark.
    fn skipped(&self, offset: usize) -> usize {
        const MARK: char = '\u{feff}';
        offset + if self.text[self.at..].starts_with(MARK) { MARK.len_utf8() } else { 0 }
    }
}

/// Where a word last stands in a line, by itself and not as a part of another.
fn whole_word(line: &str, word: &str) -> Option<usize> {
    let of_word = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '+' | '_');
    let alone = |&(at, _): &(usize, &str)| {
        let (before, after) = (&line[..at], &line[at + word.len()..]);
        !before.ends_with(of_word) && !after.starts_with(of_word)
    };
    line.rmatch_indices(word).find(alone).map(|(at, _)| at)
}

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        before: usize,
        after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let contents = self.text.read_span(span, before, after)?;
        let shifted = MietteSpanContents::new_named(
            self.file.clone(),
            contents.data(),
            *contents.span(),
            contents.line() + self.first,
            contents.column(),
            contents.line_count(),
        );
        Ok(Box::new(shifted))
    }
}

/// A message that is only its place.
#[derive(Debug, Error)]
#[error("here")]
struct Pointed {
    excerpt: Excerpt,
    label: LabeledSpan,
}

impl Diagnostic for Pointed {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        Some(&self.excerpt)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        Some(Box::new(std::iter::once(self.label.clone())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(text: &str) -> Option<String> {
        drawn_of("a.node", text)
    }

    fn drawn_of(name: &str, text: &str) -> Option<String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        of(&hexdel_io::read_points(&path).unwrap_err())
    }

    #[test]
    fn the_field_is_pointed_at_in_its_line() {
        let text = drawn("3 2\n0 0 0\n1 1 x7\n2 0 1\n").unwrap();
        assert!(text.contains("a.node:3:5]"), "{text}");
        let (number, line) = (text.find("3 |").or(text.find("3 │")), text.find("1 1 x7"));
        assert!(number.is_some() && number < line, "{text}");
        assert!(text.contains("expected") && !text.contains("2 0 1"), "{text}");
    }

    /// The columns that carets are under, from 0, in the line after.
    fn carets(name: &str, text: &str, line: &str) -> std::ops::Range<usize> {
        let drawn = drawn_of(name, text).unwrap();
        let lines: Vec<&str> = drawn.lines().collect();
        let at = lines.iter().rposition(|drawn| drawn.ends_with(line)).unwrap_or_else(|| panic!("{drawn}"));
        let start = lines[at].chars().count() - line.len();
        let marked: Vec<usize> =
            (0..).zip(lines[at + 1].chars()).filter(|(_, c)| "^|─┬".contains(*c)).map(|m| m.0).collect();
        marked[0] - start..marked[marked.len() - 1] + 1 - start
    }

    #[test]
    fn carets_are_under_the_token_at_fault() {
        let head = "4 2\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n1 1\n";
        // The index, not the marker of the same number.
        assert_eq!(carets("a.poly", &format!("{head}1 1 9 9\n0\n"), "1 1 9 9"), 4..5);
        // The number of the row; a field, not a part of another; the end of a row.
        assert_eq!(carets("a.node", "2 2\n1 0 0\n3 3 3\n", "3 3 3"), 0..1);
        assert_eq!(carets("a.node", "1 2 2 0\n0 7 x7 7 x\n", "0 7 x7 7 x"), 4..6);
        assert_eq!(carets("a.node", "1 2 1 0\n  0 1 1 1x 1\n", "  0 1 1 1x 1"), 8..10);
        assert_eq!(carets("a.node", "1 2\n0 1\n", "0 1"), 3..4);
        assert_eq!(carets("a.csv", "x,y\n\"1\",\"b\"\n", "\"1\",\"b\""), 5..6);
    }

    #[test]
    fn what_cannot_be_shown_is_left() {
        assert!(drawn("").is_none());
        assert!(drawn("1 2\n0 0 \u{1b}[31m\n").is_none());
        assert!(drawn(&format!("1 2\n0 0 {}\n", "x".repeat(500))).is_none());
    }
}
