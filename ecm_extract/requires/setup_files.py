"""What setup.py names of its own package: files to copy, packages to install, and modules that programs start in."""

from __future__ import annotations

import re
from collections.abc import Iterator
from posixpath import dirname
from typing import Final

import msgspec
from ecm_checker.hub.requirement import Requirement
from ecm_parsers.python_setup_facts import PythonSetup

from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.place import Place, required
from ecm_extract.resolve.installed_python import installed_modules
from ecm_extract.resolve.paths import tree_path

_BUILD: Final = "ament_python"
"""The build type whose packages setuptools installs; others call setup.py for a part of it, or never."""
_PROGRAMS: Final = "console_scripts"
_OPEN: Final = re.compile(r"[*?\[\]{}$]|^[/~]|(^|/)\.\.(/|$)")
"""What only a run tells, or what is not of the package."""


class _Named(msgspec.Struct, frozen=True):
    """A path of the tree, how the file says it, and its line."""

    path: str
    said: str
    line: int


def setup_file_requirements(facts: PackageFacts) -> Iterator[Requirement]:
    """Yield what the setup.py of a package that setuptools installs needs of the package."""
    manifest = facts.manifest
    if manifest is None or _BUILD not in {each.name for each in manifest.build_types}:
        return
    root = f"{facts.root.path}/" if facts.root.path else ""
    for path, setup in facts.setups.items():
        for named in (*_copied(path, setup), *_packages(setup, facts), *_started(setup, facts)):
            if named.path.startswith(root):
                name, place = named.path.removeprefix(root), Place(path, named.line, f"file {path}")
                yield required("installs_file", name, place, "likely", package=facts.name, target=named.said)


def _copied(path: str, setup: PythonSetup) -> Iterator[_Named]:
    for rule in setup.data_files:
        for file in rule.files:
            if not _OPEN.search(file):
                yield _Named(tree_path(dirname(path), file), file, rule.line)


def _packages(setup: PythonSetup, facts: PackageFacts) -> Iterator[_Named]:
    """Packages and modules that are written out."""
    for name in setup.packages:
        if not _OPEN.search(name):
            path = _place(name, facts)
            if path is not None:
                yield _Named(path, f"the package {name}", setup.package_lines.get(name) or 1)


def _started(setup: PythonSetup, facts: PackageFacts) -> Iterator[_Named]:
    """Modules of programs, of packages that the file installs; one that it makes lies in no folder."""
    for entry in setup.entry_points if not setup.makes_modules else ():
        path = _place(entry.module, facts)
        if entry.group == _PROGRAMS and path is not None and not _OPEN.search(entry.module):
            yield _Named(path, f"the program {entry.name} of the module {entry.module}", entry.line)


def _place(name: str, facts: PackageFacts) -> str | None:
    """Where a module lies by what the package installs: a folder, or else a file; None where that does not tell."""
    installed = installed_modules(facts)
    known = name if name in installed else name.partition(".")[0]
    if known not in installed:
        return None
    path = tree_path(installed[known], name.removeprefix(known).lstrip(".").replace(".", "/"))
    return path if any(entry.path.startswith(f"{path}/") for entry in facts.root.files) else f"{path}.py"
