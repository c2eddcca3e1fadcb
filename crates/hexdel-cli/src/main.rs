//! The program `hexdel`: meshes files of points, checks meshes, makes test
//! points.
//!
//! One module per command ([`mesh`], [`check`], [`dual`], [`generate`]), and what they
//! share: which files are written and when ([`outputs`]), the bar on a terminal
//! ([`progress`]), errors and exit codes ([`exit`]). All meshing is left to the
//! library, all formats to `hexdel-io`.

mod check;
mod dual;
mod exit;
mod generate;
mod input;
mod mesh;
mod outputs;
mod progress;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

#[derive(Parser)]
#[command(
    name = "hexdel",
    version,
    about = "Triangle meshes of points with every angle between 43.9 and 90 degrees, certified",
    after_help = "Exit codes: 0 done, 1 a mesh failed its check, 2 bad input or usage.\n\n\
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
    Dual(dual::Args),
    Generate(generate::Args),
}

fn main() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Mesh(args) => mesh::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Dual(args) => dual::run(&args),
        Command::Generate(args) => generate::run(&args),
    };
    exit::finish(outcome)
}
