"""The files of the new side as they stand, searched when something seems to be gone."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_extract.entities.side import Side

_READ = re.compile(
    rb"\b(?:get_parameter(?:_or)?|getParam|get_param)\s*(?:<[^<>()]{0,80}>)?\s*\(\s*[\"']([\w./~-]{1,120})[\"']"
)
_SOURCES = (".cpp", ".cc", ".cxx", ".hpp", ".h", ".hh", ".ipp", ".py")


class Texts:
    """What sources of the new side say that no declaration shows."""

    def __init__(self, new: Side) -> None:
        self._new = new
        self._parameters: dict[str, frozenset[str]] = {}
        self._files: dict[str, bytes] = {}

    def reads(self, package: str, parameter: str) -> bool:
        """Whether a package reads a parameter, which nodes that declare what they are given need not declare."""
        if package not in self._parameters:
            self._parameters[package] = frozenset(self._read(package))
        return parameter in self._parameters[package]

    def _read(self, package: str) -> Iterator[str]:
        info = self._new.packages.get(package)
        folder = f"{info.path}/" if info is not None and info.path else ""
        paths = [entry.path for entry in self._new.tree.files() if entry.path.startswith(folder)] if info else []
        for _, data in self._new.tree.read_many(path for path in paths if path.endswith(_SOURCES)):
            yield from (name.decode("latin-1") for name in _READ.findall(data))

    def quotes(self, path: str, name: str) -> bool:
        """Whether a file has a name as a text: Python sets attributes by name (`@aliases(('OLD', 'NEW'))`)."""
        if path not in self._files:
            self._files[path] = dict(self._new.tree.read_many([path])).get(path, b"")
        return re.search(rb"[\"']%s[\"']" % re.escape(name.encode()), self._files[path]) is not None
