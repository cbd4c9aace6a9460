"""Repositories that a workspace brings in from source: lists of wstool (`.rosinstall`) and vcstool (`.repos`)."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source_lists import parse_source_list

from ecm_extract.tree import Tree

_LISTS: Final = (".rosinstall", ".repos")


def fetched_repositories(tree: Tree) -> frozenset[str]:
    """Return the last parts of their folders and addresses, which many a package is called after."""
    lists = [entry.path for entry in tree.files() if entry.path.endswith(_LISTS)]
    found = [each for _, data in tree.read_many(lists) for each in parse_source_list(data).facts]
    names = (name for each in found for name in (each.folder, each.url.removesuffix(".git")))
    return frozenset(filter(None, (name.rstrip("/").rpartition("/")[2] for name in names)))
