"""Nodes that a launch file named and started, and neither it nor what it includes starts any more."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

import msgspec
from ecm_checker.hub.provision import HOLE, LAUNCHED, Provision

File = tuple[str, str]
"""The package of a launch file and its name."""


class Launches:
    """What the launch files of one side start, with all that they include."""

    def __init__(self, entities: Iterable[Provision]) -> None:
        self._runs: dict[File, tuple[str, ...]] = {}
        self.files: list[Provision] = []
        self.named_runs: set[tuple[File, str]] = set()
        self._named: dict[File, set[str]] = defaultdict(set)
        self._programs: set[str] = set()
        for each in entities:
            if each.row.is_placed:
                self._runs[each.package, each.name] = each.bases
                self.files.append(each)
            elif each.row.runs and each.facet == LAUNCHED:
                self._named[each.package, each.owner].add(each.name)
                self.named_runs.add(((each.package, each.owner), _run_of(each)))
            elif each.row.started:
                self._programs.add(f"{each.package}/{each.name}")

    def has(self, file: File) -> bool:
        """Whether a launch file is there."""
        return file in self._runs

    def runs(self, file: File) -> set[str]:
        """Return what a file and those that it includes run, and the files that they include of other trees."""
        return {run for each in self._reached(file) for run in self._runs[each] if self._file(run) is None}

    def names(self, file: File) -> set[str]:
        """Return the names that a file and those that it includes give to nodes."""
        return {name for each in self._reached(file) for name in self._named.get(each, ())}

    def is_file(self, run: str) -> bool:
        """Whether what runs is another launch file of the tree."""
        return self._file(run) is not None

    def has_program(self, run: str) -> bool:
        """Whether a program is one of the packages of the tree, as far as these are known."""
        return run in self._programs

    def _reached(self, start: File) -> Iterator[File]:
        pending, seen = [start], {start}
        while pending:
            file = pending.pop()
            yield file
            included = {found for run in self._runs[file] if (found := self._file(run)) is not None} - seen
            seen |= included
            pending += included

    def _file(self, run: str) -> File | None:
        package, name = run.partition("/")[0], run.rpartition("/")[2]
        return (package, name) if (package, name) in self._runs else None


class NoLongerStarted:
    """Asks whether a node that a launch file of the old side started is lost to who runs that file."""

    def __init__(self, old: Iterable[Provision], new: Iterable[Provision]) -> None:
        self._old, self._new = Launches(old), Launches(new)

    def is_lost(self, node: Provision, package: str) -> bool:
        """Whether neither its name nor its program is started now, and all is known that is.

        Of a launch file that is gone, or has another name, that is what is told.

        Args:
            node: with a name that a launch file of the old side gave it.
            package: the one that it is in now.
        """
        now = package, node.owner
        run = _run_of(node)
        return self._is_lost(run, (node.package, node.owner), now) and node.name not in self._new.names(now)

    def unnamed(self, packages: Mapping[str, str]) -> Iterator[Provision]:
        """Yield what launch files of the old side ran without a name, as a node that is called as what it runs.

        One that is new of its package may have come in its place. `packages` are new names of packages.
        """
        for each in self._old.files:
            file, now = (each.package, each.name), (packages.get(each.package, each.package), each.name)
            for run in each.bases:
                is_named = (file, run) in self._old.named_runs or self._old.is_file(run) or _is_launch(run)
                if not is_named and self._is_lost(run, file, now) and not self._is_replaced(run, file, now):
                    yield msgspec.structs.replace(
                        each, kind="node", facet=LAUNCHED, owner=each.name, name=run, bases=(run,), open=False
                    )

    def _is_lost(self, run: str, file: File, now: File) -> bool:
        if HOLE in run or not self._old.has(file) or not self._new.has(now) or self._is_gone(run):
            return False
        before, after = self._old.runs(file), self._new.runs(now)
        unknown = HOLE in after or any(_is_launch(each) for each in after - before)
        return not unknown and run not in after

    def _is_replaced(self, run: str, file: File, now: File) -> bool:
        came = self._new.runs(now) - self._old.runs(file)
        return any(each.partition("/")[0] == run.partition("/")[0] for each in came)

    def _is_gone(self, run: str) -> bool:
        """Whether its program is gone or has another name, which is told of the program."""
        return self._old.has_program(run) and not self._new.has_program(run)


def _run_of(node: Provision) -> str:
    """What it runs, as `run_by` writes it; its package stands before a component that needs none."""
    if len(node.bases) == 2 and "::" not in node.bases[1]:
        return "/".join(node.bases)
    return (node.bases[-1] if node.bases else HOLE).replace("::", "/")


def _is_launch(run: str) -> bool:
    """Whether something that runs is a file that another package has."""
    return run.endswith((".py", ".xml", ".launch", ".yaml", ".yml"))
