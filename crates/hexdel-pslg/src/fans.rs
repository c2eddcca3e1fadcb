//! Fans of triangles around points with corners so narrow, or so many, that
//! nothing else keeps its bounds.
//!
//! At a distance `r` from a corner of `a` radians its segments are `r a` apart.
//! If the first triangle in the corner has sides of length `r`, it is followed
//! by edges of length `r a`, and next to these, on the other sides of the
//! segments, no triangle of 30 degrees finds room when `a` is small. So all
//! triangles around the corner are made as long as that one: a ring of vertices
//! at distance `r`, close together beside the narrow corner and farther and
//! farther apart away from it.
//!
//! ```text
//!        o-----o                 o   vertices of the ring
//!      / | \ / | \
//!    o   |  A==+==o======        =   segments
//!      \ | / \ | \\o=====
//!        o-----o--o
//! ```
//!
//! The triangles of the fan are isosceles: below the lower bound in the corner
//! of the input at most, and nowhere above 90 degrees. Around the ring sizes grow
//! by a factor of two from edge to edge, for which there is room; between the
//! segments the mesh goes on as between any two that are close to each other.
//!
//! Vertices of the ring become sites, its edges and spokes pieces that are not
//! divided. No region ends at them.

use crate::carve::Carving;
use crate::geometry::{distance_sq, nearest_on};
use crate::hull::with_hull;
use crate::net::{Kind, NONE, Net};
use crate::options::Extent;
use crate::sectors::direction;
use crate::validate::{Piece, Validated};
use hexdel_geom::{AngleBounds, DVec2, point_on_segment};
use rustc_hash::{FxHashMap, FxHashSet};
use std::f64::consts::TAU;

/// Corners below this many degrees get a fan. On the outer side of a segment
/// three triangles of 60 degrees around a vertex, each with sides as 1 to 2,
/// bring edges as 1 to 8 together: with the corner's first edge as long as its
/// distance from the point and the next as long as the corner is wide there, that
/// is an angle of 1/8 radian. Below, no mesh keeps 30 degrees but in a fan.
pub(crate) const NARROW_DEG: f64 = 7.0;

/// The same for lower bounds above 30 degrees too: the sides at a triangle's corner of 60
/// degrees are then as 1 to less than 2.
fn narrow_deg(near: AngleBounds) -> f64 {
    let sin = |deg: f64| libm::sin(deg.to_radians());
    let ratio = sin(near.min_deg()) / sin(120.0 - near.min_deg());
    NARROW_DEG.max(NARROW_DEG * (2.0 * ratio).powi(3))
}

/// So many corners of a point that are less than `ROOM_DEG` above the lower
/// bound get one, too: each is one triangle wide, and all must be as long.
const MANY: usize = 3;

/// See `MANY`.
const ROOM_DEG: f64 = 2.0;

/// Below this many degrees the strip beside the fan would take too many
/// triangles.
pub(crate) const LEAST_DEG: f64 = 0.09;

/// The widest angle of a fan's triangles, radians: 50 degrees.
const WIDEST: f64 = 0.87;

/// How fast angles grow away from a narrow one, radians per radian: by a factor
/// of `exp(0.8)` from one to the next.
const GROWTH: f64 = 0.8;

/// The ring's radius over the distance of the nearest thing that is not part of
/// the corner, where that is not beside short edges of the ring. The larger, the
/// shorter the strip beside the fan; but the longest edges of the ring must not be
/// much longer than what is left to that thing.
const CLEAR: f64 = 0.5;

/// The radii of two rings over the distance of their centres at most.
const CLEAR_OF_RING: f64 = 0.9;

/// What two rings leave between them, in lengths of the ring's edges there.
const BETWEEN_RINGS: f64 = 0.45;

/// How far beyond the ring anything is that is not on it, in lengths of the
/// ring's edges there: what is between has the room for good angles. Of things
/// farther than `CLEAR` allows no more is asked for.
const BEYOND: f64 = 4.0;

/// Places on a piece at which that is looked at, less one.
const SAMPLES: u32 = 16;

/// Whether a free end is a vertex of a ring: its triangles, with one side along the
/// radius, have no obtuse angle.
fn is_on_ring(spoke: &Spoke, beside: f64, radius: f64) -> bool {
    spoke.length * libm::cos(beside) <= radius * (1.0 + 4.0 * f64::EPSILON)
}

/// A ring around a site.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fan {
    pub(crate) site: u32,
    pub(crate) radius: f64,
}

/// Sites and pieces, those of fans among them.
pub(crate) struct Scene {
    /// The sites of the input, then those on rings.
    pub(crate) sites: Vec<DVec2>,
    /// The first input point at each site; of a ring that in its centre.
    pub(crate) input_of_site: Vec<u32>,
    /// In a row along each segment; then those of fans that are on no segment.
    pub(crate) pieces: Vec<Piece>,
    /// Whether a piece must stay one edge; as long as `pieces`.
    pub(crate) whole: Vec<bool>,
    /// The first piece that is on no segment and on no hull; no region ends there.
    pub(crate) soft: u32,
    pub(crate) fans: Vec<Fan>,
}

/// The pieces of an input with a fan at each narrow corner that is not carved away.
/// `most` is the largest radius at a place.
pub(crate) fn with_fans(
    input: &Validated,
    pieces: Vec<Piece>,
    near: AngleBounds,
    carving: Option<&Carving<'_>>,
    most: &dyn Fn(DVec2) -> f64,
) -> Scene {
    let mut scene = Scene::plain(input, pieces);
    let spokes = Spokes::of(&scene, carving);
    let corners: Vec<&[Spoke]> = spokes.corners(near).collect();
    let found = spokes.fans(input, &corners, most);
    if !found.is_empty() {
        let rings: Vec<Ring> = found.iter().map(|fan| spokes.ring(*fan)).collect();
        scene.cut(&rings);
        scene.fans = found;
    }
    scene
}

/// The points of a PSLG, by index, that may have a fan of triangles around them: those with
/// corners narrower than a mesh with these bounds near points and segments has room
/// for. The vertices around them count as points.
///
/// ```
/// use hexdel_geom::{AngleBounds, DVec2, Pslg};
/// use hexdel_pslg::{Extent, fan_points, validate};
///
/// let mut graph = Pslg::from_points(vec![DVec2::X, DVec2::ZERO, DVec2::new(1.0, 0.1)]);
/// graph.segments = vec![[0, 1], [1, 2]];
/// let near = AngleBounds::new(30.0, 90.0)?;
/// assert_eq!(fan_points(&validate(&graph)?, Extent::Hexagon, near), [1]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn fan_points(input: &Validated, extent: Extent, near: AngleBounds) -> Vec<u32> {
    let pieces = if extent == Extent::Hull { with_hull(input) } else { input.pieces.clone() };
    let scene = Scene::plain(input, pieces);
    let carving = Carving::of(input, extent);
    let spokes = Spokes::of(&scene, carving.as_ref());
    spokes.corners(near).map(|corner| scene.input_of_site[corner[0].site as usize]).collect()
}

/// A piece as seen from one of its ends.
#[derive(Clone, Copy, Debug)]
struct Spoke {
    site: u32,
    /// The direction of the piece, radians.
    angle: f64,
    piece: u32,
    length: f64,
    /// Whether nothing else begins where it ends.
    free: bool,
    /// Whether the sector from here to the next spoke is carved away.
    carved: bool,
}

/// All pieces from both ends, by site and direction.
struct Spokes<'a> {
    scene: &'a Scene,
    all: Vec<Spoke>,
}

/// What is around a corner.
struct Room {
    /// Of a ring that is clear of all but other rings.
    radius: f64,
    /// Sites that may have a ring, too; perhaps more than once.
    ringed: Vec<Other>,
}

/// A site that may have a ring, as seen from another.
#[derive(Clone, Copy)]
struct Other {
    site: u32,
    /// The radii of both rings together at most.
    shared: f64,
}

/// A ring to be.
struct Ring {
    fan: Fan,
    spokes: Vec<RingSpoke>,
}

struct RingSpoke {
    piece: u32,
    /// Whether the ring passes through the end of the piece.
    ends_there: bool,
    /// Angles to vertices of the ring before the next spoke.
    angles: Vec<f64>,
}

impl<'a> Spokes<'a> {
    fn of(scene: &'a Scene, carving: Option<&Carving<'_>>) -> Self {
        let mut degree = vec![0_u32; scene.sites.len()];
        for end in scene.pieces.iter().flat_map(|p| p.ends) {
            degree[end as usize] += 1;
        }
        let mut all = Vec::with_capacity(2 * scene.pieces.len());
        for (piece, i) in scene.pieces.iter().zip(0..) {
            let [a, b] = piece.ends;
            for [site, other] in [[a, b], [b, a]] {
                let u = scene.sites[other as usize] - scene.sites[site as usize];
                let free = degree[other as usize] == 1;
                let angle = direction(u);
                all.push(Spoke { site, angle, piece: i, length: u.length(), free, carved: false });
            }
        }
        all.sort_by(|a, b| a.site.cmp(&b.site).then(a.angle.total_cmp(&b.angle)));
        if let Some(carving) = carving {
            for group in all.chunk_by_mut(|a, b| a.site == b.site) {
                for (i, gap) in gaps(group).into_iter().enumerate() {
                    let spoke = &mut group[i];
                    spoke.carved = carving.is_carved_at(spoke.site, spoke.angle + 0.5 * gap);
                }
            }
        }
        Self { scene, all }
    }

    fn at(&self, site: u32) -> &[Spoke] {
        let first = self.all.partition_point(|s| s.site < site);
        let end = self.all.partition_point(|s| s.site <= site);
        &self.all[first..end]
    }

    /// The spokes of each site that has a narrow corner, or many that are
    /// somewhat narrow.
    fn corners(&self, near: AngleBounds) -> impl Iterator<Item = &[Spoke]> {
        let narrow = narrow_deg(near);
        self.all.chunk_by(|a, b| a.site == b.site).filter(move |group| {
            let gaps = kept_gaps(group);
            let least = gaps.iter().copied().fold(TAU, f64::min).to_degrees();
            let tight = gaps.iter().filter(|gap| gap.to_degrees() < near.min_deg() + ROOM_DEG).count();
            // Isosceles triangles have two angles near the largest.
            least >= LEAST_DEG && (least < narrow || tight >= MANY) && 90.0 - 0.5 * least < near.max_deg()
        })
    }

    /// The fans at corners, of radii of `most` at a place at most, where there is room.
    fn fans(&self, input: &Validated, corners: &[&[Spoke]], most: &dyn Fn(DVec2) -> f64) -> Vec<Fan> {
        let rooms: FxHashMap<u32, Room> =
            corners.iter().map(|at| (at[0].site, self.room(input, at, corners))).collect();
        let made = |at: &&[Spoke]| {
            let site = at[0].site;
            let room = &rooms[&site];
            // What one ring leaves of what they share is for the other.
            let left = |other: &Other| f64::max(0.5 * other.shared, other.shared - rooms[&other.site].radius);
            let clear = room.ringed.iter().map(left).fold(room.radius, f64::min);
            fan(at, clear.min(most(self.scene.sites[site as usize])))
        };
        corners.iter().filter_map(made).collect()
    }

    /// The room at a corner for a ring that is clear of other sites, but for free ends
    /// of its own pieces, and of other pieces.
    fn room(&self, input: &Validated, at: &[Spoke], corners: &[&[Spoke]]) -> Room {
        let (plane, site) = (&input.plane, at[0].site);
        let (centre, vertex) = (self.scene.sites[site as usize], input.vertex_of_site[site as usize]);
        let own: FxHashSet<u32> =
            at.iter().filter(|s| s.free).flat_map(|s| self.scene.pieces[s.piece as usize].ends).collect();
        let clear = clearance(centre, at);
        let clear_of_piece = |[a, b]: [DVec2; 2]| {
            let places = (0..=SAMPLES).map(|k| a.lerp(b, f64::from(k) / f64::from(SAMPLES)));
            places.chain([nearest_on(centre, a, b)]).map(&clear).fold(f64::INFINITY, f64::min)
        };
        let is_ringed = |s: u32| corners.binary_search_by_key(&s, |at| at[0].site).is_ok();
        let mut room = Room { radius: f64::INFINITY, ringed: Vec::new() };
        let mut stack = Vec::new();
        plane.star(vertex, &mut stack);
        let mut seen: FxHashSet<u32> = stack.iter().copied().collect();
        while let Some(t) = stack.pop() {
            let tri = plane.tri(t);
            for i in 0..3 {
                let p = plane.at(tri.v[i]);
                if let Kind::Site(s) = plane.vertex(tri.v[i]).kind
                    && s != site
                    && !own.contains(&s)
                {
                    room.radius = room.radius.min(clear(p));
                    if is_ringed(s) {
                        room.ringed.push(Other { site: s, shared: shared(at, self.at(s), [centre, p]) });
                    }
                }
                if tri.edge(i).contains(&vertex) {
                    continue;
                }
                let [a, b] = tri.edge(i).map(|v| plane.at(v));
                if tri.s[i] != NONE {
                    room.radius = room.radius.min(clear_of_piece([a, b]));
                }
                let reached = 0.5 * CLEAR_OF_RING * distance_sq(centre, a, b).sqrt() < room.radius;
                if reached && tri.n[i] != NONE && seen.insert(tri.n[i]) {
                    stack.push(tri.n[i]);
                }
            }
        }
        room
    }

    fn ring(&self, fan: Fan) -> Ring {
        let at = self.at(fan.site);
        let angles = divisions(at);
        let spoke = |((s, beside), angles): ((&Spoke, f64), Vec<f64>)| RingSpoke {
            piece: s.piece,
            ends_there: s.free && is_on_ring(s, beside, fan.radius),
            angles,
        };
        Ring { fan, spokes: at.iter().zip(beside(at, &angles)).zip(angles).map(spoke).collect() }
    }
}

/// The fan at a corner, clear of all but free ends of its spokes.
fn fan(at: &[Spoke], clear: f64) -> Option<Fan> {
    let beside = beside(at, &divisions(at));
    let free = || at.iter().zip(beside.iter().copied()).filter(|(s, _)| s.free);
    let first = free().map(|(s, _)| s.length).fold(f64::INFINITY, f64::min);
    let mut radius = clear.min(first);
    let beyond = |(s, gap): (&Spoke, f64)| s.length / (1.0 + BEYOND * gap);
    if !free().all(|(s, gap)| is_on_ring(s, gap, radius) || beyond((s, gap)) >= radius) {
        radius = free().map(beyond).fold(radius, f64::min);
    }
    (radius > 0.0 && radius.is_finite()).then_some(Fan { site: at[0].site, radius })
}

/// The angles, from each spoke, at which a ring has vertices before the next: close
/// together beside narrow corners.
fn divisions(at: &[Spoke]) -> Vec<Vec<f64>> {
    let size = sizes(at);
    at.iter().zip(gaps(at)).map(|(s, gap)| divided(gap, |a| size(s.angle + a))).collect()
}

/// The angle that a fan's triangle has in each direction.
fn sizes(at: &[Spoke]) -> impl Fn(f64) -> f64 {
    let (gaps, kept) = (gaps(at), kept_gaps(at));
    let starts: Vec<f64> = at.iter().map(|s| s.angle).collect();
    move |angle: f64| {
        let sizes = starts.iter().zip(&gaps).zip(&kept).map(|((start, gap), kept)| {
            let into = (angle - start).rem_euclid(TAU);
            let away = if into <= *gap { 0.0 } else { (into - gap).min(TAU - into) };
            kept + GROWTH * away
        });
        sizes.fold(WIDEST, f64::min)
    }
}

/// The largest radius of a ring that is clear of a place.
fn clearance(centre: DVec2, at: &[Spoke]) -> impl Fn(DVec2) -> f64 {
    let size = sizes(at);
    move |p: DVec2| {
        let beyond = 1.0 / (1.0 + BEYOND * size(direction(p - centre)));
        centre.distance(p) * CLEAR.max(beyond)
    }
}

/// The radii of the rings around two sites together at most. What is left between them is edge after edge longer
/// by a factor of two at most, beside the ring's edges, which are not divided.
fn shared(at: &[Spoke], other: &[Spoke], [a, b]: [DVec2; 2]) -> f64 {
    let edge = f64::max(sizes(at)(direction(b - a)), sizes(other)(direction(a - b)));
    a.distance(b) * CLEAR_OF_RING.min(1.0 / (1.0 + BETWEEN_RINGS * edge))
}

/// The angles from each spoke to the next, radians.
fn gaps(at: &[Spoke]) -> Vec<f64> {
    let gap = |i: usize| match (at[(i + 1) % at.len()].angle - at[i].angle).rem_euclid(TAU) {
        0.0 => TAU,
        gap => gap,
    };
    (0..at.len()).map(gap).collect()
}

/// The same, as wide as can be where they are carved away: nothing is asked for there.
fn kept_gaps(at: &[Spoke]) -> Vec<f64> {
    gaps(at).into_iter().zip(at).map(|(gap, spoke)| if spoke.carved { TAU } else { gap }).collect()
}

/// The narrower of a fan's triangles beside each spoke, radians.
fn beside(at: &[Spoke], divisions: &[Vec<f64>]) -> Vec<f64> {
    let gaps = gaps(at);
    let narrower = |i: usize| {
        let last = (i + gaps.len() - 1) % gaps.len();
        let after = divisions[i].first().copied().unwrap_or(gaps[i]);
        let before = gaps[last] - divisions[last].last().copied().unwrap_or(0.0);
        after.min(before)
    };
    (0..at.len()).map(narrower).collect()
}

/// The angles, between 0 and `gap`, that divide a gap into parts of a size that
/// depends on the place.
fn divided(gap: f64, size: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut counts = vec![(0.0, 0.0)];
    let (mut at, mut count) = (0.0, 0.0);
    while at < gap {
        let here = size(at);
        let next = if at + 0.15 * here >= gap { gap } else { at + 0.1 * here };
        count += 0.5 * (next - at) * (1.0 / here + 1.0 / size(next));
        at = next;
        counts.push((count, at));
    }
    // What rounding adds to a whole count divides nothing.
    let parts = (count - 1e-3).ceil().max(1.0);
    let angle_of = |wanted: f64| {
        let i = counts.partition_point(|c| c.0 < wanted).clamp(1, counts.len() - 1);
        let [(c0, a0), (c1, a1)] = [counts[i - 1], counts[i]];
        a0 + (a1 - a0) * (wanted - c0) / (c1 - c0)
    };
    (1..parts as u32).map(|i| angle_of(count * f64::from(i) / parts)).collect()
}

impl Scene {
    /// The pieces as they are.
    pub(crate) fn plain(input: &Validated, pieces: Vec<Piece>) -> Self {
        Self {
            sites: input.points.sites().to_vec(),
            input_of_site: input.points.input_of_site().to_vec(),
            whole: vec![false; pieces.len()],
            soft: pieces.len() as u32,
            pieces,
            fans: Vec::new(),
        }
    }

    /// Puts the vertices of rings on pieces and between them.
    fn cut(&mut self, rings: &[Ring]) {
        // By piece: the sites on it, first that of its first end's ring.
        let mut on: Vec<[u32; 2]> = vec![[NONE; 2]; self.pieces.len()];
        let mut soft = Vec::new();
        for ring in rings {
            let Fan { site, radius } = ring.fan;
            let mut all = Vec::new();
            for spoke in &ring.spokes {
                let p = spoke.piece as usize;
                let piece = self.pieces[p];
                let from = usize::from(piece.ends[0] != site);
                let other = piece.ends[1 - from];
                let [a, b] = [site, other].map(|s| self.sites[s as usize]);
                let vertex = if spoke.ends_there {
                    other
                } else {
                    self.add(point_on_segment(a, b, radius / a.distance(b)), site)
                };
                on[p][from] = vertex;
                all.push(vertex);
                let start = direction(b - a);
                for angle in &spoke.angles {
                    let (sin, cos) = libm::sincos(start + angle);
                    let vertex = self.add(a + radius * DVec2::new(cos, sin), site);
                    soft.push([site, vertex]);
                    all.push(vertex);
                }
            }
            soft.extend((0..all.len()).map(|i| [all[i], all[(i + 1) % all.len()]]));
        }
        let old = std::mem::take(&mut self.pieces);
        self.whole.clear();
        for (piece, [first, last]) in old.into_iter().zip(on) {
            let [a, b] = piece.ends;
            let mut row = vec![a];
            row.extend([first, last].into_iter().filter(|&v| v != NONE && v != a && v != b));
            row.push(b);
            for ends in row.windows(2).map(|pair| [pair[0], pair[1]]) {
                let whole = first != NONE && ends[0] == a || last != NONE && ends[1] == b;
                self.pieces.push(Piece { ends, segment: piece.segment });
                self.whole.push(whole);
            }
        }
        self.soft = self.pieces.len() as u32;
        self.pieces.extend(soft.into_iter().map(|ends| Piece { ends, segment: NONE }));
        self.whole.resize(self.pieces.len(), true);
    }

    fn add(&mut self, at: DVec2, centre: u32) -> u32 {
        self.sites.push(at);
        self.input_of_site.push(self.input_of_site[centre as usize]);
        self.sites.len() as u32 - 1
    }
}

/// Takes out the free vertices inside of a ring around a vertex. Those just outside
/// are to stay: beside a narrow corner the mesh is as fine as the corner is wide.
pub(crate) fn empty(net: &mut Net, centre: u32, radius: f64) {
    let at = net.at(centre);
    let (mut stack, mut inside) = (vec![centre], FxHashSet::default());
    let mut star = Vec::new();
    while let Some(v) = stack.pop() {
        net.star(v, &mut star);
        for w in star.iter().flat_map(|&t| net.tri(t).v) {
            if at.distance(net.at(w)) < radius && inside.insert(w) {
                stack.push(w);
            }
        }
    }
    let mut free: Vec<u32> = inside.into_iter().filter(|&v| net.vertex(v).kind == Kind::Free).collect();
    free.sort_unstable();
    for v in free {
        net.remove(v);
    }
}
