//! The interval that every angle of a mesh is promised to lie in.

use thiserror::Error;

/// An interval of angles, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Interval"))]
pub struct AngleBounds {
    min_deg: f64,
    max_deg: f64,
}

/// What bounds are read as, before they are checked.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Interval {
    min_deg: f64,
    max_deg: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Interval> for AngleBounds {
    type Error = BoundsError;

    fn try_from(Interval { min_deg, max_deg }: Interval) -> Result<Self, BoundsError> {
        Self::new(min_deg, max_deg)
    }
}

/// Why two numbers are no angle bounds.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BoundsError {
    /// One of the angles is not a number between 0 and 180, or the pair leaves
    /// no triangle: a triangle's smallest angle is at most 60, its largest at
    /// least 60.
    #[error("no triangle has all angles between {min_deg} and {max_deg} degrees")]
    Infeasible {
        /// The lower bound given, degrees.
        min_deg: f64,
        /// The upper bound given, degrees.
        max_deg: f64,
    },
}

impl AngleBounds {
    /// What the relocated dual keeps: 43.8978 to 90 degrees.
    ///
    /// The templates keep `atan(5 / (3 sqrt 3))` = 43.89788.. (paper, sections
    /// 5.4 and 6.1). The bound is rounded down after four decimals, so that a
    /// vertex may be rounded by a millionth of an edge before an angle is past it.
    pub const EXTENDED: Self = Self { min_deg: 43.8978, max_deg: 90.0 };

    /// The smallest angle of the templates, `atan(5 / (3 sqrt 3))`, in degrees, to the nearest
    /// `f64`.
    pub const EXACT_MIN_DEG: f64 = 43.897_886_248_013_98;

    /// What the plain dual keeps: 30 to 120 degrees (paper, section 4.3).
    pub const SIMPLE: Self = Self { min_deg: 30.0, max_deg: 120.0 };

    /// Bounds of `min_deg` to `max_deg` degrees.
    ///
    /// # Errors
    ///
    /// [`BoundsError::Infeasible`] unless `0 <= min_deg <= 60 <= max_deg <= 180`.
    pub fn new(min_deg: f64, max_deg: f64) -> Result<Self, BoundsError> {
        if (0.0..=60.0).contains(&min_deg) && (60.0..=180.0).contains(&max_deg) {
            Ok(Self { min_deg, max_deg })
        } else {
            Err(BoundsError::Infeasible { min_deg, max_deg })
        }
    }

    /// Above this smallest angle, 360 / 7 degrees, no inner vertex has room for seven
    /// triangles.
    pub const MOST_GRADED_MIN_DEG: f64 = 360.0 / 7.0;

    /// Below this largest angle no inner vertex is surrounded by five triangles.
    pub const LEAST_GRADED_MAX_DEG: f64 = 72.0;

    /// Whether a mesh within the bounds can be finer in one place than in another.
    ///
    /// The sum of `6 - d` over inner vertices, of `3 - t` over those on the boundary, of degree `d` and
    /// with `t` triangles, is 6 for every disk. Where no vertex has seven triangles,
    /// or none five, all terms have one sign, and in a hexagon
    /// they are all 0 but for the six corners: the mesh is one piece of the regular lattice,
    /// bent a little.
    ///
    /// ```
    /// use hexdel_geom::AngleBounds;
    /// assert!(AngleBounds::new(51.0, 90.0)?.allow_grading());
    /// assert!(!AngleBounds::new(52.0, 90.0)?.allow_grading());
    /// assert!(!AngleBounds::new(40.0, 71.0)?.allow_grading());
    /// # Ok::<(), hexdel_geom::BoundsError>(())
    /// ```
    pub fn allow_grading(self) -> bool {
        self.min_deg <= Self::MOST_GRADED_MIN_DEG && self.max_deg >= Self::LEAST_GRADED_MAX_DEG
    }

    /// The smallest angle allowed, degrees.
    pub const fn min_deg(self) -> f64 {
        self.min_deg
    }

    /// The largest angle allowed, degrees.
    pub const fn max_deg(self) -> f64 {
        self.max_deg
    }

    /// The largest circumradius over twice the inradius of a triangle within the bounds;
    /// infinite if the smallest angle is 0. 1.20787 for [`EXTENDED`](Self::EXTENDED) (paper,
    /// section 6.2, where the ratio is inverted).
    ///
    /// The ratio is `1 / (8 sin(A/2) sin(B/2) sin(C/2))`. The logarithm of the sine is
    /// concave, so the product is least at a corner of the set of angles allowed, where at
    /// least two of the three are at a bound.
    ///
    /// ```
    /// use hexdel_geom::AngleBounds;
    /// assert!((AngleBounds::EXTENDED.max_aspect_ratio() - 1.20787).abs() < 1e-5);
    /// assert!((AngleBounds::SIMPLE.max_aspect_ratio() - 2.15470).abs() < 1e-5);
    /// ```
    pub fn max_aspect_ratio(self) -> f64 {
        let Self { min_deg: low, max_deg: high } = self;
        let thirds = [[low, low], [low, high], [high, high]].map(|[a, b]| [a, b, 180.0 - a - b]);
        let allowed = thirds.into_iter().filter(|[_, _, c]| (low..=high).contains(c));
        allowed.map(aspect_ratio_of_angles).fold(1.0, f64::max)
    }

    /// A lower bound alone.
    pub(crate) const fn at_least(min_deg: f64) -> Self {
        Self { min_deg, max_deg: 180.0 }
    }

    /// Bounds wider by an angle at both ends, as far as there are angles.
    pub(crate) fn widened(self, by_deg: f64) -> Self {
        Self { min_deg: (self.min_deg - by_deg).max(0.0), max_deg: (self.max_deg + by_deg).min(180.0) }
    }
}

/// Circumradius over twice the inradius of a triangle with these angles, degrees.
fn aspect_ratio_of_angles(angles_deg: [f64; 3]) -> f64 {
    let [a, b, c] = angles_deg.map(|angle| libm::sin((0.5 * angle).to_radians()));
    // Rounding may take an angle of 0 below it.
    (0.125 / (a * b * c).max(0.0)).max(1.0)
}

impl Default for AngleBounds {
    fn default() -> Self {
        Self::EXTENDED
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_aspect_ratio_is_that_of_the_worst_triangle_allowed() {
        for (low, high) in
            [(43.8978, 90.0), (30.0, 120.0), (30.0, 90.0), (48.0, 84.0), (20.0, 70.0), (60.0, 60.0)]
        {
            let bound = AngleBounds::new(low, high).unwrap().max_aspect_ratio();
            let mut largest = 0.0_f64;
            // Every tenth of a degree, and the ends.
            let angles = || (0..=1800).map(|i| 0.1 * f64::from(i)).chain([low, high]);
            for (a, b) in angles().flat_map(|a| angles().map(move |b| (a, b))) {
                let all = [a, b, 180.0 - a - b];
                if all.iter().all(|x| (low - 1e-9..=high + 1e-9).contains(x)) {
                    largest = largest.max(aspect_ratio_of_angles(all));
                }
            }
            assert!((bound - largest).abs() < 1e-8, "{low} {high}: {bound} {largest}");
        }
        assert_eq!(AngleBounds::new(0.0, 90.0).unwrap().max_aspect_ratio(), f64::INFINITY);
        let exact = (5.0 / 27_f64.sqrt()).atan().to_degrees();
        assert!((exact - AngleBounds::EXACT_MIN_DEG).abs() < 1e-13);
    }

    #[cfg(feature = "serde")]
    #[test]
    fn what_is_read_is_checked() {
        let read = |min: f64, max: f64| {
            let text = format!(r#"{{"min_deg": {min}, "max_deg": {max}}}"#);
            serde_json::from_str::<AngleBounds>(&text).ok()
        };
        assert_eq!(read(30.0, 90.0), AngleBounds::new(30.0, 90.0).ok());
        for (min, max) in [(-1.0, 90.0), (61.0, 90.0), (30.0, 59.0), (30.0, 1e300)] {
            assert_eq!(read(min, max), None, "{min} {max}");
        }
    }
}
