"""What is taken where nobody set a parameter: `return read if known else fallback`, `if (!get(x)) x = fallback;`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.source.expr import Call, Constant, Expr, Member, Name, Op
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Block, Branch, Switch, statements, steps

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.walk import expressions, last_of, names_in
from ecm_extract.shipped import shipped_names

_PRESENT: Final = shipped_names("link/code/library_values.toml", "present")
_JOINING: Final = frozenset({"!", "&&", "||", "not", "and", "or"})


def returned_instead(call: Invocation, out: Expr | None) -> Expr | None:
    """Return what a helper returns where it does not return what it read: one of its parameters; None without one.

    Args:
        call: reads the parameter.
        out: the variable that the call writes it to, where it has one.
    """
    returned = [statement.value for statement in call.func.fact.body if statement.kind == "return"]
    read = out if out is not None else _assigned(call)
    if call.statement.kind != "return" and (read is None or read not in returned):
        return None
    given = {parameter.name for parameter in call.func.fact.params}
    others = {value for value in returned if isinstance(value, Name) and value.id in given}
    return others.pop() if len(others) == 1 else None


def is_denied(call: Invocation) -> bool:
    """Tell whether a condition is just that the parameter is not set: `!read(...)`, `read(...) == false`."""
    value = call.statement.value
    if not isinstance(value, Op) or call.statement.kind != "do":
        return False
    denies = value.op == "!" or (value.op == "==" and value.operands[1:] == (Constant("false"),))
    asked = value.operands[0]
    return denies and _is(asked, call)


def assigned_instead(call: Invocation, out: Expr, at: int) -> Expr | None:
    """Return what the branch behind the condition gives the variable; `at` is the statement of the call."""
    for statement in call.func.fact.body[at + 1 :]:
        if statement.depth < call.statement.depth or statement.kind == "return":
            return None
        if statement.kind == "set" and statement.target == out:
            return statement.value
    return None


def assigned_otherwise(call: Invocation, out: Expr) -> Expr | None:
    """Return what the other side of a choice gives the variable: of a read that is asked, or of whether it is there.

    `if (read(name, out)) {} else { out = value; }`, `if (has(name)) { read(name, out); } else { out = value; }`.
    """
    body = call.func.fact.body
    found = [body[at].value for block in _where_unset(call) for at in statements(block) if _gives(body[at], out)]
    return found[0] if len(found) == 1 else None


def _where_unset(call: Invocation) -> Iterator[Block]:
    """Yield what runs where a parameter is not set, which a choice around its read asks, or the read itself."""
    for step in steps(call.func.fact.flow):
        if not isinstance(step, Branch):
            continue
        denies = isinstance(step.test, Op) and step.test.op == "!"
        asked = step.test.operands[0] if isinstance(step.test, Op) and denies else step.test
        there, absent = (step.other, step.then) if denies else (step.then, step.other)
        reads = step.test == call.statement.value and _is(asked, call)
        if reads or (_asks_for(asked, call) and call.at in statements(there)):
            yield absent


def _is(asked: Expr, call: Invocation) -> bool:
    return isinstance(asked, Call) and asked.line == call.line and asked.args == call.args


def _asks_for(asked: Expr, call: Invocation) -> bool:
    """Whether an expression asks just whether the parameter is there that a call reads."""
    return isinstance(asked, Call) and last_of(asked.callee) in _PRESENT and asked.args[:1] == call.args[:1]


def _gives(statement: Statement, out: Expr) -> bool:
    return statement.kind == "set" and statement.target == out and not statement.type


def given_instead(call: Invocation, out: Expr | None) -> Expr | None:
    """Return what a helper returns where nobody set the parameter that it reads; None where that is not stated."""
    instead = returned_instead(call, out)
    if instead is not None or out is None or not _returns_only(call, out):
        return instead
    return (assigned_instead(call, out, call.at) if is_denied(call) else None) or kept_instead(call, out)


def kept_instead(call: Invocation, out: Expr) -> Expr | None:
    """Return the parameter that a helper begins its variable with, where that is returned as it is if nothing is read.

    `T value = other; if (!read(name, value)) { warn(); } return value;`: a branch that does anything may end the run.
    """
    body = call.func.fact.body
    given = {parameter.name for parameter in call.func.fact.params}
    begun = [statement for statement in body if statement.target == out]
    if len(begun) != 1 or begun[0].kind != "let" or begun[0].depth or not _returns_only(call, out):
        return None
    value, between = begun[0].value, body[body.index(begun[0]) + 1 : call.at]
    untouched = isinstance(out, Name) and not any(out.id in names_in(statement.value) for statement in between)
    plainly = untouched and _does_nothing(call)
    return value if plainly and isinstance(value, Name) and value.id in given else None


def goes_on(call: Invocation) -> bool:
    """Tell whether a function goes on where the parameter of a condition is not set, as if nobody had asked.

    A condition of several reads, `if (read(x) && read(y))`, is none where nothing is done behind it.
    """
    branches = (step for step in steps(call.func.fact.flow) if isinstance(step, Branch))
    asked = [step for step in branches if step.test == call.statement.value]
    if is_denied(call):
        return any(not step.then for step in asked)
    return _is_of_reads(call) and any(not step.then and not step.other for step in asked)


def _is_of_reads(call: Invocation) -> bool:
    """Tell whether a condition is made of nothing but calls of the same name."""
    pending, found = [call.statement.value], list[Expr]()
    while pending:
        part = pending.pop()
        if isinstance(part, Op) and part.op in _JOINING:
            pending += part.operands
        elif part is not None:
            found.append(part)
    return len(found) > 1 and all(isinstance(each, Call) and last_of(each.callee) == call.last for each in found)


def is_asked(call: Invocation) -> bool:
    """Tell whether a read is a condition: `if (read(x))`, `if (!read(x))`."""
    return next(_where_set(call), None) is not None


def is_made_over(call: Invocation, out: Expr) -> bool:
    """Tell whether a variable is given something made of it where the parameter is set: `if (read(x)) x = !x;`.

    What it holds where nothing is read is then not what somebody would set.
    """
    body = call.func.fact.body
    where_set = [at for block in _where_set(call) for at in statements(block)]
    return any(body[at].target == out and _names_again(body[at], out) for at in where_set)


def _where_set(call: Invocation) -> Iterator[Block]:
    """Yield what runs where the condition that reads a parameter finds it set."""
    for step in steps(call.func.fact.flow):
        if isinstance(step, Branch) and step.test == call.statement.value:
            yield step.other if is_denied(call) else step.then
        elif isinstance(step, Switch):
            yield from (case.body for case in step.cases if case.tests == (call.statement.value,))


def _names_again(statement: Statement, out: Expr) -> bool:
    """Whether a statement that gives a variable something names it in that, too."""
    return sum(expr == out for expr, _ in expressions(statement)) > 1


def _returns_only(call: Invocation, out: Expr) -> bool:
    """Whether a variable is all that a function returns."""
    return [statement.value for statement in call.func.fact.body if statement.kind == "return"] == [out]


def _does_nothing(call: Invocation) -> bool:
    """Whether what follows a read up to the return is nothing: it is asked for alone, or by a branch without calls."""
    after = call.func.fact.body[call.at + 1 :]
    alone = isinstance(call.statement.value, Call) and call.statement.kind == "do" and not call.statement.depth
    return (alone or is_denied(call)) and [statement.kind for statement in after] == ["return"]


def _assigned(call: Invocation) -> Expr | None:
    """The variable that is given nothing but what a call gives."""
    value = call.statement.value
    whole = isinstance(value, Call) and value.line == call.line and value.args == call.args
    return call.statement.target if whole and isinstance(call.statement.target, Name | Member) else None
