"""Sessions."""

import copy
import pickle

import numpy as np
import pytest

import hexdel


def test_points_come_and_go(points):
    session = hexdel.Session(points[:30])
    change = session.insert(points[30:35])
    assert change.points.tolist() == [30, 31, 32, 33, 34] and len(session) == 35
    mesh = session.mesh()
    assert mesh.holds and (mesh.vertices[mesh.vertex_of_input] == points[:35]).all()
    session.remove([0, 34])
    numbers, places = session.points
    assert numbers.tolist() == list(range(1, 34)) and (places == points[1:34]).all()
    assert session.mesh().vertex_of_input[0] == -1
    session.undo()
    assert session.mesh() == mesh


def test_changes_keep_a_copy_up_to_date(points):
    session = hexdel.Session(points[:20])

    def copied():
        mesh, (vertices, triangles) = session._mesh()
        places = {int(s): tuple(p) for s, p in zip(vertices, mesh.vertices.tolist())}
        corners = {int(s): frozenset(int(vertices[v]) for v in t) for s, t in zip(triangles, mesh.triangles)}
        return places, corners

    places, corners = copied()
    for point in points[20:30]:
        change = session.insert(point)
        for serial in change.vertices_removed.tolist():
            del places[serial]
        for serial in change.triangles_removed.tolist():
            del corners[serial]
        for serials, new in (change.vertices_added, change.vertices_moved):
            places.update(zip(serials.tolist(), map(tuple, new.tolist())))
        serials, new = change.triangles_added
        corners.update(zip(serials.tolist(), (frozenset(t) for t in new.tolist())))
        assert (places, corners) == copied()


def test_segments_stay(square):
    corners, sides, holes = square
    session = hexdel.Session(corners, sides, holes=holes, regions=[(0.5, 0.5, 7)])
    session.insert([(3, 3), (0.5, 2.0)])
    mesh = session.mesh()
    assert mesh.holds and mesh.quality().area.sum() == pytest.approx(15)
    assert set(mesh.segment_of_edge[mesh.segment_of_edge >= 0].tolist()) == set(range(8))
    assert (mesh.regions == 7).all()
    with pytest.raises(hexdel.HexdelError) as caught:
        session.insert((1.5, 1.5))
    assert caught.value.kind == "outside"
    with pytest.raises(hexdel.HexdelError) as caught:
        session.remove([0])
    assert caught.value.kind == "segment_end"


def test_sizes_and_refinement(points):
    session = hexdel.Session(points[:10], method="compact")
    before = len(session.mesh())
    session.set_size(lambda x, y: 0.1 + 0 * x)
    fine = session.mesh()
    assert len(fine) > 2 * before
    with pytest.raises(hexdel.OptionError):
        session.dumps()
    session.undo()
    session.set_size(0.2)
    session.refine((0, 0), (0.2, 0.2), 2)
    assert session.mesh().holds

    class Own(Exception):
        pass

    def broken(x, y):
        raise Own

    before = session.mesh()
    with pytest.raises(Own):
        session.set_size(broken)
    assert session.mesh() == before


def test_saving_copying_and_the_rest(points):
    session = hexdel.Session(points[:15], effort="fast")
    again = hexdel.Session.loads(session.dumps())
    assert again.mesh() == session.mesh() == pickle.loads(pickle.dumps(session)).mesh()
    other = copy.copy(session)
    other.insert(points[20])
    assert len(other) == 16 and len(session) == 15
    (x, y), radius = session.domain
    session.grow()
    assert session.domain[1] == pytest.approx(2 * radius)
    session.renew()
    assert session.mesh().holds and "15 points" in repr(session)
    with pytest.raises(hexdel.FileError):
        hexdel.Session.loads("(no session)")
    with pytest.raises(hexdel.OptionError, match="center"):
        hexdel.Session()


def test_templates(points):
    session = hexdel.Session(points[:10], method="templates")
    session.insert(points[10])
    mesh = session.mesh()
    assert mesh.holds and mesh.method == "templates" and np.isfinite(mesh.vertices).all()


@pytest.mark.parametrize("method", ["compact", "templates"])
def test_a_domain_follows_its_points(points, method):
    session, first = hexdel.Session.begin(points[:10], method=method)
    assert first.points.tolist() == list(range(10)) and first.domain == session.domain
    assert len(first.triangles_added[0]) == len(session.mesh()) and len(first.triangles_removed) == 0
    inside = session.insert(points[:10].mean(axis=0))
    assert inside.domain is None
    before = session.mesh()
    far = session.insert((40.0, -30.0))
    assert far.remeshed and far.domain == session.domain and far.domain[1] > 49
    mesh = session.mesh()
    assert mesh.holds and (mesh.vertices[mesh.vertex_of_input[11]] == (40.0, -30.0)).all()
    assert session.undo().domain == session.domain == first.domain and session.mesh() == before
    again = hexdel.Session.loads(session.dumps())
    assert again.insert((40.0, -30.0)).domain[1] == far.domain[1]


def test_a_domain_that_was_asked_for_does_not_follow():
    session = hexdel.Session(center=(0, 0), radius=1)
    with pytest.raises(hexdel.SessionError, match="does not grow by itself"):
        session.insert((5, 5))
    with pytest.raises(hexdel.HexdelError):
        hexdel.Session.begin([])
    one, _ = hexdel.Session.begin((3, 4))
    assert len(one) == 1


def test_a_callable_size_is_asked_for_wherever_the_domain_goes():
    places = 0

    def wanted_at(x, y):
        nonlocal places
        places += len(x)
        return 200.0 + 0.5 * np.abs(x - 5000.0)

    session, _ = hexdel.Session.begin([(0, 0), (1, 0)], size=wanted_at)
    session.insert((5000.0, 1.0))
    mesh = session.mesh()
    # A few tiles of a thousand places for each doubling of the domain.
    assert places < 500_000
    ends = mesh.vertices[mesh.edges]
    wanted = 200.0 + 0.5 * np.abs(ends[..., 0] - 5000.0)
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    assert (lengths <= 1.1 * wanted.min(axis=1)).all() and mesh.vertices[:, 0].max() > 5000.0


def test_what_has_no_effect_is_named(square, points):
    corners, sides, holes = square
    with pytest.warns(hexdel.HexdelWarning, match="hole 1 at .* has no effect"):
        hexdel.Session(corners, sides, holes=[*holes, (9.0, 9.0)])
    with pytest.warns(hexdel.HexdelWarning, match="holes and regions have no effect in a session without segments"):
        hexdel.Session(points[:5], holes=[(0.5, 0.5)], regions=[(0.2, 0.2)])
