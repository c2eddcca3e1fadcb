//! Parsing JSON that lies in memory, with faults that name file, line and column.

use std::borrow::Cow;
use std::io::{self, BufRead};

use serde::de::DeserializeOwned;

use crate::error::ReadError;
use crate::lines::{BYTE_ORDER_MARK, clip_message};

/// A text to be parsed and what errors call it.
pub(crate) struct Source<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) file: &'a str,
}

/// Reads all there is, for formats that have no lines.
pub(crate) fn slurp(mut reader: impl BufRead, file: &str) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    reader.read_to_end(&mut bytes).map_err(|source| ReadError::Io { file: file.to_owned(), source })?;
    if bytes.starts_with(BYTE_ORDER_MARK) {
        bytes.drain(..BYTE_ORDER_MARK.len());
    }
    Ok(bytes)
}

/// Takes the mark from the front of a stream, if there is one.
pub(crate) fn skip_byte_order_mark(reader: &mut impl BufRead) -> io::Result<()> {
    if reader.fill_buf()?.starts_with(BYTE_ORDER_MARK) {
        reader.consume(BYTE_ORDER_MARK.len());
    }
    Ok(())
}

/// Parses a text.
pub(crate) fn parse<T: DeserializeOwned>(source: &Source<'_>) -> Result<T, ReadError> {
    serde_json::from_slice(source.bytes).map_err(|error| json_error(&error, source.file))
}

/// Parses a text of one value or more, with white space or record separators (RFC 8142) between them.
pub(crate) fn sequence<T: DeserializeOwned>(
    source: &Source<'_>,
    mut take: impl FnMut(T) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    let text = without_separators(source.bytes);
    let mut values = serde_json::Deserializer::from_slice(&text).into_iter().peekable();
    if values.peek().is_none() {
        return parse(source).and_then(take);
    }
    values.try_for_each(|value| take(value.map_err(|error| json_error(&error, source.file))?))
}

/// The first value of a text that may be a sequence of them.
pub(crate) fn first<T: DeserializeOwned>(source: &Source<'_>) -> Result<T, ReadError> {
    let text = without_separators(source.bytes);
    match serde_json::Deserializer::from_slice(&text).into_iter().next() {
        None => parse(source),
        Some(value) => value.map_err(|error| json_error(&error, source.file)),
    }
}

/// A sequence with spaces for record separators, which stand in no string.
fn without_separators(bytes: &[u8]) -> Cow<'_, [u8]> {
    const SEPARATOR: u8 = 0x1e;
    if bytes.first() != Some(&SEPARATOR) {
        return Cow::Borrowed(bytes);
    }
    Cow::Owned(bytes.iter().map(|&byte| if byte == SEPARATOR { b' ' } else { byte }).collect())
}

/// The fault of a text.
pub(crate) fn json_error(error: &serde_json::Error, file: &str) -> ReadError {
    let message = error.to_string();
    // The place is told apart from the message.
    let place = format!(" at line {} column {}", error.line(), error.column());
    let message = message.strip_suffix(&place).unwrap_or(&message);
    ReadError::Json {
        file: file.to_owned(),
        line: error.line() as u64,
        column: error.column() as u64,
        message: clip_message(message.to_owned()),
    }
}
