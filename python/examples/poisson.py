"""Poisson's equation on a square with a slanted hole: finite volumes, and finite elements.

``-div grad u = f`` with the values of ``u = sin(2 x) cosh(y) + x y`` on the boundary. Finite
volumes take two-point fluxes between Voronoi cells, with nothing but the weights and areas
of the dual; finite elements are scikit-fem's, on the same mesh. Both converge at second order.

    python poisson.py
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import spsolve

import hexdel

Floats = NDArray[np.float64]

CORNERS = [(0, 0), (3, 0), (3, 3), (0, 3), (1.0, 1.2), (1.8, 1.0), (2.0, 1.8), (1.2, 2.0)]
SIDES = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]


def exact(p: Floats) -> Floats:
    """The solution at places of shape (n, 2)."""
    x, y = p.T
    return np.sin(2 * x) * np.cosh(y) + x * y


def source(p: Floats) -> Floats:
    """Minus its Laplacian."""
    x, y = p.T
    return 3 * np.sin(2 * x) * np.cosh(y)


def mesh_of(size: float) -> hexdel.Mesh:
    """The domain with edges of a length."""
    return hexdel.mesh_pslg(CORNERS, SIDES, holes=[(1.5, 1.5)], size=size)


def by_volumes(mesh: hexdel.Mesh) -> Floats:
    """Values at vertices, by two-point fluxes between the cells around them."""
    dual = mesh.dual()
    matrix, right = dual.laplacian().tocsr(), dual.areas * source(mesh.vertices)
    values = exact(mesh.vertices)
    inner = np.setdiff1d(np.arange(len(values)), mesh.boundary)
    outer = np.unique(mesh.boundary)
    known = matrix[inner][:, outer] @ values[outer]
    values[inner] = spsolve(matrix[inner][:, inner].tocsc(), right[inner] - known)
    return values


def by_elements(mesh: hexdel.Mesh) -> Floats:
    """Values at vertices, by linear elements of scikit-fem."""
    import skfem

    basis = skfem.Basis(mesh.to_skfem(), skfem.ElementTriP1())
    stiffness = skfem.BilinearForm(lambda u, v, w: u.grad[0] * v.grad[0] + u.grad[1] * v.grad[1])
    load = skfem.LinearForm(lambda v, w: 3 * np.sin(2 * w.x[0]) * np.cosh(w.x[1]) * v)
    values = exact(mesh.vertices)
    condensed = skfem.condense(stiffness.assemble(basis), load.assemble(basis), x=values, D=np.unique(mesh.boundary))
    return np.asarray(skfem.solve(*condensed), dtype=np.float64)


def error(mesh: hexdel.Mesh, values: Floats) -> float:
    """The root mean square over the domain."""
    difference = values - exact(mesh.vertices)
    areas = mesh.dual().areas
    return float(np.sqrt(areas @ difference**2 / areas.sum()))


def table(sizes: tuple[float, ...]) -> list[tuple[float, int, float, float]]:
    """For each size: the size, the unknowns, the errors of volumes and of elements."""
    rows = []
    for size in sizes:
        mesh = mesh_of(size)
        assert mesh.holds and (mesh.dual().weights >= 0).all()
        volumes, elements = (error(mesh, solve(mesh)) for solve in (by_volumes, by_elements))
        rows.append((size, len(mesh.vertices), volumes, elements))
    return rows


def main() -> None:
    """Prints the table."""
    print("| edge | vertices | volumes | order | elements | order |\n|---:|---:|---:|---:|---:|---:|")
    before: tuple[float, int, float, float] | None = None
    for row in table((0.4, 0.2, 0.1, 0.05)):
        orders = ["", ""]
        if before is not None:
            orders = [f"{np.log(before[i] / row[i]) / np.log(before[0] / row[0]):.2f}" for i in (2, 3)]
        print(f"| {row[0]} | {row[1]} | {row[2]:.2e} | {orders[0]} | {row[3]:.2e} | {orders[1]} |")
        before = row


if __name__ == "__main__":
    main()
