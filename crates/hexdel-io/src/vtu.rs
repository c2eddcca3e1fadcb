//! VTK's XML format of unstructured grids (`.vtu`), for `ParaView` and its kin.
//!
//! Cell data are `min_angle` and `max_angle` in degrees and `region`, the attribute
//! of the triangle's region; point data are `input_index` (-1 for Steiner points),
//! `marker` and `height`; field data say what the mesh was made to keep. What the mesh view
//! does not have is left out.
//!
//! Arrays are stored in place as base64 of little-endian binary with a 64-bit byte
//! count before them ("binary" in VTK's terms, uncompressed): coordinates keep
//! their bits, the file is well-formed XML (raw appended data is not), every array
//! is written in one pass without offsets, and all readers of the format know it.
//! The crate `vtkio` would build a second copy of the mesh in memory and a third
//! as XML, hence a writer of our own.

use std::io::{self, BufWriter, Write};

use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;
use hexdel_geom::{DVec2, TriangleId};

use crate::angles::angle_range_deg;
use crate::promised::Promised;
use crate::view::MeshView;

/// VTK's number of the cell type triangle.
pub(crate) const VTK_TRIANGLE: u8 = 5;

/// Writes a mesh.
pub(crate) fn write_vtu(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 16, out);
    begin_with(&mut out, &view.mesh.vertices, view.mesh.triangles.len(), view.promised)?;
    cells(&mut out, view)?;
    point_data(&mut out, view)?;
    cell_data(&mut out, view)?;
    end(&mut out)
}

/// Writes the file up to and with the points of so many cells.
pub(crate) fn begin(out: &mut dyn Write, points: &[DVec2], cells: usize) -> io::Result<()> {
    begin_with(out, points, cells, None)
}

fn begin_with(
    out: &mut dyn Write,
    points: &[DVec2],
    cells: usize,
    promised: Option<&Promised>,
) -> io::Result<()> {
    let count = points.len();
    write!(
        out,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" \
         byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <UnstructuredGrid>\n"
    )?;
    if let Some(promised) = promised {
        field_data(out, promised)?;
    }
    write!(out, "<Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{cells}\">\n<Points>\n")?;
    let coordinates = points.iter().flat_map(|p| [p.x, p.y, 0.0]).map(f64::to_le_bytes);
    let attributes = "type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"";
    array(out, attributes, 3 * count, coordinates)?;
    out.write_all(b"</Points>\n")
}

/// What the mesh was made to keep: four bounds, the number of the domain, the exempt
/// triangles.
fn field_data(out: &mut dyn Write, promised: &Promised) -> io::Result<()> {
    let Promised { near, far, domain, exempt } = promised;
    out.write_all(b"<FieldData>\n")?;
    let bounds = [near.min_deg(), near.max_deg(), far.min_deg(), far.max_deg()];
    let attributes = "type=\"Float64\" Name=\"hexdel_bounds\" NumberOfTuples=\"4\"";
    array(out, attributes, bounds.len(), bounds.into_iter().map(f64::to_le_bytes))?;
    let attributes = "type=\"UInt8\" Name=\"hexdel_domain\" NumberOfTuples=\"1\"";
    array(out, attributes, 1, std::iter::once([domain.number()]))?;
    let count = exempt.len();
    let attributes = format!("type=\"Int64\" Name=\"hexdel_exempt\" NumberOfTuples=\"{count}\"");
    array(out, &attributes, count, exempt.iter().map(|&t| i64::from(t).to_le_bytes()))?;
    out.write_all(b"</FieldData>\n")
}

/// Writes what stands after the last array of cell data.
pub(crate) fn end(out: &mut dyn Write) -> io::Result<()> {
    out.write_all(b"</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")?;
    out.flush()
}

fn cells(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let triangles = &view.mesh.triangles;
    let count = triangles.len();
    let corners = triangles.iter().flatten().map(|v| v.index());
    let ends = (1..=count).map(|i| 3 * i);
    out.write_all(b"<Cells>\n")?;
    // Half the size while the numbers fit.
    if i32::try_from(3 * count).is_ok() && i32::try_from(view.mesh.vertices.len()).is_ok() {
        let bytes = |i: usize| (i as i32).to_le_bytes();
        array(out, "type=\"Int32\" Name=\"connectivity\"", 3 * count, corners.map(bytes))?;
        array(out, "type=\"Int32\" Name=\"offsets\"", count, ends.map(bytes))?;
    } else {
        let bytes = |i: usize| (i as i64).to_le_bytes();
        array(out, "type=\"Int64\" Name=\"connectivity\"", 3 * count, corners.map(bytes))?;
        array(out, "type=\"Int64\" Name=\"offsets\"", count, ends.map(bytes))?;
    }
    let types = std::iter::repeat_n([VTK_TRIANGLE], count);
    array(out, "type=\"UInt8\" Name=\"types\"", count, types)?;
    out.write_all(b"</Cells>\n")
}

fn point_data(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    if view.input_indices.is_none() && view.vertex_markers.is_none() && view.heights.is_none() {
        return Ok(());
    }
    out.write_all(b"<PointData>\n")?;
    if let Some(indices) = view.input_indices {
        let values = indices.iter().map(|index| index.map_or(-1, i64::from));
        array(out, "type=\"Int64\" Name=\"input_index\"", indices.len(), values.map(i64::to_le_bytes))?;
    }
    if let Some(markers) = view.vertex_markers {
        let values = markers.iter().map(|m| m.to_le_bytes());
        array(out, "type=\"Int32\" Name=\"marker\"", markers.len(), values)?;
    }
    if let Some(heights) = view.heights {
        let values = heights.iter().map(|z| z.to_le_bytes());
        array(out, "type=\"Float64\" Name=\"height\"", heights.len(), values)?;
    }
    out.write_all(b"</PointData>\n")
}

fn cell_data(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let count = view.mesh.triangles.len();
    let ranges = || (0..count).map(|t| angle_range_deg(view.measured(TriangleId::new(t))));
    let smallest = ranges().map(|[min, _]| min.to_le_bytes());
    let largest = ranges().map(|[_, max]| max.to_le_bytes());
    out.write_all(b"<CellData>\n")?;
    array(out, "type=\"Float64\" Name=\"min_angle\"", count, smallest)?;
    array(out, "type=\"Float64\" Name=\"max_angle\"", count, largest)?;
    if let Some(regions) = view.regions {
        array(out, "type=\"Float64\" Name=\"region\"", count, regions.iter().map(|r| r.to_le_bytes()))?;
    }
    out.write_all(b"</CellData>\n")
}

/// Writes `count` values of `N` bytes each.
pub(crate) fn array<const N: usize>(
    out: &mut dyn Write,
    attributes: &str,
    count: usize,
    values: impl Iterator<Item = [u8; N]>,
) -> io::Result<()> {
    writeln!(out, "<DataArray {attributes} format=\"binary\">")?;
    // Feeding the encoder in bulk is several times as fast as value by value.
    let encoder = EncoderWriter::new(out, &STANDARD);
    let mut bytes = BufWriter::with_capacity(3 << 12, encoder);
    bytes.write_all(&((count * N) as u64).to_le_bytes())?;
    for value in values {
        bytes.write_all(&value)?;
    }
    let mut encoder = bytes.into_inner().map_err(io::IntoInnerError::into_error)?;
    encoder.finish()?.write_all(b"\n</DataArray>\n")
}
