//! Writing files: which writer for which format, all or nothing.

use std::io::{self, Write};
use std::path::Path;

use hexdel_geom::{DVec2, Pslg};

use crate::atomic::Draft;
use crate::error::WriteError;
use crate::format::{MeshFormat, PointFormat};
use crate::read::beside;
use crate::text::TextWriter;
use crate::view::MeshView;
use crate::{mesh_ron, picture, svg, triangle_out, vtu};

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
/// `.vtu` and `.ron`, and 12 bytes per triangle for pictures.
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
/// [`WriteError::TwoFiles`] for [`MeshFormat::NodeEle`], otherwise as
/// [`write_mesh`].
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

/// Writes points, and segments, holes and regions if the format has them.
///
/// # Guarantees
///
/// As [`write_mesh`]. A table holds points alone, without attributes and markers.
///
/// # Errors
///
/// [`WriteError::PointsOnly`] if the format would lose segments, holes or regions;
/// any other [`WriteError`] but [`WriteError::TwoFiles`].
pub fn write_points(path: impl AsRef<Path>, pslg: &Pslg) -> Result<(), WriteError> {
    let path = path.as_ref();
    let name = path.display().to_string();
    let Some(format) = PointFormat::from_path(path) else {
        return Err(WriteError::UnknownExtension { file: name, known: PointFormat::EXTENSIONS });
    };
    check_points(format, pslg, &name)?;
    let mut draft = Draft::create(path)?;
    draft.write(|out| match format {
        PointFormat::Node => triangle_out::write_points(out, pslg),
        PointFormat::Poly => triangle_out::write_poly(out, pslg),
        PointFormat::Table => write_table(out, path, &pslg.points),
    })?;
    draft.publish()
}

type StreamWriter = fn(&mut dyn Write, &MeshView<'_>) -> io::Result<()>;

/// What writes the format, if it is a single file.
fn stream_writer(format: MeshFormat) -> Option<StreamWriter> {
    match format {
        MeshFormat::Vtu => Some(vtu::write_vtu),
        MeshFormat::Ron => Some(mesh_ron::write_ron),
        MeshFormat::Svg => Some(svg::write_svg),
        #[cfg(feature = "png")]
        MeshFormat::Png => Some(crate::png::write_png),
        MeshFormat::NodeEle => None,
    }
}

fn check(format: MeshFormat, view: &MeshView<'_>, name: &str) -> Result<(), WriteError> {
    view.check(name)?;
    if format.is_picture() {
        picture::check(view, name)?;
    }
    Ok(())
}

fn check_points(format: PointFormat, pslg: &Pslg, name: &str) -> Result<(), WriteError> {
    pslg.check_layout().map_err(|source| WriteError::Layout { file: name.to_owned(), source })?;
    for (item, points) in [("point", &pslg.points), ("hole", &pslg.holes)] {
        check_finite(item, points.iter().copied(), name)?;
    }
    check_finite("region", pslg.regions.iter().map(|r| r.point), name)?;
    if format == PointFormat::Poly {
        return Ok(());
    }
    let lost = [
        ("segments", pslg.segments.is_empty()),
        ("holes", pslg.holes.is_empty()),
        ("regions", pslg.regions.is_empty()),
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

/// Comma and tab tables have a header, others are bare numbers.
fn write_table(out: &mut dyn Write, path: &Path, points: &[DVec2]) -> io::Result<()> {
    let has = |extension| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension));
    let (delimiter, header) = match (has("csv"), has("tsv")) {
        (true, _) => (",", "x,y\n"),
        (_, true) => ("\t", "x\ty\n"),
        _ => (" ", ""),
    };
    let mut text = TextWriter::new(out);
    text.text(header);
    for p in points {
        text.number(p.x).text(delimiter).number(p.y);
        text.text("\n").breathe()?;
    }
    text.finish()
}
