"""Which classes and functions of a package name a type: in members, declarations and what they make."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.spelling import last_name, plain, pointee, template_arguments
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.index.program import Program, imported_names
from ecm_extract.link.owning.references import Unit

MAX_ALIASES = 8
"""Aliases of aliases that are followed."""
_SERVER = "dynamic_reconfigure.server.Server"
_NAMESPACE = 2
"""Position of the namespace in `Server(config, callback, namespace)` of Python."""


class MentionedTypes:
    """The types that units name, by package."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._texts: dict[str, list[tuple[Unit, str]]] = {}

    def units(self, marks: tuple[str, ...], files: Sequence[File]) -> list[Unit]:
        """Return the units of a package that name a type with one of some marks in it; `>` ends each type."""
        found: dict[Unit, None] = {}
        for unit, text in self._typed_units(files):
            if any(mark in text for mark in marks):
                found[unit] = None
        return list(found)

    def servers(self, config: str, files: Sequence[File]) -> list[Unit]:
        """Return the units of a package that name a server of dynamic_reconfigure for the class of a configuration."""
        return list(dict.fromkeys(unit for unit, text in self._typed_units(files) if config in _served(text)))

    def _typed_units(self, files: Sequence[File]) -> list[tuple[Unit, str]]:
        """Return the classes and functions of a package, each with the types that it names as one text."""
        package = files[0].package if files else ""
        known = self._texts.get(package)
        if known is None:
            classes = (cls for file in files for cls in self.program.classes_in(file))
            functions = (func for file in files for func in self.program.functions_in(file))
            known = [(cls, " ".join(f"{written}>" for written in self._members(cls))) for cls in classes]
            known += [(func.holder or func, "> ".join(self._types_in(func)) + ">") for func in functions]
            self._texts[package] = known
        return known

    def _members(self, cls: Cls) -> Iterator[str]:
        """The types of members, as written and as they are behind aliases."""
        scope = f"{cls.fact.scope}::{cls.fact.name}".removeprefix("::")
        for entry in cls.fact.fields:
            yield entry.type
            yield self._spelled_out(pointee(entry.type), cls.file, scope, MAX_ALIASES)

    def _types_in(self, func: Func) -> Iterator[str]:
        """The types of variables and of what is made, as written and as they are behind aliases."""
        python = func.file.language == "python"
        imported = imported_names(func.file) if python else {}
        written = [statement.type for statement in func.fact.body if statement.type]
        for call in (call for calls in func.calls for call in calls):
            yield from call.types
            yield from _named_by(call, imported)
            written += [] if python else [_made_by(call)]
        for entry in filter(None, written):
            yield entry
            yield self._spelled_out(pointee(entry), func.file, func.scope, MAX_ALIASES)

    def _spelled_out(self, written: str, file: File, scope: str, depth: int) -> str:
        """A type with what aliases stand for, in its template arguments too."""
        target = self.program.alias(plain(written), file, scope) if depth else None
        if target is not None and target != written:
            return self._spelled_out(target, file, scope, depth - 1)
        inner = [self._spelled_out(entry, file, scope, depth - 1) for entry in template_arguments(written) if depth]
        return f"{plain(written)}<{', '.join(inner)}>" if inner else written


def _named_by(call: Call, imported: Mapping[str, str]) -> Iterator[str]:
    """The function that a call names, and the type that a Python server of parameters is given."""
    path = _path(call.callee)
    yield from (path,) if path else ()
    if path and _imported(path, imported) == _SERVER and _is_of_node(call) and call.args:
        yield f"Server<{_imported(_path(call.args[0]), imported)}"


def _made_by(call: Call) -> str:
    """The class that a call of C++ makes an object of, if it does: `Server<Config>(lock, handle)`."""
    path = _path(call.callee)
    return f"{path}<{', '.join(call.types)}>" if path and call.types else path


def _served(text: str) -> frozenset[str]:
    """The configurations that a text of types has servers for."""
    given = (piece.partition(">")[0] for piece in text.split("Server<")[1:])
    return frozenset(last_name(entry.strip()) for entry in given)


def _is_of_node(call: Call) -> bool:
    """Tell whether a server offers the node's own parameters: one with a namespace offers others."""
    return len(call.args) <= _NAMESPACE and all(name != "namespace" for name, _ in call.keywords)


def _path(expr: Expr) -> str:
    if isinstance(expr, Name):
        return expr.id
    return dotted_name(expr) if isinstance(expr, Member) else ""


def _imported(path: str, imported: Mapping[str, str]) -> str:
    """A dotted path with what its first name was imported as."""
    head, dot, rest = path.partition(".")
    return imported.get(head, head) + dot + rest
