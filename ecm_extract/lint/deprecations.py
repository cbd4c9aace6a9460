"""What libraries outside the workspace have deprecated: a table of lines and imports, and where a package has them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

import msgspec

from ecm_extract.entities.distributions import is_for_older
from ecm_extract.lint.alternatives import has_alternative
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped_as
from ecm_extract.source_suffixes import CPP
from ecm_extract.test_code import is_test_path

_KINDS = {
    "cpp": tuple(CPP),
    "python": (".py",),
    "launch": (".launch", ".launch.xml", ".xml.launch"),
    "cmake": ("CMakeLists.txt", ".cmake"),
}
_COMMENT = re.compile(rb"\s*(?://|#(?!\s*include)|\*|<!--)")
_BLOCK = re.compile(rb"/\*.*?\*/|<!--.*?-->", re.DOTALL)


class DeprecatedText(msgspec.Struct, frozen=True):
    """A line of some kinds of files; `ros` is None where it holds for both."""

    files: tuple[str, ...]
    pattern: str
    old: str
    new: str
    since: str
    ros: int | None = None


class DeprecatedImport(msgspec.Struct, frozen=True):
    """Names that a Python module no longer has; `holds` is the package and the versions in which it is so."""

    module: str
    names: tuple[str, ...]
    new: str
    since: str
    holds: tuple[str, str] | None = None


class Deprecations(msgspec.Struct, frozen=True):
    """The whole table."""

    text: tuple[DeprecatedText, ...]
    imports: tuple[DeprecatedImport, ...] = msgspec.field(name="import", default=())


class Deprecated(msgspec.Struct, frozen=True):
    """One place that uses something deprecated; `new` is what to write."""

    path: str
    line: int
    old: str
    new: str
    since: str


@cache
def deprecations() -> Deprecations:
    """Return the table."""
    return shipped_as("lint/deprecations.toml", Deprecations)


def deprecated_in(package: PackageFacts, workspace: Workspace) -> Iterator[Deprecated]:
    """Yield the uses of a package, tests left out."""
    named = workspace.known.distributions
    possible = [row for row in deprecations().text if not _is_needed(row, package, named)]
    rows = {
        entry.path: concerned
        for entry in package.root.files
        if not is_test_path(entry.path, package.root.path)
        and (concerned := [row for row in possible if _concerns(row, entry.path, package.ros)])
    }
    for path, data in workspace.tree.read_many(list(rows)):
        yield from _lines(path, _BLOCK.sub(_blank, data), rows[path])
    for path, facts in package.sources.items():
        for found in facts.imports:
            for row in deprecations().imports:
                if row.holds is not None and _is_other(row.holds, workspace):
                    continue
                if found.module != row.module or found.name not in row.names:
                    continue
                if not has_alternative(path, workspace.files.read(path) or b"", found.line):
                    yield Deprecated(path, found.line, f"{row.module}.{found.name}", row.new, row.since)


def _is_needed(row: DeprecatedText, package: PackageFacts, named: frozenset[str]) -> bool:
    """Tell whether a distribution that the repository is for lacks what replaces something."""
    return is_for_older(row.since, named) or (package.root.rosbuild and row.since.startswith("ROS"))


def _is_other(holds: tuple[str, str], workspace: Workspace) -> bool:
    """Tell whether the workspace holds the package in a version in which the row does not hold."""
    name, versions = holds
    return name in workspace.versions and not workspace.provides(name, versions)


def _concerns(row: DeprecatedText, path: str, ros: int | None) -> bool:
    return row.ros in {None, ros} and any(path.endswith(_KINDS[kind]) for kind in row.files)


def _lines(path: str, data: bytes, rows: list[DeprecatedText]) -> Iterator[Deprecated]:
    for row in rows:
        for match in re.finditer(row.pattern.encode(), data, re.MULTILINE):
            start = data.rfind(b"\n", 0, match.start()) + 1
            if _COMMENT.match(data, start) is None:
                line = data.count(b"\n", 0, match.end()) + 1
                if not has_alternative(path, data, line):
                    yield Deprecated(path, line, row.old, row.new, row.since)


def _blank(match: re.Match[bytes]) -> bytes:
    """Lines keep their numbers when a comment goes."""
    return b"\n" * match[0].count(b"\n")
