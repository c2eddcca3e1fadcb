//! What a mesh must keep of a PSLG's segments.

use super::{finding, points};
use hexdel::geom::certificate::{PlaceCheck, Promise, Promises, Violation, check_promises, features};
use hexdel::geom::segments::{covered, is_on};
use hexdel::geom::{ANGLE_TOLERANCE_DEG, MissingSegment, SegmentCheck, check_segments, quality};
use hexdel::{AngleBounds, Certificate, DVec2, Domain, Mesher, Pslg, TriMesh, pslg};
use hexdel_io::{Promised, PromisedDomain};
use serde::Serialize;
use std::cmp::Ordering;

/// What was found of a PSLG in a mesh.
#[derive(Serialize)]
pub(super) struct OfGraph {
    /// Its segments, each one or, where points lie on it, several.
    segments: SegmentCheck,
    /// Triangles below the bound in a corner where two segments are, too.
    exempt: usize,
    /// What was found of the triangles two edges or more away from points and segments,
    /// if their bounds are known.
    far: Option<PlaceCheck>,
    #[serde(skip)]
    far_bounds: AngleBounds,
}

impl OfGraph {
    /// Holds a mesh against a PSLG. Exempt triangles, and points in holes or
    /// outside, are taken out of the certificate.
    pub(super) fn new(
        mesh: &TriMesh,
        graph: &Pslg,
        promised: Option<&Promised>,
        certificate: &mut Certificate,
    ) -> Self {
        // Of polygons the holes and regions that meshes are made of.
        let prepared = Some(graph).filter(|g| !g.polygons.is_empty());
        let mesher = promised.map_or(Mesher::new(), |p| Mesher::new().domain(domain_of(p.domain)));
        let prepared = prepared.and_then(|graph| mesher.prepared_pslg(graph).ok()).map(|p| p.graph);
        // Places that are merged would have other numbers.
        let prepared = prepared.filter(|p| p.points.starts_with(&graph.points));
        let graph = prepared.as_ref().unwrap_or(graph);
        let domain = Wanted::of(mesh, graph, promised, certificate.bounds.min_deg());
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
        let spare = spare_places(mesh, graph, &domain);
        let (mut exempt, mut outside, mut unused) = (0, 0, 0);
        let bounds = certificate.bounds;
        certificate.violations.retain(|violation| match *violation {
            Violation::AngleBelow { triangle, corner, corners, .. } => {
                let v = mesh.triangles[triangle.index()];
                let sides = [[v[corner], v[(corner + 1) % 3]], [v[corner], v[(corner + 2) % 3]]];
                let is_corner = || {
                    sides.into_iter().all(|side| segments.has_edge(side))
                        || domain.narrow.binary_search_by(|p| order(p, &corners[corner])).is_ok()
                };
                let excused = others_keep(corners, corner, bounds) && is_corner()
                    || keeps_upper(corners, bounds)
                        && domain
                            .wedges
                            .iter()
                            .any(|w| corners.iter().all(|&p| w.iter().any(|&s| is_on(s, p))));
                exempt += usize::from(excused);
                !excused
            }
            Violation::UnusedVertex { vertex } => {
                let at = mesh.vertices[vertex.index()];
                let excused = spare.binary_search_by(|p| order(p, &at)).is_ok();
                unused += usize::from(excused);
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
        certificate.unused_vertices -= unused;
        let far = promised.map(|promised| {
            let with_boundary = promised.domain != PromisedDomain::Hexagon;
            let features =
                features(mesh, &graph.points, &fans(graph, promised), &segments.edges, with_boundary);
            let far = Some((promised.far, &features[..]));
            check_promises(mesh, &Promises { far, ..Promises::default() })
        });
        let far_bounds = promised.map_or(AngleBounds::EXTENDED, |promised| promised.far);
        Self { segments, exempt, far, far_bounds }
    }

    pub(super) fn findings(&self) -> Vec<(bool, String)> {
        let (segments, kept) = (self.segments.segments, self.segments.kept);
        let mut findings = Vec::new();
        if segments > 0 {
            let complete = self.segments.missing.is_empty();
            findings.push((complete, format!("{kept} of {segments} segments are unions of edges")));
        }
        if self.exempt > 0 {
            let n = self.exempt;
            findings.push((true, format!("{n} triangles exempt at corners narrower than the bound")));
        }
        if let Some(far) = self.far.as_ref().filter(|far| far.far > 0) {
            let (n, broken) = (far.far, far.broken.len());
            let bounds = format!("{:.4} to {:.4}", self.far_bounds.min_deg(), self.far_bounds.max_deg());
            findings.push(finding(
                broken == 0,
                format!("{n} triangles two edges from points and segments, within {bounds} degrees"),
                format!("{broken} of {n} triangles two edges from points and segments not within {bounds}"),
            ));
        }
        findings
    }

    /// The missing segments, and the triangles past the far bounds, in words.
    pub(super) fn describe(&self) -> impl Iterator<Item = String> + '_ {
        let segments = self.segments.missing.iter().map(|missing| {
            let MissingSegment { segment, ends, reached, .. } = missing;
            let reached = match reached {
                None => "there is no vertex at its start".to_owned(),
                Some(p) => format!("edges lead only to ({}, {})", p.x, p.y),
            };
            format!("segment {segment} {}: {reached}", points(ends))
        });
        let far = self.far.iter().flat_map(|far| &far.broken).filter_map(|broken| match broken.promise {
            Promise::FarAngle { angle_deg, .. } => {
                let (t, corners) = (broken.triangle.index(), points(&broken.corners));
                Some(format!(
                    "triangle {t} {corners}: {angle_deg} degrees, two edges from points and segments"
                ))
            }
            _ => None,
        });
        segments.chain(far)
    }
}

/// Where vertices need not be in use, as Triangle writes them: at points of the PSLG in holes
/// and outside, and where there is another one that is in use. In order.
fn spare_places(mesh: &TriMesh, graph: &Pslg, domain: &Wanted) -> Vec<DVec2> {
    let carved = graph.points.iter().zip(&domain.carved_points).filter(|(_, carved)| **carved);
    let used = mesh.triangles.iter().flatten().filter_map(|v| mesh.vertices.get(v.index()));
    let mut places: Vec<DVec2> = carved.map(|(&p, _)| p).chain(used.copied()).collect();
    places.sort_by(order);
    places
}

/// The points that may have a fan around them: their neighbours count as points do.
fn fans(graph: &Pslg, promised: &Promised) -> Vec<DVec2> {
    let Ok(valid) = pslg::validate(graph) else { return Vec::new() };
    let points = pslg::fan_points(&valid, extent_of(promised.domain), promised.near).into_iter();
    points.map(|p| graph.points[p as usize]).collect()
}

/// Whether the angles at the other corners are within bounds.
fn others_keep(corners: [DVec2; 3], corner: usize, bounds: AngleBounds) -> bool {
    let angles = quality::angles_deg(corners);
    let least = bounds.min_deg() - ANGLE_TOLERANCE_DEG;
    let most = bounds.max_deg() + ANGLE_TOLERANCE_DEG;
    (0..3).all(|i| i == corner || (least..=most).contains(&angles[i]))
}

fn keeps_upper(corners: [DVec2; 3], bounds: AngleBounds) -> bool {
    quality::angles_deg(corners).into_iter().all(|a| a <= bounds.max_deg() + ANGLE_TOLERANCE_DEG)
}

fn order(p: &DVec2, q: &DVec2) -> Ordering {
    p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y))
}

/// What a mesh covers that was made to cover a domain.
fn extent_of(domain: PromisedDomain) -> pslg::Extent {
    match domain {
        PromisedDomain::Hull => pslg::Extent::Hull,
        PromisedDomain::Inside => pslg::Extent::Inside,
        // In a box, too, only holes are left out.
        PromisedDomain::Hexagon | PromisedDomain::Box => pslg::Extent::Hexagon,
    }
}

fn domain_of(domain: PromisedDomain) -> Domain {
    match domain {
        PromisedDomain::Hexagon => Domain::Hexagon,
        PromisedDomain::Hull => Domain::Hull,
        PromisedDomain::Box => Domain::Box,
        PromisedDomain::Inside => Domain::Inside,
    }
}

/// What a mesh covers that does not say so: the inside if its area does, or more.
fn extent_by_area(mesh: &TriMesh, graph: &pslg::Validated) -> pslg::Extent {
    let areas = graph.areas(pslg::Extent::Inside);
    let inside = areas.of_region.iter().sum::<f64>() + areas.of_none;
    let corners = mesh.triangles.iter().map(|t| t.map(|v| mesh.vertices.get(v.index()).copied()));
    let area = |corners: [Option<DVec2>; 3]| match corners {
        [Some(a), Some(b), Some(c)] => 0.5 * (b - a).perp_dot(c - a),
        _ => 0.0,
    };
    let covered: f64 = corners.map(area).sum();
    if covered <= inside * (1.0 + 1e-9) { pslg::Extent::Inside } else { pslg::Extent::Hexagon }
}

/// What a mesh must have of a PSLG.
struct Wanted {
    /// The segments, divided where points lie on them.
    pieces: Vec<[u32; 2]>,
    segment_of_piece: Vec<usize>,
    /// Whether a piece lies in a hole or outside, and may be missing.
    carved_pieces: Vec<bool>,
    /// Whether a point does.
    carved_points: Vec<bool>,
    /// The points where segments meet at less than the bound, in order: triangles
    /// there may be below it in that corner.
    narrow: Vec<DVec2>,
    /// Pairs of segments between which nothing is asked for.
    wedges: Vec<[[DVec2; 2]; 2]>,
}

impl Wanted {
    fn of(mesh: &TriMesh, graph: &Pslg, promised: Option<&Promised>, least_deg: f64) -> Self {
        let valid = Some(graph).filter(|graph| !graph.segments.is_empty());
        let Some(Ok(valid)) = valid.map(pslg::validate) else {
            // Points alone are vertices wherever they lie. Of other PSLGs the mesh may have been
            // made of what repair made of them; their segments are looked for as they are.
            return Self {
                pieces: graph.segments.clone(),
                segment_of_piece: (0..graph.segments.len()).collect(),
                carved_pieces: vec![false; graph.segments.len()],
                carved_points: vec![false; graph.points.len()],
                narrow: Vec::new(),
                wedges: Vec::new(),
            };
        };
        let promised = promised.map(|promised| extent_of(promised.domain));
        let carved = valid.carved(promised.is_none_or(|extent| extent == pslg::Extent::Inside));
        let extent = promised.unwrap_or_else(|| extent_by_area(mesh, &valid));
        let (segment_of_piece, pieces) = valid.pieces().unzip();
        let corners = pslg::narrow_corners(&valid, extent, least_deg);
        let at = |p: u32| graph.points[p as usize];
        let mut narrow: Vec<DVec2> = corners.iter().map(|c| at(c.point)).collect();
        narrow.sort_by(order);
        let given_up = corners.iter().filter(|c| c.given_up);
        Self {
            pieces,
            segment_of_piece,
            carved_pieces: carved.pieces,
            carved_points: carved.points,
            narrow,
            wedges: given_up.map(|c| c.ends.map(|end| [at(c.point), at(end)])).collect(),
        }
    }
}
