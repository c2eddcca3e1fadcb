//! A rectangle around a PSLG, as four segments more.
//!
//! They come last, so that the PSLG's own points and segments keep their
//! numbers, and are forgotten when the mesh is made.

use hexdel_geom::{DVec2, Pslg};
use hexdel_pslg::PslgMesh;

/// The margin over the longer side.
const MARGIN: f64 = 0.1;

/// The PSLG in its box.
pub(super) fn with_box(graph: &Pslg) -> Pslg {
    let mut boxed = graph.clone();
    let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (min, max) = graph.points.iter().fold(start, |(min, max), &p| (min.min(p), max.max(p)));
    let longer = (max - min).max_element();
    // A single point has no size: any will do.
    let margin = if longer > 0.0 { MARGIN * longer } else { 1.0 };
    if !margin.is_finite() {
        // Without points, or with some that are not finite: an error later.
        return boxed;
    }
    let (min, max) = (min - margin, max + margin);
    let first = graph.points.len() as u32;
    boxed.points.extend([min, DVec2::new(max.x, min.y), max, DVec2::new(min.x, max.y)]);
    boxed.point_attributes.extend(std::iter::repeat_n(0.0, 4 * graph.attributes_per_point));
    boxed.segments.extend((0..4).map(|i| [first + i, first + (i + 1) % 4]));
    if !graph.point_markers.is_empty() {
        boxed.point_markers.extend([1; 4]);
    }
    if !graph.segment_markers.is_empty() {
        boxed.segment_markers.extend([1; 4]);
    }
    boxed
}

/// Leaves of a mesh's arrays what is about the PSLG without its box.
pub(super) fn forget_box(made: &mut PslgMesh, graph: &Pslg) {
    let (points, segments) = (graph.points.len(), graph.segments.len());
    // The box may lie in a hole, as a whole: then it has no vertices.
    let corners = made.vertex_of_point[points..].iter().flatten().count();
    made.vertex_of_point.truncate(points);
    for point in &mut made.point_of_vertex {
        *point = point.filter(|&p| (p as usize) < points);
    }
    made.edges_of_segment.truncate(segments);
    for edge in &mut made.edges {
        edge.segment = edge.segment.filter(|&s| (s as usize) < segments);
    }
    made.certificate.inputs -= corners;
    // One that is missing stays missing.
    made.certificate.inputs_kept = made.certificate.inputs_kept.saturating_sub(corners);
}
