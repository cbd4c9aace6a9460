"""What source text says about the end of a name: texts that quote it beside the word `deprecated`.

Log calls are not among the facts of a source file, so the files that declare endpoints are searched as they stand.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

_LITERAL = rb"\"(?:[^\"\\\n]|\\.){0,400}\"|'(?:[^'\\\n]|\\.){0,400}'"
_TEXTS = re.compile(rb"(?:%s)(?:\s{1,200}(?:%s)){0,12}" % (_LITERAL, _LITERAL))
_PIECE = re.compile(_LITERAL)
_MARK = re.compile(r"deprecat", re.IGNORECASE)
_OLD = re.compile(r"(.{0,200})\bdeprecat\w*(.{0,200})", re.IGNORECASE | re.DOTALL)
_INSTEAD = re.compile(r"\b(?:use|replaced by|in favou?r of|instead)\b", re.IGNORECASE)
_QUOTED = re.compile(r"[\"'`]([\w./~:-]+)[\"'`]")
_WORD = re.compile(r"[\w./~-]+")


def deprecated_names(speaking: Mapping[str, bytes], paths: Iterable[str]) -> dict[str, str]:
    """Return the names that texts of these files call deprecated, with the text.

    Args:
        speaking: contents by path, see `SideTexts`.
        paths: of the files that are asked.
    """
    found: dict[str, str] = {}
    for data in (speaking[path] for path in sorted(set(paths)) if path in speaking):
        if b"eprecat" in data:
            for text in warnings_in(data):
                for word in old_names(text):
                    found.setdefault(word, " ".join(text.split()))
    return found


def warnings_in(data: bytes) -> Iterator[str]:
    """Yield the string literals of a source that speak of deprecation; adjacent literals are one text."""
    for match in _TEXTS.finditer(data):
        if b"eprecat" in match[0]:
            pieces = [piece[0][1:-1] for piece in _PIECE.finditer(match[0])]
            yield re.sub(r"\\(.)", r"\1", b"".join(pieces).decode("utf-8", "replace"))


def old_names(text: str) -> Iterator[str]:
    """Yield the names that a text calls deprecated: those before the word, and after it up to `use` or `instead`.

    Where names are quoted only those count, else words with an underscore or a dot inside.
    """
    match = _OLD.search(text)
    if match is None:
        return
    before, after = match.groups()
    parts = (before, _INSTEAD.split(after)[0])
    quoted = [word for part in parts for word in _QUOTED.findall(part)]
    words = [word.strip(".") for part in parts for word in _WORD.findall(part)]
    yield from quoted or [word for word in words if re.search(r"\w[._]\w", word)]
