"""What a choice of releases is made of, without knowing what a release is: families, options, requests, clashes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

import msgspec


class Place(NamedTuple):
    """A release by its family and its place in it, 0 for the best."""

    family: str
    number: int


class Option(msgspec.Struct, frozen=True):
    """A release: its version, and which places of other families it takes."""

    version: str
    needs: Mapping[str, frozenset[int]] = {}


class Fact(NamedTuple):
    """Something that narrows the choice: a request (`needs` is empty), what one family needs of another, a clash."""

    family: str
    needs: str = ""
    clash: bool = False


class Problem(msgspec.Struct, frozen=True):
    """What is asked.

    Attributes:
        families: options, the best first.
        requests: which places of which families are asked for.
        excluded: places that may not be chosen.
        clashes: pairs of places that may not stand together.
    """

    families: Mapping[str, Sequence[Option]]
    requests: Mapping[str, frozenset[int]]
    excluded: frozenset[Place] = frozenset()
    clashes: frozenset[tuple[Place, Place]] = frozenset()

    def facts(self) -> list[Fact]:
        """Return all facts, in a fixed order."""
        found = {Fact(name) for name in self.requests}
        found |= {Fact(name, other) for name, of in self.families.items() for each in of for other in each.needs}
        found |= {clash_of(pair) for pair in self.clashes}
        return sorted(found)

    def only(self, facts: Iterable[Fact]) -> Problem:
        """Return the problem with these facts alone, and the families that they name."""
        kept = frozenset(facts)
        named = sorted({name for fact in kept for name in (fact.family, fact.needs) if name in self.families})
        families = {
            name: [Option(each.version, _kept(name, each, kept)) for each in self.families[name]] for name in named
        }
        clashes = {pair for pair in self.clashes if clash_of(pair) in kept}
        requests = {name: places for name, places in self.requests.items() if Fact(name) in kept}
        excluded = frozenset(place for place in self.excluded if place.family in families)
        return Problem(families, requests, excluded, frozenset(clashes))


def clash_of(pair: tuple[Place, Place]) -> Fact:
    """Return the fact that two places may not stand together."""
    first, second = sorted((pair[0].family, pair[1].family))
    return Fact(first, second, clash=True)


def _kept(name: str, option: Option, kept: frozenset[Fact]) -> Mapping[str, frozenset[int]]:
    return {other: places for other, places in option.needs.items() if Fact(name, other) in kept}
