"""What stays until the end of the tests is not looked through each time that garbage is collected."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable
from typing import Final

_MANY: Final = 50


class Kept:
    """Puts what was imported out of sight of the collector, together with all tests."""

    def __init__(self, freeze: Callable[[], None]) -> None:
        self._freeze = freeze
        self._modules = 0

    def look(self) -> None:
        """Keep what is there, where many modules came since the last time."""
        if len(sys.modules) - self._modules < _MANY:
            return
        gc.collect()
        self._freeze()
        self._modules = len(sys.modules)
