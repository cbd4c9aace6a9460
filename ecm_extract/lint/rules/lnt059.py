"""LNT059: a build file names a file or folder that is not there, or a variable that nothing sets."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.entities.install_rules import InstallRule, install_rules
from ecm_extract.lint.known import Asked, Known
from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.build_files import build_words

RULE = LintRule(
    id="LNT059",
    name="cmake_names_nothing",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="CMake stops there when the package is installed",
    resolution="correct the name",
    tier="stable",
)
_VARIABLE = re.compile(r"\$\{(\w+)\}")
_KNOWN = (
    *(
        f"{maker}_{what}_DESTINATION"
        for maker in ("CATKIN_PACKAGE", "CATKIN_GLOBAL")
        for what in ("BIN", "LIB", "LIBEXEC", "INCLUDE", "SHARE", "PYTHON", "ETC")
    ),
    *(f"catkin_{what}" for what in ("INCLUDE_DIRS", "LIBRARIES", "LIBRARY_DIRS", "EXPORTED_TARGETS", "FOUND")),
    *("PROJECT_NAME", "PROJECT_SOURCE_DIR", "PROJECT_BINARY_DIR", "CMAKE_CURRENT_SOURCE_DIR", "CMAKE_INSTALL_PREFIX"),
)
_PYTHON = (".py", ".cfg", ".toml")
"""Endings of the files that setuptools reads."""
_SLIP = 0.9
_EMPTY = "CMake puts nothing in its place and goes on"
_NO_CONFIGURE = "catkin_package refuses it, and the package is not configured"
_NO_PYTHON = "the build of the package stops there, or the program as soon as it starts"


def tell(known: Known) -> Iterator[Finding]:
    """Report files and folders that install rules and exports name, and that the package does not hold."""
    missing: dict[tuple[str, Evidence], list[Asked]] = {}
    for asked in known.asked("installs_file"):
        if asked.match.state == "dangling":
            missing.setdefault((asked.consumer.name, asked.requirement.evidence[0]), []).append(asked)
    for (package, place), group in missing.items():
        yield _absent(package, place, group, known)
    for asked in known.asked("exports_headers"):
        if asked.match.state == "dangling":
            name, package = asked.requirement.target, asked.consumer.name
            text = f"{package} exports the folder {name}, which is not there"
            yield _finding(text, name, asked.requirement.evidence[0], package, None, _NO_CONFIGURE)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report variables that nothing sets: a slip inside one build, which has no other side."""
    for package in workspace.packages:
        if not package.root.rosbuild and package.cmake:
            words = build_words(workspace.commands, package)
            if not words.is_open:
                yield from _slips(package, words.said, workspace)
                for rule in install_rules(package):
                    yield from _unset(rule, words.said, package)


def _slips(package: PackageFacts, words: frozenset[str], workspace: Workspace) -> Iterator[Finding]:
    """Variables that are nearly one of catkin or CMake, each once."""
    seen: set[str] = set()
    for path in package.cmake:
        for command in workspace.commands(path):
            for name in {name for each in command.args for name in _VARIABLE.findall(each.text)} - seen - set(_KNOWN):
                near = nearest(name, _KNOWN, _SLIP)
                if near and name not in words:
                    seen.add(name)
                    text = f"{path} uses ${{{name}}}, which nothing sets; there is ${{{near}}}"
                    yield _finding(text, name, Evidence(path, command.line), package.name, near, _EMPTY)


def _unset(rule: InstallRule, words: frozenset[str], package: PackageFacts) -> Iterator[Finding]:
    for name in sorted({name for text in (*rule.items, rule.destination) for name in _VARIABLE.findall(text)}):
        if name.islower() and "_" not in name and name not in words:
            text = f"an install rule of {package.name} uses ${{{name}}}, which nothing sets"
            yield _finding(text, name, Evidence(rule.path, rule.line), package.name, None, _EMPTY)


def _absent(package: str, place: Evidence, group: list[Asked], known: Known) -> Finding:
    """One finding for all that one rule names in vain, with a near name where it is one."""
    missing = [asked.requirement.target for asked in group]
    near = _beside(group[0].requirement.name, known.files_of(package)) if len(missing) == 1 else None
    text = f"{package} installs {', '.join(missing)}, which {'is' if len(missing) == 1 else 'are'} not there"
    stops = _NO_PYTHON if place.path.endswith(_PYTHON) else ""
    return _finding(text + (f"; there is {near}" if near else ""), " ".join(missing), place, package, near, stops)


def _beside(path: str, there: frozenset[str]) -> str | None:
    folder, _, name = path.rpartition("/")
    return nearest(name, [each.rpartition("/")[2] for each in sorted(there) if each.rpartition("/")[0] == folder])


def _finding(text: str, name: str, place: Evidence, package: str, near: str | None, consequence: str = "") -> Finding:
    entity = Entity("file", name, near or "")
    return RULE.finding(text, entity, package, [place], certainty="likely", consequence=consequence)
