"""Lists of CMake: texts with `;` between the items."""

from __future__ import annotations

from collections.abc import Iterable


def items(text: str) -> list[str]:
    """Return all items of a list, empty ones too (CMP0007); an empty text has none."""
    if not text:
        return []
    if "\\;" not in text and "[" not in text:
        return text.split(";")
    return list(_split(text))


def arguments(text: str) -> list[str]:
    """Return what an unquoted argument stands for: items that are not empty."""
    return [item for item in items(text) if item]


def all_items(texts: Iterable[str]) -> list[str]:
    """Return what texts stand for where quotes keep no list together, as the sources of a target."""
    return [item for text in texts for item in arguments(text)]


def _split(text: str) -> list[str]:
    r"""Split at `;`, but not at `\\;` nor between brackets."""
    found, current, depth, at = [], "", 0, 0
    while at < len(text):
        char = text[at]
        if char == "\\" and text[at + 1 : at + 2] == ";":
            current, at = current + ";", at + 2
            continue
        depth += {"[": 1, "]": -1}.get(char, 0)
        if char == ";" and depth == 0:
            found.append(current)
            current = ""
        else:
            current += char
        at += 1
    return [*found, current]
