"""`file(...)`, `get_filename_component` and `aux_source_directory`: paths, and the files that are there."""

from __future__ import annotations

import posixpath
from collections.abc import Sequence
from typing import Final

from ecm_parsers.text import decode

from ecm_extract.cmake import globs, patterns
from ecm_extract.cmake.change import Change, Setter, not_known
from ecm_extract.cmake.files import BuildFiles, absolute, tree_path
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.values import MAX_TEXT, SOURCE, is_known

_SOURCES: Final = (".c", ".C", ".c++", ".cc", ".cpp", ".cxx", ".m", ".M", ".mm", ".mpp", ".ixx", ".cppm", ".cu")
"""Suffixes of CMAKE_C_SOURCE_FILE_EXTENSIONS and CMAKE_CXX_SOURCE_FILE_EXTENSIONS."""
_GLOBS: Final = frozenset({"GLOB", "GLOB_RECURSE"})
_NAMED_FIRST: Final = frozenset({"GLOB", "GLOB_RECURSE", "RELATIVE_PATH"})
_PATH_FORMS: Final = frozenset({"TO_CMAKE_PATH", "TO_NATIVE_PATH"})
_TRUE: Final = frozenset({"1", "ON", "YES", "TRUE", "Y"})


def folder_of(look: Look) -> str:
    """Return CMAKE_CURRENT_SOURCE_DIR as a path of the tree."""
    return tree_path(look.get("CMAKE_CURRENT_SOURCE_DIR") or SOURCE) or ""


def file_command(files: BuildFiles) -> Setter:
    """Return `file(...)` over the files of a tree."""

    def run(args: list[str], look: Look) -> Sequence[Change]:
        action = args[0] if args else ""
        if action in _GLOBS and len(args) > 1:
            return _glob(files, action == "GLOB_RECURSE", args[1], args[2:], look)
        if action in {"READ", "STRINGS"} and len(args) > 2:
            return _content(files, args, look)
        if action == "RELATIVE_PATH" and len(args) > 3:
            return _relative(args[1], args[2], args[3])
        if action in _PATH_FORMS and len(args) > 2:
            return [Change(args[2], args[1])]
        outputs = args[1:2] if action in _NAMED_FIRST else [word for word in args[2:] if word.isidentifier()]
        return [change for word in outputs for change in not_known(word)]

    return run


def _glob(files: BuildFiles, recursive: bool, name: str, args: list[str], look: Look) -> Sequence[Change]:
    words = [word for word in args if word not in {"CONFIGURE_DEPENDS", "FOLLOW_SYMLINKS"}]
    relative, with_folders = None, not recursive
    if "RELATIVE" in words:
        at = words.index("RELATIVE")
        relative, words = "".join(words[at + 1 : at + 2]), words[:at] + words[at + 2 :]
    if "LIST_DIRECTORIES" in words:
        at = words.index("LIST_DIRECTORIES")
        with_folders, words = "".join(words[at + 1 : at + 2]).upper() in _TRUE, words[:at] + words[at + 2 :]
    found = [globs.found(files, word, folder_of(look), recursive) for word in words]
    if any(each is None for each in found):
        return not_known(name)
    paths = sorted({path for each in found for path in each or () if with_folders or _is_file(files, path)})
    shown = paths if relative is None else [posixpath.relpath(path, relative) for path in paths]
    return [Change(name, ";".join(shown))]


def _is_file(files: BuildFiles, path: str) -> bool:
    return files.has(tree_path(path) or "")


def _content(files: BuildFiles, args: list[str], look: Look) -> Sequence[Change]:
    """`file(READ path NAME)` and `file(STRINGS path NAME [REGEX ...])` of a file of the tree."""
    path, name, words = tree_path(absolute(args[1], folder_of(look))), args[2], args[3:]
    data = files.read(path) if path is not None and files.has(path) else None
    compiled = (
        patterns.pattern(words[1]) if args[0] == "STRINGS" and words[:1] == ["REGEX"] and len(words) == 2 else None
    )
    if data is None or len(data) > MAX_TEXT or (words and compiled is None):
        return not_known(name)
    text, _ = decode(data)
    if args[0] == "READ":
        return [Change(name, text)]
    lines = [line for line in text.split("\n") if line]
    if compiled is not None:
        if not all(patterns.is_cheap(compiled, line) for line in lines):
            return not_known(name)
        lines = [line for line in lines if compiled.search(line)]
    return [Change(name, ";".join(line.replace(";", "\\;") for line in lines))]


def _relative(name: str, start: str, path: str) -> Sequence[Change]:
    known = start.startswith(SOURCE) and path.startswith(SOURCE) and is_known(start + path)
    return [Change(name, posixpath.relpath(path, start))] if known else not_known(name)


def get_filename_component(args: list[str], look: Look) -> Sequence[Change]:
    """`get_filename_component(NAME path PART [BASE_DIR dir] [CACHE])`."""
    if len(args) < 3:
        return []
    name, path, part = args[:3]
    if not is_known(path):
        return not_known(name)
    if part in {"ABSOLUTE", "REALPATH"}:
        base = tree_path(args[args.index("BASE_DIR") + 1]) if "BASE_DIR" in args[3:-1] else folder_of(look)
        return not_known(name) if base is None else [Change(name, absolute(path, base))]
    base_name = posixpath.basename(path)
    if base_name == "\x03" or (part in {"DIRECTORY", "PATH"} and path == SOURCE):
        return not_known(name)
    parts = {
        "DIRECTORY": posixpath.dirname(path),
        "PATH": posixpath.dirname(path),
        "NAME": base_name,
        "EXT": base_name[base_name.find(".") :] if "." in base_name else "",
        "LAST_EXT": posixpath.splitext(base_name)[1],
        "NAME_WE": base_name.split(".")[0],
        "NAME_WLE": posixpath.splitext(base_name)[0],
    }
    return [Change(name, parts[part])] if part in parts else not_known(name)


def aux_source_directory(files: BuildFiles) -> Setter:
    """Return `aux_source_directory(dir NAME)` over the files of a tree: its sources, added to the list."""

    def run(args: list[str], look: Look) -> Sequence[Change]:
        if len(args) != 2:
            return []
        folder = tree_path(absolute(args[0], folder_of(look)))
        if folder is None or not is_known(folder):
            return not_known(args[1])
        names = [name for name in files.inside(folder) if name.endswith(_SOURCES)]
        found = [f"{args[0].rstrip('/')}/{name}" for name in names if not files.is_folder(f"{folder}/{name}")]
        held = look.built_up(args[1])
        return [Change(args[1], ";".join([held, *found] if held else found))]

    return run


def exists(files: BuildFiles, path: str, folder: str) -> bool | None:
    """Tell whether a path is there; None of one outside of the tree, hidden in it, or in what this copy lacks."""
    place = tree_path(absolute(path, folder))
    if place is None or not is_known(place) or any(part.startswith(".") for part in place.split("/")):
        return None
    if files.has(place) or files.is_folder(place):
        return True
    return None if files.is_absent(place) else False


def is_directory(files: BuildFiles, path: str) -> bool | None:
    """Tell whether an absolute path is a folder; None of one outside of the tree, or in what this copy lacks."""
    place = tree_path(path)
    if place is None or not is_known(place):
        return None
    if files.is_folder(place):
        return True
    return None if files.is_absent(place) else False
