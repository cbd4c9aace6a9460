"""What a run that gets to a place asked of parameters: behind `if (!name.empty())` no empty default is left.

Behind `if (mode == "gui")` the parameter is that text. A parameter stays what it is while a function runs, so it
counts whatever variable has its value by then.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import msgspec
from ecm_parsers.source.expr import Call, Expr, Member, Name, Op, Text

from ecm_extract.infer.held import Turn, common_path
from ecm_extract.link.code.walk import calls_in
from ecm_extract.link.running.defaults import Asked, by_asked, default_of, stated
from ecm_extract.link.running.env import MAX_DEPTH, Env
from ecm_extract.link.running.surely_held import surely_held
from ecm_extract.link.running.values import OfParameter, Value, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

Answers = frozenset[Asked]
_NONE: Final = Answers()
_EQUAL: Final = frozenset({"==", "!="})


class AskedParameters:
    """Tells them, for each side of a branch once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[Turn, Answers] = {}
        self._asked: set[Turn] = set()

    def forget(self) -> None:
        """Drop what was found, since more is known of parameters now."""
        self._known.clear()

    def at(self, env: Env) -> Answers:
        """Return what every run that gets to a place has asked."""
        return _NONE.union(*[self._by(turn) for turn in common_path(self.folder.flow.reached(env))])

    def by_asked(self, values: tuple[Value, ...], env: Env | None) -> tuple[Value, ...]:
        """Return the values that an expression has in one state, open where they have a default that is not there."""
        if env is None or env.state is None or not any(value.template for value in values):
            return values
        asked = {each for each in self.at(env) if each.text is None}  # what it is, who knows all parameters tells
        return tuple([by_asked(value, asked) for value in values])

    def _by(self, turn: Turn) -> Answers:
        """What one side of a branch has asked; nothing for who asks in a circle."""
        known = self._known.get(turn)
        if known is not None or turn.gate is None:
            return known or _NONE
        if turn in self._asked:
            self.folder.cuts += 1
            return _NONE
        cuts = self.folder.cuts
        self._asked.add(turn)
        found = self.on(turn.gate.test, turn.holds, turn.gate.env)
        self._asked.discard(turn)
        if cuts == self.folder.cuts:
            self._known[turn] = found
        return found

    def on(self, test: Expr, holds: bool, env: Env) -> Answers:
        """Return what is known of parameters where a test holds, or does not."""
        if isinstance(test, Op) and test.op == "!":
            return self.on(test.operands[0], not holds, env)
        if isinstance(test, Op) and test.op in {"&&", "||"}:
            sides = [self.on(operand, holds, env) for operand in test.operands]
            return _NONE.union(*sides) if (test.op == "&&") is holds else sides[0].intersection(*sides)
        if isinstance(test, Op) and test.op in _EQUAL and (test.op == "==") is holds:
            same = self._same(test.operands, env)
            if same is not None:
                return frozenset({same})
        if not self._is_plain(test, env):
            return _NONE
        defaults = set[OfParameter]()
        unset = self._unset(test, env, defaults)
        if len(defaults) != 1 or self.folder.flow.truths.holds(unset, env) is not (not holds):
            return _NONE
        return frozenset([Asked(part) for part in defaults])

    def _same(self, operands: tuple[Expr, ...], env: Env) -> Asked | None:
        """The parameter that one side is, with the text that the other side is, unless that is its default."""
        for asked, text in (operands, operands[::-1]):
            values = self.folder.fold(asked, env) if _is_text(text) and not isinstance(asked, Text) else ()
            part = values[0].template[0] if len(values) == 1 and len(values[0].template) == 1 else None
            if isinstance(part, OfParameter) and isinstance(text, Text) and part.default != (text.value,):
                return Asked(part, text.value)
        return None

    def _is_plain(self, test: Expr, env: Env) -> bool:
        """Whether a test asks for nothing that functions of the tree give: to follow these is what takes time."""
        flow = self.folder.flow
        own = (flow.target(call, env.func, env.at) for call in calls_in(test))
        return flow.truths.may_know(test, env) and all(target is None for target in own)

    def _unset(self, expr: Expr, env: Env, defaults: set[OfParameter]) -> Expr:
        """What stands for an expression as long as nobody sets its parameters, and what these are then."""
        if isinstance(expr, Op):
            return Op(expr.op, self._all_unset(expr.operands, env, defaults))
        if not isinstance(expr, Name | Member | Call) or env.depth >= MAX_DEPTH:
            return expr
        values = self.folder.fold(expr, env)
        default = default_of(values[0]) if len(values) == 1 else None
        if default is not None:
            defaults.add(default.part)
            return default.value
        if isinstance(expr, Call):
            return self._call_unset(expr, env, defaults)
        return self._held_unset(expr, env, defaults)

    def _all_unset(self, exprs: tuple[Expr, ...], env: Env, defaults: set[OfParameter]) -> tuple[Expr, ...]:
        return tuple([self._unset(each, env, defaults) for each in exprs])

    def _call_unset(self, call: Call, env: Env, defaults: set[OfParameter]) -> Call:
        """A call by what it is given: `name.empty()`, `bool(name)`."""
        args = self._all_unset(call.args, env, defaults)
        if not isinstance(call.callee, Member):
            return msgspec.structs.replace(call, args=args)
        callee = Member(self._unset(call.callee.base, env, defaults), call.callee.name)
        return msgspec.structs.replace(call, callee=callee, args=args)

    def _held_unset(self, expr: Expr, env: Env, defaults: set[OfParameter]) -> Expr:
        """A variable by what it was given: `named = name != ""`."""
        held = surely_held(expr, env, self.folder.flow)
        if held is None or not self._is_plain(held.expr, held.env):
            return expr
        inner = held.env.deeper(env.depth + 1)
        values = self.folder.fold(self._unset(held.expr, inner, defaults), inner)
        return stated(values[0]) if len(values) == 1 and is_proved(values[0]) else expr


def _is_text(expr: Expr) -> bool:
    return isinstance(expr, Text) and not expr.is_character
