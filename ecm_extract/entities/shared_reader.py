"""A reader that parses no blob twice within one run."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

from ecm_parsers.result import Parsed
from ecm_parsers.source.facts import SourceFile

from ecm_extract.read.facts import PackageFacts
from ecm_extract.read.parallel import Task
from ecm_extract.read.reader import Progress, Reader

_DECLARATIVE: Final = (".msg", ".srv", ".action", ".xml", ".cfg", "CMakeLists.txt", "setup.py", "setup.cfg")


class SharedReader(Reader):
    """Takes the facts of blobs that another tree of the run holds too.

    Attributes:
        parsed: facts by blob id, shared between the readers of a run.
    """

    parsed: dict[str, SourceFile]

    def read(self, jobs: int | None, progress: Progress | None = None) -> list[PackageFacts]:
        """Return the facts of every package, those of known blobs included."""
        self._known: dict[str, SourceFile] = {}
        packages = super().read(jobs, progress)
        for package in packages:
            own = {entry.path: entry.identity for entry in package.root.files}
            for path, facts in package.sources.items():
                if own[path] is not None:
                    self.parsed[own[path] or ""] = facts
            known = {path: self._known[path] for path in own if path in self._known}
            package.sources = dict(sorted({**package.sources, **known}.items()))
        return packages

    def _tasks(self, packages: list[PackageFacts]) -> list[Task]:
        self._fetch(packages)
        identity = {entry.path: entry.identity for package in packages for entry in package.root.files}
        remaining = []
        for task in super()._tasks(packages):
            facts = self.parsed.get(identity[task[0]] or "")
            if facts is None:
                remaining.append(task)
            else:
                self._known[task[0]] = facts
        return remaining

    def _fetch(self, packages: list[PackageFacts]) -> None:
        """Read the small declarative files at once: a process for each costs more than parsing it."""
        paths = [
            entry.path for package in packages for entry in package.root.files if entry.path.endswith(_DECLARATIVE)
        ]
        self._contents = dict(self.tree.read_many(paths))

    def parse(self, path: str, parser: Callable[[bytes], Parsed[Any]]) -> Any:
        """Return the facts of one file, None when it cannot be read."""
        data = self._contents.pop(path, None)
        if data is None:
            return super().parse(path, parser)
        parsed = parser(data)
        self._count(path, len(data), parsed.diagnostics)
        return parsed.facts
