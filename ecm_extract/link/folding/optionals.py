"""Optionals of C++: whether they hold anything, and what stands for them where they do not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Constant, Expr, Items, Member, Name, Number, Op, Template, Text

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.numbers import kind_of_type
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.values import Value, alternatives, constant, demoted, unknown, without_defaults

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_TYPE: Final = "optional"
_NOTHING: Final = frozenset({"nullopt", "none"})
"""en.cppreference.com, std::nullopt; boost.org, boost::none."""
_ELSEWHERE: Final = frozenset({"given", "shared", "handed"})
"""Ways to hold an optional that the function at hand does not decide."""
_MAKING_TEXT: Final = frozenset({"string", "to_string", "substr", "append", "c_str", "str"})
_NO_VALUE_OF_ITS_OWN: Final = frozenset({"[]", "&", "*", "?:"})


class OptionalFolder:
    """Evaluates optionals."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def called(self, call: Invocation, env: Env) -> tuple[Value, ...] | None:
        """Methods of optionals that ask for what they hold; None for other calls."""
        if call.last not in {"value_or", "has_value", "value"} or call.receiver is None:
            return None
        if not self._is_one(call.receiver, env):
            return None
        if call.last == "has_value":
            has = self.holds(call.receiver, env)
            return (unknown(call.last),) if has is None else demoted((constant(has),))
        rest = call.args if call.last == "value_or" else ()
        return self._value(call.receiver, rest, env)

    def holds(self, expr: Expr, env: Env) -> bool | None:
        """Tell whether an optional holds anything; None where that is not decided, and for all other things."""
        if not isinstance(expr, Name | Member) or not self._is_one(expr, env):
            return None
        found = {self._is_full(held) for held in self._helds(expr, env)}
        return found.pop() if len(found) == 1 else None

    def _value(self, expr: Expr, rest: tuple[Expr, ...], env: Env) -> tuple[Value, ...]:
        """What it holds, else what is given instead."""
        values: list[Value] = []
        helds = self._helds(expr, env)
        if not helds:  # whoever calls, or makes the object, knows
            left = tuple(map(without_defaults, self.folder.fold(expr, env)))
            return left if all(value.open("param") | value.open("made") for value in left) else (unknown("value"),)
        for held in helds:
            full = self._is_full(held)
            values += [unknown("value")] if full is None else self.folder.held.values(held, env) if full else []
        instead = [value for arg in rest for value in self.folder.fold(arg, env)]
        empty = any(self._is_full(held) is False for held in helds)
        return alternatives(demoted([*values, *(instead if empty else [])])) or (unknown("value"),)

    def _helds(self, expr: Expr, env: Env) -> list[Held]:
        ways = self.folder.flow.ways(expr, env) if isinstance(expr, Name | Member) else []
        found = [held for way in ways for held in way]
        if all(held.how in _ELSEWHERE for held in found):
            found = self.folder.origins.of(expr, env)
        return list(dict.fromkeys(found))

    def _is_one(self, expr: Expr, env: Env) -> bool:
        if env.func.file.language != "cpp":
            return False
        return last_name(plain(self.folder.objects.type_of(expr, env))) == _TYPE

    def _is_full(self, held: Held) -> bool | None:
        """Whether an optional holds anything; None where that is not known."""
        if held.how == "made":
            return False
        return self._gives(held.expr, held.env) if held.how == "value" and held.env is not None else None

    def _gives(self, expr: Expr | None, env: Env) -> bool | None:
        """Whether an optional that is given something holds a value then; a variable may be an optional as well."""
        if _is_nothing(expr):
            return False
        if isinstance(expr, Op) and expr.op == "?:":
            found = {self._gives(operand, env) for operand in expr.operands[1:]}
            return found.pop() if len(found) == 1 else None
        if isinstance(expr, Call) and last_name(invocation_of(expr, env).path) == _TYPE and len(expr.args) == 1:
            return self._gives(expr.args[0], env)
        return True if expr is not None and self._is_value(expr, env) else None

    def _is_value(self, expr: Expr, env: Env) -> bool:
        """Whether an expression is a text or a number, and no optional."""
        if isinstance(expr, Text | Number | Template) or (isinstance(expr, Constant) and expr.name != "null"):
            return True
        if isinstance(expr, Op) and expr.op not in _NO_VALUE_OF_ITS_OWN:
            return True
        if isinstance(expr, Call) and invocation_of(expr, env).last in _MAKING_TEXT:
            return True
        return bool(kind_of_type(self.folder.objects.type_of(expr, env.before(env.at))))


def _is_nothing(expr: Expr | None) -> bool:
    """Whether an expression is `std::nullopt`, `{}`, or an optional that is made of nothing."""
    if isinstance(expr, Name):
        return last_name(expr.id) in _NOTHING
    if isinstance(expr, Items):
        return not expr.items
    made = expr.callee if isinstance(expr, Call) and not expr.args else None
    return isinstance(made, Name) and last_name(made.id) == _TYPE
