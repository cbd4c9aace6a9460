"""Types of fields of messages: of those that the tree defines, and of common ones of which it has no source."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import PurePosixPath
from typing import Final

from ecm_parsers.interface_facts import PRIMITIVES, Definition, Field, Section
from ecm_parsers.source.expr import Expr, Member

from ecm_extract.link.code.spelling import plain, pointee
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped

_Fields = Mapping[str, Mapping[str, str | Mapping[str, str]]]
_KNOWN: Final[_Fields] = shipped("link/interfaces/message_fields.toml")
_OTHERS: Final = {"bool": "bool", "float32": "float", "float64": "double", "string": "std::string"}
_IN_CPP: Final = {base: _OTHERS.get(base, f"{base}_t") for base in PRIMITIVES}
"""Primitive types of fields as C++ has them; those of single bytes and wide texts are no types of parameters."""


class MessageFields:
    """Tells the type of a field as C++ declares it.

    Args:
        folder: knows what variables are.
        packages: those that define messages, services and actions.
    """

    def __init__(self, folder: Folder, packages: Sequence[PackageFacts]) -> None:
        self.folder = folder
        self._fields: _Fields = {**_KNOWN, **dict(_defined(packages))}

    def written_type(self, expr: Expr, env: Env) -> str:
        """Return the type of a variable, or of a field of a message that it is, as written, or nothing."""
        written = self.folder.objects.type_of(expr, env)
        if written or not isinstance(expr, Member):
            return written
        message = self._meant(self.written_type(expr.base, env), env)
        found = self._fields.get(message, {}).get(expr.name, "")
        return found if isinstance(found, str) else found.get(str(env.func.file.ros), "")

    def has(self, written: str, env: Env) -> bool:
        """Tell whether a type as written is a message of which the fields are known."""
        return self._meant(written, env) in self._fields

    def _meant(self, written: str, env: Env) -> str:
        """The message that a type as written means, without the namespace of its kind."""
        message = plain(pointee(written))
        meant = plain(self.folder.program.alias(message, env.func.file, env.scope) or message)
        for shape in ("::msg::", "::srv::", "::action::"):
            meant = meant.replace(shape, "::")
        return meant


def _defined(packages: Sequence[PackageFacts]) -> Iterator[tuple[str, Mapping[str, str]]]:
    """Yield the classes of what packages define, with their fields: `demo::Add::Request`, and `demo::AddRequest`."""
    for package in packages:
        for path, definition in package.interfaces.items():
            whole = f"{package.name}::{PurePosixPath(path).stem}"
            for section in definition.sections:
                fields = {field.name: _in_cpp(field, package.name) for field in section.fields}
                yield from ((name, fields) for name in _classes(whole, definition, section))


def _classes(whole: str, definition: Definition, section: Section) -> tuple[str, ...]:
    part = section.name.capitalize()
    return (whole,) if definition.shape == "msg" else (f"{whole}::{part}", f"{whole}{part}")


def _in_cpp(field: Field, package: str) -> str:
    own = _IN_CPP.get(field.base) if field.package is None else None
    one = own or f"{field.package or package}::{field.base}"
    return one if field.array == "none" else f"std::vector<{one}>"
