//! What a mesh must keep of a graph's segments.

use super::finding;
use hexdel::geom::certificate::Violation;
use hexdel::geom::segments::covered;
use hexdel::geom::{ANGLE_TOLERANCE_DEG, MissingSegment, SegmentCheck, check_segments, quality};
use hexdel::{Certificate, DVec2, Pslg, TriMesh, pslg};
use serde::Serialize;

/// What was found of a graph in a mesh.
#[derive(Serialize)]
pub(super) struct OfGraph {
    /// Its segments, each one or, where points lie on it, several.
    segments: SegmentCheck,
    /// Triangles with an angle below the bound that two segments make.
    exempt: usize,
}

impl OfGraph {
    /// Holds a mesh against a graph. Exempt triangles, and points in holes or
    /// outside, are taken out of the certificate.
    pub(super) fn new(mesh: &TriMesh, graph: &Pslg, certificate: &mut Certificate) -> Self {
        let domain = Wanted::of(graph);
        let mut segments = check_segments(mesh, &graph.points, &domain.pieces);
        let midpoints: Vec<DVec2> = segments.missing.iter().map(|m| m.ends[0].midpoint(m.ends[1])).collect();
        let mut covers = covered(mesh, &midpoints).into_iter();
        let before = segments.missing.len();
        segments.missing.retain(|m| covers.next() == Some(true) || !domain.carved_pieces[m.segment]);
        segments.segments -= before - segments.missing.len();
        for missing in &mut segments.missing {
            missing.segment = domain.segment_of_piece[missing.segment];
        }

        let absent = certificate.violations.iter().filter_map(|violation| match *violation {
            Violation::InputMissing { input, .. } if domain.carved_points[input] => Some(input),
            _ => None,
        });
        let absent: Vec<usize> = absent.collect();
        let places: Vec<DVec2> = absent.iter().map(|&input| graph.points[input]).collect();
        let covers = covered(mesh, &places);
        let is_outside = |input| absent.binary_search(&input).is_ok_and(|at| !covers[at]);
        let mut exempt = 0;
        let mut outside = 0;
        certificate.violations.retain(|violation| match *violation {
            Violation::AngleBelow { triangle, corner, corners, .. } => {
                let v = mesh.triangles[triangle.index()];
                let sides = [[v[corner], v[(corner + 1) % 3]], [v[corner], v[(corner + 2) % 3]]];
                let excused = sides.into_iter().all(|side| segments.has_edge(side))
                    && others_keep(corners, corner, certificate.bounds);
                exempt += usize::from(excused);
                !excused
            }
            Violation::InputMissing { input, .. } => {
                let excused = is_outside(input);
                outside += usize::from(excused);
                !excused
            }
            _ => true,
        });
        certificate.out_of_bounds -= exempt;
        certificate.inputs -= outside;
        Self { segments, exempt }
    }

    /// Whether the mesh is what it should be.
    pub(super) fn holds(&self, c: &Certificate) -> bool {
        let broken =
            c.malformed + c.not_finite + c.not_counter_clockwise + c.repeated_edges + c.unused_vertices;
        broken + c.out_of_bounds == 0
            && c.triangles > 0
            && c.delaunay
            && c.inputs_kept == c.inputs
            && self.segments.missing.is_empty()
    }

    /// What takes the place of being a disk.
    pub(super) fn findings(&self, c: &Certificate) -> Vec<(bool, String)> {
        let (segments, kept) = (self.segments.segments, self.segments.kept);
        let mut findings = vec![
            finding(
                c.repeated_edges + c.unused_vertices == 0 && c.triangles > 0,
                format!(
                    "{} boundary loops, Euler characteristic {}",
                    c.boundary_loops, c.euler_characteristic
                ),
                format!("{} edges repeated, {} vertices unused", c.repeated_edges, c.unused_vertices),
            ),
            (self.segments.missing.is_empty(), format!("{kept} of {segments} segments are unions of edges")),
        ];
        if self.exempt > 0 {
            let n = self.exempt;
            findings.push((true, format!("{n} triangles exempt in corners narrower than the bound")));
        }
        findings
    }

    /// The missing segments in words.
    pub(super) fn describe(&self) -> impl Iterator<Item = String> + '_ {
        self.segments.missing.iter().map(|MissingSegment { segment, ends: [a, b], reached, .. }| {
            let reached = match reached {
                None => "no vertex at its start".to_owned(),
                Some(p) => format!("edges lead to ({}, {}) only", p.x, p.y),
            };
            format!("segment {segment} ({}, {}) ({}, {}): {reached}", a.x, a.y, b.x, b.y)
        })
    }
}

/// Whether the angles at the other corners are within bounds.
fn others_keep(corners: [DVec2; 3], corner: usize, bounds: hexdel::AngleBounds) -> bool {
    let angles = quality::angles_deg(corners);
    let least = bounds.min_deg() - ANGLE_TOLERANCE_DEG;
    let most = bounds.max_deg() + ANGLE_TOLERANCE_DEG;
    (0..3).all(|i| i == corner || (least..=most).contains(&angles[i]))
}

/// What a mesh must have of a graph.
struct Wanted {
    /// The segments, divided where points lie on them.
    pieces: Vec<[u32; 2]>,
    segment_of_piece: Vec<usize>,
    /// Whether a piece lies in a hole or outside, and may be missing.
    carved_pieces: Vec<bool>,
    /// Whether a point does.
    carved_points: Vec<bool>,
}

impl Wanted {
    fn of(graph: &Pslg) -> Self {
        let Ok(valid) = pslg::validate(graph) else {
            // The mesh may have been made of what repair made of the graph; its
            // segments are looked for as they are.
            return Self {
                pieces: graph.segments.clone(),
                segment_of_piece: (0..graph.segments.len()).collect(),
                carved_pieces: vec![false; graph.segments.len()],
                carved_points: vec![false; graph.points.len()],
            };
        };
        let carved = valid.carved(true);
        let (segment_of_piece, pieces) = valid.pieces().unzip();
        Self { pieces, segment_of_piece, carved_pieces: carved.pieces, carved_points: carved.points }
    }
}
