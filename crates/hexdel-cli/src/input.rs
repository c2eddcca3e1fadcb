//! Reading files, or standard input where a file is called `-`.

use crate::exit::Failure;
use clap::builder::PossibleValuesParser;
use hexdel::Pslg;
use hexdel_io::{MeshData, MeshFormat, PointFormat};
use std::io;
use std::path::Path;

/// What errors call standard input.
const STDIN: &str = "<stdin>";

/// The formats of standard input and output.
#[derive(clap::Args, Clone, Default)]
pub(crate) struct Formats {
    /// Format of `-` as output, or as input if only that is `-`
    #[arg(long, value_name = "NAME", value_parser = names(), hide_possible_values = true)]
    format: Option<String>,
    /// Format of `-` as input, if that of output is another
    #[arg(long, value_name = "NAME", value_parser = names(), hide_possible_values = true)]
    input_format: Option<String>,
}

/// The names of all formats.
pub(crate) fn names() -> PossibleValuesParser {
    let mut names: Vec<&str> = MeshFormat::names().chain(PointFormat::names()).collect();
    names.sort_unstable();
    names.dedup();
    PossibleValuesParser::new(names)
}

impl Formats {
    /// What a mesh is written to standard output as.
    pub(crate) fn of_output(&self) -> Result<MeshFormat, Failure> {
        named(self.format.as_ref(), MeshFormat::from_name, "meshes", "output")
    }

    /// What points are written to standard output as.
    pub(crate) fn of_points(&self) -> Result<PointFormat, Failure> {
        named(self.format.as_ref(), PointFormat::from_name, "points", "output")
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

/// Whether a path stands for standard input or output.
pub(crate) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Points, and segments, holes and regions if there are any.
pub(crate) fn read_graph(path: &Path, formats: &Formats) -> Result<Pslg, Failure> {
    if !is_stream(path) {
        return Ok(hexdel_io::read_points(path)?);
    }
    let format = named(formats.of_input(), PointFormat::from_name, "points", "input")?;
    Ok(hexdel_io::read_points_from(io::stdin().lock(), format, STDIN)?)
}

/// A mesh with what its file knows about it.
pub(crate) fn read_mesh_data(path: &Path, formats: &Formats) -> Result<MeshData, Failure> {
    if !is_stream(path) {
        return Ok(hexdel_io::read_mesh_data(path)?);
    }
    let format = named(formats.of_input(), MeshFormat::from_name, "meshes", "input")?;
    Ok(hexdel_io::read_mesh_from(io::stdin().lock(), format, STDIN)?)
}
