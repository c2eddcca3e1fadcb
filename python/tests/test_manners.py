"""Threads, signals, progress, exceptions, and whatever comes in."""

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

import hexdel

#: Examples of each property: many more with HEXDEL_EXAMPLES.
EXAMPLES = int(os.environ.get("HEXDEL_EXAMPLES", "60"))
MANY = settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck))


def long_work():
    return hexdel.mesh(np.random.default_rng(1).random((100_000, 2)), threads=1)


def test_other_threads_run_while_a_mesh_is_made():
    turns, done = 0, threading.Event()

    def work():
        hexdel.mesh(np.random.default_rng(1).random((2000, 2)), method="templates", threads=1)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        turns += 1
        time.sleep(0.001)
    thread.join()
    assert turns > 20


def test_threads_may_mesh_at_once(points):
    made = [None] * 4

    def work(i):
        made[i] = hexdel.mesh(points)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(mesh == made[0] for mesh in made)


@pytest.fixture
def ctrl_c_raises():
    """Python's own handler: a process that was started in the background ignores the signal."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
@pytest.mark.parametrize("after", [0.1, 0.7])
@pytest.mark.usefixtures("ctrl_c_raises")
def test_ctrl_c_stops_the_work(after):
    sent = []

    def interrupt():
        time.sleep(after)
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        long_work()
    took = time.perf_counter() - sent[0]
    thread.join()
    # A machine under load may take longer than the 0.1 s of one that is not.
    assert took < 2 and threading.active_count() == 1
    # The next call is as good as any.
    assert hexdel.mesh([(0, 0), (1, 0)]).holds


def test_progress_is_told_and_may_stop_the_work():
    told = []
    hexdel.mesh(np.random.default_rng(1).random((3000, 2)), method="templates", progress=lambda *a: told.append(a))
    assert told and {phase for phase, _, _ in told} <= {"refine", "extract", "optimize", "certify"}
    assert told[-1][0] == "certify" and told[-1][1] == told[-1][2]

    class Enough(Exception):
        pass

    def stop(phase, done, total):
        raise Enough

    with pytest.raises(Enough):
        hexdel.mesh(np.random.default_rng(1).random((3000, 2)), progress=stop)
    with pytest.raises(TypeError):
        hexdel.mesh([(0, 0)], progress=lambda: None)
    with pytest.raises(hexdel.OptionError, match="progress must be"):
        hexdel.mesh([(0, 0)], progress=3)


def test_progress_as_a_bar(capfd):
    hexdel.mesh(np.random.default_rng(1).random((500, 2)), method="templates", progress=True)
    assert "certify" in capfd.readouterr().err


def in_child(points):
    return hexdel.mesh(points), hexdel._options.thread_count()


@pytest.mark.parametrize("method", [m for m in ("fork", "spawn") if m in multiprocessing.get_all_start_methods()])
def test_children_of_multiprocessing(method, points):
    here = hexdel.mesh(points)  # the threads of this process are running now
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # fork with threads: what is tested
        with multiprocessing.get_context(method).Pool(2) as pool:
            made = pool.map_async(in_child, [points] * 4).get(timeout=120)
    assert all(mesh == here and threads == 1 for mesh, threads in made)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_a_plain_fork_does_not_hang(points):
    code = (
        "import os, hexdel, warnings\n"
        "warnings.simplefilter('ignore')\n"
        "hexdel.mesh([(0, 0), (1, 0)])\n"
        "child = os.fork()\n"
        "if child == 0:\n"
        "    os._exit(7 if hexdel.mesh([(0, 0), (1, 0)]).holds else 8)\n"
        "print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))\n"
    )
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=120, check=True)
    assert out.stdout.strip() == "7"


def test_exceptions_say_the_way_out():
    for call, kind, words in [
        (lambda: hexdel.mesh([]), "empty", "pass at least one point"),
        (lambda: hexdel.mesh([(0, 0), (np.inf, 0)]), "not_finite", "numpy.isfinite"),
        (lambda: hexdel.mesh([(1, 0), (1 + 1e-15, 0), (2, 0)]), "too_close", "repair="),
        (lambda: hexdel.mesh([(0, 0)], method="tempaltes"), "option", "did you mean 'templates'"),
        (lambda: hexdel.mesh([(0, 0)], min_angle=61), "option", "between 0 and 60"),
        (lambda: hexdel.mesh([(0, 0)], method="templates", min_angle=46), "bounds", "compact"),
        (lambda: hexdel.mesh([(0, 0)], threads=0), "option", "between 1 and 1024"),
        (lambda: hexdel.mesh([(0, 0)], budget=-1), "option", "at least 0"),
        (lambda: hexdel.mesh([(0, 0)], max_area="big"), "option", "positive"),
        (lambda: hexdel.mesh([(0, 0), (1, 0)], domain=0.5), "domain", "radius="),
        (lambda: hexdel.mesh(np.zeros((2, 5))), "shape", "points.T"),
        (lambda: hexdel.mesh_pslg([(0, 0), (1, 0)], [(0, 2)]), "segment_end", "count from 0"),
        (lambda: hexdel.mesh_pslg([(0, 0), (1, 0)], [(0, 1)]), "nothing_enclosed", "domain='hull'"),
        (lambda: hexdel.mesh_pslg([(0, 0), (1, 1), (3, 3)], [(0, 1)], domain="hull"), "flat_hull", "domain='box'"),
        (lambda: hexdel.mesh_pslg([(0, 0), (1, 0)], [(0, 1)], markers=[1, 2]), "length", "one entry for each"),
        (lambda: hexdel.mesh_pslg([(0, 0), (1, 0)], [(0, 0.5)]), "dtype", "for an index"),
    ]:
        with pytest.raises(hexdel.HexdelError) as caught:
            call()
        assert caught.value.kind == kind, (kind, caught.value)
        assert words in str(caught.value), (words, str(caught.value))
        again = pickle.loads(pickle.dumps(caught.value))
        assert type(again) is type(caught.value) and str(again) == str(caught.value)
        assert (again.kind, again.index, again.location) == (kind, caught.value.index, caught.value.location)


def test_unknown_options_are_python_s_own_error():
    with pytest.raises(TypeError, match="min_angel"):
        hexdel.mesh([(0, 0)], min_angel=30)


def test_missing_packages_are_named(monkeypatch, points):
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(hexdel.MissingPackageError, match="pip install meshio") as caught:
        hexdel.mesh(points).to_meshio()
    assert isinstance(caught.value, ImportError)


def attempt(call):
    """Whatever comes in, a result or an exception of hexdel comes out."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return call()
        except hexdel.HexdelError as error:
            assert error.kind not in ("internal", "other"), error
            return None


numbers = st.floats(-4, 4).map(lambda x: round(x, 2)) | st.sampled_from(
    [0.0, -0.0, 1e-300, 1e300, -1e155, np.nan, np.inf, -np.inf, 1e-12, 1 + 1e-15, 2**53]
)
anything = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | numbers
    | st.text(max_size=3)
    | st.binary(max_size=3)
    | st.complex_numbers(),
    lambda inner: (
        st.lists(inner, max_size=4) | st.tuples(inner, inner) | st.dictionaries(st.text(max_size=2), inner, max_size=2)
    ),
    max_leaves=8,
)
arrays = npst.arrays(
    npst.scalar_dtypes() | st.just(np.dtype(object)),
    npst.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4),
)


@MANY
@given(st.lists(st.tuples(numbers, numbers), max_size=8))
def test_any_points(points):
    mesh = attempt(lambda: hexdel.mesh(points, effort="fast"))
    if mesh is not None:
        assert mesh.holds and (mesh.vertices[mesh.vertex_of_input] == np.array(points)).all()


@MANY
@given(
    st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6)), max_size=8),
    st.lists(st.tuples(st.integers(-1, 9), st.integers(-1, 9)), max_size=8),
    st.lists(st.tuples(numbers, numbers), max_size=2),
    st.sampled_from([None, True, 0.5]),
    st.sampled_from([None, "hull", "box", "hexagon"]),
)
def test_any_graph(points, segments, holes, repair, domain):
    mesh = attempt(
        lambda: hexdel.mesh_pslg(points, segments, holes=holes, repair=repair, domain=domain, effort="fast", budget=2)
    )
    if mesh is not None:
        found = hexdel.check(mesh.vertices, mesh.triangles, delaunay=mesh.certificate.delaunay)
        assert found.not_counter_clockwise == 0 and found.malformed == 0


@MANY
@given(anything | arrays, anything | arrays)
def test_anything_at_all(one, other):
    attempt(lambda: hexdel.mesh(one))
    attempt(lambda: hexdel.mesh_pslg(one, other))
    attempt(lambda: hexdel.mesh_pslg([(0, 0), (1, 0), (0, 1)], [(0, 1), (1, 2), (2, 0)], holes=one, regions=other))
    attempt(lambda: hexdel.check(one, other))
    attempt(lambda: hexdel.Mesh(one, other).certificate)
    attempt(lambda: hexdel.mesh_polygons(one))
    attempt(lambda: hexdel.Session(one, other))
    attempt(lambda: hexdel.Session(center=(0, 0), radius=1).remove(one))
    attempt(lambda: hexdel.triangulate({"vertices": one, "segments": other}, "p"))


@MANY
@given(anything, anything)
def test_any_options(one, other):
    points = [(0, 0), (1, 0), (0.3, 0.8)]
    for name in (
        "size",
        "method",
        "effort",
        "domain",
        "min_angle",
        "max_angle",
        "budget",
        "threads",
        "repair",
        "max_area",
    ):
        if name in ("size", "max_area", "domain") and isinstance(one, (int, float)) and 0 < abs(one) < 0.05:
            continue  # honest work, but much of it
        if name == "threads" and isinstance(one, int) and one > 8:
            continue
        attempt(lambda name=name: hexdel.mesh(points, **{name: one}))
    if not callable(one):
        attempt(lambda: hexdel.mesh(points, size=[one, other]) if not _small(one) and not _small(other) else None)
    attempt(lambda: hexdel.triangulate({"vertices": points}, one))
    attempt(lambda: hexdel.check(points, [(0, 1, 2)], min_angle=one, max_angle=other))


def _small(value):
    return isinstance(value, (int, float)) and 0 < abs(value) < 0.05


@MANY
@given(npst.arrays(np.float64, st.tuples(st.integers(1, 6), st.just(2)), elements=st.floats(-1, 1)), st.data())
def test_layout_in_memory_does_not_matter(points, data):
    points = np.round(points, 3)
    layouts = [
        np.asfortranarray(points),
        np.repeat(points, 2, axis=0)[::2],
        points[::-1][::-1],
        np.concatenate((points, points), axis=1)[:, :2],
        points.tolist(),
        points.astype(">f8"),
        points.astype(object),
    ]
    expected = attempt(lambda: hexdel.mesh(points, effort="fast"))
    other = attempt(lambda: hexdel.mesh(data.draw(st.sampled_from(layouts)), effort="fast"))
    assert expected == other
    frozen = points.copy()
    frozen.flags.writeable = False
    assert attempt(lambda: hexdel.mesh(frozen, effort="fast")) == expected


@MANY
@given(
    st.booleans(),
    st.lists(
        st.tuples(st.sampled_from(["insert", "remove", "undo", "refine"]), numbers, numbers), min_size=1, max_size=8
    ),
)
def test_any_session(follows, steps):
    session = hexdel.Session.begin((0, 0))[0] if follows else hexdel.Session(center=(0, 0), radius=2)
    for step, x, y in steps:
        before = session.mesh() if step != "undo" else None
        made = attempt(
            {
                "insert": lambda: session.insert((x, y)),
                "remove": lambda: session.remove([int(x) if np.isfinite(x) and abs(x) < 9 else 0]),
                "undo": lambda: session.undo(),
                "refine": lambda: session.refine((0, 0), (0.5, 0.5)),
            }[step]
        )
        if made is None and before is not None:
            assert session.mesh() == before
        assert session.mesh().holds


def test_memory_that_cannot_be_had_is_an_error():
    with pytest.raises((hexdel.HexdelError, MemoryError)):
        hexdel.generate("uniform", 2**40)
