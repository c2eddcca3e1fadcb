//! Development tasks: `cargo xtask <task>`.

mod bench;
mod ci;
mod tidy;

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
}

/// What a task returns: nothing, or what went wrong.
type Outcome = Result<(), Box<dyn std::error::Error>>;

fn main() -> ExitCode {
    let outcome = match Cli::parse().task {
        Task::Ci => ci::run(),
        Task::Tidy => tidy::run(),
        Task::Bench(args) => bench::run(&args),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
