"""Which files and packages are test code, by the conventions of those who write it."""

from __future__ import annotations

from functools import cache
from pathlib import PurePosixPath

import msgspec

from ecm_extract.shipped import shipped_as
from ecm_extract.source_suffixes import CPP


class _Folders(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    names: frozenset[str]


class _Packages(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    prefixes: tuple[str, ...]
    suffixes: tuple[str, ...]


class _Files(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    names: frozenset[str]
    suffixes: tuple[str, ...]


class _Sources(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    prefixes: tuple[str, ...]
    suffixes: tuple[str, ...]


class _TestCode(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    folders: _Folders
    packages: _Packages
    files: _Files
    sources: _Sources


@cache
def _conventions() -> _TestCode:
    return shipped_as("test_code.toml", _TestCode)


def is_test_package(root: str) -> bool:
    """Whether a package below the root of a tree exists only to test others, by the name of its folder."""
    name = root.rpartition("/")[2].lower()
    known = _conventions().packages
    return name.startswith(known.prefixes) or name.endswith(known.suffixes)


def is_test_path(path: str, root: str = "") -> bool:
    """Whether a file is test code, by the path of its package `root` and its own path below it."""
    name = path.lower().rpartition("/")[2]
    known = _conventions().files
    named = name in known.names or name.endswith(known.suffixes) or _is_test_source(name)
    return named or is_in_test_folder(path, root)


def is_in_test_folder(path: str, root: str = "") -> bool:
    """Whether a file lies where tests do, whatever it is called itself."""
    inside = path.removeprefix(f"{root}/") if root else path
    folders = inside.lower().split("/")[:-1]
    return is_test_package(root) or not _conventions().folders.names.isdisjoint(folders)


def _is_test_source(name: str) -> bool:
    file = PurePosixPath(name)
    known = _conventions().sources
    named = file.stem.startswith(known.prefixes) or file.stem.endswith(known.suffixes)
    return named and (file.suffix == ".py" or file.suffix in CPP)
