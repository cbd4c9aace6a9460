"""`file(GLOB ...)` and `file(GLOB_RECURSE ...)`: which files and folders of the tree a pattern finds."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from ecm_checker.gaps import with_gaps

from ecm_extract.cmake.files import MAX_FOUND, BuildFiles, absolute, placed, tree_path

_WILD: Final = frozenset("*?[")


def found(files: BuildFiles, expression: str, folder: str, recursive: bool) -> list[str] | None:
    """Return absolute paths that an expression finds, or None for what lies outside of the tree.

    Args:
        files: of the tree.
        expression: as evaluated, relative to `folder`.
        folder: CMAKE_CURRENT_SOURCE_DIR as a path of the tree.
        recursive: whether the last part is looked for in all folders below.
    """
    path = tree_path(absolute(expression, folder))
    if path is None or "\x01" in path:
        return None
    parts = path.split("/")
    folders = [""]
    for part in parts[:-1]:
        folders = [each for outer in folders for each in _folders(files, outer, part)]
    if recursive:
        folders = [each for outer in folders for each in _below(files, outer)]
    return [placed(each) for outer in folders[:MAX_FOUND] for each in _matching(files, outer, parts[-1])]


def _folders(files: BuildFiles, outer: str, part: str) -> list[str]:
    return [each for each in _matching(files, outer, part) if files.is_folder(each)]


def _matching(files: BuildFiles, outer: str, part: str) -> list[str]:
    prefix = f"{outer}/" if outer else ""
    if _WILD.isdisjoint(part):
        return [prefix + part] if files.has(prefix + part) or files.is_folder(prefix + part) else []
    compiled = re.compile(_translated(part))
    return [prefix + name for name in files.inside(outer) if compiled.fullmatch(name)]


def _below(files: BuildFiles, outer: str) -> Iterator[str]:
    yield outer
    prefix = f"{outer}/" if outer else ""
    for name in files.inside(outer):
        if files.is_folder(prefix + name):
            yield from _below(files, prefix + name)


def _translated(part: str) -> str:
    """A pattern of file names: `*`, `?` and sets of characters."""
    texts, at = [""], 0
    while at < len(part):
        char = part[at]
        end = part.find("]", at + 2) if char == "[" else -1
        if end > 0:
            inside = part[at + 1 : end].replace("\\", r"\\").replace("[", r"\[")
            texts[-1] += f"[{'^' + inside[1:] if inside[0] in '!^' else inside}]"
            at = end
        elif char == "*":
            texts.append("")
        else:
            texts[-1] += "." if char == "?" else re.escape(char)
        at += 1
    return with_gaps(texts, ".*")
