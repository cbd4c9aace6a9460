"""Peak memory of a command and everything it starts, sampled from /proc while it runs.

Not getrusage: a child's `ru_maxrss` starts at the size of the process that forked it, here this benchmark.
"""

from __future__ import annotations

import os
import re
import subprocess
import time
from pathlib import Path

import msgspec

_INTERVAL_S = 0.02


class Peak(msgspec.Struct, frozen=True):
    """Megabytes (10^6 bytes).

    Attributes:
        sum_of_peaks: highest resident set of each process, summed: pages shared after a fork count each time.
        proportional: highest sum, at one moment, of the proportional sets: shared pages count once.
        largest: highest resident set of one process.
        processes: how many were seen.
    """

    sum_of_peaks: float
    proportional: float
    largest: float
    processes: int


def run(line: list[str], environment: dict[str, str]) -> Peak:
    """Run a command in a process group of its own and watch the group."""
    peaks: dict[int, float] = {}
    highest = 0.0
    with subprocess.Popen(
        line, env=environment, start_new_session=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        while process.poll() is None:
            highest = max(highest, _sample(process.pid, peaks))
            time.sleep(_INTERVAL_S)
    return Peak(sum(peaks.values()), highest, max(peaks.values(), default=0.0), len(peaks))


def _sample(group: int, peaks: dict[int, float]) -> float:
    """Note the peak of each process of the group; return the proportional memory of all, now."""
    total = 0.0
    for pid in _members(group):
        peak = _megabytes(pid, "status", "VmHWM")
        peaks[pid] = max(peaks.get(pid, 0.0), peak)
        total += _megabytes(pid, "smaps_rollup", "Pss")
    return total


def _members(group: int) -> list[int]:
    pids = (int(entry.name) for entry in Path("/proc").iterdir() if entry.name.isdigit())
    return [pid for pid in pids if _group_of(pid) == group]


def _group_of(pid: int) -> int:
    try:
        return os.getpgid(pid)
    except ProcessLookupError:
        return 0


def _megabytes(pid: int, file: str, key: str) -> float:
    try:
        text = Path(f"/proc/{pid}/{file}").read_text()
    except OSError:
        return 0.0
    found = re.search(rf"^{key}:\s*(\d+) kB", text, re.MULTILINE)
    return int(found.group(1)) * 1024 / 1e6 if found else 0.0
