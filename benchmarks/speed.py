"""Speed and memory of an extraction against a raw parse of the same files: `python benchmarks/speed.py REPO`.

All times are of one run on one machine, each the best of three, and what counts is their ratio (DESIGN §7).
The raw parse is tree-sitter alone, on one core, over bytes that are already in memory: of all C++ and Python
files of the tree, and of just those that an extraction reads (product sources of packages, no tests).

The cache is measured in three states: empty, so that a run fills it; knowing all source files but not the extraction,
as after a change of any other file; and knowing everything. `--diff OLD NEW` times a diff of two refs of the repository
against the extraction of NEW.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import msgspec
import peak_memory
import tree_sitter_cpp
import tree_sitter_python
from extracted import command
from source_files import language, walk
from tree_sitter import Language, Parser

RUNS = 3
COLD, WARM, DIFF, MEMORY_MB, VERSION_S = 2.0, 0.15, 1.3, 600.0, 0.2
"""Figures of DESIGN §7: cold / raw parse, warm / cold, diff / cold, peak memory, `--version`."""


class Timing(msgspec.Struct, frozen=True):
    """Seconds, all best of three.

    Attributes:
        cold: without the cache. filled: with an empty one. known: with the facts of all source files.
        warm: with everything.
    """

    files: int
    megabytes: float
    parse_all: float
    parse_read: float
    files_read: int
    cold: float
    filled: float
    known: float
    warm: float
    version: float


class DiffTiming(msgspec.Struct, frozen=True):
    """Seconds of a diff and of the extraction of its new side, all best of three."""

    cold: float
    warm: float
    extraction: float


def best(action: Callable[[], None], before: Callable[[], None] = lambda: None) -> float:
    """Seconds of the fastest of three runs; what is done `before` each does not count."""
    times = []
    for _ in range(RUNS):
        before()
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

    def __init__(self, cache: Path) -> None:
        self.cache = cache
        # An installed package has its bytecode; where Python may not write it, each run would compile the tool anew.
        inherited = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
        self.environment = {**inherited, "ECM_CACHE_DIR": str(cache)}

    def extraction(self, root: str, *options: str) -> list[str]:
        """Command line of an extraction."""
        return [command(), "extract", root, "--format", "json", "-o", "-", *options]

    def run(self, line: list[str]) -> None:
        """Run once; a status above 1 ends the benchmark."""
        done = subprocess.run(line, env=self.environment, capture_output=True, check=False)
        if done.returncode > 1:
            sys.exit(f"{' '.join(line)} ended with status {done.returncode}:\n{done.stderr.decode()[-2000:]}")

    def cold(self, line: list[str]) -> float:
        """Seconds without the cache."""
        return best(lambda: self.run([*line, "--no-cache"]))

    def filled(self, line: list[str]) -> float:
        """Seconds of a run that finds the cache empty and fills it."""
        return best(lambda: self.run(line), before=self.forget)

    def known(self, line: list[str]) -> float:
        """Seconds of a run that finds the facts of all source files, and nothing else."""
        self.run(line)
        return best(lambda: self.run(line), before=self.forget_results)

    def warm(self, line: list[str]) -> float:
        """Seconds of a run after one that filled the cache."""
        self.run(line)
        return best(lambda: self.run(line))

    def forget(self) -> None:
        """Empty the cache."""
        shutil.rmtree(self.cache, ignore_errors=True)

    def forget_results(self) -> None:
        """Leave only the facts of source files in the cache."""
        for file in self.cache.glob("*.sqlite"):
            with closing(sqlite3.connect(file)) as connection, connection:
                connection.execute("DELETE FROM entries WHERE key NOT LIKE 'facts %'")


def measure(root: Path, tool: Tool) -> Timing:
    """Take all times, one after the other."""
    everything, read = sources(root)
    line = tool.extraction(str(root))
    return Timing(
        files=len(everything),
        megabytes=sum(len(data) for _, data in everything) / 1e6,
        parse_all=best(lambda: parse(everything)),
        parse_read=best(lambda: parse(read)),
        files_read=len(read),
        cold=tool.cold(line),
        filled=tool.filled(line),
        known=tool.known(line),
        warm=tool.warm(line),
        version=best(lambda: tool.run([command(), "--version"])),
    )


def measure_diff(root: Path, refs: tuple[str, str], tool: Tool) -> DiffTiming:
    """Times of a diff between two refs of a repository."""
    line = [command(), "diff", *refs, "--repo", str(root), "--format", "json", "--fail-on", "never"]
    extraction = tool.cold(tool.extraction(str(root), "--ref", refs[1]))
    return DiffTiming(cold=tool.cold(line), warm=tool.warm(line), extraction=extraction)


def _verdict(label: str, value: float, limit: float, unit: str = "") -> tuple[str, bool]:
    good = value <= limit
    return f"{label:44}{value:9.2f}{unit} (to reach: <= {limit:g}{unit}) {'ok' if good else 'MISSED'}", good


def verdicts(timing: Timing, peak: peak_memory.Peak) -> list[tuple[str, bool]]:
    """One line for each figure of DESIGN §7 that this script measures."""
    return [
        _verdict("cold / raw parse of all files", timing.cold / timing.parse_all, COLD, " x"),
        _verdict("warm / cold", timing.warm / timing.cold, WARM, " x"),
        _verdict("peak memory, sum over processes", peak.sum_of_peaks, MEMORY_MB, " MB"),
        _verdict("--version", timing.version, VERSION_S, " s"),
    ]


def diff_verdicts(diff: DiffTiming) -> list[tuple[str, bool]]:
    """The line for the figure of DESIGN §7 about diffs."""
    return [_verdict("diff, cold / extraction of its new side, cold", diff.cold / diff.extraction, DIFF, " x")]


def _print(timing: Timing, peak: peak_memory.Peak) -> None:
    print(f"files: {timing.files} ({timing.megabytes:.1f} MB), of which an extraction reads {timing.files_read}")
    print(f"raw parse, one core: all {timing.parse_all:.2f} s, those read {timing.parse_read:.2f} s")
    print(
        f"extraction: cold {timing.cold:.2f} s, filling the cache {timing.filled:.2f} s, sources known "
        f"{timing.known:.2f} s, warm {timing.warm:.2f} s; {os.cpu_count()} cores"
    )
    print(f"cold / raw parse of the files read: {timing.cold / max(timing.parse_read, 1e-9):.2f} x")
    print(
        f"memory: {peak.processes} processes, peaks sum to {peak.sum_of_peaks:.0f} MB, "
        f"largest {peak.largest:.0f} MB, at one moment {peak.proportional:.0f} MB with shared pages once"
    )


def _print_diff(diff: DiffTiming) -> None:
    print(
        f"diff: cold {diff.cold:.2f} s, warm {diff.warm:.2f} s ({diff.warm / diff.extraction:.2f} x); "
        f"extraction of the new side, cold {diff.extraction:.2f} s"
    )


def main() -> None:
    """Run the benchmark; status 1 when a figure is not reached."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("repo", type=Path, help="a work tree; with --diff a repository")
    parser.add_argument("--diff", nargs=2, metavar=("OLD", "NEW"), help="time a diff of two refs, and nothing else")
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        tool = Tool(Path(folder) / "cache")
        lines = _diffed(options, tool) if options.diff else _extracted(options, tool)
    if not options.json:
        print("\n".join(line for line, _ in lines))
    sys.exit(0 if all(good for _, good in lines) else 1)


def _extracted(options: argparse.Namespace, tool: Tool) -> list[tuple[str, bool]]:
    timing = measure(options.repo, tool)
    peak = peak_memory.run([*tool.extraction(str(options.repo)), "--no-cache"], tool.environment)
    if options.json:
        print(json.dumps({"timing": msgspec.to_builtins(timing), "memory": msgspec.to_builtins(peak)}))
    else:
        _print(timing, peak)
    return verdicts(timing, peak)


def _diffed(options: argparse.Namespace, tool: Tool) -> list[tuple[str, bool]]:
    diff = measure_diff(options.repo, tuple(options.diff), tool)
    if options.json:
        print(json.dumps({"diff": msgspec.to_builtins(diff)}))
    else:
        _print_diff(diff)
    return diff_verdicts(diff)


if __name__ == "__main__":
    main()
