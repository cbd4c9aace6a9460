"""Python: names that it imports, attributes of modules, arguments that calls give by name, results that it takes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.hub.requirement import ONE_VALUE, Given, Requirement
from ecm_parsers.source.expr import Call, Expr, Member, Name, Op
from ecm_parsers.source.facts import Function, Import, Statement

from ecm_extract.link.code.full_names import full_name
from ecm_extract.link.code.tuples import count_of
from ecm_extract.link.code.units import File
from ecm_extract.link.code.walk import dotted, expressions
from ecm_extract.requires.place import Place, required

SPREAD: Final = "**"
"""Stands for the name of arguments that a mapping gives."""


def python_requirements(file: File) -> Iterator[Requirement]:
    """Yield what a Python file requires of modules that it imports; what it says twice in a line, it requires once."""
    yield from import_requirements(file)
    if not file.imported:
        return
    seen: set[tuple[str, str, str, int]] = set()
    for function in file.facts.functions:
        parted = _taken_apart(function)
        for statement in function.body:
            for found in _of_statement(file, statement, parted):
                mark = (found.use, found.name, found.said, found.evidence[0].line)
                if mark not in seen:
                    seen.add(mark)
                    yield found


def import_requirements(file: File) -> Iterator[Requirement]:
    """Yield what the imports of a Python file require."""
    for entry in file.facts.imports:
        yield from _of_import(entry, file)


def _place(file: File, line: int) -> Place:
    return Place(file.path, line, f"file {file.path}")


def _of_import(entry: Import, file: File) -> Iterator[Requirement]:
    name = absolute(entry, file)
    said = f"{entry.name} from {entry.module}" if entry.name else entry.module
    yield required("imports", name, _place(file, entry.line), said=said)


def absolute(entry: Import, file: File) -> str:
    """Return the dotted name that an import binds; a leading dot stands for the file's own folder."""
    module = entry.module
    if module.startswith("."):
        folders = file.path.split("/")[:-1]
        module = f"{folders[-1] if folders else ''}.{module.lstrip('.')}".strip(".")
    return f"{module}.{entry.name}" if entry.name else module


def _of_statement(file: File, statement: Statement, parted: frozenset[str]) -> Iterator[Requirement]:
    for expr, line in expressions(statement):
        yield from _attribute(file, expr, line)
        if isinstance(expr, Call):
            yield from _keywords(file, expr, line)
            yield from _call(file, expr, line)
    yield from _result(file, statement, parted)


def _attribute(file: File, expr: Expr, line: int) -> Iterator[Requirement]:
    """`module.name` of a module that the file imports."""
    written = dotted(expr) if isinstance(expr, Member) else None
    if written is None:
        return
    full = full_name(written, file.imported)
    if full:
        yield required("uses_name", full, _place(file, line), said=written)


def _keywords(file: File, call: Call, line: int) -> Iterator[Requirement]:
    full = full_name(dotted(call.callee) or "", file.imported)
    if full:
        for (word, _), at in zip(call.keywords, call.keyword_lines, strict=True):
            if word != SPREAD:
                yield required("gives_keyword", full, _place(file, at), said=word, given=Given(names=(word,)))


def _call(file: File, call: Call, line: int) -> Iterator[Requirement]:
    """A call by an imported name with arguments that can be told: `**rest` may give any."""
    full = full_name(dotted(call.callee) or "", file.imported)
    names = tuple(word for word, _ in call.keywords)
    if full and SPREAD not in names:
        given = Given(count=len(call.args), names=names)
        yield required("calls", full, _place(file, line), "likely", given=given)


def _result(file: File, statement: Statement, parted: frozenset[str]) -> Iterator[Requirement]:
    """How many values a line takes from a call; methods are known by their name alone."""
    call = statement.value
    if statement.kind != "set" or not isinstance(call, Call):
        return
    takes = _taken(statement.target, parted)
    written = dotted(call.callee) or ""
    full = full_name(written, file.imported)
    last = call.callee.name if isinstance(call.callee, Member) else ""
    if takes and (full or last):
        said = f"{takes} from {written or last}()"
        given = Given(takes=takes)
        place = _place(file, statement.line)
        yield required("takes_result", full or last, place, "proved" if full else "likely", said=said, given=given)


def _taken(target: Expr | None, parted: frozenset[str]) -> str:
    """How many values a line takes, as a form tells what it returns; empty where that cannot be told."""
    count = count_of(target)
    if count is not None:
        return f"{count} values"
    return ONE_VALUE if isinstance(target, Name) and target.id not in parted else ""


def _taken_apart(function: Function) -> frozenset[str]:
    """Variables of which a function takes elements, or that it unpacks."""
    found: set[str] = set()
    for statement in function.body:
        if isinstance(statement.value, Name) and count_of(statement.target) is not None:
            found.add(statement.value.id)
        for part, _ in expressions(statement):
            if isinstance(part, Op) and part.op == "[]" and isinstance(part.operands[0], Name):
                found.add(part.operands[0].id)
    return frozenset(found)
