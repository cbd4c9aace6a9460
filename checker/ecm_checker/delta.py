"""What the signature of a new version lacks or has more than the one before."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Container, Iterable, Iterator, Sequence
from typing import Final

import msgspec

from ecm_checker.contract import Evidence, Interface
from ecm_checker.endpoint_types import types
from ecm_checker.hub.roles import Role, roles
from ecm_checker.terms import Field
from ecm_checker.view import View

_HOLE: Final = re.compile(r"\{[^{}]*\}")


class Lost(msgspec.Struct, frozen=True):
    """Something that users of the old version may miss.

    Attributes:
        kind: role of an endpoint, `input` or `output`.
        old: its name in the old version; empty for an input that is new.
        new: its name, or its type, in the new version; empty when it is gone.
        text: what happened.
        evidence: lines of the old version, then of the new one.
    """

    kind: str
    old: str
    new: str
    text: str
    evidence: tuple[Evidence, ...] = ()


def lost(old: View, new: View) -> Iterator[Lost]:
    """What the new version does not have in the form of the old one."""
    was, now = _endpoints(old), _endpoints(new)
    for role in (role for role, row in roles().items() if row.provides):
        for name, before in was[role].items():
            yield from _endpoint(role, name, before, now[role].get(name, ()))
    told = {name for named in was.values() for name in named}
    yield from _fields("output", old.outputs, new.outputs, told)
    yield from _fields("input", old.inputs, new.inputs, told)
    before_names = {field.name for field in old.inputs or ()}
    for field in new.inputs or ():
        if old.inputs is not None and field.name not in before_names and not field.optional:
            yield Lost("input", "", field.name, f"input {field.name!r} is now required")


def gained(old: View, new: View) -> Iterator[tuple[str, str]]:
    """Kind and name of what only the new version offers."""
    was, now = _endpoints(old), _endpoints(new)
    for role in (role for role, row in roles().items() if row.gives):
        yield from ((role, name) for name in now[role] if name not in was[role])
    before = {field.name for field in old.outputs or ()}
    if old.outputs is not None:
        told = {name for named in now.values() for name in named}
        yield from (("output", field.name) for field in new.outputs or () if field.name not in before | told)


def _endpoints(module: View) -> defaultdict[Role, dict[str, list[Interface]]]:
    """All endpoints by role and name: of one module, private and computed names can be compared too.

    What a computed part is called in source does not matter.
    """
    found: defaultdict[Role, dict[str, list[Interface]]] = defaultdict(dict)
    for entry in module.contract.signature.interfaces:
        found[entry.role].setdefault(_HOLE.sub("{}", entry.name), []).append(entry)
    return found


def _endpoint(role: Role, name: str, before: Sequence[Interface], after: Sequence[Interface]) -> Iterator[Lost]:
    evidence = _lines((*before, *after))
    if not after:
        yield Lost(role, name, "", f"{role} {name} is gone", evidence)
        return
    old, new = types(before), types(after)
    if old and new and not old <= new:
        text = f"{role} {name} changed its type from {'|'.join(sorted(old))} to {'|'.join(sorted(new))}"
        yield Lost(role, name, "|".join(sorted(new)), text, evidence)


def _fields(
    kind: str, before: tuple[Field, ...] | None, after: tuple[Field, ...] | None, told: Container[str]
) -> Iterator[Lost]:
    """Fields that are gone or changed; that an endpoint is gone is told of the endpoint already."""
    now = {field.name: field for field in after or ()}
    for field in before or ():
        found = now.get(field.name)
        if found is None and kind == "output" and _HOLE.sub("{}", field.name) not in told:
            yield Lost(kind, field.name, "", f"{kind} {field.name!r} is gone")
        elif found is not None and _form(found) != _form(field):
            yield Lost(kind, field.name, field.name, f"{kind} {field.name!r} changed its type, unit or frame")
        elif found is not None and kind == "input" and field.optional and not found.optional:
            yield Lost(kind, field.name, field.name, f"{kind} {field.name!r} is no longer optional")


def _form(field: Field) -> tuple[str | None, str | None, str | None]:
    return field.type, field.unit, field.frame


def _lines(endpoints: Iterable[Interface]) -> tuple[Evidence, ...]:
    return tuple(entry.evidence[0] for entry in endpoints if entry.evidence)
