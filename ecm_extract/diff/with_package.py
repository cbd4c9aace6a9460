"""What goes with its package when that has another name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice

from ecm_checker.hub.provision import Key, Provision

from ecm_extract.diff.model import How, Pair
from ecm_extract.diff.similarity import in_package, same_language

_WITH_PACKAGE = 0.95


def _keys(entity: Provision, package: str) -> Iterator[Key]:
    """Its keys in a package of another name: with that in its own; what code names may be called as it was."""
    owner, name = (in_package(text, entity.package, package) for text in (entity.owner, entity.name))
    yield entity.kind, package, owner, name, entity.facet
    if entity.row.in_language:
        yield entity.kind, package, entity.owner, entity.name, entity.facet


class WithPackage:
    """Asks for the new entity that an old one is when its package is renamed; both sides are given as a whole."""

    def __init__(self, old: Mapping[Key, Provision], new: Mapping[Key, Provision]) -> None:
        sides = [each for side in (old, new) for each in side.values()]
        self._included = {(each.package, each.path): each.name for each in sides if each.row.included}
        self._wholes = {(each.package, each.name) for each in old.values() if each.row.holds}

    def pairs(
        self, old: Mapping[Key, Provision], new: Mapping[Key, Provision], packages: Mapping[str, str]
    ) -> Iterator[Pair]:
        """Yield the pairs among what has no partner yet, by the new name of each package that has one."""
        for entity in old.values():
            package = packages.get(entity.package)
            if package is not None and not entity.is_of_module:
                found = (new[key] for key in _keys(entity, package) if key in new and same_language(entity, new[key]))
                yield from (self._pair(entity, target) for target in islice(found, 1))

    def _pair(self, old: Provision, new: Provision) -> Pair:
        """One that is got by other words than before is told; a part of a whole is told by that.

        Values that a file sets go with the file, and what the graph or robots call so knows of no package.
        """
        stays = old.row.sets or old.row.runs or (old.row.anywhere and old.name == new.name)
        part = old.row.part and (old.package, old.owner) in self._wholes
        if stays or part or self._is_taken_in_alike(old, new):
            return Pair(old, new)
        how: How = "moved" if old.name == new.name or old.row.qualified else "renamed"
        return Pair(old, new, how, _WITH_PACKAGE, f"its package is {new.package} now")

    def _is_taken_in_alike(self, old: Provision, new: Provision) -> bool:
        """Whether code says the same to get it: no line that imports or includes it tells its package."""
        taken = self._included.get((old.package, old.path))
        alike = taken is not None and taken == self._included.get((new.package, new.path))
        return alike and old.row.in_language and (old.owner, old.name) == (new.owner, new.name)
