"""Arguments that a launch file reads and that nothing gives a value."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import Final

import msgspec
from ecm_parsers.launch.model import Action, Argument, Group, Include, LaunchFile, SetConfiguration
from ecm_parsers.launch.templates import all_actions, plain_text, substitutions
from ecm_parsers.template import Template

from ecm_extract.entities.launch_reads import is_partly_read
from ecm_extract.lint.near import nearest

_ROS_2: Final = 2
_PYTHON: Final = ".py"


class Unset(msgspec.Struct, frozen=True):
    """What is wrong with an argument at a line; `is_sure` tells that no launch of the tree gives it."""

    line: int
    wrong: str
    is_sure: bool = True


class Unsettled:
    """The launch files of a tree, each with who includes it by the name of the file."""

    def __init__(self, launches: Mapping[str, LaunchFile]) -> None:
        self._launches = launches
        self._by_name: dict[str, list[str]] = defaultdict(list)
        for path in launches:
            self._by_name[_last(path)].append(path)
        self._includes = {path: list(_includes(file)) for path, file in launches.items()}
        self._includers: dict[str, set[str]] = defaultdict(set)
        for path, found in self._includes.items():
            for include in found:
                self._includers[_target(include)].add(path)

    def of(self, path: str) -> Iterator[Unset]:
        """Yield what a file reads without a value."""
        yield from self._own_defaults(path)
        file = self._launches[path]
        if file.ros == _ROS_2 and not path.endswith(_PYTHON):
            yield from self._undeclared(path, file)

    def _own_defaults(self, path: str) -> Iterator[Unset]:
        given = {name for each in self._into(path) for name, _ in each.arguments}
        for action in all_actions(self._launches[path].actions):
            if isinstance(action, Argument) and _reads(action.default or action.value or (), action.name):
                wrong = f"the default of {action.name} is {action.name} itself"
                yield Unset(action.line, wrong, action.condition is None and action.name not in given)

    def _into(self, path: str) -> Iterator[Include]:
        for includer in self._includers[_last(path)]:
            yield from (each for each in self._includes[includer] if _target(each) == _last(path))

    def _undeclared(self, path: str, file: LaunchFile) -> Iterator[Unset]:
        """Values of ROS 2 are seen by all that is launched after them, in files that include and are included."""
        known, is_open = self._named_around(path)
        told = set()
        for each in substitutions(file.actions):
            part = each.substitution
            name = plain_text(part.args[0]) if part.kind == "arg" and len(part.args) == 1 else None
            if name is None or name in told or name in known:
                continue
            told.add(name)
            near = nearest(name, known)
            hint = f"; {near} is declared" if near else ""
            is_sure = each.is_sure and not is_open and not self._is_open(path, each.line)
            yield Unset(each.line, f"$(var {name}) is read and nothing of the tree declares {name}{hint}", is_sure)

    def _named_around(self, path: str) -> tuple[set[str], bool]:
        """What the files of all launches that hold this one name, and whether one of these may name more."""
        pending, seen, is_open = [path], {path}, False
        while pending:
            current = pending.pop()
            above = self._includers[_last(current)] - seen
            below = {other for each in self._includes[current] for other in self._by_name[_target(each)]} - seen
            is_open |= current != path and is_partly_read(self._launches[current])
            is_open |= any(self._is_open(each, line) for each in above for line in self._lines(each, current))
            is_open |= any(self._is_open(each, None) for each in below - above)
            seen |= above | below
            pending += [*above, *below]
        return {name for each in seen for name in _named(self._launches[each])}, is_open

    def _lines(self, includer: str, path: str) -> list[int]:
        return [each.line for each in self._includes[includer] if _target(each) == _last(path)]

    def _is_open(self, path: str, before: int | None) -> bool:
        """Whether a file that is not of the tree is included in the same scope, before a line."""
        found = _visible(self._launches[path].actions, before)
        return any(not self._by_name[_target(each)] for each in found)


def _visible(actions: tuple[Action, ...], before: int | None) -> Iterator[Include]:
    """Includes whose values are seen at a line, or at the end: what a group sets ends with it."""
    for action in actions:
        if isinstance(action, Include) and (before is None or action.line < before):
            yield action
        elif isinstance(action, Group) and (not action.scoped or (before is not None and _holds(action, before))):
            yield from _visible(action.actions, before)


def _holds(group: Group, line: int) -> bool:
    return group.line <= line <= max((each.line for each in all_actions(group.actions)), default=group.line)


def _reads(template: Template, name: str) -> bool:
    return any(
        each.substitution.kind == "arg"
        and len(each.substitution.args) == 1
        and plain_text(each.substitution.args[0]) == name
        for each in substitutions(template)
    )


def _named(file: LaunchFile) -> Iterator[str]:
    for action in all_actions(file.actions):
        if isinstance(action, Argument):
            yield action.name
        elif isinstance(action, SetConfiguration):
            yield plain_text(action.name) or ""
        elif isinstance(action, Include):
            yield from (name for name, _ in action.arguments)


def _includes(file: LaunchFile) -> Iterator[Include]:
    return (action for action in all_actions(file.actions) if isinstance(action, Include))


def _target(include: Include) -> str:
    """The name of the included file, empty where the launch decides it."""
    last = include.path[-1] if include.path else ""
    return _last(last) if isinstance(last, str) else ""


def _last(path: str) -> str:
    return path.rpartition("/")[2]
