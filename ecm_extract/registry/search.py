"""Any answer to a choice, found by resolvelib.

What may not stand together is told to it by a second, conditional name of each family, whose release is `ABSENT` where
the family is not needed.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final, NamedTuple

from resolvelib import AbstractProvider, BaseReporter, ResolutionImpossible
from resolvelib.resolvers import Resolution

from ecm_extract.registry.problem import Place, Problem

ABSENT: Final = -1
_ROUNDS: Final = 1_000_000


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

    def __init__(self, problem: Problem, domains: Mapping[str, frozenset[int]]) -> None:
        self._problem, self._domains = problem, domains
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
        allowed = sorted(self._domains.get(name.family, ()))
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


def any_answer(problem: Problem, domains: Mapping[str, frozenset[int]]) -> dict[str, int] | None:
    """Return an answer within domains; None when there is none."""
    wanted = [_Wanted(_Name(name, conditional=False), places) for name, places in problem.requests.items()]
    resolution = Resolution(_Provider(problem, domains), BaseReporter())
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
