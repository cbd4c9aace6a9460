"""When the cycle collector runs: not while facts are read, now and then while functions are run."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

RARELY: Final = (300_000, 2, 5)
"""Thresholds of `gc`: on navigation2 a sixth less memory than without it, in the same time."""


@contextmanager
def without_collector() -> Iterator[None]:
    """Records of facts have no cycles: the collector finds nothing among them and costs a quarter of the time."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


@contextmanager
def rare_collector() -> Iterator[None]:
    """Runs of functions are circles, of states and of places in them, and most are dropped again.

    What was made until now is not looked through.
    """
    enabled, thresholds = gc.isenabled(), gc.get_threshold()
    gc.freeze()
    gc.set_threshold(*RARELY)
    gc.enable()
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
        gc.unfreeze()
        if not enabled:
            gc.disable()
