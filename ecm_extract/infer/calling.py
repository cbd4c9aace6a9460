"""What the calls of a statement do to variables."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Member, Name, Text

from ecm_extract.infer.effects import Effect, is_plain
from ecm_extract.infer.held import Held, State
from ecm_extract.infer.memory import Memory
from ecm_extract.infer.run import Frame

if TYPE_CHECKING:
    from ecm_extract.link.env import Env


class Calling:
    """Applies the effects of calls."""

    def __init__(self, frame: Frame, memory: Memory) -> None:
        self.frame = frame
        self.memory = memory

    def after(self, at: int, state: State, env: Env) -> State:
        """Return the state after the calls of a statement."""
        for effect in self.frame.effects.of(at):
            state = self._apply(effect, at, env, state)
        waits = any(self._waits(call) for call in self.frame.env.func.calls[at])
        if waits or self.frame.judge.reaches_object(env):
            state = self.memory.given_again([key for key in state.holds if key.startswith(".")], state)
            state = replace(state, called=True)
        if waits or self.frame.effects.own_calls(at):
            outside = [key for key in state.holds if self.memory.is_open(key) and not key.startswith(".")]
            state = self.memory.given_again(outside, state)
        return state

    def _apply(self, effect: Effect, at: int, env: Env, state: State) -> State:
        before = self.memory.known(effect.key, state, env)
        if effect.kind == "handed" and all(self._keeps_its_text(held) for held in before):
            return state
        how = effect.kind
        name = effect.name if how == "out" else effect.key
        return self.memory.in_place(effect.key, Held(how, name, effect.call, env, at, before=before), state)

    def _keeps_its_text(self, held: Held) -> bool:
        """Whether nobody who gets a value can change it: texts and numbers of Python, literals of C++."""
        if held.how != "value" or not is_plain(held.expr):
            return False
        written = self.frame.body[held.at].type if 0 <= held.at < len(self.frame.body) else ""
        return self.frame.python or (isinstance(held.expr, Text) and (written == "auto" or "*" in written))

    def _waits(self, call: Call) -> bool:
        callee = call.callee
        last = callee.name if isinstance(callee, Member) else callee.id if isinstance(callee, Name) else ""
        return last.rsplit("::", 1)[-1] in self.frame.effects.calls.waiting
