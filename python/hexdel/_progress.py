"""How far the work is: a callback, or a bar."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

from ._errors import OptionError


def callback(progress: Any) -> Callable[[str, int, int], object] | None:
    """What is called with a phase, the units done and about how many there are."""
    if progress is None or progress is False:
        return None
    if progress is True:
        return Bar()
    if not callable(progress):
        raise OptionError(
            f"progress must be True, False or a callable, got {type(progress).__name__}",
            kind="option",
            hint="it is called with (phase, done, total)",
        )
    result: Callable[[str, int, int], object] = progress
    return result


class Bar:
    """A bar of tqdm if that is installed, else a line on standard error."""

    def __init__(self) -> None:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self._bar: Any = None
        else:

            class Bar(tqdm):  # type: ignore[type-arg, misc, unused-ignore]
                # No thread that outlives the call.
                monitor_interval = 0

            self._bar = Bar(total=1, desc="hexdel", unit="", leave=False)

    def __call__(self, phase: str, done: int, total: int) -> None:
        if self._bar is None:
            sys.stderr.write(f"\rhexdel: {phase:<9}{100 * done // max(total, 1):>4} %")
            sys.stderr.flush()
            return
        self._bar.set_description(phase, refresh=False)
        self._bar.total, self._bar.n = total, done
        self._bar.refresh()

    def close(self) -> None:
        """Takes the bar away."""
        if self._bar is None:
            sys.stderr.write("\n")
        else:
            self._bar.close()


def close(progress: Any) -> None:
    """Ends a bar, if it is one of ours."""
    if isinstance(progress, Bar):
        progress.close()
