"""The calls, and what a mesh holds."""

import copy
import json
import pickle
import warnings

import numpy as np
import pytest
from conftest import FIXTURES

import hexdel


def edges_by_hand(triangles):
    return sorted({tuple(sorted((t[i], t[i - 1]))) for t in triangles.tolist() for i in range(3)})


def test_points_are_vertices_bit_for_bit_and_angles_within_bounds(points):
    mesh = hexdel.mesh(points)
    assert (mesh.vertices[mesh.vertex_of_input] == points).all()
    assert (mesh.input_of_vertex[mesh.vertex_of_input] == np.arange(len(points))).all()
    quality = mesh.quality()
    assert quality.min_angle.min() >= 43.8978 - 1e-9 and quality.max_angle.max() <= 90 + 1e-9
    assert (quality.area > 0).all()
    assert mesh.holds and mesh.certificate.delaunay and mesh.certificate.disk
    assert (mesh.certificate.inputs_kept, mesh.domain, mesh.method) == (60, "hexagon", "compact")


def test_shapes_dtypes_and_read_only(points):
    mesh = hexdel.mesh(points)
    for name, dtype, shape in [
        ("vertices", np.float64, (None, 2)),
        ("triangles", np.int32, (None, 3)),
        ("edges", np.int32, (None, 2)),
        ("neighbors", np.int32, (len(mesh), 3)),
        ("boundary", np.int32, (None, 2)),
        ("vertex_of_input", np.int32, (60,)),
        ("input_of_vertex", np.int32, (len(mesh.vertices),)),
        ("vertex_markers", np.int32, (len(mesh.vertices),)),
        ("segment_edges", np.int32, (None, 2)),
        ("segment_of_edge", np.int32, (len(mesh.segment_edges),)),
        ("segment_edge_markers", np.int32, (len(mesh.segment_edges),)),
        ("regions", np.float64, (len(mesh),)),
        ("region_of_triangle", np.int32, (len(mesh),)),
    ]:
        array = getattr(mesh, name)
        assert array.dtype == dtype, name
        assert len(array.shape) == len(shape) and all(b in (None, a) for a, b in zip(array.shape, shape)), name
        assert not array.flags.writeable, name
        assert getattr(mesh, name) is array, name
    with pytest.raises(AttributeError, match="immutable"):
        mesh.vertices = 1
    with pytest.raises(AttributeError):
        del mesh._data


def test_vertices_are_handed_over_without_a_copy(points):
    vertices = hexdel.mesh(points).vertices
    while isinstance(vertices.base, np.ndarray):
        vertices = vertices.base
    # The memory belongs to what Rust has filled.
    assert vertices.base is not None and not vertices.flags.owndata


def test_topology_against_a_count_by_hand(points):
    mesh = hexdel.mesh(points, min_angle=30)
    assert mesh.edges.tolist() == [list(edge) for edge in edges_by_hand(mesh.triangles)]
    assert len(mesh.edges) == mesh.certificate.edges
    assert len(mesh.boundary) == mesh.certificate.boundary_edges
    for t, row in enumerate(mesh.neighbors):
        for corner, neighbor in enumerate(row):
            edge = set(np.delete(mesh.triangles[t], corner).tolist())
            if neighbor >= 0:
                assert edge < set(mesh.triangles[neighbor].tolist()) and t in mesh.neighbors[neighbor]
            else:
                assert tuple(sorted(edge)) in {tuple(sorted(e)) for e in mesh.boundary.tolist()}
    (loop,) = mesh.boundary_loops()
    x, y = mesh.vertices[loop].T
    area = 0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum()
    assert area == pytest.approx(mesh.quality().area.sum(), rel=1e-12)


@pytest.mark.parametrize(
    ("options", "least", "most"),
    [
        ({}, 43.8978, 90),
        ({"method": "templates"}, 43.8978, 90),
        ({"method": "simple"}, 30, 120),
        ({"min_angle": 35}, 35, 90),
        ({"min_angle": 25, "max_angle": 100, "effort": "fast"}, 25, 100),
        ({"method": "simple", "min_angle": 20}, 20, 120),
        ({"budget": 0.001, "domain": 3.0}, 43.8978, 90),
    ],
)
def test_options(points, options, least, most):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", hexdel.HexdelWarning)
        mesh = hexdel.mesh(points, **options)
    quality = mesh.quality()
    assert quality.min_angle.min() >= least - 1e-9 and quality.max_angle.max() <= most + 1e-9


def test_domains_of_points(points):
    hull = hexdel.mesh(points, domain="hull")
    assert hull.vertices.min() >= points.min() and hull.vertices.max() <= points.max()
    box = hexdel.mesh(points, domain="box")
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.1 * (high - low).max()
    assert box.quality().area.sum() == pytest.approx(np.prod(high - low + 2 * margin), rel=1e-9)


def test_the_same_on_any_number_of_threads(points):
    one, two = hexdel.mesh(points, threads=1), hexdel.mesh(points, threads=3)
    assert one == two and hash(one) == hash(two)


def test_dual_edges(points):
    mesh = hexdel.mesh(points, min_dual_edge=0.05)
    found = mesh.dual_edges
    assert mesh.certificate.max_angle_deg <= 87.14
    assert found["below"] == 0 and found["worst"]["ratio"] >= 0.05 - 1e-9
    assert hexdel.mesh(points).dual_edges is None
    with pytest.raises(hexdel.OptionError, match="at most 0.32"):
        hexdel.mesh(points, min_dual_edge=0.4)
    with pytest.raises(hexdel.OptionError, match="min_dual_edge must be a positive number"):
        hexdel.mesh(points, min_dual_edge=0)


def test_graph_with_a_hole(square):
    corners, sides, holes = square
    mesh = hexdel.mesh_pslg(corners, sides, holes=holes, markers=[1, 2, 3, 4, 5, 5, 5, 5])
    assert mesh.holds and mesh.quality().area.sum() == pytest.approx(15, rel=1e-12)
    assert mesh.quality().min_angle.min() >= 30 - 1e-9
    assert len(mesh.boundary_loops()) == 2
    assert set(mesh.segment_edge_markers.tolist()) == {1, 2, 3, 4, 5}
    for segment, (a, b) in enumerate(np.array(sides)):
        chain = mesh.segment_edges[mesh.segment_of_edge == segment]
        assert (mesh.vertices[chain[0, 0]] == corners[a]).all()
        assert (mesh.vertices[chain[-1, 1]] == corners[b]).all()
        assert (chain[1:, 0] == chain[:-1, 1]).all()
    found = hexdel.check(
        mesh.vertices, mesh.triangles, points=np.array(corners, float), segments=sides, min_angle=30, max_angle=90
    )
    assert found.holds and found.missing_segments == ()


def test_regions_and_areas():
    corners = [(0, 0), (2, 0), (2, 1), (0, 1), (1, 0), (1, 1)]
    sides = [(0, 4), (4, 1), (1, 2), (2, 5), (5, 3), (3, 0), (4, 5)]
    regions = [(0.5, 0.5, 10, 0.001), (1.5, 0.5, 20, 0)]
    mesh = hexdel.mesh_pslg(corners, sides, regions=regions, max_area=0.02)
    area, centre = mesh.quality().area, mesh.vertices[mesh.triangles].mean(axis=1)
    left = mesh.regions == 10
    assert (left == (centre[:, 0] < 1)).all() and (mesh.regions[~left] == 20).all()
    assert (mesh.region_of_triangle == np.where(left, 0, 1)).all()
    assert area[left].max() <= 0.001 * (1 + 1e-9) and area.max() <= 0.02 * (1 + 1e-9)


def test_repair_is_told_and_warned_of():
    bow = [(0, 0), (1, 1), (1, 0), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)]
    with pytest.raises(hexdel.InputError) as caught:
        hexdel.mesh_pslg(*bow)
    assert (caught.value.kind, caught.value.item, caught.value.index) == ("crossing", "segment", (0, 2))
    assert caught.value.location == (0.5, 0.5) and "repair=True" in str(caught.value)
    with pytest.warns(hexdel.HexdelWarning, match="repaired: .*cross"):
        mesh = hexdel.mesh_pslg(*bow, repair=True)
    assert mesh.quality().area.sum() == pytest.approx(0.5, rel=1e-12)
    assert [set(entry) for entry in mesh.repairs] == [{"what", "at"}]


def test_exempt_corners_are_listed_and_warned_of():
    sliver = [(0, 0), (1, 0), (1, 0.3)], [(0, 1), (1, 2), (2, 0)]
    with pytest.warns(hexdel.HexdelWarning, match="narrower than the bound"):
        mesh = hexdel.mesh_pslg(*sliver)
    assert mesh.holds and len(mesh.exempt) == 1 and mesh.failed == []
    assert mesh.exempt[0]["corner"]["angle_deg"] == pytest.approx(np.degrees(np.arctan(0.3)))


def test_duplicates_and_points_outside_are_warned_of(square):
    with pytest.warns(hexdel.HexdelWarning, match="1 points are duplicates"):
        mesh = hexdel.mesh([(0, 0), (1, 0), (0, 0)])
    assert mesh.vertex_of_input[0] == mesh.vertex_of_input[2]
    corners, sides, holes = square
    with pytest.warns(hexdel.HexdelWarning, match="1 points are not in the domain: 8"):
        mesh = hexdel.mesh_pslg([*corners, (1.5, 1.5)], sides, holes=holes)
    assert mesh.vertex_of_input[8] == -1


def test_pickling_copies_and_equality(square):
    corners, sides, holes = square
    mesh = hexdel.mesh_pslg(corners, sides, holes=holes, size=0.5)
    again = pickle.loads(pickle.dumps(mesh))
    assert again == mesh and hash(again) == hash(mesh) and again is not mesh
    assert again.certificate == mesh.certificate and again.size_ratio == mesh.size_ratio
    assert (again.segment_edges == mesh.segment_edges).all() and not again.vertices.flags.writeable
    assert copy.copy(mesh) is mesh and copy.deepcopy(mesh) is mesh
    other = hexdel.mesh_pslg(corners, sides, holes=holes)
    assert other != mesh and mesh != "mesh"
    with pytest.raises(ValueError):
        mesh.vertices[0] = 0


def test_a_mesh_of_arrays_from_elsewhere():
    mesh = hexdel.Mesh([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)], regions=[1, 2])
    assert mesh.holds and mesh.certificate.min_angle_deg == 45
    assert mesh.regions.tolist() == [1, 2] and mesh.boundary.tolist() == [[0, 1], [1, 2], [2, 3], [3, 0]]
    assert mesh.vertex_markers.tolist() == [1, 1, 1, 1]
    with pytest.raises(hexdel.InputError) as caught:
        hexdel.Mesh([(0, 0), (1, 0), (1, 1)], [(0, 1, 3)])
    assert (caught.value.item, caught.value.index) == ("triangle", 0)


def test_check_finds_what_is_wrong():
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    good = hexdel.check(square, [(0, 1, 2), (0, 2, 3)], points=square, segments=[(0, 2)], disk=True)
    assert good.holds and good.inputs_kept == 4
    across = hexdel.check(square, [(0, 1, 2), (0, 2, 3)], points=square, segments=[(1, 3), (0, 1)])
    assert not across.holds and across.missing_segments == (0,)
    flat = hexdel.check([(0, 0), (2, 0), (1, 0.1), (1, -1)], [(0, 1, 2), (0, 3, 1)])
    assert not flat.holds and not flat.delaunay and flat.non_delaunay_edges == 1
    wild = hexdel.check(square, [(0, 1, 9), (0, 0, 1)])
    assert wild.malformed == 2 and len(wild.violations) >= 2
    narrow = hexdel.check(square, [(0, 1, 2), (0, 2, 3)], min_angle=46)
    assert not narrow.holds and narrow.out_of_bounds == 2 and narrow.bounds == (46, 180)


def test_certificates_print_and_serialise(points):
    certificate = hexdel.mesh(points).certificate
    assert repr(certificate).startswith("certified") and "60 of 60 are vertices" in repr(certificate)
    assert "<table>" in certificate._repr_html_()
    json.dumps(certificate.as_dict())
    assert "min_angle_deg" in dir(certificate)
    with pytest.raises(AttributeError, match="as_dict"):
        certificate.beauty  # noqa: B018
    with pytest.raises(AttributeError, match="immutable"):
        certificate.holds = False


def test_unreached_bounds_carry_the_best_mesh(points):
    with pytest.raises(hexdel.UnreachedError) as caught:
        hexdel.mesh(points[:8], min_angle=51.4, max_angle=72, budget=0.05)
    assert caught.value.kind in ("unreached", "bounds")
    assert isinstance(caught.value.mesh, hexdel.Mesh) and len(caught.value.mesh) > 5


def test_pictures_for_notebooks(points):
    mesh = hexdel.mesh(points)
    assert mesh._repr_svg_().startswith("<svg") and mesh._repr_png_() is None
    large = hexdel.mesh(np.random.default_rng(1).random((400, 2)), method="templates")
    assert large._repr_svg_() is None and large._repr_png_().startswith(b"\x89PNG")
    assert "43.9" in repr(mesh)


@pytest.mark.parametrize("name", ["vtu", "msh", "json", "ron", "ele", "off", "obj", "2dm", "14"])
def test_files_read_back(tmp_path, square, name):
    name = f"mesh.{name}"
    corners, sides, holes = square
    mesh = hexdel.mesh_pslg(corners, sides, holes=holes, regions=[(0.5, 0.5, 3)])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", hexdel.HexdelWarning)
        mesh.save(tmp_path / name)
    again = hexdel.read(str(tmp_path / name))
    assert (again.vertices == mesh.vertices).all() and len(again.triangles) == len(mesh.triangles)
    if name.endswith(("vtu", "json", "ron")):
        assert (again.regions == mesh.regions).all() and (again.input_of_vertex == mesh.input_of_vertex).all()
        assert (again.vertex_of_input == mesh.vertex_of_input).all() and (again.triangles == mesh.triangles).all()


@pytest.mark.parametrize("name", ["mesh.vtu", "mesh.json", "mesh.2dm", "mesh.14"])
def test_heights_read_back(tmp_path, name):
    heights = [0.5, -1.0, 0.1]
    mesh = hexdel.Mesh([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)], heights=heights)
    mesh.save(tmp_path / name)
    assert hexdel.read(tmp_path / name).heights.tolist() == mesh.heights.tolist() == heights
    assert hexdel.mesh([(0, 0), (1, 0)]).heights.max() == 0
    with pytest.raises(hexdel.InputError):
        hexdel.Mesh([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)], heights=heights[:2])


def test_what_a_format_loses_is_named(tmp_path, points):
    with pytest.warns(hexdel.HexdelWarning, match="input indices"):
        hexdel.write(tmp_path / "a.off", hexdel.mesh(points))


def test_graphs_are_read_and_written(tmp_path):
    graph = hexdel.read(FIXTURES / "graphs" / "square_with_hole.poly")
    assert isinstance(graph, hexdel.Graph) and set(graph) >= {"points", "segments", "holes"}
    mesh = hexdel.mesh_pslg(**graph)
    assert mesh.holds
    hexdel.write(tmp_path / "again.poly", graph)
    again = hexdel.read(tmp_path / "again.poly")
    assert (again.points == graph.points).all() and (again.segments == graph.segments).all()
    hexdel.write(tmp_path / "points.csv", graph.points)
    assert (hexdel.read(tmp_path / "points.csv").points == graph.points).all()


def test_coordinate_systems_and_shapefiles(tmp_path, points):
    mesh = hexdel.mesh(points)
    for crs in ("EPSG:25832", 25832, "epsg:25832"):
        with pytest.warns(hexdel.HexdelWarning, match="no place for input indices"):
            hexdel.write(tmp_path / "m.geojson", mesh, crs=crs)
        named = json.loads((tmp_path / "m.geojson").read_text())["crs"]["properties"]["name"]
        assert named == "urn:ogc:def:crs:EPSG::25832"
    mesh.save(tmp_path / "m.nc", crs="EPSG:4326")
    for crs in ("WGS84", 0, -1, 70000, True):
        with pytest.raises(hexdel.OptionError, match="crs must be a code like"):
            mesh.save(tmp_path / "m.nc", crs=crs)
    with pytest.raises(hexdel.OptionError, match="crs is for .geojson and .nc"):
        mesh.save(tmp_path / "m.vtu", crs="EPSG:4326")
    with pytest.warns(hexdel.HexdelWarning, match="borders of polygons were divided"):
        areas = hexdel.read(FIXTURES / "formats" / "areas.shp")
    assert len(areas["points"]) > 3 and len(areas["segments"]) > 3
    hexdel.write(tmp_path / "areas.geojson", {"points": areas["points"], "segments": areas["segments"]})
    assert len(hexdel.read(tmp_path / "areas.geojson")["segments"]) == len(areas["segments"])


def test_columns_of_tables(tmp_path):
    (tmp_path / "wells.csv").write_text("id,north,east\n1,5.0,2.0\n2,6.0,3.5\n")
    assert hexdel.read(tmp_path / "wells.csv").points.tolist() == [[2.0, 5.0], [3.5, 6.0]]
    turned = hexdel.read(tmp_path / "wells.csv", columns="2,3")
    assert turned.points.tolist() == [[5.0, 2.0], [6.0, 3.5]]
    with pytest.raises(hexdel.OptionError):
        hexdel.read(tmp_path / "wells.csv", columns="2")


def test_files_that_are_not_there_or_no_such(tmp_path):
    with pytest.raises(hexdel.MissingFileError) as caught:
        hexdel.read(tmp_path / "none.vtu")
    assert isinstance(caught.value, FileNotFoundError) and isinstance(caught.value, hexdel.HexdelError)
    (tmp_path / "bad.node").write_text("3 2 0 0\n0 0 0\n1 x 0\n2 0 0\n")
    with pytest.raises(hexdel.FileError) as caught:
        hexdel.read(tmp_path / "bad.node")
    assert caught.value.line == 3
    with pytest.raises(hexdel.FileError):
        hexdel.read(tmp_path / "what.xyzzy")
    with pytest.raises(hexdel.FileError):
        hexdel.write(tmp_path / "nowhere" / "a.vtu", hexdel.mesh([(0, 0)]))


def test_generated_points_are_those_of_the_program():
    points = hexdel.generate("uniform", 50, 1)
    assert points.shape == (50, 2) and (points == hexdel.generate("uniform", 50)).all()
    with pytest.raises(hexdel.OptionError):
        hexdel.generate("unknown", 3)
