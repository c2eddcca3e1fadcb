//! Polygons become holes and regions: what covers each face of the plane.
//!
//! A face is a part of the plane between segments. Whoever crosses a segment of a
//! ring enters or leaves the ring, so that a walk from face to face, begun outside,
//! knows the rings around each, exactly and whatever lines pass through a polygon.
//! Each face then gets one seed: a hole or a region.
//!
//! ```text
//!   o-----------------o      no ring: outside
//!   | A   o-----------|--o   in A: a region with the attribute of A
//!   |     | A, B      |  |   in both: the later one's
//!   o-----------------o  |
//!         | B            |
//!         o--------------o
//! ```

use crate::carve::flood;
use crate::net::{NONE, Net};
use crate::options::Extent;
use crate::validate::Validated;
use hexdel_geom::{DVec2, Pslg, Region, orient2d};
use std::collections::BTreeMap;

/// What was found of polygons.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Cover {
    /// Polygons that differ in attribute or largest area and have a part of the plane in
    /// common.
    pub overlaps: Vec<Overlap>,
    /// Rings that do not say clearly what is inside.
    pub stray: Vec<StrayRing>,
}

/// What two polygons have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// Their indices; the attribute there is that of the last polygon that covers it.
    pub polygons: [u32; 2],
    /// A point in the largest part.
    pub at: DVec2,
    /// The area of all parts, square input units.
    pub area: f64,
}

/// A hole of a polygon that is not in it, or in another of its holes. It takes
/// nothing more away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrayRing {
    /// Index of the polygon.
    pub polygon: u32,
    /// Index of the ring.
    pub ring: u32,
    /// The other hole; `None` of a hole that is not in the polygon.
    pub other: Option<u32>,
    /// A point in the ring.
    pub at: DVec2,
}

impl Validated {
    /// The same PSLG with holes and regions in place of its polygons: a seed in each
    /// face, a region for the last polygon that covers it, or a hole. Its own holes and
    /// regions come first.
    ///
    /// Faces that no polygon covers are holes where polygons enclose them. Other such
    /// faces, which lines may enclose, are outside: holes only if `extent` is
    /// [`Extent::Inside`]. A PSLG without polygons comes back as it is.
    ///
    /// # Complexity
    ///
    /// Linear in the triangles between its points, the segments around faces and the
    /// rings around each.
    ///
    /// # Examples
    ///
    /// ```
    /// use hexdel_geom::{DVec2, Polygon, Pslg};
    /// use hexdel_pslg::{Extent, validate};
    ///
    /// // A square, cut by a line, beside a square.
    /// let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (4.0, 0.0), (4.0, 2.0)];
    /// let mut graph = Pslg::from_points(corners.map(|(x, y)| DVec2::new(x, y)).to_vec());
    /// graph.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0], [1, 4], [4, 5], [5, 2], [0, 2]];
    /// let polygon = |ring: [u32; 4], attribute| Polygon { rings: vec![ring.to_vec()], attribute, max_area: None };
    /// graph.polygons = vec![polygon([0, 1, 2, 3], 7.0), polygon([4, 5, 6, 1], 8.0)];
    /// let (seeded, cover) = validate(&graph)?.seeded(Extent::Inside);
    /// let mut attributes: Vec<f64> = seeded.pslg().regions.iter().map(|r| r.attribute).collect();
    /// attributes.sort_by(f64::total_cmp);
    /// assert_eq!(attributes, [7.0, 7.0, 8.0]);
    /// assert!(seeded.pslg().polygons.is_empty() && cover.overlaps.is_empty());
    /// # Ok::<(), hexdel_pslg::ValidateError>(())
    /// ```
    pub fn seeded(mut self, extent: Extent) -> (Self, Cover) {
        if self.pslg.polygons.is_empty() {
            return (self, Cover::default());
        }
        let rings = Rings::of(&self.pslg);
        let faces = Faces::of(&self, &rings);
        let polygons = std::mem::take(&mut self.pslg.polygons);
        let label = |p: u32| (polygons[p as usize].attribute, polygons[p as usize].max_area);
        let (mut overlaps, mut stray) = (BTreeMap::new(), BTreeMap::new());
        for face in &faces.all {
            let covering = rings.covering(&face.within);
            if let Some(&last) = covering.last() {
                let (attribute, max_area) = label(last);
                self.pslg.regions.extend(face.seed.map(|point| Region { point, attribute, max_area }));
                let others = covering.iter().filter(|&&p| label(p) != label(last));
                others.for_each(|&other| note_overlap(&mut overlaps, [other, last], face));
            } else if !face.outside || (extent == Extent::Inside && !face.rim) {
                self.pslg.holes.extend(face.seed);
            }
            rings.note_stray(&face.within, face, &mut stray);
        }
        let overlap = |(polygons, (_, at, area))| Overlap { polygons, at, area };
        let stray_ring = |((polygon, ring, other), at)| StrayRing { polygon, ring, other, at };
        let cover = Cover {
            overlaps: overlaps.into_iter().map(overlap).collect(),
            stray: stray.into_iter().map(stray_ring).collect(),
        };
        (self, cover)
    }
}

/// By pair of polygons: the largest part, a point in it, the area of all parts.
type Overlaps = BTreeMap<[u32; 2], (f64, DVec2, f64)>;

fn note_overlap(overlaps: &mut Overlaps, pair: [u32; 2], face: &Face) {
    let Some(at) = face.seed else { return };
    let entry = overlaps.entry(pair).or_insert((0.0, at, 0.0));
    entry.2 += face.area;
    if face.area > entry.0 {
        (entry.0, entry.1) = (face.area, at);
    }
}

/// All rings of all polygons, numbered in a row.
struct Rings {
    /// The polygon and the number in it of each ring.
    of: Vec<[u32; 2]>,
    /// Segments and rings that run along them an odd number of times, sorted.
    sides: Vec<(u32, u32)>,
}

impl Rings {
    fn of(pslg: &Pslg) -> Self {
        let (mut of, mut sides) = (Vec::new(), Vec::new());
        for (polygon, p) in pslg.polygons.iter().zip(0_u32..) {
            for (ring, i) in polygon.rings.iter().zip(0_u32..) {
                sides.extend(ring.iter().map(|&segment| (segment, of.len() as u32)));
                of.push([p, i]);
            }
        }
        sides.sort_unstable();
        let odd = sides.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1).map(|same| same[0]);
        Self { of, sides: odd.collect() }
    }

    /// The rings that run along a segment, in order.
    fn along(&self, segment: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.sides.partition_point(|side| side.0 < segment);
        self.sides[first..].iter().take_while(move |side| side.0 == segment).map(|side| side.1)
    }

    /// The polygons that cover what lies in some rings, in order.
    fn covering(&self, within: &[u32]) -> Vec<u32> {
        let of = |ring: &u32| self.of[*ring as usize];
        within
            .chunk_by(|a, b| of(a)[0] == of(b)[0])
            .filter(|rings| rings.len() == 1 && of(&rings[0])[1] == 0)
            .map(|rings| of(&rings[0])[0])
            .collect()
    }

    /// Notes holes in holes and holes outside of their polygon.
    fn note_stray(&self, within: &[u32], face: &Face, stray: &mut BTreeMap<(u32, u32, Option<u32>), DVec2>) {
        let Some(at) = face.seed else { return };
        let of = |ring: &u32| self.of[*ring as usize];
        for rings in within.chunk_by(|a, b| of(a)[0] == of(b)[0]) {
            let holes: Vec<u32> = rings.iter().map(|r| of(r)[1]).filter(|&ring| ring > 0).collect();
            let polygon = of(&rings[0])[0];
            if let [other, .., ring] = holes[..] {
                stray.entry((polygon, ring, Some(other))).or_insert(at);
            } else if let ([ring], 1) = (&holes[..], rings.len()) {
                stray.entry((polygon, *ring, None)).or_insert(at);
            }
        }
    }
}

/// A part of the plane between segments.
struct Face {
    /// A point inside; `None` if it is so thin that coordinates have none.
    seed: Option<DVec2>,
    area: f64,
    /// The rings around it, in order.
    within: Vec<u32>,
    /// Whether it can be reached from the rim without crossing a ring.
    outside: bool,
    /// Whether it is at the rim.
    rim: bool,
}

struct Faces {
    all: Vec<Face>,
    /// A face, one beside it, and the segment between them; sorted.
    doors: Vec<(u32, u32, u32)>,
}

/// The face that a walk comes from, and the segment it crosses.
type Step = Option<(usize, u32)>;

impl Faces {
    fn of(input: &Validated, rings: &Rings) -> Self {
        let (face_of, mut all) = partition(&input.plane);
        let mut doors = Vec::new();
        for t in input.plane.alive() {
            let tri = input.plane.tri(t);
            for i in 0..3 {
                let (near, far) = (face_of[t as usize], tri.n[i]);
                if far == NONE {
                    all[near as usize].rim = true;
                } else if near != face_of[far as usize] {
                    let segment = input.pieces[tri.s[i] as usize].segment;
                    doors.push((near, face_of[far as usize], segment));
                }
            }
        }
        doors.sort_unstable();
        doors.dedup();
        let mut faces = Self { all, doors };
        let rim: Vec<u32> = (0..faces.all.len() as u32).filter(|&f| faces.all[f as usize].rim).collect();
        let is_line = |segment| rings.along(segment).next().is_none();
        faces.walk(rim.clone(), |all, face, _| all[face].outside = true, is_line);
        let enter = |all: &mut [Face], face: usize, from: Step| {
            if let Some((from, segment)) = from {
                all[face].within = toggled(&all[from].within, rings.along(segment));
            }
        };
        faces.walk(rim, enter, |_| true);
        faces
    }

    /// Goes from face to face through segments that `opens` lets through, and enters
    /// each face once: with the face it comes from and the segment between them.
    fn walk(
        &mut self,
        mut stack: Vec<u32>,
        mut enter: impl FnMut(&mut [Face], usize, Step),
        opens: impl Fn(u32) -> bool,
    ) {
        let mut seen = vec![false; self.all.len()];
        for &face in &stack {
            seen[face as usize] = true;
            enter(&mut self.all, face as usize, None);
        }
        while let Some(face) = stack.pop() {
            let first = self.doors.partition_point(|door| door.0 < face);
            for &(_, next, segment) in self.doors[first..].iter().take_while(|door| door.0 == face) {
                if !seen[next as usize] && opens(segment) {
                    seen[next as usize] = true;
                    enter(&mut self.all, next as usize, Some((face as usize, segment)));
                    stack.push(next);
                }
            }
        }
    }
}

/// The face of each triangle, and the faces.
fn partition(plane: &Net) -> (Vec<u32>, Vec<Face>) {
    let mut face_of = vec![NONE; plane.tri_count() as usize];
    let mut faces = Vec::new();
    for start in plane.alive() {
        if face_of[start as usize] != NONE {
            continue;
        }
        let number = faces.len() as u32;
        let mut face = Face { seed: None, area: 0.0, within: Vec::new(), outside: false, rim: false };
        let mut room = 0.0;
        flood(plane, vec![start], |t| {
            let new = face_of[t as usize] == NONE;
            if new {
                face_of[t as usize] = number;
                let corners = plane.corners(t);
                let [a, b, c] = corners;
                let area = 0.5 * (b - a).perp_dot(c - a);
                face.area += area;
                let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
                if area / longest > room
                    && let Some(seed) = middle(corners)
                {
                    (room, face.seed) = (area / longest, Some(seed));
                }
            }
            new
        });
        faces.push(face);
    }
    (face_of, faces)
}

/// The centroid of a triangle, if it is inside as rounded.
fn middle([a, b, c]: [DVec2; 3]) -> Option<DVec2> {
    let p = a + ((b - a) + (c - a)) / 3.0;
    [(a, b), (b, c), (c, a)].into_iter().all(|(a, b)| orient2d(a, b, p) > 0.0).then_some(p)
}

/// What is in one of two sorted lists, and not in both.
fn toggled(within: &[u32], crossed: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut all: Vec<u32> = within.iter().copied().chain(crossed).collect();
    all.sort_unstable();
    all.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| same[0]).collect()
}
