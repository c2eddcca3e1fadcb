//! `hexdel triangle` beside Triangle itself, as the package `triangle` of Python has it, in a
//! virtual environment that is made once below `target/`. It is a test environment only.
//!
//! Without Python or a package registry this is skipped, and says so. There is no test
//! harness around it, which would keep that line to itself.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test fails by panicking, and this one talks")]

use std::fs;
use std::path::Path;
use std::process::{Command, ExitCode};

#[path = "../../hexdel-io/tests/support/python.rs"]
mod python;

/// What is installed. A new version must not break an old commit.
const PACKAGES: [&str; 2] = ["triangle==20250106", "numpy<3"];

/// PSLGs and the switches that both mesh them with.
const CASES: [(&str, &str); 5] = [
    ("box_closed", "p"),
    ("letter_A", "pq30"),
    ("crossing", "p"),
    ("p_missing_marker", "p"),
    ("p_comma", "pq30a0.01"),
];

fn main() -> ExitCode {
    if python::is_asked_for_a_list() {
        return ExitCode::SUCCESS;
    }
    let python = match python::environment(env!("CARGO_TARGET_TMPDIR"), "triangle", &PACKAGES) {
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
