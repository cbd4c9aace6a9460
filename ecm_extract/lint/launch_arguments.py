"""Which arguments a launch file declares, uses, and hands to files that it includes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

import msgspec
from ecm_parsers.launch.model import Action, Argument, Group, Include, LaunchFile, SetConfiguration, Substitution

from ecm_extract.lint.workspace import Workspace, all_actions, plain_text
from ecm_extract.system.files import TREE, Files


class Handed(msgspec.Struct, frozen=True):
    """An include: the launch file of the tree that it names, None when it is another or unknown one."""

    target: str | None
    names: tuple[str, ...]
    passes_all: bool
    line: int


class Interface(msgspec.Struct, frozen=True):
    """The arguments of one launch file.

    Attributes:
        declared: every argument or variable that the file gives a name. required: those without any value.
        used: what it reads without a default, with the first line. read: what it reads in any way.
        is_open: an action of it could not be read, or names what only the launch knows.
    """

    ros: int
    declared: frozenset[str]
    required: frozenset[str]
    used: Mapping[str, int]
    read: frozenset[str]
    includes: tuple[Handed, ...]
    is_open: bool


def interfaces(workspace: Workspace) -> dict[str, Interface]:
    """Return the arguments of every launch file of the tree."""
    return {path: _interface(path, facts, workspace) for path, facts in workspace.launches.items()}


def _interface(path: str, facts: LaunchFile, workspace: Workspace) -> Interface:
    actions = list(all_actions(facts.actions))
    arguments = [action for action in actions if isinstance(action, Argument)]
    names = [plain_text(action.name) for action in actions if isinstance(action, SetConfiguration)]
    used: dict[str, int] = {}
    read = set()
    is_open = None in names
    for line, found in _substitutions(facts.actions, 0):
        name = plain_text(found.args[0]) if found.args else None
        is_open |= found.kind in {"eval", "unknown"} or (found.kind == "arg" and name is None)
        if found.kind == "arg" and name is not None:
            read.add(name)
            if len(found.args) == 1:
                used.setdefault(name, line)
    return Interface(
        ros=facts.ros,
        declared=frozenset({*(each.name for each in arguments), *(name for name in names if name)}),
        required=frozenset(_required(facts.actions)),
        used=used,
        read=frozenset(read),
        includes=tuple(_handed(each, path, workspace) for each in actions if isinstance(each, Include)),
        is_open=is_open or any(type(action).__name__ == "Unread" for action in actions),
    )


def _required(actions: tuple[Action, ...]) -> Iterator[str]:
    """Arguments that have to be given whenever the file is used, and are not given a value later."""
    for action in actions:
        if isinstance(action, Argument) and action.condition is None:
            if action.default is None and action.value is None:
                yield action.name
        elif isinstance(action, Group) and action.condition is None and not action.scoped:
            yield from _required(action.actions)


def _handed(action: Include, path: str, workspace: Workspace) -> Handed:
    names = tuple(name for name, _ in action.arguments)
    return Handed(_target(action, path, workspace.files), names, action.pass_all, action.line)


def _target(action: Include, path: str, files: Files) -> str | None:
    """The file that an include means and no other: one that is found by its name alone may be another one."""
    text = ""
    for part in action.path:
        place: str | None = part if isinstance(part, str) else None
        if isinstance(part, Substitution) and part.kind == "find" and part.args:
            place = files.share(plain_text(part.args[0]) or "")
        elif isinstance(part, Substitution) and part.kind == "dirname":
            place = files.folder(path)
        if place is None:
            return None
        text += place
    found = files.find(text)
    return found if found is not None and text.removeprefix(TREE).replace("//", "/").lstrip("/") == found else None


def _substitutions(value: object, line: int) -> Iterator[tuple[int, Substitution]]:
    """Every substitution below a value, with the line of the action that holds it."""
    if isinstance(value, Substitution):
        yield line, value
        value = value.args
    if isinstance(value, tuple | list):
        for item in value:
            yield from _substitutions(item, line)
    elif isinstance(value, msgspec.Struct):
        line = getattr(value, "line", line)
        for name in value.__struct_fields__:
            yield from _substitutions(getattr(value, name), line)


class Reach:
    """What launch configurations of ROS 2 a file can see, and which of those that it is given are read at all.

    A configuration is visible in every file that is included later, and what an included file sets is visible after it.
    """

    def __init__(self, files: Mapping[str, Interface]) -> None:
        self._files = files
        self._callers: dict[str, set[str]] = {}
        for path, entry in files.items():
            for call in entry.includes:
                self._callers.setdefault(call.target or "", set()).add(path)

    def read(self, path: str) -> frozenset[str] | None:
        """Return every name that a file, or one below it, declares or reads; None where that is not known."""
        entries = self._below(path)
        return None if entries is None else frozenset(name for entry in entries for name in entry.declared | entry.read)

    def visible(self, path: str) -> frozenset[str] | None:
        """Return every name that may be set where a file includes others; None where that is not known."""
        found: set[str] = set()
        for name in self._around({path}, lambda name: set(self._callers.get(name, ()))):
            entry = self._files[name or ""]
            if entry.is_open:
                return None
            found |= entry.declared
            for call in entry.includes:
                below = self._below(call.target or "")
                found |= {name for each in below or () for name in each.declared - each.required}.union(call.names)
        return frozenset(found)

    def _below(self, path: str) -> list[Interface] | None:
        """A file and all that it includes; None when one of them is outside of the tree or not read."""
        if path not in self._files:
            return None
        names = self._around({path}, lambda name: {call.target for call in self._files[name].includes})
        entries = [self._files[name] for name in names if name is not None]
        return None if None in names or any(entry.is_open for entry in entries) else entries

    def _around(self, start: set[str | None], step: Callable[[str], set[str | None]]) -> set[str | None]:
        found, pending = set(start), [name for name in start if name is not None]
        while pending:
            name = pending.pop()
            new = (step(name) if name in self._files else {None}) - found
            found |= new
            pending += [each for each in new if each is not None]
        return found
