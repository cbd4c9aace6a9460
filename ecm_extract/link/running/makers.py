"""The constructors that a class has, of its own or by a base."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.overloads import best, scored
from ecm_extract.link.code.units import Cls, Func

if TYPE_CHECKING:
    from ecm_extract.link.index.program import Program


def makers_of(cls: Cls, program: Program) -> list[Func]:
    """Return the constructors of a class; a class without any has those of its base, but for implied ones."""
    lineage = (_own(owner, cls) for owner in program.ancestry(cls))
    return [func for func in next(filter(None, lineage), ()) if "deleted" not in func.fact.traits]


def best_makers(cls: Cls, call: Invocation, program: Program) -> list[Func]:
    """Return the constructors that take the arguments of a call best: of Python those by a base, too."""
    makers = makers_of(cls, program) if cls.file.language == "python" else cls.constructors
    return list(best(call, scored(call, makers)))


def _own(owner: Cls, cls: Cls) -> list[Func]:
    return [each for each in owner.methods if each.is_constructor and (owner is cls or not each.is_implied)]
