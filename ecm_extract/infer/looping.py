"""Loops: over what is known round by round, others once with what their body changes unknown."""

from __future__ import annotations

from collections.abc import Collection

from ecm_parsers.source.expr import Constant, Expr, Number
from ecm_parsers.source.flow import Leave, Loop, statements, steps

from ecm_extract.infer.assigning import Assigning
from ecm_extract.infer.branching import Blocks
from ecm_extract.infer.comprehending import Comprehending
from ecm_extract.infer.exits import Exits
from ecm_extract.infer.held import MAX_WAYS, Held, State, all_ways, joined_states
from ecm_extract.infer.run import MAX_ITEMS, MAX_ROUNDS, MAX_STEPS, Frame


class Looping:
    """Runs loops."""

    def __init__(
        self, frame: Frame, exits: Exits, assigning: Assigning, comprehending: Comprehending, blocks: Blocks
    ) -> None:
        self.frame = frame
        self.exits = exits
        self.memory = assigning.memory
        self.assigning = assigning
        self.comprehending = comprehending
        self.calling = comprehending.choosing.calling
        self.blocks = blocks

    def run(self, loop: Loop, state: State) -> State | None:
        """Run a loop; None when no way leads out of it."""
        if loop.each >= 0 and self.frame.follows:
            return self._over(loop, state)
        return self._while(loop, state) if loop.test is not None and self.frame.unrolls else self._blur(loop, state)

    def _over(self, loop: Loop, state: State) -> State | None:
        each, self.frame.at = self.frame.body[loop.each], loop.each
        rounds = self.frame.judge.rounds(each.value, self.frame.place(state)) if each.value is not None else None
        if rounds is None or len(rounds) > MAX_ITEMS:
            return self._blur(loop, state)
        self.calling.giving.note(each, loop.each, self.frame.place(state), state)
        state = self._begun(loop, state)
        self.assigning.enter(each, state)
        self.exits.enter_loop()
        current: State | None = state
        for item, path in rounds:
            if current is None:
                break
            bound = self.assigning.known_element(each, item, loop.each, current)
            if not path:
                current = self._round(loop, bound)
                continue
            after = self._round(loop, bound.along((*bound.path, *path)))
            current = joined_states([current, after])
        if not rounds:
            self.blocks.unreached(loop.body, self.assigning.element(each, loop.each, state))
        return self._exit(loop, current)

    def _begun(self, loop: Loop, state: State) -> State:
        """The state after what a loop is over was asked for, which is done once."""
        self.frame.at = loop.each
        return self.comprehending.after(self.frame.body[loop.each], loop.each, state)

    def _round(self, loop: Loop, state: State) -> State | None:
        """Run the body once; what comes after a way out that may have been taken is not certain any more."""
        before = self._left()
        self.frame.rounds += 1
        after = self.blocks.run(loop.body, state)
        after = joined_states([after, *self.exits.next_round()])
        after = self.blocks.run(loop.step, after) if after is not None else None
        self.frame.rounds -= 1
        return self.frame.undecided(after) if after is not None and self._left() > before else after

    def _exit(self, loop: Loop, state: State | None) -> State | None:
        broken = self.exits.end_loop()
        state = self.blocks.run(loop.other, state) if state is not None else None
        return joined_states([*broken, state])

    def _while(self, loop: Loop, state: State) -> State | None:
        """Run rounds while the condition is decided; one that never ends by it, while it is decided what ends it."""
        assert loop.test is not None
        endless = self._is_endless(loop, state)
        if endless and not self._may_be_left(loop):
            return self._blur(loop, state)
        self.exits.enter_loop()
        current = state
        for count in range(MAX_ROUNDS + 1):
            holds = True if loop.first and not count else self.frame.judge.truth(loop.test, self.frame.place(current))
            if holds is False:
                if not count:
                    self.blocks.unreached(loop.body, current)
                return self._exit(loop, current)
            if holds is None or count == MAX_ROUNDS or self.frame.steps > MAX_STEPS:
                counted = self._counted(loop, loop.test, current) if not count else ()
                return self._exit(loop, self._blur(loop, current, counted))
            before = self._left()
            after = self._round(loop, current)
            if after is None:
                return self._exit(loop, None)
            current = after
            if endless and self._left() > before:
                return self._exit(loop, self._blur(loop, current))
        return self._exit(loop, current)

    def _left(self) -> int:
        """How many ways out of the loop at hand were found so far."""
        return self.exits.broken() + self.exits.ways_out

    def _is_endless(self, loop: Loop, state: State) -> bool:
        """Whether what a loop asks holds in all rounds: `while True`."""
        fixed = isinstance(loop.test, Constant | Number)
        return fixed and loop.test is not None and self.frame.judge.truth(loop.test, self.frame.place(state)) is True

    def _may_be_left(self, loop: Loop) -> bool:
        """Whether something in a loop may end it; otherwise no round tells more than any."""
        ends = any(isinstance(step, Leave) and step.how != "continue" for step in steps(loop.body))
        return ends or any(self.frame.body[at].kind == "return" for at in statements(loop.body))

    def _counted(self, loop: Loop, test: Expr, state: State) -> Collection[str]:
        """What counts the rounds of a loop that has none as long as nobody sets a parameter."""
        begins = loop.first or self.frame.judge.likely(test, self.frame.place(state)) is not False
        return () if begins else self.memory.changed_in(loop.step)

    def _blur(self, loop: Loop, state: State, counted: Collection[str] = ()) -> State | None:
        """Run the body once with what it changes unknown, which stands for any number of rounds.

        `counted`: what counts the rounds where none is the first to tell.
        """
        if loop.each >= 0:
            state = self._begun(loop, state)
            self.assigning.enter(self.frame.body[loop.each], state)
        before, changed = self.calling.before_rounds((*loop.body, *loop.step), state)
        changed |= {key for block in (loop.body, loop.step) for key in self.memory.changed_in(block)}
        start = self.memory.lost(before, changed)
        heads = {key: start.holds[key][0] for key in changed}
        self.exits.enter_loop()
        inside = self.frame.undecided(start)
        if loop.each >= 0:
            inside = self.assigning.element(self.frame.body[loop.each], loop.each, inside)
        self.frame.blurred += 1
        after = joined_states([self.blocks.run(loop.body, inside), *self.exits.next_round()])
        if after is not None:
            after = self.blocks.run(loop.step, after)
        self.frame.blurred -= 1
        ends = after.holds if after is not None else {}
        for key, head in heads.items():
            known = () if key in counted else self.memory.known(key, before, None)
            self._close(head, known, ends.get(key, ()))
        return self._exit(loop, joined_states([*([state] if counted else []), start, after]))

    def _close(self, head: Held, before: tuple[Held, ...], after: tuple[Held, ...]) -> None:
        """What a variable holds when a round begins: what it held before the loop, or what a round left."""
        ways = tuple(dict.fromkeys([*all_ways(before), *(held for held in all_ways(after) if held is not head)]))
        if len(ways) <= MAX_WAYS and head.name not in self.memory.escaped:
            head.how, head.before = "looped", ways
            head.settled.clear()
            self.memory.sharing.consisting.loop_ended()
