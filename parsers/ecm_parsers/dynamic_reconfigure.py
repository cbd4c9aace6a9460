"""`.cfg` files of dynamic_reconfigure (ROS 1): Python text, read as a tree and never executed.

Source: ROS wiki, dynamic_reconfigure, "How to Write Your First .cfg File".
"""

from __future__ import annotations

from typing import Any

import msgspec
from tree_sitter import Node

from ecm_parsers.python_tree import (
    MAX_BYTES,
    Reached,
    callee_name,
    fold,
    line_of,
    parse_python,
    read_call,
    statements,
    text_of,
)
from ecm_parsers.python_values import PyCall, Unknown, Value, is_counted, shown
from ecm_parsers.python_variables import TELLING, Variables
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.text import decode

_FIELDS = ("name", "paramtype", "level", "description", "default", "min", "max", "edit_method")
_CONSTANT_FIELDS = ("name", "type", "value", "descr")
_WANTED = TELLING | {"import_from_statement", "for_statement"}
_OWN_MODULES = frozenset({"dynamic_reconfigure", "math", "driver_base", "roslib", "os", "sys", "__future__"})
_METHODS = frozenset({"add", "generate", "add_group", "const"})
_MAX_ROUNDS = 1000
_MAX_NESTED = 4


class EnumValue(msgspec.Struct, frozen=True):
    """A named value of an enumerated parameter."""

    name: str
    value: Any
    description: str = ""


class ReconfigureParameter(msgspec.Struct, frozen=True):
    """One parameter that can be changed at run time.

    Attributes:
        name: as on the parameter server; a part that is not known stays `{expression}`.
        type: int, double, str or bool; empty when not known.
        line: 1-based.
        default, min, max: plain data, None when not given or not known.
        level: bit mask passed to the callback.
        group: names of the enclosing groups, outermost first.
        enum: allowed values with their names.
    """

    name: str
    type: str
    line: int
    description: str = ""
    default: Any = None
    min: Any = None
    max: Any = None
    level: int | None = None
    group: tuple[str, ...] = ()
    enum: tuple[EnumValue, ...] = ()


class IncludedParameters(msgspec.Struct, frozen=True):
    """A function of another Python module that adds parameters: `from module import name`, `name(gen)`."""

    module: str
    name: str
    line: int


class ReconfigureFile(msgspec.Struct, frozen=True):
    """A dynamic_reconfigure configuration; `name` + `Config` is the class that is generated."""

    package: str | None = None
    node: str | None = None
    name: str | None = None
    line: int = 0
    parameters: tuple[ReconfigureParameter, ...] = ()
    included: tuple[IncludedParameters, ...] = ()


def is_dynamic_reconfigure(data: bytes) -> bool:
    """Tell by the generator that it asks whether a `.cfg` file describes parameters; other programs have such files."""
    return b"ParameterGenerator" in data


def parse_dynamic_reconfigure(data: bytes, path: str = "") -> Parsed[ReconfigureFile]:
    """Read a `.cfg` file; parameters added by imported functions are named in `included` and diagnosed.

    Args:
        data: the file.
        path: where it stands in its tree, by which it may call its configuration (`__file__`).
    """
    if len(data) > MAX_BYTES:
        message = f".cfg file larger than {MAX_BYTES} bytes is not read."
        return Parsed(ReconfigureFile(), (Diagnostic("error", "cfg-too-large", 0, message, cut=True),))
    text, diagnostics = decode(data)
    root = parse_python(text)
    reader = _Reader(list(diagnostics), path)
    if root.has_error:
        message = "Parts of the file are not valid Python; parameters in them may be missing."
        reader.diagnostics.append(Diagnostic("warning", "cfg-syntax", 0, message))
    reader.read(Reached(root, True))
    return Parsed(reader.facts(), tuple(reader.diagnostics))


class _Reader:
    """Goes through the statements in order."""

    def __init__(self, diagnostics: list[Diagnostic], path: str) -> None:
        self.diagnostics = diagnostics
        self._variables = Variables({"__file__": Value(path, 0)} if path else {})
        self._groups: dict[str, tuple[str, ...]] = {}
        self._imports: dict[str, str] = {}
        self._parameters: list[ReconfigureParameter] = []
        self._included: list[IncludedParameters] = []
        self._generate: tuple[PyCall, int] | None = None
        self._rounds = _MAX_ROUNDS

    def read(self, root: Reached, nested: int = 0) -> None:
        """Handle the imports, assignments, loops and calls below a node, those in a loop once for each round."""
        done = 0
        for reached in statements(root, _WANTED, self._variables.names, self.diagnostics):
            node = reached.node
            if node.start_byte < done:
                continue
            if node.type in TELLING:
                self._variables.take(reached)
            if node.type == "import_from_statement":
                self._import(node)
            elif node.type == "assignment":
                self._group(node)
            elif node.type == "call":
                self._call(node)
            elif node.type == "for_statement" and self._loops(reached, nested):
                done = node.end_byte

    def _loops(self, loop: Reached, nested: int) -> bool:
        """Go through the rounds of a loop over what is written out; of any other one the variables are not known."""
        node, known = loop.node, self._variables.names
        names = _targets(node.child_by_field_name("left"))
        rounds = fold(node.child_by_field_name("right"), known).data
        body = node.child_by_field_name("body")
        if not isinstance(rounds, tuple) or not is_counted(rounds) or not all(_fits(item, names) for item in rounds):
            rounds = ()
        if not rounds or body is None or nested == _MAX_NESTED or len(rounds) > self._rounds:
            for name in names:
                known.pop(name, None)
            return False
        self._rounds -= len(rounds)
        for item in rounds:
            given = item.data if len(names) > 1 and isinstance(item.data, tuple) else (item,)
            known.update(zip(names, given, strict=False))
            self.read(Reached(body, loop.certain), nested + 1)
        return True

    def facts(self) -> ReconfigureFile:
        """Return what was collected."""
        parameters, included = tuple(self._parameters), tuple(self._included)
        if self._generate is None:
            if parameters or included:
                message = "No call of generate(PACKAGE, node, name): the configuration has no name."
                self.diagnostics.append(Diagnostic("warning", "cfg-no-generate", 0, message))
            return ReconfigureFile(parameters=parameters, included=included)
        call, line = self._generate
        if not isinstance(call.args[2].data, str):
            message = "What the configuration is called is computed: its parameters are told of no server."
            self.diagnostics.append(Diagnostic("warning", "cfg-no-name", line, message))
        package, node, name = (shown(value) for value in call.args[:3])
        return ReconfigureFile(package, node, name, line, parameters, included)

    def _import(self, node: Node) -> None:
        module = _field_text(node, "module_name")
        if module.split(".")[0] in _OWN_MODULES:
            return
        for child in node.children_by_field_name("name"):
            name = _field_text(child, "name") if child.type == "aliased_import" else text_of(child)
            alias = _field_text(child, "alias") if child.type == "aliased_import" else name
            self._imports[alias] = module

    def _group(self, node: Node) -> None:
        """Note a generator, or a group of one, that a variable holds."""
        target = _field_text(node, "left")
        held = self._variables.names.get(target)
        if held is None or not isinstance(held.data, PyCall):
            return
        owner, _, method = held.data.name.rpartition(".")
        if method == "ParameterGenerator":
            self._groups[target] = ()
        elif method == "add_group":
            label = held.data.args[:1] or (held.data.keyword("name") or held,)
            self._groups[target] = (*self._groups.get(owner, ()), shown(label[0]))

    def _call(self, node: Node) -> None:
        owner, _, method = callee_name(node.child_by_field_name("function")).rpartition(".")
        if method in _METHODS and owner:
            call = read_call(node, self._variables.names)
            if method == "add":
                self._add(call, self._groups.get(owner, ()), line_of(node))
            elif method == "generate" and len(call.args) >= 3:
                self._generate = (call, line_of(node))
        elif method in self._imports:
            self._include(node, method)

    def _include(self, node: Node, name: str) -> None:
        """Note a call `function(gen)` of an imported function."""
        call = read_call(node, {})
        if not any(isinstance(arg.data, Unknown) and arg.data.text in self._groups for arg in call.args):
            return
        module = self._imports[name]
        self._included.append(IncludedParameters(module, name, line_of(node)))
        message = f"Parameters that {module[:80]}.{name[:80]} adds are not read; they stand in another file."
        self.diagnostics.append(Diagnostic("info", "cfg-imported-parameters", line_of(node), message))

    def _add(self, call: PyCall, group: tuple[str, ...], line: int) -> None:
        fields = _by_name(call, _FIELDS)
        kind = _type(fields.get("paramtype"))
        if "name" not in fields or (not kind and "default" not in fields and len(fields) < 4):
            return
        level = _plain(fields.get("level"))
        self._parameters.append(
            ReconfigureParameter(
                name=shown(fields["name"]),
                type=kind,
                line=line,
                description=shown(fields["description"]) if "description" in fields else "",
                default=_plain(fields.get("default")),
                min=_plain(fields.get("min")),
                max=_plain(fields.get("max")),
                level=level if isinstance(level, int) else None,
                group=group,
                enum=_enum(fields.get("edit_method")),
            )
        )


def _targets(left: Node | None) -> list[str]:
    """The variables of a loop: `a`, or `a, b`."""
    if left is None:
        return []
    return [text_of(child) for child in left.named_children] or [text_of(left)]


def _fits(item: Value, names: list[str]) -> bool:
    return len(names) == 1 or (isinstance(item.data, tuple) and len(item.data) == len(names))


def _field_text(node: Node, field: str) -> str:
    child = node.child_by_field_name(field)
    return "" if child is None else text_of(child)


def _by_name(call: PyCall, fields: tuple[str, ...]) -> dict[str, Value]:
    """Return the arguments of a call by the names of its parameters."""
    return {**dict(zip(fields, call.args, strict=False)), **dict(call.keywords)}


def _type(value: Value | None) -> str:
    """Return `double` for `double_t`, `gen.double_t` or `"double"`."""
    if value is None:
        return ""
    text = value.data.text if isinstance(value.data, Unknown) else value.data
    name = str(text).rpartition(".")[2].removesuffix("_t")
    return name if name in {"int", "double", "str", "bool"} else ""


def _plain(value: Value | None) -> Any:
    data = None if value is None else value.data
    return data if isinstance(data, str | int | float) else None


def _enum(value: Value | None) -> tuple[EnumValue, ...]:
    """Return the values of `gen.enum([gen.const(...), ...], description)`."""
    if value is None or not isinstance(value.data, PyCall) or not value.data.args:
        return ()
    constants = value.data.args[0].data
    found: list[EnumValue] = []
    for constant in constants if isinstance(constants, tuple) else ():
        if isinstance(constant.data, PyCall) and constant.data.name.endswith("const"):
            fields = _by_name(constant.data, _CONSTANT_FIELDS)
            if "name" in fields:
                description = shown(fields["descr"]) if "descr" in fields else ""
                found.append(EnumValue(shown(fields["name"]), _plain(fields.get("value")), description))
    return tuple(found)
