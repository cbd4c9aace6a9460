"""What constructors give members in braces: of a container its elements, of anything else what it is made from.

A file does not tell which it is, since the member can stand in another one: its braces are read as a list.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ecm_parsers.source.expr import Call, Expr, Items, Name
from ecm_parsers.source.facts import Statement
from msgspec.structs import replace

from ecm_extract.link.code.containers import is_container
from ecm_extract.link.code.spelling import plain, template_arguments
from ecm_extract.link.code.units import Func

Aliased = Callable[[str, Func], str]
"""Gives what an alias stands for where a function stands; what is none stays."""


def settle_members(funcs: Sequence[Func], aliased: Aliased) -> None:
    """Read the initialisers of constructors as the types of their members say."""
    for func in funcs:
        if func.file.language == "cpp" and any(entry.kind == "init" for entry in func.fact.body):
            body = tuple(
                [_settled(entry, func, aliased) if entry.kind == "init" else entry for entry in func.fact.body]
            )
            func.fact = replace(func.fact, body=body)


def _settled(entry: Statement, func: Func, aliased: Aliased) -> Statement:
    value, target = entry.value, entry.target
    if not isinstance(target, Name) or value is None:
        return entry
    written = _member_type(target.id, func, aliased)
    if is_container(written):
        return replace(entry, value=_container(value, target, written))
    if isinstance(value, Items):
        made = Call(target, value.items, (), (), entry.line)
        return replace(entry, value=value.items[0] if len(value.items) == 1 else made)
    return entry


def _container(value: Expr, target: Name, written: str) -> Expr:
    """The call that makes a container, as a variable of its type is made; what is copied stays."""
    own = isinstance(value, Call) and value.callee == target
    args = value.args if isinstance(value, Call) and own else (value,)
    return Call(Name(plain(written)), args, (), template_arguments(written), getattr(value, "line", 0))


def _member_type(name: str, func: Func, aliased: Aliased) -> str:
    field = func.cls.fields.get(name) if func.cls is not None else None
    if field is None:
        return ""
    return field.type if is_container(field.type) else aliased(field.type, func)
