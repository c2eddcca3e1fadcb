//! `cargo xtask regen`: everything in the repository that is computed from
//! something else in it.
//!
//! The records of the snapshot tests and the figures of the documents are
//! written anew from the fixtures or, with `--check`, compared with what they
//! would be. Both are the same bytes on every platform. What a record is made
//! of is the business of the tests, what a figure shows that of [`figures`].

mod figures;

use crate::{Outcome, tidy};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Where the figures lie, below the workspace's folder. Nothing else may lie there.
const FIGURES: &str = "docs/figures/algorithm";

/// Where the records lie, below the workspace's folder.
const RECORDS: &str = "crates/hexdel/tests/snapshots";

/// Rebuilds, or compares, everything.
pub(crate) fn run(check: bool) -> Outcome {
    let root = tidy::root();
    let figures = figures::all(&root)?;
    let folder = root.join(FIGURES);
    if check {
        check_figures(&folder, &figures)?;
    } else {
        write_figures(&folder, &figures)?;
        remove_orphans(&root)?;
    }
    records(&root, check)
}

fn write_figures(folder: &Path, figures: &BTreeMap<String, Vec<u8>>) -> Outcome {
    std::fs::create_dir_all(folder)?;
    for name in names(folder, "svg")?.iter().filter(|name| !figures.contains_key(*name)) {
        std::fs::remove_file(folder.join(name))?;
    }
    for (name, bytes) in figures {
        std::fs::write(folder.join(name), bytes)?;
    }
    Ok(())
}

fn check_figures(folder: &Path, figures: &BTreeMap<String, Vec<u8>>) -> Outcome {
    let mut faults = Vec::new();
    for (name, bytes) in figures {
        match std::fs::read(folder.join(name)) {
            Ok(found) if found == *bytes => {}
            Ok(_) => faults.push(format!("{FIGURES}/{name} differs")),
            Err(error) => faults.push(format!("{FIGURES}/{name}: {error}")),
        }
    }
    let surplus = names(folder, "svg")?.into_iter().filter(|name| !figures.contains_key(name));
    faults.extend(surplus.map(|name| format!("{FIGURES}/{name} is made by nothing")));
    if faults.is_empty() {
        Ok(())
    } else {
        Err(format!("{}; run `cargo xtask regen`", faults.join("\n")).into())
    }
}

/// Removes the records of fixtures that are gone: `points-a-simple.snap` is the
/// record of `fixtures/points/a.node`.
fn remove_orphans(root: &Path) -> Outcome {
    for name in names(&root.join(RECORDS), "snap")? {
        let parts = name.split_once('-').and_then(|(folder, rest)| Some((folder, rest.rsplit_once('-')?.0)));
        let fixture =
            parts.map(|(folder, stem)| root.join("fixtures").join(folder).join(format!("{stem}.node")));
        if !fixture.is_some_and(|path| path.exists()) {
            std::fs::remove_file(root.join(RECORDS).join(name))?;
        }
    }
    Ok(())
}

/// Runs the tests that keep the records.
fn records(root: &Path, check: bool) -> Outcome {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.current_dir(root).args(["test", "--quiet", "--package", "hexdel", "--test", "snapshots"]);
    cargo.env("INSTA_UPDATE", if check { "no" } else { "always" }).env_remove("INSTA_FORCE_PASS");
    if !check {
        // Whether all records are there is a question for afterwards.
        cargo.args(["--", "templates", "simple"]);
    }
    let status = cargo.status()?;
    if status.success() { Ok(()) } else { Err("the records of the snapshot tests do not hold".into()) }
}

/// The names of the files in a folder with an extension, in order.
fn names(folder: &Path, extension: &str) -> std::io::Result<Vec<String>> {
    let mut names = Vec::new();
    if folder.exists() {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.extension().is_some_and(|e| e == extension) {
                names.extend(path.file_name().map(|name| name.to_string_lossy().into_owned()));
            }
        }
    }
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_that_differ_are_missing_or_surplus_are_named() {
        let folder = std::env::temp_dir().join(format!("hexdel-regen-{}", std::process::id()));
        let figures = |names: [&str; 2]| names.map(|n| (n.to_owned(), n.as_bytes().to_vec())).into();
        write_figures(&folder, &figures(["a.svg", "b.svg"])).unwrap();
        check_figures(&folder, &figures(["a.svg", "b.svg"])).unwrap();
        std::fs::write(folder.join("b.svg"), "other").unwrap();
        std::fs::rename(folder.join("a.svg"), folder.join("c.svg")).unwrap();
        let error = check_figures(&folder, &figures(["a.svg", "b.svg"])).unwrap_err().to_string();
        for part in ["a.svg: ", "b.svg differs", "c.svg is made by nothing"] {
            assert!(error.contains(part), "{error}");
        }
        write_figures(&folder, &figures(["a.svg", "b.svg"])).unwrap();
        assert_eq!(names(&folder, "svg").unwrap(), ["a.svg", "b.svg"]);
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
