//! What a finished mesh keeps, found out anew from coordinates and indices.

use super::Domain;
use crate::size::Size;
use hexdel_geom::certificate::{PlaceCheck, Promise, Promises, Violation, check_promises, features};
use hexdel_geom::segments::faces;
use hexdel_geom::{
    CertifyOptions, DVec2, PointSet, Pslg, SegmentCheck, TriangleId, certify, check_segments, quality,
    smallest_enclosing_circle,
};
use hexdel_optimize::Sizing;
use hexdel_pslg::{Exception, Options, PslgMesh, Reason, Validated, fan_points};
use std::collections::BTreeSet;

/// Lists every triangle that the certificate finds out of bounds and the mesher
/// has said nothing of.
pub(super) fn list_all(made: &mut PslgMesh) {
    if made.certificate.out_of_bounds == 0 {
        return;
    }
    let options = CertifyOptions {
        bounds: made.certificate.bounds,
        max_violations: usize::MAX,
        ..CertifyOptions::default()
    };
    let listed: BTreeSet<TriangleId> = made.exempt.iter().chain(&made.failed).map(|e| e.triangle).collect();
    let mut found = Vec::new();
    for violation in certify(&made.mesh, &options).violations {
        let (Violation::AngleBelow { triangle, corners, .. }
        | Violation::AngleAbove { triangle, corners, .. }) = violation
        else {
            continue;
        };
        if !listed.contains(&triangle) {
            found.push(exception(triangle, corners, Reason::Unsolved));
        }
    }
    made.failed.extend(found);
}

fn exception(triangle: TriangleId, corners: [DVec2; 3], reason: Reason) -> Exception {
    let angles = quality::angles_deg(corners);
    let angles_deg =
        [angles.iter().copied().fold(360.0, f64::min), angles.iter().copied().fold(0.0, f64::max)];
    Exception { triangle, at: (corners[0] + corners[1] + corners[2]) / 3.0, angles_deg, reason }
}

/// Checks what is promised by place: the bounds of triangles two edges away from points
/// and segments, areas and lengths. What is not kept and not listed is listed.
pub(super) fn places(
    made: &mut PslgMesh,
    segments: &SegmentCheck,
    input: &Meshed<'_>,
    options: &Options,
) -> PlaceCheck {
    let Meshed { graph, domain, size, .. } = *input;
    let mesh = &made.mesh;
    // The vertices around a point with a fan count as points do.
    let fans = fan_points(input.validated, domain.extent(), options.near);
    let fans: Vec<DVec2> = fans.into_iter().map(|p| input.validated.pslg().points[p as usize]).collect();
    let features = features(mesh, &graph.points, &fans, &segments.edges, domain != Domain::Hexagon);
    let max_area = areas(mesh, segments, input, options);
    let max_edge = |p: DVec2| size.map_or(f64::INFINITY, |size| size.at(p));
    let promises = Promises {
        far: Some((options.far, &features)),
        max_area: max_area.as_ref().map(|limit| limit as _),
        max_edge: size.map(|_| &max_edge as _),
    };
    let found = check_promises(mesh, &promises);
    let listed: BTreeSet<TriangleId> = made.failed.iter().map(|e| e.triangle).collect();
    let missing = found.broken.iter().filter(|broken| !listed.contains(&broken.triangle));
    let missing: Vec<Exception> = missing
        .map(|broken| {
            let reason = match broken.promise {
                Promise::Area { area, limit } => Reason::TooLarge { area, limit },
                Promise::Edge { length, limit } => Reason::TooLong { length, limit },
                _ => Reason::Unsolved,
            };
            exception(broken.triangle, broken.corners, reason)
        })
        .collect();
    made.failed.extend(missing);
    found
}

/// What was meshed.
#[derive(Clone, Copy)]
pub(super) struct Meshed<'a> {
    pub(super) graph: &'a Pslg,
    /// With the box, if there is one.
    pub(super) validated: &'a Validated,
    pub(super) domain: Domain,
    pub(super) size: Option<&'a Size>,
}

/// The largest area of each triangle: that of its region, found anew in the mesh, and,
/// in the circle around the PSLG, that of the options. None without any limit.
fn areas(
    mesh: &hexdel_geom::TriMesh,
    segments: &SegmentCheck,
    input: &Meshed<'_>,
    options: &Options,
) -> Option<impl Fn(TriangleId, DVec2) -> f64 + Sync + use<>> {
    let regions = &input.graph.regions;
    if options.max_area.is_none() && regions.iter().all(|r| r.max_area.is_none()) {
        return None;
    }
    let seeds: Vec<DVec2> = regions.iter().map(|r| r.point).collect();
    let limit = |face: Option<u32>| face.and_then(|r| regions[r as usize].max_area).unwrap_or(f64::INFINITY);
    let of_region: Vec<f64> = faces(mesh, &segments.edges, &seeds).into_iter().map(limit).collect();
    let points = PointSet::new(&input.validated.pslg().points).ok()?;
    let circle = smallest_enclosing_circle(points.sites())?;
    let everywhere = options.max_area.unwrap_or(f64::INFINITY);
    Some(move |t: TriangleId, centroid: DVec2| {
        if centroid.distance(circle.center) > circle.radius {
            return f64::INFINITY;
        }
        everywhere.min(of_region[t.index()])
    })
}

/// Checks the segments of a PSLG, piece by piece between the points on them,
/// those in holes and outside of the domain left out.
pub(super) fn segments(
    made: &mut PslgMesh,
    graph: &Pslg,
    validated: &Validated,
    domain: Domain,
) -> SegmentCheck {
    let carved = validated.carved(domain == Domain::Inside);
    let lost = made.vertex_of_point.iter().zip(&carved.points).filter(|(v, carved)| v.is_none() && !**carved);
    made.certificate.inputs += lost.count();
    // What comes after the PSLG's own is the box.
    let own =
        validated.pieces().zip(carved.pieces).filter(|((s, _), carved)| *s < graph.segments.len() && !carved);
    let (segment_of_piece, pieces): (Vec<usize>, Vec<[u32; 2]>) = own.map(|(piece, _)| piece).unzip();
    let mut found = check_segments(&made.mesh, &graph.points, &pieces);
    for missing in &mut found.missing {
        missing.segment = segment_of_piece[missing.segment];
    }
    found
}
