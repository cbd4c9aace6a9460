"""`.cfg` files of dynamic_reconfigure (ROS 1): Python text, read as a tree and never executed.

Source: ROS wiki, dynamic_reconfigure, "How to Write Your First .cfg File".
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from typing import Any

import msgspec

from ecm_parsers.python.arguments import Arguments, Constructor
from ecm_parsers.python.declared import MAX_BYTES, declarations, pattern_of
from ecm_parsers.python.values import Method, Modelled, Reference, Text, Unknown, Value
from ecm_parsers.python.watching import Watcher
from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.template import Substitution
from ecm_parsers.text import decode

_FIELDS = ("name", "paramtype", "level", "description", "default", "min", "max", "edit_method")
_CONSTANT_FIELDS = ("name", "type", "value", "descr")
_OWN_MODULES = frozenset({"dynamic_reconfigure", "math", "driver_base", "roslib", "os", "sys", "__future__"})
_METHODS = ("add", "add_group", "const", "enum", "generate")


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
    text, doubts = decode(data)
    reader = _Reader(list(doubts))
    names = {"__file__": Text((Substitution("unknown", (("tree",),)), f"/{path}"))} if path else {}
    is_whole, bounds = declarations(reader.models, names, reader).read(text)
    if not is_whole:
        message = "Parts of the file are not valid Python; parameters in them may be missing."
        reader.diagnostics.append(Diagnostic("warning", "cfg-syntax", 0, message))
    reader.diagnostics.extend(bounds)
    return Parsed(reader.facts(), tuple(reader.diagnostics))


class _Constant(msgspec.Struct, frozen=True):
    """What `gen.const` gives."""

    value: EnumValue


class _Choice(msgspec.Struct, frozen=True):
    """What `gen.enum` gives."""

    values: tuple[EnumValue, ...]


class _Generator(Modelled):
    """A generator or a group of one, below the groups with these names."""

    def __init__(self, reader: _Reader, group: tuple[str, ...] = ()) -> None:
        self._reader = reader
        self._group = group

    def call(self, name: str, given: Arguments) -> Value:
        """Take a parameter or the name of the configuration; return a group, a constant or a choice."""
        if name == "add_group":
            return _Generator(self._reader, (*self._group, pattern_of(given.get("name", 0, Unknown("")))))
        if name == "const":
            fields = _by_name(given, _CONSTANT_FIELDS)
            return _Constant(_enum_value(fields)) if "name" in fields else Unknown("")
        if name == "enum":
            listed = given.get("constants", 0)
            constants = listed if isinstance(listed, list | tuple) else ()
            return _Choice(tuple(each.value for each in constants if isinstance(each, _Constant)))
        if name == "add":
            self._reader.add(given, self._group)
        elif name == "generate" and len(given.positional) >= 3:
            self._reader.generated = given
        return Unknown("")


class _Reader(Watcher):
    """Collects what the calls of a file say."""

    def __init__(self, diagnostics: list[Diagnostic]) -> None:
        self.diagnostics = diagnostics
        self.generated: Arguments | None = None
        self._parameters: list[ReconfigureParameter] = []
        self._included: list[IncludedParameters] = []

    @property
    def models(self) -> Mapping[str, Constructor]:
        """What a `.cfg` file calls; a generator that is handed to a function is one by its methods."""
        made = _Generator(self)
        calls: dict[str, Constructor] = {name: partial(made.call, name) for name in _METHODS}
        calls["ParameterGenerator"] = lambda _: _Generator(self)
        return calls

    def facts(self) -> ReconfigureFile:
        """Return what was collected."""
        parameters, included = tuple(self._parameters), tuple(self._included)
        if self.generated is None:
            if parameters or included:
                message = "No call of generate(PACKAGE, node, name): the configuration has no name."
                self.diagnostics.append(Diagnostic("warning", "cfg-no-generate", 0, message))
            return ReconfigureFile(parameters=parameters, included=included)
        line = self.generated.line
        if not isinstance(self.generated.positional[2], str | Text):
            message = "What the configuration is called is computed: its parameters are told of no server."
            self.diagnostics.append(Diagnostic("warning", "cfg-no-name", line, message))
        package, node, name = map(pattern_of, self.generated.positional[:3])
        return ReconfigureFile(package, node, name, line, parameters, included)

    def unread(self, path: str, given: Arguments) -> None:
        """Note a call `function(gen)` of an imported function."""
        module, _, name = path.rpartition(".")
        if not module or module.split(".")[0] in _OWN_MODULES:
            return
        if not any(isinstance(each, _Generator) for each in given.positional):
            return
        self._included.append(IncludedParameters(module, name, given.line))
        message = f"Parameters that {module[:80]}.{name[:80]} adds are not read; they stand in another file."
        self.diagnostics.append(Diagnostic("info", "cfg-imported-parameters", given.line, message))

    def add(self, given: Arguments, group: tuple[str, ...]) -> None:
        """Take a parameter."""
        fields = _by_name(given, _FIELDS)
        kind = _type(fields.get("paramtype"))
        if "name" not in fields or (not kind and "default" not in fields and len(fields) < 4):
            return
        level, choice = _plain(fields.get("level")), fields.get("edit_method")
        self._parameters.append(
            ReconfigureParameter(
                name=pattern_of(fields["name"]),
                type=kind,
                line=given.line,
                description=pattern_of(fields["description"]) if "description" in fields else "",
                default=_plain(fields.get("default")),
                min=_plain(fields.get("min")),
                max=_plain(fields.get("max")),
                level=level if isinstance(level, int) else None,
                group=group,
                enum=choice.values if isinstance(choice, _Choice) else (),
            )
        )


def _by_name(given: Arguments, fields: tuple[str, ...]) -> Mapping[str, Value]:
    """Return the arguments of a call by the names of its parameters."""
    return {**dict(zip(fields, given.positional, strict=False)), **given.keywords}


def _type(value: Value) -> str:
    """Return `double` for `double_t`, `gen.double_t` or `"double"`."""
    named = value.path if isinstance(value, Reference) else value.name if isinstance(value, Method) else value
    text = named.text if isinstance(named, Unknown) else str(named)
    name = text.rpartition(".")[2].removesuffix("_t")
    return name if name in {"int", "double", "str", "bool"} else ""


def _plain(value: Value) -> Any:
    if isinstance(value, str | Text):
        return pattern_of(value)
    return value if isinstance(value, int | float) and math.isfinite(value) else None


def _enum_value(fields: Mapping[str, Value]) -> EnumValue:
    description = pattern_of(fields["descr"]) if "descr" in fields else ""
    return EnumValue(pattern_of(fields["name"]), _plain(fields.get("value")), description)
