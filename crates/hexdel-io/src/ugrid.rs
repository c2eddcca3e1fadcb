//! UGRID, `.nc`: unstructured grids in `NetCDF` by the conventions CF-1.8 and UGRID-1.0, of
//! triangles or of Voronoi cells.
//!
//! The topology is the variable `mesh2d`; nodes, faces and edges are counted from 0. Beside
//! them stand what is known: `mesh2d_node_z` (heights), `mesh2d_node_marker`,
//! `mesh2d_node_input_index` (-1 for Steiner points), `mesh2d_edge_marker` and
//! `mesh2d_face_region`; of cells `mesh2d_face_vertex` and `mesh2d_face_area`, with the vertex
//! as the centre of the face. A coordinate system is the grid mapping `projected_coordinate_system`, which
//! knows it by its number or by PROJ's parameters; that of longitudes and latitudes is `wgs84`.

use std::io::{self, Write};

use hexdel_geom::{DVec2, TriMesh, Voronoi};

use crate::dual::Cells;
use crate::error::WriteError;
use crate::netcdf::{self, Attribute, Values, Variable};
use crate::topology::{EdgeMarkers, Edges, counter_clockwise};
use crate::view::MeshView;

const NODE: &str = "mesh2d_nNodes";
const FACE: &str = "mesh2d_nFaces";
const EDGE: &str = "mesh2d_nEdges";
const CORNER: &str = "mesh2d_nMax_face_nodes";
const TWO: &str = "Two";

/// The variable that names the coordinate system, as `Delft3D` and QGIS know it.
const SYSTEM: &str = "projected_coordinate_system";

/// The same of longitudes and latitudes.
const DEGREES: &str = "wgs84";

/// The number of WGS 84 in the register of EPSG.
const WGS84: u16 = 4326;

/// The corner of a face that has fewer than others.
const NO_NODE: i32 = -1;

/// Finds what `NetCDF` cannot hold.
pub(crate) fn check(mesh: &TriMesh, file: &str) -> Result<(), WriteError> {
    netcdf::check_count("vertices", mesh.vertices.len(), file)?;
    netcdf::check_count("triangles", mesh.triangles.len(), file)
}

/// Writes a mesh that has triangles.
pub(crate) fn write_ugrid(out: &mut dyn Write, view: &MeshView<'_>) -> io::Result<()> {
    let (mesh, edges) = (view.mesh, Edges::new(view.mesh));
    let edge_count = edges.iter().count();
    let dimensions = [
        (NODE, mesh.vertices.len()),
        (FACE, mesh.triangles.len()),
        (EDGE, edge_count),
        (CORNER, 3),
        (TWO, 2),
    ];
    let markers = view.marked_edges.map(EdgeMarkers::new);
    let mut topology = topology();
    topology.attributes.push(("edge_node_connectivity", Attribute::Text("mesh2d_edge_nodes")));
    topology.attributes.push(("edge_dimension", Attribute::Text(EDGE)));
    let corners =
        (0..mesh.triangles.len()).flat_map(|t| counter_clockwise(mesh, t)).map(|v| v.index() as i32);
    let ends = edges.iter().flat_map(|edge| edge.ends).map(|v| v as i32);
    let mut variables = vec![topology];
    variables.extend(coordinates(view, ["mesh2d_node_x", "mesh2d_node_y"], &[NODE], &mesh.vertices));
    variables.push(connectivity("mesh2d_face_nodes", "face_node_connectivity", &[FACE, CORNER], corners));
    variables.push(connectivity("mesh2d_edge_nodes", "edge_node_connectivity", &[EDGE, TWO], ends));
    if let Some(markers) = &markers {
        let of = |edge: crate::topology::Edge| markers.of(edge.ends).unwrap_or(0);
        variables.push(data("mesh2d_edge_marker", "edge", &[EDGE], Values::integers(edges.iter().map(of))));
    }
    variables.extend(node_data(view));
    if let Some(regions) = view.regions {
        variables.push(data("mesh2d_face_region", "face", &[FACE], Values::numbers(regions.iter().copied())));
    }
    write(out, &dimensions, variables, view)
}

fn node_data<'a>(view: &MeshView<'a>) -> Vec<Variable<'a>> {
    let mut all = Vec::new();
    if let Some(heights) = view.heights {
        let mut heights = data("mesh2d_node_z", "node", &[NODE], Values::numbers(heights.iter().copied()));
        heights.attributes.push(("standard_name", Attribute::Text("altitude")));
        heights.attributes.push(("coordinates", Attribute::Text("mesh2d_node_x mesh2d_node_y")));
        all.push(heights);
    }
    if let Some(markers) = view.vertex_markers {
        all.push(data("mesh2d_node_marker", "node", &[NODE], Values::integers(markers.iter().copied())));
    }
    if let Some(indices) = view.input_indices {
        // Doubles hold all of them, 32-bit integers do not.
        let indices = indices.iter().map(|index| index.map_or(-1.0, f64::from));
        all.push(data("mesh2d_node_input_index", "node", &[NODE], Values::numbers(indices)));
    }
    all
}

/// Writes the cells of a mesh that has triangles.
pub(crate) fn write_dual_ugrid(
    out: &mut dyn Write,
    view: &MeshView<'_>,
    dual: &Voronoi<'_>,
) -> io::Result<()> {
    let mesh = view.mesh;
    let cells = Cells::of(view, dual);
    let most = cells.iter().map(|(_, ring)| ring.len()).max().unwrap_or(0);
    let dimensions = [(NODE, cells.corners.len()), (FACE, cells.vertices.len()), (CORNER, most)];
    let centres: Vec<DVec2> = cells.iter().map(|(vertex, _)| mesh.vertices[vertex]).collect();
    let areas = cells.iter().map(|(vertex, _)| dual.areas[vertex]);
    let corners = cells.iter().flat_map(|(_, ring)| {
        let padding = std::iter::repeat_n(NO_NODE, most - ring.len());
        ring.iter().map(|&corner| corner as i32).chain(padding)
    });
    let mut topology = topology();
    topology.attributes.push(("face_coordinates", Attribute::Text("mesh2d_face_x mesh2d_face_y")));
    let mut variables = vec![topology];
    variables.extend(coordinates(view, ["mesh2d_node_x", "mesh2d_node_y"], &[NODE], &cells.corners));
    variables.extend(coordinates(view, ["mesh2d_face_x", "mesh2d_face_y"], &[FACE], &centres));
    let mut faces = connectivity("mesh2d_face_nodes", "face_node_connectivity", &[FACE, CORNER], corners);
    faces.attributes.push(("_FillValue", Attribute::Integer(NO_NODE)));
    variables.push(faces);
    let vertices = cells.iter().map(|(vertex, _)| vertex as i32);
    variables.push(data("mesh2d_face_vertex", "face", &[FACE], Values::integers(vertices)));
    variables.push(data("mesh2d_face_area", "face", &[FACE], Values::numbers(areas)));
    write(out, &dimensions, variables, view)
}

/// Writes a file, with its coordinate system if that is known.
fn write(
    out: &mut dyn Write,
    dimensions: &[(&str, usize)],
    variables: Vec<Variable<'_>>,
    view: &MeshView<'_>,
) -> io::Result<()> {
    let of_degrees = view.geographic.is_some();
    let number = view.epsg.or(of_degrees.then_some(WGS84));
    if number.is_none() && view.definition.is_none() {
        return netcdf::write(out, dimensions, &CONVENTIONS, variables);
    }
    let system = if of_degrees { DEGREES } else { SYSTEM };
    let code = number.map(|number| format!("EPSG:{number}"));
    let mut variables = variables;
    for variable in &mut variables {
        if variable.attributes.iter().any(|(name, _)| *name == "location") {
            variable.attributes.push(("grid_mapping", Attribute::Text(system)));
        }
    }
    let mut attributes = Vec::new();
    if let (Some(number), Some(code)) = (number, &code) {
        attributes.push(("name", Attribute::Text(code)));
        attributes.push(("epsg", Attribute::Integer(number.into())));
        attributes.push(("EPSG_code", Attribute::Text(code)));
    }
    if of_degrees {
        attributes.push(("grid_mapping_name", Attribute::Text("latitude_longitude")));
    } else if let Some(definition) = view.definition {
        attributes.push(("proj4_params", Attribute::Text(definition)));
    }
    let values = Values::integers([number.map_or(0, i32::from)]);
    variables.push(Variable { name: system, dimensions: &[], attributes, values });
    netcdf::write(out, dimensions, &CONVENTIONS, variables)
}

const CONVENTIONS: [(&str, Attribute<'_>); 1] = [("Conventions", Attribute::Text("CF-1.8 UGRID-1.0"))];

/// The variable that says which variables make the grid.
fn topology() -> Variable<'static> {
    let attributes = vec![
        ("cf_role", Attribute::Text("mesh_topology")),
        ("topology_dimension", Attribute::Integer(2)),
        ("node_coordinates", Attribute::Text("mesh2d_node_x mesh2d_node_y")),
        ("node_dimension", Attribute::Text(NODE)),
        ("face_node_connectivity", Attribute::Text("mesh2d_face_nodes")),
        ("face_dimension", Attribute::Text(FACE)),
    ];
    Variable { name: "mesh2d", dimensions: &[], attributes, values: Values::integers([0]) }
}

fn coordinates<'a>(
    view: &MeshView<'_>,
    names: [&'a str; 2],
    dimensions: &'a [&'a str],
    places: &'a [DVec2],
) -> [Variable<'a>; 2] {
    let [x, y]: [Values<'a>; 2] =
        [Values::numbers(places.iter().map(|p| p.x)), Values::numbers(places.iter().map(|p| p.y))];
    let variable = |name, standard, units: Option<&'static str>, values| {
        let standard = [("standard_name", Attribute::Text(standard))];
        let units = units.map(|units| ("units", Attribute::Text(units)));
        Variable { name, dimensions, attributes: standard.into_iter().chain(units).collect(), values }
    };
    if view.geographic.is_some() {
        let longitude = variable(names[0], "longitude", Some("degrees_east"), x);
        return [longitude, variable(names[1], "latitude", Some("degrees_north"), y)];
    }
    let metres = view.definition.map(|_| "m");
    [
        variable(names[0], "projection_x_coordinate", metres, x),
        variable(names[1], "projection_y_coordinate", metres, y),
    ]
}

fn connectivity<'a>(
    name: &'a str,
    role: &'a str,
    dimensions: &'a [&'a str],
    nodes: impl Iterator<Item = i32> + 'a,
) -> Variable<'a> {
    let attributes = vec![("cf_role", Attribute::Text(role)), ("start_index", Attribute::Integer(0))];
    Variable { name, dimensions, attributes, values: Values::integers(nodes) }
}

/// A variable with a value at each node, edge or face.
fn data<'a>(name: &'a str, location: &'a str, dimensions: &'a [&'a str], values: Values<'a>) -> Variable<'a> {
    let attributes = vec![("mesh", Attribute::Text("mesh2d")), ("location", Attribute::Text(location))];
    Variable { name, dimensions, attributes, values }
}
