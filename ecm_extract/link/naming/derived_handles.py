"""Classes of C++ that are node handles themselves: `class Arm : public ros::NodeHandle`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.source.expr import Call, Expr, Name

from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.env import Env, Instance
from ecm_extract.link.running.objects import Objects

_HANDLE: Final = "NodeHandle"


def derives_from_handle(cls: Cls, program: Program) -> bool:
    """Tell whether the objects of a class are node handles."""
    return _owner(cls, program) is not None


def base_handles(cls: Cls, made: Instance | None, objects: Objects) -> Iterator[tuple[tuple[Expr, ...], Env]]:
    """Yield what each constructor makes the handle of that an object is, with the place; nothing for the default one.

    Args:
        cls: the class of the object.
        made: how it is made, where one way is looked at.
        objects: tells what a constructor of a base is given.
    """
    owner = _owner(cls, objects.program)
    for func in owner.constructors if owner is not None else ():
        part = objects.part(made, owner) if made is not None and owner is not None else None
        if part is not None and part.maker not in (None, func):
            continue
        yield _given(func, Env(func, args=part.args if part is not None else {}, this=cls, made=made))


def _given(func: Func, env: Env) -> tuple[tuple[Expr, ...], Env]:
    for at, statement in enumerate(func.fact.body):
        target, value = statement.target, statement.value
        if statement.kind == "init" and isinstance(target, Name) and last_name(target.id) == _HANDLE:
            return (value.args if isinstance(value, Call) else ()), env.before(at)
    return (), env


def _owner(cls: Cls, program: Program) -> Cls | None:
    """The class of a lineage that derives from a handle itself, which no class of the tree is."""
    lineage = program.ancestry(cls) if cls.file.language == "cpp" else ()
    return next((each for each in lineage if any(last_name(plain(base)) == _HANDLE for base in each.fact.bases)), None)
