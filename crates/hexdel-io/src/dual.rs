//! The Voronoi dual of a mesh: cells as polygons in `.vtu`, Triangle's `.v.node` and
//! `.v.edge`, and which writer is for which other format.
//!
//! In `.vtu` each vertex of the mesh is one polygon, its cell cut off at the
//! boundary; corners that cells share are one point. Cell data are `vertex`, the
//! index in the mesh, and `area`. In `.v.node` are the circumcentres, numbered as
//! the triangles are; in `.v.edge` the pairs of those that share an edge, and for an
//! edge of the boundary a ray that leaves the mesh, as Triangle's `-v` has it.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use hexdel_geom::{DVec2, VertexId, Voronoi};
use rustc_hash::FxHashMap;

use crate::atomic::Draft;
use crate::error::WriteError;
use crate::format::DualFormat;
use crate::text::TextWriter;
use crate::view::MeshView;
use crate::vtu::{self, array};
use crate::{disv, mpas, polygons_out, ugrid};

/// VTK's number of the cell type polygon.
const VTK_POLYGON: u8 = 7;

/// Writes the dual of a mesh in the format that the extension stands for. Of the view, the mesh and its
/// coordinate system are taken; of a [`Geographic`](crate::Geographic) one the dual is that of the plane.
///
/// A `.v.node` or `.v.edge` path stands for the pair of both.
///
/// # Guarantees
///
/// As [`write_mesh`](crate::write_mesh).
///
/// # Errors
///
/// [`WriteError::UnknownExtension`], [`WriteError::NotAFile`] and
/// [`WriteError::Io`]; for `NetCDF` also [`WriteError::Empty`] and [`WriteError::TooMany`].
///
/// # Complexity
///
/// Linear in the size of the mesh; about 200 bytes per vertex for formats with cells that share
/// corners, and the file in memory for `NetCDF`.
pub fn write_dual(path: impl AsRef<Path>, view: &MeshView<'_>, dual: &Voronoi<'_>) -> Result<(), WriteError> {
    let path = path.as_ref();
    let file = path.display().to_string();
    let Some(format) = DualFormat::from_path(path) else {
        return Err(WriteError::UnknownExtension { file, known: DualFormat::EXTENSIONS });
    };
    let write: Writer = match format {
        DualFormat::Vtu => write_vtu,
        DualFormat::GeoJson => polygons_out::write_dual_geojson,
        DualFormat::Wkt => polygons_out::write_dual_wkt,
        DualFormat::Disv => disv::write_disv,
        DualFormat::Ugrid | DualFormat::Mpas => {
            ugrid::check(view.mesh, &file)?;
            if format == DualFormat::Mpas { mpas::write_mpas } else { ugrid::write_dual_ugrid }
        }
        DualFormat::Voronoi => {
            let mut nodes = Draft::create(&path.with_extension("node"))?;
            let mut edges = Draft::create(&path.with_extension("edge"))?;
            nodes.write(|out| write_node(out, view, dual))?;
            edges.write(|out| write_edge(out, view, dual))?;
            nodes.publish()?;
            return edges.publish();
        }
    };
    let mut draft = Draft::create(path)?;
    draft.write(|out| write(out, view, dual))?;
    draft.publish()
}

/// What writes a format that is a single file.
type Writer = fn(&mut dyn Write, &MeshView<'_>, &Voronoi<'_>) -> io::Result<()>;

/// The cells of all vertices that have one.
pub(crate) struct Cells {
    pub(crate) corners: Vec<DVec2>,
    /// Indices of corners, cell after cell.
    rings: Vec<i64>,
    /// For each cell the number of indices up to its end.
    ends: Vec<i64>,
    /// The vertex of each cell.
    pub(crate) vertices: Vec<i64>,
}

impl Cells {
    pub(crate) fn of(view: &MeshView<'_>, dual: &Voronoi<'_>) -> Self {
        let mut cells =
            Self { corners: Vec::new(), rings: Vec::new(), ends: Vec::new(), vertices: Vec::new() };
        // Only looked up, never iterated.
        let mut known = FxHashMap::default();
        for vertex in 0..view.mesh.vertices.len() {
            let ring = dual.cell(VertexId::new(vertex));
            if ring.is_empty() {
                continue;
            }
            for corner in ring {
                let id = *known.entry(corner.to_array().map(f64::to_bits)).or_insert_with(|| {
                    cells.corners.push(corner);
                    cells.corners.len() as i64 - 1
                });
                cells.rings.push(id);
            }
            cells.ends.push(cells.rings.len() as i64);
            cells.vertices.push(vertex as i64);
        }
        cells.corners.iter_mut().for_each(|corner| *corner = view.placed(*corner));
        cells
    }

    /// The vertex of each cell, with the corners of the cell, counter-clockwise.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (usize, &[i64])> {
        (0..self.vertices.len()).map(|i| {
            let start = i.checked_sub(1).map_or(0, |before| self.ends[before]);
            (self.vertices[i] as usize, &self.rings[start as usize..self.ends[i] as usize])
        })
    }
}

fn write_vtu(out: &mut dyn Write, view: &MeshView<'_>, dual: &Voronoi<'_>) -> io::Result<()> {
    let cells = Cells::of(view, dual);
    let count = cells.vertices.len();
    let mut out = BufWriter::with_capacity(1 << 16, out);
    vtu::begin(&mut out, &cells.corners, count)?;
    out.write_all(b"<Cells>\n")?;
    integers(&mut out, "connectivity", &cells.rings)?;
    integers(&mut out, "offsets", &cells.ends)?;
    array(&mut out, "type=\"UInt8\" Name=\"types\"", count, std::iter::repeat_n([VTK_POLYGON], count))?;
    out.write_all(b"</Cells>\n<CellData>\n")?;
    integers(&mut out, "vertex", &cells.vertices)?;
    let areas = cells.vertices.iter().map(|&v| dual.areas[v as usize].to_le_bytes());
    array(&mut out, "type=\"Float64\" Name=\"area\"", count, areas)?;
    out.write_all(b"</CellData>\n")?;
    vtu::end(&mut out)
}

fn integers(out: &mut dyn Write, name: &str, values: &[i64]) -> io::Result<()> {
    let attributes = format!("type=\"Int64\" Name=\"{name}\"");
    array(out, &attributes, values.len(), values.iter().map(|i| i.to_le_bytes()))
}

fn write_node(out: &mut dyn Write, view: &MeshView<'_>, dual: &Voronoi<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.integer(dual.circumcentres.len()).text(" 2 0 0\n");
    for (i, p) in dual.circumcentres.iter().map(|&p| view.placed(p)).enumerate() {
        text.integer(i).text(" ").number(p.x).text(" ").number(p.y);
        text.text("\n").breathe()?;
    }
    text.finish()
}

fn write_edge(out: &mut dyn Write, view: &MeshView<'_>, dual: &Voronoi<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    text.integer(dual.edges.len()).text(" 0\n");
    for (i, edge) in dual.edges.iter().enumerate() {
        text.integer(i);
        let [from, to] = edge.ends.map(|v| view.mesh.vertices[v.index()]);
        match edge.triangles.map(|t| t.map(hexdel_geom::TriangleId::index)) {
            [Some(left), Some(right)] => {
                text.text(" ").integer(left).text(" ").integer(right);
            }
            [left, right] => {
                // The ray leaves on the side without a triangle.
                let outwards = if left.is_some() { (from - to).perp() } else { (to - from).perp() };
                text.text(" ").integer(left.or(right).unwrap_or_default()).text(" -1 ");
                text.number(outwards.x).text(" ").number(outwards.y);
            }
        }
        text.text("\n").breathe()?;
    }
    text.finish()
}
