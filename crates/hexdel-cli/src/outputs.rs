//! Which files a command writes, found out before it works and written after,
//! all or none.
//!
//! Every file is first written under its own name in a temporary folder beside
//! its place, on the same file system, and renamed when all are complete: only
//! the system refusing a name then could leave some without the others.

use crate::exit::{Failure, print};
use hexdel_io::{DualFormat, MeshFormat, PointFormat, WriteError, points_beside};
use std::collections::BTreeMap;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, TempDir};

/// What a file is to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Content {
    Mesh,
    Dual,
    Points,
    Text,
}

/// The files to be written.
#[derive(Default)]
pub(crate) struct Outputs {
    /// What each path given is to hold; their files are all different.
    files: Vec<(Content, PathBuf)>,
    /// Files that must stay as they are.
    protected: Vec<PathBuf>,
    /// Every file that will appear.
    claimed: Vec<PathBuf>,
    /// What is written to standard output, if anything.
    stdout: Option<MeshFormat>,
}

impl Outputs {
    /// Keeps the input from being replaced, with the `.node` that a `.poly` has its
    /// points in, if it has.
    pub(crate) fn protect_input(&mut self, input: &Path) {
        self.protected.push(settled(input));
        if PointFormat::from_path(input) == Some(PointFormat::Poly) && points_beside(input) {
            self.protected.extend(["node", "NODE"].map(|e| settled(&input.with_extension(e))));
        }
    }

    /// A mesh or its picture, in the format of the extension.
    pub(crate) fn add_mesh(&mut self, path: &Path) -> Result<(), Failure> {
        let Some(format) = MeshFormat::from_path(path) else {
            return Err(unknown_extension(path, MeshFormat::EXTENSIONS));
        };
        if format != MeshFormat::NodeEle {
            return self.add(Content::Mesh, path, &[path.to_owned()]);
        }
        let upper = path.extension().is_some_and(|e| e.to_string_lossy().chars().all(char::is_uppercase));
        let pair = if upper { ["NODE", "ELE"] } else { ["node", "ele"] };
        let beside = |extension: &str| {
            let same = path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension));
            if same { path.to_owned() } else { path.with_extension(extension) }
        };
        self.add(Content::Mesh, path, &pair.map(beside))
    }

    /// The Voronoi dual of a mesh, in the format of the extension.
    pub(crate) fn add_dual(&mut self, path: &Path) -> Result<(), Failure> {
        match DualFormat::from_path(path) {
            Some(DualFormat::Voronoi) => {
                let pair = ["node", "edge"].map(|extension| path.with_extension(extension));
                self.add(Content::Dual, path, &pair)
            }
            Some(_) => self.add(Content::Dual, path, &[path.to_owned()]),
            None => Err(unknown_extension(path, DualFormat::EXTENSIONS)),
        }
    }

    /// Points, in the format of the extension.
    pub(crate) fn add_points(&mut self, path: &Path) -> Result<(), Failure> {
        match PointFormat::from_path(path) {
            Some(_) => self.add(Content::Points, path, &[path.to_owned()]),
            None => Err(unknown_extension(path, PointFormat::EXTENSIONS)),
        }
    }

    /// A mesh to standard output.
    pub(crate) fn add_stdout(&mut self, format: MeshFormat) -> Result<(), Failure> {
        match self.stdout.replace(format) {
            Some(_) => Err(Failure::Twice { file: "-".into() }),
            None => Ok(()),
        }
    }

    /// What the files are called.
    pub(crate) fn paths(&self) -> Vec<&Path> {
        self.files.iter().map(|(_, path)| path.as_path()).collect()
    }

    /// Writes to standard output what goes there.
    pub(crate) fn write_stdout(
        &self,
        write: impl FnOnce(&mut dyn Write, MeshFormat) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        self.stdout.map_or(Ok(()), |format| to_stdout(|out| write(out, format)))
    }

    /// Says something on standard output, or on standard error if there is a
    /// mesh on the former.
    pub(crate) fn tell(&self, text: &str) -> Result<(), Failure> {
        if self.stdout.is_none() {
            return print(text);
        }
        // If even that is closed there is nobody to tell.
        let _ = io::stderr().write_all(text.as_bytes());
        Ok(())
    }

    /// A text of any name.
    pub(crate) fn add_text(&mut self, path: &Path) -> Result<(), Failure> {
        self.add(Content::Text, path, &[path.to_owned()])
    }

    /// Claims the files that `path` stands for, if they can be written.
    fn add(&mut self, content: Content, path: &Path, files: &[PathBuf]) -> Result<(), Failure> {
        for file in files {
            let place = settled(file);
            if self.protected.contains(&place) {
                return Err(Failure::ReplacesInput { file: file.clone() });
            }
            if self.claimed.contains(&place) {
                return Err(Failure::Twice { file: file.clone() });
            }
            check_place(file)?;
            self.claimed.push(place);
        }
        self.files.push((content, path.to_owned()));
        Ok(())
    }

    /// Writes all files, each by a call of `write` with what it holds and the
    /// path to write it to in the meantime. On failure nothing is left behind.
    pub(crate) fn write(&self, write: impl Fn(Content, &Path) -> Result<(), Failure>) -> Result<(), Failure> {
        let mut stage = Stage::default();
        for (content, path) in &self.files {
            let draft = stage.draft(path)?;
            write(*content, &draft).map_err(|failure| renamed(failure, path))?;
        }
        stage.publish()
    }
}

/// Writes to standard output. A reader that has seen enough and closed the pipe
/// is no failure.
pub(crate) fn to_stdout(write: impl FnOnce(&mut dyn Write) -> Result<(), Failure>) -> Result<(), Failure> {
    let mut out = BufWriter::new(io::stdout().lock());
    match write(&mut out).and_then(|()| out.flush().map_err(Failure::Stdout)) {
        Err(Failure::Stdout(e) | Failure::Write(WriteError::Io { source: e, .. }))
            if e.kind() == io::ErrorKind::BrokenPipe =>
        {
            Ok(())
        }
        done => done,
    }
}

/// Temporary folders beside the places of files.
#[derive(Default)]
struct Stage {
    /// By the folder that the files will be in. Removed with all that is in
    /// them when dropped.
    drafts: BTreeMap<PathBuf, TempDir>,
    /// Folders that were missing, each before its own folders; taken away
    /// again unless the files are published.
    made: Vec<PathBuf>,
}

impl Stage {
    /// Where to write the file that is to be at `path`.
    fn draft(&mut self, path: &Path) -> Result<PathBuf, Failure> {
        let at_fault = |source| Failure::Output { file: path.to_owned(), source };
        let folder = folder_of(path);
        let name = path.file_name().ok_or_else(|| at_fault(io::ErrorKind::InvalidFilename.into()))?;
        if !self.drafts.contains_key(folder) {
            self.make_folder(folder).map_err(at_fault)?;
            let draft = temporary_in(folder).map_err(at_fault)?;
            self.drafts.insert(folder.to_owned(), draft);
        }
        Ok(self.drafts[folder].path().join(name))
    }

    fn make_folder(&mut self, folder: &Path) -> io::Result<()> {
        let missing: Vec<&Path> = folder.ancestors().take_while(|f| !exists(f)).collect();
        for folder in missing.into_iter().rev() {
            fs::create_dir(folder)?;
            self.made.push(folder.to_owned());
        }
        Ok(())
    }

    /// Moves all files to their places.
    fn publish(mut self) -> Result<(), Failure> {
        for (from, to) in self.moves()? {
            let target = settled(&to);
            let at_fault = |source| Failure::Output { file: to.clone(), source };
            if let Ok(before) = fs::metadata(&target) {
                fs::set_permissions(&from, before.permissions()).map_err(at_fault)?;
            }
            fs::rename(&from, &target).map_err(at_fault)?;
        }
        self.made.clear();
        Ok(())
    }

    /// All files, with their places, which can be taken.
    fn moves(&self) -> Result<Vec<(PathBuf, PathBuf)>, Failure> {
        let mut moves = Vec::new();
        for (folder, draft) in &self.drafts {
            let at_fault = |source| Failure::Output { file: folder.clone(), source };
            for entry in fs::read_dir(draft.path()).map_err(at_fault)? {
                let entry = entry.map_err(at_fault)?;
                let place = folder.join(entry.file_name());
                check_plain(&place)?;
                moves.push((entry.path(), place));
            }
        }
        moves.sort();
        Ok(moves)
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        self.drafts.clear();
        for folder in self.made.drain(..).rev() {
            // Only empty folders are removed: what others put there stays.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Whether `file` could be written: it is no folder, and where it will be there
/// is one, or can be made.
fn check_place(file: &Path) -> Result<(), Failure> {
    check_plain(file)?;
    let folder = folder_of(file);
    let there = folder.ancestors().find(|f| exists(f)).unwrap_or(Path::new("."));
    // The only way to know is to try.
    temporary_in(there).map(drop).map_err(|source| Failure::Output { file: file.to_owned(), source })
}

fn check_plain(file: &Path) -> Result<(), Failure> {
    match fs::metadata(file) {
        Ok(metadata) if !metadata.is_file() => Err(Failure::NotAFile { file: file.to_owned() }),
        _ => Ok(()),
    }
}

fn temporary_in(folder: &Path) -> io::Result<TempDir> {
    Builder::new().prefix(".hexdel-").tempdir_in(folder).map_err(|error| {
        // What the system says alone, without a name that means nothing to
        // the reader.
        let system = error.get_ref().and_then(|e| e.source()).and_then(|e| e.downcast_ref::<io::Error>());
        system.and_then(io::Error::raw_os_error).map_or(error.kind().into(), io::Error::from_raw_os_error)
    })
}

/// Like [`Path::exists`], the empty path being the current folder.
fn exists(folder: &Path) -> bool {
    folder.as_os_str().is_empty() || folder.exists()
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// One name for one file, whether it is there or not, links followed.
fn settled(path: &Path) -> PathBuf {
    path.canonicalize().unwrap_or_else(|_| {
        let folder = folder_of(path);
        let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        path.file_name().map_or(folder.clone(), |name| folder.join(name))
    })
}

fn unknown_extension(path: &Path, known: &'static str) -> Failure {
    WriteError::UnknownExtension { file: path.display().to_string(), known }.into()
}

/// The failure with the file's own name in place of its draft's.
fn renamed(failure: Failure, path: &Path) -> Failure {
    match failure {
        Failure::Output { source, .. } | Failure::Write(WriteError::Io { source, .. }) => {
            Failure::Output { file: path.to_owned(), source }
        }
        Failure::Write(error) => Failure::Write(error.renamed(&path.display().to_string())),
        other => other,
    }
}
