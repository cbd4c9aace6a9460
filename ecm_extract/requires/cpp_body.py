"""C++: the bodies of functions as those read them who look for what they touch of other packages.

A body is walked once, and what its objects are is looked up once, for all who ask.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.link.running.objects import Objects
from ecm_extract.requires.foreign_classes import ForeignClasses, Inherited

_REACHING: Final[frozenset[type]] = frozenset({Call, Member})
_INHERITING: Final[frozenset[type]] = _REACHING | {Name}
"""A bare name touches something of another package only where the class inherits from there."""


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """A function that has a body.

    Attributes:
        statements: of each the members and calls in it, and the names that may be inherited, with their lines.
        classes: of its objects. inherited: what its class has of others.
    """

    func: Func
    objects: Objects
    statements: Sequence[Sequence[tuple[Expr, int]]]
    classes: ForeignClasses
    inherited: Inherited


def bodies(objects: Objects) -> Iterator[Body]:
    """Yield the bodies of all functions of C++."""
    inherited: dict[tuple[Cls | None, str], Inherited] = {}
    for functions in objects.program.functions.values():
        for func in functions:
            if func.file.language == "cpp" and func.fact.body:
                key = (func.cls, func.file.package)
                if key not in inherited:
                    inherited[key] = Inherited(func.cls, func.file.package, objects)
                statements = _statements(func, _INHERITING if inherited[key].bases else _REACHING)
                yield Body(func, objects, statements, ForeignClasses(func, objects), inherited[key])


def _statements(func: Func, kinds: Container[type]) -> Sequence[Sequence[tuple[Expr, int]]]:
    return [[each for each in expressions(statement) if type(each[0]) in kinds] for statement in func.fact.body]
