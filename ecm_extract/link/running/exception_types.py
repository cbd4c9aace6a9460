"""Types of exceptions by what is written: those of the standard libraries, and those of the tree."""

from __future__ import annotations

from ecm_extract.infer.kinds import Kind, standard_kind
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program


class ExceptionTypes:
    """Finds what a type derives from, each once."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._known: dict[Cls, Kind] = {}

    def kind(self, spelled: str, func: Func) -> Kind | None:
        """Return the type that is written so in a function; None for what is no type that is known."""
        cls = self.program.class_named(plain(spelled), func.file, func.scope)
        if cls is not None:
            return self._of_class(cls)
        return standard_kind(self.program.canonical(spelled, func.file, func.scope), func.file.language)

    def _of_class(self, cls: Cls) -> Kind:
        known = self._known.get(cls)
        if known is None:
            lineage = self.program.ancestry(cls)
            outside = [(base, entry) for entry in lineage for base in self._outside(entry)]
            kinds = [standard_kind(base, cls.file.language) for base, _ in outside]
            above = {entry.qualified for entry in lineage}.union(*[kind.above for kind in kinds if kind is not None])
            whole = None not in kinds
            known = self._known[cls] = Kind(cls.qualified, frozenset(above), whole)
        return known

    def _outside(self, cls: Cls) -> list[str]:
        """The bases of a class that do not stand in the tree."""
        named = [(base, self.program.class_named(plain(base), cls.file, cls.fact.scope)) for base in cls.fact.bases]
        return [self.program.canonical(base, cls.file, cls.fact.scope) for base, found in named if found is None]
