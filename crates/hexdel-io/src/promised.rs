//! What was promised of a mesh, carried along with it.
//!
//! Lines of text say it, for formats with comments or names:
//!
//! ```text
//! hexdel: angles 30 90 far 43.8978 90 domain inside
//! hexdel: exempt 3 17
//! ```
//!
//! `.ele` has it as a comment, `.msh` as the name of a physical group without
//! elements and as element data `exempt`, `.vtu` as field data, `.json` and `.ron`
//! as a member of their own.

use std::fmt;
use std::str::FromStr;

use hexdel_geom::AngleBounds;
use serde::{Deserialize, Serialize};

/// What a mesh was made to keep.
///
/// # Examples
///
/// ```
/// use hexdel_geom::AngleBounds;
/// use hexdel_io::{Promised, PromisedDomain};
///
/// let promised = Promised {
///     near: AngleBounds::new(30.0, 90.0)?,
///     far: AngleBounds::EXTENDED,
///     domain: PromisedDomain::Inside,
///     exempt: vec![3, 17],
/// };
/// let text = "hexdel: angles 30 90 far 43.8978 90 domain inside\nhexdel: exempt 3 17";
/// assert_eq!(promised.to_string(), text);
/// assert_eq!(text.parse(), Ok(promised));
/// # Ok::<(), hexdel_geom::BoundsError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Promised {
    /// Bounds of all triangles.
    pub near: AngleBounds,
    /// Bounds of those two edges or more away from points and segments.
    pub far: AngleBounds,
    /// What the mesh covers.
    pub domain: PromisedDomain,
    /// The triangles that a corner of the input excuses, by number from 0.
    pub exempt: Vec<u32>,
}

/// The part of the plane that a mesh was made to cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PromisedDomain {
    /// A regular hexagon, without holes.
    Hexagon,
    /// The convex hull of the points.
    Hull,
    /// A rectangle.
    Box,
    /// What segments enclose.
    Inside,
}

/// All domains, in the order of the numbers that field data have for them.
const DOMAINS: [PromisedDomain; 4] =
    [PromisedDomain::Hexagon, PromisedDomain::Hull, PromisedDomain::Box, PromisedDomain::Inside];

impl PromisedDomain {
    fn name(self) -> &'static str {
        match self {
            Self::Hexagon => "hexagon",
            Self::Hull => "hull",
            Self::Box => "box",
            Self::Inside => "inside",
        }
    }

    pub(crate) fn number(self) -> u8 {
        DOMAINS.iter().position(|&d| d == self).unwrap_or(0) as u8
    }

    pub(crate) fn of_number(number: f64) -> Option<Self> {
        DOMAINS.into_iter().find(|d| f64::from(d.number()) == number)
    }
}

/// What each line begins with.
pub(crate) const PREFIX: &str = "hexdel: ";

/// Exempt triangles in a line: some hundred kilobytes, so that readers of lines take it.
const IN_LINE: usize = 10_000;

/// A text that is none of ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotPromised;

impl Promised {
    /// The line without the exempt triangles.
    pub(crate) fn head(&self) -> String {
        let Self { near, far, domain, .. } = self;
        let [a, b, c, d] = [near.min_deg(), near.max_deg(), far.min_deg(), far.max_deg()];
        format!("{PREFIX}angles {a} {b} far {c} {d} domain {}", domain.name())
    }
}

impl fmt::Display for Promised {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.head())?;
        for line in self.exempt.chunks(IN_LINE) {
            write!(f, "\n{PREFIX}exempt")?;
            line.iter().try_for_each(|t| write!(f, " {t}"))?;
        }
        Ok(())
    }
}

impl FromStr for Promised {
    type Err = NotPromised;

    fn from_str(text: &str) -> Result<Self, NotPromised> {
        let mut lines = text.lines().map(|line| line.strip_prefix(PREFIX).ok_or(NotPromised));
        let mut words = lines.next().ok_or(NotPromised)??.split_ascii_whitespace();
        keyword(&mut words, "angles")?;
        let near = bounds(&mut words)?;
        keyword(&mut words, "far")?;
        let far = bounds(&mut words)?;
        keyword(&mut words, "domain")?;
        let name = words.next().ok_or(NotPromised)?;
        let domain = DOMAINS.into_iter().find(|d| d.name() == name).ok_or(NotPromised)?;
        if words.next().is_some() {
            return Err(NotPromised);
        }
        let mut exempt = Vec::new();
        for line in lines {
            let mut words = line?.split_ascii_whitespace();
            keyword(&mut words, "exempt")?;
            for word in words {
                exempt.push(word.parse().map_err(|_| NotPromised)?);
            }
        }
        Ok(Self { near, far, domain, exempt })
    }
}

fn keyword<'a>(words: &mut impl Iterator<Item = &'a str>, expected: &str) -> Result<(), NotPromised> {
    if words.next() == Some(expected) { Ok(()) } else { Err(NotPromised) }
}

fn bounds<'a>(words: &mut impl Iterator<Item = &'a str>) -> Result<AngleBounds, NotPromised> {
    let mut number = || words.next().and_then(|w| w.parse().ok()).ok_or(NotPromised);
    AngleBounds::new(number()?, number()?).map_err(|_| NotPromised)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_domain_is_read_back_and_other_texts_are_refused() {
        for (domain, exempt) in
            DOMAINS.into_iter().zip([vec![], vec![0], (0..30_000).collect(), vec![4_000_000_000, 1]])
        {
            let near = AngleBounds::new(20.5, 120.0).unwrap();
            let promised = Promised { near, far: AngleBounds::EXTENDED, domain, exempt };
            assert_eq!(promised.to_string().parse(), Ok(promised.clone()));
            assert_eq!(PromisedDomain::of_number(f64::from(domain.number())), Some(domain));
        }
        for text in [
            "",
            "angles 30 90 far 30 90 domain hull",
            "hexdel: angles 30 90",
            "hexdel: angles 90 30 far 30 90 domain hull",
            "hexdel: angles 30 90 far 30 90 domain moon",
            "hexdel: angles 30 90 far 30 90 domain hull\nhexdel: exempt x",
            "hexdel: angles 30 90 far 30 90 domain hull\nexempt 3",
            "hexdel: angles 30 90 far 30 90 domain hull exempt 3",
        ] {
            assert_eq!(text.parse::<Promised>(), Err(NotPromised), "{text}");
        }
        assert_eq!(PromisedDomain::of_number(4.0), None);
    }
}
