//! `hexdel mesh`: points or a PSLG in, a certified mesh out.

mod dual_edges;
mod graph;
mod points;

use crate::crs::{self, epsg};
use crate::exit::{Failure, Outcome, unused, warn};
use crate::input::{Formats, Streams, is_stream, read_graph};
use crate::outputs::{Content, Outputs};
use crate::plane::{Plane, PlaneArgs, PlaneFigures, stays_in_plane};
use crate::plot::{Colour, PictureArgs};
use crate::sizing::{DepthFigures, Place, SizeArgs, positive};
use clap::ValueEnum;
use hexdel::geom::{BoundsError, Voronoi};
use hexdel::{AngleBounds, Domain, Effort, Mesher, Method, Pslg, SegmentMethod, Size, TriMesh};
use hexdel_io::{DualFormat, MeshFormat, MeshView, PointFile, write_dual, write_mesh, write_mesh_to};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Duration;

pub(crate) use graph::{Finished, failure, place, warn_of_repairs, warn_of_warnings};

/// Mesh points or a PSLG: angles of 43.89 to 90 degrees, 30 to 90 at segments
#[derive(clap::Args)]
#[command(
    mut_arg("format", |arg| arg.hide(true)),
    mut_arg("input_format", |arg| arg.hide(true)),
    mut_arg("colour", |arg| arg.hide(true)),
    mut_arg("histogram", |arg| arg.hide(true)),
    mut_arg("zoom", |arg| arg.hide(true)),
    mut_arg("size", |arg| arg.hide(true).long("pixels")),
    override_usage = "hexdel mesh [OPTIONS] <INPUT> -o <FILE>...",
    after_help = "\
Input: .node .poly .csv .tsv .xyz .txt .pts .geojson .wkt .shp .2dm .14 .json .ron, - with --format
Output: .ele (with .node) .edge .neigh .poly .vtu .vtk .msh .obj .off .mesh .stl .2dm .14 .nc
        .geojson .wkt .json .ron .svg .png   Not listed: --overlaps --grid --size-from-depth
Example: hexdel mesh letters.poly -o letters.vtu --max-area 0.1 --report letters.json"
)]
pub(crate) struct Args {
    /// File of points or a PSLG
    #[arg(hide = true)]
    input: PathBuf,
    /// File to write; may be given several times
    #[arg(short, long, value_name = "FILE", required_unless_present_any = ["report", "dual"])]
    output: Vec<PathBuf>,
    /// File for the Voronoi dual: .vtu .geojson .wkt .disv .nc .mpas.nc .v.node
    #[arg(long, value_name = "FILE")]
    dual: Option<PathBuf>,
    /// hexagon (--domain-radius R), hull, box, inside [default: by the input]
    #[arg(long, value_enum, hide_possible_values = true)]
    domain: Option<DomainName>,
    /// templates, simple, compact; for segments --pslg paper
    #[arg(long, value_enum, default_value_t = MethodName::Compact, hide_possible_values = true)]
    method: MethodName,
    /// How hard to optimise: fast, standard, best, fewest
    #[arg(long, value_enum, default_value_t, hide_possible_values = true)]
    effort: EffortName,
    /// Time limit; when it is reached, the mesh is written with exit status 3
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    budget: Option<Duration>,
    /// Smallest angle allowed [default: the method's; 30 at segments]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    min_angle: Option<f64>,
    /// Largest angle allowed [default: the method's; 90 at segments]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    max_angle: Option<f64>,
    /// Shortest Voronoi edge over the edge it crosses: angles up to acot(R)
    #[arg(long, value_name = "R", value_parser = positive, allow_negative_numbers = true)]
    min_dual_edge: Option<f64>,
    /// Largest area of a triangle; for a PSLG, within the circle around it
    #[arg(short = 'a', long, value_name = "A", value_parser = positive, allow_negative_numbers = true)]
    max_area: Option<f64>,
    #[command(flatten)]
    size: SizeArgs,
    /// Merge close points, divide crossing segments [TOL: 1e-9 of the size]
    #[arg(long, value_name = "TOL", num_args = 0..=1, require_equals = true, value_parser = tolerance)]
    #[expect(clippy::option_option, reason = "the option may be given without a value")]
    repair: Option<Option<f64>>,
    /// If polygons overlap: later (takes its attribute, and warns) or refuse
    #[arg(long, value_enum, value_name = "WAY", hide = true, default_value = "later")]
    overlaps: OverlapsName,
    /// Segment method: conform, or paper (keeps no bounds at segments)
    #[arg(long, value_enum, value_name = "WAY", hide = true)]
    pslg: Option<PslgName>,
    /// Circumradius of the hexagon around points [default: the smallest]
    #[arg(long, hide = true, value_name = "R", value_parser = positive, allow_negative_numbers = true)]
    domain_radius: Option<f64>,
    /// Do not merge hexagons again where all rules allow it
    #[arg(long, hide = true)]
    no_coarsening: bool,
    /// Number of threads; does not change the mesh [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    formats: Formats,
    /// Coordinate system that .geojson and .nc name
    #[arg(long, value_name = "EPSG:N", value_parser = epsg)]
    crs: Option<u16>,
    #[command(flatten)]
    plane: PlaneArgs,
    /// Which attribute of points is their height, from 1, in .node, .poly, .json, .ron
    #[arg(long, hide = true, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    height_attribute: Option<u32>,
    /// Write statistics of the mesh as JSON
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Show the hexagons in pictures
    #[arg(long, hide = true)]
    grid: bool,
    #[command(flatten)]
    picture: PictureArgs,
    /// Print nothing but warnings and errors
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum DomainName {
    Hexagon,
    Hull,
    Box,
    Inside,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
enum OverlapsName {
    Later,
    Refuse,
}

#[derive(Clone, Copy, ValueEnum)]
enum PslgName {
    Conform,
    Paper,
}

impl PslgName {
    fn method(self) -> SegmentMethod {
        match self {
            Self::Conform => SegmentMethod::Conform,
            Self::Paper => SegmentMethod::Paper,
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    Templates,
    Simple,
    Compact,
}

#[derive(Clone, Copy, Default, ValueEnum)]
pub(crate) enum EffortName {
    Fast,
    #[default]
    Standard,
    Best,
    Fewest,
}

impl EffortName {
    pub(crate) fn effort(self) -> Effort {
        match self {
            Self::Fast => Effort::Fast,
            Self::Standard => Effort::Standard,
            Self::Best => Effort::Best,
            Self::Fewest => Effort::Fewest,
        }
    }
}

pub(crate) fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|s| Duration::try_from_secs_f64(s).ok());
    seconds.ok_or_else(|| "must be a number of seconds, 0 or more".to_owned())
}

fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if f64::is_finite(number) && number >= 0.0 => Ok(number),
        _ => Err("must be a distance, 0 or more".to_owned()),
    }
}

/// Why options of pictures have no effect.
const NO_PICTURE: &str = "it is for pictures, and no output is .svg or .png";

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    let outputs = outputs(args)?;
    args.refuse_unused()?;
    let mut input = read_graph(&args.input, &args.formats)?;
    args.name_heights(&mut input)?;
    let plane = args.plane.take(&mut input, &args.input)?;
    let for_graphs = args.is_for_graphs(&input.pslg);
    if args.picture.colour.is_some_and(Colour::needs_hexagons) {
        let of = match args.method() {
            _ if for_graphs => Some("the mesh of a PSLG"),
            Method::Compact => Some("the compact method"),
            _ => None,
        };
        if let Some(of) = of {
            return Err(Failure::NoHexagons { of: of.to_owned() });
        }
    }
    let place = Place { file: &args.input, points: &input.pslg.points, plane: plane.as_ref() };
    let (size, depths) = args.size.read(&place)?;
    let job = Job { outputs: &outputs, input: &input, size, about: About { plane: plane.as_ref(), depths } };
    if for_graphs { graph::run(args, &job) } else { points::run(args, &job) }
}

/// What is meshed, and where the mesh goes.
struct Job<'a> {
    outputs: &'a Outputs,
    input: &'a PointFile,
    /// How long edges may be, if anything says so.
    size: Option<Size>,
    about: About<'a>,
}

/// What was made of the input before it was meshed.
#[derive(Default)]
pub(crate) struct About<'a> {
    plane: Option<&'a Plane>,
    depths: Option<DepthFigures>,
}

impl About<'_> {
    /// Lines of a summary.
    fn lines(&self) -> String {
        let plane = self.plane.map_or_else(String::new, Plane::lines);
        plane + &self.depths.as_ref().map_or_else(String::new, DepthFigures::line)
    }
}

fn outputs(args: &Args) -> Result<Outputs, Failure> {
    let mut outputs = Outputs::default();
    outputs.protect_input(&args.input);
    for path in &args.output {
        if is_stream(path) {
            outputs.add_stdout(args.formats.of_output()?)?;
        } else {
            outputs.add_mesh(path)?;
        }
    }
    if let Some(path) = &args.dual {
        outputs.add_dual(path)?;
    }
    if let Some(path) = &args.report {
        outputs.add_text(path)?;
    }
    Ok(outputs)
}

impl Args {
    /// An error if an option is given that nothing is there for.
    fn refuse_unused(&self) -> Result<(), Failure> {
        let to_stream = self.output.iter().any(|path| is_stream(path));
        let streams = Streams { input: is_stream(&self.input), output: to_stream, points: true };
        self.formats.refuse_unused(&streams)?;
        let format = |path: &PathBuf| {
            if is_stream(path) { self.formats.of_output().ok() } else { MeshFormat::from_path(path) }
        };
        let dual = self.dual.iter().map(|path| DualFormat::from_path(path));
        crs::refuse_unused(self.crs, self.output.iter().map(format), dual)?;
        let is_picture = |path: &PathBuf| format(path).is_some_and(MeshFormat::is_picture);
        let given = self.picture.given().or(self.grid.then_some("--grid"));
        match given.filter(|_| !self.output.iter().any(is_picture)) {
            // Lengths of edges have that name here.
            Some("--size") => unused("--pixels", NO_PICTURE),
            Some(option) => unused(option, NO_PICTURE),
            None => Ok(()),
        }
    }

    /// Takes an attribute of points for their height, if one was named.
    fn name_heights(&self, input: &mut PointFile) -> Result<(), Failure> {
        let Some(asked) = self.height_attribute else { return Ok(()) };
        let count = input.pslg.attributes_per_point;
        if asked as usize > count {
            return Err(Failure::NoAttribute { file: self.input.display().to_string(), asked, count });
        }
        input.height_attribute = Some(asked as usize - 1);
        Ok(())
    }

    /// Whether the input, or what is asked for, takes more than points.
    fn is_for_graphs(&self, input: &Pslg) -> bool {
        let other_domain = self.domain.is_some_and(|d| !matches!(d, DomainName::Hexagon));
        !input.segments.is_empty() || other_domain || self.repair.is_some()
    }

    /// The options that points and PSLGs share.
    fn mesher(&self) -> Mesher {
        let method = self.method();
        let mut mesher =
            Mesher::new().method(method).effort(self.effort.effort()).coarsening(!self.no_coarsening);
        if let Some(budget) = self.budget {
            mesher = mesher.budget(budget);
        }
        if let Some(radius) = self.domain_radius {
            mesher = mesher.domain_radius(radius);
        }
        if let Some(ratio) = self.min_dual_edge {
            mesher = mesher.min_dual_edge(ratio);
        }
        if let Some(threads) = self.threads {
            mesher = mesher.threads(usize::from(threads));
        }
        mesher
    }

    fn method(&self) -> Method {
        match self.method {
            MethodName::Templates => Method::Templates,
            MethodName::Simple => Method::Simple,
            MethodName::Compact => Method::Compact,
        }
    }

    fn domain(&self) -> Option<Domain> {
        self.domain.map(|domain| match domain {
            DomainName::Hexagon => Domain::Hexagon,
            DomainName::Hull => Domain::Hull,
            DomainName::Box => Domain::Box,
            DomainName::Inside => Domain::Inside,
        })
    }

    /// The bounds asked for, one by one, in place of the usual ones.
    fn bounds(&self, usual: AngleBounds) -> Result<AngleBounds, BoundsError> {
        let min = self.min_angle.unwrap_or(usual.min_deg());
        let max = self.max_angle.unwrap_or(usual.max_deg());
        AngleBounds::new(min, max)
    }

    fn failure(&self, source: hexdel::Error) -> Failure {
        let file = self.input.display().to_string();
        Failure::Mesh { file, source: Box::new(source), more: String::new() }
    }
}

/// The figures of a mesh, and what was found out about its input.
#[derive(Serialize)]
struct Report<'a, T> {
    #[serde(flatten)]
    figures: Option<&'a T>,
    /// The columns that points were taken from.
    #[serde(skip_serializing_if = "Option::is_none")]
    columns: Option<String>,
    /// What was wrong with the file and read all the same.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    input_warnings: Vec<String>,
    /// The plane that it was meshed in.
    #[serde(skip_serializing_if = "Option::is_none")]
    projection: Option<PlaneFigures<'a>>,
    /// The raster of depths that sizes are of.
    #[serde(skip_serializing_if = "Option::is_none")]
    depths: Option<&'a DepthFigures>,
}

impl<'a, T> Report<'a, T> {
    fn new(figures: Option<&'a T>, input: &PointFile, about: &'a About<'_>) -> Self {
        let columns = input.columns.as_ref().map(ToString::to_string);
        let degrees = input.degrees.then(|| DEGREES.to_owned());
        let input_warnings = input.warnings.iter().map(ToString::to_string).chain(degrees).collect();
        let projection = about.plane.map(Plane::figures);
        Self { figures, columns, input_warnings, projection, depths: about.depths.as_ref() }
    }
}

/// The line of a summary that says which columns were taken.
fn columns_line(input: &PointFile) -> String {
    input.columns.as_ref().map_or_else(String::new, |columns| format!("columns    {columns}\n"))
}

/// The heights of vertices, which are among their attributes, if the points have heights.
fn heights(
    input: &PointFile,
    of_vertices: impl FnOnce() -> Result<Vec<f64>, Failure>,
) -> Result<Option<Vec<f64>>, Failure> {
    let Some(place) = input.height_attribute else {
        return Ok(None);
    };
    let column = of_vertices()?.into_iter().skip(place).step_by(input.pslg.attributes_per_point);
    Ok(Some(column.collect()))
}

/// The line of a summary that says between what the heights of points are.
fn heights_line(input: &PointFile) -> String {
    let Some(place) = input.height_attribute else {
        return String::new();
    };
    let of_points = input.pslg.point_attributes.iter().skip(place).step_by(input.pslg.attributes_per_point);
    let [low, high] = [f64::min as fn(f64, f64) -> f64, f64::max]
        .map(|pick| of_points.clone().copied().reduce(pick).unwrap_or_default());
    format!("heights    {low} to {high} at points, linear between them\n")
}

/// Said of longitudes and latitudes.
const DEGREES: &str = "degrees are treated as plane coordinates; project them first, or with --project";

/// The line of a summary that warns of longitudes and latitudes.
fn degrees_line(input: &PointFile) -> String {
    if input.degrees { format!("warning    {DEGREES}\n") } else { String::new() }
}

/// Writes the mesh to all files, and its figures. The dual is that of the mesh beside
/// the view, of which every vertex is a corner.
fn write(
    outputs: &Outputs,
    (view, mesh): (&MeshView<'_>, &TriMesh),
    plane: Option<&Plane>,
    report: &impl Serialize,
) -> Result<(), Failure> {
    let report = serde_json::to_string_pretty(report)? + "\n";
    let mut in_plane = *view;
    in_plane.definition = plane.and_then(Plane::definition);
    let unprojected = plane.and_then(|plane| plane.unprojected(view));
    let to_degrees = |at| plane.map_or(at, |plane| plane.degrees(at));
    let in_degrees = unprojected.as_ref().map(|degrees| degrees.view(view, &to_degrees));
    if let Some(plane) = plane {
        plane.warn_of(unprojected.as_ref(), view.epsg, &outputs.paths());
    }
    let view = |path: &Path| in_degrees.filter(|_| !stays_in_plane(path)).unwrap_or(in_plane);
    outputs.write(|content, path| match content {
        Content::Mesh => Ok(write_mesh(path, &view(path))?),
        Content::Dual => {
            let at_fault = |source| Failure::Voronoi { file: path.display().to_string(), source };
            let view = view(path);
            let mut of_dual = MeshView::new(if view.geographic.is_some() { view.mesh } else { mesh });
            (of_dual.epsg, of_dual.definition) = (view.epsg, view.definition);
            of_dual.geographic = view.geographic;
            Ok(write_dual(path, &of_dual, &Voronoi::new(mesh).map_err(at_fault)?)?)
        }
        _ => {
            std::fs::write(path, &report).map_err(|source| Failure::Output { file: path.to_owned(), source })
        }
    })?;
    let stays = |format: MeshFormat| format.is_picture();
    let of = |format| in_degrees.filter(|_| !stays(format)).unwrap_or(in_plane);
    outputs.write_stdout(|out, format| Ok(write_mesh_to(out, format, &of(format), "standard output")?))
}

/// How many triangles are past a bound by rounding, as the end of a line.
fn limited(certificate: &hexdel::Certificate) -> String {
    match certificate.rounding_limited {
        0 => String::new(),
        n => format!(
            "\n           except {n} triangles, which rounding takes past a bound by up to {:.1e} degrees",
            certificate.worst_rounding_excess_deg
        ),
    }
}

/// Warns of parts of the input that are not used.
fn warn_ignored(args: &Args, parts: &[(usize, &str)]) {
    let ignored: Vec<String> =
        parts.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{count} {what}")).collect();
    if !ignored.is_empty() {
        warn(&format!(
            "{}: ignored because no segments bound them: {}",
            args.input.display(),
            ignored.join(", ")
        ));
    }
}
