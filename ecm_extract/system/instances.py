"""Node actions -> instances: names, namespaces, remaps and parameters put together."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.launch.model import Node, ParameterFile, Remap
from ecm_parsers.template import Template

from ecm_extract.system.command_line import GivenValue, ros1_given, ros2_given
from ecm_extract.system.model import Instance, Place, Remapping, Setting, Text, join
from ecm_extract.system.scope import Scope
from ecm_extract.system.settings import Settings
from ecm_extract.system.substitute import Substituter, bare, truth_of


class InstanceMaker:
    """Makes the instances of one launch file."""

    def __init__(self, path: str, ros: int, substituter: Substituter, settings: Settings) -> None:
        self.path = path
        self.ros = ros
        self.substituter = substituter
        self.settings = settings

    def make(self, node: Node, scope: Scope) -> Iterator[Instance]:
        """Yield the instance of an action, and those of the components that it loads."""
        own = self._instance(node, scope, None)
        if node.kind == "component":
            own.container = self._name(node.target)
        yield own
        for component in node.components:
            if self.substituter.truth(component.condition) is not False:
                yield self._instance(component, scope, own.name)

    def _instance(self, node: Node, scope: Scope, container: str | None) -> Instance:
        text = self.substituter.text
        namespace = self._namespace(node, scope)
        name = self._name(node.name)
        made = Instance(
            kind="nodelet" if node.kind == "component" and self.ros == 1 else node.kind,
            package=text(node.package).text,
            executable=text(node.executable).text,
            plugin=text(node.plugin).text,
            name=name,
            namespace=namespace,
            ros=self.ros,
            place=Place(self.path, node.line),
            remaps=self._in_force((*scope.remaps, *self._remaps(node.remaps))),
            container=container,
            conditional=" and ".join(self._conditions(node, scope)),
            respawn=self._flag(node.respawn),
            required=self._flag(node.required),
            arguments=tuple(text(word) for word in node.arguments),
        )
        self.settings.missing.clear()
        made.settings = tuple(self._settings(node, scope, made))
        made.missing_files = tuple(self.settings.missing)
        return made

    def _settings(self, node: Node, scope: Scope, made: Instance) -> Iterator[Setting]:
        if self.ros == 2:
            yield from self._written(node, made)  # first, since launch adds what it sets itself after these words
            yield from self.settings.ros2((*scope.parameters, *node.parameters), made.namespace)
            return
        own = join(made.namespace, made.name or "~")
        for source in node.loaded:  # roslaunch loads YAML when it meets it, and adds the values of a node at its end
            yield from self.settings.ros1(source, own, in_node=True)
        yield from (Setting(join(own, each.name.lstrip("/")), each.value, each.place) for each in scope.private)
        for source in node.parameters:
            yield from self.settings.ros1(source, own, in_node=True)
        yield from (Setting(join(own, name), value, made.place) for name, value in ros1_given(made.arguments))

    def _written(self, node: Node, made: Instance) -> Iterator[Setting]:
        """What stands on the command line of a node."""
        for entry in ros2_given(made.arguments) if made.kind != "process" else ():
            if isinstance(entry, GivenValue):
                yield Setting(entry.name, entry.value, made.place)
            else:
                source = ParameterFile(line=node.line, path=(entry.path,))
                yield from self.settings.ros2((source,), made.namespace)

    def _namespace(self, node: Node, scope: Scope) -> str:
        given = self.substituter.text(node.namespace).text if node.namespace is not None else ""
        return join(scope.namespace, given) if given else scope.namespace

    def _name(self, template: Template | None) -> str | None:
        if template is None:
            return None
        text: Text = self.substituter.text(template)
        return text.text or None

    def _remaps(self, remaps: tuple[Remap, ...]) -> Iterator[Remapping]:
        for entry in remaps:
            if self.substituter.truth(entry.condition) is False:
                continue
            source, target = self.substituter.text(entry.source).text, self.substituter.text(entry.target).text
            yield Remapping(source, target, Place(self.path, entry.line))

    def _in_force(self, remaps: tuple[Remapping, ...]) -> tuple[Remapping, ...]:
        """In ROS 1 the last remap of a name replaces those before it; rcl tries all in order."""
        if self.ros == 2:
            return remaps
        last = {entry.source: at for at, entry in enumerate(remaps)}
        return tuple(entry for at, entry in enumerate(remaps) if last[entry.source] == at)

    def _conditions(self, node: Node, scope: Scope) -> Iterator[str]:
        yield from scope.conditions
        if self.substituter.truth(node.condition) is None and not scope.conditions:
            yield bare(self.substituter.text(node.condition).text)

    def _flag(self, template: Template | None) -> bool | None:
        return None if template is None else truth_of(self.substituter.text(template))
