"""LNT017: a message, service or action has a field of a type that its package, being in the tree, does not define."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.near import slip
from ecm_extract.lint.rule import LintRule

RULE = LintRule(
    id="LNT017",
    name="field_type_unknown",
    dimension="signature",
    severity="error",
    who="wire",
    consequence="the interface package does not build, and nothing that uses it does",
    resolution="correct the type, or add the message",
)

_KIND = "message"


def tell(known: Known) -> Iterator[Finding]:
    """Report fields whose type names a package that is known and has no such message."""
    for asked in known.asked("has_field_of"):
        owner, _, name = asked.requirement.name.split(".")
        elsewhere = known.provider(_KIND, f"/msg/{name}")
        if asked.match.state == "dangling" or (elsewhere and _has_none(asked, known)):
            near = "" if elsewhere else known.near(name, owner, _KIND, f"{owner}/msg/")
            yield _finding(asked, f"{elsewhere}/{name}" if elsewhere else f"{owner}/{near}" if near else "")


def _has_none(asked: Asked, known: Known) -> bool:
    """Tell whether the package that is named is known and has no interface at all, nor lists any."""
    package = known.packages.by_name.get(asked.requirement.package or "")
    if package is None or package.name not in known.packages.names or _KIND in package.possible:
        return False
    return all(row.kind != _KIND for row in package.provides)


def _finding(asked: Asked, better: str) -> Finding:
    wanted = asked.requirement
    text = f"{wanted.package} defines no message {wanted.name.rpartition('.')[2]}"
    text += f"; there is {better}" if better else ""
    hint = f"write {better}" if better else ""
    edit = slip(wanted.name.rpartition(".")[2], better.partition("/")[2])
    entity = Entity("message_field", wanted.said, better)
    return RULE.finding(text, entity, asked.consumer.name, wanted.evidence, resolution=hint, edit=edit)
