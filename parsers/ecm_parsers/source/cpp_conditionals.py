"""Text of C++ without its conditional directives, where these keep a grammar without a preprocessor from reading it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, TypeAlias

from ecm_parsers.source.cpp_directives import Directive, directives
from ecm_parsers.source.cpp_text import blanked_at

_BEGINNING: Final = frozenset({b"if", b"ifdef", b"ifndef"})
_GOING_ON: Final = frozenset({b"elif", b"else", b"endif"})
Span: TypeAlias = tuple[int, int]
"""Where something begins and ends, in bytes."""


def without_conditionals(data: bytes, errors: Sequence[Span] | None = None) -> bytes:
    """Return `data` with lines of `#if`, `#else` and `#endif` blanked, all branches kept, length unchanged.

    Args:
        data: a file.
        errors: what could not be read: only conditionals of which one of these has a directive; None: all of them.
    """
    groups = (group for group in _groups(data) if errors is None or _touches(group, errors))
    return blanked_at(data, [(each.start, each.end) for group in groups for each in group])


def _groups(data: bytes) -> Iterator[list[Directive]]:
    """Yield the directives of each conditional, without those of conditionals within it."""
    open_: list[list[Directive]] = []
    for each in directives(data):
        if each.word in _BEGINNING:
            open_.append([each])
        elif each.word in _GOING_ON:
            if not open_:
                open_.append([])
            open_[-1].append(each)
            if each.word == b"endif":
                yield open_.pop()
    yield from open_


def _touches(group: Sequence[Directive], errors: Sequence[Span]) -> bool:
    """Whether an error has a directive of a conditional in it; around a whole file one may stand for another reason."""
    return any(start <= each.end and end >= each.start for each in group for start, end in errors)
