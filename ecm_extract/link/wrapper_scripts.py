"""Scripts that only start the main function of a module: they are the program, the module is what it runs."""

from __future__ import annotations

from ecm_extract.link.calls import invocations
from ecm_extract.link.program import Program, module_matches
from ecm_extract.link.units import File, Func

_MAIN = "main"


class Wrapped:
    """Tells which main functions of Python are started by the scripts of a tree."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._modules: frozenset[str] | None = None

    def by_script(self, func: Func) -> bool:
        """Tell whether only another file starts a main function: its own is no script."""
        if func.file.language != "python" or _is_script(func.file, self.program):
            return False
        return any(module_matches(func.file.path, module) for module in self._started())

    def _started(self) -> frozenset[str]:
        """The modules whose main function scripts call."""
        if self._modules is None:
            scripts = [file for file in self.program.files if _is_script(file, self.program)]
            self._modules = frozenset(module for file in scripts for module in self._calls_of(file))
        return self._modules

    def _calls_of(self, file: File) -> list[str]:
        calls = (call for func in self.program.functions_in(file) for call in invocations(func, {_MAIN}))
        paths = [call.path.lstrip(".") for call in calls if call.receiver is None]
        return [path.removesuffix(f".{_MAIN}") for path in paths if path.endswith(f".{_MAIN}")]


def _is_script(file: File, program: Program) -> bool:
    if file.language != "python":
        return False
    body = [func for func in program.functions_in(file) if func.fact.name == "<module>"]
    return any(file.facts.shebang or runs_as_main(func) for func in body)


def runs_as_main(func: Func) -> bool:
    """Tell whether the body of a file does something under a condition, as `if __name__ == "__main__"` is one."""
    return any(statement.kind == "do" and statement.depth > 0 for statement in func.fact.body)
