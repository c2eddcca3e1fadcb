//! Writing files: which writer for which format, all or nothing.

use std::io::{self, Write};
use std::path::Path;

use hexdel_geom::{DVec2, Pslg};
#[cfg(feature = "plot")]
use hexdel_plot::PlotError;

use crate::atomic::Draft;
use crate::error::WriteError;
use crate::format::{MeshFormat, PointFormat};
use crate::read::beside;
use crate::text::TextWriter;
use crate::view::MeshView;
use crate::{
    fort14, graph_geojson, graph_json, graph_ron, medit, mesh_json, mesh_ron, msh_out, obj, off,
    polygons_out, stl, triangle_out, twodm, ugrid, vtk, vtu,
};

/// Writes a mesh, or its picture, in the format that the extension stands for.
///
/// A `.node` or `.ele` path stands for the pair of both.
///
/// # Guarantees
///
/// The file appears complete or not at all, and an older file of that name stays
/// as it was on failure; of a pair, both are complete before either appears (if
/// the system then refuses to rename the second, the first is already there).
/// Coordinates read back to the same bits from every format but pictures. The same
/// arguments give the same bytes on every platform.
///
/// # Errors
///
/// Every [`WriteError`] but [`WriteError::TwoFiles`] and
/// [`WriteError::PointsOnly`].
///
/// # Complexity
///
/// Linear in the size of the mesh; extra memory is a constant for `.node`, `.ele`,
/// `.vtu` and `.ron`, eleven bytes per triangle for pictures, and the file for `.nc`.
pub fn write_mesh(path: impl AsRef<Path>, view: &MeshView<'_>) -> Result<(), WriteError> {
    let path = path.as_ref();
    let name = path.display().to_string();
    let Some(format) = MeshFormat::from_path(path) else {
        return Err(WriteError::UnknownExtension { file: name, known: MeshFormat::EXTENSIONS });
    };
    check(format, view, &name)?;
    if let Some(write) = stream_writer(format) {
        let mut draft = Draft::create(path)?;
        draft.write(|out| write(out, view))?;
        return draft.publish();
    }
    let mut nodes = Draft::create(&beside(path, "node"))?;
    let mut elements = Draft::create(&beside(path, "ele"))?;
    nodes.write(|out| triangle_out::write_node(out, view))?;
    elements.write(|out| triangle_out::write_ele(out, view))?;
    nodes.publish()?;
    elements.publish()
}

/// Writes a mesh, or its picture, to a stream, `name` being what errors call it.
///
/// # Errors
///
/// [`WriteError::TwoFiles`] for [`MeshFormat::NodeEle`], which
/// [`write_mesh_pair_to`] is for, otherwise as [`write_mesh`].
pub fn write_mesh_to(
    out: &mut dyn Write,
    format: MeshFormat,
    view: &MeshView<'_>,
    name: &str,
) -> Result<(), WriteError> {
    let Some(write) = stream_writer(format) else {
        return Err(WriteError::TwoFiles { file: name.to_owned(), format: ".node/.ele" });
    };
    check(format, view, name)?;
    write(out, view).map_err(WriteError::io(name))
}

/// Writes a mesh as Triangle's pair of `.node` and `.ele` to two streams, `name` being
/// what errors call it.
///
/// # Errors
///
/// As [`write_mesh`].
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, TriMesh, VertexId};
/// use hexdel_io::{MeshView, write_mesh_pair_to};
///
/// let vertices = vec![DVec2::ZERO, DVec2::X, DVec2::Y];
/// let mesh = TriMesh { vertices, triangles: vec![[0, 1, 2].map(VertexId::new)] };
/// let (mut nodes, mut elements) = (Vec::new(), Vec::new());
/// write_mesh_pair_to(&mut nodes, &mut elements, &MeshView::new(&mesh), "stream")?;
/// assert!(nodes.starts_with(b"3 2 ") && elements.starts_with(b"1 3 "));
/// # Ok::<(), hexdel_io::WriteError>(())
/// ```
pub fn write_mesh_pair_to(
    nodes: &mut dyn Write,
    elements: &mut dyn Write,
    view: &MeshView<'_>,
    name: &str,
) -> Result<(), WriteError> {
    check(MeshFormat::NodeEle, view, name)?;
    triangle_out::write_node(nodes, view).map_err(WriteError::io(name))?;
    triangle_out::write_ele(elements, view).map_err(WriteError::io(name))
}

/// Writes points, and segments, holes and regions if the format has them.
///
/// # Guarantees
///
/// As [`write_mesh`]. A table holds points alone, without attributes and markers.
///
/// # Errors
///
/// [`WriteError::ReadOnly`] if the format is not written, [`WriteError::PointsOnly`] if
/// it would lose segments, holes or regions; any other [`WriteError`] but
/// [`WriteError::TwoFiles`].
pub fn write_points(path: impl AsRef<Path>, pslg: &Pslg) -> Result<(), WriteError> {
    let path = path.as_ref();
    let name = path.display().to_string();
    let Some(format) = PointFormat::from_path(path) else {
        return Err(WriteError::UnknownExtension { file: name, known: PointFormat::EXTENSIONS });
    };
    // Other extensions of the format are of sequences, which are another text.
    let sequence = path.extension().is_some_and(|e| !e.eq_ignore_ascii_case("geojson"));
    if format == PointFormat::GeoJson && sequence {
        return Err(WriteError::ReadOnly { file: name, format: "sequences of geojson" });
    }
    check_points(format, pslg, &name)?;
    let mut draft = Draft::create(path)?;
    draft.write(|out| write_graph(out, format, pslg))?;
    draft.publish()
}

/// Writes points to a stream, `name` being what errors call it.
///
/// # Errors
///
/// As [`write_points`].
///
/// # Examples
///
/// ```
/// use hexdel_geom::{DVec2, Pslg};
/// use hexdel_io::{PointFormat, write_points_to};
///
/// let pslg = Pslg::from_points(vec![DVec2::new(0.5, 1.0)]);
/// let mut csv = Vec::new();
/// write_points_to(&mut csv, PointFormat::Csv, &pslg, "stream")?;
/// assert_eq!(csv, b"x,y\n0.5,1.0\n");
/// # Ok::<(), hexdel_io::WriteError>(())
/// ```
pub fn write_points_to(
    out: &mut dyn Write,
    format: PointFormat,
    pslg: &Pslg,
    name: &str,
) -> Result<(), WriteError> {
    check_points(format, pslg, name)?;
    write_graph(out, format, pslg).map_err(WriteError::io(name))
}

fn write_graph(out: &mut dyn Write, format: PointFormat, pslg: &Pslg) -> io::Result<()> {
    match format {
        PointFormat::Node => triangle_out::write_points(out, pslg),
        PointFormat::Poly => triangle_out::write_poly(out, pslg),
        PointFormat::Table => write_table(out, None, &pslg.points),
        PointFormat::Csv => write_table(out, Some(","), &pslg.points),
        PointFormat::Tsv => write_table(out, Some("\t"), &pslg.points),
        PointFormat::GeoJson => graph_geojson::write_geojson(out, pslg),
        PointFormat::Json => graph_json::write_graph(out, pslg),
        PointFormat::Ron => graph_ron::write_graph_ron(out, pslg),
        // Refused by `check_points`.
        _ => Err(io::ErrorKind::Unsupported.into()),
    }
}

type StreamWriter = fn(&mut dyn Write, &MeshView<'_>) -> io::Result<()>;

/// What writes the format, if it is a single file.
fn stream_writer(format: MeshFormat) -> Option<StreamWriter> {
    match format {
        MeshFormat::Vtu => Some(vtu::write_vtu),
        MeshFormat::Edge => Some(triangle_out::write_edge),
        MeshFormat::Neigh => Some(triangle_out::write_neigh),
        MeshFormat::Poly => Some(triangle_out::write_mesh_poly),
        MeshFormat::Msh41 => Some(msh_out::write_msh41),
        MeshFormat::Msh22 => Some(msh_out::write_msh22),
        MeshFormat::Obj => Some(obj::write_obj),
        MeshFormat::Off => Some(off::write_off),
        MeshFormat::Medit => Some(medit::write_medit),
        MeshFormat::Json => Some(mesh_json::write_json),
        MeshFormat::Ron => Some(mesh_ron::write_ron),
        MeshFormat::GeoJson => Some(polygons_out::write_geojson),
        MeshFormat::Wkt => Some(polygons_out::write_wkt),
        MeshFormat::TwoDm => Some(twodm::write_2dm),
        MeshFormat::Fort14 => Some(fort14::write_fort14),
        MeshFormat::Ugrid => Some(ugrid::write_ugrid),
        MeshFormat::Vtk => Some(vtk::write_vtk),
        MeshFormat::Stl => Some(stl::write_stl),
        #[cfg(feature = "plot")]
        MeshFormat::Svg => Some(|out, view| drawn(view.plot().write_svg(out))),
        #[cfg(feature = "png")]
        MeshFormat::Png => Some(|out, view| drawn(view.plot().write_png(out))),
        MeshFormat::NodeEle => None,
    }
}

/// What is left to fail of a picture that was checked: the system.
#[cfg(feature = "plot")]
fn drawn(result: Result<(), PlotError>) -> io::Result<()> {
    result.map_err(|error| match error {
        PlotError::Io(source) => source,
        other => io::Error::other(other),
    })
}

fn check(format: MeshFormat, view: &MeshView<'_>, name: &str) -> Result<(), WriteError> {
    view.check(name)?;
    match format {
        #[cfg(feature = "plot")]
        format if format.is_picture() => {
            view.plot().check().map_err(|source| WriteError::Picture { file: name.to_owned(), source })
        }
        MeshFormat::Medit => medit::check_regions(view, "Medit's format", name),
        MeshFormat::TwoDm => medit::check_regions(view, "the format .2dm", name),
        MeshFormat::Ugrid => ugrid::check(view.mesh, name),
        MeshFormat::Json | MeshFormat::GeoJson => {
            graph_json::check_numbers(view.regions.unwrap_or(&[]).iter().copied(), "region of triangle", name)
        }
        _ => Ok(()),
    }
}

fn check_points(format: PointFormat, pslg: &Pslg, name: &str) -> Result<(), WriteError> {
    if !format.is_written() {
        return Err(WriteError::ReadOnly { file: name.to_owned(), format: format.name() });
    }
    pslg.check_layout().map_err(|source| WriteError::Layout { file: name.to_owned(), source })?;
    for (item, points) in [("point", &pslg.points), ("hole", &pslg.holes)] {
        check_finite(item, points.iter().copied(), name)?;
    }
    check_finite("region", pslg.regions.iter().map(|r| r.point), name)?;
    match format {
        PointFormat::Poly if !pslg.polygons.is_empty() => {
            return Err(WriteError::Polygons { file: name.to_owned() });
        }
        PointFormat::Poly | PointFormat::Ron => return Ok(()),
        PointFormat::GeoJson => return graph_geojson::check(pslg, name),
        PointFormat::Json => return graph_json::check_writable(pslg, name),
        _ => {}
    }
    let lost = [
        ("segments", pslg.segments.is_empty()),
        ("holes", pslg.holes.is_empty()),
        ("regions", pslg.regions.is_empty()),
        ("polygons", pslg.polygons.is_empty()),
    ];
    match lost.into_iter().find(|(_, empty)| !empty) {
        None => Ok(()),
        Some((item, _)) => Err(WriteError::PointsOnly { file: name.to_owned(), item }),
    }
}

fn check_finite(
    item: &'static str,
    mut points: impl Iterator<Item = DVec2>,
    name: &str,
) -> Result<(), WriteError> {
    let mut index = 0;
    let bad = points.find(|p| {
        index += 1;
        !p.is_finite()
    });
    match bad {
        None => Ok(()),
        Some(p) => {
            Err(WriteError::NonFinite { file: name.to_owned(), item, index: index - 1, x: p.x, y: p.y })
        }
    }
}

/// Writes a table: with a header, or with spaces if there is no delimiter.
fn write_table(out: &mut dyn Write, delimiter: Option<&str>, points: &[DVec2]) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    if let Some(delimiter) = delimiter {
        text.text("x").text(delimiter).text("y\n");
    }
    for p in points {
        text.number(p.x).text(delimiter.unwrap_or(" ")).number(p.y);
        text.text("\n").breathe()?;
    }
    text.finish()
}
