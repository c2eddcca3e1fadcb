"""Edges, neighbours and the boundary of triangles, from their indices alone."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._arrays import Ints


class Topology(NamedTuple):
    """What follows from indices."""

    #: Every edge once, the lower index first, sorted.
    edges: Ints
    #: For each triangle and corner the triangle across the edge opposite, or -1.
    neighbors: Ints
    #: Edges that only one triangle has, with it on their left, sorted.
    boundary: Ints


def topology(triangles: NDArray[Any], vertices: int) -> Topology:
    """Edges and what lies on their sides, in the time that sorting them takes."""
    corners = triangles.astype(np.int64, copy=False)
    start, end = corners[:, (1, 2, 0)].ravel(), corners[:, (2, 0, 1)].ravel()
    key = np.minimum(start, end) * vertices + np.maximum(start, end)
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    same = ordered[1:] == ordered[:-1]
    first = np.flatnonzero(np.concatenate(([True], ~same))) if len(key) else np.zeros(0, np.int64)
    neighbors = np.full(len(key), -1, np.int32)
    left, right = order[:-1][same], order[1:][same]
    neighbors[left], neighbors[right] = right // 3, left // 3
    counts = np.diff(np.append(first, len(key)))
    alone = order[first[counts == 1]]
    alone = alone[np.lexsort((end[alone], start[alone]))]
    unique = ordered[first]
    # Without vertices there are no edges to divide.
    edges = np.stack(np.divmod(unique, max(vertices, 1)), axis=1)
    boundary = np.stack((start[alone], end[alone]), axis=1)
    return Topology(edges.astype(np.int32), neighbors.reshape(-1, 3), boundary.astype(np.int32))


def loops(boundary: NDArray[Any]) -> list[Ints]:
    """The closed curves of directed edges, as vertices in order; the longest first."""
    following: dict[int, list[int]] = {}
    for start, end in boundary.tolist():
        following.setdefault(start, []).append(end)
    found = []
    for start in boundary[:, 0].tolist():
        loop, at = [], start
        while following.get(at):
            loop.append(at)
            at = following[at].pop()
        if loop:
            found.append(np.array(loop, np.int32))
    return sorted(found, key=len, reverse=True)
