"""Repositories that a workspace brings in from source: lists of wstool (`.rosinstall`) and vcstool (`.repos`)."""

from __future__ import annotations

import re
from typing import Final

from ecm_extract.tree import Tree

_LISTS: Final = (".rosinstall", ".repos")
_NAMED: Final = re.compile(rb"^\s*-?\s*local-name:\s*['\"]?([\w./-]+)|^\s+['\"]?([\w./-]+)['\"]?:\s*$", re.MULTILINE)
_URL: Final = re.compile(rb"^\s*(?:-\s*)?(?:uri|url):\s*\S*/([\w.-]+?)(?:\.git)?['\"]?\s*$", re.MULTILINE)


def fetched_repositories(tree: Tree) -> frozenset[str]:
    """Return the last parts of their folders and addresses, which many a package is called after."""
    found: set[str] = set()
    lists = [entry.path for entry in tree.files() if entry.path.endswith(_LISTS)]
    for _, data in tree.read_many(lists):
        names = [own or key for own, key in _NAMED.findall(data)] + _URL.findall(data)
        found |= {name.decode().rpartition("/")[2] for name in names}
    return frozenset(found)
