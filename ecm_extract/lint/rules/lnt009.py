"""LNT009: a plugin description names a class that the package does not define, or not export for that base class."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT009",
    name="plugin_not_exported",
    dimension="versioning",
    severity="error",
    who="source",
    consequence="the loader finds the description and then fails to create the class",
    resolution="make class, export macro and description agree",
)
_KIND = "exported_class"


def tell(known: Known) -> Iterator[Finding]:
    """Report described classes that no macro of the package exports, when it exports some with that macro at all."""
    told: set[tuple[str, str | None, str | None]] = set()
    for asked in known.asked("describes_class"):
        if asked.match.state == "incompatible":
            pair = (asked.path, asked.requirement.type, asked.match.found[0].type)
            if pair not in told:
                told.add(pair)
                yield _of_other_base(asked, known)
        elif asked.match.state == "dangling" and not _is_borrowed(asked, known):
            exports = known.places(asked.consumer.name, _KIND)
            if exports:
                yield _missing(asked, min(exports, key=lambda at: (at.path, at.line)))


def _is_borrowed(asked: Asked, known: Known) -> bool:
    """Tell whether a description is of a library named after a dependency outside of what is known."""
    library = asked.requirement.target
    return library not in known.packages.by_name and library in known.needed_by(asked.consumer.name)


def _of_other_base(asked: Asked, known: Known) -> Finding:
    """The macro exports the class for another base class than the description says."""
    wanted, exported = asked.requirement, asked.match.found[0]
    text = f"{asked.path} describes {wanted.name} as a {wanted.type}, it is exported as a {exported.type}"
    line = Evidence(exported.path, exported.line)
    evidence = [*wanted.evidence, *known.lines_of(exported.package, [line])]
    return RULE.finding(text, Entity("plugin", wanted.said, wanted.type or ""), asked.consumer.name, evidence)


def _missing(asked: Asked, exported: Evidence) -> Finding:
    """A class that no macro names; the line of one that does shows where it would stand."""
    wanted, package = asked.requirement, asked.consumer.name
    text = f"{asked.path} describes {wanted.name}, which no export macro of {package} names"
    entity = Entity("plugin", wanted.said, wanted.name)
    return RULE.finding(text, entity, package, [*wanted.evidence, exported], certainty="likely")
