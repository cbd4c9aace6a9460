"""Classes, methods, functions and constants of importable Python modules."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

import msgspec
from ecm_checker.hub.provision import Provision
from ecm_parsers.source.expr import Call, Constant, Expr, Name, Number, Op, Text
from ecm_parsers.source.facts import Function, SourceFile
from ecm_parsers.source.flow import Block, Branch, blocks, statements

from ecm_extract.entities.compiled_modules import compiled_names
from ecm_extract.entities.public_files import program_modules, python_modules
from ecm_extract.entities.python_bases import Module, class_meant
from ecm_extract.entities.signatures import form_of
from ecm_extract.link.code.tuples import returned_values
from ecm_extract.link.code.walk import children
from ecm_extract.link.code.walk import dotted as dotted_name
from ecm_extract.read.facts import PackageFacts

_LABEL: Final = re.compile(r"[A-Z][A-Z0-9_]+")
"""How values of an enum are written, and other constants of a class."""
_MODULE: Final = "<module>"
_WARN: Final = frozenset({"warnings.warn", "warn"})


def python_entities(facts: PackageFacts) -> Iterator[Provision]:
    """Yield what can be imported from a package; a name with a leading underscore is private."""
    found = {dotted: _module(facts, path, dotted) for path, dotted in python_modules(facts).items()}
    for path, dotted in python_modules(facts).items():
        yield Provision(kind="file", package=facts.name, owner="", name=dotted, path=path, line=1)
        for entity in _symbols(facts.name, path, dotted, facts.sources[path]):
            bases = tuple(class_meant(base, found[dotted], found) for base in entity.bases)
            yield entity if bases == entity.bases else msgspec.structs.replace(entity, bases=bases)


def _module(facts: PackageFacts, path: str, dotted: str) -> Module:
    return Module(dotted, path.endswith("/__init__.py"), facts.sources[path])


def bound_names(facts: PackageFacts) -> Iterator[str]:
    """Yield what modules offer without declaring it: names that they import (`from .node import Node`) or assign.

    So are compiled modules, and those that programs are.
    """
    yield from compiled_names(facts)
    for path, dotted in program_modules(facts).items():
        yield dotted
        yield from (each.name for each in _symbols(facts.name, path, dotted, facts.sources[path]) if not each.row.part)
    for path, dotted in python_modules(facts).items():
        source = facts.sources[path]
        for entry in source.imports:
            name = entry.alias or entry.name
            if name and name != "*":
                yield f"{dotted}.{name}"
        yield from (f"{dotted}.{entry.name}" for entry in source.constants if not entry.scope)


def quoted_names(facts: PackageFacts) -> Iterator[str]:
    """Yield names that a module gives by text where it calls something: `@aliases(('OLD', 'NEW'))` sets attributes."""
    for path, dotted in python_modules(facts).items():
        for function in facts.sources[path].functions:
            for statement in function.body if function.name == _MODULE else ():
                for text in _texts(statement.value) if isinstance(statement.value, Call) else ():
                    if text.value.isidentifier():
                        yield f"{dotted}.{text.value}"


def _symbols(package: str, path: str, dotted: str, source: SourceFile) -> Iterator[Provision]:
    classes = {f"{entry.scope}::{entry.name}".lstrip(":") for entry in source.classes}
    for entry in source.classes:
        if not entry.scope and not entry.name.startswith("_"):
            name = f"{dotted}.{entry.name}"
            yield Provision(
                kind="class",
                package=package,
                owner="",
                name=name,
                bases=entry.bases,
                path=path,
                line=entry.line,
                open="remade" in entry.traits,
            )
    for function in source.functions:
        if not _is_private(function):
            yield from _function(package, path, dotted, function, classes)
    public = {name for name in classes if not any(part.startswith("_") for part in name.split("::"))}
    for constant in source.constants:
        owner = f"{dotted}.{constant.scope.replace('::', '.')}" if constant.scope else dotted
        label = constant.scope in public and _LABEL.fullmatch(constant.name) is not None
        if label or (not constant.scope and not constant.name.startswith("_")):
            value = constant.value.value if isinstance(constant.value, Number | Text) else None
            yield Provision(
                kind="constant",
                package=package,
                owner=owner,
                name=constant.name,
                default=value,
                path=path,
                line=constant.line,
            )


def _warning(function: Function) -> str | None:
    """What a function warns of whenever it is called, when that is its own end."""
    for statement in function.body:
        call = statement.value
        if statement.depth == 0 and isinstance(call, Call) and dotted_name(call.callee) in _WARN:
            text = "".join(part.value for arg in call.args[:1] for part in _texts(arg))
            if "deprecat" in text.lower() and function.name.strip("_") in {*re.findall(r"\w+", text), "init"}:
                return text
    return None


def advised(function: Function) -> tuple[str, ...]:
    """Return the optional parameters that a function warns of when they are left out: `if size is None: warn(..)`."""
    optional = {entry.name for entry in function.params if _is_none(entry.default)}
    found = [name for name in _warned(function, function.flow) if name in optional]
    return tuple(dict.fromkeys(found))


def _warned(function: Function, block: Block) -> Iterator[str]:
    """Yield the names of which a block that runs for None alone warns."""
    for step in block:
        if isinstance(step, Branch):
            without = step.then if _tested(step.test, "==") else step.other
            name = _tested(step.test, "==") or _tested(step.test, "!=")
            if name and any(_is_warning(function.body[at].value) for at in statements(without)):
                yield name
        for inner in blocks(step):
            yield from _warned(function, inner)


def _tested(value: Expr | None, comparison: str) -> str:
    """The name that is compared with None; empty for any other expression."""
    if isinstance(value, Op) and value.op == comparison and isinstance(value.operands[0], Name):
        return value.operands[0].id if _is_none(value.operands[1]) else ""
    return ""


def _is_none(value: Expr | None) -> bool:
    return isinstance(value, Constant) and value.name == "null"


def _is_warning(value: Expr | None) -> bool:
    return isinstance(value, Call) and dotted_name(value.callee) in _WARN


def _texts(expr: Expr) -> Iterator[Text]:
    if isinstance(expr, Text):
        yield expr
    for child in children(expr):
        yield from _texts(child)


def _is_private(function: Function) -> bool:
    parts = [*function.scope.split("::"), function.name]
    own = function.name == "__init__"
    return any(part.startswith(("_", "<")) for part in parts if not (own and part == "__init__"))


def _function(package: str, path: str, dotted: str, function: Function, classes: set[str]) -> Iterator[Provision]:
    is_method = function.scope in classes
    if function.scope and not is_method:
        return
    form = form_of(function, virtual=False)
    values = returned_values(function)
    returns = f"{values} value{'s'[: values - 1]}" if values is not None else ""
    # annotations bind nobody: only the names and the number of parameters count, and how many values are unpacked
    form = msgspec.structs.replace(form, types=("",) * len(form.names), returns=returns)
    yield Provision(
        kind="method" if is_method else "function",
        package=package,
        owner=f"{dotted}.{function.scope.replace('::', '.')}" if is_method else "",
        name=function.name if is_method else f"{dotted}.{function.name}",
        forms=(form,),
        deprecated="marked deprecated" if form.deprecated else _warning(function),
        advised=advised(function),
        path=path,
        line=function.line,
    )
