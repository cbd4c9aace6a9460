"""What libraries outside the workspace have deprecated: a table of uses and imports, and where a package has them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache

import msgspec

from ecm_extract.entities.distributions import is_for_older
from ecm_extract.lint.alternatives import has_alternative
from ecm_extract.lint.spoken import Way, spoken
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped_as
from ecm_extract.test_code import is_test_path


class DeprecatedUse(msgspec.Struct, frozen=True):
    """A use of one of some names; `ros` is None where it holds for both."""

    of: Way
    names: tuple[str, ...]
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

    use: tuple[DeprecatedUse, ...]
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
    rows = _rows(package, workspace)
    found = dict.fromkeys(each for each in spoken(package, workspace) if (each.of, each.name) in rows)
    for each in found:
        row = rows[each.of, each.name]
        if not is_test_path(each.path, package.root.path) and not _has_other_way(each.path, each.line, workspace):
            yield Deprecated(each.path, each.line, row.old, row.new, row.since)
    yield from _imports(package, workspace)


def _imports(package: PackageFacts, workspace: Workspace) -> Iterator[Deprecated]:
    for path, facts in package.sources.items():
        for found in facts.imports:
            for row in deprecations().imports:
                if row.holds is not None and _is_other(row.holds, workspace):
                    continue
                if found.module != row.module or found.name not in row.names:
                    continue
                if not _has_other_way(path, found.line, workspace):
                    yield Deprecated(path, found.line, f"{row.module}.{found.name}", row.new, row.since)


def _rows(package: PackageFacts, workspace: Workspace) -> Mapping[tuple[Way, str], DeprecatedUse]:
    """The rows that hold for a package, by use and name."""
    named = workspace.known.distributions
    rows = (row for row in deprecations().use if row.ros in {None, package.ros} and not _is_needed(row, package, named))
    return {(row.of, name): row for row in rows for name in row.names}


def _has_other_way(path: str, line: int, workspace: Workspace) -> bool:
    return has_alternative(path, workspace.files.read(path) or b"", line)


def _is_needed(row: DeprecatedUse, package: PackageFacts, named: frozenset[str]) -> bool:
    """Tell whether a distribution that the repository is for lacks what replaces something."""
    return is_for_older(row.since, named) or (package.root.rosbuild and row.since.startswith("ROS"))


def _is_other(holds: tuple[str, str], workspace: Workspace) -> bool:
    """Tell whether the workspace holds the package in a version in which the row does not hold."""
    name, versions = holds
    return name in workspace.versions and not workspace.provides(name, versions)
