"""Files of meshes and PSLGs, by extension."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from . import _arrays, _calls, _hexdel
from ._arrays import frozen
from ._errors import FileError, HexdelWarning, OptionError
from ._mesh import Mesh


class Graph(Mapping[str, Any]):
    """Points and segments that were read: the arguments of `mesh_pslg`.

    A mapping with ``points``, ``segments``, ``holes``, ``regions``, ``markers`` and
    ``point_markers``, so that ``hexdel.mesh_pslg(**graph)`` meshes it; each is an
    attribute, too. ``point_attributes`` is an attribute only.
    """

    _KEYS = ("points", "segments", "holes", "regions", "markers", "point_markers")

    def __init__(self, raw: dict[str, Any]) -> None:
        self.points = frozen(raw["points"])
        self.segments = frozen(raw["segments"])
        self.holes = frozen(raw["holes"])
        self.regions = frozen(raw["regions"])
        self.point_attributes = frozen(raw["point_attributes"])
        self.markers = frozen(raw["segment_markers"]) if len(raw["segment_markers"]) else None
        self.point_markers = frozen(raw["point_markers"]) if len(raw["point_markers"]) else None

    def __getitem__(self, key: str) -> Any:
        if key not in self._KEYS:
            raise KeyError(key)
        return getattr(self, key)

    def __iter__(self) -> Iterator[str]:
        return iter(self._KEYS)

    def __len__(self) -> int:
        return len(self._KEYS)

    def __repr__(self) -> str:
        counts = ((len(self[key]), key) for key in ("points", "segments", "holes", "regions"))
        return f"<hexdel.Graph: {', '.join(f'{count} {name}' for count, name in counts if count)}>"


def read(path: str | os.PathLike[str], *, columns: str | None = None) -> Mesh | Graph:
    """Reads a mesh, points or a PSLG, by the extension of the file.

    Parameters
    ----------
    path : path-like
        Meshes: ``.ele`` with ``.node``, ``.vtu``, ``.msh``, ``.obj``, ``.off``, ``.mesh``,
        ``.2dm``, ``.14``, ``.json``, ``.ron``. Points and PSLGs: ``.node``, ``.poly``,
        ``.csv``, ``.tsv``, ``.xyz``, ``.txt``, ``.pts``, ``.geojson``, ``.geojsonl``,
        ``.geojsons``, ``.ndjson``, ``.wkt``, ``.json``, ``.ron``.
    columns : str, optional
        Columns of x and y in a table, and of heights if there is a third, by name or number
        from 1: ``"easting,northing"``. Heights are the ``point_attributes`` of the graph.
        Found out from the header unless said otherwise.

    Returns
    -------
    Mesh or Graph
        Graphs (and points) go on to ``mesh_pslg(**graph)``, or ``mesh(graph.points)``. Polygons
        become holes and regions, whose attribute is the number of the polygon from 1.

    Raises
    ------
    MissingFileError
        There is no such file.
    FileError
        The file is not what its extension says, with the line.

    Examples
    --------
    >>> import hexdel, os, tempfile
    >>> mesh = hexdel.mesh([(0, 0), (1, 0)])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     hexdel.write(os.path.join(folder, "two.vtu"), mesh)
    ...     again = hexdel.read(os.path.join(folder, "two.vtu"))
    >>> bool((again.vertices == mesh.vertices).all())
    True
    """
    path = os.fspath(path)
    is_mesh, is_graph = _hexdel.formats(path)
    if path.lower().endswith(".node"):
        # A file of points, even if there are triangles to it: those are in .ele.
        is_mesh = False
    if is_mesh and is_graph:
        try:
            is_mesh = _hexdel.holds_mesh(path)
        except FileNotFoundError:
            is_mesh = False
        except OSError as error:
            raise FileError(str(error), kind="file") from None
    if not is_mesh:
        graph = _hexdel.read_graph(path, columns)
        if graph["warnings"]:
            warnings.warn("; ".join(graph["warnings"]), HexdelWarning, stacklevel=2)
        return Graph(graph)
    raw = {name: value for name, value in _hexdel.read_mesh(path).items() if value is not None}
    if "input_of_vertex" in raw:
        raw["vertex_of_input"] = _inverse(raw["input_of_vertex"])
    return Mesh._of(raw)


def _inverse(inputs: Any) -> Any:
    count = int(inputs.max(initial=-1)) + 1
    vertices = np.full(count, -1, np.int32)
    known = np.flatnonzero(inputs >= 0)[::-1]
    vertices[inputs[known]] = known
    return vertices


def write(
    path: str | os.PathLike[str], what: Any, *, second_order: bool = False, crs: str | int | None = None
) -> None:
    """Writes a mesh, or points or a PSLG, by the extension of the file.

    Parameters
    ----------
    path : path-like
        Meshes: ``.ele`` with ``.node``, ``.edge``, ``.neigh``, ``.poly``, ``.vtu``, ``.vtk``,
        ``.msh``, ``.obj``, ``.off``, ``.mesh``, ``.stl``, ``.2dm``, ``.14``, ``.nc`` (UGRID),
        ``.geojson``, ``.wkt``, ``.json``, ``.ron``, and pictures: ``.svg``, ``.png``.
        Graphs: ``.node``, ``.poly``, ``.csv``, ``.tsv``, ``.xyz``, ``.geojson``, ``.json``, ``.ron``.
    what : Mesh, Graph, mapping or array_like
        A PSLG is a mapping of arguments of `mesh_pslg`, points are an array of shape (n, 2).
    second_order : bool, optional
        Whether ``.ele`` gets nodes on the middles of edges.
    crs : str or int, optional
        The coordinate system of a mesh in ``.geojson`` or ``.nc``, by its code of EPSG such as
        ``"EPSG:25832"`` or 25832. Coordinates stay as they are: pyproj projects them.

    Raises
    ------
    FileError
        The file cannot be written, or not in this format. What was there before stays.

    Warns
    -----
    HexdelWarning
        The format has no place for something that is known.
    """
    path = os.fspath(path)
    if isinstance(what, Mesh):
        lost = _hexdel.write_mesh(path, what._raw(), bool(second_order), _epsg(crs, path))
    else:
        if second_order or crs is not None:
            option = "second_order" if second_order else "crs"
            raise OptionError(f"{option} is for meshes", kind="option")
        given = dict(what) if isinstance(what, Mapping) else {"points": what}
        unknown = set(given) - set(Graph._KEYS)
        if unknown:
            raise OptionError(f"a PSLG has no {', '.join(map(repr, sorted(unknown)))}", kind="option")
        places = _arrays.points(given.pop("points", None))
        lost = _hexdel.write_graph(path, _calls._graph(places, **given))
    if lost:
        name = os.path.basename(path)
        warnings.warn(f"{name}: the format has no place for {', '.join(lost)}", HexdelWarning, stacklevel=2)


def _epsg(crs: str | int | None, path: str) -> int | None:
    """The number of a coordinate system that a file holds."""
    if crs is None:
        return None
    if not path.lower().endswith((".geojson", ".nc")):
        raise OptionError(f"crs is for .geojson and .nc, and {os.path.basename(path)} is neither", kind="option")
    digits = crs.upper().removeprefix("EPSG:") if isinstance(crs, str) and ":" in crs else str(crs)
    number = int(digits) if digits.isascii() and digits.isdecimal() and not isinstance(crs, bool) else 0
    if not 0 < number < 65536:
        raise OptionError(f"crs must be a code like 'EPSG:25832', got {crs!r}", kind="option")
    return number
