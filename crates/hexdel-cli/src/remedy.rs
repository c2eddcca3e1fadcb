//! The way out of an error: the option, with a value, that would cure it.

use crate::exit::Failure;
use crate::plane;
use clap::Command;
use hexdel::pslg::{Feature, PslgError, ValidateError};
use hexdel_io::{MeshFormat, PointFormat, ReadError, WriteError};
use std::path::Path;

/// What would help, if an option would: one that the command has, or another command.
pub(crate) fn of(failure: &Failure, command: Option<&Command>) -> Option<String> {
    let of = Remedies { command: command? };
    match failure {
        Failure::Read(error) => of.reading(error),
        Failure::Write(WriteError::UnknownExtension { .. })
            if of.has("input-format") && !of.has("output") =>
        {
            Some("--input-format NAME says what the input is, --format NAME what the output is".to_owned())
        }
        Failure::NoFormat { stream: "input" } if of.has("input-format") => {
            Some("name it with --format, or with --input-format if the output has another format".to_owned())
        }
        Failure::NoFormat { .. } => of.has("format").then(|| "name it with --format".to_owned()),
        Failure::Mesh { source, file, .. } => of.meshing(source, file),
        Failure::Projection { source, .. } => plane::remedy(source).map(str::to_owned),
        _ => None,
    }
}

/// The ways out that a command has.
struct Remedies<'a> {
    command: &'a Command,
}

impl Remedies<'_> {
    fn has(&self, long: &str) -> bool {
        self.command.get_arguments().any(|argument| argument.get_long() == Some(long))
    }

    fn is(&self, name: &str) -> bool {
        self.command.get_name() == name
    }

    fn reading(&self, error: &ReadError) -> Option<String> {
        let by_number = "by name or number, says which columns are x and y";
        let columns = |text: String| self.has("columns").then_some(text);
        match error {
            ReadError::Columns { likely: Some([x, y]), .. } => {
                columns(format!("--columns {}, {by_number}", quoted(&format!("{x},{y}"))))
            }
            ReadError::Columns { .. } | ReadError::NoColumn { .. } => {
                columns(format!("--columns X,Y, {by_number}"))
            }
            ReadError::Several { errors, .. } => self.reading(errors.first()?),
            ReadError::Malformed { file, expected, found, .. }
                if is_table(file) && is_other(expected, found) =>
            {
                columns(format!("--columns X,Y, {by_number}: --columns 2,3 takes the second and the third"))
            }
            ReadError::UnknownExtension { file, known } => self.naming_a_format(file, known),
            ReadError::PointsElsewhere { .. } => {
                Some("give the name of the .poly instead of -, with its .node beside it".to_owned())
            }
            _ => None,
        }
    }

    /// How the format of a file can be named whose extension does not.
    fn naming_a_format(&self, file: &str, known: &str) -> Option<String> {
        let (file, of_mesh) = (quoted(file), known == MeshFormat::READABLE);
        if !self.has("format") {
            let converted = format!("`hexdel convert {file} mesh.vtu --input-format NAME` makes one that is");
            return of_mesh.then_some(converted);
        }
        let stream = match (of_mesh, self.has("input")) {
            (true, _) => "- --format NAME",
            (false, true) => "--input - --format csv",
            (false, false) => "- --format csv",
        };
        Some(format!("to name the format, read the file from standard input: {stream} < {file}"))
    }

    fn meshing(&self, error: &hexdel::Error, file: &str) -> Option<String> {
        use hexdel::Error as E;
        let repair = |value: &str| self.repair(value, file);
        match error {
            E::TooClose { least, .. } => {
                let repair = repair(&format!("={:e}", above(*least)))?;
                Some(format!("{repair} merges points that are closer than that"))
            }
            E::DomainTooSmall { least, .. } => self.radius(above(*least)),
            E::DomainTooLarge { most, .. } => self.radius(below(*most)),
            E::Segments(ValidateError::Crossing { .. } | ValidateError::Overlap { .. }) => {
                let (repair, within) = (repair("")?, repair("=TOL")?);
                Some(format!(
                    "{repair} divides segments where they meet; {within} also joins what is up to TOL apart"
                ))
            }
            E::Segments(ValidateError::NotFollowed { .. }) => {
                Some(format!("{} joins points that are too close", repair("")?))
            }
            E::Pslg(PslgError::NothingEnclosed { .. }) => {
                let hull = if self.is("triangle") { "-c" } else { self.option("domain", "--domain hull")? };
                Some(format!("{hull} meshes the convex hull; {} closes gaps of up to TOL", repair("=TOL")?))
            }
            E::NoDualEdge { .. } => self
                .option("min-dual-edge", "--min-dual-edge 0.1 asks for angles of at most 84.3 degrees")
                .map(str::to_owned),
            E::Overlap { .. } => {
                let later = self.option("overlaps", "--overlaps later")?;
                Some(format!("{later} takes the attribute of the later polygon"))
            }
            E::Pslg(
                PslgError::FlatHull { .. }
                | PslgError::TooClose { items: [Feature::Hull, Feature::Hull], .. },
            ) => {
                let domain = self.option("domain", "--domain hexagon or box")?;
                Some(format!("{domain} meshes the area around points that are nearly in line"))
            }
            E::Pslg(error) => {
                // Rounded to one digit it is still enough.
                let repair = repair(&format!("={:.0e}", 1.5 * error.repair_within()?))?;
                Some(format!("{repair} makes them one"))
            }
            E::NotForGraphs { option } if option.contains("radius") => {
                let domain = self.option("domain", "--domain hexagon, hull or box")?;
                Some(format!("{domain} says what to mesh around a PSLG"))
            }
            E::NotForGraphs { option } if option.contains("simple") => {
                self.option("method", "--method compact or --method templates").map(str::to_owned)
            }
            E::NotForPoints { .. } if self.has("repair") => {
                let domain = self.option("domain", "--domain hull, box or hexagon with --repair")?;
                Some(format!("{domain} meshes points as a PSLG"))
            }
            _ => None,
        }
    }

    /// A usage, if the command has the option.
    fn option(&self, long: &str, usage: &'static str) -> Option<&'static str> {
        self.has(long).then_some(usage)
    }

    fn radius(&self, radius: f64) -> Option<String> {
        self.has("domain-radius").then(|| format!("--domain-radius {radius}, or none"))
    }

    /// Repair with a tolerance, or `hexdel mesh` with it in the place of `hexdel triangle`.
    fn repair(&self, value: &str, file: &str) -> Option<String> {
        if self.has("repair") {
            return Some(format!("--repair{value}"));
        }
        self.is("triangle").then(|| format!("`hexdel mesh {} -o mesh.ele --repair{value}`", quoted(file)))
    }
}

/// Whether the field of a table is likely to be one of another column.
fn is_other(expected: &str, found: &str) -> bool {
    let is_name = expected.contains("coordinate") && found.contains(char::is_alphabetic);
    is_name && found.starts_with('"') || expected.contains("the header has")
}

fn is_table(file: &str) -> bool {
    let format = PointFormat::from_path(Path::new(file));
    matches!(format, Some(PointFormat::Table | PointFormat::Csv | PointFormat::Tsv))
}

/// As a shell would take it.
fn quoted(text: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || matches!(c, ',' | '.' | '_' | '-' | '/');
    if text.chars().all(plain) { text.to_owned() } else { format!("'{text}'") }
}

/// A number of one digit that is larger.
fn above(number: f64) -> f64 {
    rounded(number, |step| (number / step).floor() + 1.0)
}

/// A number of two digits that is smaller.
fn below(number: f64) -> f64 {
    rounded(number, |step| ((10.0 * number / step).ceil() - 1.0) / 10.0)
}

/// So many steps of the number's own power of ten.
fn rounded(number: f64, steps: impl Fn(f64) -> f64) -> f64 {
    let exponent = number.log10().floor();
    // Through a text: products of powers of ten have digits that nobody wants.
    let steps = steps(10_f64.powf(exponent));
    format!("{steps}e{exponent}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn numbers_are_rounded_to_the_side_that_helps() {
        for (number, up, down) in
            [(1.5e-9, 2e-9, 1.4e-9), (0.03, 0.04, 0.029), (9.99, 10.0, 9.9), (123.0, 200.0, 120.0)]
        {
            assert_eq!((above(number), below(number)), (up, down));
        }
    }

    fn failures() -> Vec<Failure> {
        use hexdel::Error as E;
        let file = || "a.poly".to_owned();
        let columns =
            |likely| ReadError::Columns { file: file(), line: 1, fault: "", header: file(), likely };
        let [x, y] = ["u".to_owned(), "v".to_owned()];
        let unknown = |known| ReadError::UnknownExtension { file: file(), known };
        let read = [
            columns(Some([x, y])),
            columns(None),
            unknown(MeshFormat::READABLE),
            unknown(PointFormat::READABLE),
            ReadError::PointsElsewhere { file: file(), line: 1 },
        ];
        let [a, b] = [hexdel::DVec2::ZERO, hexdel::DVec2::X];
        let loose = Vec::new();
        let made = [
            E::TooClose { a: 0, b: 1, points: [a, b], distance: 1e-9, least: 1.5e-9 },
            E::DomainTooSmall { radius: 1.0, least: 1.5 },
            E::DomainTooLarge { radius: 1.0, most: 0.5 },
            E::Segments(ValidateError::Crossing { segments: [0, 1], at: a }),
            E::Pslg(PslgError::NothingEnclosed { loose, count: 0 }),
            E::Pslg(PslgError::FlatHull {
                farthest: Feature::Point(1),
                ends: [0, 2].map(Feature::Point),
                distance: 1e-13,
            }),
            E::NoDualEdge { ratio: 0.5 },
            E::Overlap { polygons: [0, 1], attributes: [1.0, 2.0], at: a, area: 1.0 },
            E::NotForGraphs { option: "a radius of the domain" },
            E::NotForGraphs { option: "the simple method" },
            E::NotForPoints { option: "repair" },
        ];
        let meshed = |source| Failure::Mesh { file: file(), source: Box::new(source), more: String::new() };
        let streams = ["input", "output"].map(|stream| Failure::NoFormat { stream });
        let written = WriteError::UnknownExtension { file: file(), known: "" };
        let read = read.into_iter().map(Failure::Read).chain([Failure::Write(written)]);
        read.chain(made.into_iter().map(meshed)).chain(streams).collect()
    }

    /// The options of a text, those of another command in quotes of that command.
    fn check_options(text: &str, name: &str) {
        let commands = crate::Cli::command();
        for (i, part) in text.split('`').enumerate() {
            let words = || part.split(|c: char| c.is_whitespace() || matches!(c, '=' | ',' | ';' | ':'));
            let name = if i % 2 == 1 { words().nth(1).unwrap() } else { name };
            let command = commands.find_subcommand(name).unwrap();
            for long in words().filter_map(|word| word.strip_prefix("--")) {
                let has = |a: &clap::Arg| a.get_long() == Some(long);
                assert!(command.get_arguments().any(has), "{name} has no --{long}: {text}");
            }
            assert!(name == "triangle" || !words().any(|word| word == "-c"), "{name}: {text}");
        }
    }

    #[test]
    fn no_command_is_told_of_the_options_of_another() {
        let mut told = 0;
        for command in crate::Cli::command().get_subcommands() {
            for failure in failures() {
                if let Some(text) = of(&failure, Some(command)) {
                    check_options(&text, command.get_name());
                    told += 1;
                }
            }
        }
        assert!(told > 30, "{told}");
        let commands = crate::Cli::command();
        for failure in failures() {
            let (name, mesh) = (failure.to_string(), commands.find_subcommand("mesh"));
            // A mesh is not what this command reads, and its outputs have extensions.
            let spare = matches!(failure, Failure::Write(_));
            assert!(spare || of(&failure, mesh).is_some(), "{name}");
        }
    }

    #[test]
    fn values_are_quoted_where_a_shell_would_split_them() {
        assert_eq!(quoted("a,b"), "a,b");
        assert_eq!(quoted("X [m],Y [m]"), "'X [m],Y [m]'");
    }
}
