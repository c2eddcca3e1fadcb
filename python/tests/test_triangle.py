"""Triangle's call, key by key against the package `triangle` on its own data."""

import numpy as np
import pytest

import hexdel

triangle = pytest.importorskip("triangle", reason="the package triangle is not installed")

#: Its graphs whose segments enclose something.
GRAPHS = ["face", "la", "double_hex"]
CLOUDS = ["dots", "spiral"]


def both(name, opts, **more):
    given = {k: v for k, v in triangle.get_data(name).items() if k != "triangles"} | more
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", hexdel.HexdelWarning)
        return given, triangle.triangulate(dict(given), opts), hexdel.triangulate(dict(given), opts)


def assert_alike(given, theirs, ours):
    """The same keys, dtypes and columns, and indices that fit."""
    assert set(ours) == set(theirs)
    for key, array in theirs.items():
        assert ours[key].dtype == array.dtype, key
        assert ours[key].shape[1:] == array.shape[1:], key
        if key.split("_")[0] not in ("holes", "regions"):
            assert len(ours[key]) > 0, key
    count = len(ours["vertices"])
    for key in ("triangles", "segments", "edges"):
        if key in ours:
            assert ours[key].min() >= 0 and ours[key].max() < count, key
    n = len(given["vertices"])
    assert (ours["vertices"][:n] == theirs["vertices"][:n]).all()
    a, b, c = ours["vertices"][ours["triangles"][:, :3]].transpose(1, 0, 2)
    area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    assert (area > 0).all()
    return area


@pytest.mark.parametrize("name", GRAPHS)
@pytest.mark.parametrize("opts", ["pq", "pqeAn", "pq25", "pqB", "pqP", "pqo2", "pcq"])
def test_graphs(name, opts):
    given, theirs, ours = both(name, opts)
    area = assert_alike(given, theirs, ours)
    a, b, c = theirs["vertices"][theirs["triangles"][:, :3]].transpose(1, 0, 2)
    expected = 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum()
    assert area.sum() == pytest.approx(expected, rel=1e-9)
    if "segment_markers" in theirs:
        assert set(ours["segment_markers"].ravel()) == set(theirs["segment_markers"].ravel())
        length = [
            np.hypot(*(made["vertices"][made["segments"][:, 0]] - made["vertices"][made["segments"][:, 1]]).T)
            for made in (theirs, ours)
        ]
        for marker in np.unique(theirs["segment_markers"]):
            sums = [
                lengths[made["segment_markers"].ravel() == marker].sum()
                for lengths, made in zip(length, (theirs, ours))
            ]
            assert sums[1] == pytest.approx(sums[0], rel=1e-9), marker
    if "vertex_markers" in theirs:
        n = len(given["vertices"])
        assert (ours["vertex_markers"][:n] == theirs["vertex_markers"][:n]).all()
        assert set(np.unique(ours["vertex_markers"])) <= set(np.unique(theirs["vertex_markers"])) | {0, 1}
    if "edges" in theirs:
        inner = ours["edge_markers"].ravel() == 0
        assert set(np.unique(ours["edge_markers"])) == set(np.unique(theirs["edge_markers"]))
        assert len(ours["edges"]) == len({tuple(sorted(e)) for e in ours["edges"].tolist()}) and inner.any()
    if "neighbors" in theirs:
        for t, row in enumerate(ours["neighbors"]):
            for corner, other in enumerate(row):
                if other >= 0:
                    edge = set(np.delete(ours["triangles"][t], corner).tolist())
                    assert edge < set(ours["triangles"][other].tolist())
    if opts == "pqo2":
        corners, middles = ours["triangles"][:, :3], ours["triangles"][:, 3:]
        for i in range(3):
            ends = ours["vertices"][np.delete(corners, i, axis=1)]
            assert np.allclose(ours["vertices"][middles[:, i]], ends.mean(axis=1))
            ends = theirs["vertices"][np.delete(theirs["triangles"][:, :3], i, axis=1)]
            assert np.allclose(theirs["vertices"][theirs["triangles"][:, 3 + i]], ends.mean(axis=1))


@pytest.mark.parametrize("name", CLOUDS)
@pytest.mark.parametrize("opts", ["q", "qe", "qn", "qc"])
def test_points(name, opts):
    given, theirs, ours = both(name, opts)
    area = assert_alike(given, theirs, ours)
    assert area.sum() == pytest.approx(hull_area(given["vertices"]), rel=1e-9)


def hull_area(points):
    made = triangle.triangulate({"vertices": points}, "")
    a, b, c = made["vertices"][made["triangles"]].transpose(1, 0, 2)
    return 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]).sum()


def test_areas_and_regions():
    given, theirs, ours = both("la", "pqAa")
    assert_alike(given, theirs, ours)
    assert set(np.unique(ours["triangle_attributes"])) == set(np.unique(theirs["triangle_attributes"]))
    given, theirs, ours = both("A", "pqa0.01")
    assert assert_alike(given, theirs, ours).max() <= 0.01 * (1 + 1e-9)


def test_attributes_are_interpolated():
    def linear(p):
        return np.column_stack((2 * p[:, 0] - p[:, 1], 0 * p[:, 0] + 7.0))

    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1), (0.4, 0.3)], float)
    given = {
        "vertices": corners,
        "segments": [(0, 1), (1, 2), (2, 3), (3, 0)],
        "vertex_attributes": linear(corners),
    }
    ours, theirs = hexdel.triangulate(given, "pqa0.01"), triangle.triangulate(dict(given), "pqa0.01")
    assert_alike(given, theirs, ours)
    assert (ours["vertex_attributes"][:5] == linear(corners)).all()
    for made in (ours, theirs):
        assert np.allclose(made["vertex_attributes"], linear(made["vertices"]), atol=1e-12)


def test_bounds():
    _, _, ours = both("A", "pq34")
    mesh = hexdel.Mesh(ours["vertices"], ours["triangles"])
    assert np.sort(mesh.quality().min_angle)[3:].min() >= 20
    assert mesh.quality().max_angle.max() <= 90 + 1e-9


@pytest.mark.parametrize(
    ("opts", "words"),
    [("pY", "segments must be divided"), ("S10", "number of vertices"), ("pr", "not refined"), ("pk", "no switch"),
     ("q70", "between 0 and 60"), ("a0", "positive"), ("o3", "second order"), ("q1.2.3", "after 'q'")],
)  # fmt: skip
def test_what_is_refused(opts, words):
    with pytest.raises(hexdel.OptionError, match=words):
        hexdel.triangulate({"vertices": [(0, 0), (1, 0), (0, 1)]}, opts)


def test_keys_that_are_none_or_not_used():
    square = {"vertices": [(0, 0), (1, 0), (1, 1), (0, 1)]}
    with pytest.raises(hexdel.OptionError, match="no key 'vertexes'"):
        hexdel.triangulate({"vertexes": []})
    with pytest.warns(hexdel.HexdelWarning, match="triangles"):
        hexdel.triangulate(square | {"triangles": [(0, 1, 2)]}, "q")


def test_pictures_side_by_side():
    plt = pytest.importorskip("matplotlib.pyplot")
    given, _, ours = both("face", "pq")
    hexdel.compare(plt, given, ours, figsize=(6, 3))
    left, right = plt.gcf().axes
    assert len(right.lines) > len(left.lines) - 30
    plt.close("all")
