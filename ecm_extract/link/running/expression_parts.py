"""The parts of an expression of Python in the order in which they are taken."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from ecm_parsers.source.expr import Call, Comprehension, Expr, Items, Member, Name, Op, Table, Template
from msgspec.structs import replace


def inner(expr: Expr) -> Iterator[Expr]:
    """Yield the parts of an expression that are taken when it is, in their order."""
    if isinstance(expr, Call):
        if not isinstance(expr.callee, Name):
            yield expr.callee.base if isinstance(expr.callee, Member) else expr.callee
        yield from expr.args
        yield from (value for _, value in expr.keywords)
    elif isinstance(expr, Member):
        yield expr.base
    elif isinstance(expr, Op):
        yield from expr.operands
    elif isinstance(expr, Items):
        yield from expr.items
    elif isinstance(expr, Template):
        yield from expr.parts
    elif isinstance(expr, Table):
        yield from (each for entry in expr.entries for each in entry)


def with_inner(expr: Expr, change: Callable[[Expr], Expr]) -> Expr:
    """Return an expression with others in the place of its parts, which are asked for in their order."""
    if isinstance(expr, Call):
        callee = expr.callee
        if isinstance(callee, Member):
            callee = Member(change(callee.base), callee.name)
        elif not isinstance(callee, Name):
            callee = change(callee)
        args = tuple([change(each) for each in expr.args])
        return replace(
            expr, callee=callee, args=args, keywords=tuple([(key, change(each)) for key, each in expr.keywords])
        )
    if isinstance(expr, Member):
        return Member(change(expr.base), expr.name)
    if isinstance(expr, Op):
        return Op(expr.op, tuple([change(each) for each in expr.operands]))
    if isinstance(expr, Items):
        return Items(tuple([change(each) for each in expr.items]))
    if isinstance(expr, Template):
        return Template(tuple([change(each) for each in expr.parts]))
    if isinstance(expr, Table):
        return Table(tuple([(change(key), change(value)) for key, value in expr.entries]))
    return expr


def renumbered(expr: Expr, places: Sequence[int]) -> Expr:
    """Return an expression whose loops are elsewhere by now."""
    if isinstance(expr, Comprehension):
        parts = [renumbered(each, places) for each in (expr.element, *expr.tests)]
        return Comprehension(parts[0], tuple([places[at] for at in expr.loops]), tuple(parts[1:]))
    return with_inner(expr, lambda each: renumbered(each, places))
