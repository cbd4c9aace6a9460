"""What a Python file runs of others by importing them: their bodies, each once."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

from ecm_extract.link.code.units import File, Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.owning.wrapper_scripts import runs_as_main

_BODY = "<module>"


class Imported:
    """Tells whose bodies run where a file is imported; one with parts that only a program runs is not told.

    Args:
        program: all that the tree declares.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        self._importing: dict[File, list[Func]] | None = None
        self._bodies: dict[Func, Sequence[Func]] = {}

    def bodies(self, func: Func) -> Sequence[Func]:
        """Return the bodies that the body of a file runs by what it imports."""
        if not _is_body(func):
            return ()
        known = self._bodies.get(func)
        if known is None:
            found = (body for file in self.program.imported_files(func.file) for body in _bodies(self.program, file))
            known = self._bodies[func] = [body for body in found if not runs_as_main(body)]
        return known

    def importers(self, func: Func) -> Sequence[Func]:
        """Return the bodies of the files that import the one whose body a function is."""
        if not _is_body(func) or runs_as_main(func):
            return ()
        if self._importing is None:
            self._importing = defaultdict(list)
            for file in self.program.files:
                for body in _bodies(self.program, file):
                    for other in self.program.imported_files(file):
                        self._importing[other].append(body)
        return self._importing.get(func.file, ())


def _is_body(func: Func) -> bool:
    return func.fact.name == _BODY and func.file.language == "python"


def _bodies(program: Program, file: File) -> Iterator[Func]:
    if file.language == "python":
        yield from (func for func in program.functions_in(file) if func.fact.name == _BODY)
