"""What is in no answer, struck out: releases that need what nobody has left, and places that nobody who must be takes.

A family must be when it is requested, or when all that is left of one that must be needs it. Striking out goes on until
nothing follows any more; what it leaves may still hold no answer.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence

from ecm_extract.registry.problem import Fact, Place, Problem, clash_of

_Rows = Sequence[tuple[int, int]]
"""An option of a family, as a bit, and the places of another one that it takes, as bits."""


class _Index:
    """A problem by bits: place `n` is `1 << n`.

    Attributes:
        takes: family -> another one -> options that need it. users: the same the other way round.
        apart: place -> families with the places that clash with it.
    """

    def __init__(self, problem: Problem) -> None:
        self.takes: dict[str, dict[str, _Rows]] = {name: _rows(problem, name) for name in problem.families}
        self.users: dict[str, dict[str, _Rows]] = defaultdict(dict)
        for name, others in self.takes.items():
            for other, rows in others.items():
                self.users[other][name] = rows
        self.apart: dict[Place, list[Place]] = defaultdict(list)
        for first, second in problem.clashes:
            self.apart[first].append(second)
            self.apart[second].append(first)


def _rows(problem: Problem, name: str) -> dict[str, _Rows]:
    found: dict[str, list[tuple[int, int]]] = defaultdict(list)
    for number, option in enumerate(problem.families[name]):
        for other, places in option.needs.items():
            found[other].append((1 << number, _bits(places)))
    return dict(found)


class Narrowed:
    """What is left of each family, and which of them must be; none of it is ever changed."""

    def __init__(self, index: _Index, left: dict[str, int], must: frozenset[str]) -> None:
        self._index, self._left, self._must = index, left, must

    @property
    def domains(self) -> Mapping[str, frozenset[int]]:
        """Places that are left, by family."""
        return {name: frozenset(_numbers(bits)) for name, bits in self._left.items()}

    def places(self, family: str) -> Iterator[int]:
        """Yield the places that are left of a family, the best first."""
        yield from _numbers(self._left[family])

    def fixed_at(self, place: Place) -> Narrowed | None:
        """Return what a place leaves that is chosen; None where that is nothing."""
        if not self._left[place.family] & 1 << place.number:
            return None
        left = {**self._left, place.family: 1 << place.number}
        return _followed(self._index, left, {*self._must, place.family}, {place.family: None})


def narrowed(problem: Problem) -> Narrowed | None:
    """Return what is left of a problem; None where it has no answer for sure."""
    return _followed(_Index(problem), *_begin(problem))


def cause_of(problem: Problem) -> frozenset[Fact] | None:
    """Return facts by which everything of a family that must be is struck out; None where that does not come about."""
    work = _Work(_Index(problem), *_begin(problem))
    for name in problem.requests:
        work.causes[name].append((Fact(name), name))
    wiped = work.follow()
    if wiped is None:
        return None
    found, waiting, seen = set[Fact](), [wiped], {wiped}
    while waiting:
        for fact, source in work.causes[waiting.pop()]:
            found.add(fact)
            waiting += {source} - seen
            seen.add(source)
    return frozenset(found)


def _begin(problem: Problem) -> tuple[dict[str, int], set[str], dict[str, None]]:
    """What there is at first, what must be, and what is to be followed: all."""
    left = {name: _bits(range(len(options))) for name, options in problem.families.items()}
    for place in problem.excluded:
        left[place.family] &= ~(1 << place.number)
    for name, places in problem.requests.items():
        left[name] = left.get(name, 0) & _bits(places)
    return left, set(problem.requests), dict.fromkeys(left)


def _followed(index: _Index, left: dict[str, int], must: set[str], changed: dict[str, None]) -> Narrowed | None:
    work = _Work(index, left, must, changed)
    return Narrowed(index, left, frozenset(must)) if work.follow() is None else None


class _Work:
    """What follows from families that changed.

    Attributes:
        causes: why a family must be or lost places: by which fact, and by the state of which family.
    """

    def __init__(self, index: _Index, left: dict[str, int], must: set[str], waiting: dict[str, None]) -> None:
        self._index, self._left, self._must, self._waiting = index, left, must, waiting
        self.causes: dict[str, list[tuple[Fact, str]]] = defaultdict(list)

    def follow(self) -> str | None:
        """Strike out until nothing follows; return a family that must be and has nothing left, None for none."""
        while self._waiting:
            family, _ = self._waiting.popitem()
            if family in self._must and not self._left.get(family):
                return family
            self._strike_users(family)
            if family in self._must:
                self._lead(family)
                self._keep_apart(family)
        return None

    def _strike_users(self, family: str) -> None:
        """Strike out releases that take nothing of what is left of a family."""
        left = self._left.get(family, 0)
        for user, rows in self._index.users.get(family, {}).items():
            gone = 0
            for option, taken in rows:
                if not taken & left:
                    gone |= option
            self._keep(user, ~gone, Fact(user, family), family)

    def _lead(self, family: str) -> None:
        """What all that is left of a family needs must be, in a place that one of them takes."""
        here = self._left[family]
        for other, rows in self._index.takes[family].items():
            needing = taken = 0
            for option, places in rows:
                if option & here:
                    needing, taken = needing | option, taken | places
            if needing == here:
                fact = Fact(family, other)
                if other not in self._must:
                    self._must.add(other)
                    self._waiting[other] = None
                    self.causes[other].append((fact, family))
                self._keep(other, taken, fact, family)

    def _keep_apart(self, family: str) -> None:
        """Strike out what clashes with the only place that is left of a family."""
        here = self._left[family]
        if here & (here - 1) == 0:
            place = Place(family, here.bit_length() - 1)
            for other in self._index.apart.get(place, ()):
                self._keep(other.family, ~(1 << other.number), clash_of((place, other)), family)

    def _keep(self, family: str, bits: int, fact: Fact, source: str) -> None:
        before = self._left.get(family, 0)
        after = before & bits
        if after != before:
            self._left[family] = after
            self._waiting[family] = None
            self.causes[family].append((fact, source))


def _bits(places: Iterable[int]) -> int:
    found = 0
    for place in places:
        found |= 1 << place
    return found


def _numbers(bits: int) -> Iterator[int]:
    number = 0
    while bits:
        if bits & 1:
            yield number
        bits, number = bits >> 1, number + 1
