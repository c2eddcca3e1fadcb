"""The calls that make and check meshes."""

from __future__ import annotations

import json
import warnings
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import _arrays, _hexdel, _options, _progress, _size, _topology
from ._arrays import Floats
from ._certificate import Certificate
from ._errors import HexdelWarning, OptionError
from ._mesh import Mesh
from ._options import DomainName, Effort, Method, Progress
from ._size import SizeLike

#: Meshes that are made at most until one keeps to a callable size.
ROUNDS = 4

#: Items of a list that a warning shows.
SHOWN = 3


def mesh(
    points: ArrayLike,
    *,
    min_angle: float | None = None,
    max_angle: float | None = None,
    min_dual_edge: float | None = None,
    method: Method | None = None,
    effort: Effort | None = None,
    size: SizeLike | None = None,
    gradation: float | None = None,
    max_area: float | None = None,
    budget: float | None = None,
    domain: DomainName | float | None = None,
    repair: bool | float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Mesh:
    """Meshes points: each becomes a vertex, every angle is within the bounds.

    Parameters
    ----------
    points : array_like, shape (n, 2)
        Coordinates, in any unit. Duplicates share a vertex.
    min_angle, max_angle : float, optional
        Bounds of angles, degrees; 43.8978 and 90 unless said otherwise. Wider ones
        lead to fewer triangles, narrower ones are tried.
    min_dual_edge : float, optional
        No edge of the Voronoi dual is shorter than this times the edge that it crosses:
        no angle is larger than its arc cotangent, 84.3 degrees for 0.1. At most 0.3249.
        `Mesh.dual_edges` has what was found.
    method : {'compact', 'templates', 'simple'}, optional
        Few triangles (the default); the method whose bounds are proved, in a fraction
        of the time; or 30 to 120 degrees.
    effort : {'fast', 'standard', 'best', 'fewest'}, optional
        How hard 'compact' tries to get by with few triangles.
    size : float, array_like, callable, Raster, SizeAt, SizeIn or list of these, optional
        How long edges may be. An array has one length for each point. A callable gets
        arrays x and y and returns lengths, which should change no faster than the
        distance. Of a list the smallest length counts.
    gradation : float, optional
        How much longer edges may get per unit of distance away from small sizes; 0.5.
    max_area : float, optional
        The largest area of a triangle, square units.
    budget : float, optional
        Seconds that optimisation may take; the mesh is valid however short.
    domain : {'hexagon', 'hull', 'box'} or float, optional
        What is covered: a regular hexagon around the points (the default; a number is
        its radius), their convex hull, or the rectangle with a margin of a tenth.
    repair : bool or float, optional
        Points closer than this become one; True is a billionth of the extent.
    threads : int, optional
        All there are by default; one in children of `multiprocessing`. The mesh does
        not depend on it.
    progress : bool or callable, optional
        True shows a bar (tqdm if it is installed); a callable gets the phase, the units
        done and about how many there are. An exception in it stops the work.

    Returns
    -------
    Mesh

    Raises
    ------
    InputError
        Points that cannot be meshed, by index and coordinates.
    OptionError
        An option that is none, or of no use here.
    UnreachedError
        Bounds that were not reached, with the best mesh.

    Examples
    --------
    >>> import numpy as np, hexdel
    >>> points = np.random.default_rng(1).random((50, 2))
    >>> mesh = hexdel.mesh(points)
    >>> mesh.holds, bool((mesh.vertices[mesh.vertex_of_input] == points).all())
    (True, True)
    >>> wide = hexdel.mesh(points, min_angle=30)
    >>> len(wide) < len(mesh)
    True
    >>> fine = hexdel.mesh(points, size=lambda x, y: 0.05 + 0.1 * x)
    >>> fine.size_ratio <= 1 + 1e-8
    True
    """
    places = _arrays.points(points)
    raw = _options.raw(
        places,
        min_angle=min_angle,
        max_angle=max_angle,
        min_dual_edge=min_dual_edge,
        method=method,
        effort=effort,
        size=size,
        gradation=gradation,
        max_area=max_area,
        budget=budget,
        domain=domain,
        repair=repair,
        threads=threads,
        progress=progress,
    )
    of_graph = raw["domain"] not in (None, "hexagon") or raw["max_area"] or raw["repair"] is not None
    if of_graph:
        return _made(_hexdel.mesh_graph, _graph(places), raw)
    return _made(_hexdel.mesh_points, places, {**raw, "domain": None})


def mesh_pslg(
    points: ArrayLike,
    segments: ArrayLike,
    *,
    holes: ArrayLike | None = None,
    regions: ArrayLike | None = None,
    markers: ArrayLike | None = None,
    point_markers: ArrayLike | None = None,
    repair: bool | float | None = None,
    min_angle: float | None = None,
    max_angle: float | None = None,
    min_dual_edge: float | None = None,
    method: Method | None = None,
    effort: Effort | None = None,
    size: SizeLike | None = None,
    gradation: float | None = None,
    max_area: float | None = None,
    budget: float | None = None,
    domain: DomainName | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Mesh:
    """Meshes a planar straight-line graph: every segment is a union of edges.

    Angles are within 30 to 90 degrees next to segments and points, 43.8978 to 90 two
    edges away. Triangles that do not keep their bounds are listed in `Mesh.exempt`
    (corners of the input narrower than the bound) and `Mesh.failed`, and warned of.

    Parameters
    ----------
    points : array_like, shape (n, 2)
    segments : array_like of int, shape (s, 2)
        Indices of points, from 0.
    holes : array_like, shape (h, 2), optional
        A point in each part of the plane that is to be left empty.
    regions : array_like, shape (r, 2), (r, 3) or (r, 4), optional
        A point in each region, with its attribute and the largest area of its triangles
        (0 or less: no limit).
    markers : array_like of int, shape (s,), optional
        A marker of each segment, passed on to its edges and their vertices.
    point_markers : array_like of int, shape (n,), optional
    repair : bool or float, optional
        Merges points closer than this (True: a billionth of the extent) and divides
        segments where they cross or pass through points; `Mesh.repairs` tells what was done.
    domain : {'inside', 'hull', 'box', 'hexagon'}, optional
        What is covered: what segments enclose (the default if there are any), the
        convex hull, the rectangle with a margin, a hexagon; always without holes.
    min_angle, max_angle, min_dual_edge, method, effort, size, gradation, max_area, budget, threads, progress
        As of `mesh`. Bounds hold next to segments as well, if given.

    Returns
    -------
    Mesh

    Raises
    ------
    InputError
        Points or segments that cannot be meshed, by index and coordinates.
    OptionError
        An option that is none, or of no use here.

    Warns
    -----
    HexdelWarning
        Duplicates, points that are not in the domain, repairs, triangles out of bounds.

    Examples
    --------
    >>> import hexdel
    >>> corners = [(0, 0), (4, 0), (4, 4), (0, 4), (1, 1), (2, 1), (2, 2), (1, 2)]
    >>> sides = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]
    >>> plate = hexdel.mesh_pslg(corners, sides, holes=[(1.5, 1.5)], max_area=0.1)
    >>> plate.holds, round(float(plate.quality().area.sum()), 12)
    (True, 15.0)
    """
    places = _arrays.points(points)
    raw = _options.raw(
        places,
        min_angle=min_angle,
        max_angle=max_angle,
        min_dual_edge=min_dual_edge,
        method=method,
        effort=effort,
        size=size,
        gradation=gradation,
        max_area=max_area,
        budget=budget,
        domain=domain,
        repair=repair,
        threads=threads,
        progress=progress,
    )
    graph = _graph(places, segments, holes, regions, markers, point_markers)
    if raw["radius"] is not None:
        raise OptionError("a radius is for points, not for PSLGs", kind="option", hint="pass domain='hexagon'")
    return _made(_hexdel.mesh_graph, graph, raw)


def check(
    vertices: ArrayLike,
    triangles: ArrayLike,
    *,
    points: ArrayLike | None = None,
    segments: ArrayLike | None = None,
    min_angle: float = 0.0,
    max_angle: float = 180.0,
    min_edge: float | None = None,
    delaunay: bool = True,
    disk: bool = False,
    max_violations: int = 100,
    threads: int | None = None,
) -> Certificate:
    """Checks any mesh, whoever made it, from its coordinates and indices.

    Parameters
    ----------
    vertices : array_like, shape (n, 2)
    triangles : array_like of int, shape (m, 3)
        May hold anything: what is wrong is found out, not refused.
    points : array_like, shape (k, 2), optional
        Points that must be vertices, bit for bit.
    segments : array_like of int, shape (s, 2), optional
        Indices of `points`: each must be a union of edges.
    min_angle, max_angle : float, optional
        Bounds of angles, degrees.
    min_edge : float, optional
        The shortest edge allowed.
    delaunay, disk : bool, optional
        Whether the mesh must be Delaunay, must be one disk.
    max_violations : int, optional
        How many violations are listed; all are counted.
    threads : int, optional

    Returns
    -------
    Certificate

    Examples
    --------
    >>> import hexdel
    >>> square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    >>> bool(hexdel.check(square, [(0, 1, 2), (0, 2, 3)], min_angle=40, max_angle=90))
    True
    >>> turned = hexdel.check(square, [(0, 1, 2), (0, 3, 2)])
    >>> turned.holds, turned.not_counter_clockwise
    (False, 1)
    """
    places = _arrays.points(vertices, "vertices")
    corners = _arrays.indices(triangles, 3, "triangles", "triangle")
    inputs = None if points is None else _arrays.points(points)
    lines = _arrays.indices(segments, 2, "segments", "segment", 0 if inputs is None else len(inputs))
    low = _options.number(min_angle, "min_angle", least=0.0, most=60.0)
    high = _options.number(max_angle, "max_angle", least=60.0, most=180.0)
    text, holds, missing = _hexdel.check(
        places,
        corners,
        points=inputs,
        segments=lines,
        bounds=(low or 0.0, high or 180.0),
        min_edge=_options.number(min_edge, "min_edge", least=0.0),
        delaunay=bool(delaunay),
        disk=bool(disk),
        violations=int(_options.number(max_violations, "max_violations", least=0.0) or 0),
        threads=_options.thread_count(threads),
    )
    return Certificate(text, holds, tuple(missing))


def generate(kind: str, count: int, seed: int = 1) -> Floats:
    """Test points, the same on every platform.

    Parameters
    ----------
    kind : str
        'uniform', 'line', 'clusters', 'grid', 'jittered', 'circle', 'spiral', 'pairs'
        or 'contrast'.
    count : int
    seed : int, optional

    Returns
    -------
    ndarray, shape (count, 2)

    Examples
    --------
    >>> import hexdel
    >>> hexdel.generate("uniform", 3).shape
    (3, 2)
    """
    whole = _options.number(count, "count", least=0.0, most=2.0**31)
    start = _options.number(seed, "seed", least=0.0, most=2.0**53)
    return _hexdel.generate_points(str(kind), int(whole or 0), int(start or 0))


def _graph(
    points: Floats,
    segments: ArrayLike | None = None,
    holes: ArrayLike | None = None,
    regions: ArrayLike | None = None,
    markers: ArrayLike | None = None,
    point_markers: ArrayLike | None = None,
    point_attributes: Floats | None = None,
) -> dict[str, Any]:
    """A graph as the compiled half takes it."""
    lines = _arrays.indices(segments, 2, "segments", "segment", len(points))
    given = _arrays.rows(regions, (2, 3, 4), "regions")
    seeds = np.zeros((len(given), 4))
    seeds[:, : given.shape[1]] = given
    return {
        "points": points,
        "segments": lines,
        "holes": _arrays.points(holes, "holes"),
        "regions": seeds,
        "point_markers": _arrays.markers(point_markers, len(points), "point_markers", "point"),
        "segment_markers": _arrays.markers(markers, len(lines), "markers", "segment"),
        "point_attributes": np.zeros((len(points), 0)) if point_attributes is None else point_attributes,
    }


def _made(call: Any, what: Any, raw: Any) -> Mesh:
    """Meshes, as often as it takes to keep to callable sizes, and warns."""
    try:
        data = call(what, raw)
        asked = _size.functions(raw["size"])
        if asked:
            data = _kept(call, what, raw, data, asked)
    finally:
        _progress.close(raw["progress"])
    _warn(data)
    return Mesh._of(data)


def _kept(call: Any, what: Any, raw: Any, data: dict[str, Any], asked: list[_size.Function]) -> dict[str, Any]:
    """A mesh that keeps to callables themselves, not only to what was sampled of them."""
    factor = _size.FACTOR
    only = len(asked) == len(raw["size"])
    for left in reversed(range(ROUNDS)):
        edges = _topology.topology(data["triangles"], len(data["vertices"])).edges
        ratio = _size.worst(data["vertices"], edges, asked)
        sampled = data["size_ratio"] or 0.0
        data["size_ratio"] = ratio if only else max(ratio, sampled)
        factor *= 0.99 / max(ratio, 1.0)
        # Where the size jumps, ever smaller triangles everywhere do not help.
        if ratio <= 1 + _size.SLACK or sampled > 1 + _size.SLACK or left == 0 or factor < _size.FACTOR / 2:
            break
        data = call(what, {**raw, "size": _size.with_factor(raw["size"], factor)})
    return data


def _warn(data: dict[str, Any]) -> None:
    """Warns of all that was mended, not used or not reached."""
    notes = []
    inputs = data["vertex_of_input"]
    repairs = data.get("repairs", ("", []))[1]
    inside = inputs[inputs >= 0]
    twice = len(inside) - np.count_nonzero(data["input_of_vertex"] >= 0)
    if twice and not repairs:
        notes.append(f"{twice} points are duplicates of others: they share a vertex")
    outside = np.flatnonzero(inputs < 0)
    if len(outside):
        notes.append(f"{len(outside)} points are not in the domain: {_some(outside.tolist())}")
    notes.extend(data.get("warnings", []))
    if repairs:
        notes.append(f"repaired: {_some(repairs)}")
    exempt, failed = (data.get(name, ("", []))[1] for name in ("exempt", "failed"))
    if exempt:
        notes.append(f"{len(exempt)} triangles at corners narrower than the bound: {_some(exempt)}")
    if failed:
        notes.append(f"{len(failed)} triangles do not keep what was asked for: {_some(failed)}")
    if data.get("segments_missing"):
        notes.append(f"{data['segments_missing']} parts of segments are no unions of edges")
    if data.get("budget_spent"):
        notes.append("the budget was spent before the mesh was as good as can be")
    ratio = data.get("size_ratio")
    if ratio is not None and ratio > 1 + 10 * _size.SLACK:
        notes.append(f"edges are up to {ratio:.3g} times as long as the size wants")
    dual = json.loads(data.get("dual_edges", "null"))
    if dual and dual["below"]:
        notes.append(f"{dual['below']} dual edges are shorter than {dual['min_ratio']:g} of their edges")
    if notes:
        warnings.warn("; ".join(notes), HexdelWarning, stacklevel=4)


def _some(items: list[Any]) -> str:
    shown = ", ".join(map(str, items[:SHOWN]))
    return shown + (f" and {len(items) - SHOWN} more" if len(items) > SHOWN else "")
