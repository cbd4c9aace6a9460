"""Whichever ROS 2 is sourced, and programs under it on loopback."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import IO

from path_a.row import NotMeasured

PYTHON = "/usr/bin/python3"
LOOPBACK = (
    '<CycloneDDS><Domain Id="any"><General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>'
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    '<MaxAutoParticipantIndex>30</MaxAutoParticipantIndex><Peers><Peer address="127.0.0.1"/></Peers></Discovery>'
    "</Domain></CycloneDDS>"
)
_PATIENCE_S = 15


def require(packages: Sequence[str]) -> str:
    """The distribution that is sourced, with these packages; says what is missing."""
    if not os.environ.get("AMENT_PREFIX_PATH") or shutil.which("ros2") is None:
        message = "no ROS 2 is sourced (AMENT_PREFIX_PATH is not set)"
        raise NotMeasured(message)
    distribution = os.environ.get("ROS_DISTRO", "of no name")
    lacking = [package for package in packages if prefix_of(package) is None]
    if lacking:
        message = f"the sourced ROS 2 ({distribution}) has no {', '.join(lacking)}"
        raise NotMeasured(message)
    return distribution


@cache
def prefix_of(package: str) -> Path | None:
    """Where a package is installed, by the index of ament."""
    for prefix in map(Path, os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)):
        if (prefix / "share" / "ament_index" / "resource_index" / "packages" / package).exists():
            return prefix
    return None


def environment(domain: int, **variables: str) -> dict[str, str]:
    """That of the sourced ROS 2, on a domain of its own; Cyclone DDS stays on loopback."""
    return {**os.environ, "ROS_DOMAIN_ID": str(domain), "CYCLONEDDS_URI": LOOPBACK, **variables}


@contextmanager
def running(
    line: Sequence[str], variables: dict[str, str], log: IO[str] | None = None
) -> Iterator[subprocess.Popen[str]]:
    """A program and everything that it starts, until the end of the block: interrupted, then killed."""
    output = log if log is not None else subprocess.DEVNULL
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen(
            line, env=variables, cwd=folder, stdout=output, stderr=output, text=True, start_new_session=True
        )
        try:
            yield process
        finally:
            _signal(process.pid, signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                process.wait(_PATIENCE_S)
            _signal(process.pid, signal.SIGKILL)
            process.wait()


def _signal(group: int, number: signal.Signals) -> None:
    """To the program and its children, of which some may be gone."""
    with suppress(ProcessLookupError):
        os.killpg(group, number)
