"""Work that another process does meanwhile: linking one side while this process links the other."""

from __future__ import annotations

import pickle
import threading
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from typing import Final, Generic, TypeVar

from ecm_extract.processes import forked

_Result = TypeVar("_Result")

_MIN_FUNCTIONS: Final = 100
"""What is done for fewer takes less time than a process that begins, and sends what it found."""


class Background(Generic[_Result]):
    """A function that runs in a fork of this process, which sees everything that was read so far.

    What it returns comes back pickled: it is made by our own code in a process of ours, never read from a file. A
    fork that dies costs time, not the result: the function then runs here.
    """

    def __init__(self, work: Callable[[], _Result]) -> None:
        self._work = work
        self._received: bytes | None = None
        receiver, sender = Pipe(duplex=False)
        self._process = forked(_run, work, sender)
        sender.close()
        self._thread = threading.Thread(target=self._receive, args=(receiver,), daemon=True)
        self._thread.start()

    def result(self) -> _Result:
        """Wait for the result."""
        self._thread.join()
        self._process.join()
        if self._received is None:
            return self._work()
        result: _Result = pickle.loads(self._received)
        return result

    def _receive(self, receiver: Connection) -> None:
        """Drain the pipe beside the work of this process, so that the other one never waits to write."""
        try:
            self._received = receiver.recv_bytes()
        except (EOFError, OSError):
            self._received = None


def meanwhile(work: Callable[[], _Result], jobs: int | None) -> Callable[[], _Result]:
    """Start work in another process and return the function that waits for it; with one job that does it itself."""
    return work if jobs == 1 else Background(work).result


def jobs_for(functions: int, jobs: int | None) -> int | None:
    """How many jobs work on so many functions of sources is for: one where few are, unless a number was asked for."""
    return 1 if jobs is None and functions < _MIN_FUNCTIONS else jobs


def _run(work: Callable[[], object], sender: Connection) -> None:
    """An error is not told here: the parent does the work again, and meets it where it can be answered."""
    with suppress(Exception):
        sender.send_bytes(pickle.dumps(work(), pickle.HIGHEST_PROTOCOL))
    sender.close()
