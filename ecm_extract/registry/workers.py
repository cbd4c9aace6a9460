"""Who does many jobs: this process, processes beside it, or the workers of a Dask cluster.

Each job comes back with its result or with why there is none; one whose worker ends takes no other with it.
"""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing import get_context, parent_process
from threading import Thread
from typing import Generic, Protocol, TypeVar

_Job = TypeVar("_Job")
_Result = TypeVar("_Result")


@dataclass(frozen=True)
class Done(Generic[_Job, _Result]):
    """A job with its result, or with the error that ended its worker."""

    job: _Job
    result: _Result | None
    error: str = ""


class Workers(Protocol):
    """Who does jobs."""

    def do(self, work: Callable[[_Job], _Result], jobs: Sequence[_Job]) -> Iterator[Done[_Job, _Result]]:
        """Do jobs, begun in their order, and yield each when it is done."""


class Here:
    """This process, one job after the other."""

    def do(self, work: Callable[[_Job], _Result], jobs: Sequence[_Job]) -> Iterator[Done[_Job, _Result]]:
        """Do jobs and yield each when it is done."""
        for job in jobs:
            yield Done(job, work(job))


class Processes:
    """Processes of this machine, `count` at a time."""

    def __init__(self, count: int) -> None:
        self._count = count

    def do(self, work: Callable[[_Job], _Result], jobs: Sequence[_Job]) -> Iterator[Done[_Job, _Result]]:
        """Do jobs and yield each when it is done; when a worker ends, what was under way is done again, each alone."""
        waiting = deque(jobs)
        while waiting:
            suspects: list[_Job] = []
            yield from self._until_one_ends(work, waiting, suspects)
            for job in suspects:
                yield _alone(work, job)

    def _until_one_ends(
        self, work: Callable[[_Job], _Result], waiting: deque[_Job], suspects: list[_Job]
    ) -> Iterator[Done[_Job, _Result]]:
        """Do jobs until none waits or a worker ends; `suspects` takes those that were under way then."""
        under_way: dict[Future[_Result], _Job] = {}
        with _pool(self._count) as pool:
            while (waiting or under_way) and not suspects:
                while waiting and len(under_way) < self._count:
                    job = waiting.popleft()
                    under_way[pool.submit(work, job)] = job
                for future in wait(under_way, return_when=FIRST_COMPLETED).done:
                    job = under_way.pop(future)
                    if isinstance(future.exception(), BrokenProcessPool):
                        suspects.append(job)
                    else:
                        yield Done(job, future.result())
        suspects += under_way.values()


def _alone(work: Callable[[_Job], _Result], job: _Job) -> Done[_Job, _Result]:
    with _pool(1) as pool:
        try:
            return Done(job, pool.submit(work, job).result())
        except BrokenProcessPool as error:
            return Done(job, None, str(error))


@contextmanager
def _pool(count: int) -> Iterator[ProcessPoolExecutor]:
    pool = ProcessPoolExecutor(count, get_context("spawn"), _end_with_parent)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


def _end_with_parent() -> None:
    """Make this worker end when its parent does: one that is killed cannot tell its workers to."""
    Thread(target=_wait_for_parent, daemon=True).start()


def _wait_for_parent() -> None:
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)  # its transaction is rolled back, and the next run does the tag
