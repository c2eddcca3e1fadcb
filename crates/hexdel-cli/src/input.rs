//! Reading files, or standard input where a file is called `-`.

use crate::exit::{Failure, unused, warn};
use clap::builder::PossibleValuesParser;
use hexdel_io::{Columns, MeshData, MeshFormat, PointFile, PointFormat, PointReader};
use std::io;
use std::path::Path;

/// What errors call standard input.
const STDIN: &str = "<stdin>";

/// The formats of standard input and output.
#[derive(clap::Args, Clone, Default)]
pub(crate) struct Formats {
    /// Format of standard output, or of standard input if only that is `-`
    #[arg(long, value_name = "NAME", value_parser = names(), hide_possible_values = true)]
    format: Option<String>,
    /// Format of standard input, if it differs from that of the output
    #[arg(long, value_name = "NAME", value_parser = names(), hide_possible_values = true)]
    input_format: Option<String>,
    /// Columns of x and y, perhaps of heights, in a table, by name or number
    #[arg(long, value_name = "X,Y")]
    columns: Option<Columns>,
}

/// The names of all formats.
pub(crate) fn names() -> PossibleValuesParser {
    let mut names: Vec<&str> = MeshFormat::names().chain(PointFormat::names()).collect();
    names.sort_unstable();
    names.dedup();
    PossibleValuesParser::new(names)
}

/// What a command reads and writes, of that which options are about.
pub(crate) struct Streams {
    /// Whether standard input is read.
    pub(crate) input: bool,
    /// Whether standard output is written, as a mesh or points.
    pub(crate) output: bool,
    /// Whether points are read, which may be a table.
    pub(crate) points: bool,
}

impl Formats {
    /// That of standard input alone.
    pub(crate) fn named(format: Option<&String>) -> Self {
        Self { format: format.cloned(), ..Self::default() }
    }

    /// An error if an option is given that nothing is there for.
    pub(crate) fn refuse_unused(&self, streams: &Streams) -> Result<(), Failure> {
        let of_input = self.input_format.is_none() && streams.input;
        if self.format.is_some() && !streams.output && !of_input {
            return unused("--format", "it names the format of -, other files have that of their extension");
        }
        if self.input_format.is_some() && !streams.input {
            return unused(
                "--input-format",
                "no file to read is -, others have the format of their extension",
            );
        }
        if self.columns.is_some() && !streams.points {
            return unused("--columns", "no table is read without --input");
        }
        Ok(())
    }

    /// What a mesh is written to standard output as.
    pub(crate) fn of_output(&self) -> Result<MeshFormat, Failure> {
        named(self.format.as_ref(), MeshFormat::from_name, "meshes", "output")
    }

    /// What the points beside a mesh are read with: of two files only one can be standard input, and
    /// the formats are those of the mesh if that is.
    pub(crate) fn beside(&self, mesh: &Path, points: Option<&Path>) -> Result<Self, Failure> {
        let [mesh_is, points_are] = [Some(mesh), points].map(|path| path.is_some_and(is_stream));
        self.refuse_unused(&Streams {
            input: mesh_is || points_are,
            output: false,
            points: points.is_some(),
        })?;
        let files = Self { columns: self.columns.clone(), ..Self::default() };
        Ok(if mesh_is { files } else { self.clone() })
    }

    fn of_input(&self) -> Option<&String> {
        self.input_format.as_ref().or(self.format.as_ref())
    }
}

fn named<F>(
    name: Option<&String>,
    find: impl Fn(&str) -> Option<F>,
    what: &'static str,
    stream: &'static str,
) -> Result<F, Failure> {
    let name = name.ok_or(Failure::NoFormat { stream })?;
    find(name).ok_or_else(|| Failure::UnknownFormat { name: name.clone(), what })
}

/// What points are written to standard output as.
pub(crate) fn format_of_points(name: Option<&String>) -> Result<PointFormat, Failure> {
    named(name, PointFormat::from_name, "points", "output")
}

/// Whether a path stands for standard input or output.
pub(crate) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Points, and segments, holes and regions if there are any. What was wrong with the file
/// and read all the same is a warning.
pub(crate) fn read_graph(path: &Path, formats: &Formats) -> Result<PointFile, Failure> {
    let reader = PointReader::new().columns(formats.columns.clone());
    let file = if is_stream(path) {
        let format = named(formats.of_input(), PointFormat::from_name, "points", "input")?;
        reader.read_from(io::stdin().lock(), format, STDIN)?
    } else {
        reader.read(path)?
    };
    warn_of(&file);
    refuse_columns(formats.columns.as_ref(), &file, path)?;
    Ok(file)
}

/// An error if columns were asked for of what is not a table.
pub(crate) fn refuse_columns(
    columns: Option<&Columns>,
    file: &PointFile,
    path: &Path,
) -> Result<(), Failure> {
    if columns.is_some() && file.columns.is_none() && !file.pslg.points.is_empty() {
        return no_table(path);
    }
    Ok(())
}

/// Columns were asked for of what is not a table.
pub(crate) fn no_table(path: &Path) -> Result<(), Failure> {
    unused("--columns", &format!("it is for tables, and {} is not one", path.display()))
}

/// Warns of what was wrong with a file and read all the same.
pub(crate) fn warn_of(file: &PointFile) {
    file.warnings.iter().for_each(|warning| warn(&warning.to_string()));
}

/// A mesh with what its file knows about it.
pub(crate) fn read_mesh_data(path: &Path, formats: &Formats) -> Result<MeshData, Failure> {
    if !is_stream(path) {
        return Ok(hexdel_io::read_mesh_data(path)?);
    }
    let format = named(formats.of_input(), MeshFormat::from_name, "meshes", "input")?;
    Ok(hexdel_io::read_mesh_from(io::stdin().lock(), format, STDIN)?)
}
