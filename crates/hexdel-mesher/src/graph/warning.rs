//! What a PSLG says that a mesh makes no use of, or could be meant otherwise.

use hexdel_geom::{DVec2, Pslg, Region};
use hexdel_pslg::{Cover, Repair, RepairReport, StrayRing, UnusedSeed};

/// Something about a PSLG that its author should know of. The mesh is what was asked
/// for all the same.
///
/// Segments, holes, regions and polygons are counted as given.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Polygons of different attributes or largest areas cover the same part of the
    /// plane; the later one's are taken there.
    Overlap {
        /// Their indices.
        polygons: [u32; 2],
        /// Their attributes.
        attributes: [f64; 2],
        /// A point in the largest part.
        at: DVec2,
        /// The area of all parts, square input units.
        area: f64,
    },
    /// Borders of polygons cross or run along others, or lines, without common points, and
    /// were divided there; [`repairs`](crate::PslgTriangulation::repairs) has all places.
    DividedBorders {
        /// The first place.
        at: DVec2,
        /// How many places there are.
        places: usize,
    },
    /// A hole of a polygon lies in another one, or not in the polygon.
    StrayRing(StrayRing),
    /// A region lies in a polygon of another attribute or largest area, and its own are taken in
    /// the part of the polygon around it.
    RegionInPolygon {
        /// Index of the region.
        region: u32,
        /// Where it is.
        at: DVec2,
        /// Its attribute, and that of the polygon.
        attributes: [f64; 2],
    },
    /// A hole or region changes nothing.
    UnusedSeed(UnusedSeed),
}

impl Warning {
    /// Where it is.
    pub fn at(&self) -> DVec2 {
        match self {
            Self::Overlap { at, .. } | Self::DividedBorders { at, .. } | Self::RegionInPolygon { at, .. } => {
                *at
            }
            Self::StrayRing(ring) => ring.at,
            Self::UnusedSeed(seed) => seed.at,
        }
    }
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Overlap { polygons: [a, b], attributes, at, area } => {
                let [first, last] = attributes;
                write!(
                    f,
                    "polygons {a} (attribute {first}) and {b} (attribute {last}) overlap at ({}, {}), ",
                    at.x, at.y
                )?;
                write!(f, "area {area}: {last} applies there")
            }
            Self::DividedBorders { at, places } => {
                write!(f, "borders of polygons were divided at ({}, {})", at.x, at.y)?;
                match places - 1 {
                    0 => {}
                    1 => write!(f, " and 1 other place")?,
                    more => write!(f, " and {more} other places")?,
                }
                write!(f, ", where they cross or run along each other")
            }
            Self::StrayRing(StrayRing { polygon, ring, other, at }) => {
                write!(f, "ring {ring} of polygon {polygon} removes nothing at ({}, {}): ", at.x, at.y)?;
                match other {
                    Some(other) => write!(f, "it lies in ring {other}, which is already a hole"),
                    None => write!(f, "it lies outside the polygon"),
                }
            }
            Self::RegionInPolygon { region, at, attributes: [own, polygons] } => {
                write!(f, "region {region} at ({}, {}) lies in a polygon: ", at.x, at.y)?;
                if own == polygons {
                    write!(f, "its largest area applies there, not that of the polygon")
                } else {
                    write!(f, "its attribute {own} applies there, not {polygons}")
                }
            }
            Self::UnusedSeed(seed) => write!(f, "{seed}"),
        }
    }
}

/// Where borders were divided without being asked for.
pub(super) fn of_division(report: &RepairReport) -> Option<Warning> {
    let place = |done: &Repair| match *done {
        Repair::MergedSegments { ends, .. } => Some(ends[0]),
        Repair::DividedAtCrossing { at, .. } => Some(at),
        _ => None,
    };
    let mut places = report.repairs.iter().filter_map(place);
    let at = places.next()?;
    Some(Warning::DividedBorders { at, places: 1 + places.count() })
}

/// A region given that comes before that of a polygon.
pub(super) fn of_region(number: u32, given: &Region, of_polygon: &Region) -> Warning {
    let attributes = [given.attribute, of_polygon.attribute];
    Warning::RegionInPolygon { region: number, at: given.point, attributes }
}

/// The overlaps, which an option makes errors, and the stray rings.
pub(super) fn of_cover(cover: &Cover, given: &Pslg) -> Vec<Warning> {
    let overlaps = cover.overlaps.iter().map(|overlap| Warning::Overlap {
        polygons: overlap.polygons,
        attributes: overlap.polygons.map(|p| given.polygons[p as usize].attribute),
        at: overlap.at,
        area: overlap.area,
    });
    overlaps.chain(cover.stray.iter().copied().map(Warning::StrayRing)).collect()
}
