"""Releases that broke others, asked of a registry before they are made: `python benchmarks/registry_replay.py`.

    python benchmarks/registry_replay.py --clones DIR [--write ROWS] [--jobs N]

`registry_replay/cases.yaml` names releases and the lines that they broke. The state before (the provider's old release
and all consumers of all cases) is published to one registry; then `impact` is asked for each new release from its
sources. Printed are broken packages and lines that are named, and how much of what is named is true by
`registry_replay/judged.yaml`. `--write` writes what is named and not judged yet. Status 1 below the figure.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec

FOLDER = Path(__file__).parent / "registry_replay"
PROGRAM = [str(Path(sys.executable).with_name("ecm-extract"))]
FIGURE = 0.80


class Broken(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A package that the release broke: where it is, at which commit, and the lines that break."""

    repository: str
    ref: str
    package: str
    lines: tuple[str, ...]


class Case(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A release of a package, and whom it broke; `thread` is where that is told."""

    thread: str
    provider: str
    package: str
    before: str
    after: str
    change: str
    broken: tuple[Broken, ...]


class NotTaken(msgspec.Struct, frozen=True):
    """A thread that is no case, and why."""

    thread: str
    why: str


class Cases(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The choice."""

    cases: tuple[Case, ...]
    not_taken: tuple[NotTaken, ...] = ()


class Named(msgspec.Struct, frozen=True):
    """A line that impact names, and what it says of it."""

    thread: str
    package: str
    line: str
    what: str
    severity: str


class Judged(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a person read in the source: whether the line really breaks, and why or why not."""

    thread: str
    package: str
    line: str
    breaks: bool
    why: str


class _Line(msgspec.Struct, frozen=True):
    path: str
    line: int
    what: str


class _User(msgspec.Struct, frozen=True):
    package: str
    lines: tuple[_Line, ...]


class _Break(msgspec.Struct, frozen=True):
    severity: str
    users: tuple[_User, ...]


class _Impact(msgspec.Struct, frozen=True):
    breaks: tuple[_Break, ...]


def main() -> int:
    """Replay, and print what was found."""
    wanted = _arguments()
    cases = msgspec.yaml.decode((FOLDER / "cases.yaml").read_bytes(), type=Cases).cases
    with tempfile.TemporaryDirectory() as folder:
        os.environ["ECM_REGISTRY"] = str(Path(folder) / "registry.sqlite")
        _store(cases, wanted)
        named = [each for case in cases for each in _named(case, wanted)]
    if wanted.write:
        _write(named, Path(wanted.write))
    return _report(cases, named)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--clones", type=Path, required=True, help="folder with OWNER+NAME/repo")
    parser.add_argument("--write", metavar="FILE", help="write lines that nobody has judged")
    parser.add_argument("--jobs", default="2")
    return parser.parse_args()


def _store(cases: Sequence[Case], wanted: argparse.Namespace) -> None:
    """The state before: consumers of every case, so that each release is asked of all of them."""
    _run(["registry", "init"])
    places = {(each.provider, each.before) for each in cases}
    places |= {(one.repository, one.ref) for each in cases for one in each.broken}
    for repository, ref in sorted(places):
        _run(["registry", "publish", f"{_clone(repository, wanted)}@{ref}", "--jobs", wanted.jobs])


def _clone(repository: str, wanted: argparse.Namespace) -> Path:
    return Path(wanted.clones) / repository.replace("/", "+") / "repo"


def _named(case: Case, wanted: argparse.Namespace) -> Iterator[Named]:
    """What impact names in packages of others."""
    answer = _run(["impact", case.package, f"{_clone(case.provider, wanted)}@{case.after}", "--format", "json"])
    found = msgspec.json.decode(answer, type=_Impact)
    for each in found.breaks:
        for user in each.users:
            for at in user.lines:
                if user.package != case.package:
                    yield Named(case.thread, user.package, f"{at.path}:{at.line}", at.what, each.severity)


def _run(words: Sequence[str]) -> bytes:
    done = subprocess.run([*PROGRAM, *words], capture_output=True, check=False)
    if done.returncode not in {0, 1}:
        sys.exit(f"{' '.join(words)}: {done.stderr.decode(errors='replace')}")
    return done.stdout


def _report(cases: Sequence[Case], named: Sequence[Named]) -> int:
    said = {(each.thread, each.package, each.line) for each in named if each.severity != "info"}
    packages = lines = found_packages = found_lines = 0
    for case in cases:
        for one in case.broken:
            hit = [at for at in one.lines if (case.thread, one.package, at) in said]
            packages, lines = packages + 1, lines + len(one.lines)
            found_packages, found_lines = found_packages + bool(hit), found_lines + len(hit)
            print(f"{len(hit)}/{len(one.lines)} lines  {one.package}  ({case.package} {case.after}, {case.thread})")
    print(f"broken packages named by a line that breaks: {found_packages} of {packages}")
    print(f"lines that break and are named: {found_lines} of {lines}")
    _report_truth(cases, said)
    return int(found_packages < FIGURE * packages)


def _report_truth(cases: Sequence[Case], said: set[tuple[str, str, str]]) -> None:
    known = {(each.thread, one.package, at): True for each in cases for one in each.broken for at in one.lines}
    known |= {(each.thread, each.package, each.line): each.breaks for each in _judged()}
    judged = [known[each] for each in said if each in known]
    print(f"of {len(said)} lines named, {len(judged)} are judged, {sum(judged)} of these true")


def _judged() -> tuple[Judged, ...]:
    file = FOLDER / "judged.yaml"
    return msgspec.yaml.decode(file.read_bytes(), type=tuple[Judged, ...]) if file.is_file() else ()


def _write(named: Sequence[Named], file: Path) -> None:
    known = {(each.thread, each.package, each.line) for each in _judged()}
    left = [each for each in named if (each.thread, each.package, each.line) not in known]
    file.write_bytes(msgspec.yaml.encode(left))


if __name__ == "__main__":
    sys.exit(main())
