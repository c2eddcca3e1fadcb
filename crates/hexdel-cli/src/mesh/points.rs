//! Points in a hexagon.

use super::dual_edges::dual_edges_line;
use super::{
    Args, Job, OverlapsName, Report, columns_line, degrees_line, heights, heights_line, limited,
    warn_ignored, write,
};
use crate::exit::{Outcome, Verdict, warn};
use crate::plot::Colour;
use crate::progress::Progress;
use hexdel::{Certificate, Overlaps, Size, Triangulation};
use hexdel_io::{MeshView, Promised, PromisedDomain};
use hexdel_plot::{ColourBy, Overlay};
use std::fmt::Write as _;

/// Meshes points, writes the mesh and says what it is like.
pub(super) fn run(args: &Args, job: &Job<'_>) -> Outcome {
    let Job { outputs, input: file, about, .. } = job;
    let input = &file.pslg;
    warn_ignored(args, &[(input.holes.len(), "holes"), (input.regions.len(), "regions")]);
    let mut mesher = args.mesher();
    if args.min_angle.is_some() || args.max_angle.is_some() {
        mesher = mesher.bounds(args.bounds(args.method().bounds())?);
    }
    // Errors that say so.
    if let Some(way) = args.pslg {
        mesher = mesher.segment_method(way.method());
    }
    if args.overlaps == OverlapsName::Refuse {
        mesher = mesher.overlaps(Overlaps::Refuse);
    }
    let mut size = job.size.clone();
    if let Some(area) = args.max_area {
        let by_area = Size::area(area).map_err(|e| args.failure(e.into()))?;
        size = Some(size.unwrap_or_else(Size::unlimited).and(by_area));
    }
    if let Some(size) = size {
        mesher = mesher.size(size);
    }
    let progress = Progress::new(args.quiet);
    let made = mesher.triangulate_watched(&input.points, &progress);
    progress.finish();
    let made = made.map_err(|source| args.failure(source))?;

    let inputs = made.input_of_vertex();
    let overlay: Option<Overlay> = args.grid.then(|| made.overlay()).filter(|o| !o.polygons.is_empty());
    if args.grid && overlay.is_none() {
        let input = args.input.display();
        warn(&format!(
            "{input}: the mesh was grown without hexagons: --grid shows none; use --method templates"
        ));
    }
    let groups = match args.picture.colour {
        Some(Colour::Level) => made.levels(),
        Some(Colour::Class) => made.classes(),
        _ => None,
    };
    let mut picture = args.picture.picture(made.certificate.bounds);
    picture.overlay = overlay.as_ref();
    picture.fill_triangles = overlay.is_none() || args.picture.colour.is_some();
    if let Some(groups) = &groups {
        picture.colour_by = ColourBy::Groups(groups);
    }
    let bounds = made.certificate.bounds;
    let domain = PromisedDomain::Hexagon;
    let promised = Promised { near: bounds, far: bounds, domain, exempt: Vec::new() };
    let mut view = MeshView::new(&made.mesh)
        .with_input_indices(&inputs)
        .with_promised(&promised)
        .with_certificate(&made.certificate)
        .with_picture(picture);
    view.epsg = args.crs;
    let heights = heights(file, || made.vertex_attributes(input).map_err(|source| args.failure(source)))?;
    if let Some(heights) = &heights {
        view = view.with_heights(heights);
    }
    // The dual in it takes more memory than the mesh.
    let report = args.report.is_some().then(|| made.report());
    write(outputs, (&view, &made.mesh), about.plane, &Report::new(report.as_ref(), file, about))?;
    if !args.quiet {
        let distinct = inputs.iter().flatten().count();
        outputs.tell(&summary(&made, distinct, job))?;
    }
    Ok(if made.budget_spent { Verdict::Spent } else { Verdict::Holds })
}

/// The shortest edge promised, as an aside.
fn promised(certificate: &Certificate) -> String {
    certificate.min_edge_bound.map_or_else(String::new, |least| format!(", promised {}", significant(least)))
}

/// Four digits of a length.
fn significant(length: f64) -> String {
    let decimals = if length > 0.0 { (3.0 - length.log10().floor()).clamp(0.0, 12.0) as usize } else { 0 };
    format!("{length:.decimals$}")
}

/// What is worth knowing at a glance.
fn summary(made: &Triangulation, distinct: usize, job: &Job<'_>) -> String {
    let file = job.input;
    let certificate = &made.certificate;
    let mut text = String::new();
    let duplicates = match certificate.inputs - distinct {
        0 => String::new(),
        more => format!(" ({more} of them duplicates)"),
    };
    let spent = if made.budget_spent { "budget     spent before optimisation ended\n" } else { "" };
    // Writing to a string does not fail.
    let _ = write!(
        text,
        "points     {}{duplicates}\n{}{}{}{}\
         mesh       {} vertices, {} triangles, {} levels\n\
         angles     {:.4} to {:.4} degrees\n\
         shape      aspect ratio at most {:.5}, shortest edge {}{}\n\
         certified  angles within {:.4} to {}, Delaunay, one disk, every point a vertex{}\n\
         {}{spent}\
         seconds    {:.3} = refine {:.3} + extract {:.3} + certify {:.3}\n",
        certificate.inputs,
        columns_line(file),
        heights_line(file),
        degrees_line(file),
        job.about.lines(),
        certificate.vertices,
        certificate.triangles,
        made.max_level,
        certificate.min_angle_deg,
        certificate.max_angle_deg,
        certificate.max_aspect_ratio,
        significant(certificate.shortest_edge),
        promised(certificate),
        certificate.bounds.min_deg(),
        certificate.bounds.max_deg(),
        limited(certificate),
        dual_edges_line(made.dual_edges.as_ref()),
        made.seconds.total,
        made.seconds.refine,
        made.seconds.extract,
        made.seconds.certify,
    );
    text
}
