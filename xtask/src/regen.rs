//! `cargo xtask regen`: everything in the repository that is computed from
//! something else in it.
//!
//! The fixtures that have a seed or a formula, and from all fixtures the records of the snapshot
//! tests, the proof, the figures of the documents and the gallery are written anew or, with
//! `--check`, compared with what they would be. All are the same bytes on every platform. What a record is made of is
//! the business of the tests, what a figure shows that of [`figures`] and
//! [`gallery`].

mod figures;
mod fixtures;
mod gallery;
mod paper;

use crate::{Outcome, prove, tidy};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

/// Files by their paths below [`DOCS`].
type Files = BTreeMap<String, Vec<u8>>;

/// The documents, below the workspace's folder.
const DOCS: &str = "docs";

/// The fixtures, below the workspace's folder.
const FIXTURES: &str = "fixtures";

/// Where nothing else may lie, below the documents.
const FOLDERS: [&str; 3] = [figures::FOLDER, gallery::FOLDER, prove::FOLDER];

/// Where the records lie, below the workspace's folder: of all meshes, and of those that are
/// small enough to be there as a whole.
const RECORDS: &str = "crates/hexdel/tests/snapshots";
const WHOLE: &str = "crates/hexdel/tests/whole";

/// Rebuilds, or compares, everything.
pub(crate) fn run(check: bool) -> Outcome {
    let root = tidy::root();
    let fixtures = fixtures::all()?;
    if check {
        check_files(&root, FIXTURES, &fixtures)?;
    } else {
        write_files(&root.join(FIXTURES), &fixtures)?;
    }
    fixtures::check_listed(&root.join(FIXTURES), &fixtures)?;
    let mut files = figures::all(&root)?;
    files.extend(prove::files()?);
    files.extend(gallery::all(&root).map_err(|fault| fault as Box<dyn std::error::Error>)?);
    if check {
        check_files(&root, DOCS, &files)?;
    } else {
        write_files(&root.join(DOCS), &files)?;
        remove_orphans(&root)?;
    }
    records(&root, check)
}

fn write_files(folder: &Path, files: &Files) -> Outcome {
    for name in surplus(folder, files)? {
        std::fs::remove_file(folder.join(name))?;
    }
    for (name, bytes) in files {
        let path = folder.join(name);
        std::fs::create_dir_all(path.parent().unwrap_or(folder))?;
        std::fs::write(path, bytes)?;
    }
    Ok(())
}

fn check_files(root: &Path, below: &str, files: &Files) -> Outcome {
    let folder = root.join(below);
    let mut faults = Vec::new();
    for (name, bytes) in files {
        match std::fs::read(folder.join(name)) {
            Ok(found) if found == *bytes => {}
            Ok(_) => faults.push(format!("{below}/{name} differs")),
            Err(error) => faults.push(format!("{below}/{name}: {error}")),
        }
    }
    faults.extend(
        surplus(&folder, files)?.into_iter().map(|name| format!("{below}/{name} is made by nothing")),
    );
    if faults.is_empty() {
        Ok(())
    } else {
        Err(format!("{}; run `cargo xtask regen`", faults.join("\n")).into())
    }
}

/// Files in the figures' folders that are not among those made.
fn surplus(docs: &Path, files: &Files) -> std::io::Result<Vec<String>> {
    let mut surplus = Vec::new();
    for folder in FOLDERS {
        let all = names(&docs.join(folder))?.into_iter().map(|name| format!("{folder}/{name}"));
        surplus.extend(all.filter(|name| !files.contains_key(name)));
    }
    Ok(surplus)
}

/// Removes the records of fixtures that are gone.
fn remove_orphans(root: &Path) -> Outcome {
    for name in names(&root.join(RECORDS))? {
        if !fixture_of(&name).is_some_and(|path| root.join("fixtures").join(path).exists()) {
            std::fs::remove_file(root.join(RECORDS).join(name))?;
        }
    }
    // Which meshes are small is known when they have been made: all are written anew.
    for name in names(&root.join(WHOLE))? {
        std::fs::remove_file(root.join(WHOLE).join(name))?;
    }
    Ok(())
}

/// Where the fixture of a record is, below the fixtures: `points-a-simple.snap` is
/// that of `points/a.node`, `graphs-b.snap` that of `graphs/b.poly`.
fn fixture_of(record: &str) -> Option<String> {
    let (folder, rest) = record.split_once('-')?;
    match rest.rsplit_once('-') {
        Some((stem, _)) if folder != "graphs" => Some(format!("{folder}/{stem}.node")),
        _ => Some(format!("{folder}/{}.poly", rest.split_once('.')?.0)),
    }
}

/// Runs the tests that keep the records.
fn records(root: &Path, check: bool) -> Outcome {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    // With the features of the whole workspace nothing is compiled that `cargo test --workspace` has.
    cargo.current_dir(root).args(["test", "--quiet", "--workspace"]);
    cargo.args(["--test", "snapshots", "--test", "whole_meshes"]);
    cargo.env("INSTA_UPDATE", if check { "no" } else { "always" }).env_remove("INSTA_FORCE_PASS");
    if !check {
        // Whether all records are there is a question for afterwards.
        cargo.args(["--", "templates", "simple", "compact", "graphs", "whole"]);
    }
    let status = cargo.status()?;
    if status.success() { Ok(()) } else { Err("the records of the snapshot tests do not hold".into()) }
}

/// The names of the files in a folder, in order.
fn names(folder: &Path) -> std::io::Result<Vec<String>> {
    let mut names = Vec::new();
    if folder.exists() {
        for entry in std::fs::read_dir(folder)? {
            names.push(entry?.file_name().to_string_lossy().into_owned());
        }
    }
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_have_fixtures() {
        for (record, fixture) in [
            ("points-a-b-simple.snap", Some("points/a-b.node")),
            ("graphs-b.snap", Some("graphs/b.poly")),
            ("graphs-b-c.snap", Some("graphs/b-c.poly")),
            ("other", None),
        ] {
            assert_eq!(fixture_of(record).as_deref(), fixture);
        }
        let root = tidy::root();
        for record in names(&root.join(RECORDS)).unwrap() {
            let fixture = fixture_of(&record).unwrap();
            assert!(root.join("fixtures").join(fixture).exists(), "{record}");
        }
    }

    #[test]
    fn figures_that_differ_are_missing_or_surplus_are_named() {
        let root = std::env::temp_dir().join(format!("hexdel-regen-{}", std::process::id()));
        let docs = root.join(DOCS);
        let at = |name: &str| format!("{}/{name}", gallery::FOLDER);
        let files: Files = ["a.svg", "b.png"].map(|name| (at(name), name.as_bytes().to_vec())).into();
        write_files(&docs, &files).unwrap();
        check_files(&root, DOCS, &files).unwrap();
        std::fs::write(docs.join(at("b.png")), "other").unwrap();
        std::fs::rename(docs.join(at("a.svg")), docs.join(at("c.svg"))).unwrap();
        let error = check_files(&root, DOCS, &files).unwrap_err().to_string();
        for part in ["a.svg: ", "b.png differs", "c.svg is made by nothing"] {
            assert!(error.contains(part), "{error}");
        }
        write_files(&docs, &files).unwrap();
        assert_eq!(names(&docs.join(gallery::FOLDER)).unwrap(), ["a.svg", "b.png"]);
        std::fs::remove_dir_all(&root).unwrap();
    }
}
