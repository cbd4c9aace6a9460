"""Scripts that only start the main function of a module: they are the program, the module is what it runs."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_extract.link.code.calls import invocations
from ecm_extract.link.code.units import File, Func
from ecm_extract.link.index.program import Program

_MAIN = "main"


class Wrapped:
    """Tells which main functions of Python are started by the scripts of a tree."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._functions: frozenset[Func] | None = None

    def by_script(self, func: Func) -> bool:
        """Tell whether only another file starts a main function: its own is no script."""
        if func.file.language != "python" or _is_script(func.file, self.program):
            return False
        return func in self._started()

    def _started(self) -> frozenset[Func]:
        """The main functions of modules that scripts call."""
        if self._functions is None:
            scripts = [file for file in self.program.files if _is_script(file, self.program)]
            self._functions = frozenset(func for file in scripts for func in self._called_in(file))
        return self._functions

    def _called_in(self, file: File) -> Iterator[Func]:
        for func in self.program.functions_in(file):
            for call in invocations(func, {_MAIN}):
                if call.receiver is None:
                    found = self.program.functions_named(call.path, file, func.scope)
                    yield from (each for each in found if each.file is not file)


def _is_script(file: File, program: Program) -> bool:
    if file.language != "python":
        return False
    body = [func for func in program.functions_in(file) if func.fact.name == "<module>"]
    return any(file.facts.shebang or runs_as_main(func) for func in body)


def runs_as_main(func: Func) -> bool:
    """Tell whether the body of a file does something under a condition, as `if __name__ == "__main__"` is one."""
    return any(statement.kind == "do" and statement.depth > 0 for statement in func.fact.body)
