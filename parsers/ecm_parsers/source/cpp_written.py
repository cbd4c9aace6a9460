"""The names and the texts of a C++ file, found as its translation finds them: what a comment holds is neither.

Facts keep what carries values; here everything counts that is written, also what no fact is made of. Texts that stand
side by side are one. Source: [lex.phases], [lex.pptoken], [lex.string] of the C++ standard.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final, NamedTuple

from ecm_parsers.source.cpp_directives import COMMENT, INCLUDING, RAW, directives
from ecm_parsers.source.written import Written

_NUMBER: Final = rb"\.?[0-9](?:[eEpP][+-]|'[A-Za-z0-9_]|[A-Za-z0-9_.])*"
_TEXT: Final = rb'(?:(?:u8|[uUL])(?="))?"(?P<text>(?:[^"\\\n]|\\\r?\n|\\.)*)"?'
_CHARACTER: Final = rb"'(?:[^'\\\n]|\\.)'"
_NAME: Final = rb"(?P<name>[A-Za-z_][A-Za-z0-9_]*)"
_KINDS: Final = (rb"(?P<comment>" + COMMENT + rb")", RAW, _TEXT, _CHARACTER, _NUMBER, _NAME)
_TOKEN: Final = re.compile(rb"|".join(_KINDS))
_ESCAPED: Final = re.compile(rb"\\(?:\r?\n|(.))", re.DOTALL)


class _Token(NamedTuple):
    """A comment, a text or a name: its kind, what it says, and where its bytes begin and end."""

    kind: str
    said: bytes
    start: int
    end: int


def names(data: bytes) -> Iterator[Written]:
    """Yield the names of a file, words of the language among them, in order."""
    lines = _Lines(data)
    for token in _tokens(data):
        if token.kind == "name":
            yield Written(token.said.decode("ascii"), lines.of(token.start))


def texts(data: bytes) -> Iterator[Written]:
    """Yield the texts of a file in order; the path of an include is none."""
    lines, paths = _Lines(data), _paths(data)
    parts: list[_Token] = []
    end = 0
    for token in _tokens(data):
        is_text = token.kind == "text" and token.start not in paths
        goes_on = not data[end : token.start].strip() and (is_text or token.kind == "comment")
        if parts and not goes_on:
            yield _joined(parts, lines)
            parts = []
        if is_text:
            parts.append(token)
        end = token.end
    if parts:
        yield _joined(parts, lines)


def _joined(parts: list[_Token], lines: _Lines) -> Written:
    said = b"".join(part.said for part in parts)
    return Written(said.decode("utf-8", "replace"), lines.of(parts[0].start))


def _tokens(data: bytes) -> Iterator[_Token]:
    """The comments, texts and names of a file; none behind a raw text that is never closed."""
    position = 0
    while position >= 0 and (found := _TOKEN.search(data, position)) is not None:
        position = found.end()
        match found.lastgroup:
            case "mark":
                closing = b")" + found["mark"] + b'"'
                end = data.find(closing, position)
                position = end if end < 0 else end + len(closing)
                if end >= 0:
                    yield _Token("text", data[found.end() : end], found.start(), position)
            case "text":
                yield _Token("text", _ESCAPED.sub(_meant, found["text"]), found.start(), position)
            case str(kind):
                yield _Token(kind, found[kind], found.start(), position)


def _meant(escape: re.Match[bytes]) -> bytes:
    """A continued line goes on; of an escape what is escaped, which is never a part of a name but `/` and quotes."""
    kept: bytes | None = escape[1]
    return kept if kept is not None and not kept.isalnum() else b" " if kept is not None else b""


def _paths(data: bytes) -> frozenset[int]:
    """Where the quoted paths of includes begin."""
    found = (each for each in directives(data) if each.word in INCLUDING)
    return frozenset(data.find(b'"', each.start, each.end) for each in found)


class _Lines:
    """Counts lines for places that are asked for one after the other."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._line, self._at = 1, 0

    def of(self, place: int) -> int:
        """Return the 1-based line of a place that is not before the last one."""
        self._line += self._data.count(b"\n", self._at, place)
        self._at = place
        return self._line
