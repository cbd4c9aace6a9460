"""Forked processes of a run: how they begin and end, so that an interrupted run says one sentence only."""

from __future__ import annotations

import gc
import os
import signal
from collections.abc import Callable
from multiprocessing import active_children, get_context
from multiprocessing.process import BaseProcess
from types import FrameType
from typing import Any, Final, NoReturn

_INTERRUPTED: Final = 130
_SIGNALS: Final = (signal.SIGINT, signal.SIGTERM)
_PATIENCE_S: Final = 5


def forked(work: Callable[..., None], *given: Any) -> BaseProcess:
    """Start a function in a fork, which ends without a word when it is interrupted or this process ends.

    Signals wait while the fork begins: it would answer them as this process does, with a traceback.
    """
    process = get_context("fork").Process(target=_begun, args=(work, given))
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS)
    try:
        process.start()
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
    return process


def end_forks() -> None:
    """End the forks that are still at work, and wait until they have cleaned up."""
    for child in active_children():
        child.terminate()
    for child in active_children():
        child.join(_PATIENCE_S)


def close_generators() -> None:
    """Close what an interrupted run left half read: a suspended generator may hold a process and a folder."""
    gc.collect()


def _begun(work: Callable[..., None], given: tuple[Any, ...]) -> None:
    for number in _SIGNALS:
        signal.signal(number, _leave)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, _SIGNALS)
    interrupted = False
    try:
        work(*given)
    except SystemExit:
        interrupted = True
    if interrupted:
        end_forks()
        close_generators()
    os._exit(_INTERRUPTED if interrupted else 0)  # a stream that this process never wrote to may be locked for ever


def _leave(_signal: int, _frame: FrameType | None) -> NoReturn:
    """Unwind, so that temporary folders go; another signal must not stop that."""
    for number in _SIGNALS:
        signal.signal(number, _stay)
    raise SystemExit(_INTERRUPTED)


def _stay(_signal: int, _frame: FrameType | None) -> None:
    """A handler of ours and not SIG_IGN, of which Python complains when the signal is already on its way."""
