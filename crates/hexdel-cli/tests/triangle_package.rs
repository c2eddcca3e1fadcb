//! `hexdel triangle` beside Triangle itself, as the package `triangle` of Python has it, in a
//! virtual environment that is made once below `target/`. It is a test environment only.
//!
//! Without Python or a package registry this is skipped, and says so. There is no test
//! harness around it, which would keep that line to itself.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking, and this one talks")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// What is installed. A new version must not break an old commit.
const PACKAGES: [&str; 2] = ["triangle==20250106", "numpy<3"];

/// Graphs and the switches that both mesh them with.
const CASES: [(&str, &str); 5] = [
    ("box_closed", "p"),
    ("letter_A", "pq30"),
    ("crossing", "p"),
    ("p_missing_marker", "p"),
    ("p_comma", "pq30a0.01"),
];

fn main() -> ExitCode {
    // Asked for a list of tests, there is one, without a name of its own.
    if std::env::args().any(|argument| argument == "--list") {
        return ExitCode::SUCCESS;
    }
    let python = match environment() {
        Ok(python) => python,
        Err(reason) => {
            println!("triangle: skipped, {reason}");
            return ExitCode::SUCCESS;
        }
    };
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut code = ExitCode::SUCCESS;
    for (name, switches) in CASES {
        let folder = tempfile::tempdir().unwrap();
        let fixture = here.join(format!("../../fixtures/triangle/{name}.poly"));
        let graph = folder.path().join("in.poly");
        fs::write(&graph, fs::read(fixture).unwrap()).unwrap();
        let mut ours = Command::new(env!("CARGO_BIN_EXE_hexdel"));
        let ours = ours.args(["triangle", &format!("-{switches}Q")]).arg(&graph).output().unwrap();
        assert!(ours.status.success(), "{name}: {}", String::from_utf8_lossy(&ours.stderr));
        let script = here.join("tests/beside_triangle.py");
        let found = Command::new(&python).arg(script).arg(folder.path()).arg(switches).output().unwrap();
        print!("triangle: {name}: {}", String::from_utf8_lossy(&found.stdout));
        if !found.status.success() {
            println!("failed\n{}", String::from_utf8_lossy(&found.stderr));
            code = ExitCode::FAILURE;
        }
    }
    code
}

/// A Python that has the package, or why there is none.
fn environment() -> Result<PathBuf, String> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("triangle");
    let python = ["bin/python", "Scripts/python.exe"].map(|name| folder.join(name));
    let complete = folder.join("complete");
    let wanted = PACKAGES.join(" ");
    let there = || python.iter().find(|python| python.exists()).cloned();
    if fs::read_to_string(&complete).is_ok_and(|found| found == wanted)
        && let Some(python) = there()
    {
        return Ok(python);
    }
    let run = |program: &Path, arguments: &[&str], what: &str| {
        let found = Command::new(program).args(arguments).output().map_err(|e| format!("{what}: {e}"))?;
        if found.status.success() {
            return Ok(());
        }
        let said = String::from_utf8_lossy(&found.stderr);
        Err(format!("{what}: {}", said.lines().last().unwrap_or("it failed")))
    };
    let place = folder.display().to_string();
    run(Path::new("python3"), &["-m", "venv", "--clear", &place], "python3 makes no virtual environment")?;
    let python = there().ok_or("the virtual environment has no python")?;
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--retries", "1"];
    let binary = ["--only-binary", ":all:"];
    run(&python, &[&install[..], &binary, &PACKAGES].concat(), "pip installs no triangle")?;
    fs::write(complete, wanted).map_err(|e| e.to_string())?;
    Ok(python)
}
