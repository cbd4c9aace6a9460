"""Controllers of a system with the hardware interfaces that they claim.

Sources: control.ros.org "Controller Manager"; `InterfaceConfiguration` of ros2_control; wiki.ros.org/ros_control.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType
from typing import Any

from ecm_checker.hub.local_name import shown
from ecm_checker.hub.running import as_local
from ecm_parsers.parameter_yaml import parse_parameter_yaml

from ecm_extract.link.naming.filling import filled
from ecm_extract.shipped import shipped
from ecm_extract.system.files import Files
from ecm_extract.system.model import Launched, Place, Setting, join
from ecm_extract.system.modules import ModuleIndex
from ecm_extract.system.names import node_matches
from ecm_extract.system.spawners import Spawned, spawned

MAX_CLAIMS = 300
_HOLE = re.compile(r"\{([\w.|]+)\}")


@dataclass(frozen=True, slots=True)
class Controller:
    """One controller that a launch loads.

    Attributes:
        name: its own. namespace: of its manager. type: lookup name of its class, empty when nothing says it.
        active: whether it is activated at start.
        claims: command interfaces `joint/interface` in order; None when nothing shows them.
        known: False when a claim holds a part that only the launch knows.
        place: of the line that loads it. typed_at: of the line that gives its type. ros: 1 or 2.
    """

    name: str
    namespace: str
    type: str
    active: bool
    claims: tuple[str, ...] | None
    known: bool
    place: Place
    typed_at: Place | None
    conditional: str = ""
    ros: int = 2


def controllers_of(launched: Launched, files: Files, index: ModuleIndex, extra: Iterable[str] = ()) -> list[Controller]:
    """Return the controllers that a launch loads.

    Args:
        launched: what it starts.
        files: of the tree.
        index: of its modules.
        extra: parameter files that a simulator plugin names, marked paths.
    """
    settings = [*launched.globals, *(entry for instance in launched.instances for entry in instance.settings)]
    settings += [entry for path in extra for entry in _file(path, files)]
    reader = _Controllers(settings, files, index)
    found: dict[tuple[str, str], Controller] = {}
    for entry in spawned(launched.instances):
        made = reader.controller(entry)
        known = found.get((made.namespace, made.name))
        if known is None or (made.active and not known.active):
            found[made.namespace, made.name] = made
    return list(found.values())


class _Controllers:
    """Looks up types and parameters of controllers."""

    def __init__(self, settings: Sequence[Setting], files: Files, index: ModuleIndex) -> None:
        self.settings = settings
        self.files = files
        self.index = index

    def controller(self, entry: Spawned) -> Controller:
        own = [setting for path in entry.files for setting in _file(path, self.files)]
        settings = [*self.settings, *own]
        namespace = entry.namespace
        typed = self._type(entry, settings)
        kind = entry.kind or (str(typed.value) if typed is not None else "")
        parameters = self._parameters(entry.name, namespace, settings)
        claims = self._claims(kind, parameters)
        return Controller(
            name=entry.name,
            namespace=namespace,
            type=kind,
            active=entry.active,
            claims=claims,
            known=claims is not None and not any("{" in claim for claim in claims),
            place=entry.instance.place,
            typed_at=typed.place if typed is not None else None,
            conditional=entry.instance.conditional,
            ros=entry.instance.ros,
        )

    def _type(self, entry: Spawned, settings: Iterable[Setting]) -> Setting | None:
        """`<name>.type` of the manager, or `type` of the controller itself (ROS 1 and newer ROS 2)."""
        wanted = {f"{entry.name}.type"}
        absolute = {join(entry.namespace, f"{entry.name}/type"), join("/", f"{entry.name}/type")}
        for setting in settings:
            if setting.name in wanted or setting.name in absolute:
                return setting
            if setting.name == "type" and setting.node is not None and setting.node.endswith(f"/{entry.name}"):
                return setting
        return None

    def _parameters(self, name: str, namespace: str, settings: Iterable[Setting]) -> dict[str, Any]:
        full = join(namespace, name)
        found: dict[str, Any] = {}
        prefixes = (f"{full}/", f"/{name}/")
        for setting in settings:
            prefix = next((each for each in prefixes if setting.name.startswith(each)), None)
            if prefix is not None:
                found.update(_flat(setting.name.removeprefix(prefix).replace("/", "."), setting.value))
            elif setting.node is not None and _is_section(setting.node, name, full):
                found.update(_flat(setting.name, setting.value))
        return found

    def _claims(self, kind: str, parameters: Mapping[str, Any]) -> tuple[str, ...] | None:
        module = self.index.plugin(kind) if kind else None
        if module is not None and module.claims is not None:
            claims = [as_local(claim).parts for claim in module.claims]
            return _settled(shown(name) for claim in claims for name in filled(claim, parameters.get))
        rows = public_claims().get(kind)
        if rows is None:
            return None
        return _settled(name for row in rows for name in _expanded(row, parameters))


def _flat(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """ROS 2 reads a list of maps as if the maps stood without the list."""
    if not isinstance(value, list) or not value or not all(isinstance(item, dict) for item in value):
        yield name, value
        return
    for item in value:
        for key, inner in item.items():
            yield from _flat(f"{name}.{key}", inner)


def _is_section(pattern: str, name: str, full: str) -> bool:
    """Sections of parameter files often leave out the namespace of the manager."""
    if pattern in {"/**", "/*"}:
        return False
    return node_matches(pattern, full) or pattern == f"/{name}"


def _settled(names: Iterable[str]) -> tuple[str, ...]:
    """Drop what stays open where something else is known."""
    found = list(dict.fromkeys(names))[:MAX_CLAIMS]
    known = [name for name in found if "{" not in name]
    return tuple(known or found)


def _expanded(row: str, parameters: Mapping[str, Any]) -> Iterator[str]:
    """Yield a row of the table for every item of the parameters in it."""
    match = _HOLE.search(row)
    if match is None:
        yield row
        return
    value = next((parameters[name] for name in match[1].split("|") if parameters.get(name)), None)
    if value is None:
        yield row.replace(match[0], "{" + match[1].rpartition("|")[2] + "}") if "|" in match[1] else row
        return
    for item in value if isinstance(value, list) else [value]:
        yield from _expanded(row.replace(match[0], str(item)), parameters)


def _file(path: str, files: Files) -> list[Setting]:
    found = files.find(path)
    data = files.read(found) if found is not None else None
    if found is None or data is None:
        return []
    parsed = parse_parameter_yaml(data).facts
    return [Setting(entry.name, entry.value, Place(found, entry.line), entry.node) for entry in parsed.sets]


@cache
def public_claims() -> Mapping[str, Sequence[str]]:
    """Return the claims of controllers of public packages by type."""
    return MappingProxyType(shipped("system/controllers.toml")["claims"])
