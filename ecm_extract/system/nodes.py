"""Instances joined with contracts: nodes with the endpoints that they have in the graph."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from fnmatch import fnmatchcase
from typing import Any

from ecm_checker.contract import Qos
from ecm_checker.gaps import with_gaps
from ecm_checker.hub.local_name import LocalName, shown
from ecm_checker.hub.name_notation import read_name
from ecm_checker.hub.roles import Role
from ecm_checker.hub.running import RunningEndpoint, RunningModule

from ecm_extract.description.model import Description
from ecm_extract.system.bridges import bridged
from ecm_extract.system.controllers import Controller
from ecm_extract.system.files import Files
from ecm_extract.system.hosted import Hosts
from ecm_extract.system.model import Instance, Launched, Place, Setting, join
from ecm_extract.system.modules import Loaded, ModuleIndex
from ecm_extract.system.names import Around, Resolved, node_matches, resolve
from ecm_extract.system.node_model import Endpoint, Parameter, SystemNode
from ecm_extract.system.plugged import Plugged
from ecm_extract.system.programs import programs
from ecm_extract.system.public_nodes import default_name, public_endpoints, public_table
from ecm_extract.system.settings import all_given
from ecm_extract.system.spawners import spawned

_OWN_STATE = frozenset({"node", "lifecycle_node", "component"})
"""What a manager hosts has its state changed by calls, not by services."""
_HOLE = re.compile(r"\{[^{}]*\}")


class Declared:
    """The parameters that the modules of a node read; a name may have parts that only the launch knows."""

    def __init__(self, entries: Iterable[tuple[str, Any]]) -> None:
        self.plain: dict[str, Any] = {}
        self._patterns: list[re.Pattern[str]] = []
        for name, default in entries:
            if "{" in name:
                parts = [re.escape(part) for part in _HOLE.split(name)]
                self._patterns.append(re.compile(with_gaps(parts, ".+")))
            else:
                self.plain[name] = default

    def has(self, name: str) -> bool:
        """Tell whether a parameter is read."""
        return name in self.plain or any(pattern.fullmatch(name) for pattern in self._patterns)


class NodeMaker:
    """Makes the nodes of what a launch started.

    Attributes:
        unknown: what runs beside nodes, or in them, and may have endpoints that nothing tells.
    """

    def __init__(self, index: ModuleIndex, launched: Launched, files: Files) -> None:
        self.index = index
        self.files = files
        self._set: dict[SystemNode, Sequence[Setting]] = {}
        self.launched = launched
        self.unknown: set[str] = set()

    def nodes(self) -> list[SystemNode]:
        """Return every node, in the order in which they are started."""
        return [node for instance in self.launched.instances for node in self._of(instance)]

    def hosted(self, found: Iterable[Controller], robots: Sequence[Description]) -> list[SystemNode]:
        """Return the nodes that loaded controllers and the hardware of robots make."""
        hosts = Hosts(self.launched, robots)
        nodes = []
        for controller in found:
            module = self.index.plugin(controller.type)
            if module is not None:
                nodes.append(self._node(hosts.controller(controller), Loaded(module), first=True))
            elif controller.type:
                nodes.append(self._outside(hosts.controller(controller)))
            else:
                self.unknown.add(controller.name)
        return [*nodes, *self._hardware(hosts)]

    def _hardware(self, hosts: Hosts) -> Iterator[SystemNode]:
        """Drivers of the tree that have endpoints of their own; one without makes no node that could be talked to."""
        for instance in hosts.hardware():
            module = self.index.plugin(instance.plugin)
            if module is None:
                self.unknown.add(instance.plugin)
            elif any(not entry.row.value for entry in module.endpoints):
                yield self._node(instance, Loaded(module), first=True)

    def _of(self, instance: Instance) -> Iterator[SystemNode]:
        if instance.kind == "process":
            if not any(spawned([instance])):
                self.unknown.add(" ".join(word.text for word in instance.arguments))
            return
        modules = self.index.of(instance)
        if not modules:
            yield self._outside(instance)
            return
        refused = self._refused(instance)
        for at, loaded in enumerate(modules):
            if loaded.lookup is not None and refused(loaded.lookup):
                continue
            yield self._node(instance, loaded, first=at == 0)

    def _refused(self, instance: Instance) -> Callable[[str], bool]:
        """Tell which plugins the lists of an instance keep out, less what is let in again."""
        denied = _listed(instance, frozenset().union(*(row.refused for row in programs().plugin_list)))
        allowed = _listed(instance, frozenset().union(*(row.allowed for row in programs().plugin_list)))

        def refused(name: str) -> bool:
            return any(fnmatchcase(name, entry) for entry in denied) and name not in allowed

        return refused

    def _outside(self, instance: Instance) -> SystemNode:
        name = instance.name or default_name(instance)
        node = SystemNode(join(instance.namespace, name), instance, guessed=instance.name is None)
        node.endpoints = tuple(self._public(node))
        node.parameters = tuple(self._parameters(node, []))
        return node

    def _public(self, node: SystemNode) -> Iterator[Endpoint]:
        """Endpoints that a table or the configuration of a bridge tells of a node without source."""
        instance = node.instance
        known = public_endpoints(instance, lambda name: self._given(node, name))
        rows = [(row.role, row.name, row.type, instance.place) for row in known]
        rows += [(role, topic.name, topic.type, place) for role, topic, place in bridged(instance, self.files)]
        own = node.name.rpartition("/")[2]
        around = Around(node.namespace, own, instance.remaps, lambda name: self._given(node, name))
        for role, local, kind, place in rows:
            for resolved in resolve(read_name(local), around):
                yield _endpoint(node, role, kind, resolved, place)

    def _node(self, instance: Instance, loaded: Loaded, *, first: bool) -> SystemNode:
        module = loaded.module
        own = loaded.name or module.node or module.name
        name = (instance.name or own) if first else own
        namespace = join(instance.namespace, own) if loaded.nested and not first else instance.namespace
        node = SystemNode(join(namespace, name), instance, (module,))
        plugins = {_key(entry.module): entry for entry in self._plugins(node) if _key(entry.module) != _key(module)}
        node.modules = (module, *(entry.module for entry in plugins.values()))
        node.endpoints = tuple(self._endpoints(node, [Plugged(module), *plugins.values()]))
        node.parameters = tuple(self._parameters(node, [Plugged(module), *plugins.values()]))
        return node

    def _plugins(self, node: SystemNode) -> Iterator[Plugged]:
        """Classes that the parameters of a node name; `FollowPath.plugin` calls its plugin `FollowPath`."""
        for setting in self._settings(node):
            for value in setting.value if isinstance(setting.value, list) else [setting.value]:
                if isinstance(value, str) and ("::" in value or "/" in value):
                    module = self.index.plugin(value)
                    if module is None and "::" in value:
                        self.unknown.add(value)
                    if module is not None:
                        name = setting.name.rpartition(".")[0].rpartition("/")[2]
                        yield Plugged(module, name)

    def _settings(self, node: SystemNode) -> Sequence[Setting]:
        """What the launch sets for a node, later ones win; names are the node's own."""
        known = self._set.get(node)
        if known is None:
            known = self._set[node] = self._read_settings(node)
        return known

    def _read_settings(self, node: SystemNode) -> Sequence[Setting]:
        instance = node.instance
        if instance.ros == 2:
            return [entry for entry in instance.settings if node_matches(entry.node, node.name)]
        prefix = f"{node.name}/"
        return [
            Setting(entry.name.removeprefix(prefix), entry.value, entry.place)
            for entry in (*self.launched.globals, *instance.settings)
            if entry.name.startswith(prefix)
        ]

    def _given(self, node: SystemNode, name: str) -> Any:
        """Return the value that the launch sets for a parameter; in ROS 1 also in the namespaces around the node."""
        settings = self._settings(node)
        if "*" in name:
            return list(all_given(name, settings))
        bare = name.lstrip("~/")
        found = next((entry.value for entry in reversed(settings) if entry.name in {name, bare}), None)
        if found is not None or node.instance.ros == 2:
            return found
        around = {join(node.namespace, bare), f"/{bare}"}
        return next((entry.value for entry in reversed(self.launched.globals) if entry.name in around), None)

    def _endpoints(self, node: SystemNode, plugged: Sequence[Plugged]) -> Iterator[Endpoint]:
        seen = set()
        for entry in plugged:
            for declared in entry.module.endpoints:
                if declared.row.value:
                    continue
                for endpoint in self._resolved(node, entry, declared):
                    key = (endpoint.role, endpoint.name, endpoint.type)
                    if key not in seen:
                        seen.add(key)
                        yield endpoint
        if node.instance.kind in _OWN_STATE:
            yield from _of_state(node, plugged)

    def _resolved(self, node: SystemNode, entry: Plugged, declared: RunningEndpoint) -> Iterator[Endpoint]:
        own = node.name.rpartition("/")[2]
        around = Around(node.namespace, own, node.instance.remaps, lambda name: self._given(node, name))
        place = Place(declared.path, declared.line)
        for resolved in (each for local in declared.local_names for each in resolve(entry.called(local), around)):
            yield _endpoint(node, declared.role, declared.type, resolved, place, declared.qos)

    def _parameters(self, node: SystemNode, plugged: Sequence[Plugged]) -> Iterator[Parameter]:
        declared = Declared(
            (name, each.default)
            for entry in plugged
            for each in entry.module.endpoints
            if each.row.value
            for name in _own(each, entry, node)
        )
        found = {name: Parameter(name, default, None, declared=True) for name, default in declared.plain.items()}
        for setting in self._settings(node):
            known = declared.has(setting.name) if plugged else None
            found[setting.name] = Parameter(setting.name, setting.value, setting.place, known)
        yield from (found[name] for name in sorted(found))


def _listed(instance: Instance, names: Collection[str]) -> list[str]:
    """What the launch puts into parameters of an instance that are called so."""
    lists = (entry.value for entry in instance.settings if entry.name.rpartition("/")[2] in names)
    return [str(item) for value in lists if isinstance(value, list) for item in value]


def _of_state(node: SystemNode, plugged: Sequence[Plugged]) -> Iterator[Endpoint]:
    """The endpoints by which the state of a managed node is changed, read and told."""
    own = next((entry.module for entry in plugged if not entry.name and entry.module.lifecycle), None)
    for row in public_table().managed if own is not None else ():
        name = join(node.name, row.name)
        place = Place(own.path, own.line) if own is not None else node.instance.place
        yield _endpoint(node, row.role, row.type, Resolved(name, name, None, ()), place)


def _endpoint(
    node: SystemNode, role: Role, kind: str | None, resolved: Resolved, place: Place, qos: Qos | None = None
) -> Endpoint:
    return Endpoint(
        role=role,
        name=resolved.name,
        before=resolved.before,
        type=kind,
        node=node.name,
        remap=resolved.remap,
        parameters=resolved.parameters,
        known="{" not in resolved.name,
        place=place,
        qos=qos,
    )


def _own(declared: RunningEndpoint, entry: Plugged, node: SystemNode) -> set[str]:
    """Names of a parameter without the node that ROS 1 puts before it."""
    if any(isinstance(each, LocalName) for each in declared.local):
        return {shown(entry.called(name).parts).lstrip("~/") for name in declared.local_names}
    return {declared.name if node.instance.ros == 2 else declared.raw_name.lstrip("~/")}


def _key(module: RunningModule) -> tuple[str, str, str, int]:
    """What tells modules of two packages, files or lines apart."""
    return module.package, module.name, module.path, module.line
