"""Destructors of classes of C++ that have no method: the functions in which what their members begin with stands.

Source: [class.dtor] of the C++ standard: a class without a destructor has an implied one, which does nothing itself.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Name
from ecm_parsers.source.facts import Field, Function

from ecm_extract.link.code.spelling import by_value, last_name, plain
from ecm_extract.link.code.units import IMPLIED, Cls, Func
from ecm_extract.link.code.walk import calls_in

if TYPE_CHECKING:
    from ecm_extract.link.index.program import Program


def settle_implied_ends(program: Program) -> None:
    """Give each class of C++ without methods, whose members are made by calls, the destructor that is implied."""
    groups = program.classes.values()
    for cls in [cls for group in groups for cls in group if _is_without(cls)]:
        if any(_begins(field, program) for field in cls.fact.fields):
            name, line = cls.fact.name, cls.fact.line
            fact = Function(f"~{name}", cls.qualified, (), "", line, line, traits=(IMPLIED,))
            cls.methods.append(Func(fact, cls.file, cls))


def _is_without(cls: Cls) -> bool:
    return cls.file.language == "cpp" and not cls.methods


def _begins(field: Field, program: Program) -> bool:
    """Whether a member begins by a call of other than a standard class, or is an object of a class of the tree."""
    made = [field.type] if by_value(field.type) else []
    for call in calls_in(field.default):
        if not isinstance(call.callee, Name) or not call.callee.id.startswith("std::"):
            return True
        made += call.types
    return any(last_name(plain(written)) in program.classes for written in made)
