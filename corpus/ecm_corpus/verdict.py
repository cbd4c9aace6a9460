"""What the pinned checker says of the contracts of a state. Contracts are all that it sees."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ecm_checker.case import Case
from ecm_checker.contract import Contract
from ecm_checker.finding import Finding
from ecm_checker.operations.engine import examine, ready
from ecm_checker.operations.system import system
from ecm_checker.outcome import ordered

TREE = "tree"
LAUNCHED = "launched"
OLD = "old"
NEW = "new"
CONSUMER = "consumer"

Sides = Mapping[str, Sequence[Contract]]


def check_findings(sides: Sides) -> tuple[Finding, ...]:
    """Findings over the contracts of a state, by what sides it has.

    Args:
        sides: `tree` for modules that may run together, `launched` for instances that a launch file runs together;
            or `old`, `new` and `consumer` of an upgrade.
    """
    if OLD in sides:
        return ordered(_upgrade(sides[OLD], sides[NEW], sides.get(CONSUMER, ())))
    found = [] if LAUNCHED in sides else list(system(sides.get(TREE, ())).findings)
    return ordered([*found, *system(sides.get(LAUNCHED, ()), together=True).findings])


def _upgrade(old: Sequence[Contract], new: Sequence[Contract], users: Sequence[Contract]) -> list[Finding]:
    """Each module against its successor, and the new modules together with their users."""
    before = {contract.ecm.module_id: ready(contract) for contract in old}
    after = {contract.ecm.module_id: ready(contract) for contract in new}
    dependents = tuple(map(ready, users))
    found: list[Finding] = []
    for name, previous in before.items():
        case = Case([after[name]] if name in after else [], previous=previous, dependents=dependents)
        found += examine("upgrade", case)
    if not {user.ecm.package for user in users} & {contract.ecm.package for contract in new}:
        found += system([*new, *users]).findings
    return found
