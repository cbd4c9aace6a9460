"""Operators that are words in the conditions of directives: `#if A and not B`. Source: [lex.digraph]."""

import re
from typing import Final

from ecm_parsers.source.cpp_directives import directives

_ASKING: Final = frozenset({b"if", b"elif"})
_SIGNS: Final = {b"and": b"&& ", b"or": b"||", b"not": b"!  "}
_WORD: Final = re.compile(rb"\b(?:and|or|not)\b")


def with_signs(data: bytes) -> bytes:
    """Return a text with these as signs, which the grammar knows; each byte that is left stays where it is."""
    parts, position = [], 0
    for each in directives(data):
        if each.word in _ASKING:
            condition = _WORD.sub(lambda match: _SIGNS[match[0]], data[each.start : each.end])
            parts += [data[position : each.start], condition]
            position = each.end
    return b"".join([*parts, data[position:]])
