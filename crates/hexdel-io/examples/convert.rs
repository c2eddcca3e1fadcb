//! Brings a mesh or points to another format, by the names of the files:
//! `cargo run -p hexdel-io --example convert -- IN OUT`. Without names, it takes a fixture through
//! several formats and back.
#![allow(clippy::print_stdout, reason = "what an example writes is its result")]

use hexdel_io::{
    MeshFormat, read_mesh_data, read_mesh_from, read_points, write_mesh, write_mesh_to, write_points,
};
use std::error::Error;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let paths: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    match paths.as_slice() {
        [from, to] => convert(from, to),
        [] => tour(),
        _ => Err("give two files, or none".into()),
    }
}

/// A mesh if the file holds one, points or a graph otherwise.
fn convert(from: &Path, to: &Path) -> Result<(), Box<dyn Error>> {
    if let Ok(data) = read_mesh_data(from) {
        write_mesh(to, &data.view())?;
        println!("{} vertices, {} triangles", data.mesh.vertices.len(), data.mesh.triangles.len());
    } else {
        let graph = read_points(from)?;
        write_points(to, &graph)?;
        println!("{} points, {} segments", graph.points.len(), graph.segments.len());
    }
    Ok(())
}

/// What formats make of one mesh: sizes, and whether the same mesh comes back.
fn tour() -> Result<(), Box<dyn Error>> {
    let fixture = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/formats/fan.ele");
    let data = read_mesh_data(fixture)?;
    let formats = [
        MeshFormat::Vtu,
        MeshFormat::Msh41,
        MeshFormat::Obj,
        MeshFormat::Off,
        MeshFormat::Json,
        MeshFormat::Ron,
    ];
    for format in formats {
        let mut bytes = Vec::new();
        write_mesh_to(&mut bytes, format, &data.view(), "a stream")?;
        let back = read_mesh_from(bytes.as_slice(), format, "a stream")?;
        assert_eq!(back.mesh, data.mesh, "{format:?}");
        println!("{format:?}: {} bytes, and back", bytes.len());
    }
    Ok(())
}
