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

use crate::geometry::distance_sq;
use crate::net::{Kind, NONE, Net};
use crate::sectors::direction;
use crate::validate::{Piece, Validated};
use hexdel_geom::{AngleBounds, DVec2, point_on_segment};
use rustc_hash::FxHashSet;
use std::f64::consts::TAU;

/// Corners below this many degrees get a fan. On the outer side of a segment
/// three triangles of 60 degrees around a vertex, each with sides as 1 to 2,
/// bring edges as 1 to 8 together, which is enough for an angle of 1/8 radian.
const NARROW_DEG: f64 = 7.0;

/// So many corners of a point that are less than `ROOM_DEG` above the lower
/// bound get one, too: each is one triangle wide, and all must be as long.
const MANY: usize = 3;

/// See `MANY`.
const ROOM_DEG: f64 = 2.0;

/// Below this many degrees the strip beside the fan would take too many
/// triangles.
const LEAST_DEG: f64 = 0.05;

/// The widest angle of a fan's triangles, radians: 50 degrees.
const WIDEST: f64 = 0.87;

/// How fast angles grow away from a narrow one, radians per radian: by a factor
/// of `exp(0.8)` from one to the next.
const GROWTH: f64 = 0.8;

/// The ring's radius over the distance of the nearest thing that is not part of
/// the corner, another ring perhaps.
const CLEAR: f64 = 0.45;

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

/// The pieces of an input with a fan at each narrow corner. `area` is the largest
/// area of a triangle at a place.
pub(crate) fn with_fans(
    input: &Validated,
    pieces: Vec<Piece>,
    near: AngleBounds,
    area: &dyn Fn(DVec2) -> f64,
) -> Scene {
    let mut scene = Scene::plain(input, pieces);
    let spokes = Spokes::of(&scene);
    let found: Vec<Fan> = spokes
        .corners(near)
        .filter_map(|at| spokes.fan(input, at, area(scene.sites[at[0].site as usize])))
        .collect();
    if !found.is_empty() {
        let rings: Vec<Ring> = found.iter().map(|fan| spokes.ring(*fan)).collect();
        scene.cut(&rings);
        scene.fans = found;
    }
    scene
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
}

/// All pieces from both ends, by site and direction.
struct Spokes<'a> {
    scene: &'a Scene,
    all: Vec<Spoke>,
}

/// A ring to be: for each spoke the piece, and the angles between its direction
/// and the next one's at which the ring has vertices.
struct Ring {
    fan: Fan,
    spokes: Vec<(u32, Vec<f64>)>,
}

impl<'a> Spokes<'a> {
    fn of(scene: &'a Scene) -> Self {
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
                all.push(Spoke { site, angle: direction(u), piece: i, length: u.length(), free });
            }
        }
        all.sort_by(|a, b| a.site.cmp(&b.site).then(a.angle.total_cmp(&b.angle)));
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
        self.all.chunk_by(|a, b| a.site == b.site).filter(move |group| {
            let gaps = gaps(group);
            let least = gaps.iter().copied().fold(TAU, f64::min).to_degrees();
            let tight = gaps.iter().filter(|gap| gap.to_degrees() < near.min_deg() + ROOM_DEG).count();
            // Isosceles triangles have two angles near the largest.
            least >= LEAST_DEG && (least < NARROW_DEG || tight >= MANY) && 90.0 - 0.5 * least < near.max_deg()
        })
    }

    /// The fan at a corner; `None` if there is no room.
    fn fan(&self, input: &Validated, at: &[Spoke], area: f64) -> Option<Fan> {
        let site = at[0].site;
        // Twice the largest triangle's area is less than the radius squared.
        let clear = CLEAR * self.clearance(input, site).min(area.sqrt() / CLEAR);
        let free = || at.iter().zip(beside(at)).filter(|(s, _)| s.free);
        let first = free().map(|(s, _)| s.length).fold(f64::INFINITY, f64::min);
        let mut radius = clear.min(first);
        // A free end is on the ring, or as far from it as its neighbours.
        let fits = |(s, gap): (&Spoke, f64)| {
            s.length - radius <= 0.25 * gap * gap * radius || s.length >= (1.0 + gap) * radius
        };
        if !free().all(fits) {
            radius = free().map(|(s, gap)| s.length / (1.0 + gap)).fold(radius, f64::min);
        }
        (radius > 0.0 && radius.is_finite()).then_some(Fan { site, radius })
    }

    /// The distance from a site to the nearest thing that does not belong to its
    /// corner: other sites but for free ends of its own pieces, other pieces.
    fn clearance(&self, input: &Validated, site: u32) -> f64 {
        let (plane, centre) = (&input.plane, self.scene.sites[site as usize]);
        let vertex = input.vertex_of_site[site as usize];
        let own: FxHashSet<u32> = self
            .at(site)
            .iter()
            .filter(|s| s.free)
            .flat_map(|s| self.scene.pieces[s.piece as usize].ends)
            .collect();
        let mut nearest = f64::INFINITY;
        let mut stack = Vec::new();
        plane.star(vertex, &mut stack);
        let mut seen: FxHashSet<u32> = stack.iter().copied().collect();
        while let Some(t) = stack.pop() {
            let tri = plane.tri(t);
            for i in 0..3 {
                if let Kind::Site(s) = plane.vertex(tri.v[i]).kind
                    && s != site
                    && !own.contains(&s)
                {
                    nearest = nearest.min(centre.distance(plane.at(tri.v[i])));
                }
                if tri.edge(i).contains(&vertex) {
                    continue;
                }
                let [a, b] = tri.edge(i).map(|v| plane.at(v));
                let distance = distance_sq(centre, a, b).sqrt();
                if tri.s[i] != NONE {
                    nearest = nearest.min(distance);
                }
                if distance < nearest && tri.n[i] != NONE && seen.insert(tri.n[i]) {
                    stack.push(tri.n[i]);
                }
            }
        }
        nearest
    }

    fn ring(&self, fan: Fan) -> Ring {
        let at = self.at(fan.site);
        let gaps = gaps(at);
        let starts: Vec<f64> = at.iter().map(|s| s.angle).collect();
        let size = |angle: f64| {
            let sizes = starts.iter().zip(&gaps).map(|(start, gap)| {
                let into = (angle - start).rem_euclid(TAU);
                let away = if into <= *gap { 0.0 } else { (into - gap).min(TAU - into) };
                gap + GROWTH * away
            });
            sizes.fold(WIDEST, f64::min)
        };
        let spokes =
            at.iter().zip(&gaps).map(|(s, gap)| (s.piece, divided(*gap, |a| size(s.angle + a)))).collect();
        Ring { fan, spokes }
    }
}

/// The angles from each spoke to the next, radians.
fn gaps(at: &[Spoke]) -> Vec<f64> {
    let gap = |i: usize| match (at[(i + 1) % at.len()].angle - at[i].angle).rem_euclid(TAU) {
        0.0 => TAU,
        gap => gap,
    };
    (0..at.len()).map(gap).collect()
}

/// The smaller of the gaps beside each spoke, or the widest angle of a fan.
fn beside(at: &[Spoke]) -> Vec<f64> {
    let gaps = gaps(at);
    (0..at.len()).map(|i| gaps[i].min(gaps[(i + gaps.len() - 1) % gaps.len()]).min(WIDEST)).collect()
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
    let parts = count.ceil().max(1.0);
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
            for (p, angles) in &ring.spokes {
                let piece = self.pieces[*p as usize];
                let from = usize::from(piece.ends[0] != site);
                let other = piece.ends[1 - from];
                let [a, b] = [site, other].map(|s| self.sites[s as usize]);
                let t = radius / a.distance(b);
                // At a free end the ring passes through it.
                let vertex = if t > 0.999_999 { other } else { self.add(point_on_segment(a, b, t), site) };
                on[*p as usize][from] = vertex;
                all.push(vertex);
                let start = direction(b - a);
                for angle in angles {
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

/// Takes out the free vertices inside of a ring around a vertex.
pub(crate) fn empty(net: &mut Net, centre: u32, radius: f64) {
    // A chord of 50 degrees comes closer to the centre; what is between it and
    // the arc is too close to the chord.
    const BEYOND: f64 = 1.02;
    let at = net.at(centre);
    let (mut stack, mut inside) = (vec![centre], FxHashSet::default());
    let mut star = Vec::new();
    while let Some(v) = stack.pop() {
        net.star(v, &mut star);
        for w in star.iter().flat_map(|&t| net.tri(t).v) {
            if at.distance(net.at(w)) < BEYOND * radius && inside.insert(w) {
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
