"""What of an expression in C++ matters beside its value: calls, and parts that are shifted into a stream."""

from __future__ import annotations

from ecm_parsers.source.expr import Call, Expr, Lambda, Member, Op


def shifted(value: Expr) -> list[Expr]:
    """Return the operands of a chain of `<<` from left to right."""
    parts: list[Expr] = []
    while isinstance(value, Op) and value.op == "<<" and len(value.operands) == 2:
        parts.insert(0, value.operands[1])
        value = value.operands[0]
    return [value, *parts]


def has_call(value: Expr) -> bool:
    """Tell whether an expression calls anything."""
    if isinstance(value, Call):
        return True
    if isinstance(value, Op):
        return any(has_call(operand) for operand in value.operands)
    return isinstance(value, Lambda)


def matters(value: Expr) -> bool:
    """Tell whether an expression calls anything, or reads a member: who declares that member may take it away."""
    if isinstance(value, Call | Member | Lambda):
        return True
    return isinstance(value, Op) and any(matters(operand) for operand in value.operands)
