"""How long edges may be: a number, a number for each point, a raster, a callable."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays
from ._arrays import Floats
from ._errors import InputError, OptionError

#: Places that a callable is asked for at once, when a mesh is held against it.
CHUNK = 65536

#: What a callable's lengths are multiplied with at first: room for interpolation.
FACTOR = 0.97

#: How much longer than wanted an edge may be, relative, as in the certificate.
SLACK = 1e-9


@dataclass(frozen=True, eq=False)
class Raster:
    """Edge lengths by the cells of a raster.

    Between the centres of cells lengths are interpolated, and no longer than the
    gradation allows next to shorter ones. Cells that are not finite, or equal to
    `nodata`, are no limit.

    Parameters
    ----------
    values : array_like, shape (rows, columns)
        Lengths in the units of the coordinates. As in images, the first row is the
        northern one where `transform` has a negative fifth number.
    transform : sequence of 6 (or 9) float
        ``(a, b, c, d, e, f)`` of ``x = a column + b row + c`` and
        ``y = d column + e row + f``, for the outer corners of cells: what rasterio
        calls ``transform``. Rotated rasters (b or d other than 0) are refused.
    nodata : float, optional
        The number in cells without a value.

    Examples
    --------
    >>> import numpy as np, hexdel
    >>> fine_in_the_west = hexdel.Raster([[0.1, 0.4]], (1, 0, 0, 0, -1, 1))
    >>> mesh = hexdel.mesh([(0, 0.5), (2, 0.5)], size=fine_in_the_west)
    >>> mesh.size_ratio <= 1 + 1e-8
    True
    """

    values: ArrayLike
    transform: Sequence[float]
    nodata: float | None = None

    def _part(self) -> tuple[Floats, float, float, float]:
        values = _arrays.floats(self.values, "the raster")
        if values.ndim != 2 or values.size == 0:
            raise InputError(f"a raster must have rows and columns, got shape {values.shape}", kind="shape")
        affine = _arrays.floats(tuple(self.transform), "transform")
        if affine.shape not in ((6,), (9,)) or not np.isfinite(affine).all():
            raise OptionError("transform must be six finite numbers (a, b, c, d, e, f)", kind="size")
        a, b, c, d, e, f = affine[:6]
        if b != 0 or d != 0:
            raise OptionError("the raster is rotated", kind="size", hint="resample it to a north-up grid")
        if a == 0 or e == 0:
            raise OptionError("the cells of the raster have no area", kind="size")
        values = np.where(np.isfinite(values), values, np.nan)
        if self.nodata is not None:
            values = np.where(values == self.nodata, np.nan, values)
        if (values <= 0).any():
            row, column = np.argwhere(values <= 0)[0]
            raise InputError(
                f"the raster has {values[row, column]} in row {row}, column {column}: sizes must be positive",
                kind="size",
                item="raster cell",
                index=(int(row), int(column)),
            )
        # Rows from the south, columns from the west.
        count_y, count_x = values.shape
        if e < 0:
            values, f, e = values[::-1], f + e * count_y, -e
        if a < 0:
            values, c, a = values[:, ::-1], c + a * count_x, -a
        cell = min(a, e)
        if a != e:
            at_x = np.minimum((np.arange(np.ceil(a * count_x / cell)) + 0.5) * cell / a, count_x - 1)
            at_y = np.minimum((np.arange(np.ceil(e * count_y / cell)) + 0.5) * cell / e, count_y - 1)
            values = values[np.ix_(at_y.astype(int), at_x.astype(int))]
        return np.ascontiguousarray(values), float(c + cell / 2), float(f + cell / 2), float(cell)


@dataclass(frozen=True, eq=False)
class SizeAt:
    """Edge lengths at places that need not be points of the mesh.

    Parameters
    ----------
    points : array_like, shape (n, 2)
    sizes : array_like, shape (n,)
        Lengths; away from the places they grow by the gradation.

    Examples
    --------
    >>> import hexdel
    >>> well = hexdel.SizeAt([(0.5, 0.5)], [0.02])
    >>> fine = hexdel.mesh([(0, 0), (1, 1)], size=well)
    >>> len(fine.triangles) > 3 * len(hexdel.mesh([(0, 0), (1, 1)]).triangles)
    True
    """

    points: ArrayLike
    sizes: ArrayLike


@dataclass(frozen=True, eq=False)
class SizeIn:
    """One edge length in a polygon; outside it grows by the gradation.

    Parameters
    ----------
    corners : array_like, shape (n, 2)
        Corners of a simple polygon, in order.
    size : float

    Examples
    --------
    >>> import hexdel
    >>> corner = hexdel.SizeIn([(0, 0), (0.2, 0), (0.2, 0.2), (0, 0.2)], 0.05)
    >>> mesh = hexdel.mesh([(0, 0), (1, 1)], size=[corner, 0.5])
    """

    corners: ArrayLike
    size: float


SizeCallable = Callable[[Floats, Floats], ArrayLike]
SizePart = Union[float, NDArray[Any], Raster, SizeAt, SizeIn, SizeCallable]
SizeLike = Union[SizePart, Sequence[Any]]


class Function:
    """A callable that is asked for arrays of places and must answer with lengths."""

    def __init__(self, call: SizeCallable) -> None:
        self._call = call

    def __call__(self, x: Floats, y: Floats) -> Floats:
        lengths = self._call(x, y)
        array = _arrays.floats(lengths, "what a callable size returns")
        try:
            return np.ascontiguousarray(np.broadcast_to(array, x.shape))
        except ValueError:
            raise InputError(
                f"a callable size got {x.shape[0]} places and returned the shape {array.shape}",
                kind="callable",
                hint="it is called with arrays x, y of one shape (n,); numpy.vectorize makes it so",
            ) from None


def parts(size: Any, points: Floats) -> list[Any]:
    """The parts of a size as the compiled half takes them."""
    if size is None:
        return []
    if isinstance(size, Raster):
        return [size._part()]
    if isinstance(size, SizeAt):
        places = _arrays.points(size.points, "the places of sizes")
        return _at_points(places, _arrays.numbers(size.sizes, len(places), "sizes", "place"), "place")
    if isinstance(size, SizeIn):
        return [(_arrays.points(size.corners, "the corners of a region"), _positive(size.size, "the region"))]
    if callable(size):
        call: Any = size
        return [(Function(call), FACTOR)]
    if isinstance(size, (list, tuple)) and not all(_is_number(part) for part in size):
        if len(size) == 2 and _dimensions(size[0]) == 2 and _dimensions(size[1]) == 1:
            return [Raster(*size)._part()]
        return [raw for part in size for raw in parts(part, points)]
    if _is_number(size):
        return [_positive(size, "the mesh")]
    array = _arrays.floats(size, "size")
    if array.ndim == 2 and array.shape[1] != 1:
        raise OptionError(
            f"size has the shape {array.shape}", kind="size", hint="a raster is hexdel.Raster(values, transform)"
        )
    return _at_points(points, _arrays.numbers(size, len(points), "size", "point"), "point")


def _at_points(points: Floats, sizes: Floats, item: str) -> list[Any]:
    bad = ~(sizes > 0)
    if bad.any():
        index = int(np.argmax(bad))
        raise InputError(
            f"the size of {item} {index} is {float(sizes[index])!r}: it must be positive",
            kind="size",
            item=item,
            index=index,
        )
    limited = np.isfinite(sizes)
    return [(points[limited], sizes[limited])] if limited.any() else []


def _dimensions(value: Any) -> int | None:
    """How many dimensions an array-like has; None if it is none."""
    try:
        return np.ndim(value)
    except (TypeError, ValueError, RecursionError):
        return None


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float, np.integer, np.floating)) or (
        isinstance(value, np.ndarray) and value.ndim == 0
    )


def _positive(value: Any, of: str) -> float:
    number = float(value)
    if isinstance(value, bool) or not (0 < number < np.inf):
        raise OptionError(f"the size of {of} must be a positive number, got {value!r}", kind="size")
    return number


def functions(raw: list[Any]) -> list[Function]:
    """The callables among the parts of a size."""
    return [part[0] for part in raw if isinstance(part, tuple) and isinstance(part[0], Function)]


def with_factor(raw: list[Any], factor: float) -> list[Any]:
    """The same parts with another factor for what callables return."""
    return [(part[0], factor) if isinstance(part, tuple) and isinstance(part[0], Function) else part for part in raw]


def worst(vertices: Floats, edges: NDArray[Any], asked: list[Function]) -> float:
    """The longest edge over what callables want at its ends and its middle."""
    wanted = _asked(vertices, asked)
    ends = vertices[edges]
    middles = _asked(0.5 * (ends[:, 0] + ends[:, 1]), asked)
    least = np.minimum(np.minimum(wanted[edges[:, 0]], wanted[edges[:, 1]]), middles)
    lengths = np.hypot(*(ends[:, 1] - ends[:, 0]).T)
    return float((lengths / least).max(initial=0.0))


def _asked(places: Floats, asked: list[Function]) -> Floats:
    least = np.full(len(places), np.inf)
    for start in range(0, len(places), CHUNK):
        chunk = places[start : start + CHUNK]
        x, y = np.ascontiguousarray(chunk[:, 0]), np.ascontiguousarray(chunk[:, 1])
        for function in asked:
            lengths = function(x, y)
            if not (lengths > 0).all():
                index = int(np.argmin(lengths > 0))
                raise InputError(
                    f"the size at {(float(x[index]), float(y[index]))} is {float(lengths[index])!r}: "
                    "a callable must return positive numbers",
                    kind="callable",
                    location=(float(x[index]), float(y[index])),
                )
            np.minimum(least[start : start + CHUNK], lengths, out=least[start : start + CHUNK])
    return least
