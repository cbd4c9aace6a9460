"""Our reading of CMake against CMake itself: `python benchmarks/judge_cmake.py [--count 500] [--seed 0]`.

Projects of our own are made by a seed and configured by the real program over stub packages; nobody's tree is. Told
are targets with their sources and install rules: equal, wrong, missing, and what our reader says it does not know.
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from fnmatch import fnmatch
from pathlib import Path
from posixpath import join, normpath

from cmake_oracle import Oracle, Truth
from cmake_projects import Project, make

from ecm_extract.read.reader import Reader
from ecm_extract.tree import open_tree

SHOWN = 60
_SUFFIXES = ("", ".cpp")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--fixtures", type=Path, help="judge the packages below this folder instead")
    parser.add_argument("--keep", type=Path, help="keep the projects here")
    parser.add_argument("--recorded", type=Path, help="folder of what CMake said, asked once and read again")
    arguments = parser.parse_args()
    program = _program()
    if program is None:
        print("cmake is not installed: pip install 'ecm-extract[judges]'")
        return 0
    with tempfile.TemporaryDirectory() as place:
        report = Report()
        if arguments.fixtures is not None:
            return judge_fixtures(arguments.fixtures, Oracle(program, Path(place)), report)
        oracle = Recorded(Oracle(program, Path(place)), arguments.recorded)
        seed = arguments.seed
        while report.projects < arguments.count:
            folder = (arguments.keep or Path(place)) / f"project_{seed}"
            write(make(seed), folder)
            report.judge(seed, oracle.ask(seed, folder), folder)
            seed += 1
    return report.print()


def judge_fixtures(folder: Path, oracle: Oracle, report: Report) -> int:
    """Judge copies of our own packages; what CMake refuses for want of a package is counted."""
    for source in sorted(
        path.parent for path in folder.rglob("CMakeLists.txt") if (path.parent / "package.xml").exists()
    ):
        copy = oracle.folder / "fixture"
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(source, copy)
        report.judge(str(source.relative_to(folder)), oracle.ask(copy, is_fixture=True), copy)
    return report.print()


def _program() -> str | None:
    beside = Path(sys.executable).parent / "cmake"
    return str(beside) if beside.exists() else shutil.which("cmake")


def write(project: Project, folder: Path) -> None:
    """Put the files of a project into a folder."""
    for path, text in project.files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)


class Recorded:
    """An oracle whose answers are kept by seed."""

    def __init__(self, oracle: Oracle, folder: Path | None) -> None:
        self._oracle = oracle
        self._folder = folder

    def ask(self, seed: int, source: Path) -> Truth | str:
        """What CMake says of the project of a seed."""
        kept = self._folder / f"{seed}.json" if self._folder is not None else None
        if kept is not None and kept.exists():
            document = json.loads(kept.read_text())
            return document if isinstance(document, str) else Truth.of(document)
        truth = self._oracle.ask(source)
        if kept is not None:
            kept.parent.mkdir(parents=True, exist_ok=True)
            text = json.dumps(truth if isinstance(truth, str) else truth.document())
            kept.write_text(text.replace(f"{self._oracle.folder}/", ""))  # the folder is another one each time
        return truth


class Report:
    """Counts by kind and outcome, and a line for each difference."""

    def __init__(self) -> None:
        self.projects = 0
        self.refused = 0
        self.counts: Counter[tuple[str, str]] = Counter()
        self.lines: list[str] = []

    def judge(self, seed: int | str, truth: Truth | str, folder: Path) -> None:
        """Compare one project; those that CMake refuses are only counted."""
        if isinstance(truth, str):
            self.refused += 1
            return
        self.projects += 1
        told = told_of(folder)
        for kind in ("target", "install"):
            for outcome, text in compare(kind, told, truth):
                self.counts[kind, outcome] += 1
                if outcome != "equal":
                    self.lines.append(f"{outcome}: {kind} of project {seed}: {text}")

    def print(self) -> int:
        print(f"{self.projects} projects, {self.refused} more refused by CMake itself")
        for kind in ("target", "install"):
            found = {outcome: count for (each, outcome), count in self.counts.items() if each == kind}
            total = sum(found.values())
            print(
                f"{kind}s: " + ", ".join(f"{outcome} {count} ({count / total:.2%})" for outcome, count in found.items())
            )
        print("\n".join(self.lines[:SHOWN]))
        bad = sum(count for (_, outcome), count in self.counts.items() if outcome in {"wrong", "missing"})
        return 1 if bad else 0


class Told:
    """What our reader says of a build without settings; names, sources and rules that it does not know are open."""

    def __init__(self) -> None:
        self.targets: dict[str, frozenset[str]] = {}
        self.open_targets: set[str] = set()
        self.installs: set[tuple[str, str, str]] = set()
        self.open_installs: set[tuple[str, str, str]] = set()
        self.is_open = False


def told_of(folder: Path) -> Told:
    """Read a project with the reader that is judged."""
    (package,) = Reader(open_tree(folder), cached=False).read(1)
    told = Told()
    listed = {entry.path for entry in package.root.files}
    for path, file in package.cmake.items():
        base = path.rpartition("/")[0]
        told.is_open = told.is_open or bool(file.unknown or file.foreign)
        told.is_open = told.is_open or any("$" in target.name for target in file.targets)
        for target in (each for each in file.targets if each.kind != "interface"):
            if target.by_default is None or target.is_open or "$" in target.name:
                told.open_targets.add(target.name)
            elif target.by_default:
                sources = tuple(source for source in target.sources if source not in target.optional)
                told.targets[target.name] = frozenset(_files(sources, base, listed))
        for rule in file.installs:
            if rule.by_default is False:
                continue
            kind = {"programs": "files", "python": "files"}.get(rule.kind, rule.kind)
            for item in rule.items:
                slash = "/" if item.endswith("/") else ""
                paths = _files((item,), base, listed) if kind == "files" else [normpath(join(base, item)) + slash]
                names = [item] if kind == "targets" else paths
                rules = told.installs if rule.by_default else told.open_installs
                rules |= {(kind, name, rule.destination) for name in names}
    return told


def _files(items: tuple[str, ...], base: str, listed: set[str]) -> Iterator[str]:
    for item in items:
        path = item if item.startswith("${") else normpath(join(base, item))
        if "*" in path or "[" in path:
            yield from (name for name in listed if fnmatch(name, path))
        else:
            yield next((path + suffix for suffix in _SUFFIXES if path + suffix in listed), path)


def compare(kind: str, told: Told, truth: Truth) -> Iterator[tuple[str, str]]:
    """Yield an outcome and what it is about for each target or install rule."""
    if kind == "target":
        yield from _targets(told, truth)
        return
    for rule in sorted(told.installs | truth.installs):
        if "$" in "".join(rule) or (rule in truth.installs - told.installs and rule in told.open_installs):
            yield "unknown", str(rule)
        elif rule in told.installs and rule in truth.installs:
            yield "equal", ""
        elif rule in told.installs:
            yield "wrong", f"told {rule}"
        else:
            yield "unknown" if told.is_open else "missing", str(rule)


def _targets(told: Told, truth: Truth) -> Iterator[tuple[str, str]]:
    for name in sorted(told.targets.keys() | truth.targets.keys()):
        said = told.targets.get(name)
        if said is None and name in told.open_targets:
            yield "unknown", name
        elif name not in truth.targets:
            yield "wrong", f"{name} is told and not built"
        elif said is None:
            yield (
                "unknown" if told.is_open else "missing",
                f"{name} ({truth.targets[name].place}) of {sorted(truth.targets[name].sources)}",
            )
        elif said != truth.targets[name].sources:
            yield (
                "wrong",
                f"{name} ({truth.targets[name].place}) has {sorted(truth.targets[name].sources)}, told {sorted(said)}",
            )
        else:
            yield "equal", ""


if __name__ == "__main__":
    raise SystemExit(main())
