//! Development tasks: `cargo xtask <task>`.

mod bench;
mod ci;
mod drawing;
mod prove;
mod python;
mod regen;
mod tidy;
mod web;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

#[derive(Parser)]
#[command(name = "cargo xtask", about = "Development tasks of the hexdel workspace")]
struct Cli {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Run all that must pass: format, lints, structure, tests
    Ci,
    /// Check the structure of the workspace: which crate may depend on which,
    /// lengths of files, headers of modules
    Tidy,
    /// Measure time and memory, side by side with spade
    Bench(bench::Args),
    /// Rebuild all that is computed: fixtures with a seed or a formula, records of the snapshot
    /// tests, the proof, the figures of the documents and the gallery
    Regen {
        /// Change nothing; fail if anything would change
        #[arg(long)]
        check: bool,
    },
    /// Build the Python package and test it, with every package that it hands meshes
    /// to, in virtual environments below target/; nothing where there is no Python
    Python,
    /// Build the wheel of the Python package and its source distribution into target/wheels
    Wheel,
    /// Build the npm package and the page: web/package and web/dist. What is missing of the
    /// toolchain is fetched if it can be
    Web {
        /// Test them, too, in Node and in Chromium; nothing where the tools cannot be had
        #[arg(long)]
        test: bool,
    },
    /// Prove by enumeration that every triangle keeps 43.89 to 90 degrees, and
    /// write docs/proof.md
    Prove {
        /// Leave a rule away, by its name; nothing is written then
        #[arg(long, value_name = "RULE")]
        without: Vec<String>,
        /// One unit of each kind instead of all orientations; nothing is
        /// written
        #[arg(long)]
        reduced: bool,
    },
}

/// What a task returns: nothing, or what went wrong.
type Outcome = Result<(), Box<dyn std::error::Error>>;

fn main() -> ExitCode {
    let outcome = match Cli::parse().task {
        Task::Ci => ci::run(),
        Task::Tidy => tidy::run(),
        Task::Bench(args) => bench::run(&args),
        Task::Regen { check } => regen::run(check),
        Task::Python => python::test(),
        Task::Wheel => python::wheel(),
        Task::Web { test: false } => web::build(),
        Task::Web { test: true } => web::test(),
        Task::Prove { without, reduced } => prove::run(&without, reduced),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
