"""Names of nodes in launches: who is started, and who names a node of another one."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.provision import LAUNCHED, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.packages import Packages

_HOLE = "{"


def launched(packages: Packages) -> Iterator[Provision]:
    """Yield the nodes that launch files name."""
    return (each for each in packages.provisions.that(lambda row: row.runs) if each.facet == LAUNCHED)


def required(packages: Packages, *words: str) -> Iterator[tuple[str, Requirement]]:
    """Yield the requirements of some uses, each with the package that requires."""
    for consumer in packages.consumers:
        yield from ((consumer.package, each) for each in consumer.requirements if each.use in words)


def first_part(name: str) -> str:
    """`/arm/state` -> `arm`; empty for a name that is relative, or that the launch alone knows."""
    return name.split("/")[1] if name.startswith("/") and _HOLE not in name else ""


def is_below(name: str) -> bool:
    """Whether an absolute name lies below something: `/arm/state`."""
    return name.count("/") > 1
