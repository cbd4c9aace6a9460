"""Optionals of C++: whether they hold anything, and what stands for them where they do not."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Constant, Expr, Items, Member, Name, Number, Op, Template, Text

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.numbers import kind_of_type
from ecm_extract.link.code.pointed import pointed
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.folding.begun_fields import begun_with
from ecm_extract.link.running.env import MAX_DEPTH, Env, invocation_of
from ecm_extract.link.running.values import Value, alternatives, constant, demoted, unknown, without_defaults

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_TYPE: Final = "optional"
_NOTHING: Final = frozenset({"nullopt", "none"})
"""en.cppreference.com, std::nullopt; boost.org, boost::none."""
_POINTERS: Final = frozenset({"unique_ptr", "shared_ptr"})
"""en.cppreference.com: one that is declared without a value points to nothing."""
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
        if not (self._is_one(call.receiver, env) or _is_nothing(call.receiver)):
            return None
        if call.last == "has_value":
            has = self.holds(call.receiver, env)
            return (unknown(call.last),) if has is None else demoted((constant(has),))
        rest = call.args if call.last == "value_or" else ()
        return self._value(call.receiver, rest, env)

    def holds(self, expr: Expr, env: Env) -> bool | None:
        """Tell whether an optional holds anything; None where that is not decided, and for all other things."""
        if not isinstance(expr, Name | Member):
            return None
        if not self._is_one(expr, env):
            return self._points(expr, env)
        found = {self._is_full(held) for held in self._helds(expr, env)}
        return found.pop() if len(found) == 1 else None

    def _points(self, expr: Name | Member, env: Env) -> bool | None:
        """Whether a smart pointer of the function at hand points to anything; None where that is not decided."""
        written = env.func.written_types.get(self.folder.flow.effects(env.func).key(expr), "")
        helds = {held for way in self.folder.flow.ways(expr, env) for held in way}
        declared = last_name(plain(written)) in _POINTERS
        found = {False if declared and held.how == "made" else _makes(held) or None for held in helds}
        return found.pop() if len(found) == 1 else None

    def _value(self, expr: Expr, rest: tuple[Expr, ...], env: Env) -> tuple[Value, ...]:
        """What it holds, else what is given instead."""
        if isinstance(expr, Call):
            return self._given_by(expr, rest, env)
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

    def _given_by(self, expr: Call, rest: tuple[Expr, ...], env: Env) -> tuple[Value, ...]:
        """What an optional holds that a function of the tree gives, or that is made on the spot."""
        values: list[Value] = []
        for given, place in [(expr, env)] if _is_nothing(expr) else self._returned(expr, env):
            full = self._gives(given, place)
            instead = [value for arg in rest for value in self.folder.fold(arg, env)]
            values += [unknown("value")] if full is None else self.folder.fold(given, place) if full else instead
        return alternatives(demoted(values)) or (unknown("value"),)

    def _returned(self, expr: Call, env: Env) -> list[tuple[Expr, Env]]:
        """What a call of a function of the tree gives back; nothing of other calls."""
        call = invocation_of(expr, env)
        callee = self.folder.returns.meant(call, env) if env.depth < MAX_DEPTH else None
        return self.folder.returns.returned(callee, call, env.deeper(env.depth + 1)) if callee is not None else []

    def _helds(self, expr: Expr, env: Env) -> list[Held]:
        ways = self.folder.flow.ways(expr, env) if isinstance(expr, Name | Member) else []
        found = [held for way in ways for held in way]
        if all(held.how in _ELSEWHERE for held in found):
            found = self.folder.origins.of(expr, env) or self._of_object(expr, env)
        return list(dict.fromkeys(found))

    def _of_object(self, expr: Expr, env: Env) -> list[Held]:
        """What a field holds of an object that the function has, which is as that was made."""
        own = self.folder.flow.effects(env.func).key(expr).startswith(".")
        if not isinstance(expr, Member) or own or env.depth > MAX_DEPTH:
            return []
        made = self.folder.structures.made(expr, env) or begun_with(expr, env, self.folder)
        if made is not None and isinstance(made.expr, Name | Member):
            return self._helds(made.expr, made.env.deeper(env.depth + 1))
        return [Held("value", expr.name, made.expr, made.env)] if made is not None else []

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
        if expr is not None and self._is_value(expr, env):
            return True
        if isinstance(expr, Name | Member) and self._is_one(expr, env) and env.depth < MAX_DEPTH:
            return self.holds(expr, env.deeper(env.depth + 1))
        given = self._returned(expr, env) if isinstance(expr, Call) else []
        found = {self._gives(value, place) for value, place in given}
        return found.pop() if len(found) == 1 else None

    def _is_value(self, expr: Expr, env: Env) -> bool:
        """Whether an expression is a text or a number, and no optional."""
        if isinstance(expr, Text | Number | Template) or (isinstance(expr, Constant) and expr.name != "null"):
            return True
        if isinstance(expr, Op) and expr.op not in _NO_VALUE_OF_ITS_OWN:
            return True
        if isinstance(expr, Call) and invocation_of(expr, env).last in _MAKING_TEXT:
            return True
        return bool(kind_of_type(self.folder.objects.type_of(expr, env.before(env.at))))


def _makes(held: Held) -> bool:
    """Whether a pointer was given an object that was made for it."""
    return held.how == "value" and isinstance(held.expr, Call) and bool(pointed(held.expr))


def _is_nothing(expr: Expr | None) -> bool:
    """Whether an expression is `std::nullopt`, `{}`, or an optional that is made of nothing."""
    if isinstance(expr, Name):
        return last_name(expr.id) in _NOTHING
    if isinstance(expr, Items):
        return not expr.items
    made = expr.callee if isinstance(expr, Call) and not expr.args else None
    return isinstance(made, Name) and last_name(made.id) == _TYPE
