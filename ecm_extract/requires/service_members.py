"""Members of service requests and responses that source touches, where the type of the variable is known."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from ecm_parsers.source.expr import Call, Expr, Member
from ecm_parsers.source.facts import Function

from ecm_extract.link.code.full_names import full_name
from ecm_extract.link.code.units import File
from ecm_extract.link.code.walk import dotted, expressions
from ecm_extract.read.facts import PackageFacts

_CPP = re.compile(r"(?:^|[<\s(])(?:::)?(\w+)::(?:srv::)?(\w+)(?:::(Request|Response))?(?=$|[>&*\s:)])")
_PYTHON_PART = re.compile(r"(?P<name>.+?)\.?(?P<part>Request|Response)")
_GENERATED = ("Request", "Response", "Event", "request", "response")
Typed = tuple[str, str]
"""A service and `request`, `response`, or nothing for the ROS 1 object that holds both."""


@dataclass(frozen=True, slots=True)
class Touched:
    """A member of a request or response.

    Attributes:
        file, line: where. service: `package/srv/Name`. section: `request` or `response`. field: as written.
    """

    file: File
    line: int
    service: str
    section: str
    field: str


def touched_members(files: Sequence[File], packages: Sequence[PackageFacts]) -> Iterator[Touched]:
    """Yield members of variables whose service is in the tree; methods are left out."""
    services = {
        f"{package.name}/srv/{path.rpartition('/')[2].removesuffix('.srv')}"
        for package in packages
        for path, definition in package.interfaces.items()
        if definition.shape == "srv"
    }
    for file in files:
        if any(name.partition("/")[0] in str(entry.module) for entry in file.facts.imports for name in services):
            for function in file.facts.functions:
                yield from _of_function(file, function, services)


def _of_function(file: File, function: Function, services: set[str]) -> Iterator[Touched]:
    typed = _variables(file, function, services)
    for statement in function.body if typed else ():
        called = [expr.callee for expr, _ in expressions(statement) if isinstance(expr, Call)]
        for expr, line in expressions(statement):
            if not isinstance(expr, Member) or expr in called or expr.name.startswith("_"):
                continue
            owner = _owner(expr.base, typed)
            if owner is not None and owner[1] and expr.name not in _GENERATED:
                yield Touched(file, line, owner[0], owner[1], expr.name)


def _owner(base: Expr, typed: Mapping[str, Typed]) -> Typed | None:
    name = dotted(base)
    if name in typed:
        return typed[name or ""]
    if isinstance(base, Member) and base.name in {"request", "response"}:
        holder = typed.get(dotted(base.base) or "")
        return (holder[0], base.name) if holder is not None and not holder[1] else None
    return None


def _variables(file: File, function: Function, services: set[str]) -> dict[str, Typed]:
    """Types of parameters and variables; a name that is bound to several things has none."""
    found: dict[str, set[Typed | None]] = {}
    for parameter in function.params:
        found.setdefault(parameter.name, set()).add(_written(parameter.type, file, services))
    for statement in function.body:
        name = dotted(statement.target) if statement.target is not None and statement.kind != "do" else None
        if name is not None:
            stated = statement.type if statement.type and "auto" not in statement.type else ""
            kind = _written(stated, file, services) if stated else _made(statement.value, file, services)
            found.setdefault(name, set()).add(kind)
    return {name: kind for name, kinds in found.items() if len(kinds) == 1 and (kind := next(iter(kinds))) is not None}


def _made(expr: Expr | None, file: File, services: set[str]) -> Typed | None:
    if not isinstance(expr, Call):
        return None
    written = [*expr.types, dotted(expr.callee) or ""] if file.language == "cpp" else [dotted(expr.callee) or ""]
    return next((kind for text in written if (kind := _written(text, file, services)) is not None), None)


def _written(text: str, file: File, services: set[str]) -> Typed | None:
    if file.language == "python":
        return _python(text, file, services)
    match = _CPP.search(text)
    name = f"{match[1]}/srv/{match[2]}" if match is not None else ""
    if match is None or name not in services:
        return None
    return name, (match[3] or "").lower()


def _python(text: str, file: File, services: set[str]) -> Typed | None:
    match = _PYTHON_PART.fullmatch(full_name(text, file.imported) or text)
    name = match["name"].replace(".", "/") if match is not None else ""
    return (name, match["part"].lower()) if match is not None and name in services else None
