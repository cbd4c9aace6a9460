"""Values of a Python launch file: descriptions in the making, and what actions and parameters are made of."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import MappingProxyType

from ecm_parsers.launch.model import Action, Data, Group, ParameterFile, ParameterSource, ParameterValue, Typing, Unread
from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.values import MAX_DEPTH, Many, Modelled, Object, Text, Unknown, Value, is_yaml_file, template_of
from ecm_parsers.template import Template


@dataclass(slots=True, eq=False)
class Description(Modelled):
    """A `LaunchDescription` in the making."""

    actions: list[Value] = field(default_factory=list)

    @property
    def items(self) -> list[Value]:
        """Its actions."""
        return self.actions

    def attribute(self, name: str) -> Value:
        """Return its actions or a method."""
        return self.actions if name == "entities" else Modelled.attribute(self, name)

    def call(self, name: str, given: Arguments) -> Value:
        """Take an action."""
        if name in _ADDING:
            self.actions.append(given.get(_ADDING[name], 0))


_ADDING = MappingProxyType({"add_action": "action", "add_entity": "entity"})


def command_words(value: Value) -> tuple[Template, ...]:
    """Return the words of a command line."""
    if not isinstance(value, list | tuple):
        return (template_of(value),) if value is not None else ()
    return tuple(template_of(item) for item in value)


def data_of(value: Value, depth: int = 0) -> Data:
    """Return a parameter's value; quoted text and substitutions are templates."""
    if value is None or isinstance(value, bool | int | float):
        return value
    if isinstance(value, list | tuple) and depth < MAX_DEPTH:
        if any(_is_substitution(item) for item in value) and all(isinstance(item, str | Text) for item in value):
            return template_of(value)
        items = [template_of(item) if isinstance(item, list | tuple) else data_of(item, depth + 1) for item in value]
        numbers = {type(item) for item in items}
        return [float(item) for item in items] if numbers == {int, float} else items  # type: ignore[arg-type]
    return template_of(value)


def _is_substitution(value: Value) -> bool:
    return isinstance(value, Text) and not value.is_str


def typing_of(value: Value) -> Typing:
    """Return how `launch_ros` types a value of a map: what Python holds as `str` stays text, a substitution is YAML."""
    if isinstance(value, Text):
        return "str" if value.is_str else "yaml"
    items = value if isinstance(value, list | tuple) else ()
    return "yaml" if any(isinstance(item, list | tuple) or typing_of(item) == "yaml" for item in items) else "str"


def parameter_sources(value: Value, line: int) -> tuple[ParameterSource, ...]:
    """Return what `parameters=[...]` sets: maps, files and what cannot be known."""
    found: list[ParameterSource] = []
    for item in value if isinstance(value, list | tuple) else [value]:
        item = item.each if isinstance(item, Many) else item
        if isinstance(item, ParameterFile | ParameterValue):
            found.append(item)
        elif isinstance(item, dict):
            found += _flattened(item, (), line)
        elif isinstance(item, list | tuple) and any(isinstance(entry, dict | list | ParameterFile) for entry in item):
            found += parameter_sources(item, line)
        elif item is not None:
            found.append(ParameterFile(line=line, path=template_of(item), plain=is_yaml_file(item)))
    return tuple(found)


def _flattened(table: dict[Value, Value], prefix: Template, line: int, depth: int = 0) -> list[ParameterSource]:
    found: list[ParameterSource] = []
    for key, value in table.items():
        own = () if is_yaml_file(key) else template_of(key)  # what a file is updated with has no key of its own
        name = (*prefix, ".", *own) if prefix and own else own or prefix
        if is_yaml_file(value):
            found.append(ParameterFile(line=line, path=template_of(value), prefix=name, plain=True))
        elif isinstance(value, dict) and depth < MAX_DEPTH:
            found += _flattened(value, name, line, depth + 1)
        elif isinstance(value, ParameterValue):
            found.append(ParameterValue(line=line, name=name, value=value.value, typing=value.typing))
        else:
            found.append(ParameterValue(line=line, name=name, value=data_of(value), typing=typing_of(value)))
    return found


def actions_of(value: Value, depth: int = 0) -> tuple[Action, ...]:
    """Return the actions of a list, description or single action, in order; a call that cannot be read is one too."""
    if isinstance(value, Object):
        value = value.made if value.made is not None else Unknown(value.cls.name, value.line)
    if isinstance(value, Description):
        value = value.actions
    if isinstance(value, Many):
        value = value.each
    if isinstance(value, list | tuple) and depth < MAX_DEPTH:
        return tuple(action for item in value for action in actions_of(item, depth + 1))
    if isinstance(value, Unknown) and value.line:
        return (Unread(line=value.line, text=value.text),)
    return (value,) if isinstance(value, Action) else ()


def starts_something(value: Value) -> bool:
    """Tell whether a value holds actions that can be read."""
    return any(not isinstance(action, Unread) for action in actions_of(value))


def guarded(actions: tuple[Action, ...], guard: Template | None, line: int) -> tuple[Action, ...]:
    """Return actions that are taken only where the guard holds."""
    if guard is None or not actions:
        return actions
    return (Group(line=line, condition=guard, actions=actions, scoped=False),)
