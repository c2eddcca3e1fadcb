//! How long edges may be: a constant, regions, points, a raster, a function.
//!
//! The parts of a [`Size`] are combined by their minimum. Away from a region or
//! a point the size grows with the distance, by the gradation, so that the mesh
//! gets coarser no faster than that.

mod cones;
mod raster;
mod waves;

use crate::error::Error;
use cones::Cones;
use hexdel_geom::{DVec2, Raster};
use hexdel_optimize::Sizing;
use raster::Field;
use std::fmt;
use std::sync::Arc;
use thiserror::Error as ThisError;

pub use waves::{GRAVITY, PER_WAVELENGTH, TIDE, WaveRule};

/// Why something is no size.
#[derive(Clone, Debug, PartialEq, ThisError)]
#[non_exhaustive]
pub enum SizeError {
    /// A length is not positive.
    #[error("the size of {what} must be positive, got {size:?}")]
    NotPositive {
        /// What has it.
        what: String,
        /// The length.
        size: f64,
    },
    /// A length is below what coordinates resolve in the domain.
    #[error("the size {size:e} is below {least:e}, the smallest that coordinates resolve there")]
    BelowResolution {
        /// The length.
        size: f64,
        /// The smallest one that would do.
        least: f64,
    },
    /// A number of a rule by depths is not positive.
    #[error("{what} must be positive and finite, got {found:?}")]
    Rule {
        /// Which number.
        what: &'static str,
        /// Its value.
        found: f64,
    },
    /// The longest edge is shorter than the shortest.
    #[error("the longest edge must be at least the shortest, {min:?}, got {max:?}")]
    Range {
        /// The shortest.
        min: f64,
        /// The longest.
        max: f64,
    },
    /// A gradation is not positive.
    #[error("the gradation must be positive and finite, got {gradation:?}")]
    Gradation {
        /// The gradation given.
        gradation: f64,
    },
    /// A region has a corner that is not finite, or fewer than three corners.
    #[error("a region needs three or more corners, all of them finite, got {corners} corners")]
    Region {
        /// Its corners.
        corners: usize,
    },
    /// A raster has no value at all, or one that is not positive.
    #[error("the raster has {found:?} in row {row} and column {column}, counted from the south-west")]
    RasterValue {
        /// The row, from 0.
        row: usize,
        /// The column, from 0.
        column: usize,
        /// The value, not a number if the raster is empty.
        found: f64,
    },
    /// The mesh would have more triangles than can be handled.
    #[error("edges this short would take about {triangles:.1e} triangles")]
    TooMany {
        /// How many.
        triangles: f64,
    },
    /// More levels of hexagons would be needed than there can be.
    #[error("edges this short would take more than {levels} levels of hexagons")]
    TooFine {
        /// How many there can be.
        levels: u8,
    },
    /// Edges are longer than wanted and cannot be made shorter within the
    /// bounds.
    #[error("edges at ({:?}, {:?}) cannot be made shorter than {length:e}", at.x, at.y)]
    Unreached {
        /// The middle of such an edge.
        at: DVec2,
        /// Its length.
        length: f64,
    },
}

/// How much the size may grow per unit of distance, unless said otherwise:
/// edges double over the length of four.
pub const GRADATION: f64 = 0.5;

/// The largest edge length wanted at each point.
///
/// ```
/// use hexdel::{DVec2, Mesher, Size};
///
/// let size = Size::constant(0.5)?.and_box(DVec2::ZERO, DVec2::splat(0.2), 0.05)?;
/// let made = Mesher::new().size(size).triangulate(&[DVec2::ZERO, DVec2::X])?;
/// assert!(made.size_ratio.is_some_and(|ratio| ratio <= 1.0 + 1e-9));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Size {
    gradation: f64,
    parts: Vec<Part>,
}

#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
enum Part {
    Constant(f64),
    /// A simple polygon, in either direction, its size and the gradation.
    Polygon(Vec<DVec2>, f64, f64),
    Points(Cones),
    Raster(Field),
    #[cfg_attr(feature = "serde", serde(skip))]
    Function(Function),
}

/// A function of the caller's.
#[derive(Clone)]
struct Function(Arc<dyn Fn(DVec2) -> f64 + Send + Sync>);

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Function")
    }
}

impl PartialEq for Function {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

fn positive(what: &str, size: f64) -> Result<f64, SizeError> {
    if size > 0.0 && size.is_finite() {
        Ok(size)
    } else {
        Err(SizeError::NotPositive { what: what.to_owned(), size })
    }
}

impl Size {
    /// No limit yet, to add parts to.
    pub fn unlimited() -> Self {
        Self { gradation: GRADATION, parts: Vec::new() }
    }

    /// The same length everywhere.
    ///
    /// # Errors
    ///
    /// [`SizeError::NotPositive`].
    pub fn constant(size: f64) -> Result<Self, SizeError> {
        Self::unlimited().and_constant(size)
    }

    /// Triangles no larger than `area`: edges no longer than those of the
    /// equilateral triangle of that area, which is the largest with such edges.
    ///
    /// # Errors
    ///
    /// [`SizeError::NotPositive`].
    pub fn area(area: f64) -> Result<Self, SizeError> {
        let area = positive("a triangle", area)?;
        Self::constant((4.0 * area / 3_f64.sqrt()).sqrt())
    }

    /// A length wanted by a function. Its values should be positive and change
    /// no faster than the distance; the gradation does not apply to it, and it
    /// cannot be saved.
    #[must_use]
    pub fn function(f: impl Fn(DVec2) -> f64 + Send + Sync + 'static) -> Self {
        Self::unlimited().with(Part::Function(Function(Arc::new(f))))
    }

    /// The same with another gradation, for all parts added from now on.
    ///
    /// # Errors
    ///
    /// [`SizeError::Gradation`] unless it is positive.
    pub fn with_gradation(mut self, gradation: f64) -> Result<Self, SizeError> {
        if !(gradation > 0.0 && gradation.is_finite()) {
            return Err(SizeError::Gradation { gradation });
        }
        self.gradation = gradation;
        Ok(self)
    }

    /// Nowhere more than `size`.
    ///
    /// # Errors
    ///
    /// [`SizeError::NotPositive`].
    pub fn and_constant(self, size: f64) -> Result<Self, SizeError> {
        let size = positive("the mesh", size)?;
        Ok(self.with(Part::Constant(size)))
    }

    /// No more than `size` in an axis-parallel box between two opposite corners.
    ///
    /// # Errors
    ///
    /// [`SizeError::NotPositive`], [`SizeError::Region`].
    pub fn and_box(self, a: DVec2, b: DVec2, size: f64) -> Result<Self, SizeError> {
        let (low, high) = (a.min(b), a.max(b));
        self.and_polygon(vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)], size)
    }

    /// No more than `size` in a simple polygon.
    ///
    /// # Errors
    ///
    /// [`SizeError::NotPositive`], [`SizeError::Region`].
    pub fn and_polygon(self, corners: Vec<DVec2>, size: f64) -> Result<Self, SizeError> {
        let size = positive("a region", size)?;
        if corners.len() < 3 || !corners.iter().all(|p| p.is_finite()) {
            return Err(SizeError::Region { corners: corners.len() });
        }
        let slope = self.gradation;
        Ok(self.with(Part::Polygon(corners, size, slope)))
    }

    /// No more than the length given at each point; between them the largest
    /// lengths that grow by no more than the gradation.
    ///
    /// # Errors
    ///
    /// [`SizeError::NotPositive`], also for points that are not finite.
    pub fn and_points(self, points: &[(DVec2, f64)]) -> Result<Self, SizeError> {
        for (i, &(at, size)) in points.iter().enumerate() {
            positive(&format!("point {i}"), if at.is_finite() { size } else { f64::NAN })?;
        }
        let cones = Cones::new(points.to_vec(), self.gradation);
        Ok(self.with(Part::Points(cones)))
    }

    /// No more than a raster says, interpolated between the centres of its
    /// cells, smoothed to the gradation.
    ///
    /// # Errors
    ///
    /// [`SizeError::RasterValue`].
    pub fn and_raster(self, raster: &Raster) -> Result<Self, SizeError> {
        let field = Field::new(raster, self.gradation)?;
        Ok(self.with(Part::Raster(field)))
    }

    /// No more than either of two.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.parts.extend(other.parts);
        self
    }

    fn with(mut self, part: Part) -> Self {
        self.parts.push(part);
        self
    }

    /// Whether this can be written to a file: functions cannot.
    pub fn can_be_saved(&self) -> bool {
        !self.parts.iter().any(|p| matches!(p, Part::Function(_)))
    }

    /// The smallest length of the parts whose lengths are known.
    fn least(&self) -> f64 {
        let least = |part: &Part| match part {
            Part::Constant(size) | Part::Polygon(_, size, _) => *size,
            Part::Points(cones) => cones.least(),
            Part::Raster(field) => field.least(),
            Part::Function(_) => f64::INFINITY,
        };
        self.parts.iter().map(least).fold(f64::INFINITY, f64::min)
    }

    /// Refuses lengths below what coordinates resolve.
    ///
    /// # Errors
    ///
    /// [`SizeError::BelowResolution`].
    #[doc(hidden)]
    pub fn check(&self, least: f64) -> Result<(), SizeError> {
        let size = self.least();
        if size < least { Err(SizeError::BelowResolution { size, least }) } else { Ok(()) }
    }

    /// A size from data that were read, if they make one.
    ///
    /// # Errors
    ///
    /// [`SizeError`].
    #[doc(hidden)]
    pub fn checked(self) -> Result<Self, SizeError> {
        let mut size = Self::unlimited().with_gradation(self.gradation)?;
        for part in self.parts {
            size = match part {
                Part::Constant(length) => size.and_constant(length)?,
                Part::Polygon(corners, length, slope) => {
                    let sloped = Self::unlimited().with_gradation(slope)?;
                    size.and(sloped.and_polygon(corners, length)?)
                }
                Part::Points(cones) => {
                    cones.check()?;
                    size.with(Part::Points(cones.rebuilt()))
                }
                Part::Raster(field) => {
                    field.check()?;
                    size.with(Part::Raster(field))
                }
                Part::Function(f) => size.with(Part::Function(f)),
            };
        }
        Ok(size)
    }
}

impl Sizing for Size {
    fn at(&self, p: DVec2) -> f64 {
        let of = |part: &Part| match part {
            Part::Constant(size) => *size,
            Part::Polygon(corners, size, slope) => size + slope * distance(corners, p),
            Part::Points(cones) => cones.at(p),
            Part::Raster(field) => field.at(p),
            // A number that is none is as bad as none at all.
            Part::Function(f) => Some((f.0)(p)).filter(|h| !h.is_nan()).unwrap_or(0.0),
        };
        self.parts.iter().map(of).fold(f64::INFINITY, f64::min)
    }
}

/// Distance from a simple polygon, 0 inside.
fn distance(corners: &[DVec2], p: DVec2) -> f64 {
    let mut inside = false;
    let mut least = f64::INFINITY;
    for (i, &a) in corners.iter().enumerate() {
        let b = corners[(i + 1) % corners.len()];
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
        let along = ((p - a).dot(b - a) / (b - a).length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        least = least.min(p.distance_squared(a + along * (b - a)));
    }
    if inside { 0.0 } else { least.sqrt() }
}

impl From<SizeError> for Error {
    fn from(error: SizeError) -> Self {
        Self::Size(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_grow_with_the_distance() {
        let size = Size::constant(3.0).unwrap().and_box(DVec2::ONE, DVec2::ZERO, 1.0).unwrap();
        for (x, wanted) in [(0.5, 1.0), (1.0, 1.0), (2.0, 1.5), (3.0, 2.0), (9.0, 3.0), (-2.0, 2.0)] {
            assert_eq!(size.at(DVec2::new(x, 0.5)), wanted, "at {x}");
        }
    }

    #[test]
    fn what_is_no_size_is_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Size::constant(bad), Err(SizeError::NotPositive { .. })));
            assert!(matches!(Size::unlimited().with_gradation(bad), Err(SizeError::Gradation { .. })));
            let points = Size::unlimited().and_points(&[(DVec2::ZERO, 1.0), (DVec2::X, bad)]);
            assert!(matches!(points, Err(SizeError::NotPositive { what, .. }) if what == "point 1"));
        }
        let line = Size::unlimited().and_polygon(vec![DVec2::ZERO, DVec2::X], 1.0);
        assert_eq!(line, Err(SizeError::Region { corners: 2 }));
        let far = Size::constant(1e-12).unwrap();
        assert!(matches!(far.check(1e-10), Err(SizeError::BelowResolution { .. })));
    }

    #[test]
    fn distances_from_a_polygon_that_is_not_convex() {
        let l = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)].map(DVec2::from);
        assert_eq!(distance(&l, DVec2::new(0.5, 1.5)), 0.0);
        assert_eq!(distance(&l, DVec2::new(1.5, 1.5)), 0.5);
        assert_eq!(distance(&l, DVec2::new(5.0, -4.0)), 5.0);
    }
}
