//! Whether every segment in the domain is a union of edges, found out anew from
//! coordinates and indices.

use super::Domain;
use hexdel_geom::{Pslg, SegmentCheck, VertexId, check_segments};
use hexdel_pslg::{Divided, PslgMesh};

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
