"""LNT031: a service request is given a field that the service does not have."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.near import nearest, slip
from ecm_extract.lint.rule import LintRule
from ecm_extract.requires.service_calls import common_services

RULE = LintRule(
    id="LNT031",
    name="service_field_unknown",
    dimension="signature",
    severity="error",
    who="wire",
    consequence="Python stops with AttributeError at the call, C++ does not compile",
    resolution="write a field of the service, or add it there",
)
_KIND = "message_field"


def tell(known: Known) -> Iterator[Finding]:
    """Report keywords of proxy calls, and members of request and response objects, that the definition lacks."""
    calls: dict[tuple[str, Evidence], list[Asked]] = {}
    for asked in known.asked("gives_field"):
        if _is_lacking(asked):
            calls.setdefault((asked.requirement.owner, asked.requirement.evidence[0]), []).append(asked)
    yield from (_of_call(group, known) for group in calls.values())
    for asked in known.asked("has_field"):
        if asked.match.state == "dangling":
            yield _finding(asked, known)


def _is_lacking(asked: Asked) -> bool:
    """Tell whether a service has no such field: by its package, or by what is known of services without theirs."""
    fields = common_services().get(asked.requirement.owner)
    unknown = asked.match.state == "unknown" and fields is not None and _field(asked) not in fields
    return unknown or asked.match.state == "dangling"


def _of_call(group: Sequence[Asked], known: Known) -> Finding:
    """A call with several wrong fields is one finding; the near name is that of the first."""
    if len(group) == 1:
        return _finding(group[0], known)
    wanted = group[0].requirement
    order = wanted.given.names if wanted.given is not None else ()
    names = sorted((_field(asked) for asked in group), key=order.index)
    text = f"{wanted.owner} has no fields {', '.join(names)}"
    entity = Entity(_KIND, f"{wanted.owner}.{names[0]}")
    return RULE.finding(text, entity, group[0].consumer.name, wanted.evidence)


def _finding(asked: Asked, known: Known) -> Finding:
    wanted, name = asked.requirement, _field(asked)
    near = nearest(name, _fields(asked, known))
    text = f"{wanted.owner} has no field {name}" + (f"; it has {near}" if near else "")
    built = asked.path not in asked.consumer.unbuilt
    return RULE.finding(
        text,
        Entity(_KIND, f"{wanted.owner}.{name}", near or ""),
        asked.consumer.name,
        wanted.evidence,
        severity=None if built else "info",
        consequence="" if built else f"{RULE.consequence} (no target builds this file)",
        edit=slip(name, near),
    )


def _field(asked: Asked) -> str:
    return asked.requirement.name.partition(".")[2]


def _fields(asked: Asked, known: Known) -> Sequence[str]:
    """The fields of the section that is meant, in their order."""
    wanted = asked.requirement
    section = f"{wanted.name.partition('.')[0]}."
    own = known.members(wanted.package or "", wanted.owner, _KIND)
    found = [name.removeprefix(section) for name in own if name.startswith(section)]
    return found or common_services().get(wanted.owner, ())
