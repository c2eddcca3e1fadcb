//! NetCDF-3 with 64-bit offsets, by the crate `netcdf3`.
//!
//! That crate writes to what it owns and can seek in, so a file is made in memory, with one
//! variable at a time beside it.

use std::cell::RefCell;
use std::io::{self, Cursor, Seek, SeekFrom, Write};
use std::rc::Rc;

use netcdf3::{DataSet, FileWriter, Version};

use crate::error::WriteError;

/// The most items of a kind: the format has variables of less than 4 GiB.
const MAX_ITEMS: usize = 1 << 28;

/// The value of an attribute.
#[derive(Clone, Copy)]
pub(crate) enum Attribute<'a> {
    Text(&'a str),
    Integer(i32),
    Number(f64),
}

/// The values of a variable, all those of its first item before those of its second.
pub(crate) enum Values<'a> {
    Integers(Box<dyn Iterator<Item = i32> + 'a>),
    Numbers(Box<dyn Iterator<Item = f64> + 'a>),
}

impl<'a> Values<'a> {
    pub(crate) fn integers(values: impl IntoIterator<Item = i32, IntoIter: 'a>) -> Self {
        Self::Integers(Box::new(values.into_iter()))
    }

    pub(crate) fn numbers(values: impl IntoIterator<Item = f64, IntoIter: 'a>) -> Self {
        Self::Numbers(Box::new(values.into_iter()))
    }
}

/// A variable.
pub(crate) struct Variable<'a> {
    pub(crate) name: &'a str,
    /// The names of its dimensions; a variable without any has one value.
    pub(crate) dimensions: &'a [&'a str],
    pub(crate) attributes: Vec<(&'a str, Attribute<'a>)>,
    pub(crate) values: Values<'a>,
}

/// Checks that a file can have a dimension of so many items.
pub(crate) fn check_count(item: &'static str, count: usize, file: &str) -> Result<(), WriteError> {
    let (file, format) = (file.to_owned(), "NetCDF-3");
    match count {
        0 => Err(WriteError::Empty { file, format, item }),
        1..=MAX_ITEMS => Ok(()),
        _ => Err(WriteError::TooMany { file, format, item, count, limit: MAX_ITEMS }),
    }
}

/// Writes a file of dimensions with their lengths, attributes and variables.
pub(crate) fn write(
    out: &mut dyn Write,
    dimensions: &[(&str, usize)],
    attributes: &[(&str, Attribute<'_>)],
    variables: Vec<Variable<'_>>,
) -> io::Result<()> {
    let mut set = DataSet::new();
    for &(name, length) in dimensions {
        set.add_fixed_dim(name, length).map_err(|error| refused(&error))?;
    }
    for &(name, value) in attributes {
        match value {
            Attribute::Text(text) => set.add_global_attr_string(name, text),
            Attribute::Integer(integer) => set.add_global_attr_i32(name, vec![integer]),
            Attribute::Number(number) => set.add_global_attr_f64(name, vec![number]),
        }
        .map_err(|error| refused(&error))?;
    }
    for variable in &variables {
        define(&mut set, variable)?;
    }
    let bytes = Shared::default();
    let mut writer =
        FileWriter::open_seek_write("", Box::new(bytes.clone())).map_err(|error| refused(&error))?;
    writer.set_def(&set, Version::Offset64Bit, 0).map_err(|error| refused(&error))?;
    for variable in variables {
        match variable.values {
            Values::Integers(values) => writer.write_var_i32(variable.name, &values.collect::<Vec<_>>()),
            Values::Numbers(values) => writer.write_var_f64(variable.name, &values.collect::<Vec<_>>()),
        }
        .map_err(|error| refused(&error))?;
    }
    writer.close().map_err(|error| refused(&error))?;
    let made = bytes.0.borrow();
    out.write_all(made.get_ref())
}

fn define(set: &mut DataSet, variable: &Variable<'_>) -> io::Result<()> {
    let Variable { name, dimensions, attributes, values } = variable;
    match values {
        Values::Integers(_) => set.add_var_i32(name, dimensions),
        Values::Numbers(_) => set.add_var_f64(name, dimensions),
    }
    .map_err(|error| refused(&error))?;
    for &(attribute, value) in attributes {
        match value {
            Attribute::Text(text) => set.add_var_attr_string(name, attribute, text),
            Attribute::Integer(integer) => set.add_var_attr_i32(name, attribute, vec![integer]),
            Attribute::Number(number) => set.add_var_attr_f64(name, attribute, vec![number]),
        }
        .map_err(|error| refused(&error))?;
    }
    Ok(())
}

/// What the crate says, whose errors are not to be sent between threads.
fn refused(error: &impl std::fmt::Debug) -> io::Error {
    io::Error::other(format!("{error:?}"))
}

/// A file in memory, of which the writer has one end.
#[derive(Clone, Default)]
struct Shared(Rc<RefCell<Cursor<Vec<u8>>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for Shared {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.0.borrow_mut().seek(to)
    }
}
