//! Files that appear complete or not at all.
//!
//! A [`Draft`] is a temporary file in the folder of its target; [`Draft::publish`]
//! renames it, dropping it removes it. Renaming is atomic for readers on the same
//! system. Surviving a power cut would take a sync, which is left out.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use crate::error::WriteError;

/// A file that is being written.
pub(crate) struct Draft {
    /// Where the file goes, symbolic links followed.
    target: PathBuf,
    /// The name given, for errors.
    name: String,
    file: NamedTempFile,
}

impl Draft {
    /// Begins a file at `path`, which may exist as a plain file.
    pub(crate) fn create(path: &Path) -> Result<Self, WriteError> {
        let name = path.display().to_string();
        // A link is to stay a link, so the file it leads to is what is replaced.
        let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let before = fs::metadata(&target).ok();
        if before.as_ref().is_some_and(|metadata| !metadata.is_file()) {
            return Err(WriteError::NotAFile { file: name });
        }
        let file = temporary(&target, before.as_ref()).map_err(WriteError::io(&name))?;
        Ok(Self { target, name, file })
    }

    /// Fills the file. Writers are expected to buffer.
    pub(crate) fn write(
        &mut self,
        write: impl FnOnce(&mut dyn io::Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        write(self.file.as_file_mut()).map_err(WriteError::io(&self.name))
    }

    /// Gives the file its name.
    pub(crate) fn publish(self) -> Result<(), WriteError> {
        let named = self.file.persist(&self.target);
        named.map(drop).map_err(|e| WriteError::io(&self.name)(e.error))
    }
}

/// A temporary file beside `target`, open to whom the file `before` was.
fn temporary(target: &Path, before: Option<&Metadata>) -> io::Result<NamedTempFile> {
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = Builder::new();
    builder.prefix(".hexdel-").suffix(".tmp");
    #[cfg(unix)]
    {
        // Without this only the owner could read the file. The system takes off
        // what the user's mask forbids.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let file = builder.tempfile_in(folder)?;
    if let Some(before) = before {
        file.as_file().set_permissions(before.permissions())?;
    }
    Ok(file)
}
