"""How much of nodes that nobody here had read is told: `python benchmarks/unseen.py truth_unseen CLONES_DIR`.

The truth was written from the sources before the first run. Each difference is a line: `-` in the source and not
extracted, `+` extracted and not in the source, `~` extracted otherwise, `t` the name right and the type wrong, `o`
added by a library (not counted).
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import msgspec
from accuracy import ENDPOINTS, is_framework
from extracted import Extraction, Interface, extract
from truth_format import same_name, same_type
from unseen_format import SourceNode, SourceRow, load, resolved
from unseen_match import best


class Share(msgspec.Struct):
    """So many of so many."""

    right: int = 0
    of: int = 0

    def count(self, right: bool) -> None:
        """Count one."""
        self.of += 1
        self.right += int(right)

    def __str__(self) -> str:
        percent = f"{100 * self.right / self.of:.1f} %" if self.of else "none asked"
        return f"{self.right}/{self.of} = {percent}"


class Tally(msgspec.Struct):
    """What is counted of rows."""

    endpoints: Share = msgspec.field(default_factory=Share)
    parameters: Share = msgspec.field(default_factory=Share)
    types: Share = msgspec.field(default_factory=Share)
    names: Share = msgspec.field(default_factory=Share)
    qos: Share = msgspec.field(default_factory=Share)
    defaults: Share = msgspec.field(default_factory=Share)
    true: Share = msgspec.field(default_factory=Share)
    typed: Share = msgspec.field(default_factory=Share)

    def add(self, other: Tally) -> None:
        """Add the counts of another one."""
        for name in self.__struct_fields__:
            mine, its = getattr(self, name), getattr(other, name)
            mine.right += its.right
            mine.of += its.of

    def lines(self) -> Iterator[str]:
        """One line a figure."""
        words = {
            "endpoints": "endpoints found",
            "parameters": "parameters found",
            "types": "types right (of rows found)",
            "names": "names told where a reader could",
            "qos": "QoS right (of rows whose source decides it)",
            "defaults": "defaults right (of literal ones)",
            "true": "rows true",
            "typed": "rows true in their type too",
        }
        return (f"  {label:44} {getattr(self, name)}" for name, label in words.items())


def of_files(node: SourceNode, extraction: Extraction) -> list[Interface]:
    """The interfaces of the node's package with evidence in the node's files, once each."""
    return _once(
        one
        for package in extraction.packages
        if package.name == node.package
        for module in package.modules
        for one in module.signature.interfaces
        if _is_of(node, one, package.path)
    )


def _is_of(node: SourceNode, one: Interface, folder: str) -> bool:
    """Whether evidence stands in a file of the node's own, or all of it in files that it shares with others."""
    files = set(node.files)
    met = [({place.path, f"{folder}/{place.path}".lstrip("./")} & files) for place in one.evidence]
    return any(paths - set(node.shared) for paths in met) or (bool(met) and all(met))


def _once(interfaces: Iterator[Interface]) -> list[Interface]:
    return list({(one.role, one.name or one.raw_name, one.type): one for one in interfaces}.values())


class Comparison:
    """One node against its source; collects the lines of the report."""

    def __init__(self, node: SourceNode, interfaces: list[Interface]) -> None:
        self.node = node
        self.interfaces = interfaces
        self.tally = Tally()
        self.lines: list[str] = []

    def run(self) -> None:
        """Compare every row of both sides."""
        for row in self.node.interfaces:
            self._asked(row)
        for one in self.interfaces:
            if (one.role in ENDPOINTS or one.role == "parameter") and not is_framework(one):
                self._told(one)

    def _asked(self, row: SourceRow) -> None:
        one = best(row, self.interfaces, self.node)
        found = self.tally.parameters if row.role == "parameter" else self.tally.endpoints
        found.count(one is not None)
        if one is None:
            self._say("-", row, "")
        self._fields(row, one)

    def _fields(self, row: SourceRow, one: Interface | None) -> None:
        if "{" not in row.name:
            self._field(row, self.tally.names, one is not None and self._same_place(row, one), f"name {_name(one)}")
        if row.qos:
            told = (one.qos if one else None) or {}
            right = all(told.get(policy) == value for policy, value in row.qos.items())
            self._field(row, self.tally.qos, right, f"QoS {told}")
        if row.default is not None:
            told_default = one.default if one else None
            self._field(row, self.tally.defaults, told_default == row.default, f"default {told_default!r}")
        if row.type and one:
            self._field(row, self.tally.types, bool(one.type and same_type(row.type, one.type)), f"type {one.type}")

    def _field(self, row: SourceRow, share: Share, right: bool, told: str) -> None:
        share.count(right)
        if not right and best(row, self.interfaces, self.node):
            self._say("~", row, told)

    def _same_place(self, row: SourceRow, one: Interface) -> bool:
        if row.role == "parameter":
            return same_name(row.name, (one.name, one.raw_name))
        return resolved(row.name, self.node.name) == resolved(one.name, self.node.name)

    def _told(self, one: Interface) -> None:
        fitting = [row for row in self.node.interfaces if best(row, [one], self.node)]
        if fitting:
            self.tally.true.count(right=True)
            self._told_type(fitting, one)
            return
        added = next((row for row in self.node.also if best(row, [one], self.node)), None)
        if added is not None:
            self._say("o", added, "")
            return
        self.tally.true.count(right=False)
        self.tally.typed.count(right=False)
        place = f"{one.evidence[0].path}:{one.evidence[0].line}"
        self.lines.append(f"  + {one.role} {_name(one)} [{one.type or '-'}] {place}")

    def _told_type(self, fitting: list[SourceRow], one: Interface) -> None:
        """One name told with several types is several rows, and those of a type that the source has not are false."""
        right = any(not row.type or not one.type or same_type(row.type, one.type) for row in fitting)
        self.tally.typed.count(right)
        if not right:
            place = f"{one.evidence[0].path}:{one.evidence[0].line}"
            self.lines.append(f"  t {one.role} {_name(one)} [{one.type}] {place}")

    def _say(self, mark: str, row: SourceRow, told: str) -> None:
        self.lines.append(f"  {mark} {row.role} {row.name} [{row.type or '-'}] {row.where} {told}".rstrip())


def _name(one: Interface | None) -> str:
    return (one.name or one.raw_name) if one else ""


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("truth", type=Path, help="a file or the folder benchmarks/truth_unseen")
    parser.add_argument("clones", type=Path, help="folder with one work tree per `tree` of the truth files")
    parser.add_argument(
        "--saved", type=Path, metavar="DIR", help="keep extractions here as TREE.json, and use those there"
    )
    return parser.parse_args()


def main() -> None:
    """Run the benchmark over every repository whose checkout is there."""
    options = _arguments()
    total = Tally()
    for path in sorted(options.truth.glob("*.yaml")) if options.truth.is_dir() else [options.truth]:
        truth = load(path)
        if not (options.clones / truth.tree).is_dir():
            print(f"{truth.repository}: skipped, no {options.clones / truth.tree} (check out {truth.commit})")
            continue
        kept = options.saved / f"{truth.tree}.json" if options.saved else None
        extraction = extract(options.clones / truth.tree, kept if kept and kept.exists() else None)
        for node in truth.nodes:
            comparison = Comparison(node, of_files(node, extraction))
            comparison.run()
            print("\n".join([f"{truth.repository}: {node.node}", *comparison.tally.lines(), *comparison.lines]))
            total.add(comparison.tally)
    print("\n".join(["ALL", *total.lines()]))


if __name__ == "__main__":
    main()
