"""Parameters that programs read by name, whether or not they declare them."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.hub.requirement import Requirement
from ecm_parsers.source.expr import Text

from ecm_extract.link.code.calls import invocations
from ecm_extract.link.declaring.parameters import READERS
from ecm_extract.link.index.program import Program
from ecm_extract.requires.place import Place, required


def parameter_read_requirements(program: Program) -> Iterator[tuple[str, Requirement]]:
    """Yield package and requirement of each read of a parameter whose name is a literal."""
    for functions in program.functions.values():
        for func in functions:
            for call in invocations(func, READERS):
                name = call.args[0] if call.args else None
                if isinstance(name, Text) and name.value:
                    place = Place(func.file.path, call.line, f"file {func.file.path}")
                    package = func.file.package
                    yield package, required("reads_parameter", name.value, place, package=package)
