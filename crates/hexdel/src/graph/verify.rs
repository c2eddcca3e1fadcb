//! What a finished mesh keeps, found out anew from coordinates and indices.

use super::Domain;
use hexdel_geom::certificate::Violation;
use hexdel_geom::{CertifyOptions, Pslg, SegmentCheck, TriangleId, certify, check_segments, quality};
use hexdel_pslg::{Exception, PslgMesh, Reason, Validated};
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
            let reason = Reason::Unsolved;
            made.failed.push(Exception { triangle, at, angles_deg, reason });
        }
    }
}

/// Checks the segments of a graph, piece by piece between the points on them,
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
    // What comes after the graph's own is the box.
    let own =
        validated.pieces().zip(carved.pieces).filter(|((s, _), carved)| *s < graph.segments.len() && !carved);
    let (segment_of_piece, pieces): (Vec<usize>, Vec<[u32; 2]>) = own.map(|(piece, _)| piece).unzip();
    let mut found = check_segments(&made.mesh, &graph.points, &pieces);
    for missing in &mut found.missing {
        missing.segment = segment_of_piece[missing.segment];
    }
    found
}
