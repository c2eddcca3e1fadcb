//! What to say of an option that there is not: one that means the same, or nothing.

use crate::Cli;
use clap::builder::StyledStr;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, CommandFactory, Error};

/// Options of other programs, and what the same is called here, with its value. An option
/// whose value has another name is another one.
const SAME: [(&[&str], &str, &str); 17] = [
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
    (&["epsg", "srs", "srid"], "crs", "--crs EPSG:N"),
    (&["projection", "proj", "reproject", "t-srs"], "project", "--project NAME"),
    (&["grading", "growth", "growth-rate", "grade"], "gradation", "--gradation G"),
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
    // That of clap has the option that it would suggest.
    if let Some(usage) = command().map(|mut command| command.render_usage()) {
        error.insert(ContextKind::Usage, ContextValue::StyledStr(usage));
    }
    let Some(unknown) = text(error.get(ContextKind::InvalidArg)) else {
        return error;
    };
    let name = unknown.trim_start_matches('-').split('=').next().unwrap_or_default().to_owned();
    let similar = text(error.get(ContextKind::SuggestedArg));
    let tip = command().and_then(|command| meant(&name, &command));
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

/// The command that was called.
pub(crate) fn command() -> Option<Command> {
    let name = std::env::args().nth(1)?;
    let mut commands = Cli::command();
    // Only then commands know their whole names.
    commands.build();
    commands.find_subcommand(name).cloned()
}

/// What means the same in a command.
fn meant(name: &str, command: &Command) -> Option<String> {
    let same = SAME.iter().find(|(names, ..)| names.contains(&name));
    if let Some((_, option, usage)) = same
        && command.get_arguments().any(|argument| is_same(argument, option, usage))
    {
        return Some(format!("use '{usage}'"));
    }
    let option = same.map_or(name, |(_, option, _)| option);
    let ordinal = command.get_positionals().zip(["first", "second"]);
    let (_, place) = ordinal.into_iter().find(|(argument, _)| argument.get_id() == option)?;
    let all: Vec<String> = command.get_positionals().map(|a| a.get_id().as_str().to_uppercase()).collect();
    Some(format!("the {option} is the {place} argument: 'hexdel {} {}'", command.get_name(), all.join(" ")))
}

/// Whether an argument is the option of that name, and its value what the usage says.
fn is_same(argument: &Arg, option: &str, usage: &str) -> bool {
    let value = usage.split([' ', '=']).nth(1).filter(|value| value.chars().any(char::is_uppercase));
    let own = argument.get_value_names().and_then(<[_]>::first);
    argument.get_long() == Some(option)
        && value.is_none_or(|value| own.is_some_and(|own| own.as_str() == value))
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
        for (_, option, usage) in SAME {
            let has = |c: &Command| c.get_arguments().any(|a| is_same(a, option, usage));
            assert!(commands.get_subcommands().any(has), "{option}");
        }
    }

    /// What is said of every name in every command is an option of that command, with the
    /// value that it has there.
    #[test]
    fn no_command_is_told_of_the_options_of_another() {
        let mut told = 0;
        for command in Cli::command().get_subcommands() {
            for name in SAME.iter().flat_map(|(names, ..)| *names) {
                let Some(tip) = meant(name, command) else { continue };
                told += 1;
                let Some(usage) = tip.strip_prefix("use '") else { continue };
                let option = usage.trim_start_matches('-').split([' ', '=', '\'']).next().unwrap();
                let has = |a: &Arg| {
                    a.get_long() == Some(option)
                        || a.get_short().is_some_and(|short| option == short.to_string())
                };
                assert!(command.get_arguments().any(has), "{} {name}: {tip}", command.get_name());
            }
        }
        assert!(told > 50, "{told}");
        let commands = Cli::command();
        let of = |command: &str, name: &str| meant(name, commands.find_subcommand(command).unwrap());
        assert_eq!(of("mesh", "h").unwrap(), "use '--size H'");
        // The size of a picture is another one.
        assert_eq!(of("plot", "h"), None);
        assert_eq!(of("check", "repair-tolerance"), None);
        assert_eq!(
            of("convert", "to").unwrap(),
            "the output is the second argument: 'hexdel convert INPUT OUTPUT'"
        );
    }
}
