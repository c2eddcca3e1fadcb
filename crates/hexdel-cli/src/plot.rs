//! `hexdel plot`: pictures of meshes, and the options that all pictures have.

use crate::exit::{Failure, Outcome, Verdict};
use crate::input::{Formats, read_graph, read_mesh_data};
use crate::outputs::Outputs;
use clap::ValueEnum;
use hexdel::{AngleBounds, DVec2, TriMesh};
use hexdel_io::{MeshFormat, WriteError, write_mesh};
use hexdel_plot::{ColourBy, Picture};
use std::path::PathBuf;

/// Draw a mesh, coloured by its angles or regions
#[derive(clap::Args)]
#[command(after_help = "\
    The bounds are the ends of the colour scales and the marks in the histogram;\n\
    angles beyond them are red. Mesh files do not record levels and classes of\n\
    hexagons: to colour by them, use `hexdel mesh`, which has these options, too\n\
    (--size as --pixels).\n\n\
    Examples:\n  \
    hexdel plot mesh.ele -o mesh.svg --histogram\n  \
    hexdel plot mesh.ele -o corner.png --colour largest --zoom 0,0,0.5,0.5 --size 2000")]
pub(crate) struct Args {
    /// Mesh: .ele (with its .node), .vtu, .msh, .obj, .off, .mesh, .2dm, .14, .json, .ron
    mesh: PathBuf,
    /// Picture to write, .svg or .png; may be given several times
    #[arg(short, long, value_name = "FILE", required = true)]
    output: Vec<PathBuf>,
    #[command(flatten)]
    picture: PictureArgs,
    /// Smallest good angle, degrees
    #[arg(long, value_name = "DEG", default_value_t = AngleBounds::EXTENDED.min_deg(), allow_negative_numbers = true)]
    min_angle: f64,
    /// Largest good angle, degrees
    #[arg(long, value_name = "DEG", default_value_t = AngleBounds::EXTENDED.max_deg(), allow_negative_numbers = true)]
    max_angle: f64,
    /// File of points to draw where they are vertices
    #[arg(long, value_name = "FILE")]
    input: Option<PathBuf>,
    #[command(flatten)]
    formats: Formats,
}

/// How pictures look.
#[derive(clap::Args)]
pub(crate) struct PictureArgs {
    /// smallest or largest angle, region, level or class [default: smallest]
    #[arg(long, alias = "color", value_enum, value_name = "BY", hide_possible_values = true)]
    pub(crate) colour: Option<Colour>,
    /// Add a histogram of all angles
    #[arg(long)]
    histogram: bool,
    /// Show only a box, given by opposite corners
    #[arg(long, value_name = "X,Y,X,Y", value_parser = zoom, allow_hyphen_values = true)]
    zoom: Option<Zoom>,
    /// Longer side of the drawing, pixels [default: 1000]
    #[arg(long, value_name = "PX", value_parser = clap::value_parser!(u32).range(16..=16384))]
    size: Option<u32>,
}

/// What the colours of triangles say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Colour {
    Smallest,
    Largest,
    Region,
    Level,
    Class,
}

impl Colour {
    /// Whether it is about the hexagons behind a mesh.
    pub(crate) fn needs_hexagons(self) -> bool {
        matches!(self, Self::Level | Self::Class)
    }
}

/// The lower left and the upper right corner of a box.
type Zoom = [DVec2; 2];

fn zoom(text: &str) -> Result<Zoom, &'static str> {
    const EXPECTED: &str = "expected four numbers X,Y,X,Y, the corners of a box";
    let numbers: Vec<f64> = text.split(',').map_while(|number| number.trim().parse().ok()).collect();
    let &[x, y, u, v] = &numbers[..] else {
        return Err(EXPECTED);
    };
    let (a, b) = (DVec2::new(x, y), DVec2::new(u, v));
    let boxed = a.is_finite() && b.is_finite() && x != u && y != v && text.split(',').count() == 4;
    if boxed { Ok([a.min(b), a.max(b)]) } else { Err(EXPECTED) }
}

impl PictureArgs {
    /// An option that is given, if any is, by its name here.
    pub(crate) fn given(&self) -> Option<&'static str> {
        let all = [
            ("--colour", self.colour.is_some()),
            ("--histogram", self.histogram),
            ("--zoom", self.zoom.is_some()),
            ("--size", self.size.is_some()),
        ];
        all.into_iter().find(|(_, given)| *given).map(|(name, _)| name)
    }

    /// The options as the library has them; colours by groups are left to the
    /// caller.
    pub(crate) fn picture(&self, bounds: AngleBounds) -> Picture<'static> {
        let mut picture = Picture::default();
        picture.bounds_deg = [bounds.min_deg(), bounds.max_deg()];
        picture.histogram = self.histogram;
        picture.zoom = self.zoom;
        picture.size_px = self.size.map_or(picture.size_px, f64::from);
        picture.colour_by = match self.colour {
            Some(Colour::Largest) => ColourBy::LargestAngle,
            Some(Colour::Region) => ColourBy::Region,
            _ => ColourBy::SmallestAngle,
        };
        picture
    }
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    let outputs = outputs(args)?;
    if args.picture.colour.is_some_and(Colour::needs_hexagons) {
        return Err(Failure::NoHexagons { of: format!("{}: a mesh file", args.mesh.display()) });
    }
    let bounds = AngleBounds::new(args.min_angle, args.max_angle)?;
    let of_input = args.formats.beside(&args.mesh, args.input.as_deref())?;
    let read = |path| read_graph(path, &of_input).map(|file| file.pslg.points);
    let points = args.input.as_deref().map(read).transpose()?;
    let mut data = read_mesh_data(&args.mesh, &args.formats)?;
    if let Some(points) = points {
        data.input_indices = Some(input_indices(&data.mesh, &points));
    }
    let view = data.view().with_picture(args.picture.picture(bounds));
    outputs.write(|_, path| Ok(write_mesh(path, &view)?))?;
    Ok(Verdict::Holds)
}

fn outputs(args: &Args) -> Result<Outputs, Failure> {
    let mut outputs = Outputs::default();
    outputs.protect_input(&args.mesh);
    if let Some(input) = &args.input {
        outputs.protect_input(input);
    }
    for path in &args.output {
        if !MeshFormat::from_path(path).is_some_and(MeshFormat::is_picture) {
            let file = path.display().to_string();
            return Err(WriteError::UnknownExtension { file, known: MeshFormat::PICTURES }.into());
        }
        outputs.add_mesh(path)?;
    }
    Ok(outputs)
}

/// For each vertex the point of the same coordinates.
fn input_indices(mesh: &TriMesh, points: &[DVec2]) -> Vec<Option<u32>> {
    let place = |p: &DVec2| [p.x, p.y].map(|c| (c + 0.0).to_bits());
    let mut order: Vec<_> = points.iter().enumerate().map(|(i, p)| (place(p), i as u32)).collect();
    order.sort_unstable();
    let find = |vertex: &DVec2| {
        let at = order.partition_point(|(known, _)| *known < place(vertex));
        order.get(at).filter(|(known, _)| *known == place(vertex)).map(|(_, i)| *i)
    };
    mesh.vertices.iter().map(find).collect()
}
