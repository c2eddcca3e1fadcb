//! `hexdel mesh`: points in, a certified mesh out.

use crate::exit::{Failure, Outcome, Verdict, print};
use crate::input::read_points;
use crate::outputs::{Content, Outputs};
use crate::progress::Progress;
use clap::ValueEnum;
use hexdel::geom::BoundsError;
use hexdel::{AngleBounds, Effort, Mesher, Method, Triangulation};
use hexdel_io::{MeshView, Overlay, Picture, write_mesh};
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Duration;

/// Mesh points: every angle between 43.9 and 90 degrees, Delaunay, certified
#[derive(clap::Args)]
#[command(after_help = "\
    Formats, by extension:\n  \
    input   .node, .poly (points only so far), .csv, .tsv, .xyz, .txt, .pts\n  \
    output  .ele (with the .node beside it), .vtu, .ron, and pictures, .svg\n\
    All files are written or none; missing folders are made.\n\n\
    Examples:\n  \
    hexdel mesh cities.csv -o cities.ele -o cities.svg --grid\n  \
    hexdel mesh cities.csv -o cities.vtu --method templates --report cities.json")]
pub(crate) struct Args {
    /// File of points
    input: PathBuf,
    /// File to write; may be given several times
    #[arg(short, long, value_name = "FILE", required_unless_present = "report")]
    output: Vec<PathBuf>,
    /// Optimised for few triangles, or meshes of the grid as they are: 43.9 to
    /// 90 degrees, thirteen times the triangles; 30 to 120, three times
    #[arg(long, value_enum, default_value_t = MethodName::Compact)]
    method: MethodName,
    /// How hard the compact method tries
    #[arg(long, value_enum, default_value_t = EffortName::Standard)]
    effort: EffortName,
    /// Time the compact method may take for optimisation [default: as it takes]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_negative_numbers = true)]
    budget: Option<Duration>,
    /// Smallest angle allowed, in degrees [default: the method's]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    min_angle: Option<f64>,
    /// Largest angle allowed, in degrees [default: the method's]
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    max_angle: Option<f64>,
    /// Circumradius of the hexagon to mesh [default: the smallest possible]
    #[arg(long, value_name = "R", value_parser = radius, allow_negative_numbers = true)]
    domain_radius: Option<f64>,
    /// Do not merge hexagons again where all rules allow it
    #[arg(long)]
    no_coarsening: bool,
    /// Threads to use; the mesh does not depend on it [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Write the figures of the mesh as JSON
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Show the hexagons in pictures
    #[arg(long)]
    grid: bool,
    /// Print nothing but warnings and errors
    #[arg(short, long)]
    quiet: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    Templates,
    Simple,
    Compact,
}

#[derive(Clone, Copy, ValueEnum)]
enum EffortName {
    Fast,
    Standard,
    Best,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().and_then(|s| Duration::try_from_secs_f64(s).ok());
    seconds.ok_or_else(|| "expected a number of seconds".to_owned())
}

fn radius(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(radius) if f64::is_finite(radius) && radius > 0.0 => Ok(radius),
        _ => Err("expected a positive number".to_owned()),
    }
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    let outputs = outputs(args)?;
    let points = read_points(&args.input)?;
    let mesher = args.mesher()?;
    let progress = Progress::new(args.quiet);
    let made = mesher.triangulate_watched(&points, &progress);
    progress.finish();
    let made = made.map_err(|source| Failure::Mesh { file: args.input.display().to_string(), source })?;

    let inputs = made.input_of_vertex();
    write(args, &outputs, &made, &inputs)?;
    if !args.quiet {
        let distinct = inputs.iter().flatten().count();
        print(&summary(&made, distinct))?;
    }
    Ok(Verdict::Holds)
}

fn outputs(args: &Args) -> Result<Outputs, Failure> {
    let mut outputs = Outputs::default();
    outputs.protect_input(&args.input);
    for path in &args.output {
        outputs.add_mesh(path)?;
    }
    if let Some(path) = &args.report {
        outputs.add_text(path)?;
    }
    Ok(outputs)
}

impl Args {
    fn mesher(&self) -> Result<Mesher, BoundsError> {
        let method = match self.method {
            MethodName::Templates => Method::Templates,
            MethodName::Simple => Method::Simple,
            MethodName::Compact => Method::Compact,
        };
        let effort = match self.effort {
            EffortName::Fast => Effort::Fast,
            EffortName::Standard => Effort::Standard,
            EffortName::Best => Effort::Best,
        };
        let mut mesher = Mesher::new().method(method).effort(effort).coarsening(!self.no_coarsening);
        if self.min_angle.is_some() || self.max_angle.is_some() {
            let kept = method.bounds();
            let min = self.min_angle.unwrap_or(kept.min_deg());
            let max = self.max_angle.unwrap_or(kept.max_deg());
            mesher = mesher.bounds(AngleBounds::new(min, max)?);
        }
        if let Some(budget) = self.budget {
            mesher = mesher.budget(budget);
        }
        if let Some(radius) = self.domain_radius {
            mesher = mesher.domain_radius(radius);
        }
        if let Some(threads) = self.threads {
            mesher = mesher.threads(usize::from(threads));
        }
        Ok(mesher)
    }
}

fn write(
    args: &Args,
    outputs: &Outputs,
    made: &Triangulation,
    inputs: &[Option<u32>],
) -> Result<(), Failure> {
    let overlay: Option<Overlay> = args.grid.then(|| made.overlay());
    let mut picture = Picture::default();
    picture.overlay = overlay.as_ref();
    let view = MeshView::new(&made.mesh)
        .with_input_indices(inputs)
        .with_certificate(&made.certificate)
        .with_picture(picture);
    let report = serde_json::to_string_pretty(&made.report())? + "\n";
    outputs.write(|content, path| match content {
        Content::Mesh => Ok(write_mesh(path, &view)?),
        _ => {
            std::fs::write(path, &report).map_err(|source| Failure::Output { file: path.to_owned(), source })
        }
    })
}

/// What is worth knowing at a glance.
fn summary(made: &Triangulation, distinct: usize) -> String {
    let certificate = &made.certificate;
    let mut text = String::new();
    let duplicates = match certificate.inputs - distinct {
        0 => String::new(),
        more => format!(" ({more} of them duplicates)"),
    };
    let limited = match certificate.rounding_limited {
        0 => String::new(),
        n => format!(
            "\n           but for {n} triangles whose coordinates do not resolve it, by up to {:.1e} degrees",
            certificate.worst_rounding_excess_deg
        ),
    };
    // Writing to a string does not fail.
    let _ = write!(
        text,
        "points     {}{duplicates}\n\
         mesh       {} vertices, {} triangles, {} levels\n\
         angles     {:.4} to {:.4} degrees\n\
         certified  angles within {:.4} to {}, Delaunay, one disk, every point a vertex{limited}\n\
         seconds    {:.3} = refine {:.3} + extract {:.3} + certify {:.3}\n",
        certificate.inputs,
        certificate.vertices,
        certificate.triangles,
        made.max_level,
        certificate.min_angle_deg,
        certificate.max_angle_deg,
        certificate.bounds.min_deg(),
        certificate.bounds.max_deg(),
        made.seconds.total,
        made.seconds.refine,
        made.seconds.extract,
        made.seconds.certify,
    );
    text
}
