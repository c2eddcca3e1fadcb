//! Parsing JSON that lies in memory, with faults that name file, line and column.

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
