"""A mesh and all that is known about it."""

from __future__ import annotations

import hashlib
import json
import os
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _clients, _hexdel, _options, _topology
from ._arrays import Floats, Ints, frozen
from ._certificate import Certificate

if TYPE_CHECKING:
    from ._dual import Dual

#: Triangles up to which notebooks show a drawing, beyond it an image of pixels.
DRAWN = 3000


class Quality(NamedTuple):
    """Shapes of triangles, one number for each.

    Attributes
    ----------
    min_angle, max_angle : ndarray
        Degrees.
    area : ndarray
        Square units of the input.
    aspect : ndarray
        Circumradius over twice the inradius: 1 is equilateral.
    """

    min_angle: Floats
    max_angle: Floats
    area: Floats
    aspect: Floats

    def __repr__(self) -> str:
        if len(self.area) == 0:
            return "Quality of no triangles"
        return (
            f"Quality of {len(self.area)} triangles: angles {np.min(self.min_angle):.4f} to "
            f"{np.max(self.max_angle):.4f} degrees, areas {np.min(self.area):.6g} to {np.max(self.area):.6g}, "
            f"aspect up to {np.max(self.aspect):.4f}"
        )


class Mesh:
    """A triangle mesh, immutable; every array is read-only.

    `mesh`, `mesh_pslg` and `mesh_polygons` make certified ones. A mesh from elsewhere
    becomes one by its arrays, and can be checked, drawn, written and handed on.

    Parameters
    ----------
    vertices : array_like, shape (n, 2)
    triangles : array_like of int, shape (m, 3)
        Indices of vertices, counter-clockwise.
    regions : array_like, shape (m,), optional
        An attribute of each triangle.
    vertex_markers : array_like of int, shape (n,), optional
    heights : array_like, shape (n,), optional
        A height of each vertex, for files with heights or depths.

    Raises
    ------
    InputError
        Shapes or dtypes that do not fit, indices out of range.

    Examples
    --------
    >>> import hexdel
    >>> mesh = hexdel.mesh([(0.0, 0.0), (1.0, 0.2), (0.3, 0.7)])
    >>> mesh.vertices[mesh.vertex_of_input[1]].tolist()
    [1.0, 0.2]
    >>> bool(mesh.quality().max_angle.max() <= 90 + 1e-9)
    True
    """

    __slots__ = ("__weakref__", "_cache", "_data")
    _data: dict[str, Any]
    _cache: dict[str, Any]

    def __init__(
        self,
        vertices: ArrayLike,
        triangles: ArrayLike,
        *,
        regions: ArrayLike | None = None,
        vertex_markers: ArrayLike | None = None,
        heights: ArrayLike | None = None,
    ) -> None:
        places = _arrays.points(vertices, "vertices")
        corners = _arrays.indices(triangles, 3, "triangles", "triangle", len(places))
        data: dict[str, Any] = {"vertices": places.copy(), "triangles": corners.astype(np.int32)}
        if regions is not None:
            data["regions"] = _arrays.numbers(regions, len(corners), "regions", "triangle").copy()
        if vertex_markers is not None:
            data["vertex_markers"] = _arrays.markers(vertex_markers, len(places), "vertex_markers", "vertex")
        if heights is not None:
            data["heights"] = _arrays.numbers(heights, len(places), "heights", "vertex").copy()
        self._fill(data)

    @classmethod
    def _of(cls, data: dict[str, Any]) -> Mesh:
        """A mesh of what the compiled half hands over, which nobody else holds."""
        mesh = cls.__new__(cls)
        mesh._fill(data)
        return mesh

    def _fill(self, data: dict[str, Any]) -> None:
        for name, value in data.items():
            if isinstance(value, np.ndarray):
                data[name] = frozen(value)
        object.__setattr__(self, "_data", data)
        object.__setattr__(self, "_cache", {})

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError("meshes are immutable")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("meshes are immutable")

    # What was made

    @property
    def vertices(self) -> Floats:
        """Coordinates, shape (n, 2), float64."""
        result: Floats = self._data["vertices"]
        return result

    @property
    def triangles(self) -> Ints:
        """The corners of each triangle, counter-clockwise, shape (m, 3), int32."""
        result: Ints = self._data["triangles"]
        return result

    @property
    def vertex_of_input(self) -> Ints:
        """The vertex of each input point, shape (k,); -1 for one outside of the domain."""
        return self._array("vertex_of_input", lambda: np.zeros(0, np.int32))

    @property
    def input_of_vertex(self) -> Ints:
        """The first input point that each vertex is, shape (n,); -1 for Steiner points."""
        return self._array("input_of_vertex", lambda: np.full(len(self.vertices), -1, np.int32))

    @property
    def vertex_markers(self) -> Ints:
        """A marker of each vertex, shape (n,).

        That of its point, or else of a segment it lies on, or else 1 on the boundary
        and 0 inside.
        """

        def made() -> Ints:
            markers = np.zeros(len(self.vertices), np.int32)
            markers[self.boundary] = 1
            return markers

        return self._array("vertex_markers", made)

    @property
    def heights(self) -> Floats:
        """The height of each vertex, shape (n,); 0 if heights are not known.

        They are those of a file that was read, or given to the constructor.
        """
        return self._array("heights", lambda: np.zeros(len(self.vertices)))

    @property
    def segment_edges(self) -> Ints:
        """The edges that segments and the boundary consist of, shape (s, 2).

        Segment by segment, each in its segment's direction; along the boundary with the
        mesh on the left where there is no segment. Of a mesh without segments, the boundary.
        """
        return self._array("segment_edges", lambda: self.boundary)

    @property
    def segment_of_edge(self) -> Ints:
        """The segment that each of `segment_edges` is a part of, shape (s,); -1 for none."""
        return self._array("segment_of_edge", lambda: np.full(len(self.segment_edges), -1, np.int32))

    @property
    def segment_edge_markers(self) -> Ints:
        """The marker of each of `segment_edges`, shape (s,).

        That of its segment, or else 1 on the boundary and 0 inside.
        """
        return self._array("segment_edge_markers", lambda: np.ones(len(self.segment_edges), np.int32))

    @property
    def regions(self) -> Floats:
        """The attribute of each triangle's region, shape (m,), float64; 0 in none."""
        return self._array("regions", lambda: np.zeros(len(self.triangles)))

    @property
    def region_of_triangle(self) -> Ints:
        """The index of each triangle's region, shape (m,); -1 in none."""
        return self._array("region_of_triangle", lambda: np.full(len(self.triangles), -1, np.int32))

    @property
    def certificate(self) -> Certificate:
        """What the mesh was found to keep; of a mesh from elsewhere, checked when asked for."""

        def made() -> Certificate:
            if "certificate" in self._data:
                return Certificate(self._data["certificate"], self._data["holds"])
            from ._calls import check

            return check(self.vertices, self.triangles, disk=False)

        result: Certificate = self._lazy("certificate", made)
        return result

    @property
    def holds(self) -> bool:
        """Whether all that was asked for is so, up to `exempt` triangles."""
        return self.certificate.holds

    @property
    def exempt(self) -> list[dict[str, Any]]:
        """Triangles that only a corner of the input puts out of bounds: where, and why."""
        return self._list("exempt")

    @property
    def failed(self) -> list[dict[str, Any]]:
        """Triangles out of bounds, or larger or longer than asked for: where, and why."""
        return self._list("failed")

    @property
    def repairs(self) -> list[dict[str, Any]]:
        """What repair did, in order: what, and where."""
        return self._list("repairs")

    @property
    def size_ratio(self) -> float | None:
        """The longest edge over the length wanted there; None if no size was given."""
        ratio: float | None = self._data.get("size_ratio")
        return ratio

    @property
    def dual_edges(self) -> dict[str, Any] | None:
        """What was found of the edges of the Voronoi dual, if `min_dual_edge` was given.

        `min_ratio` is the bound, `edges` were looked at, `below` are shorter; `excused` are shorter next to `exempt`
        triangles. `worst` is the edge with the smallest `ratio`; its `edge` are two vertices.
        """
        found: dict[str, Any] | None = json.loads(self._data.get("dual_edges", "null"))
        return found

    @property
    def budget_spent(self) -> bool:
        """Whether the budget ended optimisation before its end."""
        return bool(self._data.get("budget_spent", False))

    @property
    def seconds(self) -> dict[str, float]:
        """Seconds of wall time by phase."""
        times: dict[str, float] = json.loads(self._data.get("seconds", "{}"))
        return times

    @property
    def method(self) -> str | None:
        """How the mesh was made: 'compact', 'templates' or 'simple'."""
        method: str | None = self._data.get("method")
        return method

    @property
    def domain(self) -> str | None:
        """What it covers: 'hexagon', 'hull', 'box' or 'inside'."""
        domain: str | None = self._data.get("domain")
        return domain

    # What follows from it

    @property
    def edges(self) -> Ints:
        """Every edge once, the lower index first, sorted, shape (e, 2)."""
        return self._topology().edges

    @property
    def neighbors(self) -> Ints:
        """The triangle across the edge opposite to each corner, shape (m, 3); -1 for none."""
        return self._topology().neighbors

    @property
    def boundary(self) -> Ints:
        """Edges that only one triangle has, with it on their left, sorted, shape (b, 2)."""
        return self._topology().boundary

    def boundary_loops(self) -> list[Ints]:
        """The closed curves of the boundary, the longest first.

        Returns
        -------
        list of ndarray
            Vertices in order, with the mesh on the left.

        Examples
        --------
        >>> import hexdel
        >>> len(hexdel.mesh([(0, 0)]).boundary_loops())
        1
        """
        return _topology.loops(self.boundary)

    def quality(self) -> Quality:
        """Angles, areas and aspect ratios of triangles.

        Returns
        -------
        Quality

        Examples
        --------
        >>> import hexdel
        >>> hexdel.Mesh([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)]).quality().area.tolist()
        [0.5]
        """

        def made() -> Quality:
            corners = self.vertices[self.triangles]
            to = np.roll(corners, -1, axis=1) - corners
            length = np.hypot(to[..., 0], to[..., 1])
            doubled = to[:, 0, 0] * to[:, 1, 1] - to[:, 0, 1] * to[:, 1, 0]
            back = -np.roll(to, 1, axis=1)
            dot = (to * back).sum(axis=2)
            angles = np.degrees(np.arctan2(np.abs(doubled)[:, None], dot))
            with np.errstate(divide="ignore", invalid="ignore"):
                aspect = length.prod(axis=1) * length.sum(axis=1) / (4 * doubled * np.abs(doubled))
            arrays = (angles.min(axis=1), angles.max(axis=1), doubled / 2, aspect)
            return Quality(*(frozen(array) for array in arrays))

        result: Quality = self._lazy("quality", made)
        return result

    def dual(self) -> Dual:
        """The Voronoi dual: cells, control volumes, lengths, weights, matrices.

        Returns
        -------
        Dual

        Raises
        ------
        InputError
            The mesh touches itself in a point, or has a flat or clockwise triangle.

        Examples
        --------
        >>> import hexdel
        >>> dual = hexdel.mesh([(0, 0), (1, 0)]).dual()
        >>> bool((dual.weights >= 0).all())
        True
        """
        from ._dual import Dual

        result: Dual = self._lazy("dual", lambda: Dual(self))
        return result

    # Out of here

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draws the mesh with matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to; new axes if there are none.
        color : {'angle', 'region', None} or array_like, optional
            What triangles are coloured by: their smallest angle, their region, or a
            number for each triangle or vertex.
        edges, points, segments : bool, optional
            Whether edges, input points, segments are drawn.
        **options
            Of matplotlib's ``tripcolor``.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from . import _plot

        return _plot.mesh(self, ax, **options)

    def save(self, path: str | os.PathLike[str], **options: Any) -> None:
        """Writes the mesh; the same as ``hexdel.write(path, mesh)``."""
        from ._files import write

        write(path, self, **options)

    to_meshio = _clients.to_meshio
    to_pyvista = _clients.to_pyvista
    to_skfem = _clients.to_skfem
    to_matplotlib = _clients.to_matplotlib
    to_xugrid = _clients.to_xugrid
    to_ugrid = _clients.to_ugrid
    to_flopy_disv = _clients.to_flopy_disv
    to_mpas = _clients.to_mpas
    to_shapely = _clients.to_shapely
    to_geopandas = _clients.to_geopandas

    # Python's manners

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Mesh):
            return NotImplemented
        return all(np.array_equal(a, b) for a, b in zip(self._identity(), other._identity(), strict=True))

    def __hash__(self) -> int:
        def made() -> int:
            digest = hashlib.sha256()
            # Zeros of both signs are equal.
            for array in self._identity():
                digest.update((array + 0).tobytes())
            return int.from_bytes(digest.digest()[:8], "little", signed=True)

        return int(self._lazy("hash", made))

    def _identity(self) -> tuple[NDArray[Any], ...]:
        return self.vertices, self.triangles, self.regions, self.vertex_markers

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Mesh:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self._data,)

    def __len__(self) -> int:
        """The number of triangles."""
        return len(self.triangles)

    def __repr__(self) -> str:
        quality = ""
        if "certificate" in self._data:
            c = self.certificate
            quality = f", {c.min_angle_deg:.4g} to {c.max_angle_deg:.4g} degrees"
            quality += "" if c.holds else ", does not keep what was asked for"
        return f"<hexdel.Mesh: {len(self.vertices)} vertices, {len(self.triangles)} triangles{quality}>"

    def _repr_svg_(self) -> str | None:
        if not 0 < len(self.triangles) <= DRAWN or not np.isfinite(self.vertices).all():
            return None
        return self._picture("svg").decode()

    def _repr_png_(self) -> bytes | None:
        if len(self.triangles) <= DRAWN or not np.isfinite(self.vertices).all():
            return None
        return self._picture("png")

    def _picture(self, form: str) -> bytes:
        bounds = self.certificate.bounds
        return _hexdel.picture(self._raw(), form, 480.0, bounds)

    def _raw(self) -> dict[str, Any]:
        """The arrays as the compiled half takes them; those that are known."""
        raw = {
            name: self._data.get(name)
            for name in (
                "input_of_vertex",
                "vertex_markers",
                "heights",
                "regions",
                "segment_edges",
                "segment_edge_markers",
            )
        }
        if raw["segment_edges"] is not None:
            raw["segment_edges"] = raw["segment_edges"].astype(np.uint32)
        return {"vertices": self.vertices, "triangles": self._corners(), **raw}

    def _corners(self) -> NDArray[np.uint32]:
        # The same bits: indices are not negative.
        return self.triangles.view(np.uint32)

    def _topology(self) -> _topology.Topology:
        def made() -> _topology.Topology:
            found = _topology.topology(self.triangles, len(self.vertices))
            return _topology.Topology(*(frozen(array) for array in found))

        result: _topology.Topology = self._lazy("topology", made)
        return result

    def _lazy(self, name: str, make: Any) -> Any:
        if name not in self._cache:
            self._cache[name] = make()
        return self._cache[name]

    def _array(self, name: str, default: Any) -> Any:
        if self._data.get(name) is not None:
            return self._data[name]
        return self._lazy(name, lambda: frozen(default()))

    def _list(self, name: str) -> list[dict[str, Any]]:
        text = self._data.get(name, ("[]", []))[0]
        entries: list[dict[str, Any]] = json.loads(text)
        return entries


def _restored(data: dict[str, Any]) -> Mesh:
    return Mesh._of(dict(data))


def threads() -> int | None:
    """Threads for what has no option for them."""
    return _options.thread_count()
