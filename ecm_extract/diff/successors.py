"""What the deprecation of a name says should be used instead."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ecm_checker.hub.provision import Key, Provision

_INSTEAD = re.compile(r"\b(?:use|replaced by|in favou?r of|instead of|renamed to|please)\b", re.IGNORECASE)
_NAME = re.compile(r"[\w./~:]*\w")


def stated_successor(entity: Provision, new: Mapping[Key, Provision]) -> Provision | None:
    """Return the entity of the same kind that an entity's deprecation tells to use; None when it names none."""
    if not entity.deprecated:
        return None
    parts = _INSTEAD.split(entity.deprecated, maxsplit=1)
    for word in _NAME.findall(parts[1]) if len(parts) > 1 else ():
        for owner, name in ((entity.owner, word), ("", word), (entity.owner, f"{_place(entity)}{word}")):
            found = new.get((entity.kind, entity.package, owner, name, entity.facet))
            if found is not None and name != entity.name:
                return found
    return None


def _place(entity: Provision) -> str:
    """What stands before the last part of a name: people leave out a namespace or folder that both have."""
    return entity.name.removesuffix(re.split(r"::|/", entity.name)[-1])
