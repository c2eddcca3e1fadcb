//! The program `hexdel`: meshes files of points and segments, checks and draws
//! meshes, makes test points.
//!
//! One module per command ([`mesh`], [`triangle`], [`check`], [`plot`], [`convert`],
//! [`dual`], [`generate`], [`session`], [`manual`] for completions and manual pages), and what they
//! share: files and standard input ([`input`]), which files are written and when
//! ([`outputs`]), the bar on a terminal ([`progress`]), errors and exit codes ([`exit`]),
//! the place in a file that an error is about ([`snippet`]), the option that cures it ([`remedy`]),
//! options that are called otherwise ([`usage`]). All meshing is left to the
//! library, all formats to `hexdel-io`.

mod check;
mod convert;
mod crs;
mod dual;
mod exit;
mod generate;
mod input;
mod manual;
mod mesh;
mod outputs;
mod plane;
mod plot;
mod progress;
mod remedy;
mod session;
mod sizing;
mod snippet;
mod triangle;
mod usage;

use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;

#[derive(Parser)]
#[command(
    name = "hexdel",
    version,
    about = "Triangle meshes of points with every angle between 43.89 and 90 degrees, certified",
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
    Mesh(Box<mesh::Args>),
    Triangle(triangle::Args),
    Check(check::Args),
    Plot(plot::Args),
    Convert(convert::Args),
    Dual(dual::Args),
    Generate(generate::Args),
    Session(session::Args),
    Completions(manual::CompletionArgs),
    Man(manual::ManArgs),
}

fn main() -> ExitCode {
    let cli = Cli::try_parse().unwrap_or_else(|error| usage::improved(error).exit());
    let outcome = match cli.command {
        Command::Mesh(args) => mesh::run(&args),
        Command::Triangle(args) => triangle::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Plot(args) => plot::run(&args),
        Command::Convert(args) => convert::run(&args),
        Command::Dual(args) => dual::run(&args),
        Command::Generate(args) => generate::run(&args),
        Command::Session(args) => session::run(&args),
        Command::Completions(args) => manual::completions(Cli::command(), &args),
        Command::Man(args) => manual::man(Cli::command(), &args),
    };
    exit::finish(outcome, usage::command().as_ref())
}
