//! `cargo xtask ci`: all that must pass before a change is taken, in the order
//! of what fails fastest.
//!
//! The library is also checked without its features, with some of them, and for browsers where
//! the compiler has their target.
//!
//! The steps are run as a person would type them; this task itself installs nothing
//! and needs the Rust toolchain with rustfmt and clippy. Two tests put packages of Python
//! below `target/`: one of `hexdel-io` meshio with numpy, which it must where there is a
//! Python, and one of `hexdel-cli` triangle with numpy, if it can. The last step but one builds
//! the Python package and installs it there, beside what it hands meshes on to; it must succeed
//! where there is a Python of 3.10 or later. The last one builds the npm package and the page
//! and tests them in Node and Chromium; it is skipped where npm or the compiler's target cannot
//! be had.

use crate::Outcome;
use crate::tidy;
use crate::web;
use std::env;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// The steps, as arguments of cargo.
const STEPS: &[&str] = &[
    "fmt --all --check",
    "fmt --manifest-path python/Cargo.toml --check",
    "xtask tidy",
    "clippy --workspace --all-targets -- -D warnings",
    // The features of the library that matter: none; formats and threads without pictures and
    // sessions as text; those without these. The workspace has all of them.
    "clippy -p hexdel --no-default-features -- -D warnings",
    "clippy -p hexdel --no-default-features --features io,rayon -- -D warnings",
    "clippy -p hexdel --no-default-features --features plot,serde,geo-types,spade -- -D warnings",
    "check -p hexdel --no-default-features --target wasm32-unknown-unknown",
    "doc --workspace --no-deps",
    "test --workspace",
    // Without threads the bytes are the same.
    "test -p hexdel --no-default-features --features io,serde --test snapshots --test whole_meshes",
    "xtask regen --check",
    "xtask python",
    "xtask web --test",
];

/// Runs all steps, up to the first that fails.
pub(crate) fn run() -> Outcome {
    let root = tidy::root();
    // Cargo says which it is, so that a chosen toolchain stays chosen.
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    STEPS.iter().try_for_each(|step| run_step(&cargo, step, &root))
}

/// Makes the test with meshio fail where it would be skipped.
const REQUIRE_MESHIO: &str = "HEXDEL_REQUIRE_MESHIO";

fn has_python() -> bool {
    Command::new("python3").arg("--version").output().is_ok_and(|found| found.status.success())
}

fn run_step(cargo: &OsString, step: &str, root: &Path) -> Outcome {
    if step.contains(web::TARGET) && !web::has_target() {
        eprintln!("ci: cargo {step}: skipped, the compiler has no such target");
        return Ok(());
    }
    eprintln!("ci: cargo {step}");
    let start = Instant::now();
    let mut command = Command::new(cargo);
    // Everything is compiled once: what incremental builds write down would not be read.
    command.args(step.split(' ')).current_dir(root).env("CARGO_INCREMENTAL", "0");
    // Doctests, too, are built anew with other flags.
    if step.starts_with("doc ") {
        command.env("RUSTDOCFLAGS", "-D warnings");
    }
    if has_python() {
        command.env(REQUIRE_MESHIO, "1");
    }
    let status = command.status()?;
    if !status.success() {
        return Err(format!("`cargo {step}` failed ({status})").into());
    }
    eprintln!("ci: cargo {step}: {:.0} s", start.elapsed().as_secs_f64());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tests_are_run_as_the_readme_says() {
        let readme = std::fs::read_to_string(tidy::root().join("README.md")).unwrap();
        let tests = STEPS.iter().find(|step| step.starts_with("test")).unwrap();
        assert!(readme.contains(&format!("\ncargo {tests}\n")));
    }

    #[test]
    fn the_test_with_meshio_knows_that_it_is_required() {
        let test = tidy::root().join("crates/hexdel-io/tests/meshio.rs");
        assert!(std::fs::read_to_string(test).unwrap().contains(REQUIRE_MESHIO));
    }

    #[test]
    fn a_step_that_fails_is_a_fault() {
        let fault = run_step(&"cargo".into(), "no-such-command", &tidy::root());
        assert!(fault.unwrap_err().to_string().contains("`cargo no-such-command` failed"));
    }
}
