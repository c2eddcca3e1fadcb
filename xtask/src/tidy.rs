//! `cargo xtask tidy`: the house's table of dependencies, held.

use crate::Outcome;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Which crates of the workspace each one may depend on. Everything points
/// towards `hexdel-geom`.
const LAYERS: &[(&str, &[&str])] = &[
    ("hexdel-geom", &[]),
    ("hexdel-grid", &["hexdel-geom"]),
    ("hexdel-classify", &["hexdel-grid", "hexdel-geom"]),
    ("hexdel-refine", &["hexdel-classify", "hexdel-grid", "hexdel-geom"]),
    ("hexdel-optimize", &["hexdel-geom"]),
    ("hexdel-grow", &["hexdel-optimize", "hexdel-geom"]),
    (
        "hexdel-pslg",
        &["hexdel-refine", "hexdel-grow", "hexdel-optimize", "hexdel-classify", "hexdel-grid", "hexdel-geom"],
    ),
    ("hexdel-plot", &["hexdel-geom"]),
    ("hexdel-io", &["hexdel-plot", "hexdel-geom"]),
    (
        "hexdel-mesher",
        &[
            "hexdel-geom",
            "hexdel-grid",
            "hexdel-classify",
            "hexdel-refine",
            "hexdel-optimize",
            "hexdel-grow",
            "hexdel-pslg",
            "hexdel-plot",
            "hexdel-io",
        ],
    ),
    (
        "hexdel-session",
        &[
            "hexdel-mesher",
            "hexdel-geom",
            "hexdel-grid",
            "hexdel-classify",
            "hexdel-refine",
            "hexdel-optimize",
            "hexdel-pslg",
        ],
    ),
    (
        "hexdel",
        &[
            "hexdel-session",
            "hexdel-mesher",
            "hexdel-geom",
            "hexdel-grid",
            "hexdel-classify",
            "hexdel-refine",
            "hexdel-optimize",
            "hexdel-grow",
            "hexdel-pslg",
            "hexdel-plot",
            "hexdel-io",
        ],
    ),
    ("hexdel-cli", &["hexdel", "hexdel-io", "hexdel-plot"]),
];

/// Lines a source file may have before it should be two.
const MAX_LINES: usize = 600;

/// Checks the workspace.
pub(crate) fn run() -> Outcome {
    let root = root();
    let mut faults = String::new();
    for (name, dependencies) in crates(&root)? {
        for fault in check_layers(&name, &dependencies) {
            writeln!(faults, "{fault}")?;
        }
    }
    for file in sources(&root)? {
        check_file(&file, &mut faults)?;
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.into()) }
}

/// The workspace's folder.
pub(crate) fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().expect("xtask lies in the workspace's folder").to_owned()
}

/// The dependencies on crates of the workspace that the table does not allow.
fn check_layers(name: &str, dependencies: &[String]) -> Vec<String> {
    let Some((_, allowed)) = LAYERS.iter().find(|(n, _)| *n == name) else {
        return vec![format!("{name} is in no layer: add it to the table")];
    };
    let foreign = dependencies.iter().filter(|d| !allowed.contains(&d.as_str()));
    foreign.map(|d| format!("{name} must not depend on {d}")).collect()
}

/// The workspace's crates and which of each other they depend on, outside of
/// tests.
fn crates(root: &Path) -> std::io::Result<BTreeMap<String, Vec<String>>> {
    let mut all = BTreeMap::new();
    for entry in std::fs::read_dir(root.join("crates"))? {
        let folder = entry?.path();
        let manifest = std::fs::read_to_string(folder.join("Cargo.toml"))?;
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        all.insert(name, dependencies(&manifest));
    }
    Ok(all)
}

/// The names under `[dependencies]` that begin with `hexdel`.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut inside = false;
    let mut names = Vec::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            inside = line.trim() == "[dependencies]";
        } else if inside && line.starts_with("hexdel") {
            let end = line.find(['.', ' ', '=']).unwrap_or(line.len());
            names.push(line[..end].to_owned());
        }
    }
    names
}

/// All source files of the workspace, in order.
fn sources(root: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut folders = vec![root.join("crates"), root.join("xtask")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() && path.file_name().is_some_and(|n| n != "target") {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

fn check_file(path: &Path, faults: &mut String) -> Outcome {
    let text = std::fs::read_to_string(path)?;
    let lines = text.lines().count();
    if lines > MAX_LINES {
        writeln!(faults, "{}: {lines} lines, more than {MAX_LINES}", path.display())?;
    }
    let is_tests = path.file_name().is_some_and(|name| name == "tests.rs");
    if !is_tests && !text.starts_with("//!") {
        writeln!(faults, "{}: does not open by saying what it is", path.display())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_workspace_is_tidy() {
        run().unwrap();
    }

    #[test]
    fn crates_that_stand_alone_name_an_example_that_there_is() {
        let folder = root().join("crates");
        let mut found = Vec::new();
        for (name, _) in crates(&root()).unwrap() {
            let Ok(readme) = std::fs::read_to_string(folder.join(&name).join("README.md")) else { continue };
            let command = readme.lines().find(|line| line.starts_with("`cargo run ")).unwrap();
            let words: Vec<&str> = command.trim_matches('`').split([' ', '`']).collect();
            let after = |word: &str| words[words.iter().position(|w| *w == word).unwrap() + 1];
            assert_eq!(after("-p"), name);
            let example = folder.join(&name).join("examples").join(after("--example"));
            assert!(example.with_extension("rs").exists(), "{command}");
            found.push(name);
        }
        let alone =
            ["grid", "classify", "refine", "optimize", "grow", "pslg", "plot", "io", "mesher", "session"];
        assert!(alone.iter().all(|name| found.contains(&format!("hexdel-{name}"))), "{found:?}");
    }

    #[test]
    fn a_dependency_that_points_upwards_is_a_fault() {
        assert!(check_layers("hexdel-grid", &["hexdel-refine".into()])[0].contains("must not"));
        assert!(check_layers("hexdel-grid", &["hexdel-geom".into()]).is_empty());
        assert!(!check_layers("hexdel-new", &[]).is_empty());
    }

    #[test]
    fn dependencies_are_read_from_their_section_only() {
        let manifest = "[dependencies]\nhexdel-geom.workspace = true\nrayon = \"1\"\n\
                        [dev-dependencies]\nhexdel-io.workspace = true\n";
        assert_eq!(dependencies(manifest), ["hexdel-geom"]);
    }
}
