"""Which extracted interface is the one that a row of unseen truth names."""

from __future__ import annotations

import re

from accuracy import match_row
from extracted import Interface
from truth_format import same_type
from unseen_format import SourceNode, SourceRow, resolved


def best(row: SourceRow, interfaces: list[Interface], node: SourceNode) -> Interface | None:
    """By resolved name, all holes alike, or by pattern, the type preferred; without a name by its place."""
    fitting = [one for one in interfaces if one.role == row.role]
    same = [one for one in fitting if resolved(row.name, node.name) == resolved(one.name, node.name)]
    if same:
        return max(same, key=lambda one: bool(row.type and one.type and same_type(row.type, one.type)))
    typed = [one for one in fitting if row.type and one.type and same_type(row.type, one.type)]
    found = None if row.name.startswith("{") else match_row(row, typed)[0] or match_row(row, fitting)[0]
    return found or next((one for one in [*typed, *fitting] if is_open(one) and _is_at(row, one)), None)


def is_open(one: Interface) -> bool:
    """Whether nothing of the name is told."""
    return not re.search(r"\w", re.sub(r"\{[^{}]*\}", "", one.name))


def _is_at(row: SourceRow, one: Interface) -> bool:
    path, _, line = (row.where or "").rpartition(":")
    return any(path.endswith(place.path) and place.line == int(line) for place in one.evidence)
