"""One requirement against what is provided: met, dangling, incompatible, or unknown.

Unknown is not missing: a name of a package that nobody has shown, or that any package of the world may offer, is not
gone because it is not here (paper, "Contract Model"; DESIGN §3).
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Literal

import msgspec

from ecm_checker.hub.kinds import Breach, kinds, uses
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.fit import misfit
from ecm_checker.match.provisions import Provisions

State = Literal["met", "dangling", "incompatible", "unknown"]


class Match(msgspec.Struct, frozen=True):
    """What became of a requirement.

    Attributes:
        state: `met` by at least one of `found`; `incompatible` when none of them fits; `dangling` when the package
            that must provide the name is known and does not; `unknown` when the other side is outside what is known.
        found: provisions of that name.
        breach: in which way they do not fit.
    """

    requirement: Requirement
    state: State
    found: tuple[Provision, ...] = ()
    breach: Breach | None = None


def match(requirement: Requirement, consumer: Consumer, provisions: Provisions, known: Collection[str]) -> Match:
    """Match a requirement.

    Args:
        requirement: of the consumer.
        consumer: the package that requires.
        provisions: what is provided.
        known: names of the packages whose provisions are all here.
    """
    if requirement.certainty == "unknown":
        return Match(requirement, "unknown")
    found = provisions.named(requirement, consumer)
    breaches = [misfit(requirement, each) for each in found]
    if None in breaches:
        return Match(requirement, "met", tuple(found))
    if found:
        return Match(requirement, "incompatible", tuple(found), breaches[0])
    return Match(requirement, "dangling" if _is_closed(requirement, known) else "unknown")


def _is_closed(requirement: Requirement, known: Collection[str]) -> bool:
    """Whether only a package that is known can provide the name."""
    return requirement.package in known and all(kinds()[kind].world == "package" for kind in uses()[requirement.use].of)
