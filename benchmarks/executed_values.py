"""Are values what programs do? `python benchmarks/executed_values.py [--programs N] [--seed S] [--language L]`.

Programs are drawn (executed/), run for real with python or g++, once without and once with an argument, and read by
the tool. For each line that made publishers:

* contained: each name that the runs made there is one that the tool tells, or fits one of its patterns;
* folded right: each name that the tool calls literal or folded there was made;
* told: where the runs made one name, the tool tells that one and no other, without saying `one of`.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from executed.combined import programs as combined_programs
from executed.draw import Program
from executed.grammar import grammar
from executed.written import programs as written_programs

from ecm_extract.link.declaring.forms import form_table
from ecm_extract.link.linker import Linker
from ecm_extract.read.reader import Reader
from ecm_extract.tree import open_tree

BATCH = 25
SECONDS = 60
STUBS = Path(__file__).parent / "executed" / "stubs"
_MANIFEST = (
    '<package format="3"><name>drawn</name><version>1.0.0</version>'
    "<export><build_type>ament_{kind}</build_type></export></package>"
)
_SURE = {"literal", "folded"}
_HOLE = re.compile(r"\{[^{}]*\}")
Place = tuple[str, int]
Made = dict[Place, set[tuple[str, frozenset[int]]]]
"""Place -> the names that were made there, each with the lines of the calls that led to it."""


@dataclass(frozen=True)
class Told:
    """A name that the tool tells of a line, with the lines of the calls that it came through."""

    name: str
    confidence: str
    lines: frozenset[int]


@dataclass(frozen=True)
class Judged:
    """One line of a program: what was made there, and what was told."""

    place: Place
    calls: frozenset[tuple[str, frozenset[int]]]
    told: tuple[Told, ...]

    @property
    def made(self) -> set[str]:
        return {name for name, _ in self.calls}

    @property
    def contained(self) -> bool:
        return all(any(_means(told, name) for told in self.told) for name in self.made)

    @property
    def sure(self) -> bool:
        return any(told.confidence in _SURE for told in self.told)

    @property
    def right(self) -> bool:
        return all(self._happened(told) for told in self.told if told.confidence in _SURE)

    def _happened(self, told: Told) -> bool:
        """Whether the name was made; calls that did not run tell nothing."""
        names = {name for name, lines in self.calls if told.lines <= lines}
        return not names or told.name in names

    @property
    def exact(self) -> bool:
        ran = [told for told in self.told if any(told.lines <= lines for _, lines in self.calls)]
        return {told.name for told in ran} == self.made and all(told.confidence in _SURE for told in ran)


def _means(told: Told, name: str) -> bool:
    if "{" not in told.name:
        return told.name == name
    parts = _HOLE.split(told.name)
    written = (name, f"/{name}", f"{name}/")  # what is unknown may be empty, and a `/` at an end is dropped
    return any(_follow(parts, each) for each in written)


def _follow(parts: Sequence[str], name: str) -> bool:
    """Whether a name has some texts in their order, the first at its beginning and the last at its end."""
    first, *between, last = parts
    at, end = len(first), len(name) - len(last)
    if end < at or not name.startswith(first) or not name.endswith(last):
        return False
    for part in between:
        found = name.find(part, at, end)
        if found < 0:
            return False
        at = found + len(part)
    return True


def _resolved(name: str) -> str:
    """A name in `/`, as the contract has it."""
    name = re.sub("/+", "/", f"/{name}")
    return name.rstrip("/") or "/"


def extracted(root: Path) -> Mapping[Place, tuple[Told, ...]]:
    """What the tool tells of each line that makes a publisher, by the name of the file."""
    packages = Reader(open_tree(root), False, (), False).read(1, None)
    found: dict[Place, dict[Told, None]] = defaultdict(dict)
    for module in Linker(packages, form_table()).link():
        for entry in module.lines:
            if entry.role == "publisher":
                last = entry.evidence[-1]
                lines = frozenset(place.line for place in entry.evidence)
                found[Path(last.path).name, last.line][Told(entry.name, entry.confidence, lines)] = None
    return {place: tuple(told) for place, told in found.items()}


def written(root: Path, files: Mapping[str, str]) -> None:
    for path, text in files.items():
        target = root / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, "utf-8")


def printed(text: str) -> Made:
    made: Made = defaultdict(set)
    for line in text.splitlines():
        path, numbers, name = line.split("\t", 2)
        lines = [int(number) for number in numbers.split(",")]
        if name:
            made[path, lines[-1]].add((_resolved(name), frozenset(lines)))
    return made


def drawn(language: str, seeds: Sequence[str]) -> Mapping[str, str]:
    """Draw programs, by the names of their files; those of C++ have a namespace of that name."""
    rules = grammar(language)
    if language == "python":
        return {f"p{at}_{seed}": Program(seed, rules).source() for at, seed in enumerate(seeds)}
    return {f"p{at}": Program(seed, rules, f"p{at}").source() for at, seed in enumerate(seeds)}


def python_batch(root: Path, programs: Mapping[str, str]) -> tuple[Path, Made]:
    """Write programs, run each, return the folder of the package and what the runs made."""
    package, stubs = root / "package", root / "stubs"
    sources = {f"drawn/{name}.py": text for name, text in programs.items()}
    written(package, {**sources, "package.xml": _MANIFEST.format(kind="python"), "drawn/__init__.py": ""})
    entries = ", ".join(f"'p{at} = drawn.{name}:main'" for at, name in enumerate(programs))
    setup = f"from setuptools import setup\nsetup(name='drawn', entry_points={{'console_scripts': [{entries}]}})\n"
    written(package, {"setup.py": setup})
    shutil.copytree(STUBS / "python", stubs)
    made: Made = defaultdict(set)
    for path in sources:
        for more in ((), ("x",)):
            line = [sys.executable, "-B", str(package / path), *more]
            done = subprocess.run(
                line, capture_output=True, text=True, timeout=SECONDS, check=False, env={"PYTHONPATH": str(stubs)}
            )
            for place, names in printed(done.stdout).items():
                made[place] |= names
    return package, made


def cpp_batch(root: Path, programs: Mapping[str, str]) -> tuple[Path, Made]:
    """The same in C++; the programs of a batch are compiled as one and run one by one."""
    package, stubs = root / "package", root / "stubs"
    spaces = list(programs)
    sources = {f"src/{space}.cpp": text for space, text in programs.items()}
    targets = "\n".join(f"add_executable({space} src/{space}.cpp)" for space in spaces)
    cmake = f"cmake_minimum_required(VERSION 3.8)\nproject(drawn)\n{targets}\n"
    written(package, {**sources, "package.xml": _MANIFEST.format(kind="cmake"), "CMakeLists.txt": cmake})
    shutil.copytree(STUBS / "cpp", stubs)
    includes = "\n".join(f'#include "{package}/src/{space}.cpp"' for space in spaces)
    calls = "\n".join(
        f"if (which == {n}) try {{ {space}::run(argc - 1); }} catch (...) {{}}" for n, space in enumerate(spaces)
    )
    driver = f"{includes}\nint main(int argc, char ** argv) {{ int which = std::atoi(argv[1]); {calls} }}\n"
    written(root, {"driver.cpp": driver})
    program = root / "driver"
    line = ["g++", "-std=c++17", "-O0", "-w", "-DBATCH", f"-I{stubs}", str(root / "driver.cpp"), "-o", str(program)]
    built = subprocess.run(line, capture_output=True, text=True, check=False)
    if built.returncode:
        sys.exit(f"g++ refused a drawn program, mend executed/cpp.toml:\n{built.stderr[:3000]}")
    made: Made = defaultdict(set)
    for number in range(len(spaces)):
        for more in ((), ("x",)):
            done = subprocess.run(
                [str(program), str(number), *more], capture_output=True, text=True, timeout=SECONDS, check=False
            )
            for place, names in printed(done.stdout).items():
                made[place] |= names
    return package, made


BATCHES = {"python": python_batch, "cpp": cpp_batch}


def judged(language: str, seeds: Sequence[str], keep: Path | None = None) -> Iterator[Judged]:
    """Draw programs from seeds, run and read them, and yield every line that made a publisher."""
    for start in range(0, len(seeds), BATCH):
        with tempfile.TemporaryDirectory() as folder:
            root = keep / f"{language}{start}" if keep else Path(folder)
            yield from _of_batch(language, root, drawn(language, seeds[start : start + BATCH]))


def judged_written(language: str) -> Iterator[Judged]:
    """Run and read the programs that people wrote, each alone."""
    for program in written_programs(language):
        with tempfile.TemporaryDirectory() as folder:
            for line in _of_batch(language, Path(folder), {"p0": program.text}):
                yield replace(line, place=(f"{program.name}, {line.place[0]}", line.place[1]))


def judged_combined(language: str, number: int, seed: str) -> Iterator[Judged]:
    """Run and read programs that combine what holds a text, what changes it and who reads it."""
    combined = combined_programs(language, number, seed)
    for start in range(0, len(combined), BATCH):
        batch = {f"p{at}": program for at, program in enumerate(combined[start : start + BATCH], start)}
        with tempfile.TemporaryDirectory() as folder:
            for line in _of_batch(language, Path(folder), {name: each.text for name, each in batch.items()}):
                told = tuple([replace(each, lines=frozenset()) for each in line.told])  # each place is run once
                yield replace(line, place=(batch[Path(line.place[0]).stem].name, line.place[1]), told=told)


def _of_batch(language: str, root: Path, programs: Mapping[str, str]) -> Iterator[Judged]:
    package, made = BATCHES[language](root, programs)
    told = extracted(package)
    for place in sorted(made):
        yield Judged(place, frozenset(made[place]), told.get(place, ()))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=int, default=300)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--language", choices=("python", "cpp", "both"), default="both")
    parser.add_argument("--show", type=int, default=0, help="lines that are wrong, at most so many")
    parser.add_argument("--keep", type=Path, help="folder for the drawn programs")
    parser.add_argument("--written", action="store_true", help="run the programs of executed/written instead")
    parser.add_argument("--combined", type=int, help="run so many combinations of executed/combined instead")
    asked = parser.parse_args()
    for language in BATCHES if asked.language == "both" else (asked.language,):
        if asked.written:
            _report(language, list(judged_written(language)), asked.show)
            continue
        if asked.combined:
            _report(language, list(judged_combined(language, asked.combined, asked.seed)), asked.show)
            continue
        seeds = [f"{asked.seed}_{number}" for number in range(asked.programs)]
        _report(language, list(judged(language, seeds, asked.keep)), asked.show)


def _report(language: str, lines: Sequence[Judged], show: int) -> None:
    single = [line for line in lines if len(line.made) == 1]
    sure = [line for line in lines if line.sure]
    print(f"{language}: {len(lines)} lines, {len(single)} with one name")
    for title, part, whole in (
        ("contained", [line for line in lines if line.contained], lines),
        ("folded right", [line for line in sure if line.right], sure),
        ("told", [line for line in single if line.exact], single),
        ("all told", [line for line in lines if line.exact], lines),
    ):
        print(f"  {title:12} {100 * len(part) / max(1, len(whole)):6.2f} %  ({len(part)} of {len(whole)})")
    wrong = [line for line in lines if not line.contained or not line.right]
    for line in (wrong or [line for line in single if not line.exact])[:show]:
        print("   ", line.place, sorted(line.made), [(told.name, told.confidence) for told in line.told])


if __name__ == "__main__":
    main()
