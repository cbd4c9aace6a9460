"""One release of each family, best first: the search, without knowing what a release is.

The answer is defined, so that it does not depend on the search: families are taken in the order in which they are
asked for (those that are requested, then what the chosen ones need, breadth first), and each gets the best release
with which there is an answer. resolvelib finds answers; what may not stand together is told to it by a second,
conditional name of each family, whose release is `ABSENT` where the family is not needed.
"""

from __future__ import annotations

from collections import defaultdict, deque
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple

import msgspec
from resolvelib import AbstractProvider, BaseReporter, ResolutionImpossible
from resolvelib.resolvers import Resolution

ABSENT: Final = -1
_ROUNDS: Final = 1_000_000


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
        found |= {_clash(pair) for pair in self.clashes}
        return sorted(found)

    def only(self, facts: Iterable[Fact]) -> Problem:
        """Return the problem with these facts alone."""
        kept = frozenset(facts)
        families = {
            name: [Option(each.version, _kept(name, each, kept)) for each in options]
            for name, options in self.families.items()
        }
        clashes = {pair for pair in self.clashes if _clash(pair) in kept}
        requests = {name: places for name, places in self.requests.items() if Fact(name) in kept}
        return Problem(families, requests, self.excluded, frozenset(clashes))


def _clash(pair: tuple[Place, Place]) -> Fact:
    first, second = sorted((pair[0].family, pair[1].family))
    return Fact(first, second, clash=True)


def _kept(name: str, option: Option, kept: frozenset[Fact]) -> Mapping[str, frozenset[int]]:
    return {other: places for other, places in option.needs.items() if Fact(name, other) in kept}


class NoAnswerError(Exception):
    """There is no answer; `facts` stand against each other, and none of them can be left out."""

    def __init__(self, facts: Sequence[Fact]) -> None:
        super().__init__(facts)
        self.facts = tuple(facts)


def choose(problem: Problem) -> dict[str, int]:
    """Return the places that are chosen, by family, in the order in which they are asked for.

    Raises:
        NoAnswerError: there is no answer.
    """
    found = _straight(problem) or _searched(problem)
    if found is None:
        raise NoAnswerError(_conflict(problem))
    return found


def _straight(problem: Problem) -> dict[str, int] | None:
    """The answer that is found without a search: each family's best release that goes with those before it.

    When all that comes later goes with it, it is the best answer; else nothing is known.
    """
    fixed: dict[str, int] = {}
    waiting = deque(problem.requests)
    while waiting:
        family = waiting.popleft()
        places = (Place(family, number) for number in range(len(problem.families[family])))
        if family not in fixed:
            first = next((each for each in places if _may_go(problem, each, fixed)), None)
            if first is None:
                return None
            fixed[family] = first.number
            waiting += sorted(problem.families[family][first.number].needs)
    return fixed


def _searched(problem: Problem) -> dict[str, int] | None:
    """Search; clashes are told when an answer has them, as few of the many that there may be ever matter.

    An answer that is best without the others and has none of them is the best with all.
    """
    told: frozenset[tuple[Place, Place]] = frozenset()
    while True:
        found = _best(msgspec.structs.replace(problem, clashes=told))
        places = {Place(*item) for item in (found or {}).items()}
        violated = {pair for pair in problem.clashes if places.issuperset(pair)}
        if not violated:
            return found
        told |= violated


def _best(problem: Problem) -> dict[str, int] | None:
    found = _solve(problem, {})
    if found is None:
        return None
    fixed: dict[str, int] = {}
    waiting = deque(problem.requests)
    while waiting:
        family = waiting.popleft()
        if family not in fixed:
            found = _improved(problem, found, fixed, family)
            fixed[family] = found[family]
            waiting += sorted(problem.families[family][found[family]].needs)
    return fixed


def _improved(problem: Problem, found: dict[str, int], fixed: Mapping[str, int], family: str) -> dict[str, int]:
    """An answer with the best release of a family that goes with those that are fixed."""
    best = found[family]
    for number in range(best):
        if _may_go(problem, Place(family, number), fixed):
            better = _solve(problem, {**fixed, family: number})
            if better is not None:
                return better
    return found


def _may_go(problem: Problem, place: Place, fixed: Mapping[str, int]) -> bool:
    """Whether nothing that is fixed speaks against a place; saves a search."""
    if place in problem.excluded or place.number not in problem.requests.get(place.family, {place.number}):
        return False
    option = problem.families[place.family][place.number]
    for name, number in fixed.items():
        other = Place(name, number)
        needed = problem.families[name][number].needs.get(place.family)
        if (place, other) in problem.clashes or (other, place) in problem.clashes:
            return False
        if (needed is not None and place.number not in needed) or number not in option.needs.get(name, {number}):
            return False
    return True


class _Name(NamedTuple):
    """What resolvelib pins: a family, or what is to be where it is needed."""

    family: str
    conditional: bool


class _Wanted(NamedTuple):
    """A name and the places that will do."""

    name: _Name
    places: frozenset[int]


class _Candidate(NamedTuple):
    """A name at a place."""

    name: _Name
    number: int


class _Provider(AbstractProvider[_Wanted, _Candidate, _Name]):
    """Tells resolvelib of a problem."""

    def __init__(self, problem: Problem, fixed: Mapping[str, int]) -> None:
        self._problem, self._fixed = problem, fixed
        self._order = {name: number for number, name in enumerate((*problem.requests, *sorted(problem.families)))}
        self._clashing: dict[Place, list[Place]] = defaultdict(list)
        for one, other in sorted(problem.clashes):
            self._clashing[one].append(other)
            self._clashing[other].append(one)
        self._conditional = {place.family for place in self._clashing}
        self._known: dict[_Name, Sequence[int]] = {}

    def identify(self, requirement_or_candidate: _Wanted | _Candidate) -> _Name:
        return requirement_or_candidate.name

    def get_preference(
        self, identifier: _Name, resolutions: Any, candidates: Any, information: Any, backtrack_causes: Any
    ) -> tuple[bool, bool, int]:
        """Families before conditions; those with one release left first."""
        return identifier.conditional, len(self._places(identifier)) != 1, self._order[identifier.family]

    def find_matches(
        self,
        identifier: _Name,
        requirements: Mapping[_Name, Iterator[_Wanted]],
        incompatibilities: Mapping[_Name, Iterator[_Candidate]],
    ) -> list[_Candidate]:
        """The best first."""
        refused = {each.number for each in incompatibilities[identifier]}
        wanted = [each.places for each in requirements[identifier]]
        places = [each for each in self._places(identifier) if each not in refused]
        return [_Candidate(identifier, each) for each in places if all(each in among for among in wanted)]

    def _places(self, name: _Name) -> Sequence[int]:
        found = self._known.get(name)
        if found is None:
            found = self._known[name] = self._open_places(name)
        return found

    def _open_places(self, name: _Name) -> Sequence[int]:
        if name.family in self._fixed and not name.conditional:
            return (self._fixed[name.family],)
        places: Iterable[int] = range(len(self._problem.families.get(name.family, ())))
        allowed = [each for each in places if Place(name.family, each) not in self._problem.excluded]
        return [*allowed, ABSENT] if name.conditional else allowed

    def is_satisfied_by(self, requirement: _Wanted, candidate: _Candidate) -> bool:
        return candidate.number in requirement.places

    def get_dependencies(self, candidate: _Candidate) -> list[_Wanted]:
        """What a release needs, and what may not stand beside it."""
        family, number = candidate.name.family, candidate.number
        if candidate.name.conditional:
            return []
        needs = self._problem.families[family][number].needs
        found = [_Wanted(_Name(name, conditional=False), places) for name, places in sorted(needs.items())]
        if family in self._conditional:
            found.append(_Wanted(_Name(family, conditional=True), frozenset({number})))
        return [*found, *self._apart(Place(family, number))]

    def _apart(self, place: Place) -> Iterator[_Wanted]:
        against: dict[str, set[int]] = defaultdict(set)
        for other in self._clashing.get(place, ()):
            against[other.family].add(other.number)
        for name, numbers in against.items():
            rest = frozenset(range(len(self._problem.families[name]))) - numbers
            yield _Wanted(_Name(name, conditional=True), rest | {ABSENT})


def _solve(problem: Problem, fixed: Mapping[str, int]) -> dict[str, int] | None:
    """Any answer with what is fixed; None when there is none."""
    wanted = [_Wanted(_Name(name, conditional=False), places) for name, places in problem.requests.items()]
    resolution = Resolution(_Provider(problem, fixed), BaseReporter())
    try:
        mapping = resolution.resolve(wanted, max_rounds=_ROUNDS).mapping
    except ResolutionImpossible:
        return None
    pinned = {name.family: each.number for name, each in mapping.items() if not name.conditional}
    return _reached(problem, pinned)


def _reached(problem: Problem, pinned: Mapping[str, int]) -> dict[str, int]:
    """What is asked for; what was needed by a release that was given up is left out."""
    found: dict[str, int] = {}
    waiting = list(problem.requests)
    while waiting:
        family = waiting.pop()
        if family not in found:
            found[family] = pinned[family]
            waiting += problem.families[family][pinned[family]].needs
    return found


def _conflict(problem: Problem) -> list[Fact]:
    """Facts that stand against each other, none of which can be left out (QuickXplain, Junker 2004)."""
    return _explained(problem, [], False, problem.facts())


def _explained(problem: Problem, background: list[Fact], grown: bool, facts: list[Fact]) -> list[Fact]:
    if grown and _solve(problem.only(background), {}) is None:
        return []
    if len(facts) == 1:
        return facts
    half = len(facts) // 2
    first, second = facts[:half], facts[half:]
    of_second = _explained(problem, [*background, *first], True, second)
    of_first = _explained(problem, [*background, *of_second], bool(of_second), first)
    return [*of_first, *of_second]
