"""One requirement against what is provided: met, dangling, incompatible, or unknown.

Unknown is not missing: a name of a package that nobody has shown, or that any package of the world may offer, is not
gone because it is not here (paper, "Contract Model"; DESIGN §3).
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Literal

import msgspec

from ecm_checker.hub.condition import Condition
from ecm_checker.hub.kinds import Breach, kinds
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.fit import misfit
from ecm_checker.match.generated import interface_package
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

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """What is not decided and must hold for this to be so: around the line, and around all that could meet it."""
        around = {each.when for each in self.found}
        meeting = next(iter(around)) if len(around) == 1 else ()
        return tuple(dict.fromkeys((*self.requirement.when, *meeting)))


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
    named = [(each, misfit(requirement, each)) for each in provisions.named(requirement, consumer)]
    # a computed name of another type is another name
    found = [(each, breach) for each, breach in named if breach is None or not each.is_computed]
    breaches = [breach for _, breach in found]
    if None in breaches:
        met = _is_sure(requirement, [each for each, breach in found if breach is None])
        return Match(requirement, "met" if met else "unknown", tuple(each for each, _ in found))
    if found:
        return Match(requirement, "incompatible", tuple(each for each, _ in found), breaches[0])
    closed = (
        _home(requirement, provisions) in known and not is_open(requirement) and _tells_all(requirement, provisions)
    )
    return Match(requirement, "dangling" if closed else "unknown")


def _home(requirement: Requirement, provisions: Provisions) -> str | None:
    """The package that alone can provide the name: the one that is named, or that generates what is imported."""
    if requirement.package is not None or not any(kinds()[kind].generated for kind in requirement.row.of):
        return requirement.package
    package = interface_package(requirement.name)
    return package if package in provisions.interface_packages else None


def _tells_all(requirement: Requirement, provisions: Provisions) -> bool:
    """Whether the owner of the name is known to tell all that is below it."""
    if not requirement.owner:
        return True
    kind = kinds()[requirement.kind].owned_by
    owners = [each for each in provisions.owners(requirement.package, requirement.owner) if kind in {"", each.kind}]
    return bool(owners) and not any(each.open for each in owners)


def _is_sure(requirement: Requirement, fitting: Sequence[Provision]) -> bool:
    """Whether one of those that fit is surely meant: in one launch a computed name may come to another one."""
    return not requirement.row.launched or any(not each.is_computed for each in fitting)


def is_open(requirement: Requirement) -> bool:
    """Whether any package of the world may provide the name, as a topic or a plugin; not within one launch."""
    row = requirement.row
    return not row.launched and any(kinds()[kind].world == "graph" for kind in row.of)
