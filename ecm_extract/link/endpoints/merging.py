"""One record for an endpoint that several lines make."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable
from functools import reduce
from typing import Any, Final, NamedTuple

import msgspec
from ecm_checker.contract import Confidence, Evidence, Interface, Qos
from ecm_checker.hub.condition import Condition, text_of

from ecm_extract.link.endpoints.open_defaults import OpenDefaults
from ecm_extract.link.endpoints.qos_presets import UNSEEN
from ecm_extract.link.running.values import surer, weaker

_POLICIES: Final = tuple(name for name in Qos.__struct_fields__ if name != "defaulted")


_NONE_OPEN: Final = OpenDefaults()


def merged(interfaces: Iterable[Interface], open_: OpenDefaults = _NONE_OPEN) -> tuple[Interface, ...]:
    """Join records of one endpoint that several lines make: same role, name and type; evidence adds up.

    Transforms are told by their pair of frames too; a listener without one has what is looked up first. Where lines
    give a parameter different defaults, or one nobody sees (`open_`), which of them holds is not known. It is as sure
    as the surest line that makes it under all that the record says.
    """
    entries = [_untyped(each, open_) for each in interfaces]
    unsure = _of_several_defaults(entries) | open_.names
    frames, types = _first_frames(entries), _first_types(entries)
    by_key: dict[_Key, Interface] = {}
    for entry in (_undecided(each, unsure) for each in entries):
        kind = entry.type or types.get(_Parameter.of(entry)) if entry.row.value else entry.type
        key = _Key(entry.role, entry.name, kind, entry.frame or frames.get((entry.role, entry.name)))
        known = by_key.get(key)
        if known is None:
            by_key[key] = entry
            continue
        evidence = tuple(dict.fromkeys((*known.evidence, *entry.evidence)))
        by_key[key] = _joined(known, entry, evidence)
    return tuple(
        sorted(
            by_key.values(),
            key=lambda e: (e.role, e.name, e.type or "", e.evidence[0].path, e.evidence[0].line),
        )
    )


class _Key(NamedTuple):
    """What makes two records one endpoint."""

    role: str
    name: str
    type: str | None
    frame: str | None


def _first_frames(entries: Iterable[Interface]) -> dict[tuple[str, str], str]:
    """The frames that are told first of each role and name."""
    found: dict[tuple[str, str], str] = {}
    for entry in entries:
        if entry.frame is not None:
            found.setdefault((entry.role, entry.name), entry.frame)
    return found


class _Parameter(NamedTuple):
    """A parameter by its name; one whose name is open also by the line that all of its lines begin with."""

    name: str
    asked: Evidence | None

    @classmethod
    def of(cls, entry: Interface) -> _Parameter:
        """Return the parameter that a record is of."""
        return cls(entry.name, entry.evidence[0] if "{" in entry.name else None)


def _first_types(entries: Iterable[Interface]) -> dict[_Parameter, str]:
    """The types that are told first of each parameter: who only reads one may not show it."""
    found: dict[_Parameter, str] = {}
    for entry in entries:
        if entry.row.value and entry.type is not None:
            found.setdefault(_Parameter.of(entry), entry.type)
    return found


def _of_several_defaults(entries: Iterable[Interface]) -> frozenset[str]:
    """Names of the parameters for which lines give different defaults."""
    defaults: dict[str, list[Any]] = defaultdict(list)
    for entry in entries:
        if entry.row.value and entry.default is not None and entry.default not in defaults[entry.name]:
            defaults[entry.name].append(entry.default)
    return frozenset(name for name, found in defaults.items() if len(found) > 1)


def _untyped(entry: Interface, open_: OpenDefaults) -> Interface:
    """A parameter without the type that its default gives it, where a run may give it another one."""
    told = entry.row.value and entry.default is not None and entry.name in open_.untyped
    return msgspec.structs.replace(entry, type=None) if told else entry


def _undecided(entry: Interface, unsure: Collection[str]) -> Interface:
    if not entry.row.value or entry.name not in unsure:
        return entry
    return msgspec.structs.replace(entry, default=None)


def _joined(first: Interface, second: Interface, evidence: tuple[Evidence, ...]) -> Interface:
    when = _either(first.when, second.when)
    return Interface(
        role=first.role,
        name=first.name,
        raw_name=first.raw_name,
        type=first.type or second.type,
        qos=(first.qos or second.qos) if first.row.transform else _in_common(first.qos, second.qos),
        frame=first.frame or second.frame,
        confidence=_confidence(first, second, when),
        evidence=evidence,
        default=second.default if first.default is None else first.default,
        inherited_from=first.inherited_from if second.inherited_from else None,
        when=when,
        needed=first.needed and second.needed,
    )


def _confidence(first: Interface, second: Interface, when: tuple[Condition, ...]) -> Confidence:
    """The surer of two that is made wherever the record says; where neither is, no line alone shows it there."""
    alone = [each.confidence for each in (first, second) if all(condition in when for condition in each.when)]
    return reduce(surer, alone) if alone else weaker(first.confidence, second.confidence)


def _in_common(one: Qos | None, other: Qos | None) -> Qos | None:
    """What two profiles of one endpoint set alike; what they set differently is unknown."""
    if one is None or other is None or one == other:
        return one if one == other else None
    policies = {key: getattr(one, key) for key in _POLICIES if getattr(one, key) == getattr(other, key)}
    unseen = {key: value for key, value in UNSEEN.items() if key not in policies}
    defaulted = tuple(key for key in one.defaulted if key in other.defaulted and key in policies)
    return Qos(**{**unseen, **policies}, defaulted=defaulted)


def _either(one: tuple[Condition, ...], other: tuple[Condition, ...]) -> tuple[Condition, ...]:
    """What holds where one of two groups of conditions does: what both ask, and what somebody outside decides."""
    both = tuple(each for each in one if each in other)
    rests = [tuple(each for each in group if each not in both) for group in (one, other)]
    opposite = len(rests[0]) == 1 and rests[1] == (rests[0][0].opposite,)
    written = any(each.tests == "expression" for rest in rests for each in rest)
    if not all(rests) or opposite or written:
        return both
    return (*both, Condition("expression", " or ".join(text_of(rest) for rest in rests)))
