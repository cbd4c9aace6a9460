"""Functions that are declared within others: which those are, and whose object they have at hand."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.index.program import Program


class Nesting:
    """Finds the functions within functions of a program, each file looked through once."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._around: dict[Func, Func | None] = {}
        self._inner: dict[File, Mapping[str, list[Func]]] = {}

    def inner(self, func: Func) -> Sequence[Func]:
        """Return the functions that are declared within a function."""
        by_scope = self._inside(func.file)
        if func.fact.name == "<module>":
            return [entry for group in by_scope.values() for entry in group if entry.fact.shared]
        return by_scope.get(func.inner_scope, ())

    def enclosing(self, func: Func) -> Func | None:
        """Return the function that one is declared in."""
        if func not in self._around:
            head, _, last = func.fact.scope.rpartition("::")
            named = (other for other in self.program.functions_in(func.file) if other.fact.name == last)
            self._around[func] = next((other for other in named if other.fact.scope == head and other.fact.body), None)
        return self._around[func]

    def around(self, func: Func) -> Iterator[Func]:
        """Yield the functions that one is declared in, the next one first; none for methods."""
        outer = self.enclosing(func) if func.cls is None and func.fact.scope else None
        if outer is not None and outer is not func:
            yield outer
            yield from self.around(outer)

    def object_of(self, func: Func) -> Cls | None:
        """Return the class of the object at hand: that of a method, of a lambda that of the function around it."""
        while func.cls is None and "lambda" in func.fact.traits:
            outer = self.enclosing(func)
            if outer is None or outer is func:
                return None
            func = outer
        return func.cls

    def _inside(self, file: File) -> Mapping[str, list[Func]]:
        known = self._inner.get(file)
        if known is None:
            known = self._inner[file] = defaultdict(list)
            for func in self.program.functions_in(file):
                known[func.fact.scope].append(func)
        return known
