"""Controllers that parameter files declare, for ros2_control and for ros_control of ROS 1.

What a controller claims is not decided here; its parameters are given as the file has them.

Source: control.ros.org "Controller Manager" (parameters), wiki.ros.org/controller_manager (ROS 1).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, Final, Literal

import msgspec

from ecm_parsers.parameter_yaml import ParameterSet, parse_parameter_yaml
from ecm_parsers.result import Diagnostic, Parsed, shortened

MAX_NAMESPACES = 12
MAX_DIAGNOSTICS = 100
_MANAGER: Final = "controller_manager"
_LOOKUP: Final = re.compile(r"[A-Za-z]\w{0,200}(?:/|::)[\w:<>, ]{1,400}")
_CONTROLLER: Final = re.compile(r"(?!\w*_msgs/).*(?:controller|broadcaster)", re.IGNORECASE)
_NO_CONTROLLER: Final = re.compile(r"\w*_msgs/|filters/|.*(?:HW|Analyzer|AnalyzerGroup)$")
# Parameters that only controllers have, for files that leave the types to the manager's file.
_TELLING: Final = re.compile(
    r"(?:command|state)_interfaces?|interface_names?|command_joints|fallback_controllers|(?:\w*_)?wheels?_names"
    r"|(?:\w*_)?(?:traction|steering|wheel_command)_joints?_names?"
)


class Declared(msgspec.Struct, frozen=True):
    """A controller as its manager knows it.

    Attributes:
        type: lookup name of its class; empty when the file sets other things for it only.
        line: 1-based, of the type or of what is set first.
        parameters: what else the manager is told about it, such as `params_file`, by its own name.
    """

    type: str
    line: int
    parameters: tuple[ParameterSet, ...] = ()


class Manager(msgspec.Struct, frozen=True):
    """A controller manager.

    Attributes:
        node: absolute name or pattern. In ROS 1 `controller_manager` in the namespace of the controllers.
        namespace: of the node, `/` at the top.
        update_rate: in Hz; None when the file leaves the default. update_rate_line: 1-based, 0 without a rate.
        controllers: by name.
    """

    node: str
    namespace: str
    update_rate: float | None
    update_rate_line: int
    controllers: dict[str, Declared]


class Controller(msgspec.Struct, frozen=True):
    """The parameters of one controller in one section; a pattern may hold for several controllers.

    Attributes:
        name: last part of the node's name, `**` or `*` for a pattern that names none.
        node: absolute name or pattern. namespace: of the node, `/` at the top.
        type: lookup name of its class, of its own or of the manager in this file; empty when none tells.
        parameters: in order of the file, named as the controller names them.
        line: 1-based, of the first parameter.
    """

    name: str
    node: str
    namespace: str
    type: str
    parameters: tuple[ParameterSet, ...]
    line: int

    def get(self, name: str) -> ParameterSet | None:
        """Return a parameter, the last one of duplicates, or None."""
        return next((entry for entry in reversed(self.parameters) if entry.name == name), None)

    def texts(self, name: str) -> tuple[str, ...]:
        """Return a parameter as list of text: one text counts as list, anything else as empty."""
        entry = self.get(name)
        value = entry.value if entry is not None else None
        items = value if isinstance(value, list) else [value]
        return tuple(item for item in items if isinstance(item, str))


class ControllerFile(msgspec.Struct, frozen=True):
    """All managers and controllers of one file; `ros` tells which layout it has."""

    ros: Literal[1, 2]
    managers: tuple[Manager, ...] = ()
    controllers: tuple[Controller, ...] = ()


def parse_controllers(data: bytes) -> Parsed[ControllerFile]:
    """Read the controllers of a parameter file; nodes that are neither manager nor controller are left out."""
    parsed = parse_parameter_yaml(data)
    problems = list(parsed.diagnostics)
    read = _ros1 if parsed.facts.ros == 1 else _ros2
    file = read(parsed.facts.sets, problems)
    return Parsed(file, shortened(problems, MAX_DIAGNOSTICS))


def _ros2(sets: Iterable[ParameterSet], problems: list[Diagnostic]) -> ControllerFile:
    sections: dict[str, list[ParameterSet]] = {}
    for entry in sets:
        sections.setdefault(entry.node or "/**", []).append(entry)
    managers = {node: _manager(node, own, problems) for node, own in sections.items() if _is_manager(node, own)}
    known = _Known(managers.values(), (own for node, own in sections.items() if node not in managers))
    controllers = (_controller(node, own, known) for node, own in sections.items() if node not in managers)
    kept = tuple(found for found in controllers if _is_controller(found, known))
    return ControllerFile(2, tuple(managers.values()), kept)


class _Known:
    """The controllers whose types a file gives: by a manager, or in a section of their own."""

    def __init__(self, managers: Iterable[Manager], sections: Iterable[Sequence[ParameterSet]]) -> None:
        self._near: dict[tuple[str, str], str] = {}
        self._any: dict[str, str] = {}
        for own in sections:
            node, kind = own[0].node or "", _own_type(own)
            if _CONTROLLER.match(kind) and "*" not in node.rpartition("/")[2]:
                self._add(_namespace(node), node.rpartition("/")[2], kind)
        for manager in managers:
            for name, declared in manager.controllers.items():
                self._add(manager.namespace, name, declared.type)

    def _add(self, namespace: str, name: str, kind: str) -> None:
        self._near[namespace, name] = kind
        self._any[name] = kind if self._any.get(name, kind) == kind else ""

    def __contains__(self, name: str) -> bool:
        return name in self._any

    def type(self, namespace: str, name: str) -> str:
        """What is said in the namespace, else what all agree on."""
        return self._near.get((namespace, name)) or self._any.get(name, "")


def _is_manager(node: str, own: Iterable[ParameterSet]) -> bool:
    """By name, or because it has a rate and types of controllers."""
    rated = any(entry.name == "update_rate" for entry in own)
    typed = any(_declares(entry) for entry in own)
    return (rated or typed) if node.endswith(_MANAGER) else (rated and typed)


def _declares(entry: ParameterSet) -> bool:
    name, _, last = entry.name.rpartition(".")
    return last == "type" and bool(name) and "." not in name and _is_lookup(entry.value)


def _manager(node: str, own: Sequence[ParameterSet], problems: list[Diagnostic]) -> Manager:
    rate = next((entry for entry in reversed(own) if entry.name == "update_rate"), None)
    types = {entry.name.removesuffix(".type"): entry for entry in own if _declares(entry)}
    others: dict[str, list[ParameterSet]] = {}
    for entry in own:
        name, _, rest = entry.name.partition(".")
        if name in types and rest and rest != "type":
            others.setdefault(name, []).append(_renamed(entry, rest))
        elif rest == "type" and name not in types:
            message = f"Type of controller `{name[:80]}` is no lookup name. Write package/Class."
            problems.append(Diagnostic("error", "controllers-bad-type", entry.line, message))
    declared = {
        name: Declared(str(entry.value), entry.line, tuple(others.get(name, ()))) for name, entry in types.items()
    }
    line = rate.line if rate is not None else 0
    return Manager(node, _namespace(node), _rate(rate, problems), line, declared)


def _rate(entry: ParameterSet | None, problems: list[Diagnostic]) -> float | None:
    """ROS 2 declares the rate as integer; another type ends the manager."""
    if entry is None or (isinstance(entry.value, str) and "$(" in entry.value):
        return None
    if type(entry.value) is int and 0 < entry.value < 1_000_000:
        return float(entry.value)
    message = "`update_rate` must be a positive integer in Hz. Correct the value."
    problems.append(Diagnostic("error", "controllers-bad-rate", entry.line, message))
    return entry.value if isinstance(entry.value, float) and 0 < entry.value < 1_000_000 else None


def _controller(node: str, own: Sequence[ParameterSet], known: _Known) -> Controller:
    name = node.rpartition("/")[2]
    namespace = _namespace(node)
    kind = _own_type(own) or known.type(namespace, name)
    return Controller(name, node, namespace, kind, tuple(own), own[0].line)


def _own_type(own: Iterable[ParameterSet]) -> str:
    return next((str(entry.value) for entry in own if entry.name == "type" and _is_lookup(entry.value)), "")


def _is_controller(found: Controller, known: _Known) -> bool:
    if found.name in known:
        return True
    if found.type:
        return _CONTROLLER.match(found.type) is not None
    return any(_TELLING.fullmatch(entry.name) for entry in found.parameters)


def _ros1(sets: Iterable[ParameterSet], problems: list[Diagnostic]) -> ControllerFile:
    sets = tuple(_renamed(entry, entry.name.strip("/")) for entry in sets)
    types = _typed(sets)
    own: dict[str, list[ParameterSet]] = {path: [] for path in types}
    for entry in sets:
        path = _within(entry.name, types)
        if path is not None:
            own[path].append(_renamed(entry, entry.name[len(path) + 1 :]))
    controllers = tuple(_controller1(path, found, str(types[path].value)) for path, found in own.items() if found)
    return ControllerFile(1, tuple(_managers(controllers, types)), controllers)


def _controller1(path: str, own: Sequence[ParameterSet], kind: str) -> Controller:
    node = f"/{path}"
    return Controller(path.rpartition("/")[2], node, _namespace(node), kind, tuple(own), own[0].line)


def _typed(sets: Iterable[ParameterSet]) -> dict[str, ParameterSet]:
    """What has a class, the outermost of nested ones, where at least one of a namespace is a controller for sure."""
    found = {
        entry.name.removesuffix("/type"): entry
        for entry in sets
        if entry.name.endswith("/type") and entry.name.count("/") <= MAX_NAMESPACES and _is_lookup(entry.value)
    }
    outer = {path: entry for path, entry in found.items() if _within(path, found) is None}
    sure = {_namespace(f"/{path}") for path, entry in outer.items() if _CONTROLLER.match(str(entry.value))}
    return {
        path: entry
        for path, entry in outer.items()
        if _namespace(f"/{path}") in sure and not _NO_CONTROLLER.match(str(entry.value))
    }


def _within(name: str, paths: Mapping[str, Any]) -> str | None:
    """Return the outermost of `paths` that `name` lies below."""
    end = name.find("/", 1)
    for _ in range(MAX_NAMESPACES):
        if end < 0:
            return None
        if name[:end] in paths:
            return name[:end]
        end = name.find("/", end + 1)
    return None


def _managers(controllers: Iterable[Controller], types: Mapping[str, ParameterSet]) -> Iterator[Manager]:
    """ROS 1 has one manager for a namespace, with no parameters of its own."""
    spaces: dict[str, dict[str, Declared]] = {}
    for found in controllers:
        line = types[found.node[1:]].line
        spaces.setdefault(found.namespace, {})[found.name] = Declared(found.type, line)
    for namespace, declared in spaces.items():
        yield Manager(f"{namespace.rstrip('/')}/{_MANAGER}", namespace, None, 0, declared)


def _renamed(entry: ParameterSet, name: str) -> ParameterSet:
    return ParameterSet(entry.node, name, entry.value, entry.type, entry.line)


def _namespace(node: str) -> str:
    return node.rpartition("/")[0] or "/"


def _is_lookup(value: Any) -> bool:
    return isinstance(value, str) and _LOOKUP.fullmatch(value.strip()) is not None
