//! `hexdel dual`: the Voronoi dual of a mesh, whoever made it.

use crate::crs::{self, epsg};
use crate::exit::{Failure, Outcome, Verdict, print};
use crate::input::{Formats, is_stream, names, read_mesh_data};
use crate::outputs::Outputs;
use hexdel::geom::{Voronoi, VoronoiSummary};
use hexdel_io::{DualFormat, MeshView, write_dual};
use std::path::PathBuf;

/// Voronoi cells of a mesh, for finite volumes and exterior calculus
#[derive(clap::Args)]
#[command(after_help = "\
    Each vertex has a cell, clipped at the boundary. The weight of an edge is its dual\n\
    length over its length, half the sum of the opposite cotangents: the transmissibility\n\
    of a two-point flux. Exit status 1 if a weight is negative.\n\n\
    Formats, by extension:\n  \
    .vtu             cells as polygons, with their vertex and area\n  \
    .geojson, .wkt   the same for geographic information systems\n  \
    .nc              the same as the faces of UGRID\n  \
    .disv            cells of MODFLOW 6\n  \
    .mpas.nc         cells and triangles for MPAS's mesh converter\n  \
    .v.node, .v.edge circumcentres and the edges between them, as Triangle has them\n\n\
    Examples:\n  \
    hexdel dual mesh.ele -o cells.vtu\n  \
    hexdel dual mesh.vtu -o mesh.v.node --json")]
pub(crate) struct Args {
    /// Mesh in any readable format, - for standard input
    mesh: PathBuf,
    /// File to write; may be given several times
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Format of MESH if it is -
    #[arg(long, value_name = "NAME", value_parser = names(), hide_possible_values = true)]
    format: Option<String>,
    /// Coordinate system that .geojson and .nc name
    #[arg(long, value_name = "EPSG:N", value_parser = epsg)]
    crs: Option<u16>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    let mut outputs = Outputs::default();
    if !is_stream(&args.mesh) {
        outputs.protect_input(&args.mesh);
    }
    for path in &args.output {
        outputs.add_dual(path)?;
    }
    crs::refuse_unused(args.crs, [], args.output.iter().map(|path| DualFormat::from_path(path)))?;
    let formats = Formats::named(args.format.as_ref());
    let mesh = formats.beside(&args.mesh, None).and_then(|_| read_mesh_data(&args.mesh, &formats))?.mesh;
    let file = args.mesh.display().to_string();
    let dual = Voronoi::new(&mesh).map_err(|source| Failure::Voronoi { file: file.clone(), source })?;
    let mut view = MeshView::new(&mesh);
    view.epsg = args.crs;
    outputs.write(|_, path| Ok(write_dual(path, &view, &dual)?))?;
    let summary = dual.summary();
    print(&if args.json {
        serde_json::to_string_pretty(&summary)? + "\n"
    } else {
        readable(&file, &dual, &summary)
    })?;
    Ok(if summary.negative_weights == 0 { Verdict::Holds } else { Verdict::Fails })
}

fn readable(file: &str, dual: &Voronoi<'_>, summary: &VoronoiSummary) -> String {
    format!(
        "{file}: {} edges, {} cells\n\
         weights    {} negative, the smallest {}\n\
         triangles  {} do not contain their circumcentre\n\
         dual edges the shortest {}, skew at most {:.1e}\n\
         cells      the smallest area {}\n",
        dual.edges.len(),
        dual.areas.iter().filter(|area| **area != 0.0).count(),
        summary.negative_weights,
        summary.min_weight,
        summary.obtuse_triangles,
        summary.shortest_dual_edge,
        summary.max_skew,
        summary.min_area,
    )
}
