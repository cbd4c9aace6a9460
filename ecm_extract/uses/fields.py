"""Reads, writes and keywords of message fields that are gone or have another type."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from ecm_parsers.source.expr import Call, Expr, Member, Name
from ecm_parsers.source.facts import Function

from ecm_extract.diff.model import Located
from ecm_extract.entities.side import Workspace
from ecm_extract.link.units import File
from ecm_extract.link.walk import dotted, expressions
from ecm_extract.uses.index import ChangeIndex
from ecm_extract.uses.model import Place, Use, use_at

_CPP = re.compile(r"(?:(\w+)::)?(?:(msg|srv|action)::)?(\w+)(?:::(Goal|Result|Feedback|Request|Response))?\b")
_POINTER = re.compile(
    r"::(?:Const)?(?:SharedPtr|Ptr|UniquePtr|ConstPtr|ConstSharedPtr)\b|std::shared_ptr<|[<>&*]|\bconst\b"
)
_CONCERNED = frozenset({"removed", "renamed", "type_changed", "deprecated"})
Fields = Mapping[tuple[str, str], Located]


def field_uses(workspace: Workspace, index: ChangeIndex) -> Iterator[Use]:
    """Yield the lines that touch a changed field of a variable whose message type is known."""
    fields: dict[tuple[str, str], Located] = {}
    for kind in ("message_field", "constant"):
        for located in index.of_kind(kind):
            entity = located.pair.old
            if entity is not None and "/" in entity.owner and located.change.change in _CONCERNED:
                section, _, own = entity.name.rpartition(".")
                fields[f"{entity.owner}#{section}", own] = located
    if not fields:
        return
    names = {own for _, own in fields}
    types = {owner.partition("#")[0] for owner, _ in fields}
    for file in workspace.program.files:
        if _mentions(file, types):
            for function in file.facts.functions:
                yield from _Reader(file, function, types, workspace).uses(fields, names)


def _mentions(file: File, types: set[str]) -> bool:
    """Whether a file imports or includes anything of a package whose types changed."""
    packages = {name.partition("/")[0] for name in types}
    return any(entry.module.replace(".", "/").split("/")[0] in packages for entry in file.facts.imports) or any(
        file.package == package for package in packages
    )


class _Reader:
    """One function with the message types of its variables."""

    def __init__(self, file: File, function: Function, types: set[str], workspace: Workspace) -> None:
        self.file, self.function, self.types = file, function, types
        self.variables: dict[str, str] = {}
        for parameter in function.params:
            self._bind(parameter.name, self._written(parameter.type))
        for statement in function.body:
            target = dotted(statement.target) if statement.target is not None else None
            if target is None:
                continue
            found = self._written(statement.type) if statement.type else None
            self._bind(target, found or self._made(statement.value))

    def _bind(self, name: str, found: str | None) -> None:
        if found is not None:
            self.variables[name] = found

    def _made(self, expr: Expr | None) -> str | None:
        """The type of a construction: `Spin.Goal()`, `std::make_shared<...>()`, `pkg::msg::T()`."""
        if not isinstance(expr, Call):
            return None
        for written in (*expr.types, dotted(expr.callee) or ""):
            found = self._written(written)
            if found is not None:
                return found
        return None

    def _written(self, text: str) -> str | None:
        """Return `package/shape/Name#section` for a type as written; None for what is no changed type."""
        if not text:
            return None
        if self.file.language == "python":
            head, _, rest = text.partition(".")
            full = self.file.imported.get(head, head) + (f".{rest}" if rest else "")
            return self._known(full.split("."))
        bare = _POINTER.sub("", text).strip()
        return self._known(bare.split("::"))

    def _known(self, parts: list[str]) -> str | None:
        section = ""
        if parts[-1] in {"Goal", "Result", "Feedback", "Request", "Response"}:
            section = parts.pop().lower()
        if len(parts) >= 3:
            names = ["/".join(parts[-3:])]
        else:
            names = [f"{parts[0]}/{shape}/{parts[-1]}" for shape in ("msg", "srv", "action")] if len(parts) == 2 else []
        for name in names:
            if name in self.types:
                return f"{name}#{section}"
            for mark in ("Request", "Response", "Goal", "Result", "Feedback"):
                if name.endswith(mark) and name.removesuffix(mark) in self.types:
                    return f"{name.removesuffix(mark)}#{mark.lower()}"
        return None

    def uses(self, fields: Fields, names: set[str]) -> Iterator[Use]:
        """Yield the uses in the body, each line and field once."""
        seen: set[tuple[str, int]] = set()
        for statement in self.function.body:
            for expr, line in expressions(statement):
                for owner, own, verb in self._touched(expr, names):
                    located = fields.get((owner, own))
                    if located is not None and (own, line) not in seen:
                        seen.add((own, line))
                        place = Place(self.file.package, self.file.path, line)
                        gone = located.change.change != "type_changed"
                        yield use_at(located, place, f"{verb} {own}", "proved" if gone else "likely")

    def _touched(self, expr: Expr, names: set[str]) -> Iterator[tuple[str, str, str]]:
        if isinstance(expr, Member) and expr.name in names:
            base = dotted(expr.base)
            if base in self.variables:
                yield self.variables[base or ""], expr.name, "reads or writes"
            else:
                found = self._written(base) if base else None
                if found is not None:
                    yield found, expr.name, "names"
        elif isinstance(expr, Call) and expr.keywords:
            made = self._made(expr)
            if made is not None:
                yield from ((made, name, "fills") for name, _ in expr.keywords if name in names)
        elif isinstance(expr, Name) and "::" in expr.id:
            owner, _, own = expr.id.rpartition("::")
            found = self._written(owner) if own in names else None
            if found is not None:
                yield found, own, "names"
