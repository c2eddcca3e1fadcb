"""The gallery's pictures, made from Python: docs/gallery.md has those that the program makes.

Each kind of input is meshed by the templates and by the compact method; triangles are
coloured by their smallest angle, and a histogram counts all angles. Letters have segments,
and with them one method.

    python gallery.py [folder for the pictures]
"""

from __future__ import annotations

import pathlib
import sys
from typing import Any, Literal

import matplotlib
import numpy as np
from numpy.typing import NDArray

import hexdel

FIXTURES = pathlib.Path(__file__).resolve().parents[2] / "fixtures"

METHODS: tuple[Literal["templates", "compact"], ...] = ("templates", "compact")

NAMES = ("two-close", "line", "plane", "letters", "uniform-1000", "uniform-2000")


def read(file: str) -> hexdel.Graph:
    """Points or a graph of the project's fixtures."""
    graph = hexdel.read(FIXTURES / file)
    assert isinstance(graph, hexdel.Graph)
    return graph


def meshes(name: str) -> dict[str, hexdel.Mesh]:
    """The meshes of one kind of input, by the name of the method."""
    if name == "letters":
        return {"compact": hexdel.mesh_pslg(**read("graphs/letters.poly"))}
    files = {"two-close": "two_close", "line": "line100", "plane": "plane100"}
    if name in files:
        points = read(f"points/{files[name]}.node").points
    else:
        points = np.random.default_rng(1).random((int(name.split("-")[1]), 2))
    domain = 1.0 if name == "two-close" else None
    return {method: hexdel.mesh(points, method=method, domain=domain) for method in METHODS}


def angles(mesh: hexdel.Mesh) -> NDArray[np.float64]:
    """All angles, degrees."""
    quality = mesh.quality()
    middle = 180 - quality.min_angle - quality.max_angle
    return np.concatenate([quality.min_angle, middle, quality.max_angle])


def draw(mesh: hexdel.Mesh, title: str) -> Any:
    """A figure of the mesh and the histogram of its angles."""
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 6), width_ratios=[3, 1], layout="constrained")
    mesh.plot(left)
    left.set_axis_off()
    certificate = mesh.certificate
    span = f"{certificate.min_angle_deg:.2f} to {certificate.max_angle_deg:.2f} degrees"
    left.set_title(f"{title}: {len(mesh.triangles)} triangles, {span}")
    right.hist(angles(mesh), bins=np.arange(0, 121, 2), orientation="horizontal", color="tab:blue")
    right.set_ylabel("angle, degrees")
    right.set_xlabel("angles")
    return figure


def main(folder: pathlib.Path, names: tuple[str, ...] = NAMES) -> None:
    """Writes the pictures and says what they show."""
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        for method, mesh in meshes(name).items():
            assert mesh.holds
            file = folder / f"{name}-{method}.png"
            figure = draw(mesh, f"{name}, {method}")
            figure.savefig(file, dpi=100)
            plt.close(figure)
            print(f"{file}: {len(mesh.triangles)} triangles")


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out"))
