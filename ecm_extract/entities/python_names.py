"""Python modules of a package that lie where its own name finds them, and all names that each binds, private too."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Final

import msgspec
from ecm_checker.hub.provision import Provision
from ecm_parsers.cmake_facts import Command
from ecm_parsers.source.expr import Call, Expr, Name
from ecm_parsers.source.facts import Function, SourceFile

from ecm_extract.entities.paths import inside
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped

MODULE: Final = "python_module"
NAME: Final = "python_name"
_TOP: Final = "<module>"
_WRITES: Final = frozenset({"globals", "setattr"})


def python_names(facts: PackageFacts) -> Iterator[Provision]:
    """Yield the modules of a package, and the names that they bind; each name by the first line that does."""
    rows: dict[tuple[str, str], Provision] = {}
    for path, dotted in modules(facts).items():
        source = facts.sources[path]
        base = Provision(kind=MODULE, package=facts.name, owner="", name=dotted, path=path, line=1)
        yield msgspec.structs.replace(base, open=_is_open(source))
        parent, _, last = dotted.rpartition(".")
        named = msgspec.structs.replace(base, kind=NAME, owner=dotted)
        for name, line in (*_bound(source), *_built(facts, dotted)):
            rows.setdefault((dotted, name), msgspec.structs.replace(named, name=name, line=line))
        if parent:  # a package binds its modules
            rows.setdefault((parent, last), msgspec.structs.replace(named, owner=parent, name=last))
    yield from rows.values()
    yield from _namespaces(facts)


def _namespaces(facts: PackageFacts) -> Iterator[Provision]:
    """Folders of modules without an `__init__.py`: Python 3 imports them all the same."""
    found = modules(facts)
    dotted, told = frozenset(found.values()), set[str]()
    for path, name in found.items():
        parts = name.split(".")
        for end in range(2, len(parts)):
            inner = ".".join(parts[:end])
            if inner not in dotted | told:
                told.add(inner)
                row = Provision(kind=MODULE, package=facts.name, owner="", name=inner, path=path, line=1, open=True)
                yield row
                parent, _, last = inner.rpartition(".")
                yield msgspec.structs.replace(row, kind=NAME, owner=parent, name=last, open=False)


def modules(facts: PackageFacts) -> dict[str, str]:
    """Return modules by path: `src/pkg/a.py` and `pkg/a.py` of package `pkg` are `pkg.a`."""
    paths = (path for path, source in facts.sources.items() if source.language == "python" and path.endswith(".py"))
    found = {path: inside(path, facts.root.path).removesuffix(".py").removeprefix("src/") for path in paths}
    return {
        path: name.removesuffix("/__init__").replace("/", ".")
        for path, name in found.items()
        if name.partition("/")[0] == facts.name
    }


def makes_modules(facts: PackageFacts) -> bool:
    """Tell whether the build of a package may add modules to it."""
    set_up = any(setup.makes_modules for setup in facts.setups.values())
    return set_up or any(_is_of_modules(command) for file in facts.cmake.values() for command in file.commands)


def _is_of_modules(command: Command) -> bool:
    words = [word.lower() for word in (command.name, *command.args)]
    return "MODULE" in command.args or any(part in word for word in words for part in _builders())


@cache
def _builders() -> tuple[str, ...]:
    return tuple(shipped("entities/module_builders.toml")["parts"])


def _built(facts: PackageFacts, dotted: str) -> Iterator[tuple[str, int]]:
    """Libraries that a package builds: one of them may be an extension module."""
    targets = (target for file in facts.cmake.values() for target in file.targets if target.kind == "library")
    yield from ((target.output or target.name, 1) for target in targets if dotted == facts.name)


def _is_open(source: SourceFile) -> bool:
    """Tell whether a module binds what it likes: with a star, by `__getattr__`, or by writing into `globals()`."""
    names = {function.name for function in source.functions}
    values = (statement.value for function in source.functions for statement in function.body)
    stars = any(entry.name == "*" for entry in source.imports)
    return stars or "__getattr__" in names or any(_called(value) in _WRITES for value in values)


def _called(value: Expr | None) -> str:
    return value.callee.id if isinstance(value, Call) and isinstance(value.callee, Name) else ""


def _bound(source: SourceFile) -> Iterator[tuple[str, int]]:
    yield from ((each.name, each.line) for each in source.functions if not each.scope)
    for rows in (source.classes, source.constants, source.aliases):
        yield from ((each.name, each.line) for each in rows)
    for entry in source.imports:
        yield entry.alias or entry.name or entry.module.split(".")[0], entry.line
    for function in source.functions:
        if function.name == _TOP:
            yield from _assigned(function)


def _assigned(function: Function) -> Iterator[tuple[str, int]]:
    for statement in function.body:
        yield from ((name, statement.line) for name in targets(statement.target))


def targets(target: Expr | None) -> Iterator[str]:
    """Yield the names that an assignment binds."""
    if isinstance(target, Name):
        yield target.id
    for item in getattr(target, "items", ()):
        yield from targets(item)
