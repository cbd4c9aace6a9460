"""Arguments of one CMake call split by its keywords."""

from __future__ import annotations


def split(args: tuple[str, ...], keywords: frozenset[str]) -> dict[str, list[str]]:
    """Return the values after each keyword; those before any keyword are under the empty one."""
    groups: dict[str, list[str]] = {"": []}
    current = ""
    for value in args:
        if value in keywords:
            current = value
            groups.setdefault(current, [])
        else:
            groups[current].append(value)
    return groups


def first(groups: dict[str, list[str]], keyword: str) -> str | None:
    """Return the first value of a keyword, or None."""
    values = groups.get(keyword)
    return values[0] if values else None
