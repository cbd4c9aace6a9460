"""Parameters that a node asks for and ends without: `if (!nh.getParam("a", a)) { throw ...; }`, and by `hasParam`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import msgspec
from ecm_parsers.source.expr import Call, Expr, Member, Op
from ecm_parsers.source.flow import Block, Branch, Leave, Step

from ecm_extract.infer.raising_calls import operation
from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.code.spelling import last_name
from ecm_extract.shipped import shipped_names

_ALWAYS: Final = "always"
_CHECKS: Final = "link/endpoints/checks.toml"


class Asked(msgspec.Struct, frozen=True):
    """A call that reads a parameter, its language, and the name of the call that only tells whether it is set."""

    call: Invocation
    language: str
    tells: str

    def is_in(self, expr: Expr) -> bool:
        """Whether an expression is a call that is true where the parameter is set."""
        if not isinstance(expr, Call) or expr.args[:1] != self.call.args[:1]:
            return False
        names = {last_name(self.call.path), last_name(self.tells)}
        if isinstance(expr.callee, Member):
            is_same = self.call.receiver is None or expr.callee.base == self.call.receiver
            return is_same and expr.callee.name in names
        return last_name(dotted_name(expr.callee)) in names


def ends_without(asked: Asked, steps: Iterator[Step]) -> bool:
    """Whether one of the steps that a function surely gets to ends the node where a parameter is not set."""
    body = asked.call.func.fact.body
    for step in steps:
        if isinstance(step, int) and _is_checked(body[step].value, asked):
            return True
        if isinstance(step, Branch):
            missing = any(map(asked.is_in, _negated(step.test)))
            there = any(map(asked.is_in, _parts(step.test, "&&")))
            sides = (missing, step.then), (there, step.other)
            if any(fails and _ends(side, asked.call, asked.language) for fails, side in sides):
                return True
    return False


def _is_checked(value: Expr | None, asked: Asked) -> bool:
    """Whether a statement is a check of what is asked: `CHECK(nh.getParam("a", a)) << "none"`."""
    while isinstance(value, Op) and value.op == "<<":
        value = value.operands[0]
    if not isinstance(value, Call) or dotted_name(value.callee) not in shipped_names(_CHECKS, "cpp"):
        return False
    return any(asked.is_in(part) for each in value.args for part in _parts(each, "&&"))


def _negated(test: Expr) -> Iterator[Expr]:
    """What is not so in any of the cases of a test."""
    return (part.operands[0] for part in _parts(test, "||") if isinstance(part, Op) and part.op == "!")


def _parts(test: Expr, word: str) -> Iterator[Expr]:
    if isinstance(test, Op) and test.op == word:
        for each in test.operands:
            yield from _parts(each, word)
    else:
        yield test


def _ends(block: Block, call: Invocation, language: str) -> bool:
    """Whether a block surely throws what nobody in the function catches, or ends the program."""
    for step in block:
        if isinstance(step, Leave):
            return step.how == "throw"
        if not isinstance(step, int):
            return False
        if _is_end(call.func.fact.body[step].value, language):
            return True
    return False


def _is_end(value: Expr | None, language: str) -> bool:
    """Whether a call never returns, as `exit` does."""
    found = operation(value, language) if value is not None else None
    return found is not None and found.when == _ALWAYS
