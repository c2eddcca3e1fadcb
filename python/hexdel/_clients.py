"""Meshes for other packages. Each is imported when it is asked for."""

from __future__ import annotations

import importlib
import os
from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import MissingPackageError

if TYPE_CHECKING:
    from ._dual import Dual
    from ._mesh import Mesh


def wanted(module: str, package: str | None = None) -> Any:
    """A module of an optional package, or an error that says how to get it."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        name = package or module
        raise MissingPackageError(
            f"this needs {name}, which cannot be imported ({error})", kind="package", hint=f"pip install {name}"
        ) from error


def to_meshio(self: Mesh) -> Any:
    """The mesh for meshio.

    Cells: triangles, and the lines of segments and the boundary. Cell data: ``region``
    of triangles, ``marker`` of lines. Point data: ``marker``, ``input_index``.

    Returns
    -------
    meshio.Mesh
    """
    meshio = wanted("meshio")
    triangles, lines = self.triangles, self.segment_edges
    return meshio.Mesh(
        self.vertices,
        [("triangle", triangles), ("line", lines)],
        point_data={"marker": self.vertex_markers, "input_index": self.input_of_vertex},
        cell_data={
            "region": [self.regions, np.zeros(len(lines))],
            "marker": [np.zeros(len(triangles), np.int32), self.segment_edge_markers],
        },
    )


def to_pyvista(self: Mesh) -> Any:
    """The mesh for pyvista, at z = 0.

    Cell data ``region``, point data ``marker`` and ``input_index``.

    Returns
    -------
    pyvista.PolyData
    """
    pyvista = wanted("pyvista")
    points = np.column_stack((self.vertices, np.zeros(len(self.vertices))))
    surface = pyvista.PolyData.from_regular_faces(points, self.triangles)
    surface.cell_data["region"] = self.regions.copy()
    surface.point_data["marker"] = self.vertex_markers.copy()
    surface.point_data["input_index"] = self.input_of_vertex.copy()
    return surface


def to_skfem(self: Mesh) -> Any:
    """The mesh for scikit-fem.

    Subdomains are named ``region N`` by attributes, boundaries ``marker N``.

    Returns
    -------
    skfem.MeshTri
    """
    skfem = wanted("skfem", "scikit-fem")
    mesh = skfem.MeshTri(np.ascontiguousarray(self.vertices.T), np.ascontiguousarray(self.triangles.T.astype(np.int64)))
    subdomains = {
        f"region {attribute:g}": np.flatnonzero(self.regions == attribute) for attribute in np.unique(self.regions)
    }
    count = np.int64(max(len(self.vertices), 1))
    facets = np.sort(mesh.facets, axis=0).astype(np.int64)
    of_facet = facets[0] * count + facets[1]
    order = np.argsort(of_facet)
    ends = np.sort(self.segment_edges, axis=1).astype(np.int64)
    found = order[np.searchsorted(of_facet, ends[:, 0] * count + ends[:, 1], sorter=order)]
    boundaries = {
        f"marker {marker}": np.unique(found[self.segment_edge_markers == marker]).astype(np.int32)
        for marker in np.unique(self.segment_edge_markers)
    }
    return mesh.with_subdomains(subdomains).with_boundaries(boundaries)


def to_matplotlib(self: Mesh) -> Any:
    """The mesh for matplotlib.

    Returns
    -------
    matplotlib.tri.Triangulation
    """
    tri = wanted("matplotlib.tri", "matplotlib")
    return tri.Triangulation(self.vertices[:, 0], self.vertices[:, 1], self.triangles)


def to_xugrid(self: Mesh) -> Any:
    """The mesh for xugrid: faces are triangles.

    Returns
    -------
    xugrid.Ugrid2d
    """
    xugrid = wanted("xugrid")
    x, y = np.ascontiguousarray(self.vertices.T)
    return xugrid.Ugrid2d(x, y, -1, self.triangles.copy())


def to_ugrid(self: Mesh, path: str | os.PathLike[str]) -> None:
    """Writes the mesh as a UGRID file (NetCDF), by xugrid.

    With ``region`` of faces, ``marker`` and ``input_index`` of nodes.
    """
    xarray = wanted("xarray")
    grid = self.to_xugrid()
    data = grid.to_dataset()
    data["region"] = xarray.DataArray(self.regions.copy(), dims=(grid.face_dimension,))
    data["marker"] = xarray.DataArray(self.vertex_markers.copy(), dims=(grid.node_dimension,))
    data["input_index"] = xarray.DataArray(self.input_of_vertex.copy(), dims=(grid.node_dimension,))
    data.to_netcdf(path)


def cells_to_xugrid(self: Dual) -> Any:
    """The cells for xugrid: faces are Voronoi cells, one for each vertex.

    Returns
    -------
    xugrid.Ugrid2d
    """
    xugrid = wanted("xugrid")
    points, offsets, corners = self.polygons()
    counts = np.diff(offsets)
    faces = np.full((len(counts), int(counts.max(initial=0))), -1, np.int64)
    faces[np.arange(faces.shape[1]) < counts[:, None]] = corners
    x, y = np.ascontiguousarray(points.T)
    return xugrid.Ugrid2d(x, y, -1, faces)


def to_flopy_disv(self: Mesh) -> dict[str, Any]:
    """Voronoi cells for flopy's DISV package of MODFLOW 6.

    Cell `i` is that of vertex `i`, its centre is the vertex; corners are clockwise, as
    MODFLOW wants them. Lines between centres cross faces at right angles.

    Returns
    -------
    dict
        ``ncpl``, ``nvert``, ``vertices``, ``cell2d``: for
        ``flopy.mf6.ModflowGwfdisv(gwf, nlay=.., top=.., botm=.., **mesh.to_flopy_disv())``.

    Examples
    --------
    >>> import hexdel
    >>> disv = hexdel.mesh([(0, 0), (1, 0)]).to_flopy_disv()
    >>> disv["ncpl"] == len(disv["cell2d"])
    True
    """
    points, offsets, corners = self.dual().polygons()
    vertices = [[i, x, y] for i, (x, y) in enumerate(points.tolist())]
    centres = self.vertices.tolist()
    cell2d = []
    for i, (x, y) in enumerate(centres):
        ring = corners[offsets[i] : offsets[i + 1]][::-1].tolist()
        cell2d.append([i, x, y, len(ring), *ring])
    return {"ncpl": len(centres), "nvert": len(vertices), "vertices": vertices, "cell2d": cell2d}


def to_mpas(self: Mesh, path: str | os.PathLike[str], density: Any = None) -> None:
    """Writes the mesh for MPAS's mesh converter (NetCDF-3, by scipy).

    Cells are those of vertices, MPAS's vertices are circumcentres; z is 0 and the mesh
    is not on a sphere.

    Parameters
    ----------
    path : path-like
    density : array_like, shape (n,), optional
        ``meshDensity`` of cells; 1 everywhere by default.
    """
    netcdf = wanted("scipy.io", "scipy").netcdf_file
    centres = self.dual().circumcenters
    cells = len(self.vertices)
    weights = np.broadcast_to(np.asarray(1.0 if density is None else density, float), (cells,))
    with netcdf(os.fspath(path), "w", version=2) as file:
        for name, count in (("nCells", cells), ("nVertices", len(centres)), ("vertexDegree", 3)):
            file.createDimension(name, count)
        file.on_a_sphere = "NO"
        file.sphere_radius = 0.0
        file.is_periodic = "NO"
        for kind, dimension, places in (("Cell", "nCells", self.vertices), ("Vertex", "nVertices", centres)):
            for axis, values in (("x", places[:, 0]), ("y", places[:, 1]), ("z", np.zeros(len(places)))):
                file.createVariable(f"{axis}{kind}", "f8", (dimension,))[:] = values
        file.createVariable("cellsOnVertex", "i4", ("nVertices", "vertexDegree"))[:] = self.triangles + 1
        file.createVariable("meshDensity", "f8", ("nCells",))[:] = weights


def to_shapely(self: Mesh) -> Any:
    """Triangles as polygons.

    Returns
    -------
    ndarray of shapely.Polygon, shape (m,)
    """
    shapely = wanted("shapely")
    corners = self.vertices[self.triangles[:, (0, 1, 2, 0)]]
    return shapely.polygons(corners)


def to_geopandas(self: Mesh, crs: Any = None) -> Any:
    """Triangles with their regions, angles and areas.

    Parameters
    ----------
    crs : optional
        The coordinate reference system, as geopandas takes it.

    Returns
    -------
    geopandas.GeoDataFrame
    """
    geopandas = wanted("geopandas")
    quality = self.quality()
    columns = {
        "region": self.regions,
        "region_index": self.region_of_triangle,
        "area": quality.area,
        "min_angle": quality.min_angle,
        "max_angle": quality.max_angle,
    }
    return geopandas.GeoDataFrame(columns, geometry=to_shapely(self), crs=crs)


def cells_to_shapely(self: Dual) -> Any:
    """Cells as polygons, one for each vertex.

    Returns
    -------
    ndarray of shapely.Polygon, shape (n,)
    """
    shapely = wanted("shapely")
    points, offsets, corners = self.polygons()
    rings = [points[corners[a:b]] for a, b in zip(offsets[:-1], offsets[1:], strict=True)]
    return np.array([shapely.Polygon(ring) if len(ring) > 2 else shapely.Polygon() for ring in rings])


def cells_to_geopandas(self: Dual, crs: Any = None) -> Any:
    """Cells with their areas, markers and input points.

    Parameters
    ----------
    crs : optional
        The coordinate reference system, as geopandas takes it.

    Returns
    -------
    geopandas.GeoDataFrame
    """
    geopandas = wanted("geopandas")
    columns = {
        "x": self.mesh.vertices[:, 0],
        "y": self.mesh.vertices[:, 1],
        "area": self.areas,
        "marker": self.mesh.vertex_markers,
        "input_index": self.mesh.input_of_vertex,
    }
    return geopandas.GeoDataFrame(columns, geometry=cells_to_shapely(self), crs=crs)
