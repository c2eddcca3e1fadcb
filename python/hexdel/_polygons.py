"""Polygons of shapely, geopandas and GeoJSON."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterable, Mapping
from typing import Any, Literal

import numpy as np

from . import _arrays, _calls, _hexdel, _options
from ._errors import HexdelWarning, InputError, OptionError
from ._mesh import Mesh
from ._options import Effort, Method, Progress
from ._size import SizeIn, SizeLike


def mesh_polygons(
    geometry: Any,
    *,
    size: SizeLike | str | None = None,
    repair: bool | float | None = None,
    overlaps: Literal["later", "refuse"] | None = None,
    min_angle: float | None = None,
    max_angle: float | None = None,
    min_dual_edge: float | None = None,
    method: Method | None = None,
    effort: Effort | None = None,
    gradation: float | None = None,
    max_area: float | None = None,
    budget: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Mesh:
    """Meshes polygons: outlines are segments, holes are empty, islands are meshed.

    Parameters
    ----------
    geometry : shapely geometry, GeoDataFrame, GeoSeries, GeoJSON mapping, or list of geometries
        Anything with ``__geo_interface__``. Lines and points of it become segments and
        vertices. Coordinates are taken as they are: project longitudes and latitudes first.
    size : str or size, optional
        As of `mesh`; or the name of a column of a GeoDataFrame with the length of edges in
        each polygon, as pandamesh's ``cellsize``.
    repair : bool or float, optional
        Outlines that cross, overlap or nearly meet: as of `mesh_pslg`.
    overlaps : {'later', 'refuse'}, optional
        Where polygons overlap the later one counts, with a warning (the default), or it is
        an error. Gaps between polygons are outside.
    min_angle, max_angle, min_dual_edge, method, effort, gradation, max_area, budget, threads, progress
        As of `mesh_pslg`.

    Returns
    -------
    Mesh
        ``region_of_triangle`` is the row of the polygon that each triangle lies in, ``regions``
        the same number from 1.

    Raises
    ------
    InputError
        Something that holds no polygons, or outlines that cross.

    Warns
    -----
    HexdelWarning
        Overlaps, borders that were divided where they meet others, and as of `mesh_pslg`.

    Examples
    --------
    >>> import hexdel
    >>> ring = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]
    >>> hole = [[1, 1], [1, 2], [2, 2], [2, 1], [1, 1]]
    >>> mesh = hexdel.mesh_polygons({"type": "Polygon", "coordinates": [ring, hole]})
    >>> round(float(mesh.quality().area.sum()), 12)
    15.0
    """
    features = _features(geometry)
    wanted: SizeLike | None = _column(geometry, features, size) if isinstance(size, str) else size
    _warn_of_degrees(geometry)
    text = json.dumps({"type": "FeatureCollection", "features": features})
    raw = _options.raw(
        np.zeros((0, 2)),
        method=method,
        effort=effort,
        min_angle=min_angle,
        max_angle=max_angle,
        min_dual_edge=min_dual_edge,
        max_area=max_area,
        budget=budget,
        repair=repair,
        overlaps=overlaps,
        size=wanted,
        gradation=gradation,
        threads=threads,
        progress=progress,
    )
    made = _calls._made(lambda text, raw: _hexdel.mesh_text(text, "geojson", "the polygons", raw), text, raw)
    data = dict(made._data)
    data["region_of_triangle"] = made.regions.astype(np.int32) - 1
    return Mesh._of(data)


def _features(geometry: Any) -> list[dict[str, Any]]:
    """The geometries, each a feature without properties."""
    found = []
    for number, shape in enumerate(_shapes(geometry)):
        mapping = getattr(shape, "__geo_interface__", shape)
        if mapping is None or getattr(shape, "is_empty", False):
            mapping = None
        elif not isinstance(mapping, Mapping) or "type" not in mapping:
            raise InputError(
                f"geometry {number} is no geometry, got {type(shape).__name__}",
                kind="geometry",
                item="geometry",
                index=number,
                hint="pass shapely geometries, a GeoDataFrame or GeoJSON",
            )
        if mapping is not None and mapping["type"] == "Feature":
            mapping = mapping.get("geometry")
        found.append({"type": "Feature", "properties": {}, "geometry": mapping})
    if not found:
        raise InputError("there are no geometries", kind="empty")
    return found


def _shapes(geometry: Any) -> Iterable[Any]:
    if hasattr(geometry, "geometry") and hasattr(geometry, "columns"):
        return list(geometry.geometry)
    if isinstance(geometry, (str, bytes)):
        raise InputError("a text is no geometry", kind="geometry", hint="hexdel.read() reads files")
    if hasattr(geometry, "geom_type") and hasattr(geometry, "iloc"):
        return list(geometry)
    mapping = getattr(geometry, "__geo_interface__", geometry)
    if isinstance(mapping, Mapping):
        kind = mapping.get("type")
        if kind == "FeatureCollection":
            return list(mapping.get("features") or [])
        if kind == "GeometryCollection":
            return list(mapping.get("geometries") or [])
        return [mapping]
    try:
        return list(geometry)
    except TypeError:
        raise InputError(
            f"there is no geometry in {type(geometry).__name__}",
            kind="geometry",
            hint="pass shapely geometries, a GeoDataFrame or GeoJSON",
        ) from None


def _column(geometry: Any, features: list[dict[str, Any]], name: str) -> list[SizeIn]:
    """One size for each polygon by a column of a table."""
    if name not in getattr(geometry, "columns", ()):
        raise OptionError(f"there is no column {name!r} with sizes", kind="size")
    lengths = _arrays.numbers(geometry[name], len(features), name, "row")
    sizes = []
    for feature, length in zip(features, lengths.tolist(), strict=True):
        shape = feature["geometry"] or {}
        kind, rings = shape.get("type"), shape.get("coordinates", [])
        for polygon in [rings] if kind == "Polygon" else rings if kind == "MultiPolygon" else []:
            sizes.append(SizeIn(_arrays.floats([place[:2] for place in polygon[0][:-1]], name), length))
    return sizes


def _warn_of_degrees(geometry: Any) -> None:
    if getattr(getattr(geometry, "crs", None), "is_geographic", False):
        warnings.warn(
            "coordinates are longitudes and latitudes: angles hold in degrees, not on the ground; "
            "project them first, geometry.to_crs(geometry.estimate_utm_crs())",
            HexdelWarning,
            stacklevel=3,
        )
