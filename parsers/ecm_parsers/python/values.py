"""Values of Python that is read and not run: plain data, texts with substitutions, classes of the tree.

Lists and dicts are mutable here, since files build them step by step.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from ecm_parsers.template import TOO_LARGE, Substitution, Template, bounded

if TYPE_CHECKING:
    from ecm_parsers.python.arguments import Arguments

MAX_ITEMS = 2_000
MAX_TEXT = 20_000
MAX_DEPTH = 20


@dataclass(frozen=True, slots=True)
class Text:
    """A text with substitutions, or one substitution; `TOO_LARGE` where it has too many.

    `is_str` tells that it is a `str` when the file is run, not a substitution of `launch`; `is_performed` that it is
    the text itself of what it substitutes; `line` where it is written, if that was asked for.
    """

    parts: Template
    is_str: bool = field(default=False, compare=False)
    is_performed: bool = field(default=False, compare=False)
    line: int = field(default=0, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "parts", bounded(self.parts))

    @property
    def is_cut(self) -> bool:
        """Whether it was too large to be kept."""
        return self.parts is TOO_LARGE


@dataclass(frozen=True, slots=True)
class Condition:
    """What `condition=` takes."""

    holds: Template

    def __post_init__(self) -> None:
        object.__setattr__(self, "holds", bounded(self.holds))


@dataclass(frozen=True, slots=True)
class Unknown:
    """A value that is not known without running the file, as written; `line` is set where a call gives it."""

    text: str
    line: int = 0


@dataclass(frozen=True, slots=True)
class Reference:
    """An imported name or a part of one, dotted as written."""

    path: str

    @property
    def last(self) -> str:
        """The part after the last dot."""
        return self.path.rsplit(".", 1)[-1]


@dataclass(frozen=True, slots=True)
class Many:
    """Any number of elements of a list, or of entries of a map, all of them like `each`."""

    each: Value
    line: int = field(default=0, compare=False)


@dataclass(frozen=True, slots=True, eq=False)
class Function:
    """A function; its free names are looked up where it was defined.

    Attributes:
        owner: class that holds it. kind: its decorator: staticmethod, classmethod, property or empty.
        first: what it is bound to and gets before the arguments of the call.
    """

    node: ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda
    scope: Scope
    owner: Class | None = None
    kind: str = ""
    first: tuple[Value, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Method:
    """A method of a value that is about to be called."""

    owner: Value
    name: str


class Modelled:
    """An object of a library whose attributes and methods a reader knows."""

    @property
    def items(self) -> list[Value] | None:
        """What a loop over it goes through, None where that is not known."""
        return None

    def attribute(self, name: str) -> Value:
        """Return an attribute; most are methods."""
        return Method(self, name)

    def call(self, name: str, given: Arguments) -> Value:
        """Return what a method gives."""
        return Unknown(name)


@dataclass(slots=True, eq=False)
class Scope:
    """Names of a function or of the module, and of what surrounds it."""

    names: dict[str, Value] = field(default_factory=dict)
    parent: Scope | None = None

    def find(self, name: str) -> Value | None:
        """Return the value of a name as a reader from here sees it, None when nobody has set it."""
        scope: Scope | None = self
        while scope is not None:
            if name in scope.names:
                return scope.names[name]
            scope = scope.parent
        return None


@dataclass(frozen=True, slots=True, eq=False)
class Module:
    """A module of the tree that the file imports."""

    name: str
    scope: Scope


@dataclass(frozen=True, slots=True, eq=False)
class Class:
    """A class of the tree; `fields` are its annotated names, as a data class has them."""

    name: str
    bases: tuple[Value, ...]
    body: Scope
    fields: tuple[str, ...] = ()


@dataclass(slots=True, eq=False)
class Object:
    """An object of a class of the tree; `made` is what its base of `launch` makes of it."""

    cls: Class
    line: int
    attributes: dict[str, Value] = field(default_factory=dict)
    made: Value = None


@dataclass(frozen=True, slots=True, eq=False)
class Super:
    """What `super()` gives in a method of `cls`."""

    holder: Value
    cls: Class


Value: TypeAlias = Any
"""str, int, float, bool, None, list, tuple, dict, what a model makes or a class of this file."""


def template_of(value: Value, depth: int = 0) -> Template:
    """Return a value as launch turns it into text: lists are joined."""
    if value is None or depth > MAX_DEPTH:
        return ()
    if isinstance(value, str):
        return (value,) if value else ()
    if isinstance(value, Text):
        return value.parts
    if isinstance(value, bool | int | float):
        return (str(value),)
    if isinstance(value, list | tuple):
        return tuple(part for item in value for part in template_of(item, depth + 1))
    if isinstance(value, Condition):
        return value.holds
    if isinstance(value, Object) and value.made is not None:
        return template_of(value.made, depth + 1)
    if isinstance(value, Many):
        return template_of(value.each, depth + 1)
    return (Substitution("unknown", ((shown(value),),)),)


def shown(value: Value) -> str:
    """Return what an unknown value is called in the file."""
    if isinstance(value, Object):
        return value.cls.name
    if isinstance(value, Reference):
        return value.path
    return value.text if isinstance(value, Unknown) else type(value).__name__


def is_counted(items: Iterable[Value]) -> bool:
    """Tell whether a list or map has as many elements as are known of it."""
    return not any(isinstance(item, Many) for item in items)


def is_plain(value: Value, depth: int = 0) -> bool:
    """Tell whether a value is data that is wholly known."""
    if isinstance(value, list | tuple) and depth < MAX_DEPTH:
        return all(is_plain(item, depth + 1) for item in value)
    if isinstance(value, dict) and depth < MAX_DEPTH:
        return all(is_plain(item, depth + 1) for pair in value.items() for item in pair)
    return value is None or isinstance(value, str | int | float)


def hashable(value: Value) -> bool:
    """Tell whether a value can be a key."""
    if isinstance(value, Many):
        return isinstance(value.each, Unknown) or hashable(value.each)
    return isinstance(value, str | int | float | bool | Text | None) or (
        isinstance(value, tuple) and all(hashable(item) for item in value)
    )


def is_yaml_file(value: Value) -> bool:
    """Tell whether a value is the data of a YAML file."""
    return isinstance(value, Text) and [getattr(part, "kind", "") for part in value.parts] == ["yaml"]


def text_of(value: Value) -> str | None:
    """Return a value that is text without substitutions, None for any other."""
    parts = template_of(value) if isinstance(value, str | Text | list | tuple) else None
    if parts is None or not all(isinstance(part, str) for part in parts):
        return None
    return "".join(str(part) for part in parts)


def merged_text(parts: Template, *, is_str: bool = False) -> Value:
    """Return parts as plain text where they hold no substitution; `is_str` as in `Text`."""
    joined: list[str | Substitution] = []
    for part in parts:
        if part == "":
            continue
        if isinstance(part, str) and joined and isinstance(joined[-1], str):
            joined[-1] = joined[-1] + part
        else:
            joined.append(part)
    if not joined:
        return ""
    if sum(len(part) for part in joined if isinstance(part, str)) > MAX_TEXT:
        return Text(TOO_LARGE)
    return joined[0] if len(joined) == 1 and isinstance(joined[0], str) else Text(tuple(joined), is_str)


def as_str(value: Value) -> Value:
    """Return what a substitution gives as a `str` of Python."""
    return Text(value.parts, is_str=True, is_performed=True) if isinstance(value, Text) else value


def expanded(value: Value, limit: int) -> int:
    """Return how many items a list or map holds on all levels, each counted as often as it is met, up to a limit."""
    count, pending = 0, [value]
    while pending and count <= limit:
        item = pending.pop()
        if isinstance(item, Modelled):
            item = item.items
        if isinstance(item, list | tuple | dict):
            count += 1 + len(item)
            pending.extend(item.values() if isinstance(item, dict) else item)
    return count
