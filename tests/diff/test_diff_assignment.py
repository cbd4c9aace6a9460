"""The assignment takes the best set of pairs, not the best first pair."""

from __future__ import annotations

from itertools import permutations

from hypothesis import given, settings
from hypothesis import strategies as st

from ecm_extract.diff.assignment import assign


def test_the_sum_counts_not_the_first_pair() -> None:
    """A greedy choice of 0.9 would leave the second row with nothing worth having."""
    scores = {(0, 0): 0.9, (0, 1): 0.8, (1, 0): 0.85}
    assert assign(scores) == [(0, 1), (1, 0)]


def test_a_pair_without_a_score_is_never_taken() -> None:
    """Candidates that are not alike stay apart."""
    assert assign({(0, 0): 0.7, (1, 0): 0.6}) == [(0, 0)]
    assert assign({}) == []


@settings(max_examples=50, deadline=None)
@given(st.dictionaries(st.tuples(st.integers(0, 3), st.integers(0, 3)), st.floats(0.01, 1), max_size=10))
def test_it_is_as_good_as_trying_all(scores: dict[tuple[int, int], float]) -> None:
    """On small sets the result equals an exhaustive search."""
    best = max(
        sum(scores.get((row, column), 0.0) for row, column in enumerate(order)) for order in permutations(range(4))
    )
    chosen = assign(scores)
    assert abs(sum(scores[pair] for pair in chosen) - best) < 1e-9
    assert len({row for row, _ in chosen}) == len({column for _, column in chosen}) == len(chosen)


def test_a_great_group_is_still_solved() -> None:
    """Past the bound of the exact method every row still gets its own column."""
    scores = {(row, column): 0.5 + (row == column) / 4 for row in range(130) for column in range(130)}
    assert assign(scores) == [(row, row) for row in range(130)]
