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

/// The columns of x, y and perhaps heights that are asked for.
///
/// ```
/// use hexdel_io::{Column, Columns};
///
/// let columns: Columns = "Easting,3".parse()?;
/// assert_eq!(columns.x, Column::Name("Easting".to_owned()));
/// assert_eq!(columns.y, Column::Number(3));
/// assert_eq!("1,2,3".parse::<Columns>()?.z, Some(Column::Number(3)));
/// assert!("Easting".parse::<Columns>().is_err());
/// # Ok::<(), hexdel_io::ColumnsError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// That of x.
    pub x: Column,
    /// That of y.
    pub y: Column,
    /// That of heights, if there is to be one.
    pub z: Option<Column>,
}

/// Why a text names no two or three columns.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ColumnsError {
    /// They are neither two nor three.
    #[error(
        "expected the columns of x and y by name or number, like 2,3 or 2,3,4 with heights, got {found:?}"
    )]
    NotTwo {
        /// The text.
        found: String,
    },
    /// A number is 0.
    #[error("columns must be counted from 1, got 0")]
    Zero,
    /// Two of them are the same.
    #[error("x, y and z must be different columns, got {column} twice")]
    Same {
        /// The column.
        column: Column,
    },
}

impl FromStr for Columns {
    type Err = ColumnsError;

    fn from_str(text: &str) -> Result<Self, ColumnsError> {
        let not_two = || ColumnsError::NotTwo { found: text.to_owned() };
        let mut parts = text.split(',');
        let column = |text: &str| match (text.trim(), text.trim().parse::<usize>()) {
            ("", _) => Err(not_two()),
            (_, Ok(0)) => Err(ColumnsError::Zero),
            (_, Ok(number)) => Ok(Column::Number(number)),
            (name, Err(_)) => Ok(Column::Name(name.to_owned())),
        };
        let mut next = || parts.next().map(column).transpose();
        let (Some(x), Some(y), z, None) = (next()?, next()?, next()?, next()?) else {
            return Err(not_two());
        };
        if x == y || z.as_ref() == Some(&x) {
            return Err(ColumnsError::Same { column: x });
        }
        if z.as_ref() == Some(&y) { Err(ColumnsError::Same { column: y }) } else { Ok(Self { x, y, z }) }
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
    /// That of heights, if there is one.
    pub z: Option<TakenColumn>,
    /// Whether heights are depths, of which the negative is taken.
    pub depths: bool,
    /// Whether their names are those of longitudes and latitudes.
    pub degrees: bool,
    /// Whether numbers had decimal commas.
    pub decimal_commas: bool,
}

impl fmt::Display for TakenColumns {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "x = {}, y = {}", self.x, self.y)?;
        if let Some(z) = &self.z {
            write!(f, ", z = {}{z}", if self.depths { "-" } else { "" })?;
        }
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

/// Names of heights, and of depths.
const HEIGHTS: [&[&str]; 2] =
    [&["z", "elev", "elevation", "alt", "altitude", "height", "hoehe", "h\u{f6}he"], &["depth", "tiefe"]];

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
    let word = core(name)?;
    of_word(&word).or_else(|| of_word(without_around(&word)?))
}

/// Whether a name is that of longitudes or latitudes.
pub(crate) fn names_degrees(name: &str) -> bool {
    meaning(name).is_some_and(|(pair, _)| PAIRS[pair].0.contains(&"lon"))
}

/// The one word of a name that is not around others, in lower case.
fn core(name: &str) -> Option<String> {
    let name = name.to_lowercase();
    let plain = name.split(['[', '(']).next().unwrap_or_default();
    let words = plain.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let mut core = words.filter(|word| !AROUND.contains(word));
    let (word, None) = (core.next()?, core.next()) else {
        return None;
    };
    Some(word.to_owned())
}

/// Whether a name is one of depths; `None` if it is not one of heights either.
pub(crate) fn names_depths(name: &str) -> Option<bool> {
    let word = core(name)?;
    let word = [Some(word.as_str()), without_around(&word)];
    let kind = HEIGHTS.iter().position(|names| word.iter().flatten().any(|word| names.contains(word)));
    kind.map(|kind| kind == 1)
}

/// The column of heights, if just one name is that of heights, or just one is z.
pub(crate) fn heights_by_name(names: &[&str]) -> Option<usize> {
    let one = |is: &dyn Fn(&str) -> bool| {
        let mut all = (0..names.len()).filter(|&i| is(names[i]));
        all.next().filter(|_| all.next().is_none())
    };
    one(&|name| names_depths(name).is_some()).or_else(|| one(&|name| name.eq_ignore_ascii_case("z")))
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
    fn heights_have_names_too() {
        for (names, column, depths) in [
            (&["x", "y", "z"][..], Some(2), false),
            (&["x", "y", "Elevation (m)"], Some(2), false),
            (&["POINT_Z", "POINT_X", "POINT_Y"], Some(0), false),
            (&["depth", "lat", "lon"], Some(0), true),
            (&["x", "y", "z", "depth"], Some(2), false),
            (&["x", "y", "height", "depth"], None, false),
            (&["x", "y", "zone"], None, false),
        ] {
            assert_eq!(heights_by_name(names), column, "{names:?}");
            assert!(column.is_none_or(|column| names_depths(names[column]) == Some(depths)), "{names:?}");
        }
    }

    #[test]
    fn columns_are_asked_for_by_name_or_number() {
        let columns: Columns = " 2 , Nord ".parse().unwrap();
        assert_eq!(columns, Columns { x: Column::Number(2), y: Column::Name("Nord".to_owned()), z: None });
        for (bad, message) in [
            (
                "",
                "expected the columns of x and y by name or number, like 2,3 or 2,3,4 with heights, got \"\"",
            ),
            (
                "2",
                "expected the columns of x and y by name or number, like 2,3 or 2,3,4 with heights, got \"2\"",
            ),
            (
                ",2",
                "expected the columns of x and y by name or number, like 2,3 or 2,3,4 with heights, got \",2\"",
            ),
            (
                "1,",
                "expected the columns of x and y by name or number, like 2,3 or 2,3,4 with heights, got \"1,\"",
            ),
            (
                "1,2,3,4",
                "expected the columns of x and y by name or number, like 2,3 or 2,3,4 with heights, got \"1,2,3,4\"",
            ),
            ("1,2,1", "x, y and z must be different columns, got 1 twice"),
            ("1,2,2", "x, y and z must be different columns, got 2 twice"),
            ("0,1", "columns must be counted from 1, got 0"),
            ("2,2", "x, y and z must be different columns, got 2 twice"),
            ("a,a", "x, y and z must be different columns, got a twice"),
        ] {
            assert_eq!(bad.parse::<Columns>().unwrap_err().to_string(), message);
        }
    }
}
