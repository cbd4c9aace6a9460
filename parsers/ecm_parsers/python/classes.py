"""Classes of a file: their members, their objects, and what `super().__init__` makes of an object."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import replace

from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.models import Models
from ecm_parsers.python.values import (
    MAX_DEPTH,
    Class,
    Function,
    Object,
    Reference,
    Scope,
    Super,
    Text,
    Unknown,
    Value,
    is_plain,
)

_ABSENT = object()
_PLAIN_TYPES = (str, bool, int, float, list, tuple, dict)
_PLAIN = frozenset(kind.__name__ for kind in _PLAIN_TYPES)


def class_of(node: ast.ClassDef, bases: tuple[Value, ...], body: Scope) -> Class:
    """Return a class; `body` holds what its statements set."""
    made = Class(node.name, bases, body, tuple(_fields(node)))
    for name, value in body.names.items():
        if isinstance(value, Function) and isinstance(value.node, ast.FunctionDef | ast.AsyncFunctionDef):
            body.names[name] = replace(value, owner=made, kind=_kind(value.node))
    return made


def _fields(node: ast.ClassDef) -> Iterator[str]:
    for statement in node.body:
        if isinstance(statement, ast.AnnAssign) and isinstance(statement.target, ast.Name):
            yield statement.target.id


def _kind(node: ast.FunctionDef | ast.AsyncFunctionDef) -> str:
    names = {entry.id for entry in node.decorator_list if isinstance(entry, ast.Name)}
    return next((kind for kind in ("staticmethod", "classmethod", "property") if kind in names), "")


def lineage(cls: Class, depth: int = 0) -> Iterator[Class | Reference]:
    """Yield a class and its bases, nearest first."""
    yield cls
    for base in cls.bases if depth < MAX_DEPTH else ():
        if isinstance(base, Class):
            yield from lineage(base, depth + 1)
        elif isinstance(base, Reference):
            yield base


def member(cls: Class, name: str, holder: Value, *, above: bool = False) -> Value:
    """Return a member as a holder (object or class) sees it, None when no class of the tree has it.

    Args:
        cls: where to look first.
        name: of the member.
        holder: what methods are bound to.
        above: leave out `cls` itself, as `super()` does.
    """
    for entry in list(lineage(cls))[1 if above else 0 :]:
        value = entry.body.names.get(name, _ABSENT) if isinstance(entry, Class) else _ABSENT
        if value is not _ABSENT:
            return _bound(value, cls, holder)
    return None


def _bound(value: Value, cls: Class, holder: Value) -> Value:
    if not isinstance(value, Function) or value.kind == "staticmethod":
        return value
    if value.kind == "classmethod":
        return replace(value, first=(holder.cls if isinstance(holder, Object) else cls,))
    return replace(value, first=(holder,)) if isinstance(holder, Object) else value


def made_by_base(cls: Class, given: Arguments, models: Models, *, above: bool = False) -> Value:
    """Return what the nearest class that is modelled among the bases makes, None when there is none."""
    for entry in list(lineage(cls))[1 if above else 0 :]:
        if isinstance(entry, Reference) and entry.last in models.calls:
            return models.calls[entry.last](given)
    return None


def is_substitution(cls: Class) -> bool:
    """Tell whether a class is a substitution of its own: its `perform` gives the text."""
    return any(isinstance(entry, Reference) and entry.last == "Substitution" for entry in lineage(cls))


def is_instance(value: Value, kinds: Value) -> Value:
    """Return what `isinstance` says of plain data, texts with substitutions and objects; Unknown for all else."""
    listed = kinds if isinstance(kinds, list | tuple) else (kinds,)
    names = {entry.last if isinstance(entry, Reference) else getattr(entry, "name", "") for entry in listed}
    if isinstance(value, Text):
        return not names <= _PLAIN
    if isinstance(value, Object):
        return any(
            (entry.last if isinstance(entry, Reference) else entry.name) in names for entry in lineage(value.cls)
        )
    if is_plain(value) or isinstance(value, list | tuple | dict):
        return any(isinstance(value, kind) for kind in _PLAIN_TYPES if kind.__name__ in names)
    return Unknown("isinstance")


def filled_fields(made: Object, given: Arguments) -> None:
    """Set the fields of a data class from what its constructor is given."""
    names = [name for entry in reversed(list(lineage(made.cls))) if isinstance(entry, Class) for name in entry.fields]
    made.attributes.update(zip(names, given.positional, strict=False))
    made.attributes.update(given.keywords)


def super_of(scope: Scope) -> Value:
    """Return what `super()` is inside a method."""
    holder, cls = scope.find("__holder__"), scope.find("__class__")
    return Super(holder, cls) if isinstance(cls, Class) else Reference("super")
