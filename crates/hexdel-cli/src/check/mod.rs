//! `hexdel check`: what can be said of a mesh, whoever made it.

mod graph;

use crate::exit::{Outcome, Verdict, print};
use crate::input::{Formats, read_graph, read_mesh_data};
use graph::OfGraph;
use hexdel::geom::certificate::Violation;
use hexdel::geom::{ANGLE_TOLERANCE_DEG, BoundsError, CertifyOptions, certify, quality};
use hexdel::{AngleBounds, Certificate, DVec2, TriMesh};
use hexdel_io::MeshData;
use serde::Serialize;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Violations that are shown to a reader; JSON has the first hundred.
const SHOWN: usize = 10;

/// Check a mesh: angles, Delaunay, topology, input points and segments
#[derive(clap::Args)]
#[command(after_help = "\
    By default angles are checked against the bounds in the file, or only reported if it has none.\n\
    The Delaunay property and orientations are decided exactly. Exit status 1 if a check fails.\n\n\
    Each segment of the input must be a union of edges, unless it lies in a hole or\n\
    outside. Corners narrower than the smallest angle are exempt, and holes may be\n\
    anywhere.\n\n\
    Examples:\n  \
    hexdel check mesh.ele --input letters.poly\n  \
    hexdel check mesh.ele --min-angle 20 --max-angle 140 --json")]
pub(crate) struct Args {
    /// Mesh in any readable format, such as .ele (with its .node), .vtu or .msh
    mesh: PathBuf,
    /// File of points that must be vertices, bit for bit, and segments
    #[arg(long, value_name = "FILE")]
    input: Option<PathBuf>,
    /// Smallest angle, degrees [default: the file's; 0 with --max-angle]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    min_angle: Option<f64>,
    /// Largest angle, degrees [default: the file's; 90 with --min-angle]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    max_angle: Option<f64>,
    #[command(flatten)]
    formats: Formats,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Findings<'a> {
    holds: bool,
    #[serde(flatten)]
    certificate: &'a Certificate,
    #[serde(flatten)]
    of_graph: Option<&'a OfGraph>,
}

/// Violations that JSON has.
const LISTED: usize = 100;

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    let of_input = args.formats.beside(&args.mesh, args.input.as_deref())?;
    let input = args.input.as_deref().map(|path| read_graph(path, &of_input)).transpose()?;
    let input = input.map(|file| file.pslg);
    let MeshData { mesh, promised, .. } = read_mesh_data(&args.mesh, &args.formats)?;
    let asked = args.asked()?;
    let has_segments = input.as_ref().is_some_and(|input| !input.segments.is_empty());
    // Points alone have a far bound of their own in other domains than the hexagon.
    let has_far = asked.is_none() && promised.as_ref().is_some_and(|p| p.near != p.far);
    let graph = input.as_ref().filter(|_| has_segments || has_far);
    let known = asked.or(promised.as_ref().map(|promised| promised.near));
    let options = CertifyOptions {
        bounds: known.map_or(AngleBounds::new(0.0, 180.0), Ok)?,
        inputs: input.as_ref().map(|input| input.points.as_slice()),
        require_disk: false,
        // Which of them are exempt remains to be seen.
        max_violations: usize::MAX,
        ..CertifyOptions::default()
    };
    let mut certificate = certify(&mesh, &options);
    // Without segments the file is believed. As Triangle does it, points may be vertices
    // without triangles.
    let spare = promised.is_some() && !has_segments;
    let promised = promised.filter(|_| asked.is_none());
    let believed = promised.as_ref().filter(|_| !has_segments).map_or(&[][..], |p| &p.exempt);
    let exempt = excuse(&mut certificate, &mesh, believed);
    let of_graph = graph.map(|graph| OfGraph::new(&mesh, graph, promised.as_ref(), &mut certificate));
    certificate.violations.truncate(LISTED);
    let found = Found {
        certificate,
        of_graph,
        exempt,
        spare,
        has_bounds: known.is_some(),
        has_input: input.is_some(),
    };
    let holds = found.holds();
    let text = if args.json {
        let findings = Findings { holds, certificate: &found.certificate, of_graph: found.of_graph.as_ref() };
        serde_json::to_string_pretty(&findings)? + "\n"
    } else {
        readable(&args.mesh.display().to_string(), &found)
    };
    print(&text)?;
    Ok(if holds { Verdict::Holds } else { Verdict::Fails })
}

impl Args {
    /// The bounds asked for, if any are.
    fn asked(&self) -> Result<Option<AngleBounds>, BoundsError> {
        if self.min_angle.is_none() && self.max_angle.is_none() {
            return Ok(None);
        }
        let least = self.min_angle.unwrap_or(0.0);
        AngleBounds::new(least, self.max_angle.unwrap_or(AngleBounds::EXTENDED.max_deg())).map(Some)
    }
}

/// Takes triangles below the bound out of the certificate that their file says are
/// exempt. How many there are.
fn excuse(certificate: &mut Certificate, mesh: &TriMesh, exempt: &[u32]) -> usize {
    let listed: BTreeSet<usize> = exempt.iter().map(|&t| t as usize).collect();
    let before = certificate.violations.len();
    let most = certificate.bounds.max_deg() + ANGLE_TOLERANCE_DEG;
    certificate.violations.retain(|violation| match *violation {
        Violation::AngleBelow { triangle, .. } => {
            let angles = quality::angles_deg(mesh.corners(triangle));
            !listed.contains(&triangle.index()) || angles.into_iter().any(|a| a > most)
        }
        _ => true,
    });
    let excused = before - certificate.violations.len();
    certificate.out_of_bounds -= excused;
    excused
}

/// All that was found.
struct Found {
    certificate: Certificate,
    of_graph: Option<OfGraph>,
    /// Triangles that are exempt because the file says so.
    exempt: usize,
    /// Whether vertices may be in no triangle.
    spare: bool,
    /// Whether angles are held against any bounds.
    has_bounds: bool,
    has_input: bool,
}

impl Found {
    /// Vertices in no triangle, where that is a fault.
    fn unused(&self) -> usize {
        if self.spare { 0 } else { self.certificate.unused_vertices }
    }

    /// Whether every finding is good: the report and the verdict say the same.
    fn holds(&self) -> bool {
        findings(self).iter().all(|(good, _)| *good)
    }
}

/// One line per finding, then the first violations.
fn readable(name: &str, found: &Found) -> String {
    let c = &found.certificate;
    let mut text = format!("{name}: {} vertices, {} triangles\n", c.vertices, c.triangles);
    for (good, finding) in findings(found) {
        // Writing to a string does not fail.
        let _ = writeln!(text, "  {}  {finding}", if good { "ok  " } else { "FAIL" });
    }
    let _ = writeln!(
        text,
        "        shortest edge {}, largest aspect ratio {:.4}",
        c.shortest_edge, c.max_aspect_ratio
    );
    let is_fault = |v: &&Violation| !found.spare || !matches!(v, Violation::UnusedVertex { .. });
    let mut violations: Vec<String> = c.violations.iter().filter(is_fault).map(describe).collect();
    violations.extend(found.of_graph.iter().flat_map(OfGraph::describe));
    for violation in violations.iter().take(SHOWN) {
        let _ = writeln!(text, "  - {violation}");
    }
    if violations.len() > SHOWN {
        let _ = writeln!(text, "  - and more");
    }
    if !found.has_input {
        let _ = writeln!(text, "  --input FILE also checks that its points and segments are in the mesh");
    }
    let _ = writeln!(text, "{}", if found.holds() { "holds" } else { "does not hold" });
    text
}

/// What was asked for, each with whether it is so.
fn findings(found: &Found) -> Vec<(bool, String)> {
    let c = &found.certificate;
    let broken = c.malformed + c.not_finite + c.not_counter_clockwise;
    // A triangle the wrong way round has negative angles.
    let beyond = c.out_of_bounds + c.not_counter_clockwise;
    let angles = format!("angles {:.4} to {:.4}", c.min_angle_deg, c.max_angle_deg);
    let bounds = if found.has_bounds {
        format!("{:.4} to {:.4} degrees", c.bounds.min_deg(), c.bounds.max_deg())
    } else {
        "0 to 180 degrees: no bounds are known; --min-angle sets some".to_owned()
    };
    let mut findings = vec![
        finding(
            beyond == 0,
            format!("{angles}, within {bounds}"),
            format!("{angles}: {beyond} triangles not within {bounds}"),
        ),
        finding(
            broken == 0,
            "all counter-clockwise",
            format!("{broken} triangles flat, clockwise or broken"),
        ),
        finding(c.delaunay, "Delaunay", format!("not Delaunay: {} edges", c.non_delaunay_edges)),
        topology(found),
    ];
    if let Some(of_graph) = &found.of_graph {
        findings.extend(of_graph.findings());
    }
    if found.exempt > 0 {
        let n = found.exempt;
        findings
            .push((true, format!("{n} triangles exempt, the file says, at corners narrower than the bound")));
    }
    if let Some(bound) = c.max_aspect_bound {
        findings.push(finding(
            c.stretched_triangles == 0,
            format!("aspect ratios at most {bound:.5}, as the angles imply"),
            format!("{} triangles with aspect ratios that the angle bounds rule out", c.stretched_triangles),
        ));
    }
    if let Some(below) = c.below_exact_bound.filter(|below| *below > c.out_of_bounds) {
        findings.push((true, format!("{below} triangles below atan(5 / (3 sqrt 3)), 43.897886 degrees")));
    }
    if c.rounding_limited > 0 {
        let excess = c.worst_rounding_excess_deg;
        let n = c.rounding_limited;
        findings.push((
            true,
            format!("{n} triangles past a bound by rounding alone, at most {excess:.1e} degrees"),
        ));
    }
    if c.inputs > 0 {
        let kept = c.inputs_kept == c.inputs;
        findings.push((kept, format!("{} of {} input points are vertices", c.inputs_kept, c.inputs)));
    }
    findings
}

/// How the triangles hang together.
fn topology(found: &Found) -> (bool, String) {
    let c = &found.certificate;
    let sound = c.repeated_edges + found.unused() == 0 && c.triangles > 0;
    let shape = if c.disk {
        "one disk".to_owned()
    } else {
        format!("{} boundary loops, Euler characteristic {}", c.boundary_loops, c.euler_characteristic)
    };
    let faults = match c.triangles {
        0 => "no triangles".to_owned(),
        _ => format!("{} edges repeated, {} vertices unused", c.repeated_edges, c.unused_vertices),
    };
    finding(sound, shape, faults)
}

fn finding(good: bool, yes: impl Into<String>, no: impl Into<String>) -> (bool, String) {
    (good, if good { yes.into() } else { no.into() })
}

/// A violation in words, ids counted from 0.
fn describe(violation: &Violation) -> String {
    use Violation as V;
    match violation {
        V::CornerOutOfRange { triangle, vertex, .. } => {
            format!("triangle {}: no vertex {}", triangle.index(), vertex.index())
        }
        V::RepeatedCorner { triangle, vertex } => {
            format!("triangle {}: vertex {} twice", triangle.index(), vertex.index())
        }
        V::CornerNotFinite { triangle, vertex } => {
            format!("triangle {}: vertex {} is not finite", triangle.index(), vertex.index())
        }
        V::NotCounterClockwise { triangle, corners } => {
            format!("triangle {} {}: clockwise or flat", triangle.index(), points(corners))
        }
        V::AngleBelow { triangle, angle_deg, corners, .. }
        | V::AngleAbove { triangle, angle_deg, corners, .. } => {
            format!("triangle {} {}: {angle_deg} degrees", triangle.index(), points(corners))
        }
        V::AspectAbove { triangle, aspect_ratio, corners } => {
            format!("triangle {} {}: an aspect ratio of {aspect_ratio}", triangle.index(), points(corners))
        }
        V::EdgeTooShort { triangle, length, .. } => {
            format!("triangle {}: an edge of length {length}", triangle.index())
        }
        V::RepeatedEdge { triangle, edge, ends } => {
            let [a, b] = edge.map(hexdel::VertexId::index);
            format!("triangle {}: edge {a} {b} {} again", triangle.index(), points(ends))
        }
        V::BranchingVertex { vertex, at } => {
            format!("vertex {} {}: its triangles form no single fan", vertex.index(), points(&[*at]))
        }
        V::UnusedVertex { vertex } => format!("vertex {}: in no triangle", vertex.index()),
        V::NotDelaunay { edge, ends, .. } => {
            let [a, b] = edge.map(hexdel::VertexId::index);
            format!("edge {a} {b} {}: not Delaunay", points(ends))
        }
        V::InputMissing { input, at } => {
            format!("input point {input} {}: no vertex", points(&[*at]))
        }
        other => format!("{other:?}"),
    }
}

fn points(points: &[DVec2]) -> String {
    let each: Vec<String> = points.iter().map(|p| format!("({}, {})", p.x, p.y)).collect();
    each.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use hexdel::VertexId;

    fn triangle() -> Found {
        let mesh = TriMesh {
            vertices: vec![DVec2::ZERO, DVec2::X, DVec2::Y],
            triangles: vec![[0, 1, 2].map(VertexId::new)],
        };
        Found {
            certificate: certify(&mesh, &CertifyOptions::default()),
            of_graph: None,
            exempt: 0,
            spare: false,
            has_bounds: true,
            has_input: false,
        }
    }

    /// The verdict is that of the report: no count of faults is told and forgiven.
    #[test]
    fn what_fails_in_the_report_does_not_hold() {
        let sound = triangle();
        assert!(sound.holds() && !readable("m", &sound).contains("FAIL"));
        let faults: [fn(&mut Certificate); 9] = [
            |c| c.stretched_triangles = 1,
            |c| c.out_of_bounds = 1,
            |c| c.not_counter_clockwise = 1,
            |c| c.malformed = 1,
            |c| c.not_finite = 1,
            |c| c.repeated_edges = 1,
            |c| c.unused_vertices = 1,
            |c| c.delaunay = false,
            |c| c.inputs = 1,
        ];
        for (i, fault) in faults.into_iter().enumerate() {
            let mut found = triangle();
            fault(&mut found.certificate);
            let text = readable("m", &found);
            assert!(
                !found.holds() && text.contains("FAIL") && text.ends_with("does not hold\n"),
                "{i}: {text}"
            );
        }
    }
}
