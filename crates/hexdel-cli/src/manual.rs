//! `hexdel completions` and `hexdel man`, made of the commands themselves.

use crate::exit::{Failure, Outcome, Verdict, print};
use clap::Command;
use clap_complete::Shell;
use std::path::PathBuf;

/// Print completions for a shell
#[derive(clap::Args)]
#[command(after_help = "\
    Examples:\n  \
    hexdel completions bash > ~/.local/share/bash-completion/completions/hexdel\n  \
    hexdel completions fish > ~/.config/fish/completions/hexdel.fish")]
pub(crate) struct CompletionArgs {
    /// The shell
    shell: Shell,
}

/// Print the manual page, or write those of all commands
#[derive(clap::Args)]
#[command(after_help = "\
    Examples:\n  \
    hexdel man | man -l -\n  \
    hexdel man ~/.local/share/man/man1")]
pub(crate) struct ManArgs {
    /// Folder for the pages of all commands
    folder: Option<PathBuf>,
}

/// Prints completions.
pub(crate) fn completions(mut command: Command, args: &CompletionArgs) -> Outcome {
    let mut bytes = Vec::new();
    clap_complete::generate(args.shell, &mut command, "hexdel", &mut bytes);
    print(&String::from_utf8_lossy(&bytes))?;
    Ok(Verdict::Holds)
}

/// Prints or writes manual pages.
pub(crate) fn man(command: Command, args: &ManArgs) -> Outcome {
    if let Some(folder) = &args.folder {
        let at_fault = |source| Failure::Output { file: folder.clone(), source };
        std::fs::create_dir_all(folder).map_err(at_fault)?;
        clap_mangen::generate_to(command, folder).map_err(at_fault)?;
        return Ok(Verdict::Holds);
    }
    let mut bytes = Vec::new();
    clap_mangen::Man::new(command).render(&mut bytes).map_err(Failure::Stdout)?;
    print(&String::from_utf8_lossy(&bytes))?;
    Ok(Verdict::Holds)
}
