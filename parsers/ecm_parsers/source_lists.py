"""Lists of repositories that a workspace brings in from source.

Source: wstool (`.rosinstall`: a list of `git: {local-name, uri}`), vcstool (`.repos`: `repositories: {folder: {url}}`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import msgspec

from ecm_parsers.result import Parsed
from ecm_parsers.yaml_tree import parse_yaml, plain


class Listed(msgspec.Struct, frozen=True):
    """A repository: the folder that it is put into and its address, each empty where it is not told."""

    folder: str
    url: str


def parse_source_list(data: bytes) -> Parsed[tuple[Listed, ...]]:
    """Read one list of either kind; what is no repository is left out."""
    tree = parse_yaml(data)
    return Parsed(tuple(each for document in tree.facts for each in _of(plain(document))), tree.diagnostics)


def _of(document: Any) -> Iterator[Listed]:
    if isinstance(document, list):
        entries = (value for each in document if isinstance(each, Mapping) for value in each.values())
        yield from (_listed(each.get("local-name"), each.get("uri")) for each in entries if isinstance(each, Mapping))
    repositories = document.get("repositories") if isinstance(document, Mapping) else None
    if isinstance(repositories, Mapping):
        for folder, entry in repositories.items():
            yield _listed(folder, entry.get("url") if isinstance(entry, Mapping) else "")


def _listed(folder: Any, url: Any) -> Listed:
    return Listed(folder if isinstance(folder, str) else "", url if isinstance(url, str) else "")
