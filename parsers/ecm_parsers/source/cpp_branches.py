"""Conditional branches that open or close blocks: a grammar without a preprocessor sees all of them at once."""

from typing import NamedTuple

from ecm_parsers.source.cpp_directives import Bracket, directives_and_brackets
from ecm_parsers.source.cpp_text import blanked_at

_STEP = {b"{": (1, 0), b"}": (-1, 0), b"(": (0, 1), b")": (0, -1)}

_Balance = tuple[int, int]
"""How many braces and parentheses are open."""


class _Group(NamedTuple):
    """An `#if` that is not closed yet: the balance before it, its directives and the balance of each branch."""

    before: _Balance
    directives: list[tuple[int, int]]
    balances: list[_Balance]


def with_one_branch(data: bytes) -> bytes:
    """Return `data` with one branch of each `#if` whose branches open or close blocks, length unchanged.

    `#if A`, `if (x) {`, `#else`, `if (y) {`, `#endif` opens two blocks of which the code below closes one. Which
    branch a build takes is not known, so the first one stands for all.
    """
    return blanked_at(data, _dropped(data))


def _dropped(data: bytes) -> list[tuple[int, int]]:
    """Return the parts to blank."""
    groups: list[_Group] = []
    ranges: list[tuple[int, int]] = []
    balance = (0, 0)
    for each in directives_and_brackets(data):
        if isinstance(each, Bracket):
            step = _STEP[each.sign]
            balance = (balance[0] + step[0], balance[1] + step[1])
        elif each.word.startswith(b"if"):
            groups.append(_Group(balance, [(each.start, each.end)], []))
        elif each.word.startswith((b"el", b"endif")) and groups:
            group = groups[-1]
            group.directives.append((each.start, each.end))
            group.balances.append((balance[0] - group.before[0], balance[1] - group.before[1]))
            balance = group.before
            if each.word == b"endif":
                groups.pop()
                ranges += _parts(group)
                balance = (group.before[0] + group.balances[0][0], group.before[1] + group.balances[0][1])
    return ranges


def _parts(group: _Group) -> list[tuple[int, int]]:
    """The directives of a group that splits blocks, and its branches after the first."""
    if all(balance == (0, 0) for balance in group.balances):
        return []
    first, *others = group.directives
    return [first, (others[0][0], others[-1][1])]
