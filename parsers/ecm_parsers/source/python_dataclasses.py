"""Constructors that Python writes itself: of data classes, named tuples and the like.

Source: docs.python.org, "dataclasses": `__init__` takes the annotated fields in their order, those of bases first, and
calls `__post_init__` in the end.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import NamedTuple

import msgspec

from ecm_parsers.source.expr import Call, Constant, Expr, Lambda, Member, Name, Op, Opaque
from ecm_parsers.source.facts import Class, Field, Function, Parameter, Statement

_THIS = Name("this")
_AFTER = "__post_init__"


class _Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    decorators: frozenset[str]
    bases: frozenset[str]
    plain: frozenset[str]
    makers: frozenset[str]
    factories: tuple[str, ...]


class _Taken(NamedTuple):
    """A field that the constructor sets; `is_given`: from a parameter of its name."""

    field: Field
    default: Expr | None
    is_given: bool


@cache
def _table() -> _Table:
    text = files("ecm_parsers").joinpath("source", "python_dataclasses.toml").read_text(encoding="utf-8")
    return msgspec.convert(tomllib.loads(text), _Table)


def generated_init(cls: Class, inside: str, methods: Sequence[str]) -> Function | None:
    """Return the constructor that a class is given by a decorator or a base; None where it is given none.

    Args:
        cls: the class.
        inside: the scope of its methods.
        methods: the names of those that it has itself.
    """
    table = _table()
    decorated = any(_last(each) in table.decorators for each in cls.decorators)
    bases = [base.partition("[")[0].rpartition(".")[2] for base in cls.bases]
    if "__init__" in methods or not (decorated or not table.bases.isdisjoint(bases)):
        return None
    taken = list(_taken(cls.fields))
    derived = not table.plain.union(table.bases).issuperset(bases)
    body = [*_of_bases(cls.line)] if derived else []
    body += [_set(each, derived) for each in taken]
    if _AFTER in methods:
        body.append(Statement("do", cls.line, Call(Member(_THIS, _AFTER), (), line=cls.line)))
    params = [Parameter(each.field.name, each.field.type, each.default) for each in taken if each.is_given]
    every = [Parameter("*values"), Parameter("**named")]
    return Function("__init__", inside, tuple(every if derived else params), "", cls.line, cls.line, tuple(body))


def _taken(fields: Sequence[Field]) -> Iterator[_Taken]:
    for field in fields:
        made = field.default if isinstance(field.default, Call) and _last(field.default) in _table().makers else None
        if field.type.partition("[")[0].rpartition(".")[2] in {"ClassVar", "KW_ONLY"} or not (field.type or made):
            continue
        if made is None:
            yield _Taken(field, field.default, is_given=True)
        else:
            said = dict(made.keywords)
            yield _Taken(field, _default(made, said), said.get("init") != Constant("false"))


def _default(made: Call, said: Mapping[str, Expr]) -> Expr | None:
    if "default" in said:
        return said["default"]
    factory = next((said[name] for name in _table().factories if name in said), None)
    if isinstance(factory, Lambda):
        return factory.body or Opaque("factory")
    return Call(factory, (), line=made.line) if factory is not None else None


def _set(taken: _Taken, derived: bool) -> Statement:
    """What a field is given; which of the arguments of a derived class that is cannot be told here."""
    given: Expr | None = Name(taken.field.name) if taken.is_given else taken.default
    value = Opaque("values") if derived and taken.is_given else given
    return Statement("set", taken.field.line, value, Member(_THIS, taken.field.name))


def _of_bases(line: int) -> Iterator[Statement]:
    callee = Member(Call(Name("super"), (), line=line), "__init__")
    everything = (Op("*", (Name("values"),)),)
    yield Statement("do", line, Call(callee, everything, (("**", Name("named")),), line=line, keyword_lines=(line,)))


def _last(expr: Expr) -> str:
    callee = expr.callee if isinstance(expr, Call) else expr
    return (
        callee.name if isinstance(callee, Member) else callee.id.rpartition(".")[2] if isinstance(callee, Name) else ""
    )
