"""Members of C++ of an object that is cast to another class: each is written as what it means before anything is run.

Source: [expr.static.cast], [class.member.lookup], [class.virtual] of the C++ standard. `static_cast<Base &>(own).topic`
is `own.Base::topic`; so is a method that is not virtual, and others are those of the object. A cast to a parameter of a
template keeps its name where the class has a member of that name as well: who knows the parameter knows which is meant.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ecm_parsers.source.expr import CAST, THIS, Call, Member
from ecm_parsers.source.rewriting import rewritten
from msgspec.structs import replace

from ecm_extract.link.code.spelling import plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.early_binding import is_virtual


def settle_casts(program: Program) -> None:
    """Write the members of objects that are cast as what they mean, in all functions of a tree."""
    for func in program.every_function():
        if any(call.callee == CAST for group in func.calls for call in group):
            func.read_as(rewritten(func.fact, _Casts(program, func).meant))


class _Casts:
    """What members of objects mean that one function casts."""

    def __init__(self, program: Program, func: Func) -> None:
        self.program = program
        self.func = func

    def meant(self, part: Any) -> Any:
        """Return what stands for a part of facts; None of what stays."""
        if isinstance(part, Call) and part.callee == CAST and part.types:
            return rewritten(part.args[0], self.meant)
        if not isinstance(part, Member) or not isinstance(part.base, Call) or part.base.callee != CAST:
            return None
        cast = part.base
        owner = self._owner(part.name, cast)
        name = f"{owner}::{part.name}" if owner and "::" not in part.name else part.name
        return replace(part, base=rewritten(cast.args[0], self.meant), name=name)

    def _owner(self, name: str, cast: Call) -> str:
        """The class that is written in front of a member; empty where the object alone tells which one it is."""
        written = plain(pointee(cast.types[0]))
        cls = self.program.class_named(written, self.func.file, self.func.scope)
        if cls is None:
            own = self.func.cls if cast.args[0] == THIS else None
            return written if own is not None and self._is_hidden(name, own) else ""
        if not self._is_hidden(name, cls):
            return ""
        methods = [each for entry in self.program.ancestry(cls) for each in entry.methods if each.fact.name == name]
        return "" if any(is_virtual(each, self.program) for each in methods) else written

    def _is_hidden(self, name: str, cls: Cls) -> bool:
        """Whether an object of a class, or of one that derives from it, has several members of a name."""
        objects = (self.program.ancestry(each) for each in (cls, *self.program.derived(cls)))
        return any(sum(name in _own_names(each) for each in lineage) > 1 for lineage in objects)


def _own_names(cls: Cls) -> Iterator[str]:
    """The names of the members of a class itself."""
    yield from cls.fields
    yield from (method.fact.name for method in cls.methods)
