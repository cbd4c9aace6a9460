"""Constructors of classes of C++ that nobody writes, which leave an object as its fields are declared.

Source: [class.default.ctor] of the C++ standard.
"""

from __future__ import annotations

from ecm_parsers.source.expr import Constant
from ecm_parsers.source.facts import Function, Statement

from ecm_extract.link.code.units import IMPLIED, Cls, Func
from ecm_extract.link.index.program import Program


class ImplicitMakers:
    """Has the one constructor of each class that does without; the same one whoever asks."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._known: dict[Cls, Func | None] = {}

    def of(self, cls: Cls) -> Func | None:
        """Return the constructor that a class has without writing one; None where it, or a base, has another one."""
        if cls not in self._known:
            self._known[cls] = _implied(cls) if self._is_plain(cls) else None
        return self._known[cls]

    def _is_plain(self, cls: Cls) -> bool:
        """Whether the tree has all of a class, and nothing of that is done when an object is made."""
        lineage = self._program.ancestry(cls)
        whole = all(len(self._program.bases(each)) == len(each.fact.bases) for each in lineage)
        makes = any(method.is_constructor for each in lineage for method in each.methods)
        return cls.file.language == "cpp" and whole and not makes and not any(each.fact.template for each in lineage)


def _implied(cls: Cls) -> Func:
    line = cls.fact.line
    nothing = (Statement("do", line, Constant("null")),)
    return Func(Function(cls.fact.name, cls.qualified, (), "", line, line, nothing, traits=(IMPLIED,)), cls.file, cls)
