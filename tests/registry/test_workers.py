"""Who does jobs: one whose worker ends takes no other with it, and no worker outlives who began it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from workers import end_at

from ecm_extract.registry.workers import Here, Processes, Workers

_JOBS = list(range(8))


@pytest.mark.parametrize("workers", [Here(), Processes(1), Processes(3)])
def test_each_job_comes_back(workers: Workers) -> None:
    """With its result."""
    assert sorted((each.job, each.result) for each in workers.do(str, _JOBS)) == [(job, str(job)) for job in _JOBS]


@pytest.mark.parametrize("bad", [0, 5])
def test_a_worker_that_ends_takes_no_other_job_with_it(bad: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither those that run beside it nor those that wait."""
    monkeypatch.setenv("ECM_TEST_BAD", str(bad))
    done = list(Processes(2).do(end_at, _JOBS))
    assert sorted(each.job for each in done if each.result is not None) == [job for job in _JOBS if job != bad]
    assert [each.job for each in done if each.error] == [bad]


def test_nothing_outlives_who_began_it(tmp_path: Path) -> None:
    """A process that is killed cannot tell its workers to end; they see that it is gone."""
    begun = subprocess.Popen([sys.executable, str(Path(__file__).with_name("waiting.py")), str(tmp_path)])
    numbers = _numbers(tmp_path, 2)
    begun.send_signal(signal.SIGKILL)
    begun.wait()
    assert _until(lambda: not any(map(_runs, numbers)))


def _numbers(folder: Path, count: int) -> list[int]:
    assert _until(lambda: len(list(folder.iterdir())) == count)
    return [int(each.name) for each in folder.iterdir()]


def _until(is_so: Callable[[], bool]) -> bool:
    ends = time.monotonic() + 30
    while not is_so() and time.monotonic() < ends:
        time.sleep(0.05)
    return is_so()


def _runs(number: int) -> bool:
    try:
        os.kill(number, 0)
    except ProcessLookupError:
        return False
    return not Path(f"/proc/{number}/stat").exists() or " Z " not in Path(f"/proc/{number}/stat").read_text()
