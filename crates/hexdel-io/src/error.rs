//! What can go wrong with a file, with the file, the line and the item named.

mod write;

use std::io;
use std::path::Path;

use hexdel_geom::PslgLayoutError;
use thiserror::Error;

pub use write::WriteError;

/// Faults of a kind that are counted before reading is given up.
pub(crate) const MOST_FAULTS: u64 = 1000;

/// Why a file was not read.
///
/// Lines are counted from 1. Whatever is quoted from the file is cut to
/// a readable length.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// There is no such file.
    #[error("{file}: no such file")]
    Missing {
        /// The file asked for, or the one that must lie beside it.
        file: String,
    },
    /// The system refused to open or read the file.
    #[error("{file}: {source}")]
    Io {
        /// The file.
        file: String,
        /// What the system says.
        source: io::Error,
    },
    /// The file name does not tell a format that can be read here.
    #[error("{file}: unknown extension, expected one of {known}")]
    UnknownExtension {
        /// The file.
        file: String,
        /// The extensions that can be read.
        known: &'static str,
    },
    /// The line is not UTF-8 text.
    #[error("{file}:{line}: not UTF-8 text")]
    NotUtf8 {
        /// The file.
        file: String,
        /// The line.
        line: u64,
    },
    /// The line is longer than any line of the format.
    #[error("{file}:{line}: line longer than {limit} bytes")]
    LineTooLong {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// The longest line accepted, bytes.
        limit: usize,
    },
    /// A field is missing, superfluous or of the wrong kind.
    #[error("{}: expected {expected}, found {found}", at(file, *line))]
    Malformed {
        /// The file.
        file: String,
        /// The line; 0 if the format does not tell.
        line: u64,
        /// Where in the line, in bytes from 1; 0 if it is not known.
        column: u64,
        /// What should be there.
        expected: &'static str,
        /// What is there: the field in quotation marks, or "end of line".
        found: String,
    },
    /// A coordinate is infinite, not a number, or beyond the range of a double.
    #[error("{}: coordinate {found} of {item} {index} is not finite", at(file, *line))]
    NonFinite {
        /// The file.
        file: String,
        /// The line; 0 if the format does not tell.
        line: u64,
        /// Where in the line, in bytes from 1; 0 if it is not known.
        column: u64,
        /// "point", "hole", "region" or "record".
        item: &'static str,
        /// Its index, counted as the file does (from 0 in tables).
        index: u64,
        /// The coordinate as written.
        found: String,
    },
    /// The file ends before a section's header.
    #[error("{file}:{line}: file ends before the number of {section}")]
    MissingSection {
        /// The file.
        file: String,
        /// The last row of the section before, 0 if there is none.
        line: u64,
        /// What the section would have held.
        section: &'static str,
    },
    /// The file ends before all announced rows.
    #[error("{file}:{line}: file ends after {found} of {expected} {section}")]
    Truncated {
        /// The file.
        file: String,
        /// The last line of the file.
        line: u64,
        /// What the rows hold.
        section: &'static str,
        /// How many the header announces.
        expected: u64,
        /// How many there are.
        found: u64,
    },
    /// There is text after the last announced row.
    #[error("{file}:{line}: expected the end of the file after the {section}, found {found}")]
    TrailingRow {
        /// The file.
        file: String,
        /// The first such line.
        line: u64,
        /// Where in the line, in bytes from 1; 0 if it is not known.
        column: u64,
        /// The section that should have been the last.
        section: &'static str,
        /// The first field of the line, in quotation marks.
        found: String,
    },
    /// Rows are not numbered consecutively, from 0 or 1.
    #[error("{file}:{line}: expected row number {expected}, found {found}")]
    NonConsecutive {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// Where in the line, in bytes from 1; 0 if it is not known.
        column: u64,
        /// The row number that was due.
        expected: u64,
        /// The row number that is there.
        found: i64,
    },
    /// A segment or triangle refers to a point that is not there.
    #[error("{}: no point {index}, there are {points} counted from {first}", at(file, *line))]
    IndexOutOfRange {
        /// The file.
        file: String,
        /// The line; 0 if the format does not tell.
        line: u64,
        /// Where in the line, in bytes from 1; 0 if it is not known.
        column: u64,
        /// The index as written.
        index: i64,
        /// The index of the first point, 0 or 1.
        first: u64,
        /// How many points there are.
        points: u64,
    },
    /// The points of a `.poly` file lie in a `.node` file, but no file system was
    /// given to look for it.
    #[error("{file}:{line}: the points are in another file")]
    PointsElsewhere {
        /// The file.
        file: String,
        /// The line that says so.
        line: u64,
    },
    /// More points or triangles than 32-bit indices can tell apart.
    #[error("{file}:{line}: more than {limit} {section}")]
    TooMany {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// What there is too much of.
        section: &'static str,
        /// How many can be held.
        limit: u64,
    },
    /// The file holds something valid that cannot be taken: other cells than
    /// triangles, a binary encoding.
    #[error("{}: {what} cannot be read", at(file, *line))]
    Unsupported {
        /// The file.
        file: String,
        /// The line; 0 if the format does not tell.
        line: u64,
        /// What it is.
        what: String,
    },
    /// The format takes two files, but one stream was given.
    #[error("{file}: the format {format} takes two files")]
    TwoFiles {
        /// The name of the stream.
        file: String,
        /// The format.
        format: &'static str,
    },
    /// The format is written only.
    #[error("{file}: the format {format} is written, not read")]
    WriteOnly {
        /// The file.
        file: String,
        /// The format.
        format: &'static str,
    },
    /// An array has neither one entry per item nor none.
    #[error("{}: {found} {array} instead of {expected}", at(file, *line))]
    Length {
        /// The file.
        file: String,
        /// The line; 0 if the format does not tell.
        line: u64,
        /// What the array holds.
        array: &'static str,
        /// The length that would fit.
        expected: u64,
        /// The length it has.
        found: u64,
    },
    /// The arrays of a PSLG do not fit together.
    #[error("{file}: {source}")]
    Layout {
        /// The file.
        file: String,
        /// Which do not.
        source: PslgLayoutError,
    },
    /// The text is no JSON, or not that of what should be read.
    #[error("{}: {message}", at_column(file, *line, *column))]
    Json {
        /// The file.
        file: String,
        /// The line; 0 if it is not known.
        line: u64,
        /// The column, counted from 1; 0 before the first character of a line.
        column: u64,
        /// What the parser says.
        message: String,
    },
    /// The text is no XML, or not that of a grid.
    #[error("{file}:{line}: {message}")]
    Xml {
        /// The file.
        file: String,
        /// The line that was reached.
        line: u64,
        /// What is wrong.
        message: String,
    },
    /// The text is no RON, or not that of what should be read.
    #[error("{file}:{line}:{column}: {message}")]
    Ron {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// The column, counted from 1.
        column: u64,
        /// What the parser says.
        message: String,
    },
    /// Nothing tells which columns of a table are x and y.
    #[error("{file}:{line}: {fault}: {header}")]
    Columns {
        /// The file.
        file: String,
        /// The line of the header, or the first row if there is none.
        line: u64,
        /// What does not tell.
        fault: &'static str,
        /// The header, or the first row, cut to a readable length.
        header: String,
        /// Columns with numbers that are likely to be meant, by name or number.
        likely: Option<[String; 2]>,
    },
    /// A column that was asked for is not there.
    #[error("{file}:{line}: no column {column}, there are {header}")]
    NoColumn {
        /// The file.
        file: String,
        /// The line of the header, or the first row if there is none.
        line: u64,
        /// The name or number asked for.
        column: String,
        /// The header, or how many columns there are.
        header: String,
    },
    /// Several faults of a kind.
    #[error("{}", listed(errors, *count))]
    Several {
        /// The first five.
        errors: Vec<ReadError>,
        /// How many there are; counting ends at a thousand.
        count: u64,
    },
    /// A shapefile is not as its format wants it.
    #[error("{}: {message}", at_record(file, *record))]
    Shapefile {
        /// The file.
        file: String,
        /// The record, counted from 1; 0 in what stands before all records.
        record: u64,
        /// What is wrong.
        message: String,
    },
    /// A raster is not as its format wants it.
    #[error("{file}:{line}: {message}")]
    Raster {
        /// The file.
        file: String,
        /// The line.
        line: u64,
        /// What is wrong.
        message: String,
    },
}

impl ReadError {
    /// The line at fault, counted from 1, if it is known.
    pub fn line(&self) -> Option<u64> {
        let line = match self {
            Self::Missing { .. }
            | Self::Io { .. }
            | Self::UnknownExtension { .. }
            | Self::TwoFiles { .. }
            | Self::WriteOnly { .. }
            | Self::Shapefile { .. }
            | Self::Layout { .. } => 0,
            Self::NotUtf8 { line, .. }
            | Self::LineTooLong { line, .. }
            | Self::Malformed { line, .. }
            | Self::NonFinite { line, .. }
            | Self::MissingSection { line, .. }
            | Self::Truncated { line, .. }
            | Self::TrailingRow { line, .. }
            | Self::NonConsecutive { line, .. }
            | Self::IndexOutOfRange { line, .. }
            | Self::PointsElsewhere { line, .. }
            | Self::TooMany { line, .. }
            | Self::Unsupported { line, .. }
            | Self::Length { line, .. }
            | Self::Json { line, .. }
            | Self::Xml { line, .. }
            | Self::Ron { line, .. }
            | Self::Columns { line, .. }
            | Self::NoColumn { line, .. }
            | Self::Raster { line, .. } => *line,
            Self::Several { errors, .. } => return errors.first().and_then(Self::line),
        };
        (line > 0).then_some(line)
    }

    /// Where in the line the fault is, in bytes from 1, if it is known.
    pub fn column(&self) -> Option<u64> {
        let column = match self {
            Self::Malformed { column, .. }
            | Self::NonFinite { column, .. }
            | Self::TrailingRow { column, .. }
            | Self::NonConsecutive { column, .. }
            | Self::IndexOutOfRange { column, .. }
            | Self::Json { column, .. }
            | Self::Ron { column, .. } => *column,
            Self::Several { errors, .. } => return errors.first().and_then(Self::column),
            _ => 0,
        };
        (column > 0).then_some(column)
    }

    pub(crate) fn open(path: &Path, source: io::Error) -> Self {
        let file = path.display().to_string();
        if source.kind() == io::ErrorKind::NotFound {
            Self::Missing { file }
        } else {
            Self::Io { file, source }
        }
    }
}

/// The first faults of a kind, one a line, and how many more there are.
fn listed(errors: &[ReadError], count: u64) -> String {
    let mut lines: Vec<String> = errors.iter().map(ToString::to_string).collect();
    match count.saturating_sub(errors.len() as u64) {
        0 => {}
        more if count >= MOST_FAULTS => lines.push(format!("and at least {more} more of this kind")),
        more => lines.push(format!("and {more} more of this kind")),
    }
    lines.join("\n")
}

/// File and, if it is known, line.
fn at(file: &str, line: u64) -> String {
    match line {
        0 => file.to_owned(),
        _ => format!("{file}:{line}"),
    }
}

/// File and, if they are known, line and column.
fn at_column(file: &str, line: u64, column: u64) -> String {
    match line {
        0 => file.to_owned(),
        _ => format!("{file}:{line}:{column}"),
    }
}

/// File and, if it is known, record.
fn at_record(file: &str, record: u64) -> String {
    match record {
        0 => file.to_owned(),
        _ => format!("{file}: record {record}"),
    }
}
