"""The wholes that a name goes and comes with: its package, and the class, message or file that has it."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.kinds import containers, kinds
from ecm_checker.hub.provision import Provision

Name = tuple[str, str, str, str]
"""Kind, package, owner and name."""


def wholes_of(entity: Provision) -> Iterator[Name]:
    """Yield by what the wholes of an entity are called, the widest first; what is released is none of itself."""
    for kind in containers():
        if kinds()[kind].released and kind != entity.kind:
            yield kind, entity.package, "", entity.package
        yield kind, entity.package, "", entity.owner
