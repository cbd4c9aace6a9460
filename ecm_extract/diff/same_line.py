"""Names that need not be alike: the line that declared the old one stands there with the new one in its place.

`bumper` may become `bump` or `contact`: its publisher is the same variable, its subscriber has the same callback.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import Final

from ecm_checker.hub.provision import Provision

from ecm_extract.diff.model import Pair

_SURE: Final = 0.85
_REASON: Final = "the line that declares it is the same but for the name"


def same_lines(removed: Iterable[Provision], added: Iterable[Provision], files: Mapping[str, str]) -> Iterator[Pair]:
    """Yield the pairs of a kind and type in one file that alone have each other's line.

    Args:
        removed: of the old side.
        added: of the new side.
        files: new path of each file that moved.
    """
    fresh: dict[tuple[str, str, str | None, str, str], list[Provision]] = defaultdict(list)
    for entity in added:
        if entity.written:
            fresh[entity.kind, entity.facet, entity.type, entity.path, entity.written].append(entity)
    matches = []
    for old in removed:
        if old.written:
            place = old.kind, old.facet, old.type, files.get(old.path, old.path), old.written
            matches += [(old, new) for new in fresh.get(place, ())]
    for old, new in matches:
        rivals = [pair for pair in matches if (pair[0] is old) != (pair[1] is new)]
        if not rivals:
            yield Pair(old, new, "renamed", _SURE, _REASON)
