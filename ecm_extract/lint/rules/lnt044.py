"""LNT044: a package exports a library that it does not build, or does not install."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT044",
    name="exported_library_missing",
    dimension="versioning",
    severity="warning",
    who="source",
    consequence="every package that depends on it fails to configure or to link",
    resolution="make name, target and install(TARGETS ...) agree",
    tier="stable",
)
_KIND = "library"


def tell(known: Known) -> Iterator[Finding]:
    """Report exported names that look like the package's own; what is installed is known when every rule is."""
    for asked in known.asked("exports_library"):
        if asked.match.state == "dangling" and (asked.requirement.target or not _is_foreign(asked, known)):
            yield _finding(asked)


def _is_foreign(asked: Asked, known: Known) -> bool:
    """Tell whether another package has the library, or the system: its name shares no word with the package."""
    name, package = asked.requirement.name, asked.consumer.name
    others = (other for other in known.packages.by_name if other != package)
    return _family(name) != _family(package) or any(known.may_have(other, _KIND, name) for other in others)


def _family(name: str) -> str:
    """The first word of a name: what shares none with its package is a library of the system."""
    return name.partition("_")[0]


def _finding(asked: Asked) -> Finding:
    wanted = asked.requirement
    reason = "does not install" if wanted.target else "does not build"
    text = f"{asked.consumer.name} exports the library {wanted.name}, which it {reason}"
    entity = Entity(_KIND, wanted.name, reason)
    return RULE.finding(text, entity, asked.consumer.name, wanted.evidence, certainty="likely")
