//! Brings a mesh or points to another format, by the names of the files:
//! `cargo run -p hexdel-io --example convert -- IN OUT`. Without names, it takes a fixture through
//! several formats and back.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "what an example writes is its result")]

use hexdel_io::{
    MeshFormat, PointFormat, read_mesh_data, read_mesh_from, read_points, write_mesh, write_mesh_to,
    write_points,
};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

fn main() -> ExitCode {
    let paths: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let done = match paths.as_slice() {
        [from, to] => convert(from, to),
        [] => tour(),
        _ => Err("give two files, or none".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// A mesh if the file holds one, points or a PSLG otherwise.
fn convert(from: &Path, to: &Path) -> Result<(), Box<dyn Error>> {
    match read_mesh_data(from) {
        Ok(data) => {
            write_mesh(to, &data.view())?;
            println!("{} vertices, {} triangles", data.mesh.vertices.len(), data.mesh.triangles.len());
        }
        Err(no_mesh) if PointFormat::from_path(from).is_some() => {
            // Some names stand for meshes and for points.
            let both = MeshFormat::from_path(from).is_some_and(MeshFormat::is_read);
            let graph = read_points(from).map_err(|error| {
                if both { format!("no mesh: {no_mesh}; no points: {error}") } else { error.to_string() }
            })?;
            write_points(to, &graph)?;
            println!("{} points, {} segments", graph.points.len(), graph.segments.len());
        }
        Err(error) => return Err(error.into()),
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
