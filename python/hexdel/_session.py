"""A mesh that points are put into and taken out of."""

from __future__ import annotations

import warnings
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays, _calls, _hexdel, _options
from ._arrays import Floats, frozen
from ._errors import HexdelWarning, OptionError, SessionError
from ._mesh import Mesh
from ._options import DomainName, Effort, Method
from ._size import SizeLike

Numbers = NDArray[np.int64]


class Change(NamedTuple):
    """What a call did. Vertices and triangles are named by serial numbers.

    Attributes
    ----------
    points : ndarray of int64
        Numbers of the points put in, in the order given.
    vertices_removed, triangles_removed : ndarray of int64
    vertices_added, vertices_moved : tuple of ndarray
        Serial numbers, and places of shape (k, 2).
    triangles_added : tuple of ndarray
        Serial numbers, and corners as serial numbers of vertices, shape (k, 3).
    remeshed : bool
        Whether the whole was meshed anew.
    domain : tuple or None
        Centre and circumradius of the domain, if the call has changed it.
    """

    points: Numbers
    vertices_removed: Numbers
    vertices_added: tuple[Numbers, Floats]
    vertices_moved: tuple[Numbers, Floats]
    triangles_removed: Numbers
    triangles_added: tuple[Numbers, Numbers]
    remeshed: bool
    domain: tuple[tuple[float, float], float] | None

    def __repr__(self) -> str:
        return (
            f"<hexdel.Change: {len(self.points)} points, {len(self.triangles_removed)} triangles removed, "
            f"{len(self.triangles_added[0])} added{', all meshed anew' if self.remeshed else ''}>"
        )


class Session:
    """A mesh that changes where points come and go, and nowhere else.

    After every call the mesh is Delaunay and within its bounds, every point a vertex, bit
    for bit; a call that fails, or is interrupted, changes nothing.

    Parameters
    ----------
    points : array_like, shape (n, 2), optional
        Points to begin with; they get the numbers 0 to n - 1.
    segments : array_like of int, shape (s, 2), optional
        Segments that stay unions of edges.
    holes, regions, markers : optional
        As of `mesh_pslg`.
    center, radius : optional
        The hexagonal domain of a session that begins without points.
    method, effort, min_angle, max_angle, size, gradation, max_area, domain, threads : optional
        As of `mesh_pslg`. Sessions of 'templates' know no segments.

    Warns
    -----
    HexdelWarning
        Holes and regions that have no effect.

    See Also
    --------
    Session.begin : a session whose domain grows by itself.

    Examples
    --------
    >>> import hexdel
    >>> session = hexdel.Session(center=(0, 0), radius=1)
    >>> first = session.insert([(0.1, 0.2), (0.1, 0.25)])
    >>> first.points.tolist(), session.mesh().holds
    ([0, 1], True)
    >>> change = session.remove([0])
    >>> len(session), session.undo().remeshed in (True, False), len(session)
    (1, True, 2)
    """

    def __init__(
        self,
        points: ArrayLike | None = None,
        segments: ArrayLike | None = None,
        *,
        holes: ArrayLike | None = None,
        regions: ArrayLike | None = None,
        markers: ArrayLike | None = None,
        center: ArrayLike | None = None,
        radius: float | None = None,
        method: Method | None = None,
        effort: Effort | None = None,
        min_angle: float | None = None,
        max_angle: float | None = None,
        size: SizeLike | None = None,
        gradation: float | None = None,
        max_area: float | None = None,
        domain: DomainName | None = None,
        threads: int | None = None,
    ) -> None:
        places = _arrays.points(points)
        raw = _options.raw(
            places,
            method=method,
            effort=effort,
            min_angle=min_angle,
            max_angle=max_angle,
            size=size,
            gradation=gradation,
            max_area=max_area,
            domain=domain,
            threads=threads,
        )
        if len(places) == 0 and segments is None:
            if center is None or radius is None:
                raise OptionError("a session needs points, or a center and a radius to begin without", kind="option")
            middle = _arrays.rows(np.atleast_2d(_arrays.floats(center, "center")), 2, "center")[0]
            length = _options.number(radius, "radius", least=0.0, open_=True)
            if any(raw[name] is not None for name in ("min_angle", "max_angle", "max_area", "domain")):
                raise OptionError("a session without points takes no bounds, areas or domain", kind="option")
            at = (float(middle[0]), float(middle[1]))
            self._raw = _hexdel.RawSession.empty(at, float(length or 0.0), raw)
        else:
            if center is not None:
                raise OptionError("a center is for sessions that begin without points", kind="option")
            raw["radius"] = _options.number(radius, "radius", least=0.0, open_=True)
            graph = _calls._graph(places, segments, holes, regions, markers)
            self._raw = _hexdel.RawSession.of_graph(graph, raw)
        notes = [*_unused(segments, holes, regions), *self._raw.warnings()]
        if notes:
            warnings.warn("; ".join(notes), HexdelWarning, stacklevel=2)

    @classmethod
    def begin(
        cls,
        points: ArrayLike,
        *,
        method: Method | None = None,
        effort: Effort | None = None,
        min_angle: float | None = None,
        max_angle: float | None = None,
        size: SizeLike | None = None,
        gradation: float | None = None,
        threads: int | None = None,
    ) -> tuple[Session, Change]:
        """A session in a hexagon that follows its points: it grows for those outside of it.

        Parameters
        ----------
        points : array_like, shape (n, 2) or (2,)
            Points to begin with, one at least; they get the numbers 0 to n - 1.
        method, effort, min_angle, max_angle, size, gradation, threads : optional
            As of `mesh`.

        Returns
        -------
        Session
        Change
            The whole mesh, as added.

        Examples
        --------
        >>> import hexdel
        >>> session, first = hexdel.Session.begin([(5, 5)])
        >>> first.points.tolist(), len(first.triangles_added[0]) == len(session.mesh())
        ([0], True)
        >>> change = session.insert((500, 5))
        >>> change.remeshed, change.domain[1] > 495, session.mesh().holds
        (True, True, True)
        """
        places = _rows(points)
        raw = _options.raw(
            places,
            method=method,
            effort=effort,
            min_angle=min_angle,
            max_angle=max_angle,
            size=size,
            gradation=gradation,
            threads=threads,
        )
        session, change = _hexdel.RawSession.begin(places, raw)
        return cls._of(session), _changed(change)

    @classmethod
    def loads(cls, text: str, *, threads: int | None = None) -> Session:
        """The session in a text that `dumps` made; certified anew.

        Raises
        ------
        FileError
            The text is no session.
        """
        if not isinstance(text, str):
            raise SessionError(f"a saved session is a text, got {type(text).__name__}", kind="session")
        return cls._of(_hexdel.RawSession.of_text(text, _options.thread_count(threads)))

    @classmethod
    def _of(cls, raw: _hexdel.RawSession) -> Session:
        session = cls.__new__(cls)
        session._raw = raw
        return session

    def dumps(self) -> str:
        """The session as text. What has been done cannot be undone in what is read back.

        Raises
        ------
        OptionError
            The size is a callable.
        """
        return self._raw.text()

    def insert(self, points: ArrayLike) -> Change:
        """Puts points in, all or none.

        Parameters
        ----------
        points : array_like, shape (n, 2) or (2,)

        Returns
        -------
        Change

        Raises
        ------
        SessionError, InputError
            A point outside of a domain that does not grow, there already, or too close
            to another.
        """
        return _changed(self._raw.insert(_rows(points)))

    def remove(self, numbers: ArrayLike) -> Change:
        """Takes points out by their numbers, all or none."""
        given = _arrays.floats(numbers, "numbers")
        rows = _arrays.indices(given.reshape(-1, 1) if given.ndim < 2 else given, 1, "numbers", "point")
        return _changed(self._raw.remove(rows[:, 0].astype(np.uint64)))

    def set_size(self, size: SizeLike | None, *, gradation: float | None = None) -> Change:
        """Wants edges to be as short as a size says; None lifts the limit."""
        _, places = self._raw.points()
        return _changed(self._raw.set_size(_options.raw(places, size=size, gradation=gradation)))

    def refine(self, low: ArrayLike, high: ArrayLike, halvings: int = 1) -> Change:
        """Halves the longest edge in a box between two corners, so many times."""
        corners = _arrays.rows(np.stack([_arrays.floats(low, "low"), _arrays.floats(high, "high")]), 2, "corners")
        times = int(_options.number(halvings, "halvings", least=0.0, most=60.0) or 0)
        a, b = ((float(x), float(y)) for x, y in corners)
        return _changed(self._raw.refine_box(a, b, times))

    def grow(self) -> Change:
        """Doubles the radius of the domain."""
        return _changed(self._raw.grow())

    def renew(self) -> Change:
        """Meshes all points anew, as if they had come at once."""
        return _changed(self._raw.renew())

    def undo(self) -> Change:
        """Takes the last call back; 256 are remembered."""
        return _changed(self._raw.undo())

    def mesh(self) -> Mesh:
        """The mesh as it stands, with its certificate.

        The serial numbers of its vertices and triangles are in `serials`.
        """
        return self._mesh()[0]

    def serials(self) -> tuple[Numbers, Numbers]:
        """Serial numbers of the vertices and triangles of `mesh`."""
        return self._mesh()[1]

    def _mesh(self) -> tuple[Mesh, tuple[Numbers, Numbers]]:
        data = self._raw.mesh()
        serials = (frozen(data.pop("vertex_serials")), frozen(data.pop("triangle_serials")))
        data["method"] = self._raw.method()
        return Mesh._of(data), serials

    @property
    def points(self) -> tuple[Numbers, Floats]:
        """Numbers and places of the points that are there."""
        numbers, places = self._raw.points()
        return frozen(numbers), frozen(places)

    @property
    def domain(self) -> tuple[tuple[float, float], float]:
        """Centre and circumradius of the domain."""
        x, y, radius = self._raw.domain()
        return (x, y), radius

    def __len__(self) -> int:
        """The number of points."""
        return self._raw.counts()[0]

    def __repr__(self) -> str:
        points, vertices, triangles = self._raw.counts()
        return f"<hexdel.Session: {points} points, {vertices} vertices, {triangles} triangles>"

    def __copy__(self) -> Session:
        return self._of(self._raw.copy())

    def __deepcopy__(self, memo: dict[int, Any]) -> Session:
        return self.__copy__()

    def __reduce__(self) -> tuple[Any, ...]:
        return Session.loads, (self.dumps(),)


def _rows(points: ArrayLike) -> Floats:
    """Points, or one point."""
    places = _arrays.floats(points, "points")
    return _arrays.points(places[None] if places.shape == (2,) else places)


def _unused(segments: Any, holes: Any, regions: Any) -> list[str]:
    """What has no effect where there are no segments, in words."""
    if segments is not None and np.size(segments):
        return []
    given = [name for name, value in (("holes", holes), ("regions", regions)) if value is not None and np.size(value)]
    return [f"{' and '.join(given)} have no effect in a session without segments"] if given else []


def _changed(raw: dict[str, Any]) -> Change:
    return Change(**{name: _read_only(value) for name, value in raw.items()})


def _read_only(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(_read_only(part) for part in value)
    return frozen(value) if isinstance(value, np.ndarray) else value
