//! Which columns of a table are x and y.
//!
//! A header tells by its names, in any order: `x` and `y`, `easting` and `northing`,
//! `lon` and `lat`, with what usually stands around them (`X_UTM`, `point_x`, `Y [m]`).
//! What does not tell is an error, not a guess.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// A column of a table that is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Column {
    /// By its number, from 1; no table has a column 0.
    Number(usize),
    /// By its name in the header, in upper or lower case.
    Name(String),
}

/// The columns of x and y that are asked for.
///
/// ```
/// use hexdel_io::{Column, Columns};
///
/// let columns: Columns = "Easting,3".parse()?;
/// assert_eq!(columns.x, Column::Name("Easting".to_owned()));
/// assert_eq!(columns.y, Column::Number(3));
/// assert!("Easting".parse::<Columns>().is_err());
/// # Ok::<(), hexdel_io::ColumnsError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// That of x.
    pub x: Column,
    /// That of y.
    pub y: Column,
}

/// Why a text names no two columns.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ColumnsError {
    /// They are not two.
    #[error("expected the columns of x and y by name or number, like 2,3, got {found:?}")]
    NotTwo {
        /// The text.
        found: String,
    },
    /// A number is 0.
    #[error("columns must be counted from 1, got 0")]
    Zero,
    /// Both are the same.
    #[error("x and y must be different columns, got {column} twice")]
    Same {
        /// The column.
        column: Column,
    },
}

impl FromStr for Columns {
    type Err = ColumnsError;

    fn from_str(text: &str) -> Result<Self, ColumnsError> {
        let not_two = || ColumnsError::NotTwo { found: text.to_owned() };
        let (x, y) = text.split_once(',').ok_or_else(not_two)?;
        let column = |text: &str| match (text.trim(), text.trim().parse::<usize>()) {
            ("", _) => Err(not_two()),
            (_, Ok(0)) => Err(ColumnsError::Zero),
            (_, Ok(number)) => Ok(Column::Number(number)),
            (name, Err(_)) => Ok(Column::Name(name.to_owned())),
        };
        let columns = Self { x: column(x)?, y: column(y)? };
        if columns.x == columns.y { Err(ColumnsError::Same { column: columns.x }) } else { Ok(columns) }
    }
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Name(name) => write!(f, "{name}"),
        }
    }
}

/// A column that was taken.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TakenColumn {
    /// Its number, from 1.
    pub number: usize,
    /// Its name, if there is a header.
    pub name: Option<String>,
}

impl fmt::Display for TakenColumn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.name {
            Some(name) => write!(f, "{name} (column {})", self.number),
            None => write!(f, "column {}", self.number),
        }
    }
}

/// The columns that x and y were taken from.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TakenColumns {
    /// That of x.
    pub x: TakenColumn,
    /// That of y.
    pub y: TakenColumn,
    /// Whether numbers had decimal commas.
    pub decimal_commas: bool,
}

impl fmt::Display for TakenColumns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "x = {}, y = {}", self.x, self.y)?;
        if self.decimal_commas { write!(f, ", with decimal commas") } else { Ok(()) }
    }
}

/// Names that are coordinates by themselves, x and y of a pair.
const PAIRS: [(&[&str], &[&str]); 4] = [
    (&["x"], &["y"]),
    (
        &["e", "east", "easting", "eastings", "ostwert", "este"],
        &["n", "north", "northing", "northings", "nordwert", "norte"],
    ),
    (&["lon", "long", "lng", "longitude"], &["lat", "latitude"]),
    (&["rechtswert"], &["hochwert"]),
];

/// What may stand around such a name without changing what it is.
const AROUND: [&str; 29] = [
    "utm",
    "point",
    "pt",
    "coord",
    "coords",
    "coordinate",
    "coordinates",
    "pos",
    "position",
    "centroid",
    "center",
    "centre",
    "node",
    "loc",
    "location",
    "gps",
    "geo",
    "map",
    "grid",
    "proj",
    "projected",
    "wgs84",
    "decimal",
    "dec",
    "deg",
    "degrees",
    "dd",
    "m",
    "km",
];

/// Names of columns that number rows.
const IDS: [&str; 9] = ["id", "fid", "oid", "objectid", "gid", "index", "nr", "no", "row"];

/// What a name says of a column: the pair that it belongs to, and whether it is its x.
fn meaning(name: &str) -> Option<(usize, bool)> {
    let name = name.to_lowercase();
    let plain = name.split(['[', '(']).next().unwrap_or_default();
    let words = plain.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let mut core = words.filter(|word| !AROUND.contains(word));
    let (word, None) = (core.next()?, core.next()) else {
        return None;
    };
    of_word(word).or_else(|| of_word(without_around(word)?))
}

fn of_word(word: &str) -> Option<(usize, bool)> {
    let of_pair = |(i, (xs, ys)): (usize, &(&[&str], &[&str]))| {
        if xs.contains(&word) { Some((i, true)) } else { ys.contains(&word).then_some((i, false)) }
    };
    PAIRS.iter().enumerate().find_map(of_pair)
}

/// `xcoord`, `utmx`, `pointx`: a name grown together with what is around it.
fn without_around(word: &str) -> Option<&str> {
    let long = AROUND.iter().filter(|around| around.len() > 2);
    let mut parts = long.filter_map(|around| word.strip_prefix(around).or_else(|| word.strip_suffix(around)));
    // A letter of its own that is not x or y may be part of any word, but for `utme`.
    parts.find(|part| part.len() > 1 || matches!(*part, "x" | "y") || word.contains("utm"))
}

/// The columns of x and y by the names of a header, or why they do not tell.
pub(crate) fn by_names(names: &[&str]) -> Result<[usize; 2], &'static str> {
    let exact = |wanted: &str| {
        let mut all = (0..names.len()).filter(|&i| names[i].eq_ignore_ascii_case(wanted));
        all.next().filter(|_| all.next().is_none())
    };
    if let (Some(x), Some(y)) = (exact("x"), exact("y")) {
        return Ok([x, y]);
    }
    let meanings: Vec<Option<(usize, bool)>> = names.iter().map(|name| meaning(name)).collect();
    let mut found = Vec::new();
    let mut twice = false;
    for pair in 0..PAIRS.len() {
        let of = |is_x: bool| -> Vec<usize> {
            (0..names.len()).filter(|&i| meanings[i] == Some((pair, is_x))).collect()
        };
        let (xs, ys) = (of(true), of(false));
        match (&xs[..], &ys[..]) {
            (&[x], &[y]) => found.push([x, y]),
            ([], _) | (_, []) => {}
            _ => twice = true,
        }
    }
    match found[..] {
        [columns] if !twice => Ok(columns),
        [] if !twice => Err("the header does not say which columns are x and y"),
        _ => Err("the header has several columns that could be x and y"),
    }
}

/// Whether a name is one of a column that numbers rows.
pub(crate) fn names_id(name: &str) -> bool {
    let name = name.trim().to_lowercase();
    IDS.contains(&name.trim_matches(|c: char| !c.is_alphanumeric())) || name.ends_with("_id") || name == "#"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_in_any_order() {
        for (names, columns) in [
            (&["x", "y"][..], [0, 1]),
            (&["Y", "X"], [1, 0]),
            (&["ID", "Easting", "Northing", "Elev"], [1, 2]),
            (&["well", "X_UTM", "Y_UTM"], [1, 2]),
            (&["name", "lat", "lon"], [2, 1]),
            (&["Latitude", "Longitude", "alt"], [1, 0]),
            (&["OBJECTID", "POINT_Y", "POINT_X", "z"], [2, 1]),
            (&["X [m]", "Y [m]", "Z [m]"], [0, 1]),
            (&["n", "E (m)", "N (m)"], [1, 2]),
            (&["xcoord", "ycoord"], [0, 1]),
            (&["Coord_X", "Coord_Y"], [0, 1]),
            (&["utme", "utmn"], [0, 1]),
            (&["decimalLatitude", "decimalLongitude"], [1, 0]),
            (&["depth", "GPS Lat (deg)", "GPS Long (deg)"], [2, 1]),
            (&["lat", "lon", "x", "y"], [2, 3]),
            (&["Rechtswert", "Hochwert"], [0, 1]),
            (&["x", "y", "x_centroid", "y_centroid"], [0, 1]),
        ] {
            let found = by_names(names);
            // "n" beside "N (m)" is two columns of the same meaning.
            if names[0] == "n" {
                assert!(found.is_err(), "{names:?}");
            } else {
                assert_eq!(found, Ok(columns), "{names:?}");
            }
        }
    }

    #[test]
    fn other_names_do_not_tell() {
        for (names, words) in [
            (&["a", "b"][..], "does not say"),
            (&["x", "z"], "does not say"),
            (&["length", "width"], "does not say"),
            (&["pose", "posn"], "does not say"),
            (&["lon", "northing"], "does not say"),
            (&["lon", "lat", "east", "north"], "several"),
            (&["x1", "y1", "x2", "y2"], "does not say"),
            (&["x_utm", "x_map", "y_utm"], "several"),
            (&["next", "latest"], "does not say"),
        ] {
            assert!(by_names(names).unwrap_err().contains(words), "{names:?}");
        }
        assert!(["ID", "fid", "OBJECTID", "well_id", "Nr.", "#"].into_iter().all(names_id));
        assert!(!["x", "width", "grid"].into_iter().any(names_id));
    }

    #[test]
    fn columns_are_asked_for_by_name_or_number() {
        let columns: Columns = " 2 , Nord ".parse().unwrap();
        assert_eq!(columns, Columns { x: Column::Number(2), y: Column::Name("Nord".to_owned()) });
        for (bad, message) in [
            ("", "expected the columns of x and y by name or number, like 2,3, got \"\""),
            ("2", "expected the columns of x and y by name or number, like 2,3, got \"2\""),
            (",2", "expected the columns of x and y by name or number, like 2,3, got \",2\""),
            ("1,", "expected the columns of x and y by name or number, like 2,3, got \"1,\""),
            ("0,1", "columns must be counted from 1, got 0"),
            ("2,2", "x and y must be different columns, got 2 twice"),
            ("a,a", "x and y must be different columns, got a twice"),
        ] {
            assert_eq!(bad.parse::<Columns>().unwrap_err().to_string(), message);
        }
    }
}
