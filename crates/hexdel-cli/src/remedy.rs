//! The way out of an error: the option, with a value, that would cure it.

use crate::exit::Failure;
use hexdel::pslg::{PslgError, ValidateError};
use hexdel_io::{PointFormat, ReadError};
use std::path::Path;

/// What would help, if an option would.
pub(crate) fn of(failure: &Failure) -> Option<String> {
    match failure {
        Failure::Read(error) => of_reading(error),
        Failure::Mesh { source, .. } => of_meshing(source),
        _ => None,
    }
}

fn of_reading(error: &ReadError) -> Option<String> {
    let by_number = "by name or number, says which columns are x and y";
    Some(match error {
        ReadError::Columns { likely: Some([x, y]), .. } => {
            format!("--columns {}, {by_number}", quoted(&format!("{x},{y}")))
        }
        ReadError::Columns { .. } | ReadError::NoColumn { .. } => format!("--columns X,Y, {by_number}"),
        ReadError::Several { errors, .. } => return errors.first().and_then(of_reading),
        ReadError::Malformed { file, expected, found, .. } if is_table(file) && is_other(expected, found) => {
            format!("--columns X,Y, {by_number}: --columns 2,3 takes the second and the third")
        }
        ReadError::UnknownExtension { file, .. } => format!(
            "the format can be named if the file comes by standard input: - --format csv < {}",
            quoted(file)
        ),
        ReadError::PointsElsewhere { .. } => {
            "give the name of the .poly in the place of -, with its .node beside it".to_owned()
        }
        _ => return None,
    })
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

fn of_meshing(error: &hexdel::Error) -> Option<String> {
    use hexdel::Error as E;
    Some(match error {
        E::TooClose { least, .. } => {
            format!("--repair={:e} makes one point of those that are closer than that", above(*least))
        }
        E::DomainTooSmall { least, .. } => format!("--domain-radius {}, or none", above(*least)),
        E::DomainTooLarge { most, .. } => format!("--domain-radius {}, or none", below(*most)),
        E::Segments(ValidateError::Crossing { .. } | ValidateError::Overlap { .. }) => {
            "--repair divides segments where they meet; --repair=TOL joins what is up to TOL apart as well".to_owned()
        }
        E::Segments(ValidateError::NotFollowed { .. }) => "--repair joins points that are too close".to_owned(),
        E::Pslg(PslgError::NothingEnclosed { .. }) => {
            "--domain hull meshes the convex hull (hexdel triangle: -c); --repair=TOL closes gaps of up to TOL".to_owned()
        }
        E::Pslg(error) => {
            // Rounded to one digit it is still enough.
            format!("--repair={:.0e} makes them one", 1.5 * error.repair_within()?)
        }
        E::NotForGraphs { option } if option.contains("radius") => {
            "--domain hexagon, hull or box says what to mesh around a graph".to_owned()
        }
        E::NotForGraphs { option } if option.contains("simple") => {
            "--method compact or --method templates".to_owned()
        }
        E::NotForPoints { .. } => "--domain hull, box or hexagon with --repair meshes points as a graph".to_owned(),
        _ => return None,
    })
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

    #[test]
    fn numbers_are_rounded_to_the_side_that_helps() {
        for (number, up, down) in
            [(1.5e-9, 2e-9, 1.4e-9), (0.03, 0.04, 0.029), (9.99, 10.0, 9.9), (123.0, 200.0, 120.0)]
        {
            assert_eq!((above(number), below(number)), (up, down));
        }
    }

    #[test]
    fn values_are_quoted_where_a_shell_would_split_them() {
        assert_eq!(quoted("a,b"), "a,b");
        assert_eq!(quoted("X [m],Y [m]"), "'X [m],Y [m]'");
    }
}
