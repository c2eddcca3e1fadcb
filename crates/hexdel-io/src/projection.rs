//! Conformal projections of longitudes and latitudes, there and back, by the crate `proj4rs`.
//!
//! A mesh keeps its angles in a plane. Of projections those are taken that keep angles, so that small triangles
//! have the same angles on the ellipsoid. The Mercator projection is for the belt around the equator, Lambert's conformal conic for
//! middle latitudes, the polar stereographic one for the poles; their parameters are chosen by the points. Any other
//! conformal projection can be given by its definition, as PROJ has it.
//!
//! Longitudes of a place may differ by 360 degrees: those of results lie within 180 degrees of the
//! [centre](Projection::centre), unless the points were on both sides of 180 and -180 degrees.

use std::str::FromStr;

use hexdel_geom::{DVec2, Pslg};
use proj4rs::Proj;
use proj4rs::adaptors::transform_xy;
use thiserror::Error;

/// The names of conformal projections that the crate knows.
const CONFORMAL: [&str; 10] =
    ["merc", "tmerc", "etmerc", "utm", "stere", "ups", "sterea", "lcc", "omerc", "somerc"];

/// Those without a meridian at which the plane ends.
const WHOLE: [&str; 3] = ["stere", "ups", "sterea"];

/// PROJ's parameters of the ellipsoid and its place.
const SHAPE: [&str; 9] = ["ellps", "datum", "towgs84", "a", "b", "rf", "f", "es", "R"];

/// The projections that are chosen by points are of this ellipsoid.
const ELLIPSOID: &str = "+ellps=WGS84 +units=m +no_defs";

/// Its equatorial radius, metres, and squared eccentricity.
const WGS84: [f64; 2] = [6_378_137.0, 0.006_694_379_990_141_316];

/// Latitudes from which on a projection that goes to infinity at the pole is refused, degrees.
const NEAR_POLE_DEG: f64 = 89.0;

/// The middle latitude from which on cones are neither planes nor cylinders, degrees.
const CONE_DEG: f64 = 1.0;

/// Steps that parameters are rounded to, in a degree: a hundredth of a degree moves a parallel by a kilometre.
const PER_DEGREE: f64 = 100.0;

/// Which projection.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ProjectionKind {
    /// Mercator's, true to scale in the middle of the latitudes.
    Mercator,
    /// Stereographic, of the pole on whose side the points are, true to scale in the middle of the latitudes.
    PolarStereographic,
    /// Lambert's conformal conic one, true to scale at a sixth of the latitudes from both ends.
    Lambert,
    /// One with PROJ's parameters, such as `+proj=utm +zone=32 +ellps=GRS80`.
    Defined(String),
}

impl FromStr for ProjectionKind {
    type Err = String;

    /// `mercator`, `polar-stereographic`, `lambert` or a definition with `+proj=`.
    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "mercator" => Ok(Self::Mercator),
            "polar-stereographic" => Ok(Self::PolarStereographic),
            "lambert" => Ok(Self::Lambert),
            text if text.contains("+proj=") => Ok(Self::Defined(text.to_owned())),
            _ => Err("must be mercator, polar-stereographic, lambert or a definition such as \
                      '+proj=utm +zone=32 +ellps=GRS80'"
                .to_owned()),
        }
    }
}

/// Why points were not projected.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProjectionError {
    /// PROJ's parameters are none that the crate knows.
    #[error("{definition:?} is not a projection: {why}")]
    Definition {
        /// The parameters.
        definition: String,
        /// What is wrong with them.
        why: String,
    },
    /// A projection that changes angles.
    #[error(
        "the projection {name} does not keep angles, so that bounds of a mesh in its plane would mean nothing"
    )]
    NotConformal {
        /// Its name.
        name: String,
    },
    /// There are no points to choose parameters by.
    #[error("there are no points to project")]
    Empty,
    /// A coordinate is no longitude (-360 to 360 degrees) or latitude (-90 to 90 degrees).
    #[error("{item} {index} at ({}, {}) is not a longitude and latitude in degrees", at.x, at.y)]
    NotDegrees {
        /// "point", "hole" or "region".
        item: &'static str,
        /// Its index.
        index: usize,
        /// Its coordinates.
        at: DVec2,
    },
    /// A place that the projection takes to infinity, or far away.
    #[error("{item} {index} at ({}, {}) is outside of what the projection is for: {why}", at.x, at.y)]
    Outside {
        /// "point", "hole" or "region".
        item: &'static str,
        /// Its index.
        index: usize,
        /// Its longitude and latitude.
        at: DVec2,
        /// What the projection is for.
        why: &'static str,
    },
    /// The points are around the equator, where a cone has no tip.
    #[error("latitudes from {} to {} degrees lie on both sides of the equator alike, where Lambert's cone is a cylinder", latitudes[0], latitudes[1])]
    Equator {
        /// The lowest and the highest latitude.
        latitudes: [f64; 2],
    },
    /// A segment across the meridian at which the plane of the projection ends.
    #[error(
        "segment {segment} from ({}, {}) to ({}, {}) crosses the meridian of {meridian} degrees, where the plane of the \
         projection ends",
        ends[0].x, ends[0].y, ends[1].x, ends[1].y
    )]
    Cut {
        /// The segment.
        segment: usize,
        /// Its ends.
        ends: [DVec2; 2],
        /// The meridian, degrees.
        meridian: f64,
    },
}

/// A conformal projection.
///
/// # Examples
///
/// ```
/// use hexdel_geom::DVec2;
/// use hexdel_io::{Projection, ProjectionKind};
///
/// let [bergen, oslo] = [DVec2::new(5.32, 60.39), DVec2::new(10.75, 59.91)];
/// let projection = Projection::new(&ProjectionKind::Lambert, &[bergen, oslo])?;
/// let [a, b] = [bergen, oslo].map(|p| projection.to_plane(p).unwrap());
/// assert!((a.distance(b) - 306e3).abs() < 1e3);
/// assert!((projection.to_degrees(a) - bergen).abs().max_element() < 1e-9);
/// # Ok::<(), hexdel_io::ProjectionError>(())
/// ```
#[derive(Debug)]
pub struct Projection {
    definition: String,
    plane: Proj,
    degrees: Proj,
    centre: f64,
    /// Whether the plane ends at a meridian.
    is_cut: bool,
    /// Whether longitudes of results are from -180 to 180 degrees, whatever the centre.
    wraps: bool,
    limit: Limit,
}

/// What latitudes a projection is for.
#[derive(Clone, Copy, Debug)]
enum Limit {
    /// All that it has a place for.
    None,
    /// Between the poles.
    Poles,
    /// Those with this sign.
    Side(f64),
}

impl Projection {
    /// A projection, with parameters by the points: longitude and latitude in degrees.
    ///
    /// The parameters are hundredths of degrees.
    ///
    /// # Errors
    ///
    /// [`ProjectionError`], naming the first point at fault.
    pub fn new(kind: &ProjectionKind, points: &[DVec2]) -> Result<Self, ProjectionError> {
        if points.is_empty() {
            return Err(ProjectionError::Empty);
        }
        check_degrees("point", points)?;
        let latitudes =
            points.iter().fold([90.0, -90.0], |[low, high]: [f64; 2], p| [low.min(p.y), high.max(p.y)]);
        let [low, high] = latitudes;
        let (centre, middle) = (rounded(middle_longitude(points)), rounded(0.5 * (low + high)));
        let (shape, limit) = match kind {
            ProjectionKind::Mercator => {
                let truth = middle.abs().min(NEAR_POLE_DEG);
                (format!("+proj=merc +lat_ts={truth} +lon_0={centre}"), Limit::Poles)
            }
            ProjectionKind::PolarStereographic => {
                let pole: f64 = if middle < 0.0 { -90.0 } else { 90.0 };
                (
                    format!("+proj=stere +lat_0={pole} +lat_ts={middle} +lon_0={centre}"),
                    Limit::Side(pole.signum()),
                )
            }
            ProjectionKind::Lambert if middle.abs() < CONE_DEG => {
                return Err(ProjectionError::Equator { latitudes });
            }
            ProjectionKind::Lambert => {
                let sixth = (high - low) / 6.0;
                let [a, b] =
                    [low + sixth, high - sixth].map(|lat| rounded(lat.clamp(-NEAR_POLE_DEG, NEAR_POLE_DEG)));
                let parameters = format!("+proj=lcc +lat_1={a} +lat_2={b} +lat_0={middle} +lon_0={centre}");
                (parameters, Limit::None)
            }
            ProjectionKind::Defined(definition) => return Self::defined(definition, points),
        };
        Self::of(format!("{shape} {ELLIPSOID}"), centre, limit, points)
    }

    fn defined(definition: &str, points: &[DVec2]) -> Result<Self, ProjectionError> {
        let number = |name| value(definition, name).and_then(|text| text.parse::<f64>().ok());
        let zone = number("zone").map(|zone| 6.0 * zone - 183.0);
        let centre = number("lon_0").or(number("lonc")).or(zone).unwrap_or(0.0);
        Self::of(definition.trim().to_owned(), centre, Limit::None, points)
    }

    fn of(definition: String, centre: f64, limit: Limit, points: &[DVec2]) -> Result<Self, ProjectionError> {
        let name = value(&definition, "proj").unwrap_or_default().to_owned();
        let at_fault = |definition: &str, error: &proj4rs::errors::Error| ProjectionError::Definition {
            definition: definition.to_owned(),
            why: error.to_string(),
        };
        let plane = Proj::from_proj_string(&definition).map_err(|error| at_fault(&definition, &error))?;
        if !CONFORMAL.contains(&name.as_str()) {
            return Err(ProjectionError::NotConformal { name });
        }
        // Longitudes and latitudes are those of the projection's own ellipsoid: no datum is changed.
        let of_shape =
            |word: &&str| SHAPE.contains(&word.trim_start_matches('+').split('=').next().unwrap_or_default());
        let shape: Vec<&str> = definition.split_whitespace().filter(of_shape).collect();
        let of_degrees = format!("+proj=longlat {} +no_defs", shape.join(" "));
        let degrees = Proj::from_proj_string(&of_degrees).map_err(|error| at_fault(&of_degrees, &error))?;
        let wraps = points.iter().any(|p| (p.x - centre).abs() > 180.0);
        let is_cut = !WHOLE.contains(&name.as_str());
        Ok(Self { definition, plane, degrees, centre, is_cut, wraps, limit })
    }

    /// The parameters, as PROJ has them.
    pub fn definition(&self) -> &str {
        &self.definition
    }

    /// The longitude in the middle, degrees.
    pub fn centre(&self) -> f64 {
        self.centre
    }

    /// The place in the plane, metres, of a longitude and latitude in degrees; none of what the projection takes
    /// to infinity.
    pub fn to_plane(&self, at: DVec2) -> Option<DVec2> {
        // Exactly on the meridian at which the plane ends, rounding would decide on the side.
        let longitude = self.centre + around(at.x - self.centre);
        let (x, y) =
            transform_xy(&self.degrees, &self.plane, longitude.to_radians(), at.y.to_radians()).ok()?;
        Some(DVec2::new(x, y)).filter(|p| p.is_finite())
    }

    /// The longitude and latitude, degrees, of a place in the plane; not numbers where there is none.
    pub fn to_degrees(&self, at: DVec2) -> DVec2 {
        let Ok((x, y)) = transform_xy(&self.plane, &self.degrees, at.x, at.y) else { return DVec2::NAN };
        let longitude = x.to_degrees();
        let longitude =
            if self.wraps { around(longitude) } else { self.centre + around(longitude - self.centre) };
        DVec2::new(longitude, y.to_degrees())
    }

    /// How much longer lengths in the plane are than on the ellipsoid, which a conformal projection has in
    /// all directions alike; of WGS 84, within 1e-6.
    pub fn scale(&self, at: DVec2) -> Option<f64> {
        // A step to the north or south whose square is below the error asked for.
        let step = if at.y > 0.0 { -1e-4 } else { 1e-4 };
        let planar = self.to_plane(at)?.distance(self.to_plane(DVec2::new(at.x, at.y + step))?);
        let sine = libm::sin((at.y + 0.5 * step).to_radians());
        let [a, es] = WGS84;
        let meridian = a * (1.0 - es) / (1.0 - es * sine * sine).powf(1.5);
        Some(planar / (meridian * step.abs().to_radians()))
    }

    /// A PSLG with all its points, holes and regions in the plane, metres. Largest areas and attributes stay as
    /// they are.
    ///
    /// Segments are straight lines in the plane.
    ///
    /// # Errors
    ///
    /// [`ProjectionError`], naming the first item at fault.
    pub fn project(&self, pslg: &Pslg) -> Result<Pslg, ProjectionError> {
        let holes = self.all("hole", &pslg.holes)?;
        let seeds: Vec<DVec2> = pslg.regions.iter().map(|region| region.point).collect();
        let mut regions = pslg.regions.clone();
        for (region, point) in regions.iter_mut().zip(self.all("region", &seeds)?) {
            region.point = point;
        }
        let points = self.all("point", &pslg.points)?;
        for (segment, ends) in pslg.segments.iter().enumerate().filter(|_| self.is_cut) {
            let ends = ends.map(|point| pslg.points[point as usize]);
            let [from, to] = ends.map(|p| around(p.x - self.centre));
            if (from - to).abs() > 180.0 {
                return Err(ProjectionError::Cut { segment, ends, meridian: around(self.centre + 180.0) });
            }
        }
        Ok(Pslg { points, holes, regions, ..pslg.clone() })
    }

    fn all(&self, item: &'static str, places: &[DVec2]) -> Result<Vec<DVec2>, ProjectionError> {
        check_degrees(item, places)?;
        let project = |(index, &at): (usize, &DVec2)| {
            let outside = |why| ProjectionError::Outside { item, index, at, why };
            let why = match self.limit {
                Limit::Poles if at.y.abs() > NEAR_POLE_DEG => Some("latitudes from -89 to 89 degrees"),
                Limit::Side(pole) if at.y * pole < 0.0 => Some("one side of the equator"),
                _ => None,
            };
            why.map_or_else(
                || self.to_plane(at).ok_or(outside("where it is finite")),
                |why| Err(outside(why)),
            )
        };
        places.iter().enumerate().map(project).collect()
    }
}

fn check_degrees(item: &'static str, places: &[DVec2]) -> Result<(), ProjectionError> {
    let on_earth = |p: &DVec2| p.x.abs() <= 360.0 && p.y.abs() <= 90.0;
    match places.iter().position(|p| !on_earth(p)) {
        Some(index) => Err(ProjectionError::NotDegrees { item, index, at: places[index] }),
        None => Ok(()),
    }
}

/// The value of one of PROJ's parameters.
fn value<'a>(definition: &'a str, name: &str) -> Option<&'a str> {
    let parameter = |word: &'a str| word.trim_start_matches('+').strip_prefix(name)?.strip_prefix('=');
    definition.split_whitespace().find_map(parameter)
}

/// The same angle from -180 to 180 degrees; those that are so already stay bit for bit.
fn around(degrees: f64) -> f64 {
    if (-180.0..=180.0).contains(&degrees) { degrees } else { degrees - 360.0 * (degrees / 360.0).round() }
}

fn rounded(degrees: f64) -> f64 {
    // Not -0, which would be written so.
    (degrees * PER_DEGREE).round() / PER_DEGREE + 0.0
}

/// The middle of the shortest arc with all longitudes.
fn middle_longitude(points: &[DVec2]) -> f64 {
    let mut all: Vec<f64> = points.iter().map(|p| around(p.x)).collect();
    all.sort_by(f64::total_cmp);
    let (first, last) = (all[0], all[all.len() - 1]);
    let gaps = all.windows(2).map(|pair| (pair[1] - pair[0], pair[1]));
    // From each gap on the arc begins; the one around 180 degrees is as good as any.
    let (gap, start) =
        gaps.fold((first + 360.0 - last, first), |most, gap| if gap.0 > most.0 { gap } else { most });
    around(start + 0.5 * (360.0 - gap))
}

#[cfg(test)]
mod tests;
