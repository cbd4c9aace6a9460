"""How members of C++ classes begin where the class declares them: objects that are made, calls that give a value."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.source.expr import Call, Expr, Items, Name
from ecm_parsers.source.facts import Field, Statement

from ecm_extract.link.code.calls import Invocation, Step, construction, invocation, one_node
from ecm_extract.link.code.spelling import by_value, plain
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import calls_in


def beginnings(cls: Cls) -> Iterator[Invocation]:
    """Yield the calls and constructions in the declarations of members, of a class with a method to hold them.

    A member that each constructor begins itself has none: what its declaration says is not run.
    """
    if not cls.methods or cls.file.language != "cpp":
        return
    holder = next((method for method in cls.methods if method.file is cls.file), cls.methods[0])
    replaced = _begun_by_all(cls)
    for field in cls.fact.fields:
        if field.name not in replaced:
            yield from _of(field, holder)


def _of(field: Field, holder: Func) -> Iterator[Invocation]:
    statement = Statement("let", field.line, field.default, Name(field.name), field.type)
    step = Step(holder, len(holder.fact.body), statement)
    for call in calls_in(field.default):
        yield invocation(step, call)
    if by_value(field.type) and not _makes_itself(field):
        args = one_node(holder, _arguments(field.default))
        yield construction(step, field.type, args, field.line)


def _makes_itself(field: Field) -> bool:
    """Tell whether a member is copied from an object that its declaration makes: `T x = T(a);`."""
    value = field.default
    return isinstance(value, Call) and isinstance(value.callee, Name) and plain(value.callee.id) == plain(field.type)


def _arguments(value: Expr | None) -> tuple[Expr, ...]:
    if value is None:
        return ()
    return value.items if isinstance(value, Items) else (value,)


def _begun_by_all(cls: Cls) -> frozenset[str]:
    """The members that every constructor of a class gives their first value; of one that calls another, that one's."""
    makers = [func for func in cls.methods if func.is_constructor and "declaration" not in func.fact.traits]
    given = [_begun_by(func) for func in makers]
    own = [names for names in given if cls.fact.name not in names]
    return frozenset.intersection(*own) if own else frozenset()


def _begun_by(func: Func) -> frozenset[str]:
    inits = (entry.target for entry in func.fact.body if entry.kind == "init")
    return frozenset(target.id for target in inits if isinstance(target, Name))
