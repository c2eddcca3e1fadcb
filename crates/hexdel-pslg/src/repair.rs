//! Makes a planar straight-line graph of one that is not.
//!
//! Points closer than a tolerance become one, segments are divided where points
//! lie on them and where they cross, what is left twice or has no length goes.
//! Every round may make new contacts, as rounding bends what it divides; rounds
//! go on until there are none, or are given up. Everything done is reported.

use crate::error::ValidateError;
use crate::geometry::distance_sq;
use crate::hull::convex_hull;
use crate::options::Extent;
use crate::pairs::{Contacts, Touch, contacts};
use crate::validate::crossing;
use hexdel_geom::{DVec2, PointSet, Polygon, Pslg};
use rustc_hash::FxHashMap;

/// Rounds at most. Each brings what is left closer to the rounding of the
/// coordinates; three or four are the rule.
const ROUNDS: usize = 32;

/// One thing that [`repair`] did. Points and segments are those of the PSLG
/// given, except where a point is new.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Repair {
    /// A point went into another within the tolerance.
    MergedPoint {
        /// Index of the point, as given.
        point: u32,
        /// Index of the one it went into, as given.
        into: u32,
        /// Where that one is.
        at: DVec2,
        /// How far it was.
        distance: f64,
    },
    /// A segment, or what was left of it, has no length, and went.
    DroppedSegment {
        /// Index of the segment, as given.
        segment: u32,
        /// Where.
        at: DVec2,
    },
    /// Two segments, or parts of them, were the same, and are one.
    MergedSegments {
        /// Their indices, as given.
        segments: [u32; 2],
        /// The ends of what they share.
        ends: [DVec2; 2],
    },
    /// A segment was divided by a point on it, or within the tolerance of it.
    DividedAtPoint {
        /// Index of the segment, as given.
        segment: u32,
        /// Where the point is.
        at: DVec2,
        /// How far from the segment it was.
        distance: f64,
    },
    /// Two crossing segments were divided where they cross.
    DividedAtCrossing {
        /// Their indices, as given.
        segments: [u32; 2],
        /// Where they cross.
        at: DVec2,
    },
}

/// What [`repair`] did.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct RepairReport {
    /// Everything done, in order.
    pub repairs: Vec<Repair>,
    /// For each point given, its index in the PSLG made.
    pub point_of_input: Vec<u32>,
    /// For each segment of the PSLG made, those given that it is a part of.
    pub sources: Vec<Vec<u32>>,
    /// Whether nothing is left to repair.
    pub complete: bool,
}

/// Repairs what [`validate`](crate::validate) would find. Points that are not
/// merged keep their coordinates; holes and regions are left as they are, polygons
/// have the parts of their segments.
///
/// Attributes of points made where segments cross are zero, their markers are
/// those of one of the segments; a part shared by segments has the marker of
/// the first that has one.
///
/// # Errors
///
/// [`ValidateError`] for what cannot be repaired: arrays that do not fit
/// together and points that are not finite.
///
/// # Complexity
///
/// Near-linear for evenly spread input, times a few rounds.
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, Pslg};
/// use hexdel_pslg::{repair, validate};
///
/// let corners = [(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)];
/// let mut cross = Pslg::from_points(corners.map(|(x, y)| DVec2::new(x, y)).to_vec());
/// cross.segments = vec![[0, 1], [2, 3]];
/// let (mended, report) = repair(&cross, 1e-9)?;
/// assert_eq!(mended.points[4], DVec2::new(0.5, 0.5));
/// assert_eq!(mended.segments.len(), 4);
/// assert!(report.complete && validate(&mended).is_ok());
/// # Ok::<(), hexdel_pslg::ValidateError>(())
/// ```
pub fn repair(pslg: &Pslg, tolerance: f64) -> Result<(Pslg, RepairReport), ValidateError> {
    run(pslg, Touch { distance: tolerance, angle: 0.0 }, Extent::Inside)
}

/// As [`repair`], and points that nearly lie on a segment divide it, too: those seen
/// from both of its ends at less than [`NEARLY_ON_DEG`], however far that is.
///
/// No mesh keeps bounds between a segment and such a point: strips of so little width take thousands
/// of triangles. If the convex hull is to be meshed, neither does one between a segment and an edge of the
/// hull from the same point: there it is enough that the hull's next point is seen from that one as near.
///
/// ```text
///              o the hull's next point
///   a ---------+-o b
///              |
/// ```
///
/// # Errors
///
/// As [`repair`].
///
/// # Complexity
///
/// As of [`repair`].
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, Pslg};
///
/// let mut hanging = Pslg::from_points(vec![DVec2::ZERO, DVec2::new(1e3, 0.0), DVec2::new(500.0, 0.1)]);
/// hanging.segments = vec![[0, 1]];
/// let (mended, _) = hexdel_pslg::repair_nearly_on(&hanging, 1e-6, hexdel_pslg::Extent::Inside)?;
/// assert_eq!(mended.segments, [[0, 2], [2, 1]]);
/// # Ok::<(), hexdel_pslg::ValidateError>(())
/// ```
pub fn repair_nearly_on(
    pslg: &Pslg,
    tolerance: f64,
    extent: Extent,
) -> Result<(Pslg, RepairReport), ValidateError> {
    run(pslg, Touch { distance: tolerance, angle: NEARLY_ON_DEG.to_radians() }, extent)
}

/// The angle at which a point nearly lies on a segment, degrees: a sixth of 0.09, below which nothing
/// is kept between two segments.
pub const NEARLY_ON_DEG: f64 = 0.015;

fn run(pslg: &Pslg, touch: Touch, extent: Extent) -> Result<(Pslg, RepairReport), ValidateError> {
    pslg.check_layout()?;
    PointSet::new(&pslg.points)?;
    let distance = if touch.distance.is_finite() { touch.distance.max(0.0) } else { 0.0 };
    let n = pslg.points.len();
    let mut mender = Mender {
        pslg,
        touch: Touch { distance, ..touch },
        extent,
        points: pslg.points.clone(),
        into: (0..n as u32).collect(),
        markers: pslg.point_markers.clone(),
        segments: pslg.segments.iter().zip(0..).map(|(&ends, i)| Part::new(ends, i)).collect(),
        report: RepairReport::default(),
    };
    for _ in 0..ROUNDS {
        mender.merge_points();
        mender.merge_segments();
        if !mender.divide() {
            mender.report.complete = true;
            break;
        }
    }
    Ok(mender.finish())
}

/// The cell of a coordinate, then those beside it: as wide as the tolerance, or
/// the coordinate itself where its neighbours are farther away than that.
fn cells(c: f64, tolerance: f64) -> Vec<u64> {
    // Its neighbours are `EPSILON / 2` times itself away, at least.
    let cell = (c / tolerance).floor();
    if tolerance == 0.0 || cell.abs() > 4.0 / f64::EPSILON {
        return vec![(c + 0.0).to_bits()];
    }
    [0.0, -1.0, 1.0].map(|step| (cell + step + 0.0).to_bits()).to_vec()
}

/// A part of a segment, or of several.
#[derive(Clone)]
struct Part {
    ends: [u32; 2],
    /// Segments as given, in order.
    sources: Vec<u32>,
    /// Those of them that run along it an odd number of times: whoever crosses it
    /// crosses these.
    odd: Vec<u32>,
}

impl Part {
    fn new(ends: [u32; 2], segment: u32) -> Self {
        Self { ends, sources: vec![segment], odd: vec![segment] }
    }
}

/// What is in a list an odd number of times, sorted.
fn odd(mut list: Vec<u32>) -> Vec<u32> {
    list.sort_unstable();
    list.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1).map(|same| same[0]).collect()
}

struct Mender<'a> {
    pslg: &'a Pslg,
    touch: Touch,
    extent: Extent,
    /// All points ever, those given first.
    points: Vec<DVec2>,
    /// The point that each has gone into: itself or an earlier one that has
    /// gone nowhere.
    into: Vec<u32>,
    /// Parallel to `points`, or empty.
    markers: Vec<i32>,
    segments: Vec<Part>,
    report: RepairReport,
}

impl Mender<'_> {
    /// Each point goes into the first one within the tolerance.
    fn merge_points(&mut self) {
        let mut grid: FxHashMap<[u64; 2], Vec<u32>> = FxHashMap::default();
        for i in 0..self.points.len() as u32 {
            if self.into[i as usize] != i {
                continue;
            }
            let p = self.points[i as usize];
            let [x, y] = [p.x, p.y].map(|c| cells(c, self.touch.distance));
            let around = x.iter().flat_map(|&x| y.iter().map(move |&y| [x, y]));
            let first = around
                .filter_map(|key| grid.get(&key))
                .flatten()
                .copied()
                .filter(|&j| p.distance(self.points[j as usize]) <= self.touch.distance)
                .min();
            match first {
                Some(j) => {
                    self.into[i as usize] = j;
                    self.report_merge(i, j);
                }
                None => grid.entry([x[0], y[0]]).or_default().push(i),
            }
        }
        for i in 0..self.into.len() {
            self.into[i] = self.into[self.into[i] as usize];
        }
    }

    fn report_merge(&mut self, point: u32, into: u32) {
        if (point as usize) < self.pslg.points.len() {
            let [p, at] = [point, into].map(|i| self.points[i as usize]);
            self.report.repairs.push(Repair::MergedPoint { point, into, at, distance: p.distance(at) });
        }
    }

    /// Lets segments end at merged points; drops those without length and
    /// those that are there already.
    fn merge_segments(&mut self) {
        let mut first: FxHashMap<[u32; 2], usize> = FxHashMap::default();
        let mut kept: Vec<Part> = Vec::with_capacity(self.segments.len());
        for mut part in std::mem::take(&mut self.segments) {
            part.ends = part.ends.map(|p| self.into[p as usize]);
            let [a, b] = part.ends;
            if a == b {
                let at = self.points[a as usize];
                self.report.repairs.push(Repair::DroppedSegment { segment: part.sources[0], at });
                continue;
            }
            match first.entry([a.min(b), a.max(b)]) {
                std::collections::hash_map::Entry::Vacant(entry) => {
                    entry.insert(kept.len());
                    kept.push(part);
                }
                std::collections::hash_map::Entry::Occupied(entry) => {
                    let other = &mut kept[*entry.get()];
                    let segments = [other.sources[0], part.sources[0]];
                    let ends = part.ends.map(|p| self.points[p as usize]);
                    self.report.repairs.push(Repair::MergedSegments { segments, ends });
                    other.sources.extend(part.sources);
                    other.sources.sort_unstable();
                    other.sources.dedup();
                    other.odd.extend(part.odd);
                    other.odd = odd(std::mem::take(&mut other.odd));
                }
            }
        }
        self.segments = kept;
    }

    /// Divides segments at points on them, or else where they cross. Whether
    /// there was anything to do.
    fn divide(&mut self) -> bool {
        let ends: Vec<[u32; 2]> = self.segments.iter().map(|s| s.ends).collect();
        let mut found = contacts(&self.points, &ends, self.touch);
        // Merged points are none.
        found.touching.retain(|&(_, p)| self.into[p as usize] == p);
        if self.extent == Extent::Hull {
            found.touching.extend(self.beside_hull());
            found.touching.sort_unstable();
            found.touching.dedup();
        }
        let cuts = self.cuts(&found);
        let any = !cuts.is_empty();
        for group in cuts.chunk_by(|a, b| a.0 == b.0) {
            self.cut(group);
        }
        any
    }

    /// Segments and next points on the hull that are seen from their ends at less than the angle.
    fn beside_hull(&self) -> Vec<(u32, u32)> {
        let kept: Vec<u32> = (0..self.points.len() as u32).filter(|&i| self.into[i as usize] == i).collect();
        let at = |p: u32| self.points[p as usize];
        let sites: Vec<DVec2> = kept.iter().map(|&p| at(p)).collect();
        let hull: Vec<u32> = convex_hull(&sites).into_iter().map(|i| kept[i as usize]).collect();
        let mut next: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for (&p, &q) in hull.iter().zip(hull.iter().cycle().skip(1)) {
            next.entry(p).or_default().push(q);
            next.entry(q).or_default().push(p);
        }
        let is_beside = |[a, b]: [u32; 2], p: u32| {
            let [a, b, p] = [a, b, p].map(at);
            let along = (p - a).dot(b - a) / a.distance_squared(b);
            along > 0.0
                && along < 1.0
                && (b - a).perp_dot(p - a).abs() <= self.touch.angle * a.distance(b) * a.distance(p)
        };
        let mut found = Vec::new();
        for (part, segment) in self.segments.iter().zip(0..) {
            let [a, b] = part.ends;
            for [from, to] in [[a, b], [b, a]] {
                let beside = next.get(&from).into_iter().flatten().filter(|&&p| p != to);
                found.extend(beside.filter(|&&p| is_beside([from, to], p)).map(|&p| (segment, p)));
            }
        }
        found
    }

    /// The segments and the points to divide them at.
    fn cuts(&mut self, found: &Contacts) -> Vec<(u32, u32)> {
        let mut cuts = found.touching.clone();
        for &(segment, p) in &cuts {
            let part = &self.segments[segment as usize];
            let ([a, b], at) = (part.ends.map(|p| self.points[p as usize]), self.points[p as usize]);
            let (segment, distance) = (part.sources[0], distance_sq(at, a, b).sqrt());
            self.report.repairs.push(Repair::DividedAtPoint { segment, at, distance });
        }
        // Dividing at points settles most crossings near them.
        if cuts.is_empty() {
            for &(r, s) in &found.crossing {
                let [[a, b], [c, d]] =
                    [r, s].map(|i| self.segments[i as usize].ends.map(|p| self.points[p as usize]));
                let at = crossing(a, b, c, d);
                let segments = [r, s].map(|i| self.segments[i as usize].sources[0]);
                self.report.repairs.push(Repair::DividedAtCrossing { segments, at });
                let p = self.add_point(at, segments);
                cuts.extend([(r, p), (s, p)]);
            }
        }
        cuts.sort_unstable();
        cuts
    }

    fn add_point(&mut self, at: DVec2, segments: [u32; 2]) -> u32 {
        let p = self.points.len() as u32;
        self.points.push(at);
        self.into.push(p);
        if !self.pslg.point_markers.is_empty() {
            let marker = |s: u32| self.pslg.segment_markers.get(s as usize).copied().unwrap_or(0);
            let first = segments.into_iter().map(marker).find(|&m| m != 0);
            self.markers.push(first.unwrap_or(0));
        }
        p
    }

    /// Divides one segment at points on it.
    fn cut(&mut self, cuts: &[(u32, u32)]) {
        let segment = cuts[0].0 as usize;
        let whole = self.segments[segment].clone();
        let [a, b] = whole.ends;
        let from = self.points[a as usize];
        let direction = self.points[b as usize] - from;
        let mut stops: Vec<(f64, u32)> =
            cuts.iter().map(|&(_, p)| ((self.points[p as usize] - from).dot(direction), p)).collect();
        stops.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        let chain: Vec<u32> = std::iter::once(a).chain(stops.into_iter().map(|s| s.1)).chain([b]).collect();
        self.segments[segment].ends = [chain[0], chain[1]];
        let rest = chain[1..].windows(2).map(|w| Part { ends: [w[0], w[1]], ..whole.clone() });
        self.segments.extend(rest);
    }

    /// The polygons, of what has become of their segments.
    fn polygons(&self) -> Vec<Polygon> {
        if self.pslg.polygons.is_empty() {
            return Vec::new();
        }
        let parts =
            self.segments.iter().zip(0_u32..).flat_map(|(part, i)| part.odd.iter().map(move |&s| (s, i)));
        let mut parts: Vec<(u32, u32)> = parts.collect();
        parts.sort_unstable();
        let of_segment = |s: &u32| {
            let [first, end] = [*s, *s + 1].map(|s| parts.partition_point(|part| part.0 < s));
            parts[first..end].iter().map(|part| part.1)
        };
        let ring = |ring: &Vec<u32>| odd(ring.iter().flat_map(of_segment).collect());
        let polygon = |p: &Polygon| Polygon { rings: p.rings.iter().map(ring).collect(), ..*p };
        self.pslg.polygons.iter().map(polygon).collect()
    }

    fn finish(self) -> (Pslg, RepairReport) {
        let mut number = vec![u32::MAX; self.points.len()];
        let mut out = Pslg {
            holes: self.pslg.holes.clone(),
            regions: self.pslg.regions.clone(),
            polygons: self.polygons(),
            attributes_per_point: self.pslg.attributes_per_point,
            ..Pslg::default()
        };
        for i in (0..self.points.len()).filter(|&i| self.into[i] as usize == i) {
            number[i] = out.points.len() as u32;
            out.points.push(self.points[i]);
            out.point_markers.extend(self.markers.get(i));
            if i < self.pslg.points.len() {
                out.point_attributes.extend(self.pslg.attributes(i));
            } else {
                out.point_attributes.extend(std::iter::repeat_n(0.0, self.pslg.attributes_per_point));
            }
        }
        let given = &self.pslg.segment_markers;
        let mut report = self.report;
        for part in self.segments {
            out.segments.push(part.ends.map(|p| number[self.into[p as usize] as usize]));
            if !given.is_empty() {
                let first = part.sources.iter().map(|&s| given[s as usize]).find(|&m| m != 0);
                out.segment_markers.push(first.unwrap_or(0));
            }
            report.sources.push(part.sources);
        }
        let new = |i: usize| number[self.into[i] as usize];
        report.point_of_input = (0..self.pslg.points.len()).map(new).collect();
        (out, report)
    }
}
