"""Functions that somebody gets, by a form that is not read as a call: who has one may call it with anything.

In C++ their address, `threads.emplace_back(&Node::run, this, "x")`; in Python they themselves, `later(self.run)`.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.cpp_invoking import called_by
from ecm_parsers.source.expr import Call, Expr, Member, Name, Op

from ecm_extract.infer.pointing import is_address
from ecm_extract.link.code.callables import callable_of
from ecm_extract.link.code.units import File, Func
from ecm_extract.link.code.walk import children, expressions, given_to, last_of
from ecm_extract.link.index.program import Program

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_ANY: Final = Name("")


class GivenFunctions:
    """Tells which they are, by name; each file is looked through once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self.program = folder.program
        self._given: dict[File, Set[Expr]] = {}

    def has(self, func: Func) -> bool:
        """Tell whether a file that sees a function gives it, or one that is called so, to somebody."""
        asked = _as_given(func)
        files = (file for file in self.program.files if self.program.sees(file, func.file))
        return any(asked in self._given_in(file) for file in files)

    def _given_in(self, file: File) -> Set[Expr]:
        known = self._given.get(file)
        if known is None:
            named = _addresses(file, self.program) if file.language == "cpp" else self._arguments(file)
            known = self._given[file] = frozenset(named)
        return known

    def _arguments(self, file: File) -> Iterator[Expr]:
        """What functions of Python in a file give to calls, but for those of the tree that only call it."""
        for func in self.program.functions_in(file):
            calls = (call for group in func.calls for call in group)
            for call in (call for call in calls if callable_of(call, file.imported) is None):  # no partial
                for index, arg in enumerate(given_to(call)):
                    if isinstance(arg, Name | Member) and not self.folder.lent.is_lent(call, func, index):
                        yield Member(_ANY, arg.name) if isinstance(arg, Member) else arg


def _as_given(func: Func) -> Expr:
    """How a function is mentioned: a method of Python by an object, whichever that is."""
    own = func.file.language == "python" and func.cls is not None
    return Member(_ANY, func.fact.name) if own else Name(func.fact.name)


def _addresses(file: File, program: Program) -> Iterator[Expr]:
    """The functions of C++ whose address a file takes, but for what is read as a call."""
    begun = (field.default for cls in file.facts.classes for field in cls.fields if field.default is not None)
    held = (part for func in program.functions_in(file) for each in func.fact.body for part, _ in expressions(each))
    parts = [*held, *(part for value in begun for part in children(value))]
    read = [called_by(part) for part in parts if isinstance(part, Call)]
    for part in parts:
        if isinstance(part, Op) and is_address(part) and not any(part is each for each in read):
            yield Name(last_of(part.operands[0]))
