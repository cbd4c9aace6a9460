"""Resolution: one release of each requested package and of what it depends on, or the reason why there is none.

Versions decide first; then what is chosen is checked like `check` does (may each be installed, do those that need
each other fit, do all run together), and what is refused is told to the search, until an answer stands.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ecm_checker.operations.system import system
from ecm_checker.profiles import NO_PROFILES, Profiles
from ecm_checker.versions import in_range
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.channels import channels_from
from ecm_extract.registry.choice import NoAnswerError, choose
from ecm_extract.registry.lock import Lock, Locked, Outside, Passed
from ecm_extract.registry.pool import Pool
from ecm_extract.registry.problem import Place, Problem
from ecm_extract.registry.reasons import Reasons
from ecm_extract.registry.refusals import Refusals
from ecm_extract.registry.releases import name_of
from ecm_extract.registry.wishes import Wish


class NoResolutionError(InputError):
    """Nothing fits; the message says why in words, `reasons` one by one."""

    def __init__(self, reasons: Sequence[str]) -> None:
        super().__init__(f"nothing fits: {'; '.join(reasons)}", "loosen one of these")
        self.reasons = tuple(reasons)


def resolve(
    session: Session, wishes: Sequence[Wish], profiles: Profiles = NO_PROFILES, channel: str | None = None
) -> Lock:
    """Choose releases.

    Args:
        session: one that reads.
        wishes: what is requested.
        profiles: of the robot, its governance and what is installed.
        channel: the lowest that may be chosen; None for any.

    Raises:
        NoResolutionError: nothing fits.
        InputError: a requested package is not stored, or there is no such channel.
    """
    pool = Pool(session, wishes)
    return _Resolution(pool, profiles, Refusals(pool, profiles, _channels(profiles, channel))).run()


def _channels(profiles: Profiles, channel: str | None) -> frozenset[str] | None:
    """The channels that may be chosen: from one upwards, and those that the policy lets run."""
    allowed = profiles.policy.release_channels if profiles.policy is not None else None
    above = channels_from(channel) if channel is not None else None
    if allowed is None or above is None:
        found = allowed if allowed is not None else above
        return frozenset(found) if found is not None else None
    return frozenset(above) & frozenset(allowed)


class _Resolution:
    """One run over a pool."""

    def __init__(self, pool: Pool, profiles: Profiles, refusals: Refusals) -> None:
        self._pool, self._profiles, self._refusals = pool, profiles, refusals
        self._reasons = Reasons(pool, refusals)

    def run(self) -> Lock:
        """Choose, check, and choose again until nothing more is refused."""
        while True:
            problem = self._pool.problem(frozenset(self._refusals.excluded), frozenset(self._refusals.clashes))
            try:
                chosen = choose(problem)
            except NoAnswerError as error:
                raise NoResolutionError([*self._reasons.conflict(error.facts)]) from None
            if not self._refusals.check(chosen):
                return self._lock(chosen, problem)

    def _lock(self, chosen: Mapping[str, int], problem: Problem) -> Lock:
        places = [Place(*item) for item in sorted(chosen.items())]
        contracts = [each for place in places for each in self._pool.package(place).contracts()]
        together = system(contracts, self._profiles, together=False) if contracts else None
        return Lock(
            requests=tuple(self._pool.wishes),
            releases=tuple(self._locked(place, chosen) for place in places),
            outside=tuple(dict.fromkeys(each for place in places for each in self._outside(place))),
            passed=tuple(each for place in places for each in self._passed(place, chosen, problem)),
            findings=together.findings if together is not None else (),
        )

    def _locked(self, place: Place, chosen: Mapping[str, int]) -> Locked:
        release, standing = self._pool.releases[place.family][place.number]
        asked = ["request"] if any(wish.package == place.family for wish in self._pool.wishes) else []
        users = [self._pool.release(Place(*item)) for item in sorted(chosen.items())]
        by = [name_of(each) for each in users if place.family in self._pool.needs[each.id]]
        where = (release.repository, release.tag, release.commit, standing.channel)
        return Locked(place.family, release.version, f"sha256:{release.digest}", *where, (*asked, *by))

    def _outside(self, place: Place) -> Iterator[Outside]:
        installed = self._profiles.runtime.versions if self._profiles.runtime is not None else {}
        release = self._pool.release(place)
        for name, wanted in sorted(self._pool.needs[release.id].items()):
            if name not in self._pool.releases:
                known = name in installed and in_range(installed[name], wanted) is True
                yield Outside(name, wanted, name_of(release), known)

    def _passed(self, place: Place, chosen: Mapping[str, int], problem: Problem) -> Iterator[Passed]:
        for number in range(place.number):
            better = Place(place.family, number)
            yield Passed(name_of(self._pool.release(better)), self._reasons.why_not(better, chosen, problem))
