"""The call, keys and switches of the package `triangle`."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _calls, _hexdel, _options, _plot
from ._arrays import Floats, Ints
from ._errors import HexdelWarning, OptionError
from ._mesh import Mesh

#: Switches that ask for what is so anyway, or choose between ways to the same.
WITHOUT_EFFECT = "DzCiFlsXVQjvgJ"

#: Switches that cannot be, and why.
REFUSED = {
    "Y": "segments must be divided for the angles to keep their bounds",
    "S": "the number of vertices follows from the angles",
    "r": "meshes are not refined: mesh the points or the PSLG anew",
    "u": "pass a callable size to hexdel.mesh_pslg instead",
    "I": "there are no files here",
    "N": "vertices are always returned",
    "E": "triangles are always returned",
}

KEYS = (
    "vertices",
    "vertex_attributes",
    "vertex_markers",
    "segments",
    "segment_markers",
    "holes",
    "regions",
)

#: Keys of what is returned, without a use in what is given.
OF_MESHES = (
    "triangles",
    "triangle_attributes",
    "triangle_max_area",
    "neighbors",
    "edges",
    "edge_markers",
)


@dataclass
class Switches:
    """What a string of switches asks for."""

    letters: set[str] = field(default_factory=set)
    min_angle: float | None = None
    max_area: float | None = None
    region_areas: bool = False
    second_order: bool = False

    @classmethod
    def parse(cls, opts: str) -> Switches:
        """Reads switches like 'pq30a0.1'."""
        if not isinstance(opts, str):
            raise OptionError(f"switches are a string, got {type(opts).__name__}", kind="option")
        switches, at = cls(), 0
        while at < len(opts):
            letter, at = opts[at], at + 1
            end = at
            if letter in "qaoS":
                while end < len(opts) and (opts[end].isdigit() or opts[end] == "."):
                    end += 1
            switches._take(letter, opts[at:end])
            at = end
        return switches

    def _take(self, letter: str, digits: str) -> None:
        if letter in REFUSED:
            raise OptionError(f"switch {letter!r} is not possible here", kind="option", hint=REFUSED[letter])
        if letter in "qa":
            number = None
            if digits:
                number = _options.number(
                    _number(digits), f"the number after {letter!r}", least=0.0, open_=letter == "a"
                )
            if letter == "q":
                self.min_angle = number
            elif number is None:
                self.region_areas = True
            else:
                self.max_area = number
        elif letter == "o":
            if digits not in ("1", "2"):
                raise OptionError("elements are of first or of second order, o2, only", kind="option")
            self.second_order = digits == "2"
        elif letter not in "pAcenBP" + WITHOUT_EFFECT and letter not in "- ":
            raise OptionError(f"there is no switch {letter!r}", kind="option")
        self.letters.add(letter)

    def __contains__(self, letter: str) -> bool:
        return letter in self.letters


def _number(digits: str) -> Any:
    try:
        return float(digits)
    except ValueError:
        return digits


def triangulate(tri: Mapping[str, Any], opts: str = "") -> dict[str, NDArray[Any]]:
    """Meshes a dictionary with Triangle's switches: ``triangle.triangulate``.

    Parameters
    ----------
    tri : mapping
        ``vertices`` (n, 2) and, if there are any, ``vertex_attributes`` (n, a),
        ``vertex_markers`` (n, 1), ``segments`` (s, 2), ``segment_markers`` (s, 1), ``holes``
        (h, 2), ``regions`` (r, 4): x, y, attribute, largest area.
    opts : str, optional
        ``p`` segments, holes and regions count, else points are meshed in their hull;
        ``q30`` the smallest angle, at most 43.89 (without a number, 30 degrees at segments
        and 43.89 elsewhere); ``a0.1`` the largest area, ``a`` the areas of regions; ``A``
        triangles carry attributes of regions; ``c`` the convex hull; ``e``, ``n`` edges,
        neighbours; ``o2`` nodes on the middles of edges; ``B``, ``P`` no markers, no
        segments. Others change nothing, or are refused by name.

    Returns
    -------
    dict
        Keys, shapes and dtypes of that package: ``vertices``, ``vertex_markers``,
        ``vertex_attributes``, ``triangles``, ``triangle_attributes``, ``neighbors``,
        ``segments``, ``segment_markers``, ``edges``, ``edge_markers``, ``holes``,
        ``regions``. Vertices begin with those given, in their order. Attributes
        are interpolated linearly between the points given.

    Examples
    --------
    >>> import hexdel
    >>> square = {"vertices": [(0, 0), (1, 0), (1, 1), (0, 1)], "segments": [(0, 1), (1, 2), (2, 3), (3, 0)]}
    >>> made = hexdel.triangulate(square, "pq30a0.1")
    >>> sorted(made)
    ['segment_markers', 'segments', 'triangles', 'vertex_markers', 'vertices']
    >>> made["vertices"][:4].tolist()
    [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
    """
    switches = Switches.parse(opts)
    given = _given(tri)
    points = _arrays.points(given.get("vertices"), "vertices")
    is_graph = "p" in switches
    attributes = _arrays.rows(given.get("vertex_attributes"), _columns(given), "vertex_attributes")
    regions = _arrays.rows(given.get("regions") if is_graph else None, (2, 3, 4), "regions").copy()
    if not switches.region_areas:
        regions = regions[:, :3]
    segments = given.get("segments") if is_graph else None
    graph = _calls._graph(
        points,
        segments,
        given.get("holes") if is_graph else None,
        regions,
        given.get("segment_markers") if segments is not None else None,
        given.get("vertex_markers"),
        attributes,
    )
    hull = "c" in switches or len(graph["segments"]) == 0
    raw = _options.raw(
        points,
        min_angle=switches.min_angle,
        max_area=switches.max_area,
        domain="hull" if hull else None,
    )
    made = _calls._made(_hexdel.mesh_graph, graph, raw)
    return _answer(made, switches, given, points, attributes)


def _given(tri: Mapping[str, Any]) -> dict[str, Any]:
    if not isinstance(tri, Mapping):
        raise OptionError(f"a dictionary is wanted, got {type(tri).__name__}", kind="option")
    unknown = [key for key in tri if key not in KEYS and key not in OF_MESHES]
    if unknown:
        raise OptionError(f"there is no key {unknown[0]!r}", kind="option", hint=f"keys are {', '.join(KEYS)}")
    unused = [key for key in tri if key in OF_MESHES]
    if unused:
        warnings.warn(f"not used, as meshes are made anew: {', '.join(unused)}", HexdelWarning, stacklevel=3)
    return {key: tri[key] for key in tri if key in KEYS}


def _columns(given: dict[str, Any]) -> int:
    shape = np.shape(given.get("vertex_attributes", np.zeros((0, 0))))
    return shape[1] if len(shape) == 2 else 1


def _answer(
    made: Mesh, switches: Switches, given: dict[str, Any], points: Floats, attributes: Floats
) -> dict[str, NDArray[Any]]:
    """The mesh in the keys and the order of the package."""
    first = made.input_of_vertex >= 0
    number = np.empty(len(made.vertices), np.int32)
    number[first] = made.input_of_vertex[first]
    number[~first] = len(points) + np.arange(np.count_nonzero(~first))
    markers = np.zeros(len(points), np.int32)
    if given.get("vertex_markers") is not None:
        markers = _arrays.markers(given["vertex_markers"], len(points), "vertex_markers", "vertex")
    markers = np.concatenate((markers, np.zeros(np.count_nonzero(~first), np.int32)), dtype=np.int32)
    markers[number] = made.vertex_markers
    answer: dict[str, NDArray[Any]] = {"vertices": np.concatenate((points, made.vertices[~first]))}
    if attributes.shape[1]:
        values = np.zeros((len(answer["vertices"]), attributes.shape[1]))
        values[: len(points)] = attributes
        values[number] = made._data["vertex_attributes"]
        answer["vertex_attributes"] = values
    triangles = number[made.triangles]
    edges = made.edges if switches.second_order or "e" in switches else np.zeros((0, 2), np.int32)
    if switches.second_order:
        answer, markers, triangles = _with_middles(made, edges, number, answer, markers, triangles)
    answer["vertex_markers"] = markers[:, None]
    answer["triangles"] = triangles
    if "A" in switches and "regions" in made._data:
        answer["triangle_attributes"] = made.regions[:, None].copy()
    if "n" in switches:
        answer["neighbors"] = made.neighbors.copy()
    if ("p" in switches or "c" in switches) and "P" not in switches:
        answer["segments"] = number[made.segment_edges]
        answer["segment_markers"] = made.segment_edge_markers[:, None].copy()
    for name in ("holes", "regions"):
        if "p" in switches and "P" not in switches and given.get(name) is not None:
            answer[name] = _arrays.floats(given[name], name)
    if "e" in switches:
        answer["edges"] = number[edges]
        answer["edge_markers"] = _edge_markers(made, edges)[:, None]
    if "B" in switches:
        answer = {key: value for key, value in answer.items() if not key.endswith("_markers")}
    return answer


def _key(ends: NDArray[Any], count: int) -> NDArray[np.int64]:
    low, high = np.sort(ends, axis=-1).astype(np.int64).reshape(-1, 2).T
    return low * count + high


def _edge_markers(made: Mesh, edges: Ints) -> Ints:
    markers = np.zeros(len(edges), np.int32)
    count, keys = len(made.vertices), _key(edges, len(made.vertices))
    markers[np.searchsorted(keys, _key(made.boundary, count))] = 1
    markers[np.searchsorted(keys, _key(made.segment_edges, count))] = made.segment_edge_markers
    return markers


def _with_middles(
    made: Mesh, edges: Ints, number: Ints, answer: dict[str, Any], markers: Ints, triangles: Ints
) -> tuple[dict[str, Any], Ints, Ints]:
    """Nodes on the middles of edges: of each triangle opposite to its corners."""
    before = len(answer["vertices"])
    ends = number[edges]
    for name in ("vertices", "vertex_attributes"):
        if name in answer:
            middles = answer[name][ends].mean(axis=1)
            answer[name] = np.concatenate((answer[name], middles))
    sides = made.triangles[:, ((1, 2), (2, 0), (0, 1))]
    place = np.searchsorted(_key(edges, len(made.vertices)), _key(sides, len(made.vertices)))
    triangles = np.concatenate((triangles, (before + place).reshape(-1, 3).astype(np.int32)), axis=1)
    return answer, np.concatenate((markers, _edge_markers(made, edges))), triangles


def compare(plt: Any, A: Mapping[str, Any], B: Mapping[str, Any], figsize: tuple[float, float] = (6, 3)) -> None:
    """Draws what went into `triangulate` beside what came out: ``triangle.compare``.

    Parameters
    ----------
    plt : module
        ``matplotlib.pyplot``.
    A, B : mapping
        Dictionaries of `triangulate`.
    figsize : tuple of float, optional
        Inches.
    """
    _plot.compare(plt, dict(A), dict(B), figsize)


def plot(ax: Any, **kw: Any) -> None:
    """Draws a dictionary of `triangulate` on axes: ``triangle.plot``."""
    _plot.triangle(ax, **kw)
