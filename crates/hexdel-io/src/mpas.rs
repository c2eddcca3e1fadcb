//! The input of MPAS's mesh converter, `.mpas.nc`: `NetCDF` of a mesh in the plane.
//!
//! MPAS has the names the other way round: its cells are the Voronoi cells of vertices, its
//! vertices are the circumcentres of triangles. `cellsOnVertex` counts from 1, `meshDensity` is 1
//! everywhere, and the mesh is not on a sphere.

use std::io::{self, Write};

use hexdel_geom::{DVec2, Voronoi};

use crate::netcdf::{self, Attribute, Values, Variable};
use crate::topology::counter_clockwise;
use crate::view::MeshView;

const CELL: &str = "nCells";
const VERTEX: &str = "nVertices";
const DEGREE: &str = "vertexDegree";

/// Writes a mesh that has triangles.
pub(crate) fn write_mpas(out: &mut dyn Write, view: &MeshView<'_>, dual: &Voronoi<'_>) -> io::Result<()> {
    let mesh = view.mesh;
    let centres: Vec<DVec2> = dual.circumcentres.iter().map(|&p| view.placed(p)).collect();
    let dimensions = [(CELL, mesh.vertices.len()), (VERTEX, mesh.triangles.len()), (DEGREE, 3)];
    let attributes = [
        ("on_a_sphere", Attribute::Text("NO")),
        ("is_periodic", Attribute::Text("NO")),
        ("sphere_radius", Attribute::Number(0.0)),
    ];
    let variable = |name, dimensions, values| Variable { name, dimensions, attributes: Vec::new(), values };
    let corners =
        (0..mesh.triangles.len()).flat_map(|t| counter_clockwise(mesh, t)).map(|v| v.index() as i32 + 1);
    let zeros = |count| Values::numbers(std::iter::repeat_n(0.0, count));
    let variables = vec![
        variable("xCell", &[CELL], Values::numbers(mesh.vertices.iter().map(|p| p.x))),
        variable("yCell", &[CELL], Values::numbers(mesh.vertices.iter().map(|p| p.y))),
        variable("zCell", &[CELL], zeros(mesh.vertices.len())),
        variable("xVertex", &[VERTEX], Values::numbers(centres.iter().map(|p| p.x))),
        variable("yVertex", &[VERTEX], Values::numbers(centres.iter().map(|p| p.y))),
        variable("zVertex", &[VERTEX], zeros(mesh.triangles.len())),
        variable("cellsOnVertex", &[VERTEX, DEGREE], Values::integers(corners)),
        variable("meshDensity", &[CELL], Values::numbers(std::iter::repeat_n(1.0, mesh.vertices.len()))),
    ];
    netcdf::write(out, &dimensions, &attributes, variables)
}
