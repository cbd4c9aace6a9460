"""One release of each family, best first.

The answer is defined, so that it does not depend on the search: families are taken in the order in which they are
asked for (those that are requested, then what the chosen ones need, breadth first), and each gets the best release
with which there is an answer. What cannot be in any answer is struck out first, again after each release that is
fixed; where that decides, no search is needed.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import msgspec

from ecm_extract.registry.narrowing import Narrowed, cause_of, narrowed
from ecm_extract.registry.problem import Fact, Place, Problem
from ecm_extract.registry.search import any_answer


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
    start = narrowed(problem)
    found = None if start is None else _straight(problem, start) or _searched(problem)
    if found is None:
        raise NoAnswerError(_conflict(problem))
    return found


def _straight(problem: Problem, start: Narrowed) -> dict[str, int] | None:
    """The answer that is found without a search: each family's best release that leaves all others something.

    What was passed over is in no answer, so that the end of the way is the best one; without an end nothing is known.
    """
    fixed: dict[str, int] = {}
    left, waiting = start, deque(problem.requests)
    while waiting:
        family = waiting.popleft()
        if family not in fixed:
            tried = ((number, left.fixed_at(Place(family, number))) for number in left.places(family))
            best = next(((number, after) for number, after in tried if after is not None), None)
            if best is None:
                return None
            fixed[family], left = best
            waiting += sorted(problem.families[family][fixed[family]].needs)
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
    start = narrowed(problem)
    found = None if start is None else any_answer(problem, start.domains)
    if start is None or found is None:
        return None
    fixed: dict[str, int] = {}
    left, waiting = start, deque(problem.requests)
    while waiting:
        family = waiting.popleft()
        if family not in fixed:
            found, left = _improved(problem, found, left, family)
            fixed[family] = found[family]
            waiting += sorted(problem.families[family][found[family]].needs)
    return fixed


def _improved(problem: Problem, found: dict[str, int], left: Narrowed, family: str) -> tuple[dict[str, int], Narrowed]:
    """An answer with the best release of a family that goes with what is fixed, and what that leaves."""
    for number in left.places(family):
        after = left.fixed_at(Place(family, number))
        if number == found[family]:
            assert after is not None, "an answer is never struck out"
            return found, after
        better = any_answer(problem, after.domains) if after is not None else None
        if after is not None and better is not None:
            return better, after
    message = f"the answer of {family} is struck out"
    raise AssertionError(message)


def _answer(problem: Problem) -> dict[str, int] | None:
    start = narrowed(problem)
    return None if start is None else any_answer(problem, start.domains)


def _conflict(problem: Problem) -> list[Fact]:
    """Facts that stand against each other, none of which can be left out, and few of them.

    Looked for is among the facts by which everything is struck out, or among all where only a search has found that
    there is no answer; without each fact of what was found there may be a shorter conflict.
    """
    facts = sorted(cause_of(problem) or problem.facts())
    best = _explained(problem, [], False, facts)
    for fact in best:
        rest = [each for each in facts if each != fact]
        if _answer(problem.only(rest)) is None:
            best = min(best, _explained(problem, [], False, rest), key=len)
    return best


def _explained(problem: Problem, background: list[Fact], grown: bool, facts: list[Fact]) -> list[Fact]:
    """Facts that with a background have no answer, none of which can be left out (QuickXplain, Junker 2004)."""
    if grown and _answer(problem.only(background)) is None:
        return []
    if len(facts) == 1:
        return facts
    half = len(facts) // 2
    first, second = facts[:half], facts[half:]
    of_second = _explained(problem, [*background, *first], True, second)
    of_first = _explained(problem, [*background, *of_second], bool(of_second), first)
    return [*of_first, *of_second]
