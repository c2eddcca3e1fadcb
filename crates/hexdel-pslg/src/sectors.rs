//! Corners of the input that are narrower than the bound.

use crate::fans::{Fan, LEAST_DEG, NARROW_DEG, Scene};
use crate::fit::judge::Wedges;
use crate::geometry::distance_sq;
use crate::validate::{Piece, Validated};
use hexdel_geom::{DVec2, quality};
use std::f64::consts::TAU;

/// A corner between two neighbouring pieces at a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sector {
    pub(crate) site: u32,
    /// The pieces on both sides.
    pub(crate) pieces: [u32; 2],
    /// Less than the bound.
    pub(crate) angle_deg: f64,
    /// The bisector, as long as the longer side.
    bisector: DVec2,
    /// Whether there is a fan around the site.
    fanned: bool,
}

impl Sector {
    /// Whether no mesh could keep bounds around it, for want of a fan.
    pub(crate) fn is_hopeless(&self) -> bool {
        self.angle_deg < NARROW_DEG && !self.fanned
    }
}

/// Pairs of segments, given by their ends, that meet at so small an angle that no
/// mesh could keep bounds between them. No two may cross.
pub fn hopeless_pairs(segments: &[[DVec2; 2]]) -> Vec<[usize; 2]> {
    let order = |a: &DVec2, b: &DVec2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
    let mut sites: Vec<DVec2> = segments.iter().flatten().copied().collect();
    sites.sort_by(order);
    sites.dedup();
    let site = |p: &DVec2| sites.partition_point(|q| order(q, p).is_lt()) as u32;
    let piece =
        |(ends, segment): (&[DVec2; 2], u32)| Piece { ends: [site(&ends[0]), site(&ends[1])], segment };
    let pieces: Vec<Piece> = segments.iter().zip(0..).map(piece).collect();
    let sectors = narrow_sectors(&sites, &pieces, &[], NARROW_DEG);
    wedge_pairs(&sectors).into_iter().map(|pair| pair.map(|p| p as usize)).collect()
}

/// A corner of a graph between two segments that meet at less than a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NarrowCorner {
    /// The point where they meet.
    pub point: u32,
    /// The next points on them, clockwise and counter-clockwise.
    pub ends: [u32; 2],
    /// The angle between them, degrees.
    pub angle_deg: f64,
    /// Whether it is so narrow that no lower bound is kept between the two. In
    /// others it is only in triangles that have a corner at the point.
    pub given_up: bool,
}

/// The corners of a graph narrower than `least_deg`, by point: where
/// [`mesh`](crate::mesh) may go below that lower bound.
///
/// ```
/// use hexdel_geom::{DVec2, Pslg};
///
/// let mut graph = Pslg::from_points(vec![DVec2::X, DVec2::ZERO, DVec2::new(1.0, 0.2), DVec2::Y]);
/// graph.segments = vec![[0, 1], [1, 2], [1, 3]];
/// let corners = hexdel_pslg::narrow_corners(&hexdel_pslg::validate(&graph)?, 30.0);
/// assert_eq!((corners[0].point, corners[0].ends, corners.len()), (1, [0, 2], 1));
/// # Ok::<(), hexdel_pslg::ValidateError>(())
/// ```
pub fn narrow_corners(input: &Validated, least_deg: f64) -> Vec<NarrowCorner> {
    let scene = Scene::plain(input, input.pieces.clone());
    let corner = |s: &Sector| {
        let end = |p: u32| {
            let [a, b] = scene.pieces[p as usize].ends;
            scene.input_of_site[(if a == s.site { b } else { a }) as usize]
        };
        NarrowCorner {
            point: scene.input_of_site[s.site as usize],
            ends: s.pieces.map(end),
            angle_deg: s.angle_deg,
            given_up: s.angle_deg < LEAST_DEG,
        }
    };
    narrow_sectors(&scene.sites, &scene.pieces, &scene.fans, least_deg).iter().map(corner).collect()
}

/// The pieces on both sides of each sector that is given up.
pub(crate) fn wedge_pairs(sectors: &[Sector]) -> Vec<[u32; 2]> {
    sectors.iter().filter(|s| s.is_hopeless()).map(|s| s.pieces).collect()
}

/// The sectors that are given up.
pub(crate) fn wedges(sectors: &[Sector], pieces: &[Piece]) -> Wedges {
    Wedges::of(&wedge_pairs(sectors), pieces.iter().map(|p| p.ends).collect())
}

/// All sectors narrower than `least_deg`.
pub(crate) fn narrow_sectors(sites: &[DVec2], pieces: &[Piece], fans: &[Fan], least_deg: f64) -> Vec<Sector> {
    let mut rays: Vec<(u32, f64, u32)> = pieces
        .iter()
        .zip(0..)
        .flat_map(|(piece, i)| {
            let [a, b] = piece.ends;
            let ray = |from: u32, to: u32| {
                let u = sites[to as usize] - sites[from as usize];
                (from, direction(u), i)
            };
            [ray(a, b), ray(b, a)]
        })
        .collect();
    rays.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let mut sectors = Vec::new();
    for group in rays.chunk_by(|a, b| a.0 == b.0) {
        if group.len() < 2 {
            continue;
        }
        for (i, ray) in group.iter().enumerate() {
            let next = group[(i + 1) % group.len()];
            let angle_deg = (next.1 - ray.1).rem_euclid(TAU).to_degrees();
            if angle_deg < least_deg {
                sectors.push(Sector {
                    site: ray.0,
                    pieces: [ray.2, next.2],
                    angle_deg,
                    fanned: fans.iter().any(|fan| fan.site == ray.0),
                    bisector: bisector(sites, pieces, ray.0, [ray.2, next.2]),
                });
            }
        }
    }
    sectors
}

fn bisector(sites: &[DVec2], pieces: &[Piece], site: u32, sides: [u32; 2]) -> DVec2 {
    let sides = sides.map(|p| {
        let [a, b] = pieces[p as usize].ends;
        sites[(if a == site { b } else { a }) as usize] - sites[site as usize]
    });
    let direction = sides[0].normalize_or_zero() + sides[1].normalize_or_zero();
    direction.normalize_or_zero() * sides[0].length().max(sides[1].length())
}

/// The direction of a vector, by the portable arc tangent of the angles.
pub(crate) fn direction(u: DVec2) -> f64 {
    quality::angles_rad([DVec2::ZERO, DVec2::X * u.length(), u])[0]
}

/// Edges around a narrow sector on which its fault may spread: those that meet
/// it and two more rings, in which sizes find back to the mesh's own.
const SPREAD: f64 = 3.0;

/// The sector that may be blamed for a triangle's angles, and how far away its
/// corner is.
///
/// At a distance `r` from the corner the sector is `r sin(angle)` wide; where
/// that is less than an edge nothing between its sides has good angles.
pub(crate) fn sector_near(
    [a, b, c]: [DVec2; 3],
    sectors: &[Sector],
    sites: &[DVec2],
) -> Option<(Sector, f64)> {
    let centre = (a + b + c) / 3.0;
    let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
    let blamed = |s: &Sector| {
        let corner = sites[s.site as usize];
        let narrow = longest / s.angle_deg.to_radians().sin();
        let end = corner + s.bisector * (narrow / s.bisector.length()).min(1.0);
        distance_sq(centre, corner, end) <= (SPREAD * longest).powi(2)
    };
    sectors
        .iter()
        .filter(|s| blamed(s))
        .map(|s| (*s, sites[s.site as usize].distance(centre)))
        .min_by(|x, y| x.1.total_cmp(&y.1))
}
