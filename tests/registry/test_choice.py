"""The search against all possibilities, on random registries."""

from __future__ import annotations

import itertools
import random
import time
from collections import deque
from collections.abc import Iterator

import pytest

from ecm_extract.registry.choice import NoAnswerError, choose
from ecm_extract.registry.problem import Fact, Option, Place, Problem

_COUNT = 1000


def _random(seed: int) -> Problem:
    """At most five families of at most three releases, dense enough that a good part has no answer."""
    dice = random.Random(seed)
    names = [f"f{number}" for number in range(dice.randint(2, 5))]
    sizes = {name: dice.randint(1, 3) for name in names}
    families = {name: [_option(dice, name, sizes) for _ in range(sizes[name])] for name in names}
    places = [Place(name, number) for name in names for number in range(sizes[name])]
    pairs = [pair for pair in itertools.combinations(places, 2) if pair[0].family != pair[1].family]
    clashes = frozenset(dice.sample(pairs, min(len(pairs), dice.randint(0, 6))))
    excluded = frozenset(dice.sample(places, dice.randint(0, 1)))
    asked = dice.sample(names, dice.randint(1, 2))
    return Problem(families, {name: _some(dice, sizes[name]) for name in asked}, excluded, clashes)


def _option(dice: random.Random, name: str, sizes: dict[str, int]) -> Option:
    others = [other for other in sizes if other != name]
    needs = {other: _some(dice, sizes[other]) for other in dice.sample(others, min(len(others), dice.randint(0, 2)))}
    return Option("1.0.0", needs)


def _some(dice: random.Random, size: int) -> frozenset[int]:
    return frozenset(dice.sample(range(size), dice.randint(1, size)))


def _answers(problem: Problem) -> Iterator[dict[str, int]]:
    """Every choice that holds, looked at one by one."""
    names = sorted(problem.families)
    for chosen in itertools.product(*(range(-1, len(problem.families[name])) for name in names)):
        choice = {name: number for name, number in zip(names, chosen, strict=True) if number >= 0}
        if _holds(problem, choice):
            yield choice


def _holds(problem: Problem, choice: dict[str, int]) -> bool:
    places = {Place(*item) for item in choice.items()}
    asked = all(choice.get(name, -1) in allowed for name, allowed in problem.requests.items())
    apart = all(not {one, other} <= places for one, other in problem.clashes)
    met = all(
        choice.get(other, -1) in allowed
        for name, number in choice.items()
        for other, allowed in problem.families[name][number].needs.items()
    )
    return asked and apart and met and not places & problem.excluded


def _best(problem: Problem) -> dict[str, int] | None:
    """The answer by its definition."""
    left = list(_answers(problem))
    if not left:
        return None
    fixed: dict[str, int] = {}
    waiting = deque(problem.requests)
    while waiting:
        family = waiting.popleft()
        if family not in fixed:
            fixed[family] = min(each[family] for each in left)
            left = [each for each in left if each[family] == fixed[family]]
            waiting += sorted(problem.families[family][fixed[family]].needs)
    return fixed


def _chosen(problem: Problem) -> dict[str, int] | None:
    try:
        return choose(problem)
    except NoAnswerError:
        return None


def test_the_answer_is_that_of_trying_everything() -> None:
    """On a thousand registries, of which some have an answer and some have none."""
    answers = [(_chosen(_random(seed)), _best(_random(seed))) for seed in range(_COUNT)]
    assert [seed for seed, (found, best) in enumerate(answers) if found != best] == []
    assert 200 < sum(found is None for found, _ in answers) < 800


def test_nothing_can_be_left_out_of_a_conflict() -> None:
    """Its facts have no answer, and without any of them there is one."""
    problems = [_random(seed) for seed in range(_COUNT // 4)]
    conflicts = [(problem, facts) for problem in problems if (facts := _refused(problem))]
    assert len(conflicts) > 20
    for problem, facts in conflicts:
        assert _best(problem.only(facts)) is None
        for fact in facts:
            assert _best(problem.only(each for each in facts if each != fact)) is not None


def _refused(problem: Problem) -> tuple[Fact, ...]:
    try:
        choose(problem)
    except NoAnswerError as error:
        return error.facts
    return ()


def test_the_order_of_the_input_does_not_matter() -> None:
    """Families in another order, the same answer."""
    for seed in range(100):
        problem = _random(seed)
        turned = dict(reversed(list(problem.families.items())))
        assert _chosen(problem) == _chosen(Problem(turned, problem.requests, problem.excluded, problem.clashes))


def test_a_conflict_in_facts() -> None:
    """Two requests need different releases of a third."""
    one, two = frozenset({0}), frozenset({1})
    families = {
        "a": [Option("1", {"c": one})],
        "b": [Option("1", {"c": two})],
        "c": [Option("2"), Option("1")],
        "d": [Option("1", {"c": one})],
    }
    with pytest.raises(NoAnswerError) as error:
        choose(Problem(families, {"d": one, "a": one, "b": one}))
    assert len(error.value.facts) == 4
    assert Fact("b", "c") in error.value.facts


def _large(families: int, releases: int, seed: int) -> Problem:
    """Each release needs some of the later families, most releases of them; some pairs clash."""
    dice = random.Random(seed)
    names = [f"f{number:03}" for number in range(families)]
    built: dict[str, list[Option]] = {}
    for number, name in enumerate(names):
        later = names[number + 1 : number + 20]
        built[name] = []
        for place in range(releases):
            needs = dice.sample(later, min(len(later), 3))
            ranges = {other: frozenset(range(max(0, place - dice.randint(0, 8)), releases)) for other in needs}
            built[name].append(Option(str(releases - place), ranges))
    pairs = ((dice.choice(names), dice.choice(names)) for _ in range(families))
    clashes = {
        (Place(one, dice.randrange(releases)), Place(other, dice.randrange(releases)))
        for one, other in pairs
        if one != other
    }
    return Problem(built, {name: frozenset(range(releases)) for name in names[:10]}, frozenset(), frozenset(clashes))


def test_five_hundred_families_of_twenty_releases() -> None:
    """In two seconds of this process."""
    problem = _large(500, 20, 16)
    choose(_large(20, 20, 1))  # whatever is made once
    begun = time.process_time()
    found = choose(problem)
    took = time.process_time() - begun
    assert len(found) > 300
    assert took < 2.0, took


def _dead_end(seed: int, ends: int, answer: bool) -> Problem:
    """All releases of some late families need old releases of early ones, which are fixed long before them."""
    problem, dice = _large(500, 20, seed), random.Random(seed)
    chosen, families, requests = choose(problem), dict(problem.families), dict(problem.requests)
    late, early = [name for name in list(chosen) if name > "f440"], list(problem.requests)
    for name in dice.sample(late, ends):
        other = dice.choice(early)
        needs = {other: frozenset(range(3, 20))}
        families[name] = [Option(each.version, {**each.needs, **needs}) for each in families[name]]
        if not answer:
            requests |= {name: frozenset(range(20)), other: frozenset({0})}
    return Problem(families, requests, problem.excluded, problem.clashes)


@pytest.mark.parametrize("ends", [1, 5, 20])
def test_what_comes_late_rules_out_what_comes_early(ends: int) -> None:
    """Where the best of each family has no answer, in two seconds as well."""
    problem = _dead_end(3, ends, answer=True)
    begun = time.process_time()
    found = choose(problem)
    assert time.process_time() - begun < 2.0
    assert _holds(problem, found)


def test_a_conflict_among_five_hundred_families() -> None:
    """Three facts of many thousand, in two seconds."""
    problem = _dead_end(3, 1, answer=False)
    begun = time.process_time()
    facts = _refused(problem)
    assert time.process_time() - begun < 2.0
    assert len(facts) == 3


def test_of_two_conflicts_the_shorter_one() -> None:
    """A chain of requests that ends in nothing, and two that stand against each other."""
    only, other = frozenset({0}), frozenset({1})
    chain = {f"c{number}": [Option("1", {f"c{number + 1}": only})] for number in range(5)}
    two = {"a": [Option("2"), Option("1")], "c5": [Option("1", {"a": only})], "b": [Option("1", {"a": other})]}
    requests = {"b": only, "c0": only, "a": only}
    assert len(_refused(Problem({**chain, **two}, requests))) == 3
