"""Constructors of classes of Python that have none, which leave an object as it begins.

Source: docs.python.org, "Data model", "object.__init__".
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Constant
from ecm_parsers.source.facts import Function, Statement
from ecm_parsers.source.python_dataclasses import has_no_fields

from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import IMPLIED, Cls, Func

if TYPE_CHECKING:
    from ecm_extract.link.index.program import Program

_MAKING: Final = frozenset({"__new__", "__getattribute__", "__setattr__", "__init_subclass__"})
"""Methods that make something else of an object, or of its class."""
_CONSTRUCTOR: Final = "__init__"


def settle_implied_makers(program: Program) -> None:
    """Give each class of Python that does without a constructor the one that is implied."""
    groups = program.classes.values()
    for cls in [cls for group in groups for cls in group if _is_seen_whole(cls, program)]:
        lineage = program.ancestry(cls)
        if not any(
            method.fact.name == _CONSTRUCTOR and not method.is_implied for each in lineage for method in each.methods
        ):
            line = cls.fact.line
            nothing = (Statement("do", line, Constant("null")),)
            fact = Function(_CONSTRUCTOR, cls.qualified, (), "", line, line, nothing, traits=(IMPLIED,))
            cls.methods.append(Func(fact, cls.file, cls))


def is_plain(cls: Cls, program: Program) -> bool:
    """Tell whether a class of Python, with its bases in the tree, has nothing that makes another one of it."""
    lineage = program.ancestry(cls)
    if cls.file.language != "python" or any("remade" in each.fact.traits for each in lineage):
        return False
    return not any(method.fact.name in _MAKING for each in lineage for method in each.methods)


def _is_seen_whole(cls: Cls, program: Program) -> bool:
    """Whether the tree has all that makes objects of a class."""
    bases = ((base, each) for each in program.ancestry(cls) for base in each.fact.bases)
    return is_plain(cls, program) and all(
        has_no_fields(base, each.file.facts.imports)
        or program.class_named(plain(base), each.file, each.fact.scope) is not None
        for base, each in bases
    )
