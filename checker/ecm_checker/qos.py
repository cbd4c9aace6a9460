"""Findings of rules about DDS policies: an offer that meets no request.

Source: ROS 2 documentation, "Quality of Service settings".
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ecm_checker.case import Case, Wire
from ecm_checker.contract import Evidence, Interface
from ecm_checker.finding import Certainty, Entity, Finding
from ecm_checker.match.qos_fit import Fits, Setting, policy_of
from ecm_checker.rule import Rule


def setting(endpoint: Interface, policy: str) -> Setting:
    """The value of a policy: as set, else the default."""
    return policy_of(endpoint.qos, policy)


def mismatches(case: Case, rule: Rule, policy: str, fits: Fits) -> Iterator[Finding]:
    """Findings of a rule for wires of which no alternative of the offer meets any of the request."""
    for wire in case.topics:
        if wire.giver.contract.ecm.ros == 1 or wire.taker.contract.ecm.ros == 1:
            continue
        found = _misfit(wire, policy, fits)
        if found is not None:
            yield _finding(rule, wire, policy, found)


def sources(wire: Wire) -> tuple[Evidence, ...]:
    """The declaring lines of both sides."""
    endpoints = (*wire.offered, *wire.wanted)
    return tuple(endpoint.evidence[0] for endpoint in endpoints if endpoint.evidence)


def certainty_of(wire: Wire) -> Certainty:
    """A name that is the default of a parameter may be another one on the robot."""
    return "proved" if is_named(wire) and wire.giver is not wire.taker else "likely"


def is_named(wire: Wire) -> bool:
    """Whether both sides fix the name, so that it is no mere default of a parameter."""
    return all(entry.confidence in {"literal", "folded"} for entry in (*wire.offered, *wire.wanted))


class _Misfit(NamedTuple):
    offered: Setting
    wanted: Setting


def _misfit(wire: Wire, policy: str, fits: Fits) -> _Misfit | None:
    first = None
    for offer in wire.offered:
        for want in wire.wanted:
            offered, wanted = setting(offer, policy), setting(want, policy)
            if fits(offered, wanted):
                return None
            first = first or _Misfit(offered, wanted)
    return first


def _finding(rule: Rule, wire: Wire, policy: str, misfit: _Misfit) -> Finding:
    sure = misfit.offered.sure and misfit.wanted.sure
    text = (
        f"{wire.name}: {wire.giver.id} offers {policy} {_shown(misfit.offered)}, "
        f"{wire.taker.id} asks for {_shown(misfit.wanted)}"
    )
    certainty = certainty_of(wire) if sure else "likely"
    entity = Entity("qos", wire.name, policy)
    return rule.finding(text, entity, (wire.giver, wire.taker), sources(wire), certainty=certainty)


def _shown(found: Setting) -> str:
    text = f"{found.value:g} ms" if isinstance(found.value, int | float) else str(found.value or "infinite")
    return text if found.sure else f"{text} (default)"
