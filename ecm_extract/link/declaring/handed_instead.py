"""What a helper hands on where nobody set the parameter that it reads.

`if (!read(name, raw)) { out.set(otherwise); return; } out.set(raw);`
"""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.source.expr import Call, Expr, Member, Name
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Block, Branch, Leave, statements, steps

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.expression_text import expression_text
from ecm_extract.link.code.walk import names_in
from ecm_extract.link.declaring.instead import is_denied

_OPEN = "..."


def handed_instead(call: Invocation, out: Expr | None) -> Expr | None:
    """Return the parameter of a helper that it hands to an object which it else hands what it read; None of several.

    Args:
        call: reads the parameter.
        out: the variable that the call writes it to.
    """
    denied = _denied_branch(call) if isinstance(out, Name) and is_denied(call) else None
    if not isinstance(out, Name) or denied is None or any(_throws(step) for step in steps(denied)):
        return None
    body, inside = call.func.fact.body, set(statements(denied))
    else_handed = {_shape(each, out.id) for at, each in enumerate(body) if at > call.at and at not in inside}
    found = {
        name
        for at in inside
        if _receiver(body[at]) in _written_to(call)
        for name in _arguments(body[at], call)
        if _shape(body[at], name) in else_handed - {None}
    }
    return Name(found.pop()) if len(found) == 1 else None


def _denied_branch(call: Invocation) -> Block | None:
    """What a function does where the parameter of a condition is not set."""
    asked = (step for step in steps(call.func.fact.flow) if isinstance(step, Branch))
    return next((step.then for step in asked if step.test == call.statement.value), None)


def _throws(step: object) -> bool:
    return isinstance(step, Leave) and step.how == "throw"


def _written_to(call: Invocation) -> set[str]:
    """The parameters of a function through which it gives something back."""
    return {each.name for each in call.func.fact.params if "&" in each.type and "const" not in each.type}


def _receiver(statement: Statement) -> str:
    """The variable that a statement gives something, by assigning it or by calling its method."""
    value = statement.value
    given = statement.target if statement.kind == "set" else None
    if given is None and isinstance(value, Call) and isinstance(value.callee, Member):
        given = value.callee.base
    return given.id if isinstance(given, Name) else ""


def _arguments(statement: Statement, call: Invocation) -> Iterator[str]:
    """The parameters of the function that a statement mentions, but for what it gives them to."""
    given = {each.name for each in call.func.fact.params} - {_receiver(statement)}
    return (name for name in set(names_in(statement.value)) if name in given)


def _shape(statement: Statement, name: str) -> str | None:
    """What a statement does with a variable, whatever that is called; None where it does not mention it."""
    if statement.value is None or name not in names_in(statement.value):
        return None
    text = expression_text(statement.value, False, lambda part: "_" if part == Name(name) else "")
    return f"{statement.kind} {_receiver(statement)} {text}" if _OPEN not in text else None
