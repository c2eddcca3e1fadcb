"""Options as the compiled half takes them."""

from __future__ import annotations

import difflib
import math
import sys
from collections.abc import Callable
from typing import Any, Literal, TypedDict

import numpy as np

from . import _progress
from ._arrays import Floats
from ._errors import OptionError
from ._size import SizeLike, parts

Method = Literal["compact", "templates", "simple"]
Effort = Literal["fast", "standard", "best", "fewest"]
DomainName = Literal["hexagon", "hull", "box", "inside"]
Progress = bool | Callable[[str, int, int], object] | None

METHODS = ("compact", "templates", "simple")
EFFORTS = ("fast", "standard", "best", "fewest")
DOMAINS = ("hexagon", "hull", "box", "inside")
WAYS = ("conform", "paper")
OVERLAPS = ("later", "refuse")


class Raw(TypedDict):
    """What `Options` of the compiled half reads."""

    method: str | None
    effort: str | None
    min_angle: float | None
    max_angle: float | None
    min_dual_edge: float | None
    max_area: float | None
    budget: float | None
    domain: str | None
    radius: float | None
    repair: float | None
    segment_method: str | None
    overlaps: str | None
    coarsening: bool | None
    threads: int | None
    size: list[Any]
    gradation: float | None
    progress: Callable[[str, int, int], object] | None


def raw(
    points: Floats,
    *,
    method: str | None = None,
    effort: str | None = None,
    min_angle: float | None = None,
    max_angle: float | None = None,
    min_dual_edge: float | None = None,
    max_area: float | None = None,
    budget: float | None = None,
    domain: str | float | None = None,
    repair: bool | float | None = None,
    segment_method: str | None = None,
    overlaps: str | None = None,
    threads: int | None = None,
    size: SizeLike | None = None,
    gradation: float | None = None,
    progress: Progress = None,
) -> Raw:
    """Checks options and brings them into one shape."""
    radius = None
    if domain is not None and not isinstance(domain, str):
        domain, radius = None, number(domain, "domain", least=0.0, open_=True)
    return {
        "method": word(method, METHODS, "method"),
        "effort": word(effort, EFFORTS, "effort"),
        "min_angle": number(min_angle, "min_angle", least=0.0, most=60.0),
        "max_angle": number(max_angle, "max_angle", least=60.0, most=180.0),
        "min_dual_edge": number(min_dual_edge, "min_dual_edge", least=0.0, open_=True),
        "max_area": number(max_area, "max_area", least=0.0, open_=True),
        "budget": number(budget, "budget", least=0.0),
        "domain": word(domain, DOMAINS, "domain"),
        "radius": radius,
        "repair": tolerance(repair),
        "segment_method": word(segment_method, WAYS, "segment_method"),
        "overlaps": word(overlaps, OVERLAPS, "overlaps"),
        "coarsening": None,
        "threads": thread_count(threads),
        "size": parts(size, points),
        "gradation": number(gradation, "gradation", least=0.0, open_=True),
        "progress": _progress.callback(progress),
    }


def word(value: Any, words: tuple[str, ...], name: str) -> str | None:
    """One of some words."""
    if value is None:
        return None
    if isinstance(value, str) and value.lower() in words:
        return value.lower()
    close = difflib.get_close_matches(str(value), words, 1)
    hint = f"did you mean {close[0]!r}?" if close else None
    raise OptionError(f"{name} must be one of {', '.join(map(repr, words))}, got {value!r}", kind="option", hint=hint)


def number(
    value: Any, name: str, *, least: float = -math.inf, most: float = math.inf, open_: bool = False
) -> float | None:
    """A finite number in a range, without its lower end if that is open."""
    if value is None:
        return None
    try:
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        result = math.nan
    too_small = result <= least if open_ else result < least
    if isinstance(value, (bool, str)) or not math.isfinite(result) or too_small or result > most:
        if most < math.inf:
            wanted = f"between {least:g} and {most:g}"
        elif open_ and least == 0:
            wanted = "a positive number"
        else:
            wanted = f"a number of at least {least:g}"
        raise OptionError(f"{name} must be {wanted}, got {value!r}", kind="option")
    return result


def tolerance(value: Any) -> float | None:
    """A tolerance of repair, -1 for one in proportion to the graph."""
    if value is None or value is False:
        return None
    if value is True or isinstance(value, np.bool_):
        return -1.0 if value else None
    return number(value, "repair", least=0.0)


def thread_count(value: Any = None) -> int | None:
    """Threads asked for; one in children of multiprocessing, else all that there are."""
    if value is None:
        processes = sys.modules.get("multiprocessing.process")
        if processes is not None and processes.parent_process() is not None:
            return 1
        return None
    wrong = isinstance(value, bool)
    try:
        count = value.__index__()
    except (AttributeError, TypeError):
        wrong, count = True, 0
    if wrong or not 1 <= count <= 1024:
        raise OptionError(f"threads must be an integer between 1 and 1024, got {value!r}", kind="option")
    return int(count)
