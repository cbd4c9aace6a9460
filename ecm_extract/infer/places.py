"""Which variable an expression means, by a key: locals by their name, members as `.name`, fields as `object.field`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence, Set

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name, Op
from ecm_parsers.source.facts import Function, Statement
from ecm_parsers.source.flow import Attempt, Block, blocks

from ecm_extract.infer.unpacking import unstarred
from ecm_extract.link.code.spelling import last_name

ALL_FIELDS = "__dict__"
"""Member of objects of Python that has all others: who changes an element of it may change any of these."""
_GET = Name("std::get")


def own_names(function: Function, python: bool) -> frozenset[str]:
    """Return the names that belong to a function: parameters and what it declares, in Python also what it assigns."""
    names = {parameter.name.lstrip("*") for parameter in function.params}
    for statement in function.body:
        if statement.kind in {"let", "each"} or (python and statement.kind == "set"):
            names.update(_bound(statement.target))
    names.update(caught_names(function.flow) if python else ())
    return frozenset(names - set(function.shared))


def caught_names(block: Block) -> Iterator[str]:
    """Yield the variables that handlers have exceptions in, once for each handler."""
    for step in block:
        if isinstance(step, Attempt):
            yield from (handler.name for handler in step.handlers if handler.name)
        if not isinstance(step, int):
            for inner in blocks(step):
                yield from caught_names(inner)


def _bound(target: Expr | None) -> Iterator[str]:
    if isinstance(target, Name):
        yield target.id
    elif isinstance(target, Items):
        for item in target.items:
            yield from _bound(unstarred(item))


def key_of(expr: Expr | None, own: Set[str], member: Callable[[str], bool]) -> str:
    """Return the key of a variable, empty for what is none.

    Args:
        expr: the expression.
        own: names of the function itself.
        member: tells whether a name that is not the function's own is a member of `this`.
    """
    if isinstance(expr, Name):
        if expr.id in own or "::" in expr.id or is_kept_value(expr.id) or not member(expr.id):
            return expr.id if expr != THIS else ""
        return "" if expr == THIS else f".{expr.id}"
    if isinstance(expr, Member):
        if expr.base == THIS:
            return f".{expr.name}"
        base = key_of(expr.base, own, member)
        return f"{base}.{expr.name}" if base else ""
    if isinstance(expr, Op) and expr.op in {"&", "*"} and len(expr.operands) == 1:
        return key_of(expr.operands[0], own, member)
    return ""


def target_of(statement: Statement) -> Expr | None:
    """Return what a statement binds: an initialiser means the member, whatever the constructor calls its parameters.

    What makes a base means what the object has of it, by the last name of that.
    """
    target = statement.target
    return Member(THIS, last_name(target.id)) if statement.kind == "init" and isinstance(target, Name) else target


def root_of(expr: Expr | None, own: Set[str], member: Callable[[str], bool]) -> str:
    """Return the key of the variable that an expression reaches into: `table` of `table["a"].back()`."""
    while expr is not None:
        key = key_of(expr, own, member)
        if key:
            return key
        expr = whole_of(expr)
    return ""


def whole_of(expr: Expr) -> Expr | None:
    """Return what an expression is a part of: `a` of `a.b`, `a[0]`, `&a`, `a.last()` and `std::get<0>(a)`."""
    if isinstance(expr, Member):
        return expr.base
    if isinstance(expr, Op) and expr.op in {"[]", "&"}:
        return expr.operands[0]
    if isinstance(expr, Call) and expr.callee == _GET and len(expr.args) == 1:
        return expr.args[0]
    return expr.callee.base if isinstance(expr, Call) and isinstance(expr.callee, Member) else None


def chosen(expr: Expr | None) -> Sequence[Expr]:
    """Return what an expression of C++ may reach into that a choice or a function gives.

    `a` and `b` of `(test ? a : b).name` and of `larger(a, b).name`.
    """
    while expr is not None and not _gives_one(expr):
        expr = whole_of(expr)
    sides = expr.operands[1:] if isinstance(expr, Op) else expr.args if isinstance(expr, Call) else ()
    return [each for side in sides for each in (chosen(side) or (side,))]


def _gives_one(expr: Expr) -> bool:
    """Whether an expression is one of several that stand in it."""
    by_function = isinstance(expr, Call) and isinstance(expr.callee, Name) and expr.callee != _GET
    return by_function or (isinstance(expr, Op) and expr.op == "?:")


def wholes(key: str) -> list[str]:
    """Return the objects that a field lies in, by key; the object at hand has none."""
    parts = key.split(".")
    return [".".join(parts[:count]) for count in range(1, len(parts)) if parts[0]]


def around(key: str) -> Iterator[str]:
    """Yield what a field lies in, by key, the nearest first; "" for the object at hand."""
    end = key.rfind(".")
    while end >= 0:
        yield key[:end]
        end = key.rfind(".", 0, end) if end else -1


def owners(key: str) -> list[str]:
    """Return the members of the object at hand that a field lies in, by key; none for a member itself."""
    parts = key.split(".")
    return [".".join(parts[:count]) for count in range(2, len(parts)) if not parts[0]]


def as_written(key: str) -> Expr:
    """Return a variable of the object, or another one, or a field of that, as a function of its own names writes it."""
    root, *names = key.split(".")
    return _field_of(Name(root) if root else THIS, names)


def _field_of(whole: Expr, names: Sequence[str]) -> Expr:
    for name in names:
        whole = Member(whole, name)
    return whole


def is_kept_value(key: str) -> bool:
    """Tell whether a variable is none of the code's, but what an expression got of one that it changed: `i--`."""
    return key.startswith("#")
