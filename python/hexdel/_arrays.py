"""Anything array-like in, checked arrays out."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._errors import InputError

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Unsigned = NDArray[np.uint32]

#: Indices have 32 bits, and -1 stands for none.
MOST = 2**31 - 1


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    """The same memory, read-only."""
    view = array.view()
    view.flags.writeable = False
    return view


def floats(value: ArrayLike, name: str) -> Floats:
    """Numbers as float64, of any shape, contiguous."""
    if np.ma.isMaskedArray(value) and np.ma.is_masked(value):
        raise InputError(f"{name} has masked entries", kind="dtype", hint="drop them or fill them first")
    try:
        array = np.asarray(value)
        if array.dtype.kind in "cmMSUV":
            raise TypeError(f"dtype {array.dtype}")
        return np.ascontiguousarray(array, dtype=np.float64)
    except (TypeError, ValueError, OverflowError, MemoryError, RecursionError) as error:
        raise InputError(
            f"{name} must be an array of real numbers, got {_described(value)} ({error})",
            kind="dtype",
            hint="rows must be of one length, entries int or float",
        ) from None


def rows(value: ArrayLike | None, columns: int | tuple[int, ...], name: str) -> Floats:
    """Rows of coordinates and such; nothing at all is no rows."""
    allowed = columns if isinstance(columns, tuple) else (columns,)
    if value is None:
        return np.zeros((0, allowed[0]))
    array = floats(value, name)
    if array.size == 0 and array.ndim <= 2:
        return np.zeros((0, allowed[0]))
    if array.ndim != 2 or array.shape[1] not in allowed:
        wanted = " or ".join(f"(n, {c})" for c in allowed)
        turned = array.ndim == 2 and array.shape[0] in allowed
        cut = array.ndim == 2 and array.shape[1] > allowed[-1]
        ways = [f"{name}.T"] * turned + [f"{name}[:, :{allowed[-1]}]"] * cut
        hint = f"pass {' or '.join(ways)}" if ways else None
        if array.ndim == 1 and array.size in allowed:
            hint = f"a single row is [{name}]"
        raise InputError(f"{name} must have shape {wanted}, got {array.shape}", kind="shape", hint=hint)
    return array


def points(value: ArrayLike | None, name: str = "points") -> Floats:
    """Coordinates, shape (n, 2)."""
    return rows(value, 2, name)


def indices(value: ArrayLike | None, columns: int, name: str, item: str, count: int | None = None) -> Unsigned:
    """Rows of indices of points or vertices, as unsigned numbers.

    If `count` is given, indices must be below it.
    """
    if value is None:
        return np.zeros((0, columns), np.uint32)
    try:
        array = np.asarray(value)
    except (TypeError, ValueError, OverflowError, RecursionError) as error:
        raise InputError(f"{name} must be an array of indices ({error})", kind="dtype") from None
    if array.size == 0 and array.ndim <= 2:
        return np.zeros((0, columns), np.uint32)
    if array.ndim != 2 or array.shape[1] != columns:
        hint = f"pass {name}.T" if array.ndim == 2 and array.shape[0] == columns else None
        raise InputError(f"{name} must have shape (n, {columns}), got {array.shape}", kind="shape", hint=hint)
    if array.dtype.kind not in "iub":
        array = _whole(array, name, item)
    if array.dtype.kind == "b":
        raise InputError(f"{name} must be indices, got booleans", kind="dtype")
    most = MOST if count is None else count - 1
    bad = (array < 0) | (array > most)
    if bad.any():
        row = int(np.argmax(bad.any(axis=1)))
        entry = array[row][bad[row]][0]
        of = "" if count is None else f" of {count}"
        raise InputError(
            f"{item} {row} has the index {entry}{of}",
            kind="segment_end" if item == "segment" else "index",
            item=item,
            index=row,
            hint="indices count from 0",
        )
    return np.ascontiguousarray(array, dtype=np.uint32)


def _whole(array: NDArray[Any], name: str, item: str) -> NDArray[np.int64]:
    numbers = floats(array, name)
    whole = np.isfinite(numbers) & (numbers == np.floor(numbers)) & (np.abs(numbers) < 2.0**53)
    if not whole.all():
        row = int(np.argmax(~whole.all(axis=1)))
        raise InputError(
            f"{item} {row} has {numbers[row][~whole[row]][0]!r} for an index", kind="dtype", item=item, index=row
        )
    return numbers.astype(np.int64)


def numbers(value: ArrayLike | None, count: int, name: str, of: str) -> Floats:
    """One number for each of `count` items; none at all if there is no value."""
    if value is None:
        return np.zeros(0)
    array = floats(value, name)
    if array.ndim == 2 and array.shape[1] == 1:
        array = array[:, 0]
    if array.shape != (count,):
        raise InputError(
            f"{name} must have one entry for each {of}, shape ({count},), got {array.shape}", kind="length"
        )
    return np.ascontiguousarray(array)


def markers(value: ArrayLike | None, count: int, name: str, of: str) -> Ints:
    """One integer for each of `count` items; none at all if there is no value."""
    array = numbers(value, count, name, of)
    good = np.isfinite(array) & (array == np.floor(array)) & (np.abs(array) <= MOST)
    if not good.all():
        index = int(np.argmin(good))
        raise InputError(
            f"{name} must be integers of 32 bits, got {array[index]!r} for {of} {index}",
            kind="dtype",
            item=of,
            index=index,
        )
    return array.astype(np.int32)


def _described(value: Any) -> str:
    dtype = getattr(value, "dtype", None)
    return type(value).__name__ if dtype is None else f"dtype {dtype}"
