"""Headers whose name changed in its ending alone: `arm.h` that became `arm.hpp`, in whatever company."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ecm_checker.hub.provision import Provision

from ecm_extract.diff.model import Pair
from ecm_extract.diff.similarity import stem

_SURE = 0.98
_REASON = "the same header with another ending"


def other_endings(removed: Iterable[Provision], after: Iterable[Provision]) -> Iterator[Pair]:
    """Yield each header that is gone with the one that has its name up to the ending.

    Args:
        removed: what is gone.
        after: all of the new side: the other header may have stood beside the old one for a while.
    """
    homes = {(entity.package, stem(entity)): entity for entity in after if entity.row.included}
    for entity in removed:
        home = homes.get((entity.package, stem(entity))) if entity.row.included else None
        if home is not None and home.name != entity.name:
            yield Pair(entity, home, "renamed", _SURE, _REASON)
