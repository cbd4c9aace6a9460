"""Generator expressions: `$<...>` is only decided when a build is generated."""

from __future__ import annotations


def stripped(text: str) -> str:
    """Return a text without its generator expressions, nested ones included."""
    found, depth, at = [], 0, 0
    while at < len(text):
        if text.startswith("$<", at):
            depth, at = depth + 1, at + 2
        elif depth and text[at] == ">":
            depth, at = depth - 1, at + 1
        else:
            found.append("" if depth else text[at])
            at += 1
    return "".join(found)


def has_genex(text: str) -> bool:
    """Tell whether a text holds a generator expression."""
    return "$<" in text
