"""LNT059: a CMake file names a file or folder that is not there, or a variable that nothing sets."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.cmake_tokens import parse_commands

from ecm_extract.lint.install_rules import InstallRule, install_rules
from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.submodules import submodules
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT059",
    name="cmake_names_nothing",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="CMake stops there when the package is installed",
    resolution="correct the name",
)
_VARIABLE = re.compile(r"\$\{(\w+)\}")
_OPEN = re.compile(r"[$*?\[\]<>@]")
_KNOWN = (
    *(
        f"{maker}_{what}_DESTINATION"
        for maker in ("CATKIN_PACKAGE", "CATKIN_GLOBAL")
        for what in ("BIN", "LIB", "LIBEXEC", "INCLUDE", "SHARE", "PYTHON", "ETC")
    ),
    *(f"catkin_{what}" for what in ("INCLUDE_DIRS", "LIBRARIES", "LIBRARY_DIRS", "EXPORTED_TARGETS", "FOUND")),
    *("PROJECT_NAME", "PROJECT_SOURCE_DIR", "PROJECT_BINARY_DIR", "CMAKE_CURRENT_SOURCE_DIR", "CMAKE_INSTALL_PREFIX"),
)
_SLIP = 0.9
_EMPTY = "CMake puts nothing in its place and goes on"
_NO_CONFIGURE = "catkin_package refuses it, and the package is not configured"
_BUILDERS = frozenset({"configure_file", "add_custom_command", "execute_process", "file", "externalproject_add"})


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report what an install rule of a CMake package names and no file, folder or command of it gives."""
    paths = frozenset(entry.path for package in workspace.packages for entry in package.root.files)
    folders = frozenset(path[:at] for path in paths for at in range(len(path)) if path[at] == "/")
    outside = submodules(workspace)
    for package in workspace.packages:
        if package.root.rosbuild or not package.cmake:
            continue
        words = _words(package, workspace)
        rules = list(install_rules(package))
        yield from _slips(package, words, workspace)
        yield from _no_headers(package, folders)
        for rule in rules:
            yield from _unset(rule, words, package)
            if rule.kind != "TARGETS" and "OPTIONAL" not in rule.words and words is not None and "EXISTS" not in words:
                yield from _absent(rule, paths | folders, words | outside, package, workspace)


def _words(package: PackageFacts, workspace: Workspace) -> frozenset[str] | None:
    """What the commands of a package say outside of install rules; None when files from elsewhere may say more."""
    if any(file.unknown for file in package.cmake.values()):
        return None
    found: set[str] = set()
    for path in package.cmake:
        for command in parse_commands(workspace.files.read(path) or b"").facts:
            words = [argument.text for argument in command.args]
            found |= set() if command.name == "install" or command.name.startswith("end") else set(words)
            if command.name in _BUILDERS:
                found |= {part for word in words for part in word.split("/")}
    return frozenset(found)


def _slips(package: PackageFacts, words: frozenset[str] | None, workspace: Workspace) -> Iterator[Finding]:
    """Variables that are nearly one of catkin or CMake, each once."""
    seen: set[str] = set()
    for path in package.cmake:
        for command in parse_commands(workspace.files.read(path) or b"").facts:
            for name in {name for each in command.args for name in _VARIABLE.findall(each.text)} - seen - set(_KNOWN):
                near = nearest(name, _KNOWN, _SLIP)
                if near and words is not None and name not in words:
                    seen.add(name)
                    text = f"{path} uses ${{{name}}}, which nothing sets; there is ${{{near}}}"
                    yield _finding(text, name, Evidence(path, command.line), package, near, _EMPTY)


def _no_headers(package: PackageFacts, folders: frozenset[str]) -> Iterator[Finding]:
    """A folder of headers that catkin_package exports, which it refuses when it is not there."""
    for path, file in package.cmake.items():
        folder = path.rpartition("/")[0]
        for call in file.commands:
            exports = call.name == "catkin_package" and call.args[:2] == ("INCLUDE_DIRS", "include")
            if exports and f"{folder}/include".lstrip("/") not in folders:
                text = f"{package.name} exports the folder include, which is not there"
                yield _finding(text, "include", Evidence(path, call.line), package, None, _NO_CONFIGURE)


def _unset(rule: InstallRule, words: frozenset[str] | None, package: PackageFacts) -> Iterator[Finding]:
    for name in sorted({name for text in (*rule.items, rule.destination) for name in _VARIABLE.findall(text)}):
        if words is not None and name.islower() and "_" not in name and name not in words:
            text = f"an install rule of {package.name} uses ${{{name}}}, which nothing sets"
            yield _finding(text, name, Evidence(rule.path, rule.line), package, None, _EMPTY)


def _absent(
    rule: InstallRule, there: frozenset[str], elsewhere: frozenset[str], package: PackageFacts, workspace: Workspace
) -> Iterator[Finding]:
    missing = [item for item in rule.items if not _is_given(item, rule, there, elsewhere)]
    missing = [item for item in missing if not workspace.files.is_left_out(f"{rule.folder}{item}".rstrip("/"))]
    if not missing:
        return
    paths = [f"{rule.folder}{item}".rstrip("/") for item in missing]
    folder, _, name = paths[0].rpartition("/")
    beside = [each.rpartition("/")[2] for each in there if each.rpartition("/")[0] == folder]
    near = nearest(name, beside) if len(missing) == 1 else None
    text = f"{package.name} installs {', '.join(missing)}, which {'is' if len(missing) == 1 else 'are'} not there"
    yield _finding(
        text + (f"; there is {near}" if near else ""), " ".join(missing), Evidence(rule.path, rule.line), package, near
    )


def _is_given(item: str, rule: InstallRule, there: frozenset[str], elsewhere: frozenset[str]) -> bool:
    """Tell whether something is there, is made by a command, or is not known."""
    path = f"{rule.folder}{item}".rstrip("/")
    if not item.rstrip("/.") or item.startswith(("/", "..")) or _OPEN.search(item) or "/../" in item:
        return True
    return path in there or bool({item, path, path.rpartition("/")[2]} & elsewhere)


def _finding(
    text: str, name: str, place: Evidence, package: PackageFacts, near: str | None, consequence: str = ""
) -> Finding:
    entity = Entity("file", name, near or "")
    return RULE.finding(text, entity, package.name, [place], certainty="likely", consequence=consequence)
