"""Meshes for other packages, each with the real one."""

import sys
import warnings

import numpy as np
import pytest

import hexdel


@pytest.fixture
def plate(square):
    corners, sides, holes = square
    regions = [(0.5, 0.5, 3)]
    return hexdel.mesh_pslg(corners, sides, holes=holes, regions=regions, markers=[1, 2, 3, 4, 5, 5, 5, 5], size=0.6)


def test_matplotlib(plate):
    pytest.importorskip("matplotlib").use("agg")
    import matplotlib.pyplot as plt

    triangulation = plate.to_matplotlib()
    assert (triangulation.triangles == plate.triangles).all()
    assert {tuple(e) for e in np.sort(triangulation.edges)} == {tuple(e) for e in plate.edges}
    assert (np.sort(triangulation.neighbors) == np.sort(plate.neighbors)).all()
    for color in ("angle", "region", None, plate.vertices[:, 0], plate.quality().area):
        ax = plate.plot(color=color)
        ax.figure.canvas.draw()
    plate.dual().plot(ax, color=plate.dual().areas)
    ax.figure.canvas.draw()
    with pytest.raises(hexdel.OptionError):
        plate.plot(color=[1, 2, 3])
    plt.close("all")


def test_meshio(plate, tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh = plate.to_meshio()
    assert (mesh.cells_dict["triangle"] == plate.triangles).all()
    assert (mesh.cells_dict["line"] == plate.segment_edges).all()
    mesh.write(tmp_path / "plate.vtu")
    again = meshio.read(tmp_path / "plate.vtu")
    assert (again.points[:, :2] == plate.vertices).all()
    assert (again.cell_data_dict["region"]["triangle"] == 3).all()
    assert (again.cell_data_dict["marker"]["line"] == plate.segment_edge_markers).all()
    assert (again.point_data["input_index"] == plate.input_of_vertex).all()
    with pytest.warns(hexdel.HexdelWarning, match="marked edges"):
        plate.save(tmp_path / "own.vtu")
    assert (meshio.read(tmp_path / "own.vtu").points[:, :2] == plate.vertices).all()


def test_pyvista(plate):
    pytest.importorskip("pyvista")
    surface = plate.to_pyvista()
    assert surface.n_cells == len(plate) and surface.n_points == len(plate.vertices)
    assert surface.area == pytest.approx(15, rel=1e-9)
    assert surface.n_open_edges == len(plate.boundary) and surface.is_all_triangles
    assert (surface.cell_data["region"] == 3).all()


def test_scikit_fem(plate):
    skfem = pytest.importorskip("skfem")
    mesh = plate.to_skfem()
    assert mesh.is_valid() and mesh.nelements == len(plate)
    assert (mesh.p.T == plate.vertices).all() and (mesh.t.T == np.sort(plate.triangles)).all()
    assert set(mesh.boundaries) == {f"marker {i}" for i in range(1, 6)}
    assert set(np.concatenate(list(mesh.boundaries.values()))) == set(mesh.boundary_facets())
    # The length of each side, integrated on its facets.
    for name, length in (("marker 1", 4), ("marker 5", 4)):
        basis = skfem.FacetBasis(mesh, skfem.ElementTriP1(), facets=name)
        assert skfem.Functional(lambda w: 1 + 0 * w.x[0]).assemble(basis) == pytest.approx(length)
    assert len(mesh.subdomains["region 3"]) == len(plate)
    # Stiffness by scikit-fem is the Laplacian of the dual.
    stiff = skfem.BilinearForm(lambda u, v, w: u.grad[0] * v.grad[0] + u.grad[1] * v.grad[1])
    matrix = stiff.assemble(skfem.Basis(mesh, skfem.ElementTriP1()))
    assert abs(matrix - plate.dual().laplacian()).max() < 1e-12


def test_xugrid(plate, tmp_path):
    xugrid = pytest.importorskip("xugrid")
    grid = plate.to_xugrid()
    assert grid.n_face == len(plate) and grid.n_edge == len(plate.edges)
    assert grid.area.sum() == pytest.approx(15, rel=1e-12)
    plate.to_ugrid(tmp_path / "plate.nc")
    opened = xugrid.open_dataset(tmp_path / "plate.nc")
    again = opened.ugrid.grid
    assert (again.face_node_connectivity == plate.triangles).all()
    assert (np.column_stack((again.node_x, again.node_y)) == plate.vertices).all()
    assert (opened["region"] == 3).all() and (opened["marker"].to_numpy() == plate.vertex_markers).all()
    opened.close()
    plate.save(tmp_path / "own.nc")
    opened = xugrid.open_dataset(tmp_path / "own.nc")
    again = opened.ugrid.grid
    assert (again.face_node_connectivity == plate.triangles).all() and again.n_edge == len(plate.edges)
    assert (np.column_stack((again.node_x, again.node_y)) == plate.vertices).all()
    assert (opened["mesh2d_face_region"] == 3).all()
    opened.close()
    plate.dual().save(tmp_path / "cells.nc")
    opened = xugrid.open_dataset(tmp_path / "cells.nc")
    assert np.allclose(opened.ugrid.grid.area, plate.dual().areas, rtol=1e-9)
    opened.close()
    cells = plate.dual().to_xugrid()
    assert cells.n_face == len(plate.vertices)
    assert np.allclose(cells.area, plate.dual().areas, rtol=1e-9)


def test_flopy(plate, tmp_path):
    flopy = pytest.importorskip("flopy")
    disv = plate.to_flopy_disv()
    simulation = flopy.mf6.MFSimulation("plate", sim_ws=tmp_path)
    flopy.mf6.ModflowTdis(simulation)
    flopy.mf6.ModflowIms(simulation)
    model = flopy.mf6.ModflowGwf(simulation, modelname="plate")
    flopy.mf6.ModflowGwfdisv(model, nlay=1, top=1.0, botm=0.0, **disv)
    simulation.write_simulation(silent=True)
    text = (tmp_path / "plate.disv").read_text().split()
    assert text[text.index("NCPL" if "NCPL" in text else "ncpl") + 1] == str(len(plate.vertices))
    grid = model.modelgrid
    assert grid.ncpl == len(plate.vertices)
    assert np.allclose(np.column_stack((grid.xcellcenters, grid.ycellcenters)), plate.vertices)
    areas = [-0.5 * sum(x * b - a * y for (x, y), (a, b) in zip(ring, ring[1:] + ring[:1])) for ring in rings(disv)]
    # Clockwise, as MODFLOW wants them, and the control volumes of the dual.
    assert np.allclose(areas, plate.dual().areas, rtol=1e-9)
    # The package as hexdel writes it.
    plate.dual().save(tmp_path / "plate.disv")
    again = flopy.mf6.MFSimulation.load(sim_ws=tmp_path, verbosity_level=0).get_model("plate").modelgrid
    assert again.ncpl == grid.ncpl and (again.nvert, again.nlay) == (grid.nvert, 1)
    assert np.allclose(np.column_stack((again.xcellcenters, again.ycellcenters)), plate.vertices)


def rings(disv):
    places = [tuple(vertex[1:]) for vertex in disv["vertices"]]
    return [[places[i] for i in cell[4:]] for cell in disv["cell2d"]]


def test_no_cell_has_an_edge_without_length():
    grid = np.stack(np.meshgrid(np.arange(4.0), np.arange(4.0)), axis=-1).reshape(-1, 2)
    right = hexdel.Mesh(grid, [t for i in (0, 1, 2, 4, 5, 6, 8, 9, 10) for t in ((i, i + 1, i + 5), (i, i + 5, i + 4))])
    assert right.dual().summary["shortest_dual_edge"] == 0
    for ring in rings(right.to_flopy_disv()):
        # On a straight side of the boundary the vertex is a corner, too.
        assert len(ring) in (4, 5) and len(set(ring)) == len(ring)


def test_mpas(plate, tmp_path):
    netcdf_file = pytest.importorskip("scipy.io").netcdf_file
    plate.to_mpas(tmp_path / "plate.nc", density=plate.vertices[:, 0] + 1)
    with netcdf_file(tmp_path / "plate.nc", mmap=False) as file:
        assert file.dimensions["nCells"] == len(plate.vertices)
        assert file.dimensions["nVertices"] == len(plate) and file.dimensions["vertexDegree"] == 3
        cells = file.variables["cellsOnVertex"][:]
        assert (cells == plate.triangles + 1).all() and cells.min() == 1
        assert (file.variables["xCell"][:] == plate.vertices[:, 0]).all()
        x, y = file.variables["xVertex"][:], file.variables["yVertex"][:]
        # Each circumcentre is as far from one corner as from the others.
        corners = plate.vertices[plate.triangles]
        distance = np.hypot(corners[..., 0] - x[:, None], corners[..., 1] - y[:, None])
        assert np.allclose(distance, distance[:, :1])
        assert (file.variables["meshDensity"][:] == plate.vertices[:, 0] + 1).all()
        assert file.on_a_sphere == b"NO" and file.sphere_radius == 0


def test_shapely_and_geopandas(plate):
    shapely = pytest.importorskip("shapely")
    pytest.importorskip("geopandas")
    triangles = plate.to_shapely()
    assert shapely.is_valid(triangles).all() and shapely.area(triangles).sum() == pytest.approx(15)
    frame = plate.to_geopandas(crs="EPSG:25832")
    assert frame.crs == "EPSG:25832" and len(frame) == len(plate) and (frame["region"] == 3).all()
    cells = plate.dual().to_geopandas()
    assert cells.is_valid.all() and np.allclose(cells.area, plate.dual().areas, rtol=1e-9)
    assert cells.union_all().area == pytest.approx(15) and (cells["input_index"] >= 0).sum() == 8
    inside = shapely.covers(cells.geometry.to_numpy(), shapely.points(plate.vertices))
    assert inside.all()


def test_polygons_of_every_kind(square):
    shapely = pytest.importorskip("shapely")
    geopandas = pytest.importorskip("geopandas")
    corners, _, _ = square
    ring = shapely.Polygon(corners[:4], [corners[4:]])
    beside = shapely.box(4, 1, 5, 2)
    mesh = hexdel.mesh_polygons(ring)
    assert mesh.quality().area.sum() == pytest.approx(15) and mesh.holds
    assert hexdel.mesh_polygons(shapely.MultiPolygon([ring, beside.buffer(-0.1)])).holds
    frame = geopandas.GeoDataFrame({"cellsize": [1.0, 0.1]}, geometry=[ring, shapely.box(5, 1, 6, 2)])
    mesh = hexdel.mesh_polygons(frame)
    for row, shape in enumerate(frame.geometry):
        area = mesh.quality().area[mesh.region_of_triangle == row].sum()
        assert area == pytest.approx(shape.area, rel=1e-12)
    fine = hexdel.mesh_polygons(frame, size="cellsize")
    of_second = fine.triangles[fine.region_of_triangle == 1]
    sides = fine.vertices[of_second] - fine.vertices[np.roll(of_second, 1, axis=1)]
    assert np.hypot(sides[..., 0], sides[..., 1]).max() <= 0.1 * (1 + 1e-8)
    for same in (frame.geometry, frame.__geo_interface__, list(frame.geometry)):
        assert hexdel.mesh_polygons(same) == mesh
    with pytest.raises(hexdel.OptionError, match="no column 'width'"):
        hexdel.mesh_polygons(frame, size="width")
    empty = geopandas.GeoSeries([shapely.Polygon(), ring, None])
    assert (hexdel.mesh_polygons(empty).region_of_triangle == 1).all()
    for bad in (shapely.Polygon(), [], "POLYGON ((0 0, 1 0, 0 1, 0 0))", 3, [3]):
        with pytest.raises(hexdel.HexdelError):
            hexdel.mesh_polygons(bad)


def test_overlaps_are_named():
    shapely = pytest.importorskip("shapely")
    squares = [shapely.box(0, 0, 2, 2), shapely.box(1, 1, 3, 3)]
    with pytest.warns(hexdel.HexdelWarning, match="overlap"):
        mesh = hexdel.mesh_polygons(squares)
    area = mesh.quality().area
    assert area[mesh.region_of_triangle == 0].sum() == pytest.approx(3)
    assert area[mesh.region_of_triangle == 1].sum() == pytest.approx(4)
    with pytest.raises(hexdel.InputError) as caught:
        hexdel.mesh_polygons(squares, overlaps="refuse")
    assert caught.value.kind == "overlaps" and "overlaps='later'" in str(caught.value)


def test_polygons_of_a_file(tmp_path, square):
    import json

    corners, _, _ = square
    ring, hole = ([list(map(float, p)) for p in part + part[:1]] for part in (corners[:4], corners[4:]))
    (tmp_path / "plate.geojson").write_text(json.dumps({"type": "Polygon", "coordinates": [ring, hole]}))
    graph = hexdel.read(tmp_path / "plate.geojson")
    mesh = hexdel.mesh_pslg(**graph)
    assert mesh.quality().area.sum() == pytest.approx(15) and (mesh.regions == 1).all()


def test_islands_in_holes(square):
    shapely = pytest.importorskip("shapely")
    corners, _, _ = square
    several = [shapely.Polygon(corners[:4], [corners[4:]]), shapely.box(1.25, 1.25, 1.75, 1.75)]
    mesh = hexdel.mesh_polygons(shapely.MultiPolygon(several))
    assert mesh.quality().area.sum() == pytest.approx(15.25)
    apart = hexdel.mesh_polygons(several)
    for row, shape in enumerate(several):
        area = apart.quality().area[apart.region_of_triangle == row].sum()
        assert area == pytest.approx(shape.area, rel=1e-12)


def test_degrees_are_warned_of():
    shapely = pytest.importorskip("shapely")
    geopandas = pytest.importorskip("geopandas")
    frame = geopandas.GeoDataFrame(geometry=[shapely.box(8, 48, 9, 49)], crs="EPSG:4326")
    with pytest.warns(hexdel.HexdelWarning, match="longitudes and latitudes"):
        hexdel.mesh_polygons(frame)


def test_dual_arrays(plate):
    dual = plate.dual()
    assert dual.areas.sum() == pytest.approx(15) and (dual.weights >= 0).all()
    assert np.allclose(dual.weights * dual.lengths, dual.dual_lengths)
    assert len(dual) == len(plate.vertices) and not dual.areas.flags.writeable
    for i in (0, len(dual) - 1):
        x, y = dual.cell(i).T
        assert 0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() == pytest.approx(dual.areas[i])
    with pytest.raises(IndexError):
        dual.cell(len(dual))
    boundary = (dual.edge_triangles < 0).any(axis=1)
    assert boundary.sum() == len(plate.boundary)
    with pytest.raises(hexdel.HexdelError) as caught:
        hexdel.Mesh([(0, 0), (1, 0), (0, 1)], [(0, 2, 1)]).dual()
    assert caught.value.kind == "dual"


def test_matrices(plate):
    pytest.importorskip("scipy")
    dual = plate.dual()
    laplacian, mass = dual.laplacian(), dual.mass()
    assert abs(laplacian.sum(axis=1)).max() < 1e-12 and abs(laplacian - laplacian.T).max() == 0
    assert mass.diagonal().sum() == pytest.approx(15)
    inner = np.setdiff1d(np.arange(len(dual)), plate.boundary)
    assert np.abs((laplacian @ (plate.vertices @ (3.0, -2.0)))[inner]).max() < 1e-10
    double = dual.laplacian(conductivity=2.0)
    assert abs(double - 2 * laplacian).max() < 1e-12


def test_dual_files(plate, tmp_path):
    plate.dual().save(tmp_path / "cells.vtu")
    assert (tmp_path / "cells.vtu").stat().st_size > 1000


def test_every_package_is_asked_for_lazily():
    import subprocess

    code = "import sys, hexdel; print([m for m in ('scipy', 'matplotlib', 'shapely', 'pandas', 'tqdm') if m in sys.modules])"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.strip() == "[]"
