//! Corners of the input that are narrower than the bound.

use crate::carve::Carving;
use crate::fans::{Fan, LEAST_DEG, NARROW_DEG, Scene};
use crate::geometry::distance_sq;
use crate::hull::with_hull;
use crate::judge::Wedges;
use crate::options::Extent;
use crate::validate::{Piece, Validated, spatial_order};
use hexdel_geom::{DVec2, quality};
use rustc_hash::FxHashSet;
use std::f64::consts::TAU;
use std::ops::Range;

/// A corner between two neighbouring pieces at a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sector {
    pub(crate) site: u32,
    /// The pieces on both sides.
    pub(crate) pieces: [u32; 2],
    /// Less than the bound.
    pub(crate) angle_deg: f64,
    /// The sine of the angle.
    sine: f64,
    /// Where the site is.
    corner: DVec2,
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

    /// Whether its fault may have spread to a triangle with such a centroid and
    /// longest edge.
    fn may_be_blamed(&self, centre: DVec2, longest: f64) -> bool {
        let narrow = longest / self.sine;
        let end = self.corner + self.bisector * (narrow / self.bisector.length()).min(1.0);
        distance_sq(centre, self.corner, end) <= (SPREAD * longest).powi(2)
    }
}

/// The corners of the input that are narrower than the bound, to be found by
/// place.
pub(crate) struct Sectors {
    all: Vec<Sector>,
    /// Indices of sectors, neighbours together.
    order: Vec<u32>,
    /// The boxes around corners and bisectors in a binary tree over `order`: the
    /// root first, the halves of node `i` at `2 i + 1` and `2 i + 2`.
    boxes: Vec<[DVec2; 2]>,
}

const EMPTY: [DVec2; 2] = [DVec2::INFINITY, DVec2::NEG_INFINITY];

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
    let sectors = Sectors::of(&sites, &pieces, &[], NARROW_DEG, None);
    sectors.wedge_pairs().into_iter().map(|pair| pair.map(|p| p as usize)).collect()
}

/// A corner of a PSLG between two segments that meet at less than a bound.
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

/// The corners of a PSLG narrower than `least_deg`, by point: where
/// [`mesh`](crate::mesh) may go below that lower bound. Corners in holes, and outside of
/// the extent, are none; those of the hull are some, if that is the extent.
///
/// ```
/// use hexdel_geom::{DVec2, Pslg};
///
/// let mut graph = Pslg::from_points(vec![DVec2::X, DVec2::ZERO, DVec2::new(1.0, 0.2), DVec2::Y]);
/// graph.segments = vec![[0, 1], [1, 2], [1, 3]];
/// let graph = hexdel_pslg::validate(&graph)?;
/// let corners = hexdel_pslg::narrow_corners(&graph, hexdel_pslg::Extent::Hexagon, 30.0);
/// assert_eq!((corners[0].point, corners[0].ends, corners.len()), (1, [0, 2], 1));
/// # Ok::<(), hexdel_pslg::ValidateError>(())
/// ```
pub fn narrow_corners(input: &Validated, extent: Extent, least_deg: f64) -> Vec<NarrowCorner> {
    let pieces = if extent == Extent::Hull { with_hull(input) } else { input.pieces.clone() };
    let scene = Scene::plain(input, pieces);
    let carving = Carving::of(input, extent);
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
    narrow_sectors(&scene.sites, &scene.pieces, &scene.fans, least_deg, carving.as_ref())
        .iter()
        .map(corner)
        .collect()
}

/// All sectors narrower than `least_deg` that are not carved away.
fn narrow_sectors(
    sites: &[DVec2],
    pieces: &[Piece],
    fans: &[Fan],
    least_deg: f64,
    carving: Option<&Carving<'_>>,
) -> Vec<Sector> {
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
    let fanned: FxHashSet<u32> = fans.iter().map(|fan| fan.site).collect();
    let mut sectors = Vec::new();
    for group in rays.chunk_by(|a, b| a.0 == b.0) {
        if group.len() < 2 {
            continue;
        }
        for (i, ray) in group.iter().enumerate() {
            let next = group[(i + 1) % group.len()];
            let angle = (next.1 - ray.1).rem_euclid(TAU);
            let is_carved = || carving.is_some_and(|c| c.is_carved_at(ray.0, ray.1 + 0.5 * angle));
            let angle_deg = angle.to_degrees();
            if angle_deg < least_deg && !is_carved() {
                let fanned = fanned.contains(&ray.0);
                sectors.push(Sector { fanned, ..sector(sites, pieces, (ray.0, [ray.2, next.2]), angle_deg) });
            }
        }
    }
    sectors
}

fn sector(sites: &[DVec2], all: &[Piece], (site, pieces): (u32, [u32; 2]), angle_deg: f64) -> Sector {
    let corner = sites[site as usize];
    let sides = pieces.map(|p| {
        let [a, b] = all[p as usize].ends;
        sites[(if a == site { b } else { a }) as usize] - corner
    });
    let units = sides.map(DVec2::normalize_or_zero);
    let longer = sides[0].length().max(sides[1].length());
    Sector {
        site,
        pieces,
        angle_deg,
        sine: units[0].perp_dot(units[1]),
        corner,
        bisector: (units[0] + units[1]).normalize_or_zero() * longer,
        fanned: false,
    }
}

/// The direction of a vector, by the portable arc tangent of the angles.
pub(crate) fn direction(u: DVec2) -> f64 {
    quality::angles_rad([DVec2::ZERO, DVec2::X * u.length(), u])[0]
}

/// Edges around a narrow sector on which its fault may spread: those that meet
/// it and two more rings, in which sizes find back to the mesh's own.
const SPREAD: f64 = 3.0;

impl Sectors {
    /// All sectors narrower than `least_deg` that are not carved away.
    pub(crate) fn of(
        sites: &[DVec2],
        pieces: &[Piece],
        fans: &[Fan],
        least_deg: f64,
        carving: Option<&Carving<'_>>,
    ) -> Self {
        let all = narrow_sectors(sites, pieces, fans, least_deg, carving);
        let order = spatial_order(&all.iter().map(|s| s.corner).collect::<Vec<_>>());
        let mut sectors = Self { boxes: vec![EMPTY; 2 * all.len().next_power_of_two()], all, order };
        if !sectors.all.is_empty() {
            sectors.enclose(0, 0..sectors.all.len());
        }
        sectors
    }

    /// The pieces on both sides of each sector that is given up.
    pub(crate) fn wedge_pairs(&self) -> Vec<[u32; 2]> {
        self.all.iter().filter(|s| s.is_hopeless()).map(|s| s.pieces).collect()
    }

    /// The sectors that are given up.
    pub(crate) fn wedges(&self, pieces: &[Piece]) -> Wedges {
        Wedges::of(&self.wedge_pairs(), pieces.iter().map(|p| p.ends).collect())
    }

    /// Fills in the boxes of a node, which holds a part of the order, and below.
    fn enclose(&mut self, node: usize, part: Range<usize>) -> [DVec2; 2] {
        let own = if part.len() == 1 {
            let s = &self.all[self.order[part.start] as usize];
            let end = s.corner + s.bisector;
            [s.corner.min(end), s.corner.max(end)]
        } else {
            let middle = part.start.midpoint(part.end);
            let first = self.enclose(2 * node + 1, part.start..middle);
            let second = self.enclose(2 * node + 2, middle..part.end);
            [first[0].min(second[0]), first[1].max(second[1])]
        };
        self.boxes[node] = own;
        own
    }

    /// The sector that may be blamed for a triangle's angles, and how far away its
    /// corner is: the nearest of them.
    ///
    /// At a distance `r` from the corner the sector is `r sin(angle)` wide; where
    /// that is less than an edge nothing between its sides has good angles.
    ///
    /// # Complexity
    ///
    /// Logarithmic in the number of sectors, for each that may be blamed.
    pub(crate) fn near(&self, [a, b, c]: [DVec2; 3]) -> Option<(Sector, f64)> {
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let mut search = Search { centre: (a + b + c) / 3.0, longest, best: None };
        if !self.all.is_empty() {
            self.search(0, 0..self.all.len(), &mut search);
        }
        search.best.map(|(distance, i)| (self.all[i as usize], distance))
    }

    fn search(&self, node: usize, part: Range<usize>, search: &mut Search) {
        let [min, max] = self.boxes[node];
        let nearest = search.centre.clamp(min, max);
        if nearest.distance(search.centre) > SPREAD * search.longest {
            return;
        }
        if part.len() > 1 {
            let middle = part.start.midpoint(part.end);
            self.search(2 * node + 1, part.start..middle, search);
            self.search(2 * node + 2, middle..part.end, search);
            return;
        }
        let i = self.order[part.start];
        let sector = &self.all[i as usize];
        let distance = sector.corner.distance(search.centre);
        let nearer = search.best.is_none_or(|(d, j)| distance.total_cmp(&d).then(i.cmp(&j)).is_lt());
        if nearer && sector.may_be_blamed(search.centre, search.longest) {
            search.best = Some((distance, i));
        }
    }
}

/// What [`Sectors::near`] looks for.
struct Search {
    /// The triangle's centroid.
    centre: DVec2,
    /// Its longest edge.
    longest: f64,
    /// Distance and index of the nearest sector so far.
    best: Option<(f64, u32)>,
}
