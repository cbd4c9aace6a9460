"""What is folded below a change, in words."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from ecm_checker.hub.kinds import row_of
from ecm_checker.release import Change

from ecm_extract.diff.folding import cause_name

With = Callable[[Change], str]


def with_it(changes: Iterable[Change]) -> With:
    """Return the words for what is folded below a change: `with it: 2 topics, 1 parameter`; empty for nothing."""
    counts: dict[str, dict[str, int]] = {}
    for change in changes:
        if change.cause:
            kinds = counts.setdefault(change.cause, {})
            kinds[change.kind] = kinds.get(change.kind, 0) + 1

    def words(change: Change) -> str:
        kinds = counts.get(cause_name(change), {}) if not change.cause else {}
        return f"with it: {', '.join(_count(kind, number) for kind, number in kinds.items())}" if kinds else ""

    return words


def _count(kind: str, number: int) -> str:
    name = kind.replace("_", " ")
    if number == 1:
        return f"1 {name}"
    return f"{number} {row_of(kind).plural or f'{name}s'}"
