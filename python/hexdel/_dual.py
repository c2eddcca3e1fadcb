"""The Voronoi dual of a mesh: what finite volumes work on."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _clients, _hexdel, _options
from ._arrays import Floats, Ints, frozen

if TYPE_CHECKING:
    import os

    from ._mesh import Mesh

#: Edges of the dual shorter than this part of the edge that they cross are no edges.
SHORT = 1e-9


class Dual:
    """Cells around the vertices of a mesh, and what finite volumes need of them.

    In a Delaunay mesh without obtuse angles every circumcentre lies in its triangle:
    cells end at the boundary by themselves, no weight is negative, and edges and faces
    cross at right angles. In other meshes lengths and areas are signed.

    Attributes
    ----------
    mesh : Mesh
    edges : ndarray of int32, shape (e, 2)
        Every edge of the mesh once, the lower index first.
    edge_triangles : ndarray of int32, shape (e, 2)
        The triangles on the left and the right of each edge; -1 for none.
    lengths, dual_lengths : ndarray, shape (e,)
        The length of each edge, and of the face between the two cells; on the boundary,
        of the part of it inside.
    weights : ndarray, shape (e,)
        Dual length over length, half the sum of the cotangents opposite: transmissibility
        of a two-point flux.
    areas : ndarray, shape (n,)
        The area of each cell: control volumes. They add up to the area of the mesh.
    circumcenters : ndarray, shape (m, 2)
    cell_offsets : ndarray of int64, shape (n + 1,)
    cell_corners : ndarray, shape (cell_offsets[-1], 2)
        Corners of cell `i`: ``cell_corners[cell_offsets[i]:cell_offsets[i + 1]]``,
        counter-clockwise.
    summary : dict
        The shortest dual edge, the smallest weight, how many are negative, ...

    Examples
    --------
    >>> import hexdel
    >>> square = hexdel.Mesh([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2), (0, 2, 3)])
    >>> square.dual().areas.tolist()
    [0.25, 0.25, 0.25, 0.25]
    >>> square.dual().cell(0).tolist()
    [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]]
    """

    mesh: Mesh
    edges: Ints
    edge_triangles: Ints
    lengths: Floats
    dual_lengths: Floats
    weights: Floats
    areas: Floats
    circumcenters: Floats
    cell_offsets: Any
    cell_corners: Floats
    summary: dict[str, float]

    def __init__(self, mesh: Mesh) -> None:
        found = _hexdel.dual(mesh.vertices, mesh._corners(), _options.thread_count())
        found["edge_triangles"] = np.stack(found["edge_triangles"], axis=1)
        self.mesh = mesh
        self.summary = json.loads(found.pop("summary"))
        for name, array in found.items():
            setattr(self, name, frozen(array))
        self._polygons: tuple[Floats, Any, Ints] | None = None

    def cell(self, vertex: int) -> Floats:
        """The corners of one cell, counter-clockwise, shape (k, 2)."""
        count = len(self.areas)
        if not -count <= vertex < count:
            raise IndexError(f"there are {count} cells, not one of number {vertex}")
        vertex = vertex % count
        return self.cell_corners[self.cell_offsets[vertex] : self.cell_offsets[vertex + 1]]

    def __len__(self) -> int:
        """The number of cells, one for each vertex."""
        return len(self.areas)

    def __repr__(self) -> str:
        return f"<hexdel.Dual: {len(self.areas)} cells, {len(self.edges)} edges>"

    def laplacian(self, conductivity: Any = None) -> Any:
        """The matrix of two-point fluxes: the cotangent Laplacian.

        Row `i` of ``L @ u`` is the flux out of cell `i` for values `u` at vertices, without
        what leaves across the boundary. Symmetric, rows add up to 0, and positive
        semidefinite where no weight is negative.

        Parameters
        ----------
        conductivity : array_like, shape (e,), optional
            A factor for each of `edges`.

        Returns
        -------
        scipy.sparse.csr_array, shape (n, n)

        Examples
        --------
        >>> import numpy as np, hexdel
        >>> mesh = hexdel.mesh([(0, 0), (1, 0.3)])
        >>> flux = mesh.dual().laplacian() @ (3 * mesh.vertices[:, 0] - mesh.vertices[:, 1])
        >>> inner = np.setdiff1d(np.arange(len(mesh.vertices)), mesh.boundary)
        >>> bool(np.abs(flux[inner]).max() < 1e-12)
        True
        """
        sparse = _clients.wanted("scipy.sparse", "scipy")
        weights = self.weights
        if conductivity is not None:
            weights = weights * np.broadcast_to(np.asarray(conductivity, float), weights.shape)
        a, b = self.edges[:, 0], self.edges[:, 1]
        rows, columns = np.concatenate((a, b, a, b)), np.concatenate((b, a, a, b))
        entries = np.concatenate((-weights, -weights, weights, weights))
        count = len(self.areas)
        return sparse.csr_array(sparse.coo_array((entries, (rows, columns)), shape=(count, count)))

    def mass(self) -> Any:
        """The diagonal matrix of control volumes.

        Returns
        -------
        scipy.sparse.dia_array, shape (n, n)
        """
        sparse = _clients.wanted("scipy.sparse", "scipy")
        return sparse.diags_array(self.areas)

    def polygons(self) -> tuple[Floats, Any, Ints]:
        """Cells by indices of shared corners.

        Corners that coincide, up to rounding, are one, so that no cell has an edge
        without length.

        Returns
        -------
        points : ndarray, shape (p, 2)
        offsets : ndarray of int64, shape (n + 1,)
        corners : ndarray of int32, shape (offsets[-1],)
            Indices of `points`, cell by cell, counter-clockwise.
        """
        if self._polygons is None:
            self._polygons = self._joined()
        return self._polygons

    def _joined(self) -> tuple[Floats, Any, Ints]:
        places, index = np.unique(self.cell_corners, axis=0, return_inverse=True)
        index = index.reshape(-1)
        of_centre = {tuple(place): i for i, place in enumerate(places.tolist())}
        root = np.arange(len(places))
        inner = (self.edge_triangles >= 0).all(axis=1)
        short = inner & (np.abs(self.weights) <= SHORT)
        for left, right in self.edge_triangles[short].tolist():
            pair = [of_centre.get(tuple(self.circumcenters[t].tolist())) for t in (left, right)]
            if None not in pair:
                a, b = (_top(root, int(i)) for i in pair if i is not None)
                root[max(a, b)] = min(a, b)
        index = np.array([_top(root, i) for i in range(len(places))], np.int64)[index]
        cell = np.repeat(np.arange(len(self.areas)), np.diff(self.cell_offsets))
        # A corner goes where the one before it in the cell is the same.
        before = np.roll(index, 1)
        first = self.cell_offsets[:-1][np.diff(self.cell_offsets) > 0]
        last = self.cell_offsets[1:][np.diff(self.cell_offsets) > 0] - 1
        before[first] = index[last]
        kept = index != before
        index, cell = index[kept], cell[kept]
        used, corners = np.unique(index, return_inverse=True)
        counts = np.bincount(cell, minlength=len(self.areas))
        offsets = np.concatenate(([0], np.cumsum(counts)))
        return frozen(places[used]), frozen(offsets), frozen(corners.reshape(-1).astype(np.int32))

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draws cells with matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
        color : array_like, shape (n,), optional
            A number for each cell.
        **options
            Of matplotlib's ``PolyCollection``.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from . import _plot

        return _plot.dual(self, ax, **options)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the dual, by the extension of the file.

        Cells: ``.vtu``, ``.geojson``, ``.wkt``, ``.nc`` (UGRID), ``.disv`` (MODFLOW 6).
        Circumcentres: ``.v.node`` with ``.v.edge``. Both: ``.mpas.nc``.
        """
        _hexdel.write_dual(path, self.mesh.vertices, self.mesh._corners())

    to_shapely = _clients.cells_to_shapely
    to_geopandas = _clients.cells_to_geopandas
    to_xugrid = _clients.cells_to_xugrid


def _top(root: Any, i: int) -> int:
    while root[i] != i:
        root[i] = root[root[i]]
        i = int(root[i])
    return i
