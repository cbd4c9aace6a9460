"""Include folders that nothing installs from, in packages that install the headers of others."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from posixpath import normpath

from ecm_parsers.cmake_facts import CmakeFile, Install

from ecm_extract.read.facts import PackageFacts

INCLUDE = "include"
_TOLD = "INCLUDE_DIRS"
_OF_TARGETS = frozenset({"FILE_SET", "PUBLIC_HEADER"})


def may_hold_headers(rule: Install) -> bool:
    """Whether a rule installs headers, or what only CMake knows to where they could be found."""
    if any(INCLUDE in text.lower() for text in (*rule.items, rule.destination)):
        return True
    anywhere = "$" in rule.destination or rule.destination.strip("/.") == ""
    return anywhere and any("$" in text for text in (*rule.items, rule.destination))


def passed_over(facts: PackageFacts, headers: Iterable[str]) -> frozenset[str]:
    """Return the headers of include folders that no rule names, as long as a rule names another one.

    Args:
        facts: of the package.
        headers: paths of its headers.
    """
    named = {place for path, file in facts.cmake.items() for place in _named(path, file)}
    if not named:
        return frozenset()
    roots = {path: root for path in headers if (root := _root(path)) is not None}
    known = {root for root in roots.values() if any(_is_beside(root, place) for place in named)}
    return frozenset(path for path, root in roots.items() if known and root not in known)


def _root(path: str) -> str | None:
    """The folder `include` that a header lies below."""
    parts = path.split("/")[:-1]
    return "/".join(parts[: parts.index(INCLUDE) + 1]) if INCLUDE in parts else None


def _named(path: str, file: CmakeFile) -> Iterator[str]:
    """Folders and files that rules of a build file name; its own folder for what only CMake knows."""
    folder = path.rpartition("/")[0]
    if file.unknown or file.foreign:
        yield folder
    for rule in file.installs:
        if rule.kind in {"directory", "files"} and may_hold_headers(rule):
            yield from (_place(folder, item) for item in rule.items)
        elif not _OF_TARGETS.isdisjoint(rule.words):
            yield folder
    for command in file.commands:
        if command.name == "catkin_package" and _TOLD in command.args:
            yield from (_place(folder, item) for item in command.args[command.args.index(_TOLD) + 1 :])


def _place(folder: str, item: str) -> str:
    return folder if "$" in item or item.startswith("/") else normpath(f"{folder}/{item}".lstrip("/")).strip(".")


def _is_beside(root: str, place: str) -> bool:
    """Whether one of two folders lies in the other, or both are one; nothing stands for the whole tree."""
    return not place or f"{root}/".startswith(f"{place}/") or place.startswith(f"{root}/")
