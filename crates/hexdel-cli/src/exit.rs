//! How a command ends: errors, exit codes, and text that a closed pipe may cut.

use crate::{remedy, snippet};
use clap::Command;
use hexdel::geom::BoundsError;
use hexdel_io::{ReadError, WriteError};
use miette::Diagnostic;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use thiserror::Error;

/// Whether what was checked holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Holds,
    Fails,
    /// The time was up before it was as good as can be.
    Spent,
}

/// How a command ends.
pub(crate) type Outcome = Result<Verdict, Failure>;

/// Why a command did not do its work.
#[derive(Debug, Error, Diagnostic)]
pub(crate) enum Failure {
    #[error(transparent)]
    Read(#[from] ReadError),
    #[error(transparent)]
    Write(#[from] WriteError),
    /// An error that is about what is in a file, with others of the kind, one a line.
    #[error("{file}: {source}{more}")]
    Mesh { file: String, source: Box<hexdel::Error>, more: String },
    #[error("{file}: {source}")]
    #[diagnostic(help("`hexdel check` lists everything that is wrong with a mesh"))]
    Voronoi { file: String, source: hexdel::geom::VoronoiError },
    #[error(transparent)]
    #[diagnostic(help("the smallest angle is at most 60 degrees, the largest at least 60"))]
    Bounds(#[from] BoundsError),
    #[error("{}: {source}", file.display())]
    Output { file: PathBuf, source: io::Error },
    #[error("{}: not a plain file, will not be replaced", file.display())]
    NotAFile { file: PathBuf },
    #[error("{}: belongs to the input, will not be replaced", file.display())]
    #[diagnostic(help("a mesh in .ele has its vertices in a .node beside it: give it another name"))]
    ReplacesInput { file: PathBuf },
    #[error("{}: two outputs of the same name", file.display())]
    Twice { file: PathBuf },
    #[error("{of} has no levels or classes of hexagons to colour by")]
    #[diagnostic(help(
        "use `hexdel mesh INPUT --method templates -o x.svg --colour level`, or --method simple"
    ))]
    NoHexagons { of: String },
    /// What was read is nothing that the format of the output holds.
    #[error("{file}: contains {found}, which {format} cannot store")]
    #[diagnostic(help("convert a mesh to a mesh format, points to a point format"))]
    Conversion { file: String, found: &'static str, format: String },
    #[error("standard {stream} has no extension to tell its format")]
    NoFormat { stream: &'static str },
    #[error("standard output: {0}")]
    Stdout(io::Error),
    #[error("standard input: {0}")]
    Stdin(io::Error),
    #[error("{file}: {source}")]
    Size { file: String, source: hexdel::SizeError },
    #[error("{file}: {source}")]
    Projection { file: String, source: hexdel_io::ProjectionError },
    #[error("{file}: --height-attribute {asked}: each point has {count} attributes")]
    NoAttribute { file: String, asked: u32, count: usize },
    #[error("{file}: the raster has no value around the points; with --project its places are degrees, too")]
    RasterElsewhere { file: String },
    #[error("{failed} commands failed")]
    Commands { failed: usize },
    #[error("{option} has no effect: {why}")]
    Unused { option: &'static str, why: String },
    #[error("{name} is not a format of {what}")]
    UnknownFormat { name: String, what: &'static str },
    #[error("-{switch}: {why}")]
    #[diagnostic(help("docs/triangle-users.md says what each switch does here"))]
    Switch { switch: String, why: String },
    #[error("cannot write the statistics as JSON: {0}")]
    Json(#[from] serde_json::Error),
}

impl Failure {
    fn code(&self) -> u8 {
        use hexdel::Error as E;
        match self {
            Self::Mesh { source, .. } => match **source {
                E::NotCertified { .. } | E::Unreached { .. } | E::DualEdges { .. } => 1,
                _ => 2,
            },
            _ => 2,
        }
    }
}

/// An option that was given and has nothing to act on.
pub(crate) fn unused<T>(option: &'static str, why: &str) -> Result<T, Failure> {
    Err(Failure::Unused { option, why: why.to_owned() })
}

/// Reports a failure on standard error and gives the exit code: 0 done, 1 a
/// check failed, 2 bad input, usage or system, 3 done within the time given.
pub(crate) fn finish(outcome: Outcome, command: Option<&Command>) -> ExitCode {
    match outcome {
        Ok(Verdict::Holds) => ExitCode::SUCCESS,
        Ok(Verdict::Fails) => ExitCode::from(1),
        Ok(Verdict::Spent) => ExitCode::from(3),
        Err(failure) => {
            complain("error", &failure.to_string());
            if let Failure::Read(error) = &failure
                && let Some(snippet) = snippet::of(error)
            {
                let _ = write!(io::stderr(), "{snippet}");
            }
            if let Some(help) =
                remedy::of(&failure, command).or_else(|| failure.help().map(|help| help.to_string()))
            {
                complain("help", &help);
            }
            ExitCode::from(failure.code())
        }
    }
}

/// Warns on standard error.
pub(crate) fn warn(message: &str) {
    complain("warning", message);
}

/// A line on standard error. If even that is closed there is nobody to tell.
fn complain(kind: &str, message: &str) {
    let _ = writeln!(io::stderr(), "{kind}: {message}");
}

/// Writes to standard output. A reader that has seen enough and closed the pipe
/// is no failure.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::Stdout(error)),
        _ => Ok(()),
    }
}
