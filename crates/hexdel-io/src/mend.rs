//! Faults of a file: those that can be read around, and several of a kind.

use std::fmt;
use std::mem::{Discriminant, discriminant};

use crate::error::{MOST_FAULTS, ReadError};
use crate::lines::{Fields, Row};

/// Faults of a kind that are told one by one.
const SHOWN: usize = 5;

/// A fault of a file that was read all the same.
#[derive(Debug)]
#[non_exhaustive]
pub struct ReadWarning {
    /// The first fault of the kind.
    pub fault: ReadError,
    /// How it was read.
    pub read_as: &'static str,
    /// How many faults there are of the kind.
    pub count: u64,
}

impl fmt::Display for ReadWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.fault, self.read_as)?;
        match self.count {
            0 | 1 => Ok(()),
            2 => write!(f, ", and once more"),
            more => write!(f, ", and {} times more", more - 1),
        }
    }
}

/// What was read around, or may not be.
#[derive(Debug, Default)]
pub(crate) struct Mends {
    strict: bool,
    warnings: Vec<ReadWarning>,
}

impl Mends {
    /// None yet; with `strict` each is an error.
    pub(crate) fn new(strict: bool) -> Self {
        Self { strict, warnings: Vec::new() }
    }

    pub(crate) fn into_warnings(self) -> Vec<ReadWarning> {
        self.warnings
    }

    /// A fault that can be read around.
    pub(crate) fn forgive(
        &mut self,
        read_as: &'static str,
        fault: impl FnOnce() -> ReadError,
    ) -> Result<(), ReadError> {
        if self.strict {
            return Err(fault());
        }
        match self.warnings.iter_mut().find(|w| w.read_as == read_as) {
            Some(warning) => warning.count += 1,
            None => self.warnings.push(ReadWarning { fault: fault(), read_as, count: 1 }),
        }
        Ok(())
    }

    /// The fields of a row, between commas as well as white space.
    pub(crate) fn fields<'a>(&mut self, row: Row<'a>) -> Result<Fields<'a>, ReadError> {
        if let Some(at) = row.text.find(',') {
            if self.strict {
                return Ok(row.fields());
            }
            let comma = &row.text[at..=at];
            self.forgive("commas are read as spaces", || {
                row.malformed("white space between fields", Some(comma))
            })?;
        }
        Ok(row.fields_with_commas())
    }
}

/// Faults of rows or items, of which several of a kind are told together.
#[derive(Debug, Default)]
pub(crate) struct Faults {
    errors: Vec<ReadError>,
    kind: Option<Discriminant<ReadError>>,
    count: u64,
}

impl Faults {
    /// What a row came to: an error only if reading cannot go on.
    pub(crate) fn note<T>(&mut self, row: Result<T, ReadError>) -> Result<Option<T>, ReadError> {
        let error = match row {
            Ok(read) => return Ok(Some(read)),
            Err(error) => error,
        };
        let of_a_row = matches!(
            error,
            ReadError::Malformed { .. }
                | ReadError::NonFinite { .. }
                | ReadError::IndexOutOfRange { .. }
                | ReadError::Layout { .. }
        );
        if !of_a_row {
            // What was found before comes first.
            return self.take().and(Err(error));
        }
        if *self.kind.get_or_insert_with(|| discriminant(&error)) == discriminant(&error) {
            self.count += 1;
            if self.errors.len() < SHOWN {
                self.errors.push(error);
            }
        }
        if self.count < MOST_FAULTS { Ok(None) } else { self.take().map(|()| None) }
    }

    /// The faults there were, if any.
    pub(crate) fn take(&mut self) -> Result<(), ReadError> {
        let (errors, count) = (std::mem::take(&mut self.errors), std::mem::take(&mut self.count));
        if count > 1 {
            return Err(ReadError::Several { errors, count });
        }
        errors.into_iter().next().map_or(Ok(()), Err)
    }
}
