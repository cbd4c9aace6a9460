"""What stays until the end of the tests is not looked through each time that garbage is collected."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable
from typing import Final

_MUCH: Final = 100_000
"""Blocks of memory: what a folder of tests and the modules that it needs take."""


class Kept:
    """Puts what is there out of sight of the collector: tests, modules, and what these remember."""

    def __init__(self, freeze: Callable[[], None]) -> None:
        self._freeze = freeze
        self._blocks = 0

    def look(self) -> None:
        """Keep what is there, where much came since the last time."""
        if sys.getallocatedblocks() - self._blocks < _MUCH:
            return
        gc.collect()
        self._freeze()
        self._blocks = sys.getallocatedblocks()
