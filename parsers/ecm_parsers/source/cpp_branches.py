"""Conditional branches that open or close blocks: a grammar without a preprocessor sees all of them at once."""

import re
from typing import NamedTuple

from ecm_parsers.source.cpp_text import blanked

_TOKEN = re.compile(
    rb"""(?P<directive>^[ \t]*\#[ \t]*(?P<word>if|elif|else|endif)?(?:[^\n\\]|\\.)*)"""
    rb"""|//[^\n]*|/\*(?:[^*]|\*(?!/))*(?:\*/)?|"(?:[^"\\\n]|\\.)*"?|'(?:[^'\\\n]|\\.)'|(?P<bracket>[{}()])""",
    re.MULTILINE | re.VERBOSE | re.DOTALL,
)
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
    ranges = _dropped(data)
    if not ranges:
        return data
    pieces, position = [], 0
    for start, end in ranges:
        if end > position:
            pieces += [data[position : max(start, position)], blanked(data[max(start, position) : end])]
            position = end
    return b"".join([*pieces, data[position:]])


def _dropped(data: bytes) -> list[tuple[int, int]]:
    """Return the parts to blank, in order."""
    groups: list[_Group] = []
    ranges: list[tuple[int, int]] = []
    balance = (0, 0)
    for match in _TOKEN.finditer(data):
        step = _STEP.get(match["bracket"] or b"")
        if step is not None:
            balance = (balance[0] + step[0], balance[1] + step[1])
        word = match["word"]
        if word == b"if":
            groups.append(_Group(balance, [match.span()], []))
        elif word is not None and groups:
            group = groups[-1]
            group.directives.append(match.span())
            group.balances.append((balance[0] - group.before[0], balance[1] - group.before[1]))
            balance = group.before
            if word == b"endif":
                groups.pop()
                ranges += _parts(group)
                balance = (group.before[0] + group.balances[0][0], group.before[1] + group.balances[0][1])
    return sorted(ranges)


def _parts(group: _Group) -> list[tuple[int, int]]:
    """The directives of a group that splits blocks, and its branches after the first."""
    if all(balance == (0, 0) for balance in group.balances):
        return []
    first, *others = group.directives
    return [first, (others[0][0], others[-1][1])]
