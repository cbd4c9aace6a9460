"""LNT067: a package is asked for by a name that no package can have."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.package import Package
from ecm_checker.hub.requirement import Requirement
from ecm_parsers.package_refused import is_package_name

from ecm_extract.lint.known import Known
from ecm_extract.lint.rule import LintRule
from ecm_extract.system.launch_files import is_aside

RULE = LintRule(
    id="LNT067",
    name="package_name_impossible",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="nobody finds a package by it, so that the launch, the build or rosdep stops there with an error",
    resolution="write the name with letters, digits and underscores, without blanks",
)
_OPEN: Final = frozenset("${}()*%@<>")
"""Characters of what is filled in later."""
_SHOWN: Final = 80
_LINES: Final = 5


def tell(known: Known) -> Iterator[Finding]:
    """Report each such name once for the package that writes it, with its first lines."""
    for package in known.packages.by_name.values():
        if package.name in known.own:
            for name, rows in _impossible(package).items():
                if name in known.packages.by_name:
                    continue
                text = f"{package.name} asks for a package '{name[:_SHOWN]}', and none can be called so"
                lines = known.lines_of(package.name, (place for row in rows for place in row.evidence))[:_LINES]
                certain = all(row.certainty == "proved" for row in rows)
                entity = Entity("package", name)
                yield RULE.finding(
                    text, entity, package.name, lines, certainty="proved" if certain else rows[0].certainty
                )


def _impossible(package: Package) -> dict[str, list[Requirement]]:
    """What asks for such names; launch files in hidden folders are copies of editors."""
    found: dict[str, list[Requirement]] = {}
    for row in package.requires:
        name = _asked_for(row)
        if name and _OPEN.isdisjoint(name) and not is_aside(row.evidence[0].path):
            found.setdefault(name, []).append(row)
    return found


def _asked_for(row: Requirement) -> str:
    """The name, where no package can have it; keys of rosdep, which manifests name beside, may have dots."""
    if row.row.brings:
        return row.name if any(char.isspace() for char in row.name) else ""
    return row.package if row.package and not is_package_name(row.package) else ""
