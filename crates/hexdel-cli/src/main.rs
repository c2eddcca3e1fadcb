//! The program `hexdel`: meshes files of points and segments, checks meshes, makes test
//! points.
//!
//! One module per command ([`mesh`], [`check`], [`convert`], [`dual`],
//! [`generate`], [`session`]), and what they
//! share: which files are written and when ([`outputs`]), the bar on a terminal
//! ([`progress`]), errors and exit codes ([`exit`]). All meshing is left to the
//! library, all formats to `hexdel-io`.

mod check;
mod convert;
mod dual;
mod exit;
mod generate;
mod mesh;
mod outputs;
mod progress;
mod session;
mod sizing;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

#[derive(Parser)]
#[command(
    name = "hexdel",
    version,
    about = "Triangle meshes of points with every angle between 43.9 and 90 degrees, certified",
    after_help = "Exit codes: 0 done, 1 a check failed, 2 bad input or usage, 3 budget spent (mesh written).\n\n\
        Examples:\n  \
        hexdel generate clusters 500 --seed 1 -o points.node\n  \
        hexdel mesh points.node -o mesh.ele -o mesh.svg\n  \
        hexdel check mesh.ele --input points.node"
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Mesh(mesh::Args),
    Check(check::Args),
    Convert(convert::Args),
    Dual(dual::Args),
    Generate(generate::Args),
    Session(session::Args),
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Mesh(args) => mesh::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Convert(args) => convert::run(&args),
        Command::Dual(args) => dual::run(&args),
        Command::Generate(args) => generate::run(&args),
        Command::Session(args) => session::run(&args),
    };
    exit::finish(outcome)
}
