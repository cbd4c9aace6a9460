"""Which old node is which new one: by what makes it, by its name, by the only file that names it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

from ecm_checker.hub.provision import HOLE, LAUNCHED, Provision

from ecm_extract.diff.model import Pair

_SURE: Final = 0.95
_ALONE: Final = 0.85


@dataclass(frozen=True, slots=True)
class Successions:
    """What has another name or place now.

    Attributes:
        packages: new name of each package. owners: of each class and launch file. files: new path of each file.
    """

    packages: Mapping[str, str] = field(default_factory=dict)
    owners: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, str] = field(default_factory=dict)

    def package(self, old: Provision) -> str:
        """The package that an old entity is in now."""
        return self.packages.get(old.package, old.package)


Place = Callable[[Provision, bool], Hashable]
"""What two nodes must have in common, told of an entity and whether it is an old one; None for nothing."""


def node_pairs(old: Iterable[Provision], new: Iterable[Provision], known: Successions) -> Iterator[Pair]:
    """Yield the pairs among nodes that have no partner by their key, the surest first."""
    before, after = _nodes(old), _nodes(new)
    for place, reason, confidence in (
        (_same_name(known), "", 1.0),
        (_same_name_and_maker, "", 1.0),
        (_same_maker(known), "the same {owner} gives itself another name", _SURE),
        (_same_file(known), "the only node that its file names", _ALONE),
    ):
        for pair in _only_ones(before, after, place):
            before.remove(pair[0])
            after.remove(pair[1])
            yield _pair(pair[0], pair[1], reason, confidence)


def _nodes(entities: Iterable[Provision]) -> list[Provision]:
    return [entity for entity in entities if entity.row.runs]


def _pair(old: Provision, new: Provision, reason: str, confidence: float) -> Pair:
    if old.name == new.name or HOLE in (old.name, new.name):
        return Pair(old, new)
    who = "launch file" if old.facet == LAUNCHED else "program"
    return Pair(old, new, "renamed", confidence, reason.format(owner=who) + _CONSEQUENCE)


_CONSEQUENCE: Final = "; parameters, remaps and private names that are keyed by the old name no longer reach it"


def _only_ones(
    before: Sequence[Provision], after: Sequence[Provision], place: Place
) -> list[tuple[Provision, Provision]]:
    """Pairs of nodes that alone have a place on their side."""
    sides: dict[Hashable, tuple[list[Provision], list[Provision]]] = defaultdict(lambda: ([], []))
    for number, entities in enumerate((before, after)):
        for entity in entities:
            at = place(entity, number == 0)
            if at is not None:
                sides[at][number].append(entity)
    return [(left[0], right[0]) for left, right in sides.values() if len(left) == 1 and len(right) == 1]


def _same_name(known: Successions) -> Place:
    def place(entity: Provision, is_old: bool) -> Hashable:
        if entity.name == HOLE or entity.facet == LAUNCHED:
            return None
        return known.package(entity) if is_old else entity.package, entity.name

    return place


def _same_name_and_maker(entity: Provision, _is_old: bool) -> Hashable:
    """Whatever package the program lies in."""
    return None if entity.name == HOLE or entity.facet == LAUNCHED else (entity.name, entity.owner)


def _same_maker(known: Successions) -> Place:
    def place(entity: Provision, is_old: bool) -> Hashable:
        package = known.package(entity) if is_old else entity.package
        owner = known.owners.get(entity.owner, entity.owner) if is_old else entity.owner
        return package, owner, entity.facet, entity.bases

    return place


def _same_file(known: Successions) -> Place:
    def place(entity: Provision, is_old: bool) -> Hashable:
        if entity.facet == LAUNCHED:
            return None
        return known.files.get(entity.path, entity.path) if is_old else entity.path

    return place
