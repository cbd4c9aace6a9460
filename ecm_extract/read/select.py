"""Which parser a file of a package goes to, decided by its name."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import Literal

from ecm_extract.discover import PackageRoot
from ecm_extract.source_suffixes import CPP
from ecm_extract.test_code import is_test_path
from ecm_extract.tree import Entry

SourceKind = Literal["cpp", "python", "script"]

_SCRIPT_FOLDERS = frozenset({"scripts", "bin", "nodes", "src", "script", "tools", "python", "node_scripts"})
INTERFACES = frozenset({".msg", ".srv", ".action"})
_SKIPPED_FOLDERS = frozenset({"doc", "docs", "launch"})


def source_kind(entry: Entry, root: str) -> SourceKind | None:
    """Return the language of a source file; `script` may be Python, which only its first line tells."""
    path = PurePosixPath(entry.path)
    suffix = path.suffix.lower()
    if suffix in CPP:
        return "cpp"
    if suffix == ".py":
        inside = entry.path.removeprefix(f"{root}/") if root else entry.path
        return None if path.name == "setup.py" or inside.split("/")[0] in _SKIPPED_FOLDERS else "python"
    if not suffix and _may_be_script(entry, path):
        return "script"
    return None


def _may_be_script(entry: Entry, path: PurePosixPath) -> bool:
    """A file without a suffix that can be run; where its mode is not known, one in a folder for programs."""
    if entry.executable is None:
        return path.parent.name in _SCRIPT_FOLDERS
    return entry.executable and not entry.path.startswith(".") and "/." not in entry.path


def sources(package: PackageRoot, include_tests: bool) -> list[tuple[str, SourceKind]]:
    """Return (path, kind) of the source files of a package."""
    found = []
    for entry in package.files:
        kind = source_kind(entry, package.path)
        if kind is not None and (include_tests or not is_test_path(entry.path, package.path)):
            found.append((entry.path, kind))
    return found


def is_python_script(data: bytes) -> bool:
    """Tell whether a file without a suffix is Python, by its first line."""
    first = data[:200].split(b"\n", 1)[0]
    return first.startswith(b"#!") and b"python" in first
