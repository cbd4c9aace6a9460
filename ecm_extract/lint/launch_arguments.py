"""Which arguments a launch file declares, uses, and hands to files that it includes."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import msgspec
from ecm_parsers.launch.model import Action, Argument, Include, LaunchFile, SetConfiguration, Substitution
from ecm_parsers.launch.templates import all_actions, plain_text, substitutions

from ecm_extract.lint.workspace import Workspace
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
        declared: every argument or variable that the file gives a name.
        required: arguments without any value, with the line of their declaration.
        used: what it reads without a default, with the first line. always: of these what no condition keeps from it.
        read: what it reads in any way.
        is_open: an action of it could not be read, or names what only the launch knows.
    """

    ros: int
    declared: frozenset[str]
    required: Mapping[str, int]
    used: Mapping[str, int]
    always: frozenset[str]
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
    read: set[str] = set()
    always: set[str] = set()
    is_open = None in names
    for each in substitutions(facts.actions):
        found = each.substitution
        name = plain_text(found.args[0]) if found.args else None
        is_open |= found.kind in {"eval", "unknown"} or (found.kind == "arg" and name is None)
        if found.kind == "arg" and name is not None:
            read.add(name)
            if len(found.args) == 1:
                used.setdefault(name, each.line)
                always.update({name} if each.is_sure else ())
    return Interface(
        ros=facts.ros,
        declared=frozenset({*(each.name for each in arguments), *(name for name in names if name)}),
        required=_required(facts.actions),
        used=used,
        always=frozenset(always),
        read=frozenset(read),
        includes=tuple(_handed(each, path, workspace) for each in actions if isinstance(each, Include)),
        is_open=is_open or any(type(action).__name__ == "Unread" for action in actions),
    )


def _required(actions: tuple[Action, ...]) -> dict[str, int]:
    """Arguments that the file itself declares without a value, whatever the conditions."""
    found = (action for action in actions if isinstance(action, Argument) and action.condition is None)
    return {action.name: action.line for action in found if action.default is None and action.value is None}


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


class Reach:
    """Which launch configurations of ROS 2 that a file is given are read at all: by itself or by what it includes."""

    def __init__(self, files: Mapping[str, Interface]) -> None:
        self._files = files

    def read(self, path: str) -> frozenset[str] | None:
        """Return every name that a file, or one below it, declares or reads; None where that is not known."""
        entries = self._below(path)
        return None if entries is None else frozenset(name for entry in entries for name in entry.declared | entry.read)

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
