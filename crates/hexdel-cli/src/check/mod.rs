//! `hexdel check`: what can be said of a mesh, whoever made it.

mod graph;

use crate::exit::{Outcome, Verdict, print};
use crate::input::{Formats, is_stream, read_graph, read_mesh};
use graph::OfGraph;
use hexdel::geom::certificate::Violation;
use hexdel::geom::{CertifyOptions, certify};
use hexdel::{AngleBounds, Certificate, DVec2};
use serde::Serialize;
use std::fmt::Write as _;
use std::path::PathBuf;

/// Violations that are shown to a reader; JSON has the first hundred.
const SHOWN: usize = 10;

/// Check a mesh: angles, Delaunay, topology, input points and segments
#[derive(clap::Args)]
#[command(after_help = "\
    The default bounds are those of `hexdel mesh`. The Delaunay property and\n\
    orientations are decided exactly. Exits with 1 if the mesh does not hold.\n\n\
    With segments in the input each must be a union of edges, unless it lies in\n\
    a hole or outside; corners narrower than the smallest angle are exempt; holes\n\
    may be where they like.\n\n\
    Examples:\n  \
    hexdel check mesh.ele --input letters.poly\n  \
    hexdel check mesh.ele --min-angle 20 --max-angle 140 --json")]
pub(crate) struct Args {
    /// Mesh, in any format that is read, such as .ele (with its .node), .vtu or .msh
    mesh: PathBuf,
    /// File of points that must be vertices, bit for bit, and of segments
    #[arg(long)]
    input: Option<PathBuf>,
    /// Smallest angle allowed, degrees [default: 43.8978; 30 with segments]
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    min_angle: Option<f64>,
    /// The largest angle allowed, degrees
    #[arg(long, value_name = "B", default_value_t = AngleBounds::EXTENDED.max_deg(), allow_negative_numbers = true)]
    max_angle: f64,
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

/// The smallest angle where there are segments.
const LEAST_WITH_SEGMENTS: f64 = 30.0;

/// Violations that JSON has.
const LISTED: usize = 100;

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    // Of two files only one can be standard input.
    let of_input = if is_stream(&args.mesh) { Formats::default() } else { args.formats.clone() };
    let input = args.input.as_deref().map(|path| read_graph(path, &of_input)).transpose()?;
    let input = input.map(|file| file.pslg);
    let mesh = read_mesh(&args.mesh, &args.formats)?;
    let graph = input.as_ref().filter(|input| !input.segments.is_empty());
    let usual = if graph.is_some() { LEAST_WITH_SEGMENTS } else { AngleBounds::EXTENDED.min_deg() };
    let options = CertifyOptions {
        bounds: AngleBounds::new(args.min_angle.unwrap_or(usual), args.max_angle)?,
        inputs: input.as_ref().map(|input| input.points.as_slice()),
        require_disk: graph.is_none(),
        // Which of them are exempt remains to be seen.
        max_violations: if graph.is_some() { usize::MAX } else { LISTED },
        ..CertifyOptions::default()
    };
    let mut certificate = certify(&mesh, &options);
    let of_graph = graph.map(|graph| OfGraph::new(&mesh, graph, &mut certificate));
    certificate.violations.truncate(LISTED);
    // An empty mesh has no fault, but is no disk: it does not hold.
    let holds = of_graph.as_ref().map_or(certificate.holds(), |of_graph| of_graph.holds(&certificate));
    let text = if args.json {
        let findings = Findings { holds, certificate: &certificate, of_graph: of_graph.as_ref() };
        serde_json::to_string_pretty(&findings)? + "\n"
    } else {
        readable(&args.mesh.display().to_string(), &certificate, of_graph.as_ref(), holds)
    };
    print(&text)?;
    Ok(if holds { Verdict::Holds } else { Verdict::Fails })
}

/// One line per finding, then the first violations.
fn readable(name: &str, c: &Certificate, of_graph: Option<&OfGraph>, holds: bool) -> String {
    let mut text = format!("{name}: {} vertices, {} triangles\n", c.vertices, c.triangles);
    for (good, finding) in findings(c, of_graph) {
        // Writing to a string does not fail.
        let _ = writeln!(text, "  {}  {finding}", if good { "ok  " } else { "FAIL" });
    }
    let _ = writeln!(
        text,
        "        shortest edge {}, largest aspect ratio {:.4}",
        c.shortest_edge, c.max_aspect_ratio
    );
    let mut violations: Vec<String> = c.violations.iter().map(describe).collect();
    violations.extend(of_graph.iter().flat_map(|of_graph| of_graph.describe()));
    for violation in violations.iter().take(SHOWN) {
        let _ = writeln!(text, "  - {violation}");
    }
    if violations.len() > SHOWN {
        let _ = writeln!(text, "  - and more");
    }
    let _ = writeln!(text, "{}", if holds { "holds" } else { "does not hold" });
    text
}

/// What was asked for, each with whether it is so.
fn findings(c: &Certificate, of_graph: Option<&OfGraph>) -> Vec<(bool, String)> {
    let broken = c.malformed + c.not_finite + c.not_counter_clockwise;
    // A triangle the wrong way round has negative angles.
    let beyond = c.out_of_bounds + c.not_counter_clockwise;
    let angles = format!("angles {:.4} to {:.4}", c.min_angle_deg, c.max_angle_deg);
    let bounds = format!("{:.4} to {:.4} degrees", c.bounds.min_deg(), c.bounds.max_deg());
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
    ];
    match of_graph {
        Some(of_graph) => findings.extend(of_graph.findings(c)),
        None => findings.extend(topology(c)),
    }
    if let Some(bound) = c.max_aspect_bound {
        findings.push(finding(
            c.stretched_triangles == 0,
            format!("aspect ratios as these angles have them, {bound:.5} at most"),
            format!("{} triangles with aspect ratios that their angles do not have", c.stretched_triangles),
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

/// Whether the mesh is one disk.
fn topology(c: &Certificate) -> [(bool, String); 2] {
    let manifold = format!(
        "not manifold: {} edges repeated, {} vertices branching, {} unused",
        c.repeated_edges, c.branching_vertices, c.unused_vertices
    );
    let disk = format!(
        "not one disk: {} boundary loops, Euler characteristic {}",
        c.boundary_loops, c.euler_characteristic
    );
    [finding(c.manifold, "manifold", manifold), finding(c.disk, "one disk", disk)]
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
