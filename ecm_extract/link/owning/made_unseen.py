"""Classes of C++ of which objects may be made where no call names the class.

Braces that are handed, returned or assigned, templates, defaults of members, variables that outlive functions, and
other names of a class make objects of it all the same.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from functools import cached_property
from typing import Final

from ecm_parsers.source.expr import Call, Expr, Items, Name
from ecm_parsers.source.facts import Constant, Statement

from ecm_extract.link.code.pointed import is_null, makes_pointed
from ecm_extract.link.code.spelling import by_value, last_name, plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import last_of
from ecm_extract.link.index.program import Program

_WORD: Final = re.compile(r"\w+")
_IN_PLACE: Final = "optional"
"""Holds the object itself, which `emplace` makes."""


class SeenMakers:
    """Tells of which classes all that makes objects names them.

    Args:
        program: has all that makes some.
        registered: classes of which frameworks make objects.
    """

    def __init__(self, program: Program, registered: Collection[Cls]) -> None:
        self.program = program
        self._registered = registered

    def is_seen(self, cls: Cls) -> bool:
        """Tell whether neither frameworks nor derived classes, nor what names none, make objects of a class."""
        return not self.program.derived(cls) and self.are_named(cls)

    def are_named(self, cls: Cls) -> bool:
        """Tell whether what makes objects of a class, and of no derived one, names it."""
        return cls not in self._registered and cls.fact.name not in self._unseen

    @cached_property
    def _unseen(self) -> frozenset[str]:
        return made_unseen(self.program)


def made_unseen(program: Program) -> frozenset[str]:
    """Return the last names of these classes, and of all that stands beside them in a type."""
    funcs = [func for group in program.functions.values() for func in group if func.file.language == "cpp"]
    classes = [cls for group in program.classes.values() for cls in group if cls.file.language == "cpp"]
    braced = {name for func in funcs for name in _given_braces(func)}
    written = [text for func in funcs for text in (*_of_body(func, braced), *_of_head(func))]
    written += [text for cls in classes for text in _of_fields(cls, braced)]
    return frozenset(word for text in (*written, *_outside(program)) for word in _WORD.findall(text))


def _given_braces(func: Func) -> Iterator[str]:
    """The variables that a function assigns what stands in braces."""
    for statement in func.fact.body:
        if statement.kind == "set" and isinstance(statement.value, Items):
            yield last_of(statement.target)


def _of_body(func: Func, braced: set[str]) -> Iterator[str]:
    for statement in func.fact.body:
        is_made = last_of(statement.target) in braced or _has_braces_within(statement)
        yield statement.type if is_made else _in_template(statement.type)
    for call in (each for group in func.calls for each in group if not _makes_pointed(each)):
        yield from call.types


def _of_head(func: Func) -> Iterator[str]:
    """What a function takes and returns, for which braces may stand; a copy is made of what there is already."""
    if not func.is_constructor and not func.fact.name.startswith("operator"):
        yield func.fact.returns
        yield from (entry.type for entry in func.fact.params if _takes_braces(entry.type))
    elif func.cls is not None:
        own = func.cls.fact.name
        yield from (entry.type for entry in func.fact.params if own not in entry.type and _takes_braces(entry.type))


def _of_fields(cls: Cls, braced: set[str]) -> Iterator[str]:
    for field in cls.fact.fields:
        yield field.type if field.default is not None or field.name in braced else _in_template(field.type)


def _outside(program: Program) -> Iterator[str]:
    for _, constant in (each for group in program.constants.values() for each in group):
        yield _in_template(constant.type) if _points_nowhere(constant) else constant.type
    for alias in (each for file in program.files for each in file.facts.aliases):
        yield _in_template(alias.target) if "<" in alias.target else alias.target


def _points_nowhere(constant: Constant) -> bool:
    """Whether a variable is a plain pointer that begins as that of no object, as a static one does."""
    return constant.type.endswith("*") and (constant.value is None or is_null(constant.value))


def _has_braces_within(statement: Statement) -> bool:
    """Whether a variable begins with braces in braces, as an array does."""
    value: Expr | None = statement.value
    return isinstance(value, Items) and any(isinstance(item, Items) for item in value.items)


def _takes_braces(written: str) -> bool:
    return by_value(written) or (written.endswith("&") and ("const" in written or written.endswith("&&")))


def _in_template(written: str) -> str:
    """What a type gives a template that may make objects of it; nothing for a pointer, and for a type without any."""
    inner = written if last_name(plain(written)) == _IN_PLACE else pointee(written)
    return inner.partition("<")[2]


def _makes_pointed(call: Call) -> bool:
    return isinstance(call.callee, Name) and makes_pointed(last_name(call.callee.id))
