"""What the tests share."""

import pathlib

import numpy as np
import pytest

FIXTURES = pathlib.Path(__file__).resolve().parents[2] / "fixtures"


@pytest.fixture
def square():
    """A square with a square hole: points, segments, holes."""
    corners = [(0, 0), (4, 0), (4, 4), (0, 4), (1, 1), (2, 1), (2, 2), (1, 2)]
    sides = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]
    return corners, sides, [(1.5, 1.5)]


@pytest.fixture
def points():
    """Sixty points in the unit square."""
    return np.random.default_rng(7).random((60, 2))
