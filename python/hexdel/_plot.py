"""Drawings by matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._clients import wanted
from ._errors import OptionError

if TYPE_CHECKING:
    from ._dual import Dual
    from ._mesh import Mesh


def _axes(ax: Any) -> Any:
    if ax is None:
        _, ax = wanted("matplotlib.pyplot", "matplotlib").subplots()
    ax.set_aspect("equal")
    return ax


def mesh(
    made: Mesh,
    ax: Any,
    *,
    color: Any = "angle",
    edges: bool = True,
    points: bool = True,
    segments: bool = True,
    **options: Any,
) -> Any:
    """Draws a mesh; see `Mesh.plot`."""
    ax = _axes(ax)
    triangulation = made.to_matplotlib()
    line = {"edgecolors": "black", "linewidth": 0.3} if edges else {}
    if color is None:
        if edges:
            ax.triplot(triangulation, color="black", linewidth=0.3)
    else:
        values, defaults = _colour(made, color)
        if edges and len(values) == len(made.vertices) != len(made.triangles):
            ax.triplot(triangulation, color="black", linewidth=0.2)
        per_face = len(values) == len(made.triangles)
        given = {"facecolors": values} if per_face else {"shading": "gouraud"}
        arguments = (triangulation,) if per_face else (triangulation, values)
        ax.tripcolor(*arguments, **given, **{**defaults, **(line if per_face else {}), **options})
    if segments and "segment_edges" in made._data:
        collections = wanted("matplotlib.collections", "matplotlib")
        lines = collections.LineCollection(made.vertices[made.segment_edges], colors="black", linewidths=1.2)
        ax.add_collection(lines)
    inputs = made.input_of_vertex >= 0
    if points and inputs.any() and inputs.sum() <= 2000:
        ax.plot(*made.vertices[inputs].T, ".", color="black", markersize=3)
    return ax


def _colour(made: Mesh, color: Any) -> tuple[Any, dict[str, Any]]:
    if isinstance(color, str):
        if color == "angle":
            return made.quality().min_angle, {"cmap": "viridis", "vmin": made.certificate.bounds[0], "vmax": 60}
        if color == "region":
            return made.regions, {"cmap": "tab20"}
        raise OptionError(f"color must be 'angle', 'region', None or an array, got {color!r}", kind="option")
    values = np.asarray(color, float)
    if values.shape not in ((len(made.triangles),), (len(made.vertices),)):
        raise OptionError(
            f"color must have one number for each triangle or vertex, got shape {values.shape}", kind="option"
        )
    return values, {"cmap": "viridis"}


def dual(made: Dual, ax: Any, *, color: Any = None, **options: Any) -> Any:
    """Draws cells; see `Dual.plot`."""
    ax = _axes(ax)
    collections = wanted("matplotlib.collections", "matplotlib")
    cells = [made.cell(i) for i in range(len(made))]
    style: dict[str, Any] = {"edgecolors": "black", "linewidths": 0.3}
    if color is None:
        style["facecolors"] = "none"
    drawn = collections.PolyCollection(cells, **{**style, **options})
    if color is not None:
        drawn.set_array(np.asarray(color, float))
    ax.add_collection(drawn)
    ax.autoscale_view()
    return ax


def compare(plt: Any, first: dict[str, Any], second: dict[str, Any], figsize: tuple[float, float]) -> None:
    """Draws two dictionaries of triangulate beside each other."""
    _, axes = plt.subplots(1, 2, figsize=figsize, sharex=True, sharey=True)
    for ax, drawn in zip(axes, (first, second), strict=True):
        triangle(ax, **drawn)


def triangle(ax: Any, **drawn: Any) -> None:
    """Draws a dictionary of triangulate: triangles, segments, vertices, holes, regions."""
    ax.set_aspect("equal")
    ax.set_axis_off()
    vertices = np.asarray(drawn["vertices"], float)
    if "triangles" in drawn and len(drawn["triangles"]):
        ax.triplot(*vertices.T, np.asarray(drawn["triangles"])[:, :3], color="black", linewidth=0.6)
    if "segments" in drawn:
        for a, b in np.asarray(drawn["segments"]):
            ax.plot(*vertices[[a, b]].T, color="tab:red", linewidth=1.5)
    if "triangles" not in drawn:
        ax.plot(*vertices.T, ".", color="black")
    if "holes" in drawn and len(drawn["holes"]):
        ax.plot(*np.asarray(drawn["holes"], float).T, "x", color="tab:red")
    if "regions" in drawn:
        for x, y, attribute, *_ in np.asarray(drawn["regions"], float):
            ax.text(x, y, f"{attribute:g}", ha="center", va="center")
