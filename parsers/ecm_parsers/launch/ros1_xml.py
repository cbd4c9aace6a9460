"""roslaunch XML -> actions.

Source: wiki.ros.org/roslaunch/XML; nodelets by wiki.ros.org/nodelet (`load`, `standalone`, `manager`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from types import MappingProxyType

from ecm_parsers.launch.entity import Entity
from ecm_parsers.launch.markup import condition, incomplete, optional, template, words
from ecm_parsers.launch.model import (
    Action,
    Argument,
    Data,
    Group,
    Include,
    Node,
    ParameterFile,
    ParameterSource,
    ParameterValue,
    PushNamespace,
    Remap,
    SetConfiguration,
    Typing,
)
from ecm_parsers.launch.substitution import parse_template
from ecm_parsers.result import Diagnostic
from ecm_parsers.template import Substitution, Template

_TYPES: Mapping[str, Typing] = MappingProxyType(
    {
        "str": "bare",
        "string": "bare",
        "int": "int",
        "double": "double",
        "bool": "bool",
        "boolean": "bool",
        "yaml": "yaml",
    }
)
"""Typing by the attribute `type` of a parameter."""


class Ros1Reader:
    """Reads the elements of one file; what cannot be read is in `problems`."""

    def __init__(self) -> None:
        self.problems: list[Diagnostic] = []
        self._readers: dict[str, Callable[[Entity], Action | None]] = {
            "arg": self._argument,
            "param": self._parameter,
            "rosparam": self._rosparam,
            "remap": self._remap,
            "env": _environment,
            "group": self._group,
            "include": self._include,
            "node": self._node,
            "test": self._test,
            "machine": lambda _: None,
            "master": lambda _: None,
        }

    @property
    def tags(self) -> frozenset[str]:
        """Elements that roslaunch knows."""
        return frozenset(self._readers)

    def actions(self, parent: Entity) -> tuple[Action, ...]:
        """Return the actions below an element, in order."""
        return tuple(action for _, action in self._read(parent))

    def _read(self, parent: Entity) -> Iterator[tuple[str, Action]]:
        for entity in parent.children:
            reader = self._readers.get(entity.tag)
            if reader is None:
                message = f"<{entity.tag}> is no element of roslaunch and is skipped. Correct its name."
                self.problems.append(Diagnostic("warning", "launch-unknown-element", entity.line, message))
                continue
            action = reader(entity)
            if action is not None:
                yield entity.tag, action

    def _needs(self, entity: Entity, *names: str) -> bool:
        missing = next((name for name in names if not entity.get(name)), None)
        if missing is not None:
            self.problems.append(incomplete(entity, missing))
        return missing is None

    def _argument(self, entity: Entity) -> Argument | None:
        if not self._needs(entity, "name"):
            return None
        return Argument(
            line=entity.line,
            condition=condition(entity),
            name=entity.attributes["name"],
            default=optional(entity, "default"),
            value=optional(entity, "value"),
            description=entity.get("doc") or "",
        )

    def _parameter(self, entity: Entity) -> ParameterValue | None:
        if not self._needs(entity, "name"):
            return None
        value: Data = optional(entity, "value")
        if value is None and entity.get("command"):
            value = (Substitution("command", (template(entity, "command"),)),)
        if value is None:
            value = (Substitution("content", (template(entity, "textfile", "binfile"),)),)
        return ParameterValue(
            line=entity.line,
            condition=condition(entity),
            name=parse_template((entity.get("name") or "").strip()),  # as roslaunch does (xmlloader.py)
            value=value,
            typing=_TYPES.get((entity.get("type") or "").lower().strip(), "auto"),
        )

    def _rosparam(self, entity: Entity) -> ParameterSource | None:
        command = entity.get("command") or "load"
        if command != "load":
            return None
        if entity.get("file"):
            place = _place(entity)
            path = template(entity, "file")
            substitutes = _substitutes(entity)
            return ParameterFile(
                line=entity.line, condition=condition(entity), path=path, namespace=place, substitutes=substitutes
            )
        name = _place(entity)
        body: Template = parse_template(entity.text) if _substitutes(entity) else (entity.text,)
        return ParameterValue(line=entity.line, condition=condition(entity), name=name, value=body)

    def _remap(self, entity: Entity) -> Remap | None:
        if not self._needs(entity, "from", "to"):
            return None
        source, target = template(entity, "from"), template(entity, "to")
        return Remap(line=entity.line, condition=condition(entity), source=source, target=target)

    def _group(self, entity: Entity) -> Group:
        inner = self.actions(entity)
        return Group(line=entity.line, condition=condition(entity), actions=_below(entity, inner))

    def _include(self, entity: Entity) -> Include | None:
        if not self._needs(entity, "file"):
            return None
        given = [child for child in entity.below("arg") if child.get("name")]
        return Include(
            line=entity.line,
            condition=condition(entity),
            path=template(entity, "file"),
            arguments=tuple((child.attributes["name"], template(child, "value", "default")) for child in given),
            argument_lines=tuple(child.line for child in given),
            argument_conditions=tuple(condition(child) for child in given),
            namespace=template(entity, "ns"),
            pass_all=(entity.get("pass_all_args") or "").lower() in {"true", "1"},
        )

    def _node(self, entity: Entity) -> Node | None:
        if not self._needs(entity, "pkg", "type"):
            return None
        inner = tuple(self._read(entity))
        node = Node(
            line=entity.line,
            condition=condition(entity),
            kind="node",
            package=template(entity, "pkg"),
            executable=template(entity, "type"),
            name=optional(entity, "name"),
            namespace=optional(entity, "ns"),
            remaps=tuple(action for _, action in inner if isinstance(action, Remap)),
            parameters=_sources(each for tag, each in inner if tag == "param"),
            loaded=_sources(each for tag, each in inner if tag == "rosparam"),
            arguments=words(entity.get("args")),
            respawn=optional(entity, "respawn"),
            required=optional(entity, "required"),
        )
        return nodelet(node) if entity.get("pkg") == "nodelet" else node

    def _test(self, entity: Entity) -> Group:
        """A test is started by rostest only; its parameters are set all the same, below its name."""
        name = template(entity, "name", "test-name")
        inner = _sources(self.actions(entity))
        below = PushNamespace(line=entity.line, namespace=name)
        actions = _below(entity, (below, *inner)) if inner else ()
        return Group(line=entity.line, condition=condition(entity), actions=actions)


def _sources(actions: Iterable[Action]) -> tuple[ParameterSource, ...]:
    return tuple(action for action in actions if isinstance(action, ParameterValue | ParameterFile))


def nodelet(node: Node) -> Node:
    """Return what the nodelet program does by its first argument: a container, or a component in one."""
    plain = [word[0] if len(word) == 1 and isinstance(word[0], str) else None for word in node.arguments]
    verb = plain[0] if plain else None
    if verb == "manager":
        return _replaced(node, kind="container")
    if verb == "standalone" and len(plain) > 1:
        return _replaced(node, kind="component", plugin=node.arguments[1])
    if verb == "load" and len(plain) > 2:
        return _replaced(node, kind="component", plugin=node.arguments[1], target=node.arguments[2])
    return node


def _replaced(node: Node, **changes: object) -> Node:
    values = {name: getattr(node, name) for name in node.__struct_fields__}
    return Node(**{**values, **changes})


def _environment(entity: Entity) -> SetConfiguration:
    return SetConfiguration(
        line=entity.line,
        condition=condition(entity),
        name=template(entity, "name"),
        value=template(entity, "value"),
        environment=True,
    )


def _below(entity: Entity, inner: tuple[Action, ...]) -> tuple[Action, ...]:
    """A group's `ns` is a namespace pushed before its actions."""
    if not entity.get("ns"):
        return inner
    return (PushNamespace(line=entity.line, namespace=template(entity, "ns")), *inner)


def _place(entity: Entity) -> Template:
    """Where `<rosparam>` puts what it loads: a private name is one of roslaunch itself, also in a node.

    Source: `Loader.load_rosparam` keeps `~x` as it is, and `ROSLaunchRunner` sets it as the caller `/roslaunch`.
    """
    place = _joined(template(entity, "ns"), template(entity, "param"))
    text = _beginning(place)
    return (f"/roslaunch/{text[1:]}", *place[1:]) if text.startswith("~") else place


def _joined(first: Template, second: Template) -> Template:
    """Put a name below another one; a private or a global one stays as it is."""
    if not first or _beginning(second).startswith(("~", "/")):
        return second
    return (*first, "/", *second) if second else first


def _beginning(name: Template) -> str:
    """The text that a name begins with."""
    return name[0] if name and isinstance(name[0], str) else ""


def _substitutes(entity: Entity) -> bool:
    return (entity.get("subst_value") or "").lower() in {"true", "1"}
