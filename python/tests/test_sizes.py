"""Sizes: numbers, arrays, callables, rasters."""

import threading

import numpy as np
import pytest

import hexdel


def longest(mesh, size):
    """The longest edge over what a function wants at its ends and its middle."""
    a, b = mesh.vertices[mesh.edges[:, 0]], mesh.vertices[mesh.edges[:, 1]]
    wanted = np.min([size(*p.T) * np.ones(len(p)) for p in (a, b, 0.5 * (a + b))], axis=0)
    return (np.hypot(*(b - a).T) / wanted).max()


def test_a_number():
    mesh = hexdel.mesh([(0, 0), (1, 0)], size=0.1)
    assert longest(mesh, lambda x, y: 0.1) <= 1 + 1e-8
    assert mesh.size_ratio == pytest.approx(longest(mesh, lambda x, y: 0.1))


def test_an_array_per_point():
    points = np.array([(0.0, 0.0), (1.0, 0.0), (0.5, 0.8)])
    sizes = np.array([0.02, np.inf, 0.3])
    mesh = hexdel.mesh(points, size=sizes, gradation=0.4)

    def wanted(x, y):
        return np.minimum(0.02 + 0.4 * np.hypot(x, y), 0.3 + 0.4 * np.hypot(x - 0.5, y - 0.8))

    assert longest(mesh, wanted) <= 1 + 1e-8
    assert len(mesh) > 2 * len(hexdel.mesh(points))


@pytest.mark.parametrize(
    "size",
    [
        lambda x, y: 0.03 + 0.3 * np.hypot(x - 0.3, y - 0.4),
        lambda x, y: 0.1 + 0.05 * np.sin(9 * x) * np.cos(7 * y),
        lambda x, y: 0.2,
        lambda x, y: np.where(
            (x - 0.71) ** 2 + (y - 0.71) ** 2 < 1e-4, 0.02, 0.02 + np.abs(np.hypot(x - 0.71, y - 0.71) - 0.01)
        ),
    ],
    ids=["cone", "waves", "constant", "hidden"],
)
def test_a_callable_is_kept_exactly(size):
    corners, sides = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)]
    mesh = hexdel.mesh_pslg(corners, sides, size=size)
    assert longest(mesh, size) <= 1 + 1e-8
    assert mesh.size_ratio == pytest.approx(longest(mesh, size), rel=1e-12)


def test_a_callable_is_called_with_arrays_and_seldom():
    calls = []

    def size(x, y):
        calls.append(len(x))
        assert x.shape == y.shape and x.dtype == np.float64
        return 0.1 + 0.05 * x

    mesh = hexdel.mesh([(0, 0), (1, 0), (1, 1), (0, 1)], size=size, domain="hull")
    # Some samples for each triangle, and calls by hundreds of samples.
    assert sum(calls) < 60 * len(mesh) + 40 * 1089
    assert sum(calls) > 300 * len(calls)


def test_a_callable_is_not_called_where_no_mesh_is():
    corners, sides = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)]

    def size(x, y):
        # As scipy's interpolators do, with bounds_error.
        if x.min() < 0 or x.max() > 1 or y.min() < 0 or y.max() > 1:
            raise ValueError("out of bounds")
        return 0.1 + 0.1 * x

    assert hexdel.mesh_pslg(corners, sides, size=size).size_ratio <= 1 + 1e-8
    assert hexdel.mesh(corners, size=size, domain="hull").size_ratio <= 1 + 1e-8


def test_a_size_that_jumps_is_reported_not_hidden():
    def size(x, y):
        return np.where(x < 0.5, 0.05, 0.5)

    corners, sides = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)]
    import warnings

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        mesh = hexdel.mesh_pslg(corners, sides, size=size)
    ratio = longest(mesh, size)
    assert mesh.size_ratio == pytest.approx(ratio)
    assert ratio <= 1 + 1e-8 or any("as long as the size wants" in str(w.message) for w in caught)


def test_the_same_mesh_on_any_number_of_threads():
    def size(x, y):
        return 0.1 + 0.2 * np.abs(x - y)

    points = np.random.default_rng(3).random((10, 2))
    assert hexdel.mesh(points, size=size, threads=1) == hexdel.mesh(points, size=size, threads=4)


def test_exceptions_in_a_callable_come_out():
    class Own(Exception):
        pass

    def size(x, y):
        raise Own("no")

    with pytest.raises(Own):
        hexdel.mesh([(0, 0), (1, 0)], size=size)
    for bad in (0.0, -1.0, np.nan):
        with pytest.raises(hexdel.InputError, match="must return positive") as caught:
            hexdel.mesh([(0, 0), (1, 0)], size=lambda x, y, bad=bad: np.where(x > 0.3, bad, 0.1))
        assert caught.value.kind == "callable" and caught.value.location[0] > 0.3
    with pytest.raises(hexdel.InputError, match="returned the shape"):
        hexdel.mesh([(0, 0), (1, 0)], size=lambda x, y: np.ones(3))
    with pytest.raises(hexdel.InputError):
        hexdel.mesh([(0, 0), (1, 0)], size=lambda x, y: "wide")
    with pytest.raises(TypeError):
        hexdel.mesh([(0, 0), (1, 0)], size=lambda x: x)


def test_infinite_lengths_are_no_limit():
    mesh = hexdel.mesh([(0, 0), (1, 0)], size=lambda x, y: np.full_like(x, np.inf))
    assert mesh.size_ratio < 1e-3


def test_a_raster_north_up():
    values = np.full((4, 8), 0.5)
    values[0, 0] = 0.05  # the north-western corner
    raster = hexdel.Raster(values, (0.5, 0, 0, 0, -0.5, 2))
    corners, sides = [(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 1), (1, 2), (2, 3), (3, 0)]
    mesh = hexdel.mesh_pslg(corners, sides, size=raster)
    shortest = np.hypot(*(mesh.vertices[mesh.edges[:, 0]] - mesh.vertices[mesh.edges[:, 1]]).T)
    middle = mesh.vertices[mesh.edges].mean(axis=1)
    fine = middle[shortest < 0.1]
    assert len(fine) and (fine[:, 0] < 1).all() and (fine[:, 1] > 1).all()
    assert mesh.size_ratio <= 1 + 1e-8
    # The same raster from the south, with cells twice as wide as high.
    wide = hexdel.Raster(values[::-1], (0.5, 0, 0, 0, 0.5, 0))
    assert hexdel.mesh_pslg(corners, sides, size=wide) == mesh
    assert hexdel.mesh_pslg(corners, sides, size=(values, (0.5, 0, 0, 0, -0.5, 2))) == mesh


def test_rasters_that_are_none():
    for transform, words in [
        ((1, 0.1, 0, 0, -1, 0), "rotated"),
        ((0, 0, 0, 0, -1, 0), "no area"),
        ((1, 2, 3), "six finite numbers"),
    ]:
        with pytest.raises(hexdel.OptionError, match=words):
            hexdel.mesh([(0, 0)], size=hexdel.Raster([[1.0]], transform))
    with pytest.raises(hexdel.InputError) as caught:
        hexdel.mesh([(0, 0)], size=hexdel.Raster([[1.0, -3.0]], (1, 0, 0, 0, -1, 0)))
    assert caught.value.index == (0, 1)
    values = [[1.0, -9999.0], [np.nan, 2.0]]
    assert hexdel.mesh([(0, 0), (2, -2)], size=hexdel.Raster(values, (1, 0, 0, 0, -1, 0), nodata=-9999)).holds


def test_parts_are_combined_by_the_smallest():
    region = hexdel.SizeIn([(0, 0), (0.3, 0), (0.3, 0.3), (0, 0.3)], 0.05)
    place = hexdel.SizeAt([(0.9, 0.9)], [0.03])
    parts = [region, place, lambda x, y: 0.4 - 0.2 * x, 0.35]
    corners, sides = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1), (1, 2), (2, 3), (3, 0)]
    mesh = hexdel.mesh_pslg(corners, sides, size=parts)

    def wanted(x, y):
        out = np.hypot(np.maximum(x - 0.3, 0), np.maximum(y - 0.3, 0))
        at = np.hypot(x - 0.9, y - 0.9)
        return np.min([0.05 + 0.5 * out, 0.03 + 0.5 * at, 0.4 - 0.2 * x, np.full_like(x, 0.35)], axis=0)

    assert longest(mesh, wanted) <= 1 + 1e-8


@pytest.mark.parametrize("bad", [0, -1.0, np.nan, "fine", [1.0, 2.0, 3.0], [0.1, -1.0], True, np.ones((2, 2))])
def test_what_is_no_size(bad):
    with pytest.raises(hexdel.HexdelError) as caught:
        hexdel.mesh([(0, 0), (1, 0)], size=bad)
    assert caught.value.kind in ("size", "length", "dtype", "shape")


def test_no_thread_is_left():
    hexdel.mesh([(0, 0), (1, 0)], size=lambda x, y: 0.1)
    assert threading.active_count() == 1
