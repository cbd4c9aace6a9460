"""What must hold where a place is reached: the tests of the branches on the way, as conditions of a contract."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from itertools import chain
from typing import NamedTuple

from ecm_checker.hub.condition import Condition, text_of
from ecm_parsers.source.expr import Call, Constant, Expr, Member, Name, Op, Opaque

from ecm_extract.infer.compute import NULL, is_number
from ecm_extract.infer.held import Turn, common_path
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.choosing import asked_before
from ecm_extract.link.code.expression_text import expression_text
from ecm_extract.link.code.numbers import NUMBERS
from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.walk import children, last_of
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.defaults import Asked
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.in_order import TAKEN_FIRST
from ecm_extract.link.running.surely_held import surely_held
from ecm_extract.link.running.values import Value, is_proved, is_setting
from ecm_extract.shipped import shipped_names

_MACRO = "#if "
_SEVERAL = "..."
_SAME = frozenset({"==", "!="})
_MORE = frozenset({">", "!=", ">="})
_TRUTHS = frozenset({"bool", *NUMBERS})
"""Types of C++ whose values are true or not; of all others a test asks whether there is an object."""


class Told(NamedTuple):
    """A condition, and the variables that it asks for as the source calls them."""

    condition: Condition
    asks: frozenset[str] = frozenset()


@cache
def _names(table: str) -> frozenset[str]:
    return shipped_names("link/endpoints/conditions.toml", table)


class Conditions:
    """Says what the branches ask that lead to a place; parameters and topics are called as the source calls them."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._told: dict[Turn, tuple[Told, ...]] = {}

    def of(self, call: Invocation, env: Env) -> tuple[Told, ...]:
        """Return what must hold where a call is evaluated: the branches around its statement, and the tests in it."""
        turns = self.folder.flow.decisions.turns(common_path(self.folder.flow.reached(env)))
        around = (told for turn in turns for told in self._of_turn(turn))
        within = (told for asked in asked_before(call) for told in self._tested(asked.test, asked.holds, env))
        return tuple(dict.fromkeys(chain(around, within)))

    def asked(self, call: Invocation, env: Env) -> Iterator[Asked]:
        """Yield what was asked of parameters where a call is evaluated."""
        known = self.folder.asked
        yield from known.at(env)
        for asked in asked_before(call):
            yield from known.on(asked.test, asked.holds, env)

    def _of_turn(self, turn: Turn) -> tuple[Told, ...]:
        known = self._told.get(turn)
        if known is None:
            known = self._told[turn] = tuple(self._of_side(turn))
        return known

    def _of_side(self, turn: Turn) -> Iterator[Told]:
        """Nothing where a run fails otherwise; behind what ends a function early, what somebody outside decides."""
        if turn.test is None or turn.env is None or turn.left == "throw":
            return
        for told in self._tested(turn.test, turn.holds, turn.env):
            if not turn.left or told.condition.tests != "expression":
                yield told

    def _tested(self, test: Expr, holds: bool, env: Env) -> Iterator[Told]:
        if isinstance(test, Op) and test.op == "!":
            yield from self._tested(test.operands[0], not holds, env)
        elif isinstance(test, Op) and test.op == ("&&" if holds else "||"):
            for operand in test.operands:
                yield from self._tested(operand, holds, env)
        elif isinstance(test, Op) and test.op in {"&&", "||"}:
            yield from self._one_of(test, holds, env)
        else:
            yield from self._leaf(test, holds, env)

    def _one_of(self, test: Op, holds: bool, env: Env) -> Iterator[Told]:
        """One of several things is enough; where one of them says nothing, all of it says nothing."""
        groups = [list(self._tested(operand, holds, env)) for operand in test.operands]
        if all(groups):
            text = " or ".join(text_of(told.condition for told in group) for group in groups)
            asks = frozenset(name for group in groups for told in group for name in told.asks)
            yield Told(Condition("expression", text), asks)

    def _leaf(self, test: Expr, holds: bool, env: Env) -> Iterator[Told]:
        condition = self._condition(test, env)
        if condition is not None:
            yield Told(condition if holds else condition.opposite, frozenset(_variables(test)))
            return
        behind = self._behind(test, env)
        if behind is not None:
            yield from self._tested(behind.expr, holds, behind.env)
        elif self._says_something(test, env):
            written = self._written(test, env)
            yield Told(written if holds else written.opposite, frozenset(_variables(test)))

    def _condition(self, test: Expr, env: Env) -> Condition | None:
        """What somebody outside of the program decides."""
        if isinstance(test, Opaque) and test.text.startswith(_MACRO):
            return Condition("macro", test.text.removeprefix(_MACRO))
        return self._of_listeners(test, env) or self._of_parameter(test, env)

    def _behind(self, test: Expr, env: Env) -> Bound | None:
        """The test that a variable holds the answer of: `const bool both = a && b; if (both)`."""
        found = surely_held(test, env, self.folder.flow)
        return found if found is not None and isinstance(found.expr, Op) else None

    def _says_something(self, test: Expr, env: Env) -> bool:
        """Whether a test is more than whether something is there already, or whether the program runs at all."""
        if any(last_of(call.callee) in _names("asking") for call in _calls(test)) or _names("always") & _variables(
            test
        ):
            return False
        if isinstance(test, Op) and test.op in _SAME and Constant("null") in test.operands:
            return False
        bare = isinstance(test, Name | Member) and env.func.file.language == "cpp"
        return not bare or plain(self.folder.objects.type_of(test, env)) in _TRUTHS

    def _of_listeners(self, test: Expr, env: Env) -> Condition | None:
        """Whether a publisher has listeners, told by the variable that holds it."""
        asked = test.operands[0] if isinstance(test, Op) and test.op in _MORE else test
        held = surely_held(asked, env, self.folder.flow)
        calls = _calls(held.expr if held is not None else asked)
        publishers = [
            base for call in calls if last_of(call.callee) in _names("listeners") for base in _receivers(call)
        ]
        return Condition("listeners", key_of(publishers[0])) if publishers else None

    def _of_parameter(self, test: Expr, env: Env) -> Condition | None:
        if isinstance(test, Op) and test.op in _SAME and len(test.operands) == 2:
            return self._compared(test, env)
        if isinstance(test, Call) and last_of(test.callee) == "empty" and isinstance(test.callee, Member):
            name = self._parameter(test.callee.base, env)
            return Condition("parameter", name, wanted="") if name else None
        name = self._parameter(test, env)
        return _true(name, self.folder.fold(test, env)) if name else None

    def _compared(self, test: Op, env: Env) -> Condition | None:
        """`mode == "fast"`: a parameter with a value that is known."""
        for one, other in (test.operands, test.operands[::-1]):
            name = self._parameter(one, env)
            values = self.folder.fold(other, env) if name else ()
            if len(values) == 1 and is_proved(values[0]) and values[0].data is not NULL:
                return _having(name, values[0], test.op == "!=")
        return None

    def _parameter(self, expr: Expr, env: Env) -> str:
        """The ROS parameter that an expression has the value of, empty for none."""
        if not isinstance(expr, Name | Member | Call) or _writes(expr) or self._is_untold(expr, env):
            return ""
        found = {value.parameter for value in self.folder.fold(expr, env)}
        return found.pop() if len(found) == 1 else ""

    def _is_untold(self, expr: Expr, env: Env) -> bool:
        return self.folder.untold.has(expr, env.func, env.at)

    def _written(self, test: Expr, env: Env) -> Condition:
        return Condition("expression", self._text(test, env))

    def _text(self, expr: Expr, env: Env) -> str:
        python = env.func.file.language == "python"
        return expression_text(expr, python, lambda part: self._called(part, env))

    def _called(self, part: Expr, env: Env) -> str:
        if isinstance(part, Name) and part.id.startswith(TAKEN_FIRST):
            return self._as_written(part, env)
        name = self._parameter(part, env)
        return Condition("parameter", name).text if name else ""

    def _as_written(self, name: Name, env: Env) -> str:
        """What stands in the source where a variable does that none of its own: a part taken before the others."""
        values = [entry.value for entry in env.func.fact.body if entry.target == name]
        return self._text(values[0], env) if len(values) == 1 and values[0] is not None else _SEVERAL


def key_of(expr: Expr) -> str:
    """Return a variable or member of the object at hand by its name, others by what they are asked of."""
    return expression_text(expr, python=False)


def _having(name: str, value: Value, negated: bool) -> Condition:
    if isinstance(value.data, bool):
        return Condition("parameter", name, negated=negated is value.data)
    return Condition("parameter", name, value.text, negated)


def _true(name: str, values: Sequence[Value]) -> Condition | None:
    """What makes a parameter count as true: being so, or being any text at all; None for numbers."""
    if any(is_number(value.data) for value in values):
        return None
    texts = all(value.data is None and not is_setting(value) for value in values)
    return Condition("parameter", name, "", negated=True) if texts else Condition("parameter", name)


def _writes(expr: Expr) -> bool:
    """Whether a read tells if the parameter is set, and gives its value to a variable: `getParam("x", x)`."""
    return isinstance(expr, Call) and last_of(expr.callee) in _names("asking") and len(expr.args) > 1


def _receivers(call: Call) -> tuple[Expr, ...]:
    return (call.callee.base,) if isinstance(call.callee, Member) else ()


def _calls(expr: Expr) -> Iterator[Call]:
    if isinstance(expr, Call):
        yield expr
    for part in children(expr):
        yield from _calls(part)


def _variables(expr: Expr) -> set[str]:
    """The variables and members that an expression mentions, as the source calls them."""
    found = {key_of(expr)} if isinstance(expr, Name | Member) else set()
    return found.union(*(_variables(part) for part in children(expr)))
