"""A progress bar on standard error, for runs that take longer than a person likes to wait in the dark."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock, Timer
from typing import TYPE_CHECKING, Final

from ecm_extract.extraction_model import Progress

if TYPE_CHECKING:
    from rich.progress import Progress as Bar
    from rich.progress import TaskID

_PATIENCE: Final = 1.0
_READING: Final = "reading files"
_WORKING: Final = "working"


class _LateBar:
    """A bar that shows itself after a second, counted or not; only the process that made it draws."""

    def __init__(self) -> None:
        self._home = os.getpid()
        self._lock = Lock()
        self._bar: Bar | None = None
        self._task: TaskID | None = None
        self._timer = Timer(_PATIENCE, self._show)
        self._timer.daemon = True
        self._timer.start()

    def __call__(self, done: int, total: int) -> None:
        """Show how many files are read; what comes after them is not counted."""
        if os.getpid() != self._home:
            return
        with self._lock:
            if self._bar is None or self._task is None:
                return
            if done < total:
                self._bar.update(
                    self._task, description=_READING, completed=done, total=total, counted=f"{done}/{total}"
                )
            else:
                self._bar.update(self._task, description=_WORKING, completed=0, total=None, counted="")

    def _show(self) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

        counted = TextColumn("{task.fields[counted]}")
        columns = (TextColumn("{task.description}"), BarColumn(), counted, TimeElapsedColumn())
        with self._lock:
            self._bar = Progress(*columns, console=Console(stderr=True), transient=True)
            self._task = self._bar.add_task(_WORKING, total=None, counted="")
            self._bar.start()

    def close(self) -> None:
        """Take the bar away, or see to it that it never comes."""
        self._timer.cancel()
        self._timer.join()
        if self._bar is not None:
            self._bar.stop()


@contextmanager
def progress_bar() -> Iterator[Progress | None]:
    """A callback `(files done, files in all)`; a bar stands on the terminal until the block ends.

    None where standard error is no terminal.
    """
    if not sys.stderr.isatty():
        yield None
        return
    bar = _LateBar()
    try:
        yield bar
    finally:
        bar.close()
