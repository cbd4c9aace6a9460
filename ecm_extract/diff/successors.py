"""What the deprecation of a name says should be used instead."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ecm_extract.entities.model import Key, PublicEntity

_INSTEAD = re.compile(r"\b(?:use|replaced by|in favou?r of|instead of|renamed to|please)\b", re.IGNORECASE)
_NAME = re.compile(r"[\w./~:]*\w")


def stated_successor(entity: PublicEntity, new: Mapping[Key, PublicEntity]) -> PublicEntity | None:
    """Return the entity of the same kind that an entity's deprecation tells to use; None when it names none."""
    if not entity.deprecated:
        return None
    parts = _INSTEAD.split(entity.deprecated, maxsplit=1)
    for word in _NAME.findall(parts[1]) if len(parts) > 1 else ():
        for owner in (entity.owner, ""):
            found = new.get((entity.kind, entity.package, owner, word, entity.facet))
            if found is not None and word != entity.name:
                return found
    return None
