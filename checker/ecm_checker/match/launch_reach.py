"""Which values a launch file of ROS 2 reads: itself, or a file that it includes, which sees all that it is given."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Final

from ecm_checker.hub.package import Package
from ecm_checker.hub.requirement import Requirement

_FILE: Final = "launch_path"
_VALUE: Final = "launch_value"
_INCLUDES: Final = "includes_launch"
_READS: Final = "substitutes_argument"
File = tuple[str, str]
"""A package, and a path from its folder."""


class LaunchReach:
    """The launch files of some packages with what they read and include."""

    def __init__(self, packages: Iterable[Package]) -> None:
        self._open: dict[File, bool] = {}
        self._names: dict[File, set[str]] = defaultdict(set)
        self._below: dict[File, set[File | None]] = defaultdict(set)
        for package in packages:
            self._provided(package)
            self._required(package)

    def _provided(self, package: Package) -> None:
        for row in package.provides:
            if row.kind == _FILE:
                self._open[package.name, row.name] = row.open
            elif row.kind == _VALUE:
                self._names[package.name, row.owner].add(row.name)

    def _required(self, package: Package) -> None:
        for row in package.requires:
            if row.use == _READS:  # without an owner: a parameter file, which any launch file may load
                self._names[package.name, row.owner].add(row.name)
            elif row.use == _INCLUDES:
                target = (row.package, row.target) if row.package and row.certainty != "unknown" else None
                self._below[package.name, package.inside(row.evidence[0].path)].add(target)

    def may_read(self, requirement: Requirement) -> bool:
        """Tell whether a file that is handed a value, or one below it, reads it, or is not known."""
        files = list(self._reached((requirement.package or "", requirement.owner)))
        if any(file is None or self._open.get(file, True) for file in files):
            return True
        owners = (owner for file in files if file is not None for owner in (file, (file[0], "")))
        return any(requirement.name in self._names[owner] for owner in owners)

    def _reached(self, start: File) -> Iterator[File | None]:
        """A file and all that it includes; None for one that cannot be told."""
        found: set[File | None] = {start}
        pending: list[File | None] = [start]
        while pending:
            file = pending.pop()
            yield file
            new = self._below[file] - found if file is not None else set()
            found |= new
            pending += new
