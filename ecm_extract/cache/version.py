"""The version of what is kept: a hash of the code that made it, so that no change of the code can be forgotten.

Hashing half a thousand source files takes 9 ms, which is little beside what reading a value of another version
would cost. The libraries that the facts depend on count by name and version, as their metadata folders spell them.
"""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from typing import Final

FACTS: Final = ("ecm_parsers", "ecm_extract.read", "ecm_extract.cache")
"""Packages whose code decides what the facts of one source file are, and how they are kept."""

EXTRACTION: Final = ("ecm_parsers", "ecm_checker", "ecm_extract")
"""Packages whose code decides what the extraction of a tree is."""

_LIBRARIES: Final = ("tree_sitter", "msgspec", "lxml", "pyyaml", "rosbags", "networkx", "packaging")
_METADATA: Final = (".dist_info", ".egg_info")


def version_of(packages: Iterable[str]) -> str:
    """Hash of the code and data of packages, and of the libraries and the Python below them.

    Returns:
        40 hexadecimal digits; empty when a package is not there as files, so that nothing can be told.
    """
    digest = hashlib.sha1(f"{sys.version} {' '.join(_libraries())}".encode(), usedforsecurity=False)
    for package in packages:
        found = 0
        for folder in _folders(package):
            for name, content in _contents(folder):
                digest.update(f"{package} {name} {len(content)} ".encode("utf-8", "surrogateescape"))
                digest.update(content)
                found += 1
        if not found:
            return ""
    return digest.hexdigest()


def _folders(package: str) -> list[str]:
    spec = find_spec(package)
    return list(spec.submodule_search_locations or ()) if spec is not None else []


def _contents(folder: str) -> Iterator[tuple[str, bytes]]:
    for place, below, files in os.walk(folder):
        below[:] = sorted(name for name in below if name != "__pycache__")
        for name in sorted(files):
            path = os.path.join(place, name)  # noqa: PTH118 - half a thousand paths: text is ten times faster
            with open(path, "rb") as stream:  # noqa: PTH123 - the same
                yield path.removeprefix(folder), stream.read()


def _libraries() -> list[str]:
    """Names such as `msgspec-0.19.0.dist-info`: importlib.metadata would read 30 ms of modules to say the same."""
    folders = [entry for entry in sys.path if os.path.isdir(entry)]  # noqa: PTH112 - an entry may be no path at all
    names = {name.lower().replace("-", "_") for folder in folders for name in os.listdir(folder)}  # noqa: PTH208
    return sorted(name for name in names if name.startswith(_LIBRARIES) and name.endswith(_METADATA))
