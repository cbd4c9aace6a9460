"""Python modules that C++ is compiled to, with the names that its bindings may give them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

from ecm_parsers.source.expr import Expr, Text
from ecm_parsers.source.facts import SourceFile

from ecm_extract.entities.public_files import stub_modules
from ecm_extract.link.code.walk import children
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped

_TABLE: Final = "entities/module_builders.toml"


def compiled_names(facts: PackageFacts) -> Iterator[str]:
    """Yield the dotted names of compiled modules and of what they hold, of which their bindings tell the name.

    A module without a stub lies in the package of its ROS package.
    """
    stubs = tuple(stub_modules(facts))
    yield from stubs
    sources = [source for source in facts.sources.values() if source.language == "cpp"]
    made = sorted({name for source in sources for name in _modules(source)})
    given = sorted({text for source in sources if _binds(source) for text in _names(source)}) if made else ()
    for name in made:
        for module in {f"{facts.name}.{name}", *(stub for stub in stubs if stub.rpartition(".")[2] == name)}:
            yield module
            yield from (f"{module}.{each}" for each in given)


def _modules(source: SourceFile) -> Iterator[str]:
    """Names of the modules that a source begins: `PYBIND11_MODULE(arm, m) { .. }`, which reads like a function."""
    for function in source.functions:
        if function.name in shipped(_TABLE)["macros"] and function.params:
            yield function.params[0].type


def _binds(source: SourceFile) -> bool:
    """Whether a source may take part in bindings: it includes a header of a library for them."""
    return any(part in entry.module for entry in source.imports for part in shipped(_TABLE)["headers"])


def _names(source: SourceFile) -> Iterator[str]:
    for function in source.functions:
        for statement in function.body:
            yield from (text for text in _texts((statement.value, statement.target)) if text.isidentifier())


def _texts(expressions: Iterable[Expr | None]) -> Iterator[str]:
    for expr in expressions:
        if isinstance(expr, Text):
            yield expr.value
        elif expr is not None:
            yield from _texts(children(expr))
