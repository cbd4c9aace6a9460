"""The best one-to-one assignment of candidates (Kuhn 1955, in the O(n^3) form with potentials).

Candidates fall into small groups that share no member, so each group is solved by itself. The library function
for this costs a quarter of a second to import; a group of a release has a dozen members.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping

MAX_GROUP = 120
_INFINITE = float("inf")
Scores = Mapping[tuple[int, int], float]


def assign(scores: Scores) -> list[tuple[int, int]]:
    """Return the pairs (row, column) that have the greatest sum of scores; a pair without a score is never taken.

    Args:
        scores: 0 to 1 by (row, column).
    """
    chosen: list[tuple[int, int]] = []
    for group in _groups(scores):
        rows = sorted({row for row, _ in group})
        columns = sorted({column for _, column in group})
        if max(len(rows), len(columns)) > MAX_GROUP:
            chosen += _greedy(group)
        else:
            chosen += _exact(rows, columns, group)
    return sorted(chosen)


def _groups(scores: Scores) -> list[dict[tuple[int, int], float]]:
    """Split into connected components."""
    by_row: dict[int, list[int]] = defaultdict(list)
    by_column: dict[int, list[int]] = defaultdict(list)
    for row, column in scores:
        by_row[row].append(column)
        by_column[column].append(row)
    seen: set[int] = set()
    groups = []
    for start in by_row:
        if start in seen:
            continue
        members, pending = {start}, [start]
        while pending:
            row = pending.pop()
            near = {other for column in by_row[row] for other in by_column[column]} - members
            members |= near
            pending += near
        seen |= members
        groups.append({(row, column): scores[row, column] for row in members for column in by_row[row]})
    return groups


def _greedy(group: Scores) -> list[tuple[int, int]]:
    rows: set[int] = set()
    columns: set[int] = set()
    chosen = []
    for (row, column), _ in sorted(group.items(), key=lambda item: (-item[1], item[0])):
        if row not in rows and column not in columns:
            rows.add(row)
            columns.add(column)
            chosen.append((row, column))
    return chosen


def _exact(rows: list[int], columns: list[int], group: Scores) -> list[tuple[int, int]]:
    size = max(len(rows), len(columns))
    cost = [
        [-group.get((rows[i], columns[j]), 0.0) if i < len(rows) and j < len(columns) else 0.0 for j in range(size)]
        for i in range(size)
    ]
    matched = _minimise(cost)
    pairs = [(rows[i], columns[j]) for i, j in matched if i < len(rows) and j < len(columns)]
    return [pair for pair in pairs if pair in group]


def _minimise(cost: list[list[float]]) -> list[tuple[int, int]]:
    """Return the (row, column) pairs of least cost of a square matrix."""
    size = len(cost)
    row_potential, column_potential = [0.0] * (size + 1), [0.0] * (size + 1)
    row_of, way = [0] * (size + 1), [0] * (size + 1)
    for row in range(1, size + 1):
        row_of[0] = row
        column = 0
        least, used = [_INFINITE] * (size + 1), [False] * (size + 1)
        while row_of[column] != 0:
            used[column] = True
            column = _step(cost, (row_potential, column_potential), (row_of, way), (least, used), column)
        while column:
            previous = way[column]
            row_of[column] = row_of[previous]
            column = previous
    return [(row_of[column] - 1, column - 1) for column in range(1, size + 1)]


def _step(
    cost: list[list[float]],
    potentials: tuple[list[float], list[float]],
    matching: tuple[list[int], list[int]],
    search: tuple[list[float], list[bool]],
    column: int,
) -> int:
    """Grow the alternating tree by one column and return it."""
    (rows, columns), (row_of, way), (least, used) = potentials, matching, search
    row, delta, best = row_of[column], _INFINITE, 0
    for other in range(1, len(columns)):
        if used[other]:
            continue
        reduced = cost[row - 1][other - 1] - rows[row] - columns[other]
        if reduced < least[other]:
            least[other], way[other] = reduced, column
        if least[other] < delta:
            delta, best = least[other], other
    for other in range(len(columns)):
        if used[other]:
            rows[row_of[other]] += delta
            columns[other] -= delta
        else:
            least[other] -= delta
    return best
