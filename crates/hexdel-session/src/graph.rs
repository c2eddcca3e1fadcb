//! Sessions of PSLGs: what of the PSLG stays, and the mesh seen with it.

use super::divide::{Divided, Divider};
use super::{PointId, Session, SessionError, SessionMesh};
use hexdel_geom::{Certificate, Circle, smallest_enclosing_circle};
use hexdel_geom::{CertifyOptions, DVec2, Pslg, SegmentCheck, VertexId, certify, check_segments};
use hexdel_mesher::Domain;
use hexdel_mesher::Error;
use hexdel_mesher::Mesher;
use hexdel_mesher::PslgTriangulation;
use hexdel_mesher::Warning;
use hexdel_mesher::for_sessions::Names;
use hexdel_optimize::live::{LiveMesh, Snapshot};
use hexdel_optimize::{Constraints, Sizing, VertexKind, kinds_of};
use hexdel_pslg::{
    Feature, Reason, RepairReport, SegmentEdge, SegmentMethod, hopeless_pairs, vertex_markers,
};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

/// Sine of the turn up to which the sides of a domain go straight on.
const STRAIGHT: f64 = 1e-3;

/// How much the radii of a ring may differ, in parts of one: they are rounded.
const ON_RING: f64 = 1e-9;

/// What does not change in a session of a PSLG.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(super) struct Frame {
    /// The PSLG. The first points of the session are its points.
    pub(super) graph: Pslg,
    /// The ends of each straight part of a segment, or of a side of the domain, and
    /// of each edge within a fan.
    pub(super) lines: Vec<[DVec2; 2]>,
    /// The segment that each of them is a part of.
    segment_of_line: Vec<Option<u32>>,
    /// How many of the lines, the last ones, are edges of fans.
    #[cfg_attr(feature = "serde", serde(default))]
    in_fans: usize,
    /// Whether the domain is what segments enclose, which does not depend on points.
    #[cfg_attr(feature = "serde", serde(default))]
    inside: bool,
    /// Whether it is the convex hull, which points in it do not change.
    #[cfg_attr(feature = "serde", serde(default))]
    hull: bool,
}

#[cfg(feature = "serde")]
impl Frame {
    /// Whether the segments are those of a mesh that was read.
    pub(super) fn fits(&self, live: &LiveMesh) -> bool {
        let known = |s: &Option<u32>| s.is_none_or(|s| (s as usize) < self.graph.segments.len());
        self.graph.check_layout().is_ok()
            && self.segment_of_line.len() == self.lines.len()
            && self.segment_of_line.iter().all(known)
            && self.in_fans <= self.lines.len()
            && live.segments().eq(self.lines.iter().copied())
    }
}

/// What was to be said of a PSLG when its session began.
#[derive(Clone, Debug, Default)]
pub(super) struct Told {
    repairs: Option<RepairReport>,
    warnings: Vec<Warning>,
}

/// What a session keeps, found out from scratch.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct SessionCheck {
    /// The certificate of the mesh; of a PSLG against the bounds near segments,
    /// and triangles at corners of the PSLG narrower than the bound count as out
    /// of bounds in it.
    pub certificate: Certificate,
    /// Whether the segments of a PSLG are unions of edges.
    pub segments: SegmentCheck,
    /// The corners of triangles that do not keep the bounds of their places, but for
    /// corners of the PSLG narrower than the bound.
    pub out_of_bounds: Vec<[DVec2; 3]>,
}

impl From<Certificate> for SessionCheck {
    /// The check of a mesh without segments.
    fn from(certificate: Certificate) -> Self {
        Self { certificate, segments: SegmentCheck::default(), out_of_bounds: Vec::new() }
    }
}

impl SessionCheck {
    /// Whether everything promised is so.
    pub fn holds(&self) -> bool {
        let c = &self.certificate;
        let broken =
            c.not_counter_clockwise + c.malformed + c.not_finite + c.repeated_edges + c.unused_vertices;
        let fits = self.out_of_bounds.is_empty() && self.segments.missing.is_empty();
        // Of a PSLG, the certificate's count of triangles has exempt ones in it.
        (c.holds() || self.segments.segments > 0)
            && fits
            && c.delaunay
            && broken == 0
            && c.inputs_kept == c.inputs
    }
}

/// The mesh of a PSLG in a row of straight parts.
struct Rows {
    lines: Vec<[DVec2; 2]>,
    segment_of_line: Vec<Option<u32>>,
    edges: Vec<[VertexId; 2]>,
    /// For each vertex the line that it lies on between the ends, if any.
    on: Vec<Option<usize>>,
    /// Ends of lines, and points of the PSLG.
    is_point: Vec<bool>,
    /// Lines from here on are edges of fans.
    fans: usize,
}

impl Rows {
    /// The rows of a mesh whose segments are parts of others, by their numbers, divided at
    /// points that are no ends of those.
    fn of(made: &PslgTriangulation, divided: &Divided) -> Self {
        let at = |v: VertexId| made.mesh.vertices[v.index()];
        let mut rows = Self {
            lines: Vec::new(),
            segment_of_line: Vec::new(),
            edges: Vec::new(),
            on: vec![None; made.mesh.vertices.len()],
            is_point: made.point_of_vertex.iter().map(Option::is_some).collect(),
            fans: 0,
        };
        let whole = |segment: Option<u32>| segment.map(|s| divided.whole[s as usize]);
        for v in divided.joints.iter().filter_map(|&p| made.vertex_of_point[p as usize]) {
            rows.is_point[v.index()] = false;
        }
        // The sides of a hexagon are no segments.
        let kept = |e: &&SegmentEdge| e.segment.is_some() || made.domain != Domain::Hexagon;
        let edges: Vec<&SegmentEdge> = made.edges.iter().filter(kept).collect();
        let fans = fan_edges(made, &edges);
        for end in fans.iter().flatten() {
            rows.is_point[end.index()] = true;
        }
        let is_point = rows.is_point.clone();
        let goes_on = |a: &SegmentEdge, b: &SegmentEdge| {
            let [u, w] = [a, b].map(|e| (at(e.ends[1]) - at(e.ends[0])).normalize_or_zero());
            let turns = is_point[b.ends[0].index()];
            let same = whole(a.segment) == whole(b.segment) && a.ends[1] == b.ends[0];
            same && !turns && u.perp_dot(w).abs() <= STRAIGHT
        };
        for row in edges.chunk_by(|a, b| goes_on(a, b)) {
            let ends = [row[0].ends[0], row[row.len() - 1].ends[1]];
            for edge in &row[1..] {
                rows.on[edge.ends[0].index()] = Some(rows.lines.len());
            }
            for end in ends {
                rows.is_point[end.index()] = true;
            }
            rows.lines.push(ends.map(at));
            rows.segment_of_line.push(whole(row[0].segment));
            rows.edges.extend(row.iter().map(|e| e.ends));
        }
        rows.fans = rows.lines.len();
        rows.lines.extend(fans.iter().map(|ends| ends.map(at)));
        rows.segment_of_line.extend(fans.iter().map(|_| None));
        rows.edges.extend(fans);
        rows
    }

    /// Pairs of segments too narrow for any bound between them.
    fn wedges(&self) -> Vec<[usize; 2]> {
        hopeless_pairs(&self.lines[..self.fans])
    }

    fn kinds(&self, made: &PslgTriangulation) -> Vec<VertexKind> {
        let taken = |v: VertexId| self.is_point[v.index()] || self.on[v.index()].is_some();
        let mut kinds = kinds_of(&made.mesh, taken);
        for (kind, on) in kinds.iter_mut().zip(&self.on) {
            if let Some(line) = *on {
                *kind = VertexKind::OnSegment(line);
            }
        }
        kinds
    }

    fn points(&self) -> Vec<VertexId> {
        (0..self.is_point.len()).filter(|&v| self.is_point[v]).map(VertexId::new).collect()
    }
}

impl Session {
    /// The mesh that a mesher makes of a PSLG of points and segments, as a
    /// session. Points of the PSLG are numbered as in it, or as in what repair has made of it
    /// ([`repairs`](Self::repairs)); those in holes or outside of the domain are not there, and
    /// those that segments end at stay.
    ///
    /// ```
    /// use hexdel::{DVec2, Mesher, Pslg, Session};
    ///
    /// let mut square = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
    /// square.segments = vec![[0, 1], [1, 2], [2, 3], [3, 0]];
    /// let mut session = Session::with_segments(&square, &Mesher::new())?;
    /// // On a side, which it divides.
    /// session.insert(DVec2::new(0.25, 0.0))?;
    /// assert!(session.check().holds());
    /// # Ok::<(), hexdel::SessionError>(())
    /// ```
    ///
    /// # Guarantees
    ///
    /// After every call, as of [`Mesher::triangulate_pslg`]: every segment is a union
    /// of edges, bounds hold by place, and triangles are exempt where segments meet at
    /// less than the bound.
    ///
    /// # Errors
    ///
    /// [`SessionError::Mesh`], [`SessionError::NotCertified`] for a PSLG whose mesh
    /// does not keep its bounds, [`SessionError::Size`], [`SessionError::NotForSessions`],
    /// [`SessionError::Duplicate`].
    pub fn with_segments(graph: &Pslg, mesher: &Mesher) -> Result<Self, SessionError> {
        let mesher = super::compact(mesher)?;
        let options = mesher.options_inside();
        let mut areas =
            graph.regions.iter().map(|r| r.max_area).chain(graph.polygons.iter().map(|p| p.max_area));
        if options.max_area.is_some() || areas.any(|area| area.is_some()) {
            return Err(SessionError::NotForSessions { option: "a limit on areas" });
        }
        if options.method == SegmentMethod::Paper {
            return Err(SessionError::NotForSessions { option: "the paper's method for segments" });
        }
        let begin = |mesher: &Mesher| -> Result<Self, SessionError> {
            let made = mesher.triangulate_pslg(graph)?;
            let (whole, divided) = (made.graph.clone(), Divided::none(&made.graph));
            Self::of_graph(&made, whole, &divided, mesher)
        };
        let size = mesher.asked().size.cloned();
        match begin(&mesher) {
            // What the size asks for has not come about at once: point by point it may.
            Err(SessionError::NotCertified { .. }) if size.is_some() => {
                let mut session = begin(&mesher.clone().without_size())?;
                session.set_size(size)?;
                session.history.clear();
                Ok(session)
            }
            begun => begun,
        }
    }

    /// The mesh that a mesher has made of a PSLG, `whole` but for points on its segments, as
    /// a session.
    fn of_graph(
        made: &PslgTriangulation,
        whole: Pslg,
        divided: &Divided,
        mesher: &Mesher,
    ) -> Result<Self, SessionError> {
        if !made.holds() {
            return Err(SessionError::NotCertified { certificate: Box::new(made.certificate.clone()) });
        }
        let options = mesher.options_inside();
        let rows = Rows::of(made, divided);
        let constraints = Constraints {
            segments: rows.lines.clone(),
            edges: rows.edges.clone(),
            points: rows.points(),
            near: options.near,
            wedges: rows.wedges(),
            ..Constraints::default()
        };
        let mesh = made.mesh.clone();
        let live = LiveMesh::with_segments(mesh, &rows.kinds(made), options.far, &constraints);
        let mut live = live.map_err(Error::Optimize)?;
        for &joint in &divided.joints {
            let at = made.graph.points[joint as usize];
            live.insert(at).map_err(|_| SessionError::NoRoom { at })?;
        }
        live.take_step();
        let size = mesher.asked().size.cloned();
        live.assume_sizing(size.clone().map(|s| Arc::new(s) as Arc<dyn Sizing>));
        let (points, of_slot) = slots_of(made, &divided.ids)?;
        let circle = smallest_enclosing_circle(&made.mesh.vertices);
        let circle = circle.unwrap_or(Circle { center: DVec2::ZERO, radius: 0.0 });
        let in_fans = rows.lines.len() - rows.fans;
        let inside = made.domain == Domain::Inside;
        let (lines, segment_of_line) = (rows.lines, rows.segment_of_line);
        let hull = made.domain == Domain::Hull;
        let frame = Frame { graph: whole, lines, segment_of_line, in_fans, inside, hull };
        let session = Self {
            live,
            bounds: options.far,
            options: mesher.for_session(),
            centre: circle.center,
            radius: circle.radius,
            grows: false,
            size,
            points,
            of_slot,
            frame: Some(Arc::new(frame)),
            told: Arc::new(Told { repairs: made.repairs.clone(), warnings: made.warnings.clone() }),
            changed: 0,
            drafts: false,
            history: VecDeque::new(),
        };
        let check = session.check();
        if !check.holds() {
            return Err(SessionError::NotCertified { certificate: Box::new(check.certificate) });
        }
        Ok(session)
    }

    /// A mesh of the PSLG with the points that are there and more, the last ones of all.
    ///
    /// # Errors
    ///
    /// [`SessionError`] where that is not made, does not hold, or has no place for them;
    /// [`SessionError::NotForSessions`] in a box or hexagon, which would be another one.
    pub(super) fn anew_with_segments(&self, frame: &Frame, new: &[DVec2]) -> Result<Self, SessionError> {
        let domain = match (frame.inside, frame.hull) {
            (true, _) => Domain::Inside,
            (_, true) => Domain::Hull,
            _ => {
                let option = "meshing a PSLG anew in a box or hexagon around it";
                return Err(SessionError::NotForSessions { option });
            }
        };
        let first = self.points.len() as u64;
        let mut divider = Divider::of(&frame.graph, |i| self.points[i].is_some());
        let olds = self.points().filter(|p| p.0.0 as usize >= frame.graph.points.len());
        let line_of = |id: PointId| self.live.line_of(self.points[id.0 as usize]?);
        let olds = olds.map(|(id, at)| (id, at, line_of(id)));
        let news = new.iter().zip(first..).map(|(&at, id)| (PointId(id), at, self.live.line_at(at)));
        for (id, at, line) in olds.chain(news) {
            divider.add(id, at, line.and_then(|line| frame.segment_of_line[line]));
        }
        let (graph, divided) = divider.divided();
        let [near, far] = self.live.bounds();
        let mesher = self.options.clone().bounds(far).near_bounds(near).domain(domain);
        let mesher = self.size.iter().fold(mesher, |m, size| m.size(size.clone()));
        let point = |p: usize| Feature::Point(divided.ids[p].0 as usize);
        let segment = |s: usize| Feature::Segment(divided.whole[s] as usize);
        let names = Names { point: &point, segment: &segment };
        let made = mesher.triangulate_pslg(&graph).map_err(|error| names.of_mesh(error))?;
        let anew = Self::of_graph(&made, frame.graph.clone(), &divided, &mesher)?;
        let there = |id: u64| anew.points.get(id as usize).copied().flatten().is_some();
        match new.iter().zip(first..).find(|p| !there(p.1)) {
            Some((&at, _)) => Err(SessionError::NotCovered { at }),
            None => Ok(anew),
        }
    }

    /// What of the PSLG that the session began with is not used or could have been meant
    /// otherwise, as of [`PslgTriangulation::warnings`]. It is not saved.
    ///
    /// ```
    /// # use hexdel::{DVec2, Mesher, Pslg, Session};
    /// let mut triangle = Pslg::from_points(vec![DVec2::ZERO, DVec2::X, DVec2::Y]);
    /// triangle.segments = vec![[0, 1], [1, 2], [2, 0]];
    /// triangle.holes = vec![DVec2::ONE];
    /// let session = Session::with_segments(&triangle, &Mesher::new())?;
    /// assert_eq!(session.warnings()[0].to_string(), "hole 0 at (1, 1) has no effect: it lies outside the domain");
    /// # Ok::<(), hexdel::SessionError>(())
    /// ```
    pub fn warnings(&self) -> &[Warning] {
        &self.told.warnings
    }

    /// What repair did to the PSLG that the session began with, as of
    /// [`PslgTriangulation::repairs`]: the points of the session are those of the PSLG made. It
    /// is not saved.
    pub fn repairs(&self) -> Option<&RepairReport> {
        self.told.repairs.as_ref()
    }

    /// What the mesh keeps, found out from scratch.
    ///
    /// # Complexity
    ///
    /// Linear in the mesh.
    pub fn check(&self) -> SessionCheck {
        self.checked(self.certificate())
    }

    /// The rest of a check.
    pub(super) fn checked(&self, certificate: Certificate) -> SessionCheck {
        let Some(frame) = &self.frame else { return certificate.into() };
        let lines = &frame.lines[..frame.lines.len() - frame.in_fans];
        let points: Vec<DVec2> = lines.iter().flatten().copied().collect();
        let pieces: Vec<[u32; 2]> = (0..lines.len() as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        SessionCheck {
            certificate,
            segments: check_segments(&self.live.snapshot().mesh, &points, &pieces),
            out_of_bounds: self.live.out_of_bounds(),
        }
    }

    /// The attribute of the region of each triangle of a mesh of this session, 0 if
    /// it lies in none.
    pub fn region_attributes(&self, made: &SessionMesh) -> Vec<f64> {
        let regions = self.frame.as_deref().map_or(&[][..], |frame| &frame.graph.regions);
        let attribute =
            |r: &Option<u32>| r.and_then(|r| regions.get(r as usize)).map_or(0.0, |r| r.attribute);
        made.region_of_triangle.iter().map(attribute).collect()
    }

    /// The certificate of a mesh with segments, against the bounds near them.
    pub(super) fn certificate_of_graph(&self, points: &[DVec2]) -> Certificate {
        let options = CertifyOptions {
            bounds: self.live.bounds()[0],
            inputs: Some(points),
            require_disk: false,
            ..CertifyOptions::default()
        };
        certify(&self.live.snapshot().mesh, &options)
    }

    /// Adds what a PSLG has besides: edges, markers, regions.
    pub(super) fn add_segments(&self, frame: &Frame, snapshot: &Snapshot, made: &mut SessionMesh) {
        let graph = &frame.graph;
        let edge = |side: &hexdel_optimize::live::SegmentSide| {
            let segment = frame.segment_of_line[side.segment];
            let marker = segment.and_then(|s| graph.segment_markers.get(s as usize)).copied().unwrap_or(0);
            let marker = if marker == 0 { i32::from(side.boundary) } else { marker };
            SegmentEdge { ends: side.ends, segment, marker, boundary: side.boundary }
        };
        let fans = frame.lines.len() - frame.in_fans;
        made.edges = snapshot.segment_edges.iter().filter(|side| side.segment < fans).map(edge).collect();
        let mut point_of_vertex = vec![None; made.mesh.vertices.len()];
        for &(PointId(id), v) in &made.points {
            point_of_vertex[v.index()] = u32::try_from(id).ok();
        }
        made.vertex_markers = vertex_markers(graph, &made.edges, &point_of_vertex);
        let regions: Vec<DVec2> = graph.regions.iter().map(|r| r.point).collect();
        made.region_of_triangle = self.live.parts(&regions, |line| line < fans);
    }
}

/// The edges of fans around points with narrow corners, but for those on segments, each
/// once: in a session they stay as segments do, and what is near them is near the PSLG.
fn fan_edges(made: &PslgTriangulation, edges: &[&SegmentEdge]) -> Vec<[VertexId; 2]> {
    let sorted = |[a, b]: [VertexId; 2]| [a.min(b), a.max(b)];
    let on_segments: BTreeSet<[VertexId; 2]> = edges.iter().map(|e| sorted(e.ends)).collect();
    let mut found = BTreeSet::new();
    for (apex, corners) in corners_of_fans(made) {
        // Where all are alone between two segments there is no fan but if all are as long.
        let alone =
            |[b, c]: &[VertexId; 2]| [*b, *c].iter().all(|&v| on_segments.contains(&sorted([apex, v])));
        if corners.exempt.iter().all(alone) && !is_ring(made, apex, &corners.all) {
            continue;
        }
        for [b, c] in corners.all {
            let sides = [[apex, b], [b, c], [c, apex]].map(sorted);
            found.extend(sides.into_iter().filter(|side| !on_segments.contains(side)));
        }
    }
    found.into_iter().collect()
}

/// The other corners of the triangles at a vertex.
#[derive(Default)]
struct Corners {
    all: Vec<[VertexId; 2]>,
    /// Of triangles that are exempt because of the angle there.
    exempt: Vec<[VertexId; 2]>,
}

/// The triangles around each point that has an exempt corner.
fn corners_of_fans(made: &PslgTriangulation) -> BTreeMap<VertexId, Corners> {
    let mut found: BTreeMap<VertexId, Corners> = BTreeMap::new();
    let others = |t: [VertexId; 3], apex: VertexId| {
        let k = t.iter().position(|&v| v == apex)?;
        Some([t[(k + 1) % 3], t[(k + 2) % 3]])
    };
    for exception in &made.exempt {
        let Reason::Sector { point, .. } = exception.reason else { continue };
        let Some(apex) = made.vertex_of_point[point as usize] else { continue };
        let sides = others(made.mesh.triangles[exception.triangle.index()], apex);
        found.entry(apex).or_default().exempt.extend(sides);
    }
    for &t in &made.mesh.triangles {
        for v in t {
            if let Some(corners) = found.get_mut(&v) {
                corners.all.extend(others(t, v));
            }
        }
    }
    found
}

/// Whether the neighbours of a vertex are on a circle around it.
fn is_ring(made: &PslgTriangulation, apex: VertexId, sides: &[[VertexId; 2]]) -> bool {
    let at = |v: VertexId| made.mesh.vertices[v.index()];
    let distances = || sides.iter().flatten().map(|&v| at(v).distance(at(apex)));
    let (least, most) = (distances().fold(f64::INFINITY, f64::min), distances().fold(0.0, f64::max));
    most - least <= ON_RING * most
}

/// The slot of each point by its number, and the point in each slot.
#[expect(clippy::type_complexity, reason = "the two fields of a session")]
fn slots_of(
    made: &PslgTriangulation,
    ids: &[PointId],
) -> Result<(Vec<Option<u32>>, BTreeMap<u32, PointId>), SessionError> {
    let mut slots = vec![None; ids.iter().map(|id| id.0 as usize + 1).max().unwrap_or(0)];
    let mut of_slot = BTreeMap::new();
    for (i, (vertex, &id)) in made.vertex_of_point.iter().zip(ids).enumerate() {
        let Some(slot) = vertex.map(|v| v.index() as u32) else { continue };
        slots[id.0 as usize] = Some(slot);
        if let Some(of) = of_slot.insert(slot, id) {
            return Err(SessionError::Duplicate { at: made.graph.points[i], of });
        }
    }
    Ok((slots, of_slot))
}
