"""LNT010: source imports or includes a message type that its package, being in the tree, does not define."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.near import slip
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT010",
    name="interface_unknown",
    dimension="signature",
    severity="error",
    who="wire",
    consequence="the module cannot be imported or compiled, and its node never starts",
    resolution="correct the name, or add the interface file",
)

_KIND = "message"


def tell(known: Known) -> Iterator[Finding]:
    """Report Python imports of interfaces that a package, being known, would provide if they existed."""
    for asked in known.asked("imports"):
        if asked.match.state == "dangling":
            yield _finding(asked, known)


def _finding(asked: Asked, known: Known) -> Finding:
    package, shape, name = asked.requirement.name.split(".")
    near = known.near(name, package, _KIND, f"{package}/{shape}/")
    text = f"{package} has no {shape}/{name}" + (f"; it has {near}" if near else "")
    entity, edit = Entity(_KIND, f"{package}/{shape}/{name}", near), slip(name, near)
    return RULE.finding(text, entity, asked.consumer.name, asked.requirement.evidence, edit=edit)
