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
use rustc_hash::FxHashSet;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::lines::quote;

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

/// What is wrong with a text of promises.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("line {line}: expected {expected}, found {found}")]
#[non_exhaustive]
pub struct NotPromised {
    /// The line, counted from 1.
    pub line: u64,
    /// What should be there.
    pub expected: &'static str,
    /// What is there, in quotation marks, cut to a readable length.
    pub found: String,
}

/// What the first line must be.
const HEAD: &str = "hexdel: angles MIN MAX far MIN MAX domain NAME";

/// What each other line must be.
const EXEMPT: &str = "hexdel: exempt and the numbers of triangles, each once";

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
        Self::of_lines((1..).zip(text.lines()), usize::MAX)
    }
}

impl Promised {
    /// What numbered lines say of a mesh of so many triangles.
    pub(crate) fn of_lines<'a>(
        lines: impl IntoIterator<Item = (u64, &'a str)>,
        triangles: usize,
    ) -> Result<Self, NotPromised> {
        let mut lines = lines.into_iter();
        let (line, text) = lines.next().unwrap_or((1, ""));
        let fault = |line, expected, found| NotPromised { line, expected, found: quote(found) };
        let head = || {
            let mut words = text.strip_prefix(PREFIX)?.split_ascii_whitespace();
            keyword(&mut words, "angles")?;
            let near = bounds(&mut words)?;
            keyword(&mut words, "far")?;
            let far = bounds(&mut words)?;
            keyword(&mut words, "domain")?;
            let name = words.next()?;
            let domain = DOMAINS.into_iter().find(|d| d.name() == name)?;
            let exempt = Vec::new();
            words.next().is_none().then_some(Self { near, far, domain, exempt })
        };
        let mut promised = head().ok_or_else(|| fault(line, HEAD, text))?;
        let mut seen = FxHashSet::default();
        for (line, text) in lines {
            let numbers = text.strip_prefix(PREFIX).and_then(|rest| rest.strip_prefix("exempt"));
            let numbers = numbers.filter(|rest| rest.is_empty() || rest.starts_with(' '));
            for word in numbers.ok_or_else(|| fault(line, EXEMPT, text))?.split_ascii_whitespace() {
                let number = word.parse().ok().filter(|&t: &u32| (t as usize) < triangles && seen.insert(t));
                promised.exempt.push(number.ok_or_else(|| fault(line, EXEMPT, word))?);
            }
        }
        Ok(promised)
    }

    /// The first exempt triangle that is not there, or is there twice.
    pub(crate) fn wrong_triangle(&self, triangles: usize) -> Option<u32> {
        let mut seen = FxHashSet::default();
        self.exempt.iter().copied().find(|&t| t as usize >= triangles || !seen.insert(t))
    }
}

fn keyword<'a>(words: &mut impl Iterator<Item = &'a str>, expected: &str) -> Option<()> {
    words.next().filter(|word| *word == expected).map(drop)
}

fn bounds<'a>(words: &mut impl Iterator<Item = &'a str>) -> Option<AngleBounds> {
    let mut number = || words.next()?.parse().ok();
    AngleBounds::new(number()?, number()?).ok()
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
        for (line, text) in [
            (1, ""),
            (1, "angles 30 90 far 30 90 domain hull"),
            (1, "hexdel: angles 30 90"),
            (1, "hexdel: angles 90 30 far 30 90 domain hull"),
            (1, "hexdel: angles 30 90 far 30 90 domain moon"),
            (2, "hexdel: angles 30 90 far 30 90 domain hull\nhexdel: exempt x"),
            (2, "hexdel: angles 30 90 far 30 90 domain hull\nexempt 3"),
            (1, "hexdel: angles 30 90 far 30 90 domain hull exempt 3"),
            (2, "hexdel: angles 30 90 far 30 90 domain hull\nhexdel: exempt -1"),
            (2, "hexdel: angles 30 90 far 30 90 domain hull\nhexdel: exempted"),
            (3, "hexdel: angles 30 90 far 30 90 domain hull\nhexdel: exempt 3\nhexdel: exempt 4 3"),
            (2, "hexdel: angles 30 90 far 30 90 domain hull\nhexdel: angles 30 90 far 30 90 domain hull"),
        ] {
            assert_eq!(text.parse::<Promised>().map_err(|e| e.line), Err(line), "{text}");
        }
        assert_eq!(PromisedDomain::of_number(4.0), None);
    }
}
