"""From a GeoDataFrame to a finite-volume solution on Voronoi cells, with pictures.

A catchment of two soils around a lake, with two wells: polygons in, cells with heads out.
What docs/python.md shows is made by this file.

    python groundwater.py [FOLDER]
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import geopandas
import matplotlib
import numpy as np
import shapely
from scipy.sparse.linalg import spsolve

import hexdel

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402

#: Wells: place, and how much they pump.
WELLS = [((620.0, 380.0), 400.0), ((300.0, 620.0), 250.0)]


def catchment() -> Any:
    """Two soils that share a border, around a lake; metres."""
    outline = [(0, 80), (260, 0), (700, 40), (1000, 300), (960, 720), (640, 900), (240, 860), (40, 520)]
    lake = shapely.Point(480, 470).buffer(130, quad_segs=6)
    border = [(-50, -50), (1050, -50), (1050, 330), (640, 290), (380, 310), (-50, 260)]
    whole = shapely.Polygon(outline) - lake
    gravel = whole & shapely.Polygon(border)
    return geopandas.GeoDataFrame(
        {"soil": ["gravel", "sand"], "conductivity": [30.0, 8.0]}, geometry=[gravel, whole - gravel], crs="EPSG:25832"
    )


def mesh_of(soils: Any) -> hexdel.Mesh:
    """Edges of 60 metres, finer towards the wells, which are vertices."""
    wells = geopandas.GeoSeries([shapely.Point(place) for place, _ in WELLS])
    near = hexdel.SizeAt([place for place, _ in WELLS], [8.0] * len(WELLS))
    shapes = [*soils.geometry, *wells]
    # The soils were cut apart by rounded coordinates: their corners are joined again.
    return hexdel.mesh_polygons(shapes, size=[60.0, near], gradation=0.3, repair=True)


def heads_of(mesh: hexdel.Mesh, soils: Any) -> Any:
    """Steady heads: the lake at 0 metres, nothing across the rest of the boundary."""
    dual = mesh.dual()
    of_triangle = soils["conductivity"].to_numpy()[mesh.region_of_triangle]
    # Faces lie in the triangles on both sides of an edge.
    sides = np.where(dual.edge_triangles >= 0, of_triangle[dual.edge_triangles], np.nan)
    matrix = dual.laplacian(conductivity=np.nanmean(sides, axis=1)).tocsr()
    # The lake is what the outline goes around, apart from its longest loop.
    at_lake = np.concatenate(mesh.boundary_loops()[1:])
    recharge = 0.002 * dual.areas
    for place, rate in WELLS:
        recharge[np.flatnonzero((mesh.vertices == place).all(axis=1))] -= rate
    free = np.setdiff1d(np.arange(len(mesh.vertices)), at_lake)
    heads = np.zeros(len(mesh.vertices))
    heads[free] = spsolve(matrix[free][:, free].tocsc(), recharge[free])
    return heads


def main(folder: Path) -> None:
    """Meshes, solves, draws."""
    soils = catchment()
    mesh = mesh_of(soils)
    print(repr(mesh), mesh.dual(), sep="\n")
    heads = heads_of(mesh, soils)
    cells = mesh.dual().to_geopandas(crs=soils.crs)
    cells["head"] = heads
    # The balance: what is recharged and not pumped flows into the lake.
    print(f"heads from {heads.min():.2f} to {heads.max():.2f} m in {len(cells)} cells")

    figure, axes = plt.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    soils.plot("soil", ax=axes[0], legend=True, cmap="Pastel1", edgecolor="black")
    axes[0].plot(*np.transpose([place for place, _ in WELLS]), "v", color="black")
    mesh.plot(axes[1])
    drawn = mesh.dual().plot(axes[2], color=heads, cmap="viridis", linewidths=0.1)
    figure.colorbar(drawn.collections[0], ax=axes[2], label="head, m")
    for ax, title in zip(axes, ("polygons", "mesh, by smallest angle", "heads on Voronoi cells"), strict=True):
        ax.set_title(title)
        ax.set_axis_off()
    figure.savefig(folder / "python-groundwater.png", dpi=60)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
