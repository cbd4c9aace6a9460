"""What a variable may hold where routes met, by one reading of which of them are taken."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from ecm_extract.infer.held import Held, Part, all_ways, either

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Ways:
    """Takes what met apart; what is found for good is kept with it."""

    def __init__(self, folder: Folder, reading: str, taken: Callable[[Held], Sequence[Part]]) -> None:
        """Take what answers are kept under, and what tells which parts count of what met."""
        self._folder = folder
        self._reading = reading
        self._parts = taken
        self._meanwhile: dict[Held, tuple[Held, ...]] = {}

    def moved_on(self) -> None:
        """Forget what a bound had a say in, which holds only as long as the same branches are being decided."""
        self._meanwhile = {}

    def of(self, helds: tuple[Held, ...]) -> tuple[Held, ...]:
        """Return what a variable may hold on the routes that count."""
        if all(held.how != "met" for held in helds):
            return helds
        cuts, meanwhile, found = self._folder.cuts, self._meanwhile, dict[Held, tuple[Held, ...]]()
        for held in helds:
            self._find(held, found)
        if cuts == self._folder.cuts:
            for held, ways in found.items():
                held.settled[self._reading] = ways
        elif meanwhile is self._meanwhile:
            meanwhile.update(found)
        return _joined(helds, found) or all_ways(helds)  # no run gets here

    def _find(self, first: Held, found: dict[Held, tuple[Held, ...]]) -> None:
        """Find what each of the things holds that met, and those that met to make it: there may be thousands."""
        taken: dict[Held, Sequence[Part]] = {}
        pending = [first]
        while pending:
            held = pending[-1]
            known = held.settled[self._reading] if self._reading in held.settled else self._cut(held)
            if held.how != "met" or held in found or isinstance(known, tuple):
                if isinstance(known, tuple):
                    found[held] = known
                pending.pop()
                continue
            if held not in taken:
                taken[held] = self._parts(held)
                pending += [way for part in taken[held] for way in part.ways if way.how == "met"]
                continue
            found[held] = _joined([way for part in taken[held] for way in part.ways], found)

    def _cut(self, held: Held) -> tuple[Held, ...] | None:
        """What was found of a thing since the branches are being decided that are; a bound had a say in it."""
        known = self._meanwhile.get(held)
        self._folder.cuts += known is not None
        return known


def _joined(helds: Iterable[Held], found: Mapping[Held, tuple[Held, ...]]) -> tuple[Held, ...]:
    """What a variable may hold, by what is found of those that met."""
    ways: tuple[Held, ...] = ()
    for held in helds:
        ways = either(held.name, ways, found.get(held, (held,)))
    return ways
