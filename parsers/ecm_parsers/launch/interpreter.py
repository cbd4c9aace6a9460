"""Python launch files: what `launch` adds to Python, and what is doubtful in a file."""

from __future__ import annotations

import ast
from collections.abc import Callable

from ecm_parsers.launch.branches import choice, returned_value, under
from ecm_parsers.launch.constructors import LAUNCH
from ecm_parsers.launch.doubts import Doubts
from ecm_parsers.launch.model import Argument, Group
from ecm_parsers.launch.values import actions_of
from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.calls import Calls, Returned
from ecm_parsers.python.interpreter import Interpreter
from ecm_parsers.python.methods import LOSING, call_method
from ecm_parsers.python.reading import MAX_BYTES
from ecm_parsers.python.sources import Sources
from ecm_parsers.python.values import MAX_ITEMS, Function, Reference, Text, Unknown, Value, as_str
from ecm_parsers.template import Substitution, Template
from ecm_parsers.xml_tree import parse_xml

_ADDING = frozenset({"append", "add_action", "extend", "insert"})
_OF_CONTEXT = frozenset({"launch_configurations", "perform_substitution"})


class LaunchInterpreter(Interpreter):
    """Reads one launch file and what it imports."""

    def __init__(self, sources: Sources | None = None) -> None:
        self.doubts = Doubts()
        super().__init__(LAUNCH, {"__file__": Text((Substitution("dirname"), "/launch.py"))}, sources, self.doubts)

    def attribute(self, owner: Value, name: str, line: int = 0) -> Value:
        """Return an attribute of a value; those of the launch context are known by their name."""
        of_context = name in _OF_CONTEXT and not isinstance(owner, Reference)
        return Reference(name) if of_context else super().attribute(owner, name, line)

    def chosen(self, holds: Template, first: Value, second: Value, name: str) -> Value:
        """Return a value with the condition in it."""
        return choice(holds, first, second)

    def method(self, owner: Value, name: str, given: Arguments, written: ast.expr) -> Value:
        """Return what a method gives; what it adds carries the condition of the branch, and nothing is taken away."""
        if name in _ADDING and self._guard is not None:
            positional = tuple(under(self._guard, value, given.line) for value in given.positional)
            given = Arguments(positional, given.keywords, given.line)
        if name in LOSING and self._guard is not None:
            return Unknown(name)
        return call_method(owner, name, given)

    def returned(self, found: Returned, line: int) -> Value:
        """Return what is returned with the conditions in it."""
        return returned_value(found, line)

    def made(self, value: Value) -> Value:
        """Take note of the arguments of the file, for paths that depend on them."""
        if isinstance(value, Argument) and value.default is not None:
            self.sources.declared(value.name, value.default)
        return value

    def _opaque(self, given: Arguments) -> Value:
        function = given.get("function", 0)
        extra = given.get("args", default=()) or ()
        if not isinstance(function, Function):
            unread = actions_of(Unknown(_called(function), given.line))
            return Group(line=given.line, condition=given.condition, actions=unread, scoped=False)
        keywords = given.get("kwargs", default={}) or {}
        positional = (Unknown("context"), *(extra if isinstance(extra, list | tuple) else ()))
        made = self.call(function, Arguments(positional, keywords if isinstance(keywords, dict) else {}, given.line))
        return Group(line=given.line, condition=given.condition, actions=actions_of(made), scoped=False)

    def _virtual_joints(self, given: Arguments) -> Value:
        """The virtual joints of a semantic description as maps of their attributes."""
        data = self.sources.file(given.template("", 0))
        root = parse_xml(data).root if data is not None and len(data) <= MAX_BYTES else None
        found = root.iter("virtual_joint") if root is not None else ()
        return [{str(name): str(value) for name, value in joint.attrib.items()} for joint in found][:MAX_ITEMS]

    SPECIAL: dict[str, Callable[[LaunchInterpreter, Arguments], Value]] = {  # noqa: RUF012  # read only, as above
        **Calls.SPECIAL,
        "OpaqueFunction": _opaque,
        "srdf_virtual_joints": _virtual_joints,
        "perform_substitution": lambda _, given: as_str(given.get("", 0)),
    }


def _called(value: Value) -> str:
    """How a function that is not of the tree is written."""
    return value.path if isinstance(value, Reference) else value.text if isinstance(value, Unknown) else "function"
