//! Draws a hexagon of six triangles, one of them pulled out of shape, as SVG or PNG:
//! `cargo run -p hexdel-plot --example draw -- OUT`.

use hexdel_geom::{DVec2, TriMesh, VertexId};
use hexdel_plot::Plot;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::args().nth(1).ok_or("usage: draw OUT")?;
    let corner = |i: u32| DVec2::from_angle(f64::from(i) * std::f64::consts::FRAC_PI_3);
    let mut vertices: Vec<DVec2> = [DVec2::ZERO].into_iter().chain((0..6).map(corner)).collect();
    vertices[1] *= 1.4;
    let triangles = (0..6).map(|i| [0, i + 1, (i + 1) % 6 + 1].map(VertexId::new)).collect();
    let mesh = TriMesh { vertices, triangles };
    let mut plot = Plot::new(&mesh);
    plot.picture.size_px = 400.0;
    plot.picture.histogram = true;
    let mut bytes = Vec::new();
    if std::path::Path::new(&out).extension().is_some_and(|e| e == "svg") {
        plot.write_svg(&mut bytes)?;
    } else {
        png(&plot, &mut bytes)?;
    }
    Ok(std::fs::write(out, bytes)?)
}

#[cfg(feature = "png")]
fn png(plot: &Plot<'_>, bytes: &mut Vec<u8>) -> Result<(), Box<dyn std::error::Error>> {
    Ok(plot.write_png(bytes)?)
}

#[cfg(not(feature = "png"))]
fn png(_: &Plot<'_>, _: &mut Vec<u8>) -> Result<(), Box<dyn std::error::Error>> {
    Err("without the feature png, OUT must end in .svg".into())
}
