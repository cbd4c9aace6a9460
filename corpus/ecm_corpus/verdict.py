"""What the pinned checker says of the documents of a state. Documents are all that it sees."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ecm_checker.case import Case
from ecm_checker.contract import Contract
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package
from ecm_checker.match.packages import Packages
from ecm_checker.operations.engine import examine, ready
from ecm_checker.operations.system import system
from ecm_checker.outcome import ordered

TREE = "tree"
LAUNCHED = "launched"
OLD = "old"
NEW = "new"
CONSUMER = "consumer"

Sides = Mapping[str, Sequence[Package]]


def check_findings(sides: Sides) -> tuple[Finding, ...]:
    """Findings over the documents of a state, by what sides it has.

    Args:
        sides: `tree` for packages that may be used together, and beside it `launched` for instances of their modules
            that a launch file runs together; or `old`, `new` and `consumer` of an upgrade.
    """
    if OLD in sides:
        return ordered(_upgrade(sides[OLD], sides[NEW], sides.get(CONSUMER, ())))
    packages = Packages(sides.get(TREE, ()))
    if LAUNCHED in sides:
        nodes, started = contracts(sides[LAUNCHED]), Packages(sides[LAUNCHED])
        return ordered(system(nodes, together=True, packages=packages, started=started).findings)
    return ordered(system(contracts(sides.get(TREE, ())), packages=packages).findings)


def contracts(packages: Sequence[Package]) -> list[Contract]:
    """The contracts of the modules of packages."""
    return [contract for package in packages for contract in package.contracts()]


def _upgrade(old: Sequence[Package], new: Sequence[Package], users: Sequence[Package]) -> list[Finding]:
    """Each module against its successor, the packages under their users, and the new modules together with these."""
    before = {contract.ecm.module_id: ready(contract) for contract in contracts(old)}
    after = {contract.ecm.module_id: ready(contract) for contract in contracts(new)}
    dependents = tuple(map(ready, contracts(users)))
    found: list[Finding] = []
    for name, previous in before.items():
        case = Case([after[name]] if name in after else [], previous=previous, dependents=dependents)
        found += examine("upgrade", case)
    found += examine("upgrade", Case((), packages=Packages(new), replaced=Packages(old), users=Packages(users)))
    if not {user.name for user in users} & {package.name for package in new}:
        together = [*new, *users]
        found += system(contracts(together), packages=Packages(together)).findings
    return found
