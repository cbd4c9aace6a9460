"""What the tools that know a package's targets look for and install by themselves: ament_cmake_auto, catkin_simple."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final

from ecm_parsers.cmake_facts import Install, InstallKind

from ecm_extract.cmake import globs
from ecm_extract.cmake.calls import Call
from ecm_extract.cmake.files import BuildFiles
from ecm_extract.cmake.keywords import split
from ecm_extract.cmake.state import both

_SUFFIXES: Final = (".c", ".cc", ".cpp", ".cxx")
_SHARED: Final = ("launch", "rviz", "urdf", "meshes", "maps", "worlds", "Media", "param")
"""Folders that `cs_install` shares (catkin_simple-extras.cmake)."""
_LIBRARY: Final = "ament_auto_add_library"
_EXECUTABLE: Final = "ament_auto_add_executable"


def auto_sources(args: Sequence[str], call: Call, files: BuildFiles) -> list[str]:
    """Return the sources that are named, and all that lie below the folder after DIRECTORY."""
    groups = split(tuple(args), frozenset({"DIRECTORY"}))
    (folder, *rest) = groups.get("DIRECTORY") or [""]
    patterns = [f"{folder}/*{suffix}" for suffix in _SUFFIXES] if folder else []
    found = [globs.found(files, pattern, call.folder, recursive=True) for pattern in patterns]
    unread = [folder] if any(each is None for each in found) else []
    return [*groups[""], *rest, *unread, *(path for each in found for path in sorted(each or ()))]


def installed_by_auto(
    call: Call, calls: Sequence[Call], projects: Mapping[str, str], files: BuildFiles
) -> Iterator[Install]:
    """Yield the rules of `ament_auto_package([INSTALL_TO_PATH] [INSTALL_TO_SHARE folders...])`.

    Args:
        call: of `ament_auto_package`.
        calls: of its file.
        projects: of the build, by folder.
        files: of the tree.
    """
    groups = split(call.texts, frozenset({"INSTALL_TO_PATH", "INSTALL_TO_SHARE"}))
    project = _project(call, projects)
    if files.is_folder(posixpath.join(call.folder, "include")):
        yield _rule("directory", [call.file("include/")], "include", call)
    yield from _of_targets(_made(_LIBRARY, calls), "lib", call)
    programs = "bin" if "INSTALL_TO_PATH" in groups else f"lib/{project}"
    yield from _of_targets(_made(_EXECUTABLE, calls), programs, call)
    for folder in groups.get("INSTALL_TO_SHARE", []):
        yield _rule("directory", [call.file(folder)], f"share/{project}", call)


def installed_by_simple(
    call: Call, calls: Sequence[Call], projects: Mapping[str, str], files: BuildFiles
) -> Iterator[Install]:
    """Yield the rules of `cs_install()` (catkin_simple): all targets of `cs_add_*`, and folders that are there."""
    project = _project(call, projects)
    yield from _of_targets(_made("cs_add_library", calls), "lib", call)
    yield from _of_targets(_made("cs_add_executable", calls), f"lib/{project}", call)
    if files.is_folder(posixpath.join(call.folder, "include")):
        yield _rule("directory", [call.file("include/")], "include", call)
    for folder in _SHARED:
        if files.is_folder(posixpath.join(call.folder, folder)):
            yield _rule("directory", [call.file(f"{folder}/")], f"share/{project}/{folder}", call)


def projects_of(calls: Iterable[Call]) -> Mapping[str, str]:
    """Return the names of projects by the folders that begin them."""
    return {call.folder: call.args[0] for call in calls if call.name == "project" and call.args}


def _project(call: Call, projects: Mapping[str, str]) -> str:
    """The project that a folder belongs to: its own, or the one of the nearest folder around it."""
    folder = call.folder
    while folder not in projects and folder not in {"", "."}:
        folder = posixpath.dirname(folder)
    return projects.get(folder, "${PROJECT_NAME}")


def _made(command: str, calls: Sequence[Call]) -> list[Call]:
    return [each for each in calls if each.name == command and each.args and "INTERFACE" not in each.args[1:2]]


def _of_targets(made: list[Call], place: str, call: Call) -> Iterator[Install]:
    """A rule for each target: builds have it where they have the target."""
    for each in made:
        by_default = both(each.by_default, call.by_default)
        yield Install("targets", (each.args[0],), place, call.line, conditions=each.conditions, by_default=by_default)


def _rule(kind: InstallKind, items: list[str], place: str, call: Call) -> Install:
    return Install(kind, tuple(items), place, call.line, conditions=call.conditions, by_default=call.by_default)
