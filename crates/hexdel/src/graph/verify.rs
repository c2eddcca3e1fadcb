//! What a finished mesh keeps, found out anew from coordinates and indices.

use super::Domain;
use hexdel_geom::certificate::Violation;
use hexdel_geom::{
    CertifyOptions, Pslg, SegmentCheck, TriangleId, VertexId, certify, check_segments, quality,
};
use hexdel_pslg::{Divided, Exception, PslgMesh, Reason};
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
    let listed: BTreeSet<TriangleId> =
        made.exempt.iter().chain(&made.failed).filter(|e| is_of(e, made)).map(|e| e.triangle).collect();
    for violation in certify(&made.mesh, &options).violations {
        let (Violation::AngleBelow { triangle, corners, .. }
        | Violation::AngleAbove { triangle, corners, .. }) = violation
        else {
            continue;
        };
        if !listed.contains(&triangle) {
            let angles = quality::angles_deg(corners);
            let at = (corners[0] + corners[1] + corners[2]) / 3.0;
            let angles_deg =
                [angles.iter().copied().fold(360.0, f64::min), angles.iter().copied().fold(0.0, f64::max)];
            made.failed.push(Exception { triangle, at, angles_deg, reason: Reason::Unsolved });
        }
    }
}

/// Whether an exception is about the triangle it names, as it is now.
fn is_of(exception: &Exception, made: &PslgMesh) -> bool {
    let [a, b, c] = made.mesh.corners(exception.triangle);
    exception.at == (a + b + c) / 3.0
}

/// Checks the segments of a graph, piece by piece between the points on them.
/// A piece may be missing as a whole where holes or the outside were left away.
pub(super) fn segments(made: &PslgMesh, graph: &Pslg, divided: &[Divided], domain: Domain) -> SegmentCheck {
    let carved = domain == Domain::Inside || !graph.holes.is_empty();
    let mut begun: Vec<(u32, VertexId)> =
        made.edges.iter().filter_map(|e| Some((e.segment?, e.ends[0]))).collect();
    begun.sort_unstable();
    let mut pieces: Vec<[u32; 2]> = Vec::new();
    let mut segment_of_piece: Vec<usize> = Vec::new();
    let mut divided = divided.iter().peekable();
    for (segment, &[a, b]) in graph.segments.iter().enumerate() {
        let mut from = a;
        loop {
            let stop = divided.next_if(|d| d.segment == segment).map(|d| d.point as u32);
            let to = stop.unwrap_or(b);
            let start = made.vertex_of_point[from as usize];
            let begins = start.is_some_and(|v| begun.binary_search(&(segment as u32, v)).is_ok());
            if begins || !carved {
                pieces.push([from, to]);
                segment_of_piece.push(segment);
            }
            if stop.is_none() {
                break;
            }
            from = to;
        }
    }
    let mut found = check_segments(&made.mesh, &graph.points, &pieces);
    for missing in &mut found.missing {
        missing.segment = segment_of_piece[missing.segment];
    }
    found
}
