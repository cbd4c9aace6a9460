"""Private names of Python: `self.__name` within a class `Part` is `self._Part__name`, which no other class has.

Source: Python language reference, "Identifiers (Names)", "Private name mangling".
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeVar

from msgspec.structs import replace

from ecm_parsers.source.expr import Expr, Member, Name
from ecm_parsers.source.facts import Class, Constant, Field, Function, SourceFile, Statement
from ecm_parsers.source.rewriting import rewritten

Part = TypeVar("Part")


def is_private(name: str) -> bool:
    """Tell whether a name means another one in each class."""
    return name.startswith("__") and not name.endswith("__")


def with_private_names(file: SourceFile) -> SourceFile:
    """Return the facts of a file with what its private names mean."""
    owners = {f"{each.scope}::{each.name}".removeprefix("::"): each.name.lstrip("_") for each in file.classes}
    return replace(
        file,
        classes=tuple([_class(each) for each in file.classes]),
        functions=tuple([_function(each, owners, file.classes) for each in file.functions]),
        constants=tuple([_constant(each, owners) for each in file.constants]),
    )


def _class(cls: Class) -> Class:
    own = cls.name.lstrip("_")
    return replace(cls, fields=tuple([_field(each, own) for each in cls.fields]))


def _field(field: Field, owner: str) -> Field:
    return replace(_within(field, owner), name=_meant(field.name, owner))


def _constant(constant: Constant, owners: Mapping[str, str]) -> Constant:
    owner = owners.get(constant.scope, "")
    return replace(_within(constant, owner), name=_meant(constant.name, owner))


def _function(function: Function, owners: Mapping[str, str], classes: Sequence[Class]) -> Function:
    if function.name == "<module>":
        return replace(function, body=tuple([_statement(each, classes) for each in function.body]))
    owner = _around(function.scope, owners)
    params = tuple([replace(each, name=_meant(each.name, owner)) for each in function.params])
    shared = tuple([_meant(each, owner) for each in function.shared])
    named = replace(function, name=_meant(function.name, owner), params=params, shared=shared)
    return _within(named, owner)


def _statement(statement: Statement, classes: Sequence[Class]) -> Statement:
    """A statement of a module, or of the body of a class."""
    around = [each for each in classes if each.line <= statement.line <= each.end_line]
    return _within(statement, max(around, key=lambda each: each.line).name.lstrip("_")) if around else statement


def _around(scope: str, owners: Mapping[str, str]) -> str:
    """The name of the innermost class that a scope is in."""
    while scope and scope not in owners:
        scope = scope.rpartition("::")[0]
    return owners.get(scope, "")


def _meant(name: str, owner: str) -> str:
    return f"_{owner}{name}" if owner and is_private(name) else name


def _within(part: Part, owner: str) -> Part:
    """A fact with the names that its expressions have in a class."""

    def change(each: object) -> Expr | None:
        if isinstance(each, Name) and is_private(each.id):
            return Name(_meant(each.id, owner))
        if isinstance(each, Member) and is_private(each.name):
            return Member(rewritten(each.base, change), _meant(each.name, owner))
        return None

    changed: Part = rewritten(part, change) if owner else part
    return changed
