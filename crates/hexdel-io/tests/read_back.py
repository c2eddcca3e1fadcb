"""Reads the files that hexdel-io wrote with readers that are not ours.

Called with a folder; `expected.json` in it is what was written. meshio reads what it
knows, a few lines below what it does not: the text formats of Triangle (its own
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
import numpy

folder = pathlib.Path(sys.argv[1])
expected = json.loads((folder / "expected.json").read_text())
points = numpy.array(expected["vertices"], dtype=float)
triangles = numpy.array(expected["triangles"])
regions = numpy.array(expected["regions"])
markers = numpy.array(expected["vertex_markers"])
inputs = numpy.array([-1 if i is None else i for i in expected["input_indices"]])
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


READERS = {
    ".vtu": vtu, ".msh": msh, ".msh2": msh2, ".mesh": medit, ".obj": plain, ".off": plain, ".node": node,
    ".ele": ele, ".edge": edge, ".neigh": neigh, ".poly": poly, ".json": json_mesh, ".ron": ron, ".svg": svg,
    ".png": png,
}

read = 0
for path in sorted(folder.iterdir()):
    if path.name != "expected.json":
        READERS[path.suffix](path)
        read += 1
print(f"{read} files as written, read by meshio {meshio.__version__} and numpy {numpy.__version__}")
