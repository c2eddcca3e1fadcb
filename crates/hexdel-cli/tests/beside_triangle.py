"""Compares what `hexdel triangle` wrote of a graph with what Triangle makes of it.

Meshes differ, so what is compared is what must not: the numbers, order, places, markers and
attributes of the input points, places where segments cross, the area and its holes, attributes
that are linear between the points, and markers of the boundary.
"""

import re
import sys
from pathlib import Path

import numpy as np
import triangle

folder, switches = Path(sys.argv[1]), sys.argv[2]


def sections(path, names):
    """The sections of a file of Triangle's, each as header and rows of numbers."""
    lines = (line.split("#")[0].replace(",", " ").split() for line in path.read_text().splitlines())
    rows = [[float(field) for field in line] for line in lines if line]
    found = {}
    for name in names:
        if not rows:
            break
        header, rows = rows[0], rows[1:]
        count = int(header[0])
        found[name], rows = (header, rows[:count]), rows[count:]
    return found


given = sections(folder / "in.poly", ["points", "segments", "holes", "regions"])
header, points = given["points"]
first, attributes, markers = int(points[0][0]), int((header + [0, 0, 0])[2]), (header + [0] * 4)[3] > 0
graph = {"vertices": [p[1:3] for p in points]}
if attributes:
    graph["vertex_attributes"] = [p[3 : 3 + attributes] for p in points]
if markers:
    graph["vertex_markers"] = [[int(p[3 + attributes]) if len(p) > 3 + attributes else 0] for p in points]
header, segments = given["segments"]
segments = [s for s in segments if s[1] != s[2] and points[int(s[1]) - first][1:3] != points[int(s[2]) - first][1:3]]
graph["segments"] = [[int(s[1]) - first, int(s[2]) - first] for s in segments]
if (header + [0])[1] > 0:
    graph["segment_markers"] = [[int(s[3]) if len(s) > 3 else 0] for s in segments]
if given["holes"][1]:
    graph["holes"] = [h[1:3] for h in given["holes"][1]]
theirs = triangle.triangulate({k: np.array(v) for k, v in graph.items()}, switches)

header, nodes = sections(folder / "in.1.node", ["nodes"])["nodes"]
nodes = np.array(nodes)
_, elements = sections(folder / "in.1.ele", ["elements"])["elements"]
corners = np.array(elements)[:, 1:4].astype(int) - first
places = nodes[:, 1:3]
n = len(points)


def area(vertices, triangles):
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    u, v = b - a, c - a
    return 0.5 * np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum()


def euler(triangles):
    """Vertices in use - edges + triangles: one less for each hole."""
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return len(np.unique(triangles)) - len(np.unique(edges, axis=0)) + len(triangles)


# Numbers from the input's base, input points first and in their order.
assert np.array_equal(nodes[:, 0], np.arange(len(nodes)) + first), "numbers"
assert np.array_equal(places[:n], theirs["vertices"][:n]), "input points"
# What both cover.
wanted = theirs["triangles"].astype(int)
assert np.isclose(area(places, corners), area(theirs["vertices"], wanted), rtol=1e-9), "area"
assert euler(corners) == euler(wanted), "holes"
# Of a plain constrained triangulation, points beyond the input are where segments cross.
crossings = theirs["vertices"][n:] if not re.search("[qa]", switches) else np.empty((0, 2))
for at in crossings:
    assert np.abs(places - at).max(axis=1).min() < 1e-9, f"crossing at {at}"
# Attributes of input points, and between them where they are linear.
assert int(header[2]) == attributes, "number of attributes"
if attributes:
    own, others = nodes[:, 3 : 3 + attributes], theirs["vertex_attributes"]
    assert np.array_equal(own[:n], others[:n]), "attributes of input points"
    design = np.column_stack([np.ones(n), places[:n]])
    fit, *_ = np.linalg.lstsq(design, own[:n], rcond=None)
    if np.allclose(design @ fit, own[:n], atol=1e-12):
        for vertices, values in [(places, own), (theirs["vertices"], others)]:
            assert np.allclose(np.column_stack([np.ones(len(vertices)), vertices]) @ fit, values, atol=1e-9), "linear"
    else:
        assert own.min() >= own[:n].min() and own.max() <= own[:n].max(), "range of attributes"
# Markers of input points that are in use; of two at a place either may be.
used = np.intersect1d(np.intersect1d(corners, wanted), np.arange(n))
ours_marked, theirs_marked = nodes[used, -1].astype(int), theirs["vertex_markers"].ravel()[used]
assert np.array_equal(ours_marked, theirs_marked), f"markers {ours_marked} {theirs_marked}"
print(f"{len(nodes)} and {len(theirs['vertices'])} points, {n} given, {len(crossings)} crossings, {attributes} attributes")
