"""Exceptions and warnings, each with the way out in its text."""

from __future__ import annotations

from typing import Any

__all__ = [
    "FileError",
    "HexdelError",
    "HexdelWarning",
    "InputError",
    "InternalError",
    "MissingFileError",
    "MissingPackageError",
    "OptionError",
    "SessionError",
    "UnreachedError",
]


class HexdelWarning(UserWarning):
    """Input that was mended, not used or taken in one of several ways."""


class HexdelError(Exception):
    """Base class of every exception of hexdel.

    Attributes
    ----------
    kind : str
        What is wrong, in a word that programs can rely on: ``"empty"``,
        ``"not_finite"``, ``"too_close"``, ``"crossing"``, ``"shape"``, ...
    item : str or None
        What `index` counts: ``"point"``, ``"segment"``, ``"triangle"``, ...
    index : int, tuple of int or None
        The offending item or items, from 0 as given.
    location : tuple of float or None
        Coordinates (x, y) of the fault, in the units of the input.
    file, line : str, int or None
        The place in a file, if the input was read from one.
    mesh : Mesh or None
        The best mesh that was found, where bounds were not reached.
    hint : str or None
        What to do about it; the last part of the text.

    Examples
    --------
    >>> import hexdel
    >>> try:
    ...     hexdel.mesh([(0, 0), (1, float("nan"))])
    ... except hexdel.HexdelError as error:
    ...     print(error.kind, error.item, error.index)
    not_finite point 1
    """

    kind: str
    item: str | None
    index: int | tuple[int, ...] | None
    location: tuple[float, float] | None
    file: str | None
    line: int | None
    mesh: Any
    hint: str | None

    def __init__(self, message: str, *, kind: str = "other", **details: Any) -> None:
        index = details.get("index")
        if isinstance(index, (list, tuple)):
            index = None if len(index) == 0 else index[0] if len(index) == 1 else tuple(index)
        self._details = {**details, "kind": kind, "message": message, "index": index}
        self.kind = kind
        self.item = details.get("item") if index is not None else None
        self.index = index
        self.location = details.get("location")
        self.file = details.get("file")
        self.line = details.get("line")
        self.mesh = details.get("mesh")
        self.hint = details.get("hint")
        super().__init__(message if self.hint is None else f"{message}; {self.hint}")

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuild, (type(self), self._details)


class InputError(HexdelError, ValueError):
    """Points, segments, polygons or arrays that cannot be meshed as they are."""


class OptionError(HexdelError, ValueError):
    """An option that there is not, out of range, or of no use to the call."""


class UnreachedError(HexdelError):
    """The bounds asked for were not reached; `mesh` is the best mesh found."""


class SessionError(HexdelError, ValueError):
    """A session did not do what was asked; it is as it was."""


class FileError(HexdelError, OSError):
    """A file that could not be read or written."""


class MissingFileError(FileError, FileNotFoundError):
    """A file that is not there."""


class MissingPackageError(HexdelError, ImportError):
    """An optional package that is not installed."""


class InternalError(HexdelError, RuntimeError):
    """A defect of hexdel. Please report it, with the input."""


_CLASSES: dict[str, type[HexdelError]] = {
    "bounds": OptionError,
    "no_grading": OptionError,
    "dual_edge": OptionError,
    "option": OptionError,
    "domain": OptionError,
    "tolerance": OptionError,
    "area": OptionError,
    "size": OptionError,
    "size_unreached": OptionError,
    "threads": OptionError,
    "unreached": UnreachedError,
    "not_certified": UnreachedError,
    "internal": InternalError,
    "file": FileError,
    "missing_file": MissingFileError,
    "session": SessionError,
    "outside": SessionError,
    "no_room": SessionError,
    "unknown_point": SessionError,
    "nothing_to_undo": SessionError,
}

_HINTS: dict[str, str] = {
    "empty": "pass at least one point, an array of shape (n, 2)",
    "not_finite": "drop such points first: points[numpy.isfinite(points).all(axis=1)]",
    "out_of_range": "scale the coordinates down",
    "crossing": "pass repair=True to divide segments where they cross",
    "overlap": "pass repair=True to merge what segments share",
    "duplicate": "pass repair=True to merge them",
    "zero_length": "pass repair=True to drop it",
    "overlaps": "pass overlaps='later' to take the later polygon there",
    "no_grading": "pass min_angle of at most 43.89 and max_angle of at least 90",
    "dual_edge": "pass min_dual_edge of at most 0.32; 0.1 asks for angles of at most 84.3 degrees",
    "nothing_enclosed": "close the outline, or pass domain='hull' or domain='box'",
    "flat_hull": "pass domain='hexagon' or domain='box' to mesh the area around points in a line",
    "segment_end": "segments hold indices of points, from 0",
    "bounds": "pass min_angle of at most 43.89 and max_angle of at least 90, or method='compact'",
    "unreached": "the best mesh is the error's attribute mesh; widen the bounds, or drop the budget",
    "not_recovered": "pass repair=True, or a larger tolerance",
    "size_unreached": "ask for larger sizes there, or for wider bounds",
    "too_many": "ask for larger sizes or areas, or join what is close with repair=tolerance",
    "internal": "please report it with the input",
    "outside": "grow() the domain first",
    "unknown_point": "insert() returns the numbers of points",
}


def make(details: dict[str, Any]) -> HexdelError:
    """The exception of a fault, as the compiled half tells of it."""
    kind = details["kind"]
    details = dict(details)
    least = details.pop("least", None)
    hint = _HINTS.get(kind)
    if kind == "too_close" and least is not None:
        joined = f"repair={1.1 * least:.2g}"
        call = "" if details.get("item") == "segment" else " to mesh_pslg"
        hint = f"drop one of them, or pass {joined}{call} to join what is closer"
    elif kind == "too_many" and least is not None:
        hint = f"pass repair={1.1 * least:.2g} to join what is so close, or ask for larger sizes"
    elif kind == "domain" and least is not None:
        hint = f"pass radius={least:.6g}, or leave it out"
    if details.get("mesh") is not None:
        from ._mesh import Mesh

        details["mesh"] = Mesh(*details["mesh"])
    cls = _CLASSES.get(kind, InputError)
    message = details.pop("message")
    if hint is not None and hint.split(":")[0] in message:
        hint = None
    return cls(message, hint=hint, **details)


def _rebuild(cls: type[HexdelError], details: dict[str, Any]) -> HexdelError:
    details = dict(details)
    return cls(details.pop("message"), **details)
