"""Arguments of one CMake call split by its keywords, and paths made relative to the file's folder."""

from __future__ import annotations

import posixpath


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


def relative(path: str) -> str:
    """Return a path without `./` and inner `..`; references and generator expressions stay as they are."""
    if not path or path.startswith(("$", "/")):
        return path
    kept_slash = "/" if path.endswith("/") else ""
    return posixpath.normpath(path) + kept_slash
