"""Reads the files that hexdel-io wrote with readers that are not ours.

Called with a folder; `expected.json` in it is what was written. meshio, netCDF4, shapely and
py2dm read what they know, a few lines below what they do not: the grids of ADCIRC and MODFLOW, the text formats of Triangle (its own
reader of .node and .ele is TetGen's and takes three dimensions only), data of elements
of .msh 2.2 beside groups, RON, and pictures.
"""

import itertools
import json
import math
import pathlib
import re
import struct
import sys
import xml.etree.ElementTree
import zlib

import meshio
import netCDF4
import numpy
import py2dm
import shapely

folder = pathlib.Path(sys.argv[1])
expected = json.loads((folder / "expected.json").read_text())
points = numpy.array(expected["vertices"], dtype=float)
triangles = numpy.array(expected["triangles"])
regions = numpy.array(expected["regions"])
markers = numpy.array(expected["vertex_markers"])
inputs = numpy.array([-1 if i is None else i for i in expected["input_indices"]])
heights = numpy.array(expected["heights"])
edges = numpy.array([edge["ends"] for edge in expected["marked_edges"]])
edge_markers = numpy.array([edge["marker"] for edge in expected["marked_edges"]])
exempt = numpy.isin(numpy.arange(len(triangles)), expected["promised"]["exempt"]).astype(float)
integral = bool(numpy.all(regions == regions.astype(int)))


def same(found, wanted, what):
    found, wanted = numpy.asarray(found), numpy.asarray(wanted)
    if found.shape != wanted.shape or not numpy.array_equal(found, wanted):
        raise SystemExit(f"{what}: found\n{found}\nexpected\n{wanted}")


def same_bits(found, what):
    """Positions to the last bit, signs of zeros included, and no height."""
    found = numpy.asarray(found, dtype=float)
    if found.shape[1] == 3:
        same(found[:, 2], numpy.zeros(len(found)), f"{what} heights")
    same(numpy.ascontiguousarray(found[:, :2]).view(numpy.uint64), points.view(numpy.uint64), what)


def blocks(mesh, kind, data=None):
    """The cells of a kind and their data, over all blocks."""
    cells = [b.data for b in mesh.cells if b.type == kind]
    if data is None:
        return numpy.concatenate(cells)
    values = [v for b, v in zip(mesh.cells, mesh.cell_data[data]) if b.type == kind]
    return numpy.concatenate(cells), numpy.concatenate(values)


def vtu(path):
    mesh = meshio.read(path)
    same_bits(mesh.points, path)
    same(blocks(mesh, "triangle"), triangles, path)
    same(mesh.point_data["marker"], markers, path)
    same(mesh.point_data["input_index"], inputs, path)
    same(mesh.point_data["height"], heights, path)
    same(mesh.cell_data["region"][0], regions, path)
    same(mesh.field_data["hexdel_bounds"], [30, 90, 43.8978, 90], path)
    same(mesh.field_data["hexdel_exempt"], expected["promised"]["exempt"], path)
    for name in ["min_angle", "max_angle"]:
        angles = mesh.cell_data[name][0]
        assert angles.shape == regions.shape and numpy.all((0 <= angles) & (angles <= 180)), path
    a, b, c = (points[triangles[-1]] * 0.5)
    by_law = angle(a, b, c), angle(b, c, a), angle(c, a, b)
    assert math.isclose(mesh.cell_data["min_angle"][0][-1], min(by_law), abs_tol=1e-6), path
    assert math.isclose(mesh.cell_data["max_angle"][0][-1], max(by_law), abs_tol=1e-6), path


def angle(a, b, c):
    u, v = b - a, c - a
    return math.degrees(math.atan2(abs(u[0] * v[1] - u[1] * v[0]), u[0] * v[0] + u[1] * v[1]))


def msh(path):
    mesh = meshio.read(path, file_format="gmsh")
    same_bits(mesh.points, path)
    # Triangles are listed by region, edges by marker, in their order otherwise.
    groups = numpy.where(regions == regions.astype(int), regions, 0).astype(int)
    order = numpy.argsort(groups, kind="stable")
    cells, physical = blocks(mesh, "triangle", "gmsh:physical")
    same(cells, triangles[order], path)
    same(physical, groups[order], path)
    if not integral:
        same(blocks(mesh, "triangle", "region")[1].ravel(), regions[order], path)
    same(blocks(mesh, "triangle", "exempt")[1].ravel(), exempt[order], path)
    order = numpy.argsort(edge_markers, kind="stable")
    cells, physical = blocks(mesh, "line", "gmsh:physical")
    same(cells, edges[order], path)
    same(physical, edge_markers[order], path)
    same(mesh.point_data["marker"].ravel(), markers, path)
    same(mesh.point_data["input_index"].ravel(), inputs, path)
    names = {("marker", int(m)) for m in edge_markers if m != 0}
    names |= {("region", int(g)) for g in groups if g != 0}
    promised = {"hexdel: angles 30 90 far 43.8978 90 domain box"}
    assert set(mesh.field_data) == {f"{kind} {number}" for kind, number in names} | promised, mesh.field_data


def msh2(path):
    # Of version 2.2 meshio does not divide data of elements among its blocks.
    lines = path.read_text().splitlines()
    section = lambda name: lines[lines.index(f"${name}") + 1 : lines.index(f"$End{name}")]
    nodes = [line.split() for line in section("Nodes")[1:]]
    same_bits(numpy.array([[float(x) for x in row[1:]] for row in nodes]), path)
    tags = {row[0]: i for i, row in enumerate(nodes)}
    elements = {row[0]: row for row in map(str.split, section("Elements")[1:]) if row[1] == "2"}
    # The last of such sections.
    end = len(lines) - 1 - lines[::-1].index("$EndElementData")
    order, found = zip(*(map(float, line.split()) for line in lines[end - len(elements) : end]))
    cells = [[tags[corner] for corner in elements[str(int(i))][-3:]] for i in order]
    sort = lambda rows, values: sorted(zip(map(tuple, rows), values))
    assert sort(cells, found) == sort(triangles.tolist(), exempt if integral else regions), path


def medit(path):
    mesh = meshio.read(path)
    same_bits(mesh.points, path)
    cells, references = blocks(mesh, "triangle", "medit:ref")
    same(cells, triangles, path)
    same(references, regions, path)
    cells, references = blocks(mesh, "line", "medit:ref")
    same(cells, edges, path)
    same(references, edge_markers, path)
    same(mesh.point_data["medit:ref"], markers, path)


def plain(path):
    mesh = meshio.read(path)
    same_bits(mesh.points, path)
    same(blocks(mesh, "triangle"), triangles, path)


def rows(path):
    lines = path.read_text().splitlines()
    return [[float(word) for word in line.split("#")[0].split()] for line in lines if line.split("#")[0].split()]


def numbered(section):
    assert [row[0] for row in section] == list(range(len(section)))
    return numpy.array([row[1:] for row in section])


def node_rows(header, body):
    assert header == [len(points), 2, 1, 1], header
    body = numbered(body)
    same_bits(body[:, :2], "nodes")
    same(body[:, 2], inputs, "nodes")
    same(body[:, 3], markers, "nodes")


def node(path):
    header, *body = rows(path)
    node_rows(header, body)


def ele(path):
    header, *body = rows(path)
    assert header == [len(triangles), 3, 1], header
    same(numbered(body)[:, :3], triangles, path)
    same(numbered(body)[:, 3], regions, path)


def edge(path):
    header, *body = rows(path)
    known = {tuple(sorted(ends)): marker for ends, marker in zip(edges.tolist(), edge_markers)}
    counts = {}
    for t in triangles.tolist():
        for k in range(3):
            ends = tuple(sorted((t[k], t[k - 1])))
            counts[ends] = counts.get(ends, 0) + 1
    wanted = [[*ends, known.get(ends, int(n == 1))] for ends, n in sorted(counts.items())]
    assert header == [len(wanted), 1], header
    same(numbered(body), wanted, path)


def neigh(path):
    header, *body = rows(path)
    assert header == [len(triangles), 3], header
    sides = {}
    for i, t in enumerate(triangles.tolist()):
        for k in range(3):
            sides.setdefault(frozenset((t[k - 2], t[k - 1])), []).append(i)
    def across(i, k):
        t = triangles[i].tolist()
        others = [j for j in sides[frozenset((t[k - 2], t[k - 1]))] if j != i]
        return others[0] if others else -1
    wanted = [[across(i, k) for k in range(3)] for i in range(len(triangles))]
    same(numbered(body), wanted, path)


def poly(path):
    body = rows(path)
    node_rows(body[0], body[1 : 1 + len(points)])
    header, *segments = body[1 + len(points) : -1]
    assert header == [len(edges), 1] and body[-1] == [0], header
    same(numbered(segments)[:, :2], edges, path)
    same(numbered(segments)[:, 2], edge_markers, path)


def json_mesh(path):
    assert json.loads(path.read_text()) == expected, path


def ron_value(tokens):
    """One value of RON: structs become dicts, tuples and lists lists, Some(x) is x."""
    token = next(tokens)
    if token == "None":
        return None
    if token == "Some":
        [value] = ron_value(tokens)
        return value
    if re.fullmatch("[a-z_]+", token) and token not in ("true", "false"):
        return token
    if token not in "([":
        return json.loads(token)
    items, fields = [], {}
    for token in tokens:
        if token in ")]":
            return fields or items
        if token == ",":
            continue
        if re.fullmatch("[a-z_]+", token):
            assert next(tokens) == ":", token
            fields[token] = ron_value(tokens)
        else:
            items.append(ron_value(itertools.chain([token], tokens)))


def ron(path):
    tokens = iter(re.findall(r"[()\[\]:,]|[^()\[\]:,\s]+", path.read_text()))
    found = ron_value(tokens)
    assert {name: found[name] for name in expected} == expected and not list(tokens), path


def png(path):
    content = path.read_bytes()
    assert content[:8] == b"\x89PNG\r\n\x1a\n", path
    at, data = 8, b""
    while at < len(content):
        length, kind = struct.unpack(">I4s", content[at : at + 8])
        body = content[at + 8 : at + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack(">I", content[at + 8 + length : at + 12 + length])[0], path
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", body[:10])
        data += body if kind == b"IDAT" else b""
        at += 12 + length
    channels = {2: 3, 6: 4}[colours]
    pixels = zlib.decompress(data)
    assert kind == b"IEND" and depth == 8 and len(pixels) == height * (1 + channels * width), path
    assert len(set(pixels)) > 10, "an empty picture"


def svg(path):
    root = xml.etree.ElementTree.parse(path).getroot()
    assert root.tag.endswith("svg"), path


def vtk(path):
    mesh = meshio.read(path)
    same_bits(mesh.points, path)
    same(blocks(mesh, "triangle"), triangles, path)
    same(mesh.point_data["marker"].ravel(), markers, path)
    same(mesh.point_data["input_index"].ravel(), inputs, path)
    same(mesh.point_data["height"].ravel(), heights, path)
    same(mesh.cell_data["region"][0].ravel(), regions, path)
    range_deg = [mesh.cell_data[name][0] for name in ["min_angle", "max_angle"]]
    assert numpy.all(range_deg[0] > 0) and numpy.all(range_deg[1] < 180), path


def stl(path):
    # meshio gives equal corners one number, so places are compared.
    mesh = meshio.read(path)
    same(mesh.points[blocks(mesh, "triangle")][:, :, :2], points[triangles], path)
    same(mesh.cell_data["facet_normals"][0], [[0, 0, 1]] * len(triangles), path)


def boundary():
    """The edges of the boundary with the mesh on the left, with their markers, 0 if they have none."""
    marker = {frozenset(ends): m for ends, m in zip(edges.tolist(), edge_markers.tolist())}
    sides = [(t[k - 1], t[k]) for t in triangles.tolist() for k in range(3)]
    return {side: marker.get(frozenset(side), 0) for side in sides if side[::-1] not in sides}


def windows(nodes):
    return list(zip(nodes, nodes[1:]))


def sms(path):
    with py2dm.Reader(str(path)) as mesh:
        nodes = list(mesh.iter_nodes())
        assert [node.id for node in nodes] == list(range(1, len(points) + 1)), path
        same_bits(numpy.array([[node.x, node.y] for node in nodes]), path)
        same([node.z for node in nodes], heights, path)
        elements = list(mesh.iter_elements())
        same([element.nodes for element in elements], triangles + 1, path)
        same([element.materials[0] for element in elements], regions.astype(int), path)
        found = {}
        for string in mesh.iter_node_strings():
            found |= {(a - 1, b - 1): int(string.name) for a, b in windows(string.nodes)}
    assert found == {side: marker for side, marker in boundary().items() if marker != 0}, path


def adcirc(path):
    lines = [line.split("=")[0].split() for line in path.read_text().splitlines()[1:]]
    rows = iter([[float(word) for word in line] for line in lines])
    assert next(rows) == [len(triangles), len(points)], path
    nodes = numpy.array([next(rows) for _ in points])
    same(nodes[:, 0], numpy.arange(1, len(points) + 1), path)
    same_bits(nodes[:, 1:3], path)
    same(nodes[:, 3], -heights, path)
    elements = numpy.array([next(rows) for _ in triangles])
    same(elements[:, 1:], numpy.column_stack([[3] * len(triangles), triangles + 1]), path)
    found = {}
    for kind in ["open", "land"]:
        [count], [total] = next(rows), next(rows)
        for _ in range(int(count)):
            length, *ibtype = next(rows)
            nodes = [int(next(rows)[0]) - 1 for _ in range(int(length))]
            assert kind == "open" or ibtype == [0], path
            total -= length
            found |= {side: kind for side in windows(nodes)}
        assert total == 0, path
    assert next(rows, None) is None, path
    assert found == {side: "open" if marker < 0 else "land" for side, marker in boundary().items()}, path


def ugrid(path):
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        assert file.data_model == "NETCDF3_64BIT_OFFSET" and file.Conventions == "CF-1.8 UGRID-1.0", path
        mesh = file["mesh2d"]
        assert mesh.cf_role == "mesh_topology" and mesh.topology_dimension == 2, path
        same_bits(numpy.column_stack([file[name][:] for name in mesh.node_coordinates.split()]), path)
        faces, ends = file[mesh.face_node_connectivity], file[mesh.edge_node_connectivity]
        assert faces.start_index == ends.start_index == 0, path
        same(faces[:], triangles, path)
        sides = {frozenset((t[k - 1], t[k])) for t in triangles.tolist() for k in range(3)}
        assert sorted(map(sorted, sides)) == ends[:].tolist(), path
        marker = {frozenset(e): m for e, m in zip(edges.tolist(), edge_markers.tolist())}
        same(file["mesh2d_edge_marker"][:], [marker.get(frozenset(e), 0) for e in ends[:].tolist()], path)
        for name, values in [
            ("node_z", heights), ("node_marker", markers), ("node_input_index", inputs), ("face_region", regions),
        ]:
            variable = file[f"mesh2d_{name}"]
            assert file[variable.grid_mapping].epsg == 25832, path
            assert variable.mesh == "mesh2d" and variable.location == name.split("_")[0], path
            same(variable[:], values, path)


def features(path):
    return json.loads(path.read_text())["features"]


def polygons(shapes, wanted, what):
    """Rings are closed and counter-clockwise."""
    for shape, ring in zip(shapes, wanted, strict=True):
        assert shape.is_valid and shape.exterior.is_ccw and not shape.interiors, what
        same(shapely.get_coordinates(shape, include_z=shape.has_z)[:-1], ring, what)


def raised():
    return numpy.column_stack([points, heights])[triangles]


def geojson(path):
    found = features(path)
    assert json.loads(path.read_text())["crs"]["properties"] == {"name": "urn:ogc:def:crs:EPSG::25832"}, path
    polygons([shapely.geometry.shape(feature["geometry"]) for feature in found], raised(), path)
    assert [feature["id"] for feature in found] == list(range(len(triangles))), path
    same([feature["properties"]["region"] for feature in found], regions, path)
    areas = [shapely.geometry.shape(feature["geometry"]).area for feature in found]
    assert numpy.allclose([feature["properties"]["area"] for feature in found], areas, rtol=1e-9), path


def wkt(path):
    polygons(shapely.from_wkt(path.read_text().splitlines()), raised(), path)


# The vertices that the duals are of.
sites = numpy.array(json.loads((folder / "dual.json").read_text())["vertices"])


def cells():
    """The Voronoi cells, from the file that meshio reads: vertex, area, corners."""
    mesh = meshio.read(folder / "dual.vtu")
    rings = [mesh.points[ring][:, :2] for block in mesh.cells for ring in block.data]
    columns = [numpy.concatenate(mesh.cell_data[name]) for name in ["vertex", "area"]]
    return sorted(zip(*columns, rings), key=lambda cell: cell[0])


def dual_vtu(path):
    total = sum(area for _, area, _ in cells())
    assert math.isclose(total, sum(shapely.area(shapely.polygons(sites[triangles]))), rel_tol=1e-9), path


def dual_geojson(path):
    found = features(path)
    vertices, areas, rings = zip(*cells())
    polygons([shapely.geometry.shape(feature["geometry"]) for feature in found], rings, path)
    same([feature["properties"]["vertex"] for feature in found], vertices, path)
    same([feature["properties"]["area"] for feature in found], areas, path)


def dual_wkt(path):
    polygons(shapely.from_wkt(path.read_text().splitlines()), [ring for *_, ring in cells()], path)


def dual_disv(path):
    blocks = {}
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["BEGIN"]:
            block = blocks.setdefault(words[1], [])
        elif words and words[0] not in ("#", "END"):
            block.append(words)
    assert blocks["DIMENSIONS"] == [["NLAY", "1"], ["NCPL", str(len(cells()))], ["NVERT", str(len(blocks["VERTICES"]))]]
    corners = {row[0]: [float(c) for c in row[1:]] for row in blocks["VERTICES"]}
    for i, (row, (vertex, _, ring)) in enumerate(zip(blocks["CELL2D"], cells(), strict=True)):
        assert int(row[0]) == i + 1 and int(row[3]) == len(row) - 4, path
        same([float(c) for c in row[1:3]], sites[vertex], path)
        same([corners[corner] for corner in row[:3:-1]], ring, path)


def dual_ugrid(path):
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        mesh = file["mesh2d"]
        corners = numpy.column_stack([file[name][:] for name in mesh.node_coordinates.split()])
        centres = numpy.column_stack([file[name][:] for name in mesh.face_coordinates.split()])
        faces = file[mesh.face_node_connectivity]
        rows = zip(faces[:], centres, file["mesh2d_face_area"][:], cells(), strict=True)
        for face, centre, area, (vertex, area_wanted, ring) in rows:
            same(corners[face[face != faces._FillValue]], ring, path)
            same(centre, sites[vertex], path)
            assert area == area_wanted, path


def dual_mpas(path):
    with netCDF4.Dataset(path) as file:
        assert (file.on_a_sphere, file.sphere_radius) == ("NO", 0.0), path
        same(numpy.column_stack([file[f"{axis}Cell"][:] for axis in "xy"]), sites, path)
        same(numpy.concatenate([file["zCell"][:], file["zVertex"][:]]), numpy.zeros(len(sites) + len(triangles)), path)
        same(file["cellsOnVertex"][:], triangles + 1, path)
        centres = numpy.column_stack([file[f"{axis}Vertex"][:] for axis in "xy"])
        to_corners = numpy.linalg.norm(sites[triangles] - centres[:, None], axis=2)
        assert numpy.allclose(to_corners, to_corners[:, :1], rtol=1e-6), path
        same(file["meshDensity"][:], numpy.ones(len(sites)), path)


DUALS = {
    "dual.vtu": dual_vtu, "dual.geojson": dual_geojson, "dual.wkt": dual_wkt, "dual.disv": dual_disv,
    "dual.nc": dual_ugrid, "dual.mpas.nc": dual_mpas,
}

READERS = {
    ".vtu": vtu, ".msh": msh, ".msh2": msh2, ".mesh": medit, ".obj": plain, ".off": plain, ".node": node,
    ".ele": ele, ".edge": edge, ".neigh": neigh, ".poly": poly, ".json": json_mesh, ".ron": ron, ".svg": svg,
    ".png": png, ".vtk": vtk, ".stl": stl, ".2dm": sms, ".14": adcirc, ".nc": ugrid, ".geojson": geojson, ".wkt": wkt,
}

read = 0
for path in sorted(folder.iterdir()):
    if path.name not in ("expected.json", "dual.json"):
        DUALS.get(path.name, READERS.get(path.suffix))(path)
        read += 1
versions = ", ".join(f"{m.__name__} {m.__version__}" for m in (meshio, netCDF4, numpy, py2dm, shapely))
print(f"{read} files as written, read by {versions}")
