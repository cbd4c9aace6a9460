"""Objects of Python made of others with some fields changed: `replace(row, name="x")`, `row._replace(name="x")`.

Source: docs.python.org, "dataclasses" (`replace`), "copy" (`replace`), "collections" (`_replace`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.left_alone import SPREAD
from ecm_extract.link.code.units import Cls
from ecm_extract.link.running.env import Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_FUNCTIONS: Final = frozenset({"dataclasses.replace", "copy.replace"})
_METHOD: Final = "_replace"


def with_fields_in_place(made: Bound, folder: Folder) -> Bound:
    """Return what makes an object, where that changes fields of another one as the call of its class that does it."""
    call, env = made.expr, made.env
    if not isinstance(call, Call) or env.func.file.language != "python":
        return made
    other = _other(call, env, folder)
    if other is None or any(name == SPREAD for name, _ in call.keywords):
        return made
    cls = folder.structures.class_at(other, env)
    names = _given_fields(cls) if cls is not None else []
    if cls is None or not names or folder.objects.class_written(cls.fact.name, env) is not cls:
        return made
    given = dict(call.keywords)
    fields = tuple([(name, given.get(name, Member(other, name))) for name in names])
    return Bound(Call(Name(cls.fact.name), (), fields, (), call.line), env)


def _other(call: Call, env: Env, folder: Folder) -> Expr | None:
    """The object of which some fields are changed; None where a call does something else."""
    if isinstance(call.callee, Member) and call.callee.name == _METHOD and not call.args:
        return call.callee.base
    written = dotted_name(call.callee)
    replaces = bool(written) and folder.program.canonical(written, env.func.file) in _FUNCTIONS
    return call.args[0] if replaces and len(call.args) == 1 else None


def _given_fields(cls: Cls) -> list[str]:
    """The fields that the one constructor of a class is given by their names; none where it is given anything else."""
    names = [each.name for each in cls.constructors[0].fact.params] if len(cls.constructors) == 1 else []
    return names if all(name in cls.fields for name in names) else []
