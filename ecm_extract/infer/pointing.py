"""Expressions that point to objects: addresses, and calls that make an object behind a pointer."""

from __future__ import annotations

from ecm_parsers.source.expr import Call, Expr, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.held import Held
from ecm_extract.link.code.pointed import makes_pointed
from ecm_extract.link.code.spelling import last_name


def is_address(value: Expr | None) -> bool:
    """Tell whether an expression is the address of something."""
    return isinstance(value, Op) and value.op == "&" and len(value.operands) == 1


def refers(binding: Statement) -> bool:
    """Tell whether a declaration of C++ makes a reference or a pointer: `auto & x = y`, `auto p = &y`."""
    is_let = binding.kind in {"let", "each"}
    return is_let and (binding.type.endswith("&") or (binding.kind == "let" and is_address(binding.value)))


def makes_pointer(held: Held) -> bool:
    """Tell whether a variable holds a pointer to an object that was made for it."""
    callee = held.expr.callee if held.how == "value" and isinstance(held.expr, Call) else None
    return isinstance(callee, Name) and makes_pointed(last_name(callee.id))
