"""Recall and precision against documented nodes: `python benchmarks/accuracy.py TRUTH CLONES_DIR`.

TRUTH is a file of benchmarks/truth or the folder. Each difference is printed on a line:
`-` documented and not extracted, `+` extracted and in no document, `~` extracted with another type or only as
a pattern, `o` in the code but in no document (right), `x` in the document but not in the code (not counted).
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator
from pathlib import Path

import msgspec
from extracted import Extraction, Interface, Package, extract
from truth_format import Row, Truth, covered, load, same_name, same_type

TARGET = 0.95
ENDPOINTS = {
    "publisher", "subscriber", "service_server", "service_client", "action_server", "action_client",
}  # fmt: skip
FRAMEWORK = {
    "/diagnostics", "/tf", "/tf_static", "/rosout", "/parameter_events", "/clock", "use_sim_time", "/bond",
}  # fmt: skip
"""What the middleware and its libraries add to every node, which documents of a node leave out."""


class Score(msgspec.Struct, frozen=True):
    """Counts of one group (endpoints, or parameters)."""

    documented: int = 0
    found: int = 0
    by_pattern: int = 0
    typed: int = 0
    type_right: int = 0
    extracted: int = 0
    right: int = 0

    def plus(self, other: Score) -> Score:
        """The sum of two groups."""
        return Score(*(mine + its for mine, its in zip(_values(self), _values(other), strict=True)))

    @property
    def recall(self) -> float:
        """Share of what is documented (and in the code) that was extracted, patterns included."""
        return self.found / self.documented if self.documented else 1.0

    @property
    def precision(self) -> float:
        """Share of what was extracted, in the roles that are documented in full, that is right."""
        return self.right / self.extracted if self.extracted else 1.0


def _values(score: Score) -> tuple[int, ...]:
    return msgspec.structs.astuple(score)


def of_node(truth: Truth, extraction: Extraction) -> tuple[list[Interface], str]:
    """The interfaces of the node, once each, and how they were chosen."""
    package = next((one for one in extraction.packages if one.name == truth.package), None)
    if package is None:
        return [], f"no package {truth.package} in the extraction"
    chosen = [module for module in package.modules if re.search(truth.module, module.ecm.module_id)]
    if chosen:
        found = [interface for module in chosen for interface in module.signature.interfaces]
        return _once(found), "modules " + ", ".join(module.ecm.module_id for module in chosen)
    return _once(_of_files(package, truth.files)), f"files, since no module is called {truth.module}"


def _of_files(package: Package, files: list[str]) -> Iterator[Interface]:
    for module in package.modules:
        for interface in module.signature.interfaces:
            if any(_stands_in(place.path, file) for place in interface.evidence for file in files):
                yield interface


def _stands_in(path: str, file: str) -> bool:
    """Whether a path is a file, or lies below it where that is a folder, which ends with a slash."""
    return f"/{file}" in f"/{path}" if file.endswith("/") else path.endswith(file)


def _once(interfaces: Iterator[Interface] | list[Interface]) -> list[Interface]:
    return list({(one.role, one.name or one.raw_name): one for one in interfaces}.values())


def _names(one: Interface) -> tuple[str, ...]:
    return one.name, one.raw_name


def match_row(row: Row, interfaces: list[Interface]) -> tuple[Interface | None, bool]:
    """The interface that a row names, and whether only by its pattern."""
    fitting = [one for one in interfaces if one.role == row.role]
    exact = [one for one in fitting if same_name(row.name, _names(one))]
    if exact:
        return max(exact, key=lambda one: bool(row.type and one.type and same_type(row.type, one.type))), False
    loose = [one for one in fitting if covered(row.name, _names(one))]
    return (loose[0], True) if loose else (None, False)


def is_framework(one: Interface) -> bool:
    return any(same_name(known, _names(one)) for known in FRAMEWORK) or one.role.startswith("tf_")


class Comparison:
    """One node against its document; collects the lines of the report."""

    def __init__(self, truth: Truth, interfaces: list[Interface]) -> None:
        self.truth = truth
        self.interfaces = interfaces
        self.lines: list[str] = []

    def score(self, roles: set[str]) -> Score:
        """Compare the rows of some roles."""
        rows = [row for row in self.truth.interfaces if row.role in roles]
        total = Score()
        for row in rows:
            total = total.plus(self._recall(row))
        for one in self.interfaces:
            if one.role in roles and one.role in self.truth.complete and not is_framework(one):
                total = total.plus(self._precision(one))
        return total

    def _recall(self, row: Row) -> Score:
        one, loose = match_row(row, self.interfaces)
        if one is None:
            self._say("-", row.role, row.name, row.type)
            return Score(documented=1)
        if loose:
            self._say("~", row.role, row.name, row.type, f"as pattern {one.name or one.raw_name}")
        typed = row.type is not None
        right = bool(row.type and one.type and same_type(row.type, one.type))
        if typed and not right:
            self._say("~", row.role, row.name, row.type, f"extracted type {one.type}")
        return Score(documented=1, found=1, by_pattern=int(loose), typed=int(typed), type_right=int(right))

    def _precision(self, one: Interface) -> Score:
        for row in self.truth.interfaces:
            if match_row(row, [one])[0]:
                return Score(extracted=1, right=1)
        for row in self.truth.undocumented:
            if match_row(row, [one])[0]:
                self._say("o", row.role, row.name, row.type, row.where or "")
                return Score(extracted=1, right=1)
        place = f"{one.evidence[0].path}:{one.evidence[0].line}" if one.evidence else "no evidence"
        self._say("+", one.role, one.name or one.raw_name, one.type, place)
        return Score(extracted=1)

    def _say(self, mark: str, role: str, name: str, kind: str | None, more: str = "") -> None:
        self.lines.append(f"  {mark} {role} {name} [{kind or '-'}] {more}".rstrip())


def _line(label: str, score: Score) -> str:
    return (
        f"  {label:11} recall {score.found}/{score.documented} = {score.recall:.3f} "
        f"({score.by_pattern} by pattern), type right {score.type_right}/{score.typed}, "
        f"precision {score.right}/{score.extracted} = {score.precision:.3f}"
    )


def report(truth: Truth, extraction: Extraction) -> tuple[Score, Score]:
    """Print one node; return its scores for endpoints and for parameters."""
    interfaces, how = of_node(truth, extraction)
    comparison = Comparison(truth, interfaces)
    endpoints, parameters = comparison.score(ENDPOINTS), comparison.score({"parameter"})
    print(f"{truth.node} ({truth.tree} at {truth.commit[:10]}): {how}")
    print(_line("endpoints", endpoints))
    print(_line("parameters", parameters))
    for row in truth.absent:
        comparison.lines.append(f"  x {row.role} {row.name}: {row.where or 'not in the code'}")
    print("\n".join([*comparison.lines, *(f"  note: {note}" for note in truth.notes)]))
    return endpoints, parameters


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("truth", type=Path, help="a file or the folder benchmarks/truth")
    parser.add_argument("clones", type=Path, help="folder with one work tree per `tree` of the truth files")
    parser.add_argument("--extraction", type=Path, metavar="FILE", help="JSON that ecm-extract wrote before")
    return parser.parse_args()


def main() -> None:
    """Run the benchmark; status 1 when recall or precision of the whole is under the target."""
    options = _arguments()
    files = sorted(options.truth.glob("*.yaml")) if options.truth.is_dir() else [options.truth]
    endpoints, parameters = Score(), Score()
    read: dict[str, Extraction] = {}
    for truth in map(load, files):
        if not (options.clones / truth.tree).is_dir():
            print(f"{truth.node}: skipped, {options.clones / truth.tree} is not there (check out {truth.ref})")
            continue
        if truth.tree not in read:
            read[truth.tree] = extract(options.clones / truth.tree, options.extraction)
        mine = report(truth, read[truth.tree])
        endpoints, parameters = endpoints.plus(mine[0]), parameters.plus(mine[1])
    both = endpoints.plus(parameters)
    print("ALL\n" + "\n".join([_line("endpoints", endpoints), _line("parameters", parameters), _line("both", both)]))
    sys.exit(0 if both.documented and min(both.recall, both.precision) >= TARGET else 1)


if __name__ == "__main__":
    main()
