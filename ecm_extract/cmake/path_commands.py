"""`cmake_path(...)` (cmake-path(7)); forms that are not here make their variables unknown."""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Sequence
from typing import Final

from ecm_extract.cmake.change import Change, not_known
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.values import SOURCE, is_known


def run_path(args: list[str], look: Look) -> Sequence[Change]:
    """Run one `cmake_path(ACTION NAME ...)`."""
    if len(args) < 2:
        return []
    form = _FORMS.get(args[0])
    found = form(args[1:], look) if form is not None else None
    return _not_modelled(args[1:]) if found is None else found


def _not_modelled(words: list[str]) -> Sequence[Change]:
    """Any of the words may be a variable that is set."""
    return [change for word in words if word.isidentifier() for change in not_known(word)]


def _get(args: list[str], look: Look) -> Sequence[Change] | None:
    """`GET <path> <part> [LAST_ONLY] <out>`."""
    path, is_last = look.get(args[0]) or "", "LAST_ONLY" in args[2:-1]
    part = _PARTS.get("".join(args[1:2]))
    if part is None or not is_known(path) or posixpath.normpath(path) == SOURCE:
        return None
    return [Change(args[-1], part(path, is_last))]


def _stem(path: str, is_last: bool) -> str:
    return _cut(path, is_last)[0]


def _extension(path: str, is_last: bool) -> str:
    return _cut(path, is_last)[1]


def _cut(path: str, is_last: bool) -> tuple[str, str]:
    """The file name before and from its first or last dot; one at its start begins no extension."""
    name = posixpath.basename(path)
    at = name.rfind(".") if is_last else name.find(".", 1)
    return (name[:at], name[at:]) if at > 0 else (name, "")


_PARTS: Final[dict[str, Callable[[str, bool], str]]] = {
    "FILENAME": lambda path, is_last: posixpath.basename(path),
    "PARENT_PATH": lambda path, is_last: posixpath.dirname(path),
    "STEM": _stem,
    "EXTENSION": _extension,
}


def _set(args: list[str], look: Look) -> Sequence[Change] | None:
    """`SET <path> [NORMALIZE] <text>`."""
    del look
    text = args[-1]
    if len(args) == 2:
        return [Change(args[0], text)]
    return [Change(args[0], posixpath.normpath(text))] if args[1] == "NORMALIZE" and is_known(text) else None


def _append(args: list[str], look: Look) -> Sequence[Change] | None:
    """`APPEND <path> <texts>... [OUTPUT_VARIABLE <out>]`."""
    at = args.index("OUTPUT_VARIABLE") if "OUTPUT_VARIABLE" in args[:-1] else len(args)
    parts = [look.built_up(args[0]), *args[1:at]]
    if not all(is_known(part) for part in parts):
        return None
    return [Change("".join(args[at + 1 : at + 2]) or args[0], posixpath.join(*parts))]


_FORMS: Final[dict[str, Callable[[list[str], Look], Sequence[Change] | None]]] = {
    "GET": _get,
    "SET": _set,
    "APPEND": _append,
}
