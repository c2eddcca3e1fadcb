//! A Python with packages, in a virtual environment that is made once below `target/`. It is a
//! test environment only; included by the tests that need one.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A Python that has the packages, or why there is none. The folder of that name below
/// `target` is theirs.
pub(crate) fn environment(target: &str, name: &str, packages: &[&str]) -> Result<PathBuf, String> {
    let folder = Path::new(target).join(name);
    let python = ["bin/python", "Scripts/python.exe"].map(|name| folder.join(name));
    let complete = folder.join("complete");
    let wanted = packages.join(" ");
    let there = || python.iter().find(|python| python.exists()).cloned();
    if fs::read_to_string(&complete).is_ok_and(|found| found == wanted)
        && let Some(python) = there()
    {
        return Ok(python);
    }
    let place = folder.display().to_string();
    run(Path::new("python3"), &["-m", "venv", "--clear", &place], "python3 makes no virtual environment")?;
    let python = there().ok_or("the virtual environment has no python")?;
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--retries", "1"];
    // Nothing is built here: that would take a compiler, and minutes.
    let binary = ["--only-binary", ":all:"];
    let what = format!("pip installs no {name}");
    run(&python, &[&install[..], &binary, packages].concat(), &what)?;
    fs::write(complete, wanted).map_err(|e| e.to_string())?;
    Ok(python)
}

/// Whether the test is asked for a list of tests: there is one, without a name of its own.
pub(crate) fn is_asked_for_a_list() -> bool {
    std::env::args().any(|argument| argument == "--list")
}

fn run(program: &Path, arguments: &[&str], what: &str) -> Result<(), String> {
    let found = Command::new(program).args(arguments).output().map_err(|e| format!("{what}: {e}"))?;
    if found.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&found.stderr);
    Err(format!("{what}: {}", said.lines().last().unwrap_or("it failed")))
}
