//! Polygons for geographic information systems: triangles, or the Voronoi cells of vertices,
//! as `GeoJSON` (RFC 7946) and as well-known text.
//!
//! Rings are closed and counter-clockwise. In `GeoJSON` each polygon is a feature whose `id` is
//! the index of the triangle or vertex; well-known text has a polygon per line and no
//! properties. Heights, if the mesh has them, are third coordinates. A coordinate system is named as
//! `GeoJSON` did before RFC 7946, which is what its readers know: the standard has longitudes and
//! latitudes only.

use std::io::{self, Write};

use hexdel_geom::{DVec2, TriangleId, VertexId, Voronoi};

use crate::angles::angle_range_deg;
use crate::text::TextWriter;
use crate::topology::counter_clockwise;
use crate::view::MeshView;

/// A corner, with its height if that is known.
type Corner = (DVec2, Option<f64>);

/// Writes the triangles as features with the properties `region`, if it is known, `area`, and
/// `min_angle` and `max_angle` in degrees.
pub(crate) fn write_geojson(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    begin_features(&mut text, view.epsg);
    text.rows(0..view.mesh.triangles.len(), |text, t| {
        let [a, b, c] = view.measured(TriangleId::new(t));
        let [min, max] = angle_range_deg([a, b, c]);
        text.text("{\"type\": \"Feature\", \"id\": ").integer(t).text(", \"properties\": {");
        if let Some(regions) = view.regions {
            property(text, "region", regions[t]).text(", ");
        }
        property(text, "area", ((b - a).perp_dot(c - a) * 0.5).abs()).text(", ");
        property(text, "min_angle", min).text(", ");
        property(text, "max_angle", max);
        geometry(text, &triangle(view, t));
    })?;
    text.text("]}\n").finish()
}

/// Writes the cells as features with the properties `vertex`, its index, and `area`.
pub(crate) fn write_dual_geojson(
    out: &mut dyn Write,
    view: &MeshView<'_>,
    dual: &Voronoi<'_>,
) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    begin_features(&mut text, view.epsg);
    text.rows(cells(view, dual), |text, (vertex, ring)| {
        text.text("{\"type\": \"Feature\", \"id\": ").integer(vertex);
        text.text(", \"properties\": {\"vertex\": ").integer(vertex).text(", ");
        property(text, "area", dual.areas[vertex]);
        geometry(text, &ring);
    })?;
    text.text("]}\n").finish()
}

/// Writes the triangles, each as a `POLYGON` on a line of its own.
pub(crate) fn write_wkt(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    for t in 0..view.mesh.triangles.len() {
        polygon(&mut text, &triangle(view, t))?;
    }
    text.finish()
}

/// Writes the cells, each as a `POLYGON` on a line of its own.
pub(crate) fn write_dual_wkt(out: &mut dyn Write, view: &MeshView<'_>, dual: &Voronoi<'_>) -> io::Result<()> {
    let mut text = TextWriter::new(out);
    for (_, ring) in cells(view, dual) {
        polygon(&mut text, &ring)?;
    }
    text.finish()
}

fn begin_features(text: &mut TextWriter<'_>, epsg: Option<u16>) {
    text.text("{\"type\": \"FeatureCollection\", ");
    if let Some(number) = epsg {
        text.text("\"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"urn:ogc:def:crs:EPSG::");
        text.integer(number).text("\"}}, ");
    }
    text.text("\"features\": [");
}

/// The corners of a triangle, counter-clockwise.
fn triangle(view: &MeshView<'_>, t: usize) -> [Corner; 3] {
    counter_clockwise(view.mesh, t).map(|v| {
        let v = v.index();
        (view.mesh.vertices[v], view.heights.map(|heights| heights[v]))
    })
}

/// The vertices that have a cell, with its corners.
fn cells(view: &MeshView<'_>, dual: &Voronoi<'_>) -> impl Iterator<Item = (usize, Vec<Corner>)> {
    let cell = |v| dual.cell(VertexId::new(v)).into_iter().map(|p| (view.placed(p), None)).collect();
    (0..view.mesh.vertices.len())
        .map(move |v| (v, cell(v)))
        .filter(|(_, ring): &(_, Vec<_>)| !ring.is_empty())
}

/// Writes a property, which is null if JSON has no such number.
fn property<'t, 'w>(text: &'t mut TextWriter<'w>, name: &str, value: f64) -> &'t mut TextWriter<'w> {
    text.text("\"").text(name).text("\": ");
    if value.is_finite() { text.number(value) } else { text.text("null") }
}

/// Ends the properties of a feature and writes its geometry.
fn geometry(text: &mut TextWriter<'_>, corners: &[Corner]) {
    text.text("}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\": [[");
    for (i, (p, height)) in closed(corners).enumerate() {
        text.text(if i == 0 { "[" } else { ", [" }).number(p.x).text(", ").number(p.y);
        if let Some(height) = height {
            text.text(", ").number(*height);
        }
        text.text("]");
    }
    text.text("]]}}");
}

fn polygon(text: &mut TextWriter<'_>, corners: &[Corner]) -> io::Result<()> {
    let with_heights = corners.iter().any(|(_, height)| height.is_some());
    text.text(if with_heights { "POLYGON Z ((" } else { "POLYGON ((" });
    for (i, (p, height)) in closed(corners).enumerate() {
        text.text(if i == 0 { "" } else { ", " }).number(p.x).text(" ").number(p.y);
        if let Some(height) = height {
            text.text(" ").number(*height);
        }
    }
    text.text("))\n").breathe()
}

/// A ring ends where it begins.
fn closed(corners: &[Corner]) -> impl Iterator<Item = &Corner> {
    corners.iter().chain(corners.first())
}
