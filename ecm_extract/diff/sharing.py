"""What several modules offer by one line is one entity of the first of them, and each of them has it all the same."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec
from ecm_checker.hub.provision import Key, Provision


def by_sharers(entities: Iterable[Provision]) -> dict[Key, Provision]:
    """Return what modules have by the line of another one, by the key that it would have as their own."""
    return {_of(entity, owner).key: entity for entity in entities for owner in entity.sharers}


def _of(entity: Provision, owner: str) -> Provision:
    return msgspec.structs.replace(entity, owner=owner, sharers=())
