"""Files of a tree as xacro names them, and the substitutions `$(word rest)` that need no expression."""

from __future__ import annotations

from typing import Any, Protocol

from ecm_extract.description.symbols import Unknown
from ecm_extract.description.units import yaml_data

MARK = "tree:"
"""Prefix of a path that is in the tree."""
MAX_YAML_FILES = 200


class Files(Protocol):
    """The files of a tree, as descriptions name them."""

    def share(self, package: str) -> str | None:
        """Return the marked path of a package, None when the tree does not hold it."""

    def folder(self, path: str) -> str:
        """Return the marked path of the folder of a file."""

    def find(self, text: str) -> str | None:
        """Return the path in the tree of a marked path."""

    def candidates(self, text: str) -> list[str]:
        """Return the paths in the tree that a marked path with `{name}` parts can mean."""

    def read(self, path: str) -> bytes | None:
        """Return the bytes of a file of the tree."""

    def globbed(self, text: str) -> list[str]:
        """Return the paths in the tree that a marked path with `*`, `?` and `[...]` means, in order."""

    def ros_of(self, path: str) -> int | None:
        """Return the ROS version of the package that a file belongs to, None where that is not known."""


class XacroFiles:
    """Looks files up for one expansion; each YAML file is read once."""

    def __init__(self, files: Files) -> None:
        self._files = files
        self._yaml: dict[str, Any] = {}

    def read(self, path: str) -> bytes | None:
        """Return the bytes of a file of the tree."""
        return self._files.read(path)

    def may_be_early(self, path: str) -> bool:
        """Tell whether a file may be of the xacro that needs no prefix, which ROS 2 never had."""
        return self._files.ros_of(path) != 2

    def find(self, name: str, beside: str) -> str | None:
        """Return the path of the file that `name` means in the file `beside`, None when the tree does not hold it."""
        return self._files.find(self._marked(name, beside))

    def has_choice(self, pattern: str, beside: str) -> bool:
        """Tell whether files of the tree have a name with `{name}` parts."""
        return bool(self._files.candidates(self._marked(pattern, beside)))

    def _marked(self, name: str, beside: str) -> str:
        return name if name.startswith(MARK) else f"{self._files.folder(beside)}/{name}"

    def named(self, name: str, beside: str) -> list[str]:
        """Return the paths of the files that an include names: several for a pattern, none for what is not there."""
        found = self.find(name, beside)
        if found is not None or not is_glob(name):
            return [] if found is None else [found]
        return self._files.globbed(name if name.startswith(MARK) else f"{self._files.folder(beside)}/{name}")

    def yaml(self, name: str, beside: str) -> Any:
        """Return the data of a YAML file, an `Unknown` when the tree does not hold it."""
        path = self.find(name, beside)
        if path is not None and path not in self._yaml and len(self._yaml) < MAX_YAML_FILES:
            data = self._files.read(path)
            if data is not None:
                self._yaml[path] = yaml_data(data)
        return self._yaml.get(path or "", Unknown("{" + shown_path(name) + "}"))

    def substitute(self, word: str, rest: str, beside: str) -> str | None:
        """Return what `$(word rest)` stands for, None when only the launch knows."""
        if word == "find":
            return self._files.share(rest)
        if word == "dirname":
            return self._files.folder(beside)
        if word == "optenv" and rest:
            return rest.partition(" ")[2]
        return None


def is_glob(name: str) -> bool:
    """Tell whether a file name is a pattern, as xacro tells it."""
    return any(char in name for char in "*?[")


def shown_path(name: str) -> str:
    """Return a file name for a message."""
    return name.removeprefix(MARK).strip("{}")
