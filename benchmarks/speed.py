"""Speed and memory of an extraction against a raw parse of the same files: `python benchmarks/speed.py REPO`.

All times are of one run on one machine, each the best of three, and what counts is their ratio (DESIGN §7).
The raw parse is tree-sitter alone, on one core, over bytes that are already in memory: of all C++ and Python
files of the tree, and of just those that an extraction reads (product sources of packages, no tests).
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import msgspec
import peak_memory
import tree_sitter_cpp
import tree_sitter_python
from extracted import command
from source_files import language, walk
from tree_sitter import Language, Parser

RUNS = 3
COLD, WARM, MEMORY_MB, VERSION_S = 2.0, 0.15, 600.0, 0.2
"""Figures of DESIGN §7: cold / raw parse, warm / cold, peak memory, `--version`."""


class Timing(msgspec.Struct, frozen=True):
    """Seconds, all best of three; `warm` is None when the tool has no cache."""

    files: int
    megabytes: float
    parse_all: float
    parse_read: float
    files_read: int
    cold: float
    warm: float | None
    version: float


def best(action: Callable[[], None]) -> float:
    """Seconds of the fastest of three runs."""
    times = []
    for _ in range(RUNS):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return min(times)


def parse(files: list[tuple[str, bytes]]) -> None:
    """Parse files one after the other and forget the trees."""
    parsers = {
        "cpp": Parser(Language(tree_sitter_cpp.language())),
        "python": Parser(Language(tree_sitter_python.language())),
    }
    for lang, data in files:
        parsers[lang].parse(data)


def sources(root: Path) -> tuple[list[tuple[str, bytes]], list[tuple[str, bytes]]]:
    """All C++ and Python files of a tree, and those that an extraction reads: (language, bytes)."""
    from ecm_extract.discover import is_test_path

    paths = (path for path in sorted(root.rglob("*")) if ".git" not in path.parts)
    everything = [(lang, path.read_bytes()) for path in paths if (lang := language(path))]
    read = [(one.lang, one.text.encode()) for one in walk(root, is_test_path, Counter())]
    return everything, read


class Tool:
    """The installed command, run in an environment whose cache folder is a temporary one."""

    def __init__(self, root: Path, cache: str) -> None:
        self.environment = {**os.environ, "XDG_CACHE_HOME": cache}
        self.line = [command(), str(root), "--format", "json", "-o", "-"]
        self.has_cache = any("--no-cache" in _help(of) for of in ([], ["extract"]))
        self.cold_line = [*self.line, "--no-cache"] if self.has_cache else self.line

    def run(self, line: list[str]) -> None:
        """Run once; a status above 1 ends the benchmark."""
        done = subprocess.run(line, env=self.environment, capture_output=True, check=False)
        if done.returncode > 1:
            sys.exit(f"{' '.join(line)} ended with status {done.returncode}:\n{done.stderr.decode()[-2000:]}")

    def warm(self) -> float | None:
        """Seconds of a run after one that filled the cache."""
        if not self.has_cache:
            return None
        self.run(self.line)
        return best(lambda: self.run(self.line))


def _help(subcommand: list[str]) -> str:
    line = [command(), *subcommand, "--help"]
    return subprocess.run(line, capture_output=True, text=True, check=False).stdout


def measure(root: Path, tool: Tool) -> Timing:
    """Take all times, one after the other."""
    everything, read = sources(root)
    return Timing(
        files=len(everything),
        megabytes=sum(len(data) for _, data in everything) / 1e6,
        parse_all=best(lambda: parse(everything)),
        parse_read=best(lambda: parse(read)),
        files_read=len(read),
        cold=best(lambda: tool.run(tool.cold_line)),
        warm=tool.warm(),
        version=best(lambda: tool.run([command(), "--version"])),
    )


def _verdict(label: str, value: float, limit: float, unit: str = "") -> tuple[str, bool]:
    good = value <= limit
    return f"{label:44}{value:9.2f}{unit} (to reach: <= {limit:g}{unit}) {'ok' if good else 'MISSED'}", good


def verdicts(timing: Timing, peak: peak_memory.Peak) -> list[tuple[str, bool]]:
    """One line for each figure of DESIGN §7 that this script measures."""
    found = [
        _verdict("cold / raw parse of all files", timing.cold / timing.parse_all, COLD, " x"),
        _verdict("peak memory, sum over processes", peak.sum_of_peaks, MEMORY_MB, " MB"),
        _verdict("--version", timing.version, VERSION_S, " s"),
    ]
    if timing.warm is not None:
        found.append(_verdict("warm / cold", timing.warm / timing.cold, WARM, " x"))
    return found


def _print(timing: Timing, peak: peak_memory.Peak) -> None:
    warm = "no cache" if timing.warm is None else f"{timing.warm:.2f} s"
    print(f"files: {timing.files} ({timing.megabytes:.1f} MB), of which an extraction reads {timing.files_read}")
    print(f"raw parse, one core: all {timing.parse_all:.2f} s, those read {timing.parse_read:.2f} s")
    print(f"extraction: cold {timing.cold:.2f} s, warm {warm}; {os.cpu_count()} cores")
    print(f"cold / raw parse of the files read: {timing.cold / max(timing.parse_read, 1e-9):.2f} x")
    print(
        f"memory: {peak.processes} processes, peaks sum to {peak.sum_of_peaks:.0f} MB, "
        f"largest {peak.largest:.0f} MB, at one moment {peak.proportional:.0f} MB with shared pages once"
    )


def main() -> None:
    """Run the benchmark; status 1 when a figure is not reached."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("repo", type=Path, help="a work tree")
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as cache:
        tool = Tool(options.repo, cache)
        timing = measure(options.repo, tool)
        peak = peak_memory.run(tool.cold_line, tool.environment)
    lines = verdicts(timing, peak)
    if options.json:
        print(json.dumps({"timing": msgspec.to_builtins(timing), "memory": msgspec.to_builtins(peak)}))
    else:
        _print(timing, peak)
        print("\n".join(line for line, _ in lines))
    sys.exit(0 if all(good for _, good in lines) else 1)


if __name__ == "__main__":
    main()
