//! What a mesh must keep besides its outline: edges, the segments that
//! vertices slide along, other bounds near them, limits on areas.

use hexdel_geom::{AngleBounds, DVec2, VertexId, point_on_segment};

use crate::angles::{Limits, Measure, Place};
use crate::mesh::Mesh;
use crate::refill::tightness;
use crate::sizing::Sizing;

/// The largest area of a triangle by the place of its centroid.
pub type AreaLimit<'a> = &'a (dyn Fn(DVec2) -> f64 + Sync);

/// Whether a triangle with these corners is beyond repair.
pub type Hopeless<'a> = &'a (dyn Fn([DVec2; 3]) -> bool + Sync);

/// Segments in a mesh, and what holds around them.
#[derive(Clone, Default)]
pub struct Constraints<'a> {
    /// The ends of each segment that a
    /// [`VertexKind::OnSegment`](crate::VertexKind::OnSegment) names.
    pub segments: Vec<[DVec2; 2]>,
    /// Edges that must stay. A vertex on a segment may go, and leaves one edge
    /// in the place of two; all others stay as they are. The corner of a
    /// triangle between two of them has the angle it has: the lower bound does
    /// not count there.
    pub edges: Vec<[VertexId; 2]>,
    /// Fixed vertices that count as segments do for `near`.
    pub points: Vec<VertexId>,
    /// Bounds of the triangles that have a vertex at most one edge away from a
    /// vertex on a segment or from one of `points`, instead of those of the
    /// options. They must be wider.
    pub near: AngleBounds,
    /// Whether an angle that is exactly at a bound of `near`, up to rounding,
    /// is out of it. Right angles on both sides of an edge leave it to rounding
    /// whether the edge is Delaunay.
    pub strict: bool,
    /// Pairs of segments that meet at so small an angle that no triangle between
    /// them can keep the lower bound. Of those whose corners all lie on the two
    /// only the upper bound is asked.
    pub wedges: Vec<[usize; 2]>,
    /// Triangles, by their corners, for which changes of topology are not worth
    /// trying: what surrounds them has no room.
    pub hopeless: Option<Hopeless<'a>>,
    /// Triangles larger than this where their centroids lie are divided if their
    /// angles let them, and no removal makes one. Square units of the mesh.
    pub max_area: Option<AreaLimit<'a>>,
    /// Edges longer than wanted are divided if the angles let them, and no removal
    /// makes one. A [`LiveMesh`](crate::live::LiveMesh) has a sizing of its own.
    pub sizing: Option<&'a dyn Sizing>,
}

impl std::fmt::Debug for Constraints<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Constraints")
            .field("segments", &self.segments.len())
            .field("edges", &self.edges.len())
            .field("points", &self.points.len())
            .field("near", &self.near)
            .field("strict", &self.strict)
            .field("wedges", &self.wedges.len())
            .field("hopeless", &self.hopeless.is_some())
            .field("max_area", &self.max_area.is_some())
            .field("sizing", &self.sizing.is_some())
            .finish()
    }
}

/// A vertex that is on no segment and counts as none.
pub(crate) const NOWHERE: u32 = u32::MAX;

/// A fixed vertex that counts as a segment does.
pub(crate) const POINT: u32 = u32::MAX - 1;

/// Whether all corners of a triangle lie on two segments that make a wedge, and
/// one of them between its ends. `sources` are segments, [`POINT`] or
/// [`NOWHERE`].
pub(crate) fn in_wedge(lines: &[Line], sources: [u32; 3], corners: [DVec2; 3]) -> bool {
    let Some(&first) = sources.iter().find(|&&s| s < POINT) else { return false };
    let wedges = &lines[first as usize].wedges;
    if wedges.is_empty() || sources.contains(&NOWHERE) {
        return false;
    }
    let on = |i: usize, line: u32| {
        sources[i] == line || (sources[i] == POINT && lines[line as usize].ends.contains(&corners[i]))
    };
    wedges.iter().any(|&second| (0..3).all(|i| on(i, first) || on(i, second)))
}

/// Last places of the largest coordinate that a point on a segment may be away
/// from it: rounding each coordinate takes it by `1 / sqrt 2`, measuring that by
/// two more.
const LAST_PLACES: f64 = 3.0;

/// A segment that vertices slide along.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) ends: [DVec2; 2],
    /// Unit vector from the first end to the second.
    pub(crate) along: DVec2,
    /// Those that it makes a wedge with.
    pub(crate) wedges: Vec<u32>,
}

impl Line {
    pub(crate) fn new(ends: [DVec2; 2]) -> Self {
        Self { ends, along: (ends[1] - ends[0]).normalize_or_zero(), wedges: Vec::new() }
    }

    /// Whether `p` lies between the ends, up to rounding.
    pub(crate) fn holds(&self, p: DVec2) -> bool {
        let [a, b] = self.ends;
        let largest = a.abs().max(b.abs()).max(p.abs()).max_element();
        let last_place = largest.next_up() - largest;
        let [from, to] = [p - a, b - p].map(|side| side.dot(self.along));
        let off = (p - a).perp_dot(self.along).abs().min((p - b).perp_dot(self.along).abs());
        from > 0.0 && to > 0.0 && off <= LAST_PLACES * last_place && p != a && p != b
    }

    /// The rounded point of the segment nearest to `p`.
    pub(crate) fn nearest(&self, p: DVec2) -> DVec2 {
        let [a, b] = self.ends;
        let t = (p - a).dot(self.along) / (b - a).dot(self.along);
        point_on_segment(a, b, t.clamp(0.0, 1.0))
    }
}

/// The segment that an edge is part of: that of an end between the segment's
/// own, or the one whose ends are the edge's. `sources` as of [`in_wedge`].
pub(crate) fn line_between(lines: &[Line], sources: [u32; 2], ends: [DVec2; 2]) -> Option<u32> {
    let between = sources.into_iter().find(|&s| s < POINT);
    let whole = || {
        let same = |l: &Line| l.ends == ends || l.ends == [ends[1], ends[0]];
        lines.iter().position(same).map(|i| i as u32)
    };
    between.or_else(whole)
}

/// Bounds by place, and limits on areas.
#[derive(Clone)]
pub(crate) struct Rules<'a> {
    far: Limits,
    near: Limits,
    /// How much tighter `far` is than usual.
    tightness: f64,
    max_area: Option<AreaLimit<'a>>,
    hopeless: Option<Hopeless<'a>>,
}

impl std::fmt::Debug for Rules<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Rules").field("far", &self.far).field("near", &self.near).finish_non_exhaustive()
    }
}

impl<'a> Rules<'a> {
    pub(crate) fn new(bounds: AngleBounds, constraints: Option<&Constraints<'a>>) -> Self {
        let far = Limits::new(bounds);
        Self {
            far,
            tightness: tightness(&far),
            near: match constraints {
                None => far,
                Some(c) if c.strict => Limits::new(c.near).without_tolerance(),
                Some(c) => Limits::new(c.near),
            },
            max_area: constraints.and_then(|c| c.max_area),
            hopeless: constraints.and_then(|c| c.hopeless),
        }
    }

    /// The bounds of a triangle.
    #[inline]
    pub(crate) fn limits(&self, place: Place) -> &Limits {
        if place.is_near() { &self.near } else { &self.far }
    }

    /// As [`tightness`] says of the bounds away from segments.
    #[inline]
    pub(crate) fn tightness(&self) -> f64 {
        self.tightness
    }

    /// The bounds of most triangles at a vertex.
    pub(crate) fn limits_at(&self, mesh: &Mesh, v: u32) -> &Limits {
        if mesh.is_near(v) { &self.near } else { &self.far }
    }

    /// Whether a mesh within the bounds may have edges that are not Delaunay.
    pub(crate) fn check_delaunay(&self) -> bool {
        self.far.check_delaunay || self.near.check_delaunay
    }

    /// Whether a triangle of the mesh keeps its bounds as a certificate sees
    /// them.
    #[inline]
    pub(crate) fn is_good(&self, mesh: &Mesh, t: u32) -> bool {
        self.is_within(mesh.place(t), mesh.tri[t as usize].v.map(|v| mesh.pos[v as usize]))
    }

    /// Whether a triangle at such a place keeps its bounds.
    #[inline]
    pub(crate) fn is_within(&self, place: Place, corners: [DVec2; 3]) -> bool {
        let limits = self.limits(place);
        let [a, b, c] = corners;
        let m = place.view(Measure::of(a, b, c), limits);
        limits.loose(&m) || limits.granted(&m, corners)
    }

    /// Whether a triangle is no larger than it may be.
    pub(crate) fn is_small(&self, [a, b, c]: [DVec2; 3]) -> bool {
        let Some(limit) = self.max_area else { return true };
        0.5 * Measure::of(a, b, c).cross <= limit((a + b + c) / 3.0)
    }

    /// Whether `count` triangles may cover what the triangles `tris` do.
    pub(crate) fn can_cover(&self, mesh: &Mesh, tris: &[u32], count: usize) -> bool {
        let Some(limit) = self.max_area else { return true };
        let area: f64 = tris.iter().map(|&t| 0.5 * mesh.measure(t).cross).sum();
        let largest = tris.iter().map(|&t| {
            let [a, b, c] = mesh.tri[t as usize].v.map(|v| mesh.pos[v as usize]);
            limit((a + b + c) / 3.0)
        });
        area <= count as f64 * largest.fold(0.0, f64::max)
    }

    /// Whether it is of no use to look for a better triangle here.
    pub(crate) fn is_hopeless(&self, corners: [DVec2; 3]) -> bool {
        self.hopeless.is_some_and(|hopeless| hopeless(corners))
    }

    pub(crate) fn limits_areas(&self) -> bool {
        self.max_area.is_some()
    }
}
