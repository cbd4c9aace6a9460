"""Runs the tool on inputs that were mutated, each in a package of its own, in a process with limits."""

from __future__ import annotations

import os
import resource
import shutil
import signal
import subprocess
import tempfile
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Final, NamedTuple

from extracted import command
from fuzz_inputs import KINDS

SECONDS: Final = 10.0
MEGABYTES: Final = 1024
_HARD_SECONDS: Final = 40
_HARD_MEGABYTES: Final = 3072
_TOOL_FAILED: Final = 3
_MANIFEST: Final = (
    '<package format="3"><name>{0}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@b.c">a</maintainer><license>MIT</license><depend>rclcpp</depend>'
    '<export><build_type>ament_cmake</build_type><b plugin="${{prefix}}/plugins.xml"/></export></package>'
)


class Input(NamedTuple):
    """One input: its kind, the real text it was made of, and the text itself."""

    kind: str
    real: str
    text: str


class Run(NamedTuple):
    """How a process ended: `problem` is empty, `traceback`, `slow` or `large`; `told` the end of its errors."""

    problem: str
    told: str


_FINE: Final = Run("", "")


def run(inputs: Sequence[Input]) -> Run:
    """Run every command that reads inputs of this kind on a workspace of them; the first problem is returned."""
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        write(inputs, Path(folder))
        runs = (_limited(arguments, Path(folder), len(inputs)) for arguments in _commands(inputs, Path(folder)))
        return next((found for found in runs if found.problem), _FINE)


def write(inputs: Sequence[Input], root: Path) -> None:
    """Write a package for each input: as it was below `old`, as it is below `new`."""
    for number, entry in enumerate(inputs):
        for side, text in (("old", entry.real), ("new", entry.text)):
            package = root / side / f"fuzz{number}"
            target = package / KINDS[entry.kind].place
            target.parent.mkdir(parents=True, exist_ok=True)
            (package / "package.xml").write_text(_MANIFEST.format(package.name), "utf-8")
            target.write_text(text, "utf-8", "surrogatepass")


def _commands(inputs: Sequence[Input], root: Path) -> list[list[str]]:
    kind, new = inputs[0].kind, str(root / "new")
    files = [str(path) for path in sorted((root / "new").glob(f"*/{KINDS[kind].place}"))]
    if kind == "patch":
        return [["lint", new, "--patch", path, "--jobs", "1"] for path in files]
    if kind == "refs":
        return [arguments for path in files for arguments in _on_refs(Path(path))]
    found = [["extract", new, "--jobs", "1", "--no-cache", "--format", "json", "-o", "-"], ["lint", new, "--jobs", "1"]]
    found.append(["diff", str(root / "old"), new, "--jobs", "1"])
    launched = ["system", *files, "--workspace", new, "--format", "json"]
    return [*found, launched] if kind.startswith("launch") else found


def _on_refs(path: Path) -> list[list[str]]:
    """A repository with these packed refs and nothing else."""
    repository = path.parent / "repository"
    subprocess.run(["git", "init", "-q", str(repository)], check=True)
    shutil.move(path, repository / ".git/packed-refs")
    return [["diff", "--repo", str(repository)], ["lint", str(repository), "--base", "1.0.0"]]


def _limited(arguments: Sequence[str], cache: Path, count: int) -> Run:
    """Run one command; what takes longer than one input may is slow where it was given one only."""
    environment = {**os.environ, "ECM_CACHE_DIR": str(cache / "cache")}
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(
            [command(), *arguments],
            stdout=subprocess.DEVNULL,
            stderr=errors,
            stdin=subprocess.DEVNULL,
            env=environment,
            preexec_fn=_limit,
            start_new_session=True,
        )
        status, usage = _waited(process, _HARD_SECONDS + count)
        errors.seek(0)
        told = errors.read().decode("utf-8", "replace")
    return Run(_problem(status, told, usage), f"{' '.join(arguments)}\n{told[-3000:]}")


def _limit() -> None:
    limit = _HARD_MEGABYTES * 1024 * 1024
    resource.setrlimit(resource.RLIMIT_AS, (limit, limit))


def _waited(process: subprocess.Popen[bytes], seconds: float) -> tuple[int, resource.struct_rusage]:
    """Wait for a process, and end it and what it started after some time: its status and what it used."""
    end = time.monotonic() + seconds
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            process.returncode = os.waitstatus_to_exitcode(status)
            return process.returncode, usage
        if time.monotonic() > end:
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
        time.sleep(0.02)


def _problem(status: int, told: str, usage: resource.struct_rusage) -> str:
    if usage.ru_utime + usage.ru_stime > SECONDS:
        return "slow"
    if usage.ru_maxrss > MEGABYTES * 1024 or "MemoryError" in told:
        return "large"
    return "traceback" if status < 0 or status == _TOOL_FAILED or "Traceback" in told else ""
