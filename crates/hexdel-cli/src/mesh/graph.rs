//! PSLGs of points and segments, and points in other domains than a hexagon.

use super::dual_edges::dual_edges_line;
use super::{
    About, Args, Job, OverlapsName, Report, columns_line, degrees_line, heights, heights_line, limited, write,
};
use crate::exit::{Failure, Outcome, Verdict, warn};
use crate::outputs::Outputs;
use crate::progress::Progress;
use crate::triangle::Numbered;
use hexdel::pslg::{RepairReport, Seed, violations};
use hexdel::{
    AngleBounds, Domain, Mesher, Overlaps, Pslg, PslgReport, PslgTriangulation, RepairEntry, SegmentMethod,
    Warning,
};
use hexdel_io::{MarkedEdge, MeshView, PointFile, Promised, PromisedDomain};
use hexdel_plot::Picture;
use std::fmt::{Display, Write as _};

/// Items of a list that are shown; the report has all.
const SHOWN: usize = 10;

/// Meshes a PSLG, writes the mesh and says what it is like.
pub(super) fn run(args: &Args, job: &Job<'_>) -> Outcome {
    let Job { outputs, input, size, about } = job;
    let mut mesher = mesher(args)?;
    if let Some(size) = size {
        mesher = mesher.size(size.clone());
    }
    if args.grid {
        warn("--grid: the mesh of a PSLG has no hexagons to show");
    }
    let progress = Progress::new(args.quiet);
    let made = mesher.triangulate_pslg_watched(&input.pslg, &progress);
    progress.finish();
    let file = args.input.display().to_string();
    let made = made.map_err(|source| failure(&file, source, &input.pslg))?;
    if args.repair.is_none() {
        warn_of_repairs(made.repairs.as_ref(), &file);
    }
    let finished = Finished {
        made: &made,
        input,
        numbered: None,
        file: &file,
        quiet: args.quiet,
        with_regions: !made.graph.regions.is_empty(),
        with_markers: true,
        second_order: false,
        epsg: args.crs,
        about,
        picture: args.picture.picture(made.certificate.bounds),
    };
    finished.write(outputs)
}

/// A mesh of a PSLG to be written.
#[expect(clippy::struct_excessive_bools, reason = "each is a choice of its own")]
pub(crate) struct Finished<'a> {
    pub(crate) made: &'a PslgTriangulation,
    /// What it was made of.
    pub(crate) input: &'a PointFile,
    /// The same mesh with its vertices in another order, to be written in its place.
    pub(crate) numbered: Option<&'a Numbered>,
    /// The name of the file that it was made of.
    pub(crate) file: &'a str,
    pub(crate) quiet: bool,
    pub(crate) with_regions: bool,
    pub(crate) with_markers: bool,
    pub(crate) second_order: bool,
    /// The number of the coordinate system.
    pub(crate) epsg: Option<u16>,
    pub(crate) about: &'a About<'a>,
    pub(crate) picture: Picture<'a>,
}

impl Finished<'_> {
    /// Where all items of a list are.
    fn elsewhere(&self) -> &'static str {
        // Meshes in Triangle's order are those of `hexdel triangle`, which makes no report.
        if self.numbered.is_some() { "" } else { ", see --report" }
    }

    /// Writes the mesh to all files and says what it is like.
    pub(crate) fn write(&self, outputs: &Outputs) -> Outcome {
        let made = self.made;
        let report = made.report();
        let inputs = made.input_of_vertex();
        let regions = self.with_regions.then(|| made.region_attributes());
        let edges: Vec<MarkedEdge> =
            made.edges.iter().map(|e| MarkedEdge { ends: e.ends, marker: e.marker }).collect();
        let mut view = match self.numbered {
            Some(numbered) => numbered.view(),
            None => MeshView::new(&made.mesh).with_input_indices(&inputs).with_marked_edges(&edges),
        };
        view = view
            .with_seeds(&made.graph.holes, &made.graph.regions)
            .with_certificate(&made.certificate)
            .with_second_order(self.second_order)
            .with_picture(self.picture);
        if self.with_markers && self.numbered.is_none() {
            view = view.with_vertex_markers(&made.vertex_markers);
        }
        if !self.with_markers {
            view.vertex_markers = None;
        }
        if let Some(regions) = &regions {
            view = view.with_regions(regions);
        }
        view.epsg = self.epsg;
        let heights = match self.numbered {
            // Attributes are written as they are.
            Some(_) => None,
            None => heights(self.input, || Ok(made.vertex_attributes(&self.input.pslg)))?,
        };
        if let Some(heights) = &heights {
            view = view.with_heights(heights);
        }
        let promised = promised(made);
        if let Some(promised) = &promised {
            view = view.with_promised(promised);
        }
        let report_file = Report::new(Some(&report), self.input, self.about);
        write(outputs, (&view, &made.mesh), self.about.plane, &report_file)?;
        if !self.quiet {
            outputs.tell(&self.summary(&report))?;
        }
        warn_of_warnings(
            &made.warnings,
            self.file,
            |warning| place(warning, self.file, self.input),
            self.elsewhere(),
        );
        if !made.holds() {
            warn(&format!("{}: the mesh does not meet all requirements", self.file));
        }
        Ok(match (made.budget_spent, made.holds()) {
            (true, _) => Verdict::Spent,
            (false, true) => Verdict::Holds,
            (false, false) => Verdict::Fails,
        })
    }

    /// What is worth knowing at a glance.
    fn summary(&self, report: &PslgReport<'_>) -> String {
        let made = self.made;
        let (graph, c) = (&made.graph, &made.certificate);
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "PSLG       {} points, {} segments, {} holes, {} regions",
            graph.points.len(),
            graph.segments.len(),
            graph.holes.len(),
            graph.regions.len()
        );
        text.push_str(&columns_line(self.input));
        text.push_str(&heights_line(self.input));
        text.push_str(&degrees_line(self.input));
        text.push_str(&self.about.lines());
        self.list(&mut text, "repaired", &report.repairs);
        let without = made.edges_of_segment.iter().filter(|&&edges| edges == 0).count();
        let without = if without > 0 { format!(", {without} not in the domain") } else { String::new() };
        let _ = write!(
            text,
            "mesh       {} vertices, {} triangles, domain {}\n\
             segments   {} edges{without}\n\
             angles     {:.4} to {:.4} degrees\n",
            c.vertices, c.triangles, report.domain, report.segment_edges, c.min_angle_deg, c.max_angle_deg,
        );
        self.list(&mut text, "exempt", &report.exempt);
        // What the paper's templates do near segments is no failure of theirs.
        let name = if report.holds { "beyond" } else { "FAILED" };
        self.list(&mut text, name, &report.failed);
        let spent = if made.budget_spent { "budget     spent before optimisation ended\n" } else { "" };
        let _ = write!(
            text,
            "{}  {}\n{}{spent}seconds    {:.3} = refine {:.3} + extract {:.3} + certify {:.3}\n",
            if report.holds { "certified" } else { "NOT MET  " },
            promises(made),
            dual_edges_line(made.dual_edges.as_ref()),
            made.seconds.total,
            made.seconds.refine,
            made.seconds.extract,
            made.seconds.certify,
        );
        text
    }

    /// A count and the first items, if there are any.
    fn list(&self, text: &mut String, name: &str, items: &[impl Display]) {
        if items.is_empty() {
            return;
        }
        let _ = writeln!(text, "{name:<9}  {}", items.len());
        for item in items.iter().take(SHOWN) {
            let _ = writeln!(text, "           {item}");
        }
        if items.len() > SHOWN {
            let _ = writeln!(text, "           and {} more{}", items.len() - SHOWN, self.elsewhere());
        }
    }
}

/// The file that a warning is about, and the line if it is known.
pub(crate) fn place(warning: &Warning, file: &str, input: &PointFile) -> String {
    let seed = match warning {
        Warning::UnusedSeed(unused) => unused.seed,
        Warning::RegionInPolygon { region, .. } => Seed::Region(*region),
        _ => return file.to_owned(),
    };
    let line = match seed {
        Seed::Hole(i) => input.hole_lines.get(i as usize),
        Seed::Region(i) => input.region_lines.get(i as usize),
    };
    line.map_or_else(|| file.to_owned(), |line| format!("{file}:{line}"))
}

/// What the mesh was made to keep; the paper's way promises nothing near segments.
fn promised(made: &PslgTriangulation) -> Option<Promised> {
    let domain = match made.domain {
        Domain::Hull => PromisedDomain::Hull,
        Domain::Box => PromisedDomain::Box,
        Domain::Inside => PromisedDomain::Inside,
        _ => PromisedDomain::Hexagon,
    };
    let exempt = made.exempt.iter().map(|e| e.triangle.index() as u32).collect();
    let promised = Promised { near: made.certificate.bounds, far: made.far_bounds, domain, exempt };
    (made.method != SegmentMethod::Paper).then_some(promised)
}

fn mesher(args: &Args) -> Result<Mesher, Failure> {
    let mut mesher = args.mesher();
    if args.min_angle.is_some() || args.max_angle.is_some() {
        let usual = AngleBounds::new(30.0, 90.0)?;
        mesher = mesher.bounds(args.bounds(AngleBounds::EXTENDED)?).near_bounds(args.bounds(usual)?);
    }
    if let Some(domain) = args.domain() {
        mesher = mesher.domain(domain);
    }
    if let Some(area) = args.max_area {
        mesher = mesher.max_area(area);
    }
    if let Some(way) = args.pslg {
        mesher = mesher.segment_method(way.method());
    }
    if args.overlaps == OverlapsName::Refuse {
        mesher = mesher.overlaps(Overlaps::Refuse);
    }
    Ok(match args.repair {
        None => mesher,
        Some(None) => mesher.repair(),
        Some(Some(tolerance)) => mesher.repair_within(tolerance),
    })
}

/// Faults of a kind that are told one by one.
const TOLD: usize = 5;

/// Why a PSLG was not meshed. Of segments at fault, all of a kind are told of.
pub(crate) fn failure(file: &str, source: hexdel::Error, input: &Pslg) -> Failure {
    let mut more = String::new();
    if let hexdel::Error::Segments(first) = &source {
        let kind = std::mem::discriminant(first);
        let all = violations(input).into_iter().filter(|other| std::mem::discriminant(other) == kind);
        let others: Vec<String> =
            all.map(|other| other.to_string()).filter(|other| *other != first.to_string()).collect();
        for other in others.iter().take(TOLD - 1) {
            let _ = write!(more, "\n{file}: {other}");
        }
        if others.len() >= TOLD {
            let _ = write!(more, "\nand {} more of this kind", others.len() + 1 - TOLD);
        }
    }
    Failure::Mesh { file: file.to_owned(), source: Box::new(source), more }
}

/// Warns of what was done to a PSLG without being asked for.
pub(crate) fn warn_of_repairs(repairs: Option<&RepairReport>, file: &str) {
    let repairs = repairs.map_or(&[][..], |report| &report.repairs);
    warn_of_each(repairs.iter().map(|repair| format!("{file}: {}", RepairEntry::new(repair))), file, "");
}

/// Warns of what is not used of a PSLG, or could have been meant otherwise, with its place in
/// the file, and where more is to be found.
pub(crate) fn warn_of_warnings(
    warnings: &[Warning],
    file: &str,
    place: impl Fn(&Warning) -> String,
    elsewhere: &str,
) {
    // Divided borders are among the repairs.
    let told = warnings.iter().filter(|w| !matches!(w, Warning::DividedBorders { .. }));
    warn_of_each(told.map(|warning| format!("{}: {warning}", place(warning))), file, elsewhere);
}

fn warn_of_each(all: impl Iterator<Item = String>, file: &str, elsewhere: &str) {
    let all: Vec<String> = all.collect();
    all.iter().take(SHOWN).for_each(|text| warn(text));
    if all.len() > SHOWN {
        warn(&format!("{file}: {} more of this kind{elsewhere}", all.len() - SHOWN));
    }
}

/// What a mesh of a PSLG is to keep.
fn promises(made: &PslgTriangulation) -> String {
    let c = &made.certificate;
    let exempt = if made.exempt.is_empty() { "" } else { " but for exempt corners" };
    let (min, max) = (c.bounds.min_deg(), c.bounds.max_deg());
    let points = match c.inputs - c.inputs_kept {
        0 => "every point a vertex".to_owned(),
        lost => format!("{lost} points lost"),
    };
    let segments = match made.segments.missing.len() {
        0 => "every segment a union of edges".to_owned(),
        lost => format!("{lost} parts of segments lost"),
    };
    let edges = made.size_ratio.map_or_else(String::new, |ratio| {
        format!(",\n           edges up to {ratio:.4} of the length wanted")
    });
    if made.method == SegmentMethod::Paper {
        return format!("away from segments angles within 43.8978 to 90, {points}, {segments}{edges}");
    }
    let delaunay = if c.delaunay { "Delaunay" } else { "not Delaunay" };
    format!("angles within {min:.4} to {max}{exempt}, {delaunay}, {points}, {segments}{edges}{}", limited(c))
}
