"""Whether two messages of different names hold anything in common: else they are two, however alike the names."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import Final

from ecm_checker.hub.provision import Provision

from ecm_extract.diff.model import Pair
from ecm_extract.diff.similarity import last_part, name_similarity, words

_HEADER: Final = "std_msgs/Header"
"""What half of all messages hold tells of none of them."""
_ALIKE: Final = 0.6
_SAME_CONTENT: Final = 0.9
_LEAST_HELD: Final = 2
_LEAST_OF_FEW: Final = 1 / 2
_LEAST_OF_MANY: Final = 1 / 3
"""Shares of the message with fewer parts and of that with more; one word in common is in any two of a package."""
Parts = dict[str, list[Provision]]
Content = frozenset[tuple[str, str, str | None, str]]
"""Kind, name, type and value of each part."""


class SharedParts:
    """Knows the fields and constants of the interfaces of both sides."""

    def __init__(self, old: Iterable[Provision], new: Iterable[Provision]) -> None:
        self._old, self._new = _parts(old), _parts(new)

    def twins(self, groups: Iterable[tuple[Sequence[Provision], Sequence[Provision]]]) -> Iterator[Pair]:
        """Yield the messages that alone hold what another one held, among those that are gone and came together."""
        for before, after in groups:
            held, holds = _by_content(before, self._old), _by_content(after, self._new)
            for content in (each for each in held if each in holds):
                (old, *rest), (new, *others) = held[content], holds[content]
                if not rest and not others and words(last_part(old.name)) & words(last_part(new.name)):
                    yield Pair(old, new, "renamed", _SAME_CONTENT, "gone and new; it holds the very same")

    def may_be_one(self, old: Provision, new: Provision) -> bool:
        """Whether one entity can be the other under another name; one that is empty tells nothing against it.

        Where the words of one name are all in the other, as of `SickSetMap` and `SetMap`, the fields may be others.
        """
        names = words(last_part(old.name)), words(last_part(new.name))
        if not old.row.generated or names[0] <= names[1] or names[1] <= names[0]:
            return True
        before, after = self._old.get(old.name, []), self._new.get(new.name, [])
        if not before or not after or [each.type for each in before] == [each.type for each in after]:
            return True
        left = sum(any(_is_alike(one, other) for other in after) for one in before)
        right = sum(any(_is_alike(one, other) for one in before) for other in after)
        least, most = sorted((len(before), len(after)))
        return min(left, right) >= max(_LEAST_OF_FEW * least, _LEAST_OF_MANY * most)


def _parts(entities: Iterable[Provision]) -> Parts:
    found: Parts = defaultdict(list)
    for entity in entities:
        if entity.row.part and entity.row.wire and "/" in entity.owner and entity.type != _HEADER:
            found[entity.owner].append(entity)
    return found


def _by_content(entities: Iterable[Provision], parts: Parts) -> dict[Content, list[Provision]]:
    """Messages by all that they hold; those with next to nothing may be anything."""
    found: dict[Content, list[Provision]] = defaultdict(list)
    for entity in entities:
        held = [(each.kind, each.name, each.type, repr(each.default)) for each in parts.get(entity.name, ())]
        if entity.row.generated and len(held) >= _LEAST_HELD:
            found[frozenset(held)].append(entity)
    return found


def _is_alike(old: Provision, new: Provision) -> bool:
    """`segId` is `segment_id`, `posex` is `x`: a word or an end in common, or nearly all letters."""
    before, after = last_part(old.name), last_part(new.name)
    if before.endswith(after) or after.endswith(before):
        return True
    return bool(words(before) & words(after)) or name_similarity(before, after) >= _ALIKE
