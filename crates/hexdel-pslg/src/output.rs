//! The finished mesh: compact arrays, markers, regions, and what it keeps.

use crate::error::PslgError;
use crate::fans::Scene;
use crate::judge::{FAR_RING, Judge, is_sector};
use crate::limits::Limits;
use crate::locator::Locator;
use crate::net::{Kind, NONE, Net};
use crate::options::{Deadline, SegmentMethod};
use crate::result::{Exception, PslgMesh, Reason, SegmentEdge};
use crate::rings::count_rings;
use crate::sectors::Sectors;
use crate::validate::Validated;
use hexdel_geom::delaunay::restore_constrained_delaunay;
use hexdel_geom::monitor::{Monitor, check};
use hexdel_geom::{
    AngleBounds, CertifyOptions, DVec2, Pslg, TriMesh, TriangleId, VertexId, certify, quality,
    settle_rounding,
};
use rustc_hash::{FxHashMap, FxHashSet};

/// What the mesh was made of.
pub(crate) struct Parts<'a> {
    pub(crate) input: &'a Validated,
    pub(crate) scene: &'a Scene,
    pub(crate) sectors: &'a Sectors,
    pub(crate) judge: Judge<'a>,
    pub(crate) method: SegmentMethod,
    pub(crate) deadline: &'a Deadline,
    pub(crate) limits: Option<&'a Limits<'a>>,
}

/// Makes the result.
pub(crate) fn finish(
    mut net: Net,
    parts: &Parts<'_>,
    retries: u32,
    monitor: &dyn Monitor,
) -> Result<PslgMesh, PslgError> {
    count_rings(&mut net);
    let numbers = Numbers::of(&net);
    let mut mesh = numbers.mesh(&net);
    let edges = edges(&net, parts, &numbers);
    let bound: FxHashSet<[VertexId; 2]> = edges.iter().map(|e| sorted(e.ends)).collect();
    check(monitor)?;
    // What templates make of segments is not Delaunay by design.
    if parts.method != SegmentMethod::Paper {
        settle(&mut net, &mut mesh, parts, &numbers, |ends| !bound.contains(&sorted(ends)));
    }
    let vertex_of_point = numbers.vertex_of_point(parts.input);
    let mut point_of_vertex = vec![None; mesh.vertices.len()];
    for (point, v) in vertex_of_point.iter().enumerate().rev() {
        if let Some(v) = v {
            point_of_vertex[v.index()] = Some(point as u32);
        }
    }
    let (exempt, failed) = exceptions(&net, parts, &numbers);
    let kept: Vec<DVec2> =
        vertex_of_point.iter().zip(&parts.input.pslg.points).filter_map(|(v, &p)| v.map(|_| p)).collect();
    let options = CertifyOptions {
        bounds: parts.judge.near,
        inputs: Some(&kept),
        require_disk: false,
        ..CertifyOptions::default()
    };
    let mut edges_of_segment = vec![0; parts.input.pslg.segments.len()];
    for segment in edges.iter().filter_map(|e| e.segment) {
        edges_of_segment[segment as usize] += 1;
    }
    Ok(PslgMesh {
        certificate: certify(&mesh, &options),
        vertex_markers: vertex_markers(&parts.input.pslg, &edges, &point_of_vertex),
        region_of_triangle: regions(&net, parts.input),
        mesh,
        vertex_of_point,
        point_of_vertex,
        edges,
        edges_of_segment,
        exempt,
        failed,
        method: parts.method,
        retries,
        budget_spent: parts.deadline.is_spent(),
    })
}

/// Moves free vertices by units in the last place and flips edges that segments
/// do not need, so that angles and the Delaunay property suffer no rounding.
/// Where that fails the certificate says so.
fn settle(
    net: &mut Net,
    mesh: &mut TriMesh,
    parts: &Parts<'_>,
    numbers: &Numbers,
    may_flip: impl Fn([VertexId; 2]) -> bool,
) {
    let kind = |v: VertexId| net.vertex(numbers.first[v.index()]).kind;
    let free = |v: VertexId| kind(v) == Kind::Free;
    // What is below the lower bound is so for other reasons.
    if let Ok(upper) = AngleBounds::new(0.0, parts.judge.near.max_deg()) {
        settle_rounding(mesh, upper, free);
    }
    let _ = restore_constrained_delaunay(mesh, parts.judge.near, free, may_flip);
    for (&v, &at) in numbers.first.iter().zip(&mesh.vertices) {
        if net.at(v) != at {
            net.move_to(v, at, net.vertex(v).kind);
        }
    }
    adopt_flips(net, mesh, numbers);
    count_rings(net);
}

/// Makes the flips of the mesh in the net that it came of, triangle by triangle
/// the same.
fn adopt_flips(net: &mut Net, mesh: &TriMesh, numbers: &Numbers) {
    let corners = |net: &Net, t: u32| net.tri(t).v.map(|v| numbers.vertex(v));
    let changed = |&(t, new): &(u32, &[VertexId; 3])| corners(net, t) != *new;
    let changed: Vec<(u32, &[VertexId; 3])> = net.alive().zip(&mesh.triangles).filter(changed).collect();
    // Of the copies of a site, the one that these triangles have.
    let own: FxHashMap<VertexId, u32> =
        changed.iter().flat_map(|&(t, _)| net.tri(t).v).map(|v| (numbers.vertex(v), v)).collect();
    let (old, new): (Vec<u32>, Vec<[u32; 3]>) =
        changed.into_iter().map(|(t, new)| (t, new.map(|v| own[&v]))).unzip();
    net.replace(&old, &new, |_, _| NONE);
}

fn sorted([a, b]: [VertexId; 2]) -> [VertexId; 2] {
    if a <= b { [a, b] } else { [b, a] }
}

/// From the net's numbers to those of the mesh.
struct Numbers {
    /// By vertex of the net; `NONE` if it is gone.
    vertex: Vec<u32>,
    /// By triangle of the net; `NONE` if it is gone.
    triangle: Vec<u32>,
    /// The first vertex of the net for each of the mesh.
    first: Vec<u32>,
    /// The vertex of the net that each site is; `NONE` if it was carved away.
    vertex_of_site: Vec<u32>,
}

impl Numbers {
    fn of(net: &Net) -> Self {
        let mut numbers = Self {
            vertex: vec![NONE; net.vertex_count() as usize],
            triangle: vec![NONE; net.tri_count() as usize],
            first: Vec::new(),
            vertex_of_site: Vec::new(),
        };
        for v in 0..net.vertex_count() {
            let kind = net.vertex(v).kind;
            if kind == Kind::Gone {
                continue;
            }
            if let Kind::Site(site) = kind {
                let site = site as usize;
                if site >= numbers.vertex_of_site.len() {
                    numbers.vertex_of_site.resize(site + 1, NONE);
                }
                // Copies of a site, made where a hole touches itself, are one.
                let same = numbers.vertex_of_site[site];
                if same != NONE {
                    numbers.vertex[v as usize] = numbers.vertex[same as usize];
                    continue;
                }
                numbers.vertex_of_site[site] = v;
            }
            numbers.vertex[v as usize] = numbers.first.len() as u32;
            numbers.first.push(v);
        }
        for (count, t) in net.alive().enumerate() {
            numbers.triangle[t as usize] = count as u32;
        }
        numbers
    }

    fn vertex(&self, v: u32) -> VertexId {
        VertexId::new(self.vertex[v as usize] as usize)
    }

    fn mesh(&self, net: &Net) -> TriMesh {
        TriMesh {
            vertices: self.first.iter().map(|&v| net.at(v)).collect(),
            triangles: net.alive().map(|t| net.tri(t).v.map(|v| self.vertex(v))).collect(),
        }
    }

    fn vertex_of_point(&self, input: &Validated) -> Vec<Option<VertexId>> {
        let of_site = |site: &u32| self.vertex_of_site.get(*site as usize).copied().filter(|&v| v != NONE);
        input.points.site_of_input().iter().map(|site| of_site(site).map(|v| self.vertex(v))).collect()
    }
}

/// The edges of pieces and of the boundary: piece by piece, in their direction,
/// then the rest of the boundary.
fn edges(net: &Net, parts: &Parts<'_>, numbers: &Numbers) -> Vec<SegmentEdge> {
    let mut found: Vec<(u32, f64, [u32; 2], bool)> = Vec::new();
    for t in net.alive() {
        let tri = net.tri(t);
        for i in 0..3 {
            let (n, piece) = (tri.n[i], tri.s[i]);
            let boundary = n == NONE;
            if !boundary && (!net.is_border(t, i) || n < t) {
                continue;
            }
            let [a, b] = tri.edge(i);
            if piece == NONE {
                found.push((piece, f64::from(t), [a, b], boundary));
                continue;
            }
            let [ta, tb] = [a, b].map(|v| net.fraction_of(v, piece));
            let ends = if ta < tb { [a, b] } else { [b, a] };
            found.push((piece, ta.min(tb), ends, boundary));
        }
    }
    found.sort_by(|x, y| x.0.cmp(&y.0).then(x.1.total_cmp(&y.1)));
    let markers = &parts.input.pslg.segment_markers;
    found
        .into_iter()
        .map(|(piece, _, ends, boundary)| {
            let segment = parts.scene.pieces.get(piece as usize).map(|p| p.segment).filter(|&s| s != NONE);
            let marker = segment.and_then(|s| markers.get(s as usize)).copied().unwrap_or(0);
            let marker = if marker == 0 { i32::from(boundary) } else { marker };
            SegmentEdge { ends: ends.map(|v| numbers.vertex(v)), segment, marker, boundary }
        })
        .collect()
}

/// A marker of each vertex of a mesh of a PSLG, as of
/// [`PslgMesh::vertex_markers`], given the mesh's edges on segments and the
/// boundary and for each vertex the point that it is.
pub fn vertex_markers(pslg: &Pslg, edges: &[SegmentEdge], point_of_vertex: &[Option<u32>]) -> Vec<i32> {
    let given = &pslg.point_markers;
    let own = |p: &Option<u32>| p.and_then(|p| given.get(p as usize)).copied().unwrap_or(0);
    let mut markers: Vec<i32> = point_of_vertex.iter().map(own).collect();
    let segment_markers = &pslg.segment_markers;
    let of_segment = |e: &SegmentEdge| e.segment.and_then(|s| segment_markers.get(s as usize)).copied();
    for (e, marker) in edges.iter().map(|e| (e, of_segment(e).unwrap_or(0))) {
        for v in e.ends {
            if markers[v.index()] == 0 {
                markers[v.index()] = marker;
            }
        }
    }
    for v in edges.iter().filter(|e| e.boundary).flat_map(|e| e.ends) {
        if markers[v.index()] == 0 {
            markers[v.index()] = 1;
        }
    }
    markers
}

/// The region that each triangle lies in; of two in the same part of the plane
/// the first.
fn regions(net: &Net, input: &Validated) -> Vec<Option<u32>> {
    if input.pslg.regions.is_empty() {
        return vec![None; net.alive().count()];
    }
    let plane = Locator::of(input);
    let regions = plane.regions(&input.pslg.regions);
    let [min, max] = [0, 2].map(|corner| input.plane.at(corner));
    let region_at = |t: u32| {
        let [a, b, c] = net.corners(t);
        // What lies beyond the plane's rectangle is one with what is at its rim.
        let centroid = ((a + b + c) / 3.0).clamp(min, max);
        plane.triangle_at(centroid).and_then(|t| regions[t as usize])
    };
    net.alive().map(region_at).collect()
}

/// The triangles that do not keep their bounds: those that a corner of the
/// input excuses, and the others, with those larger or longer than allowed.
fn exceptions(net: &Net, parts: &Parts<'_>, numbers: &Numbers) -> (Vec<Exception>, Vec<Exception>) {
    let least = parts.judge.near.min_deg();
    let entry = |t: u32, reason: Reason| {
        let corners = net.corners(t);
        let angles = quality::angles_deg(corners);
        let [min, max] =
            [angles.iter().copied().fold(360.0, f64::min), angles.iter().copied().fold(0.0, f64::max)];
        let at = (corners[0] + corners[1] + corners[2]) / 3.0;
        let triangle = TriangleId::new(numbers.triangle[t as usize] as usize);
        Exception { triangle, at, angles_deg: [min, max], reason }
    };
    let point = |site: u32| parts.scene.input_of_site[site as usize];
    let failed = net.alive().filter(|&t| parts.judge.is_out(net, t));
    let failed = failed.map(|t| {
        let is_near = || net.tri(t).v.iter().any(|&v| net.vertex(v).ring < FAR_RING);
        if parts.method == SegmentMethod::Paper && is_near() {
            return entry(t, Reason::Template);
        }
        let near = parts.sectors.near(net.corners(t));
        let reason = near.map_or(Reason::Unsolved, |(sector, distance)| Reason::NearSector {
            point: point(sector.site),
            angle_deg: sector.angle_deg,
            distance,
        });
        entry(t, reason)
    });
    let mut failed: Vec<Exception> = failed.collect();
    let large: FxHashSet<u32> = parts.limits.iter().flat_map(|limits| limits.exceeded(net)).collect();
    failed.extend(
        net.alive()
            .filter(|t| large.contains(t) && !parts.judge.is_out(net, *t))
            .filter_map(|t| Some(entry(t, parts.limits?.exceeded_by(net.corners(t))?))),
    );
    let narrow = |t: u32| {
        let (sector, _) = parts.sectors.near(net.corners(t))?;
        Some(Reason::Sector { point: point(sector.site), angle_deg: sector.angle_deg })
    };
    let sector = |t: u32| {
        let angles = quality::angles_deg(net.corners(t));
        (0..3)
            .find_map(|i| match net.vertex(net.tri(t).v[i]).kind {
                Kind::Site(site) if angles[i] < least && is_sector(net, t, i) => {
                    Some(Reason::Sector { point: point(site), angle_deg: angles[i] })
                }
                _ => None,
            })
            .or_else(|| if angles.iter().any(|&a| a < least - 1e-6) { narrow(t) } else { None })
    };
    let exempt = net
        .alive()
        .filter(|&t| !parts.judge.is_out(net, t) && !large.contains(&t))
        .filter_map(|t| sector(t).map(|reason| entry(t, reason)))
        .collect();
    (exempt, failed)
}
