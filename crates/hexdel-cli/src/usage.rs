//! What to say of an option that there is not: one that means the same, or nothing.

use crate::Cli;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory, Error};

/// Options of other programs, and what the same is called here, with its value.
const SAME: [(&[&str], &str, &str); 14] = [
    (&["area", "maxarea", "max_area", "area-max", "triangle-area"], "max-area", "--max-area A"),
    (&["angle", "quality", "minangle", "min_angle", "angle-min"], "min-angle", "--min-angle DEG"),
    (&["maxangle", "max_angle", "angle-max"], "max-angle", "--max-angle DEG"),
    (&["out", "to", "o", "output-file", "outfile"], "output", "-o FILE"),
    (
        &["edge", "edge-length", "edge-size", "h", "length", "max-size", "clmax", "mesh-size"],
        "size",
        "--size H",
    ),
    (&["time", "timeout", "time-limit", "seconds"], "budget", "--budget SECONDS"),
    (&["cores", "jobs", "nproc", "cpus", "parallel"], "threads", "--threads N"),
    (
        &["tol", "tolerance", "snap", "merge", "fix", "heal", "clean", "eps", "epsilon"],
        "repair",
        "--repair=TOL",
    ),
    (
        &["hull", "convex-hull", "convex", "bbox", "inside", "boundary"],
        "domain",
        "--domain hexagon, hull, box or inside",
    ),
    (&["column", "cols", "xy", "fields", "x-column", "xcol", "x", "y"], "columns", "--columns X,Y"),
    (&["silent", "no-output"], "quiet", "--quiet"),
    (&["radius", "domain-size"], "domain-radius", "--domain-radius R"),
    (&["from", "input-type", "in-format"], "input-format", "--input-format NAME"),
    (&["points", "pslg-file", "graph"], "input", "--input FILE"),
];

/// Slips of the keyboard in a suggestion, at most.
const SLIPS: usize = 2;

/// The error, with a suggestion that means the same or without one.
pub(crate) fn improved(mut error: Error) -> Error {
    if error.kind() != ErrorKind::UnknownArgument {
        return error;
    }
    let text = |value: Option<&ContextValue>| match value {
        Some(ContextValue::String(text)) => Some(text.clone()),
        _ => None,
    };
    let Some(unknown) = text(error.get(ContextKind::InvalidArg)) else {
        return error;
    };
    let name = unknown.trim_start_matches('-').split('=').next().unwrap_or_default().to_owned();
    let similar = text(error.get(ContextKind::SuggestedArg));
    let tip = meant(&name, std::env::args().nth(1).as_deref());
    // That a value could begin with a dash is no help.
    error.remove(ContextKind::Suggested);
    if let Some(tip) = tip {
        error.remove(ContextKind::SuggestedArg);
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![StyledStr::from(tip)]));
    } else if similar.is_some_and(|similar| !is_slip(&name, similar.trim_start_matches('-'))) {
        error.remove(ContextKind::SuggestedArg);
    }
    error
}

/// What means the same in a command.
fn meant(name: &str, command: Option<&str>) -> Option<String> {
    let commands = Cli::command();
    let command = commands.find_subcommand(command?)?;
    let (_, option, usage) = SAME.iter().find(|(names, ..)| names.contains(&name))?;
    if command.get_arguments().any(|argument| argument.get_long() == Some(option)) {
        return Some(format!("the same here is '{usage}'"));
    }
    let positional = command.get_positionals().any(|argument| argument.get_id() == option);
    positional.then(|| {
        format!("{} comes without an option, as in 'hexdel {} INPUT OUTPUT'", option, command.get_name())
    })
}

/// Whether a name is another one but for a slip, or its beginning.
fn is_slip(name: &str, other: &str) -> bool {
    other.starts_with(name) && name.len() > 2 || distance(name, other) <= SLIPS.min(name.len() / 2)
}

/// Letters inserted, left out or exchanged between two names (Levenshtein).
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, &y) in b.iter().enumerate() {
            let next = (diagonal + usize::from(x != y)).min(row[j] + 1).min(row[j + 1] + 1);
            diagonal = std::mem::replace(&mut row[j + 1], next);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_told_from_other_names() {
        assert!(is_slip("min-angel", "min-angle") && is_slip("out", "output") && is_slip("repiar", "repair"));
        assert!(!is_slip("area", "repair") && !is_slip("to", "histogram") && !is_slip("angle", "zoom"));
    }

    #[test]
    fn every_suggestion_is_an_option_somewhere() {
        let commands = Cli::command();
        for (_, option, _) in SAME {
            let has = |c: &clap::Command| c.get_arguments().any(|a| a.get_long() == Some(option));
            assert!(commands.get_subcommands().any(has), "{option}");
        }
    }
}
