//! Is it planar? What crosses, overlaps or has no length is found and named.
//!
//! Points and segments are put into a constrained Delaunay triangulation, each
//! segment following its way through the triangles. On it the segment meets
//! whatever it crosses, overlaps or passes through, in exact arithmetic: no
//! pair is looked at that has nothing to do with each other. Nothing is
//! repaired here, except that a point exactly on a segment divides it, and that
//! exact duplicates of a point are one.

use crate::error::{Feature, ValidateError};
use crate::net::trace::Trace;
use crate::net::{Kind, NONE, Net};
use hexdel_geom::{DVec2, PointSet, PointsError, Pslg};

/// Largest coordinate: predicates take products of four, and of differences.
const MAX_COORDINATE: f64 = 1e70;

/// Smallest extent of several points, for the same reason.
const MIN_EXTENT: f64 = 1e-60;

/// A part of a segment between two neighbouring points on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Piece {
    /// The sites at its ends, in the direction of the segment.
    pub(crate) ends: [u32; 2],
    /// The first input segment it is a part of; `NONE` on the convex hull.
    pub(crate) segment: u32,
}

/// A planar straight-line graph.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, Pslg};
/// use hexdel_pslg::{ValidateError, validate};
///
/// let corners = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)];
/// let mut cross = Pslg::from_points(corners.map(|(x, y)| DVec2::new(x, y)).to_vec());
/// cross.segments = vec![[0, 1], [2, 3]];
/// let at = DVec2::new(0.5, 0.5);
/// assert_eq!(validate(&cross).err(), Some(ValidateError::Crossing { segments: [0, 1], at }));
/// ```
pub struct Validated {
    pub(crate) pslg: Pslg,
    pub(crate) points: PointSet,
    /// Disjoint but for common ends; every segment is the union of its pieces,
    /// which are listed in a row along it.
    pub(crate) pieces: Vec<Piece>,
    /// The constrained Delaunay triangulation in a rectangle; edges are marked
    /// with pieces. Vertex `4 + i` is not necessarily site `i`.
    pub(crate) plane: Net,
    /// The vertex of `plane` that each site is.
    pub(crate) vertex_of_site: Vec<u32>,
    divided: Vec<Divided>,
}

/// A point that lies exactly on a segment and divides it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Divided {
    /// Index of the segment.
    pub segment: usize,
    /// Index of the point.
    pub point: usize,
}

impl Piece {
    /// What of the input it is.
    pub(crate) fn feature(&self) -> Feature {
        if self.segment == NONE { Feature::Hull } else { Feature::Segment(self.segment as usize) }
    }
}

impl std::fmt::Debug for Validated {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Validated")
            .field("points", &self.points.sites().len())
            .field("pieces", &self.pieces.len())
            .field("divided", &self.divided)
            .finish_non_exhaustive()
    }
}

impl Validated {
    /// The PSLG, as given.
    pub fn pslg(&self) -> &Pslg {
        &self.pslg
    }

    /// The points on segments, which divide them.
    pub fn divided(&self) -> &[Divided] {
        &self.divided
    }

    /// The pieces between neighbouring points that segments consist of, in a row
    /// along each: the segment's index and the points at the ends.
    pub fn pieces(&self) -> impl Iterator<Item = (usize, [u32; 2])> + '_ {
        let point = |site: u32| self.points.input_of_site()[site as usize];
        self.pieces.iter().map(move |piece| (piece.segment as usize, piece.ends.map(point)))
    }

    /// For each input point the first one at the same place: itself, if it is
    /// no duplicate.
    pub fn first_of_point(&self) -> Vec<u32> {
        let sites = self.points.site_of_input().iter();
        sites.map(|&site| self.points.input_of_site()[site as usize]).collect()
    }
}

/// Checks that a PSLG is planar.
///
/// # Errors
///
/// The first of [`violations`].
///
/// # Complexity
///
/// Near-linear for evenly spread points; at worst every segment passes every
/// point.
pub fn validate(pslg: &Pslg) -> Result<Validated, ValidateError> {
    let (validated, violations) = examine(pslg)?;
    match violations.into_iter().next() {
        None => Ok(validated),
        Some(first) => Err(first),
    }
}

/// Everything that keeps a PSLG from being planar: what is wrong with the
/// arrays or the points, or else with the segments, in their order.
///
/// A segment found to be at fault is then left away, so that the crossings of
/// two faulty ones may only show when one is mended.
pub fn violations(pslg: &Pslg) -> Vec<ValidateError> {
    match examine(pslg) {
        Ok((_, violations)) => violations,
        Err(fatal) => vec![fatal],
    }
}

fn examine(pslg: &Pslg) -> Result<(Validated, Vec<ValidateError>), ValidateError> {
    pslg.check_layout()?;
    let points = PointSet::new(&pslg.points)?;
    check_range(&points)?;
    let named = pslg.holes.iter().enumerate().map(|(i, &p)| ("hole", i, p));
    let named = named.chain(pslg.regions.iter().enumerate().map(|(i, r)| ("region", i, r.point)));
    for (item, index, point) in named {
        if !point.is_finite() {
            return Err(ValidateError::NotFinite { item, index, point });
        }
    }
    check_rings(pslg, &points)?;
    // Four vertices of the rectangle and the pieces' numbers share 32 bits.
    if points.sites().len() + 4 > NONE as usize {
        return Err(PointsError::TooMany { count: points.sites().len() }.into());
    }
    let (plane, vertex_of_site) = plane_of(points.sites());
    let validated = Validated {
        pslg: pslg.clone(),
        points,
        pieces: Vec::new(),
        plane,
        vertex_of_site,
        divided: Vec::new(),
    };
    let mut examiner = Examiner { of: validated, violations: Vec::new() };
    for segment in 0..pslg.segments.len() {
        examiner.segment(segment);
    }
    Ok((examiner.of, examiner.violations))
}

/// An even number of a ring's segments ends at each point.
fn check_rings(pslg: &Pslg, points: &PointSet) -> Result<(), ValidateError> {
    let rings = pslg.polygons.iter().enumerate();
    for (polygon, ring, segments) in
        rings.flat_map(|(p, polygon)| polygon.rings.iter().enumerate().map(move |(r, ring)| (p, r, ring)))
    {
        let ends = segments.iter().flat_map(|&s| pslg.segments[s as usize]);
        let mut sites: Vec<u32> = ends.map(|p| points.site_of_input()[p as usize]).collect();
        sites.sort_unstable();
        if let Some(odd) = sites.chunk_by(|a, b| a == b).find(|same| same.len() % 2 == 1) {
            let at = points.sites()[odd[0] as usize];
            return Err(ValidateError::OpenRing { polygon, ring, at });
        }
    }
    Ok(())
}

fn check_range(points: &PointSet) -> Result<(), ValidateError> {
    let (min, max) = bounding_box(points.sites());
    let extent = (max - min).max_element();
    if points.sites().len() > 1 && extent < MIN_EXTENT {
        return Err(ValidateError::TooSmall { extent, limit: MIN_EXTENT });
    }
    let beyond = |p: &DVec2| p.abs().max_element() > MAX_COORDINATE;
    match points.sites().iter().position(beyond) {
        Some(site) => Err(ValidateError::OutOfRange {
            index: points.input_of_site()[site] as usize,
            point: points.sites()[site],
            limit: MAX_COORDINATE,
        }),
        None => Ok(()),
    }
}

/// The Delaunay triangulation of points in a rectangle around them.
fn plane_of(sites: &[DVec2]) -> (Net, Vec<u32>) {
    let (min, max) = bounding_box(sites);
    // Any margin will do; one of the input's own size keeps triangles at the
    // rim plump enough not to attract every walk.
    let margin = (max - min).max_element().max(max.abs().max(min.abs()).max_element() * 1e-6).max(1e-60);
    let mut net = Net::rectangle(min - margin, max + margin);
    let mut vertex_of_site = vec![NONE; sites.len()];
    let mut hint = 0;
    for site in spatial_order(sites) {
        let v = net.insert(sites[site as usize], Kind::Site(site), hint);
        let v = v.expect("sites lie inside of the rectangle around them");
        vertex_of_site[site as usize] = v;
        hint = net.some_triangle(v);
    }
    (net, vertex_of_site)
}

pub(crate) fn bounding_box(points: &[DVec2]) -> (DVec2, DVec2) {
    let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    points.iter().fold(start, |(min, max), &p| (min.min(p), max.max(p)))
}

/// Points in the order of a Morton curve through their bounding box: each near
/// the one before.
pub(crate) fn spatial_order(points: &[DVec2]) -> Vec<u32> {
    let (min, max) = bounding_box(points);
    let scale = f64::from(u32::MAX) / (max - min).max_element().max(f64::MIN_POSITIVE);
    let spread =
        |x: f64| (0..32).fold(0_u64, |bits, i| bits | (u64::from(((x * scale) as u32) >> i & 1) << (2 * i)));
    let mut order: Vec<(u64, u32)> = points
        .iter()
        .enumerate()
        .map(|(i, &p)| (spread(p.x - min.x) | spread(p.y - min.y) << 1, i as u32))
        .collect();
    order.sort_unstable();
    order.into_iter().map(|(_, i)| i).collect()
}

struct Examiner {
    of: Validated,
    violations: Vec<ValidateError>,
}

impl Examiner {
    /// Puts a segment into the triangulation, up to the first thing in its way.
    fn segment(&mut self, segment: usize) {
        let ends = self.of.pslg.segments[segment];
        let [a, b] = ends.map(|p| self.of.points.site_of_input()[p as usize]);
        if a == b {
            let at = self.of.points.sites()[a as usize];
            self.violations.push(ValidateError::ZeroLength { segment, at });
            return;
        }
        let goal = self.of.vertex_of_site[b as usize];
        let mut v = self.of.vertex_of_site[a as usize];
        while v != goal {
            match self.piece(segment, v, goal) {
                Ok(next) => v = next,
                Err(fault) => {
                    self.violations.push(fault);
                    return;
                }
            }
            if v != goal
                && let Kind::Site(site) = self.of.plane.vertex(v).kind
            {
                let point = self.of.points.input_of_site()[site as usize] as usize;
                self.of.divided.push(Divided { segment, point });
            }
        }
    }

    /// The piece of a segment from `v` to the next vertex on the way to `goal`.
    fn piece(&mut self, segment: usize, v: u32, goal: u32) -> Result<u32, ValidateError> {
        match self.of.plane.trace(v, goal) {
            Trace::Vertex { vertex, crossed } => {
                if let Some((t, i)) = self.of.plane.find_either(v, vertex)
                    && self.of.plane.tri(t).s[i] != NONE
                {
                    return Err(self.shared(segment, self.of.plane.tri(t).s[i], [v, vertex]));
                }
                let number = self.of.pieces.len() as u32;
                let site = |v| match self.of.plane.vertex(v).kind {
                    Kind::Site(site) => site,
                    _ => NONE,
                };
                self.of.pieces.push(Piece { ends: [site(v), site(vertex)], segment: segment as u32 });
                self.of.plane.lines.push([self.of.plane.at(v), self.of.plane.at(vertex)]);
                // Flips recover an edge that crosses no other constrained one.
                let made = self.of.plane.recover(v, vertex, crossed, number);
                if made { Ok(vertex) } else { Err(self.not_followed(segment, v)) }
            }
            Trace::Blocked([p, q]) => {
                let (t, i) = self.of.plane.find_either(p, q).expect("a traced edge is there");
                let other = self.of.pieces[self.of.plane.tri(t).s[i] as usize].segment as usize;
                let [a, b, c, d] = [v, goal, p, q].map(|v| self.of.plane.at(v));
                Err(ValidateError::Crossing { segments: sorted(segment, other), at: crossing(a, b, c, d) })
            }
            // In exact arithmetic a segment between sites stays inside of the
            // rectangle around them.
            Trace::Lost => Err(self.not_followed(segment, v)),
        }
    }

    fn not_followed(&self, segment: usize, v: u32) -> ValidateError {
        ValidateError::NotFollowed { segment, at: self.of.plane.at(v) }
    }

    fn shared(&self, segment: usize, piece: u32, part: [u32; 2]) -> ValidateError {
        let other = self.of.pieces[piece as usize].segment as usize;
        let segments = sorted(segment, other);
        let ends = part.map(|v| self.of.plane.at(v));
        let sites = |s: usize| {
            let [a, b] = self.of.pslg.segments[s].map(|p| self.of.points.site_of_input()[p as usize]);
            [a.min(b), a.max(b)]
        };
        if sites(segment) == sites(other) {
            ValidateError::Duplicate { segments, ends }
        } else {
            ValidateError::Overlap { segments, ends }
        }
    }
}

fn sorted(i: usize, j: usize) -> [usize; 2] {
    [i.min(j), i.max(j)]
}

/// Where the lines through `a b` and `c d` meet, up to rounding.
pub(crate) fn crossing(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> DVec2 {
    let (u, w) = (b - a, d - c);
    let t = (c - a).perp_dot(w) / u.perp_dot(w);
    if t.is_finite() { a + u * t.clamp(0.0, 1.0) } else { a.midpoint(b) }
}
