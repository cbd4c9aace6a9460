"""Why releases were not chosen, and why there is no answer, in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ecm_extract.registry.pool import Pool
from ecm_extract.registry.problem import Fact, Place, Problem
from ecm_extract.registry.refusals import Refusals
from ecm_extract.registry.releases import name_of


class Reasons:
    """Words for what a pool holds and what of it is refused."""

    def __init__(self, pool: Pool, refusals: Refusals) -> None:
        self._pool, self._refusals = pool, refusals

    def why_not(self, place: Place, chosen: Mapping[str, int], problem: Problem) -> str:
        """Return why a release that is better than the one that was chosen was passed over."""
        if place in self._refusals.excluded:
            return self._refusals.excluded[place]
        for pair, why in sorted(self._refusals.clashes.items()):
            if place in pair:
                other = pair[0] if pair[1] == place else pair[1]
                return f"not with {name_of(self._pool.release(other))}: {why}"
        for wish in self._pool.wishes:
            if wish.package == place.family and place.number not in problem.requests[place.family]:
                return f"{wish.wanted} is requested"
        for name, number in sorted(chosen.items()):
            user = self._pool.release(Place(name, number))
            if place.number not in problem.families[name][number].needs.get(place.family, {place.number}):
                return f"{name_of(user)} needs {self._pool.needs[user.id][place.family]}"
        return "there is no answer with it"

    def conflict(self, facts: Sequence[Fact]) -> Iterator[str]:
        """A conflict in words: each fact, then why releases of its families are left out."""
        for fact in facts:
            yield self._fact(fact)
        families = dict.fromkeys(name for fact in facts for name in (fact.family, fact.needs) if name)
        for place, why in sorted(self._refusals.excluded.items()):
            if place.family in families:
                yield f"{name_of(self._pool.release(place))} is left out: {why}"

    def _fact(self, fact: Fact) -> str:
        if fact.clash:
            pairs = {(one.family, other.family): why for (one, other), why in sorted(self._refusals.clashes.items())}
            why = pairs.get((fact.family, fact.needs)) or pairs.get((fact.needs, fact.family), "")
            return f"{fact.family} and {fact.needs} do not go together: {why}"
        if not fact.needs:
            wanted = [wish.wanted for wish in self._pool.wishes if wish.package == fact.family]
            ranges = "".join(f" {each}" for each in wanted if each != "*")
            return f"{fact.family}{ranges} is requested"
        needed = {self._pool.needs[release.id].get(fact.needs) for release, _ in self._pool.releases[fact.family]}
        return f"{fact.family} needs {fact.needs} {' or '.join(sorted(filter(None, needed)))}"
