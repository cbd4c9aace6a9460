"""Python: fields of messages that a file reads, writes, fills or names."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import msgspec
from ecm_checker.hub.requirement import Requirement
from ecm_parsers.source.expr import Call, Expr, Member
from ecm_parsers.source.facts import Function

from ecm_extract.link.code.full_names import full_name
from ecm_extract.link.code.units import File
from ecm_extract.link.code.walk import dotted, expressions
from ecm_extract.requires.place import Place, required

_SHAPES: Final = frozenset({"msg", "srv", "action"})


class _Touched(msgspec.Struct, frozen=True):
    owner: str
    name: str
    verb: str
    line: int


def field_requirements(file: File) -> Iterator[Requirement]:
    """Yield what a Python file requires of the messages that it imports, each line and field once."""
    if not any(_is_message(target) for target in file.imported.values()):
        return
    for function in file.facts.functions:
        seen: dict[tuple[str, int], _Touched] = {}
        for touched in _Reader(file, function).touched():
            seen.setdefault((touched.name, touched.line), touched)
        for touched in seen.values():
            place = Place(file.path, touched.line, f"file {file.path}")
            yield required("reads_field", touched.name, place, owner=touched.owner, said=touched.verb)


def _is_message(dotted_name: str) -> bool:
    return not _SHAPES.isdisjoint(dotted_name.split(".")[1:])


class _Reader:
    """One function with the message types of its variables."""

    def __init__(self, file: File, function: Function) -> None:
        self._file, self._function = file, function
        self._variables: dict[str, str] = {}
        for parameter in function.params:
            self._bind(parameter.name, self._written(parameter.type))
        for statement in function.body:
            target = dotted(statement.target) if statement.target is not None else None
            if target is not None:
                self._bind(target, self._written(statement.type) or self._made(statement.value))

    def _bind(self, name: str, found: str) -> None:
        if found:
            self._variables[name] = found

    def _made(self, expr: Expr | None) -> str:
        """The type of a construction: `Spin.Goal()`."""
        return self._written(dotted(expr.callee) or "") if isinstance(expr, Call) else ""

    def _written(self, text: str) -> str:
        """`pkg.msg.T` or `pkg.srv.T.Request` for a type as written; empty for what is no message."""
        full = full_name(text, self._file.imported)
        return full if _is_message(full) and full.rpartition(".")[2][:1].isupper() else ""

    def touched(self) -> Iterator[_Touched]:
        """Yield the fields that the body touches, in its order."""
        for statement in self._function.body:
            for expr, line in expressions(statement):
                yield from self._of(expr, line)

    def _of(self, expr: Expr, line: int) -> Iterator[_Touched]:
        if isinstance(expr, Member):
            base = dotted(expr.base) or ""
            if base in self._variables:
                yield _Touched(self._variables[base], expr.name, "reads or writes", line)
            elif self._written(base):
                yield _Touched(self._written(base), expr.name, "names", line)
        elif isinstance(expr, Call) and expr.keywords:
            made = self._made(expr)
            for name, _ in expr.keywords if made else ():
                yield _Touched(made, name, "fills", line)
