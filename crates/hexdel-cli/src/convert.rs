//! `hexdel convert`: a mesh or points from one format to another.

use crate::crs::{self, epsg};
use crate::exit::{Failure, Outcome, Verdict, warn};
use crate::input::{is_stream, names, no_table, refuse_columns, warn_of};
use crate::mesh::{failure, warn_of_repairs, warn_of_warnings};
use crate::outputs::Outputs;
use hexdel::Mesher;
use hexdel::geom::Pslg;
use hexdel_io::{
    Columns, MeshData, MeshFormat, MeshView, PointFormat, PointReader, ReadError, WriteError, holds_mesh,
    read_mesh_data, read_mesh_from, write_mesh, write_mesh_to, write_points, write_points_to,
};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

/// Convert a mesh, or points with segments, to another format
#[derive(clap::Args)]
#[command(after_help = "\
    Meshes    .ele (with .node), .vtu, .msh, .obj, .off, .mesh, .2dm, .14, .json, .ron; written only:\n          \
    .edge, .neigh, .poly, .vtk, .stl, .nc, .geojson, .wkt, .svg, .png\n\
    Points    .node, .poly, .csv, .tsv, .xyz, .txt, .pts, .geojson, .json, .ron; read only:\n          \
    .geojsonl, .geojsons, .ndjson, .wkt, .shp, .2dm, .14, .json of CG:SHOP\n\
    A .node is read as a mesh only if the output can be nothing else. Markers, regions and\n\
    marked edges are kept if the format has them; a warning names what is lost.\n\n\
    Examples:\n  \
    hexdel convert mesh.ele mesh.vtu\n  \
    hexdel convert old.msh new.msh --format msh2\n  \
    hexdel convert borders.geojson borders.poly\n  \
    hexdel convert mesh.vtu - --format off | less")]
pub(crate) struct Args {
    /// File to read, - for standard input
    input: PathBuf,
    /// File to write, - for standard output
    output: PathBuf,
    /// Format of OUTPUT, or of INPUT if only that is - [default: by extension]
    #[arg(long, value_name = "NAME", value_parser = names(), hide_possible_values = true)]
    format: Option<String>,
    /// Format of INPUT [default: by extension]
    #[arg(long, value_name = "NAME", value_parser = names(), hide_possible_values = true)]
    input_format: Option<String>,
    /// Columns of x and y, perhaps of heights, in a table, by name or number
    #[arg(long, value_name = "X,Y")]
    columns: Option<Columns>,
    /// Coordinate system that a mesh in .geojson or .nc names
    #[arg(long, value_name = "EPSG:N", value_parser = epsg)]
    crs: Option<u16>,
}

/// What is converted.
enum Content {
    Mesh(MeshData),
    Points(Pslg),
}

/// Runs the command.
pub(crate) fn run(args: &Args) -> Outcome {
    let [input, output] = args.formats()?;
    crs::refuse_unused(args.crs, [MeshFormat::from_name(&output)], [])?;
    let mut outputs = Outputs::default();
    if !is_stream(&args.input) {
        outputs.protect_input(&args.input);
    }
    let content = args.read(&input, &output)?;
    let holds = match &content {
        Content::Mesh(_) => MeshFormat::from_name(&output).is_some(),
        Content::Points(_) => PointFormat::from_name(&output).is_some(),
    };
    if !holds {
        let found = if matches!(content, Content::Mesh(_)) { "a mesh" } else { "points" };
        return Err(Failure::Conversion { file: name(&args.input, "input"), found, format: output });
    }
    let content = seeded(content, &output, &args.input)?;
    report_losses(&content, &output, &args.output);
    if is_stream(&args.output) {
        return to_stdout(&content, &output, args.crs);
    }
    // By its own extension the format may write a pair of files.
    let by_extension = match content {
        Content::Mesh(_) => MeshFormat::from_path(&args.output) == MeshFormat::from_name(&output),
        Content::Points(_) => PointFormat::from_path(&args.output) == PointFormat::from_name(&output),
    };
    match content {
        Content::Mesh(_) if by_extension => outputs.add_mesh(&args.output)?,
        Content::Points(_) if by_extension => outputs.add_points(&args.output)?,
        _ => outputs.add_text(&args.output)?,
    }
    outputs.write(|_, path| match &content {
        Content::Mesh(mesh) if by_extension => Ok(write_mesh(path, &view(mesh, args.crs))?),
        Content::Points(points) if by_extension => Ok(write_points(path, points)?),
        content => {
            let file = File::create(path);
            let mut file = file.map_err(|source| Failure::Output { file: path.to_owned(), source })?;
            write_to(&mut file, content, &output, args.crs, &args.output.display().to_string())
        }
    })?;
    Ok(Verdict::Holds)
}

impl Args {
    /// The names of the formats of input and output.
    fn formats(&self) -> Result<[String; 2], Failure> {
        let output = match (&self.format, is_stream(&self.output)) {
            (Some(format), true) => Some(format.clone()),
            // The format given is that of the input if only that needs one.
            (Some(format), false) if !is_stream(&self.input) || self.input_format.is_some() => {
                Some(format.clone())
            }
            (_, false) => extension(&self.output),
            (None, true) => None,
        };
        let spare = self.format.as_ref().filter(|_| is_stream(&self.input) && !is_stream(&self.output));
        let input = self.input_format.clone().or_else(|| spare.cloned()).or_else(|| extension(&self.input));
        let known = |format: Option<String>, path: &Path, stream: &'static str, known| match format {
            Some(format) if names_format(&format) => Ok(format),
            _ if is_stream(path) => Err(Failure::NoFormat { stream }),
            _ => Err(WriteError::UnknownExtension { file: path.display().to_string(), known }.into()),
        };
        Ok([known(input, &self.input, "input", READABLE)?, known(output, &self.output, "output", WRITABLE)?])
    }

    /// Reads the input as what the formats leave it to be.
    fn read(&self, input: &str, output: &str) -> Result<Content, Failure> {
        let mesh = MeshFormat::from_name(input);
        let points = PointFormat::from_name(input);
        let to_mesh = MeshFormat::from_name(output).is_some();
        let to_points = PointFormat::from_name(output).is_some_and(PointFormat::is_written);
        match (mesh, points) {
            (Some(MeshFormat::NodeEle), Some(points)) if to_points => self.points(points),
            (Some(mesh), Some(points)) if matches!(mesh, MeshFormat::Json | MeshFormat::Ron) => {
                self.refuse_columns()?;
                let bytes = self.bytes()?;
                let name = name(&self.input, "input");
                if holds_mesh(&bytes, mesh) {
                    Ok(Content::Mesh(read_mesh_from(&bytes[..], mesh, &name)?))
                } else {
                    Ok(Content::Points(self.reader().read_from(&bytes[..], points, &name)?.pslg))
                }
            }
            // A PSLG in .poly is no mesh, though the mesh formats have one.
            (Some(mesh), points) if to_mesh && (mesh.is_read() || points.is_none()) => self.mesh(mesh),
            (_, Some(points)) => self.points(points),
            (Some(mesh), None) => self.mesh(mesh),
            (None, None) => {
                Err(ReadError::UnknownExtension { file: name(&self.input, "input"), known: READABLE }.into())
            }
        }
    }

    fn mesh(&self, format: MeshFormat) -> Result<Content, Failure> {
        self.refuse_columns()?;
        let by_extension = MeshFormat::from_path(&self.input) == Some(format);
        Ok(Content::Mesh(if by_extension && !is_stream(&self.input) {
            read_mesh_data(&self.input)?
        } else {
            read_mesh_from(self.open()?, format, &name(&self.input, "input"))?
        }))
    }

    fn points(&self, format: PointFormat) -> Result<Content, Failure> {
        let by_extension = PointFormat::from_path(&self.input) == Some(format);
        let file = if by_extension && !is_stream(&self.input) {
            self.reader().read(&self.input)?
        } else {
            self.reader().read_from(self.open()?, format, &name(&self.input, "input"))?
        };
        warn_of(&file);
        refuse_columns(self.columns.as_ref(), &file, &self.input)?;
        Ok(Content::Points(file.pslg))
    }

    /// Of what cannot be a table.
    fn refuse_columns(&self) -> Result<(), Failure> {
        if self.columns.is_some() { no_table(&self.input) } else { Ok(()) }
    }

    fn reader(&self) -> PointReader {
        PointReader::new().columns(self.columns.clone())
    }

    fn open(&self) -> Result<Box<dyn BufRead>, Failure> {
        if is_stream(&self.input) {
            return Ok(Box::new(io::stdin().lock()));
        }
        match File::open(&self.input) {
            Ok(file) => Ok(Box::new(BufReader::new(file))),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                Err(ReadError::Missing { file: name(&self.input, "input") }.into())
            }
            Err(source) => Err(ReadError::Io { file: name(&self.input, "input"), source }.into()),
        }
    }

    fn bytes(&self) -> Result<Vec<u8>, Failure> {
        let mut bytes = Vec::new();
        let read = self.open()?.read_to_end(&mut bytes);
        read.map_err(|source| ReadError::Io { file: name(&self.input, "input"), source })?;
        Ok(bytes)
    }
}

const READABLE: &str = ".node, .ele, .vtu, .msh, .obj, .off, .mesh, .2dm, .14, .json, .ron, .poly, .csv, .tsv, \
    .xyz, .txt, .pts, .geojson, .geojsonl, .geojsons, .ndjson, .wkt, .shp";

const WRITABLE: &str = ".node, .ele, .edge, .neigh, .poly, .vtu, .vtk, .msh, .obj, .off, .mesh, .stl, .2dm, .14, \
    .nc, .geojson, .wkt, .json, .ron, .svg, .csv, .tsv, .xyz, .txt, .pts";

fn names_format(name: &str) -> bool {
    MeshFormat::from_name(name).is_some() || PointFormat::from_name(name).is_some()
}

/// What messages call the file.
fn name(path: &Path, stream: &str) -> String {
    if is_stream(path) { format!("standard {stream}") } else { path.display().to_string() }
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_str()?.to_ascii_lowercase())
}

/// For `.poly`, which has no polygons, the holes and regions that they are.
fn seeded(content: Content, output: &str, input: &Path) -> Result<Content, Failure> {
    match content {
        Content::Points(points)
            if !points.polygons.is_empty() && PointFormat::from_name(output) == Some(PointFormat::Poly) =>
        {
            let file = name(input, "input");
            let prepared = Mesher::new().prepared_pslg(&points);
            let prepared = prepared.map_err(|source| failure(&file, source, &points))?;
            warn_of_repairs(prepared.repairs.as_ref(), &file);
            warn_of_warnings(&prepared.warnings, &file, |_| file.clone(), "");
            Ok(Content::Points(prepared.graph))
        }
        content => Ok(content),
    }
}

/// Says what the format has no place for.
fn report_losses(content: &Content, format: &str, output: &Path) {
    let lost = match content {
        Content::Mesh(mesh) => MeshFormat::from_name(format).map(|format| mesh.view().lost_in(format)),
        Content::Points(points) => PointFormat::from_name(format).map(|format| format.lost(points)),
    };
    if let Some(lost) = lost.filter(|lost| !lost.is_empty()) {
        warn(&format!("{}: the format has no {}", name(output, "output"), lost.join(", ")));
    }
}

/// A mesh to be written, with its coordinate system.
fn view(mesh: &MeshData, crs: Option<u16>) -> MeshView<'_> {
    let mut view = mesh.view();
    view.epsg = crs;
    view
}

fn write_to(
    out: &mut dyn Write,
    content: &Content,
    format: &str,
    crs: Option<u16>,
    name: &str,
) -> Result<(), Failure> {
    match content {
        Content::Mesh(mesh) => {
            if let Some(format) = MeshFormat::from_name(format) {
                write_mesh_to(out, format, &view(mesh, crs), name)?;
            }
        }
        Content::Points(points) => {
            if let Some(format) = PointFormat::from_name(format) {
                write_points_to(out, format, points, name)?;
            }
        }
    }
    Ok(())
}

/// A reader that has seen enough and closed the pipe is no failure.
fn to_stdout(content: &Content, format: &str, crs: Option<u16>) -> Outcome {
    let mut out = io::stdout().lock();
    match write_to(&mut out, content, format, crs, "standard output") {
        Err(Failure::Write(WriteError::Io { source, .. })) if source.kind() != io::ErrorKind::BrokenPipe => {
            Err(Failure::Stdout(source))
        }
        Err(Failure::Write(WriteError::Io { .. })) | Ok(()) => Ok(Verdict::Holds),
        Err(other) => Err(other),
    }
}
