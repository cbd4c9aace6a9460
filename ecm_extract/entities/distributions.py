"""The distributions that a repository says it is for, in its read-me, its continuous integration and its images."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from types import MappingProxyType
from typing import Final

from ecm_extract.shipped import shipped
from ecm_extract.tree import Tree

_NAMING: Final = ("readme", ".travis", ".gitlab-ci", "dockerfile", "devcontainer")
_LISTS: Final = (".rosinstall", ".repos")
_WORKFLOWS: Final = "/.github/workflows/"
_WORD: Final = re.compile(rb"[a-z]+")


@cache
def distributions() -> Mapping[str, Sequence[str]]:
    """Return `ros1` and `ros2` -> their distributions, oldest first."""
    return MappingProxyType(shipped("entities/distributions.toml"))


def named_distributions(tree: Tree) -> frozenset[str]:
    """Return the distributions that the repositories of a tree name."""
    known = {name for names in distributions().values() for name in names}
    texts = tree.read_many([entry.path for entry in tree.files() if _names_some(entry.path)])
    return frozenset(word for _, data in texts for word in _words(data) if word in known)


def is_for_older(since: str, named: frozenset[str]) -> bool:
    """Tell whether a named distribution is older than the first one that a text such as `ROS 2 Humble; ...` names."""
    for word in _words(since.encode()):
        for names in distributions().values():
            if word in names:
                return not named.isdisjoint(names[: names.index(word)])
    return False


def _names_some(path: str) -> bool:
    name = path.rpartition("/")[2].lower()
    return name.startswith(_NAMING) or name.endswith(_LISTS) or _WORKFLOWS in f"/{path}"


def _words(data: bytes) -> Iterator[str]:
    return (word.decode() for word in _WORD.findall(data.lower()))
