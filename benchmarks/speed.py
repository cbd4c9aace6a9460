"""Speed and memory of the tool against a raw parse of the same files: `python benchmarks/speed.py REPO`.

All times are of one run on one machine, each the best of three, and what counts is their ratio (DESIGN §7).
The raw parse is tree-sitter alone, on one core, over bytes that are already in memory: of all C++ and Python
files of the tree, and of just those that an extraction reads (product sources of packages, no tests).

The cache is measured in three states: empty, so that a run fills it; knowing all source files but not the extraction,
as after a change of any other file; and knowing everything. A lint fills an empty cache too, and so is compared with
an extraction that does. Comparisons are between `--refs OLD NEW`, by default the two newest tags that HEAD can reach:
of sources against the extraction of NEW, and of documents that were stored before.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from collections import Counter
from pathlib import Path

import msgspec
import peak_memory
import tree_sitter_cpp
import tree_sitter_python
from extracted import command
from source_files import language, walk
from speed_diff import DiffTiming, measure_diff, newest_tags
from timed_tool import Tool, best
from tree_sitter import Language, Parser

COLD, WARM, LINT, DIFF, STORED_S, MEMORY_MB, VERSION_S = 2.0, 0.15, 1.5, 1.3, 0.5, 600.0, 0.2
"""Figures of DESIGN §7: cold / raw parse, warm / cold, lint / extraction, diff / cold, a diff of stored documents, peak
memory, `--version`."""


class Timing(msgspec.Struct, frozen=True):
    """Seconds, all best of three.

    Attributes:
        cold: without the cache. filled: with an empty one. known: with the facts of all source files.
        warm: with everything. lint: with an empty cache.
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
    lint: float
    version: float


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
    from ecm_extract.test_code import is_test_path

    paths = (path for path in sorted(root.rglob("*")) if ".git" not in path.parts)
    everything = [(lang, path.read_bytes()) for path in paths if (lang := language(path))]
    read = [(one.lang, one.text.encode()) for one in walk(root, is_test_path, Counter())]
    return everything, read


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
        lint=tool.filled([command(), "lint", str(root), "--fail-on", "never"]),
        version=best(lambda: tool.run([command(), "--version"])),
    )


def _verdict(label: str, value: float, limit: float, unit: str = "") -> tuple[str, bool]:
    good = value <= limit
    return f"{label:44}{value:9.2f}{unit} (to reach: <= {limit:g}{unit}) {'ok' if good else 'MISSED'}", good


def verdicts(timing: Timing, peak: peak_memory.Peak) -> list[tuple[str, bool]]:
    """One line for each figure of DESIGN §7 that this script measures."""
    return [
        _verdict("cold / raw parse of all files", timing.cold / timing.parse_all, COLD, " x"),
        _verdict("warm / cold", timing.warm / timing.cold, WARM, " x"),
        _verdict("lint / extraction, the cache being empty", timing.lint / timing.filled, LINT, " x"),
        _verdict("peak memory, shared pages once", peak.proportional, MEMORY_MB, " MB"),
        _verdict("--version", timing.version, VERSION_S, " s"),
    ]


def diff_verdicts(diff: DiffTiming) -> list[tuple[str, bool]]:
    """The lines for the figures of DESIGN §7 about diffs."""
    return [
        _verdict("diff, cold / extraction of its new side, cold", diff.cold / diff.extraction, DIFF, " x"),
        _verdict("diff of two stored documents of a package", diff.stored, STORED_S, " s"),
    ]


def _print(timing: Timing, peak: peak_memory.Peak) -> None:
    print(f"files: {timing.files} ({timing.megabytes:.1f} MB), of which an extraction reads {timing.files_read}")
    print(f"raw parse, one core: all {timing.parse_all:.2f} s, those read {timing.parse_read:.2f} s")
    print(
        f"extraction: cold {timing.cold:.2f} s, filling the cache {timing.filled:.2f} s, sources known "
        f"{timing.known:.2f} s, warm {timing.warm:.2f} s; lint {timing.lint:.2f} s; {os.cpu_count()} cores"
    )
    print(f"cold / raw parse of the files read: {timing.cold / max(timing.parse_read, 1e-9):.2f} x")
    print(
        f"memory: {peak.processes} processes, peaks sum to {peak.sum_of_peaks:.0f} MB, "
        f"largest {peak.largest:.0f} MB, at one moment {peak.proportional:.0f} MB with shared pages once"
    )


def _told(diff: DiffTiming | None, refs: tuple[str, str] | None) -> str:
    if diff is None or refs is None:
        return "no comparison: HEAD reaches no two tags"
    return (
        f"diff {refs[0]} {refs[1]}: cold {diff.cold:.2f} s, warm {diff.warm:.2f} s; extraction of the new side, cold "
        f"{diff.extraction:.2f} s; of stored documents: one package {diff.stored:.2f} s, all {diff.stored_all:.2f} s"
    )


def main() -> None:
    """Run the benchmark; status 1 when a figure is not reached."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("repo", type=Path, help="a work tree of a repository")
    parser.add_argument("--refs", nargs=2, metavar=("OLD", "NEW"), help="compare these")
    parser.add_argument("--json", action="store_true", help="print JSON instead of text")
    options = parser.parse_args()
    refs = tuple(options.refs) if options.refs else newest_tags(options.repo)
    with tempfile.TemporaryDirectory() as folder:
        tool = Tool(Path(folder) / "cache")
        timing = measure(options.repo, tool)
        peak = peak_memory.run([*tool.extraction(str(options.repo)), "--no-cache"], tool.environment)
        diff = measure_diff(options.repo, refs, tool, Path(folder)) if refs is not None else None
    lines = [*verdicts(timing, peak), *(diff_verdicts(diff) if diff is not None else ())]
    if options.json:
        print(json.dumps(msgspec.to_builtins({"timing": timing, "memory": peak, "diff": diff})))
    else:
        _print(timing, peak)
        print(_told(diff, refs))
        print("\n".join(line for line, _ in lines))
    sys.exit(0 if all(good for _, good in lines) else 1)


if __name__ == "__main__":
    main()
