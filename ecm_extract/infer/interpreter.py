"""Runs a function abstractly: every statement with the states in which it is reached.

Where a condition is decided one side runs, else both and their states join. Loops over what is known are unrolled,
others run once with what their body changes unknown. What is not modelled makes a value unknown, never stale.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Protocol

from ecm_parsers.source.expr import Call, Comprehension, Constant, Expr, Items, Member, Name, Number, Op, Opaque, Text
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Attempt, Block, Branch, Case, Later, Leave, Loop, Step, Switch, blocks, statements

from ecm_extract.infer.effects import Effect, Targets, bare_names, is_plain
from ecm_extract.infer.held import MAX_WAYS, Held, How, State, Turn, joined_states
from ecm_extract.infer.outline import Outline
from ecm_extract.infer.sharing import Sharing
from ecm_extract.link.walk import children

if TYPE_CHECKING:
    from ecm_extract.link.env import Bound, Env
    from ecm_extract.link.units import Func

MAX_ROUNDS = 64
"""Rounds of a loop that are run one by one."""
MAX_STATES = 64
"""States of one statement that are kept apart; beyond, they are joined."""
MAX_STEPS = 4_000
"""Statements that one run may take; beyond, loops are no longer unrolled."""
MAX_NESTING = 60
"""Blocks within blocks that are followed; what is deeper changes its variables in ways that nobody knows."""


class Judge(Targets, Protocol):
    """Who evaluates expressions for a run."""

    def truth(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds; None when that is not decided."""

    def likely(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds as long as nobody sets a parameter; None when that is not known."""

    def alike(self, one: Expr, other: Expr, env: Env) -> bool | None:
        """Tell whether two expressions have the same value; None when that is not decided."""

    def rounds(self, over: Expr, env: Env) -> list[Bound] | None:
        """Return what a loop is over, each element once; None when not all of it is known."""

    def is_own(self, call: Call, env: Env) -> bool:
        """Tell whether a call may run a function of the tree."""

    def reaches_object(self, call: Call, env: Env) -> bool:
        """Tell whether a call of a function of the tree may run a method of the object at hand."""

    def outline(self, func: Func) -> Outline:
        """Return what is known of a function before it runs."""

    def settle(self, held: Held) -> None:
        """Evaluate now, so that a long chain of changes needs no deep recursion later."""


@dataclass(slots=True, eq=False)
class Run:
    """What a function does for one binding of its parameters.

    Attributes:
        states: statement -> the states in which it is reached, live ones first if there are any.
        returns: the reached `return` statements with their states.
        end: the state in which the function is left; None when it never is.
        shown: member or variable outside of functions -> what it holds while other functions may run.
        cut: whether a bound was hit.
    """

    states: dict[int, list[State]] = field(default_factory=lambda: defaultdict(list))
    returns: list[tuple[int, State]] = field(default_factory=list)
    end: State | None = None
    shown: dict[str, list[Held]] = field(default_factory=lambda: defaultdict(list))
    cut: bool = False

    def at(self, at: int) -> list[State]:
        """Return the states of a statement: live ones, else what it would do if it were reached."""
        found = self.states.get(at, [])
        live = [state for state in found if state.live]
        return live or found


class Interpreter:
    """One run of one function.

    Args:
        env: the place of evaluation at the entry: function, arguments, object.
        judge: who evaluates expressions.
        whole: whether conditions are decided and loops unrolled; else every way is taken for possible, which is quick.
    """

    def __init__(self, env: Env, judge: Judge, whole: bool = True) -> None:
        self.whole = whole
        self.env = env
        self.func = env.func
        self.judge = judge
        self.python = self.func.file.language == "python"
        self.body = self.func.fact.body
        self.outline = judge.outline(self.func)
        self.effects = self.outline.effects
        self.run = Run()
        self._escaped: set[str] = set(self.outline.escaped)
        self.sharing = Sharing(self.outline)
        self._breaks: list[list[State]] = []
        self._continues: list[list[State]] = []
        self._raised: list[list[State]] = []
        self._left: list[State] = []
        self._pending: list[int] = []
        self._at = 0
        self._blurred = 0
        self._later = 0
        self._steps = 0
        self._nesting = 0

    def result(self) -> Run:
        """Run the function from its beginning."""
        for key in self._escaped:
            if self._is_open(key):
                self.run.shown[key].append(Held("lost", key))
        end = self._block(self.outline.block, State())
        self.run.end = joined_states([*self._left, *(state for _, state in self.run.returns), end])
        return self.run

    # --- blocks ------------------------------------------------------------------------------------------

    def _block(self, block: Block, state: State | None) -> State | None:
        """Run steps in order; None when no way leads out of their end."""
        if self._nesting >= MAX_NESTING:
            self.run.cut = True
            return self._lost(state, self._changed_in(block)) if state is not None else None
        self._nesting += 1
        before = state
        for at, step in enumerate(block):
            after = self._step(step, state) if state is not None else None
            if after is None:
                self._shadow(block[at + 1 :], state)
                state = None
                break
            state = after
        self._nesting -= 1
        return self._outside_again(block, before, state)

    def _outside_again(self, block: Block, before: State | None, state: State | None) -> State | None:
        """In C++ a variable of a block hides one of the same name around it, until the block ends."""
        if self.python or self._nesting == 0 or before is None or state is None:
            return state
        lets = (self.body[step] for step in block if isinstance(step, int) and self.body[step].kind == "let")
        hidden = {key for entry in lets for key in self.outline.bound_keys(entry.target)}
        return state.having({key: before.holds[key] for key in hidden if key in before.holds})

    def _step(self, step: Step, state: State) -> State | None:
        if isinstance(step, int):
            return self._statement(step, state)
        if isinstance(step, Branch):
            return _behind(step, state, self._branch(step, state))
        if isinstance(step, Loop):
            return self._loop(step, state)
        if isinstance(step, Switch):
            return _behind(step, state, self._switch(step, state))
        if isinstance(step, Attempt):
            return self._attempt(step, state)
        if isinstance(step, Later):
            return self._run_later(step, state)
        self._leave(step, state)
        return None

    def _shadow(self, block: Block, state: State | None) -> None:
        """Follow code that no run reaches, so that what it would do is known too."""
        first = next(statements(block), -1)
        if state is None or first < 0 or first in self.run.states:
            return
        keep = (self._breaks, self._continues, self._raised, self._left, self.run.returns)
        self._breaks, self._continues, self._raised, self._left, self.run.returns = [[]], [[]], [], [], []
        self._blurred += 1
        self._block(block, replace(state, live=False))
        self._blurred -= 1
        self._breaks, self._continues, self._raised, self._left, self.run.returns = keep

    def _truth(self, test: Expr, state: State) -> bool | None:
        return self.judge.truth(test, self._env(state)) if self.whole else None

    def _side(self, test: Expr | None, holds: bool, state: State) -> Turn:
        return Turn(test, holds, self._env(state))

    # --- branches ----------------------------------------------------------------------------------------

    def _branch(self, step: Branch, state: State) -> State | None:
        holds = self._truth(step.test, state)
        if holds is not None:
            self._shadow(step.other if holds else step.then, state)
            return self._block(step.then if holds else step.other, state)
        likely = self.judge.likely(step.test, self._env(state)) if self.whole else None
        then = self._block(step.then, state.on(self._side(step.test, True, state), likely is not False))
        other = self._block(step.other, state.on(self._side(step.test, False, state), likely is not True))
        return joined_states([other, then] if likely is False else [then, other])

    def _switch(self, step: Switch, state: State) -> State | None:
        return self._falling(step, state) if step.falls else self._chosen(step, state)

    def _chosen(self, step: Switch, state: State) -> State | None:
        """The first case that applies runs."""
        rest: State | None = state
        outs: list[State | None] = []
        for case in step.cases:
            holds = self._applies(step.subject, case, state) if rest is not None else False
            if holds is False or rest is None:
                self._shadow(case.body, state)
            elif holds:
                outs.append(self._block(case.body, rest))
                rest = None
            else:
                asked = _question(step.subject, case)
                outs.append(self._block(case.body, rest.on(self._side(asked, True, rest))))
                rest = rest.on(self._side(asked, False, rest))
        return joined_states([*outs, rest])

    def _applies(self, subject: Expr, case: Case, state: State) -> bool | None:
        if not case.tests or not self.whole:
            return None if case.tests else True
        env = self._env(state)
        if subject == Constant("true"):
            return self.judge.truth(case.tests[0], env)
        found = [self.judge.alike(subject, test, env) for test in case.tests]
        return True if True in found else None if None in found else False

    def _falling(self, step: Switch, state: State) -> State | None:
        """From the case that applies on until something leaves."""
        entries = self._entries(step, state)
        self._breaks.append([])
        current: State | None = None
        for case, entry in zip(step.cases, entries, strict=True):
            asked = _question(step.subject, case)
            given = state if entry else state.on(self._side(asked, True, state)) if entry is None else None
            current = joined_states([current, given])
            if current is None:
                self._shadow(case.body, state)
            else:
                current = self._block(case.body, current)
        passed = state if not any(entries) and all(case.tests for case in step.cases) else None
        return joined_states([*self._breaks.pop(), current, passed])

    def _entries(self, step: Switch, state: State) -> list[bool | None]:
        """Whether a run enters each case: the first that surely applies, those before it that may, else the default."""
        found: list[bool | None] = []
        for case in step.cases:
            settled = True in found
            found.append(False if settled or not case.tests else self._applies(step.subject, case, state))
        default = False if True in found else None if None in found else True
        return [default if not case.tests else entry for case, entry in zip(step.cases, found, strict=True)]

    def _attempt(self, step: Attempt, state: State) -> State | None:
        self._raised.append([])
        done = self._block(step.body, state)
        raised = self._raised.pop()
        done = self._block(step.other, done) if done is not None else None
        outs: list[State | None] = [done]
        if step.handlers and not self._may_raise(step.body):
            for handler in step.handlers:
                self._shadow(handler, state)
        elif step.handlers:
            caught = joined_states([state, *raised])
            start = caught if caught is not None else state
            outs += [self._block(handler, start.on(Turn())) for handler in step.handlers]
        met = joined_states(outs)
        if met is None:
            self._block(step.final, (joined_states([state, *raised]) or state).on(Turn()))
            return None
        return self._block(step.final, met)

    def _may_raise(self, block: Block) -> bool:
        return any(not isinstance(step, int) or _raises(self.body[step].value) for step in block)

    def _leave(self, step: Leave, state: State) -> None:
        if step.how == "break" and self._breaks:
            self._breaks[-1].append(state)
        elif step.how == "continue" and self._continues:
            self._continues[-1].append(state)
        elif step.how == "throw":
            for frame in self._raised:
                frame.append(state)
        elif step.how == "return" and not self._later:
            self._left.append(state)

    # --- loops -------------------------------------------------------------------------------------------

    def _loop(self, loop: Loop, state: State) -> State | None:
        if self._blurred or self._steps > MAX_STEPS or not self.whole:
            return self._blur(loop, state)
        if loop.each >= 0:
            return self._over(loop, state)
        return self._while(loop, state) if loop.test is not None else self._blur(loop, state)

    def _over(self, loop: Loop, state: State) -> State | None:
        each = self.body[loop.each]
        items = self.judge.rounds(each.value, self._env(state)) if each.value is not None else None
        if items is None or len(items) > MAX_ROUNDS:
            return self._blur(loop, state)
        self._record(loop.each, state)
        self.sharing.enter(each)
        self._enter()
        current: State | None = state
        for item in items:
            if current is None:
                break
            current = self._bind(each.target, Held("value", "", item.expr, item.env, loop.each), current)
            current = self._round(loop, current)
        if not items:
            self._shadow(loop.body, self._element(each, loop.each, state))
        return self._exit(loop, current)

    def _enter(self) -> None:
        self._breaks.append([])
        self._continues.append([])

    def _round(self, loop: Loop, state: State) -> State | None:
        """Run the body once; what comes after a way out that may have been taken is not certain any more."""
        broken = len(self._breaks[-1])
        after = self._block(loop.body, state)
        after = joined_states([after, *self._continues[-1]])
        self._continues[-1].clear()
        after = self._block(loop.step, after) if after is not None else None
        left = len(self._breaks[-1]) > broken or self._left or self.run.returns
        return after.on(Turn()) if after is not None and left else after

    def _exit(self, loop: Loop, state: State | None) -> State | None:
        self._continues.pop()
        broken = self._breaks.pop()
        state = self._block(loop.other, state) if state is not None else None
        return joined_states([*broken, state])

    def _while(self, loop: Loop, state: State) -> State | None:
        """Run rounds while the condition is decided."""
        assert loop.test is not None
        self._enter()
        current = state
        for count in range(MAX_ROUNDS + 1):
            holds = True if loop.first and not count else self.judge.truth(loop.test, self._env(current))
            if holds is False:
                if not count:
                    self._shadow(loop.body, current)
                return self._exit(loop, current)
            if holds is None or count == MAX_ROUNDS or self._steps > MAX_STEPS:
                return self._exit(loop, self._blur(loop, current))
            after = self._round(loop, current)
            if after is None:
                return self._exit(loop, None)
            current = after
        return self._exit(loop, current)

    def _element(self, each: Statement, at: int, state: State) -> State:
        return self._bind(each.target, Held("each", "", each.value, self._env(state), at), state)

    def _blur(self, loop: Loop, state: State) -> State | None:
        """Run the body once with what it changes unknown, which stands for any number of rounds."""
        changed = {key for block in (loop.body, loop.step) for key in self._changed_in(block)}
        start = self._lost(state, changed)
        heads = {key: start.holds[key][0] for key in changed}
        self._enter()
        inside = start.on(Turn())
        if loop.each >= 0:
            self._record(loop.each, state)
            self.sharing.enter(self.body[loop.each])
            inside = self._element(self.body[loop.each], loop.each, inside)
        self._blurred += 1
        after = joined_states([self._block(loop.body, inside), *self._continues[-1]])
        if after is not None:
            after = self._block(loop.step, after)
        self._blurred -= 1
        for key, head in heads.items():
            self._close(head, self._known(key, state, None), after.holds[key] if after is not None else ())
        return self._exit(loop, joined_states([start, after]))

    def _close(self, head: Held, before: tuple[Held, ...], after: tuple[Held, ...]) -> None:
        """What a variable holds when a round begins: what it held before the loop, or what a round left."""
        ways = tuple(dict.fromkeys([*before, *(held for held in after if held is not head)]))
        if len(ways) <= MAX_WAYS and head.name not in self._escaped:
            head.how, head.before = "looped", ways
            head.settled.clear()

    def _changed_in(self, block: Block) -> set[str]:
        """The variables that steps change."""
        found: set[str] = set()
        for at in statements(block):
            found |= self._changed_by(at)
        return found

    def _changed_by(self, at: int) -> set[str]:
        found = self.outline.changed_by(at)
        if self.body[at].kind == "each":  # a loop binds its variable, and changes nothing of what it is over
            return found
        return found | self.sharing.roots(found)

    def _lost(self, state: State, keys: Iterable[str]) -> State:
        """The state in which nobody knows what some variables hold; what they were made as is kept."""
        lost = {key: (Held("lost", key, before=state.holds.get(key, ())),) for key in keys if key}
        for key in tuple(lost):
            for part in state.holds:
                if part.startswith(f"{key}."):
                    lost[part] = (Held("lost", part),)
        return state.having(lost)

    # --- what runs later ---------------------------------------------------------------------------------

    def _run_later(self, step: Later, state: State) -> State:
        """A lambda may run any time from now on: what it assigns, and what is assigned after it, is unknown to it."""
        own = (self._declared_in(step.body) | set(step.params)) - {""}  # a parameter may have no name
        inside = self._changed_in(step.body) - own
        self._escaped |= inside
        keep = (self._breaks, self._continues, self._raised)
        self._breaks, self._continues, self._raised = [[]], [[]], []
        self._later += 1
        again = {key for key in state.holds if self.outline.changes.get(key, 0) > 1}
        shared = {key: (Held("shared", key),) for key in again | inside if self._is_open(key)}
        start = self._lost(state, inside | again | own).having(shared)
        self._block(step.body, start.on(Turn()))
        self._later -= 1
        self._breaks, self._continues, self._raised = keep
        return self._lost(state, inside).having({key: ways for key, ways in shared.items() if key in inside})

    def _declared_in(self, block: Block) -> set[str]:
        """The variables that steps declare for themselves."""
        declaring = (self.body[at] for at in statements(block))
        lets = [entry for entry in declaring if entry.kind == "let" or (entry.kind == "each" and not self.python)]
        return {key for entry in lets for key in self.outline.bound_keys(entry.target)} - {""}

    # --- statements --------------------------------------------------------------------------------------

    def _statement(self, at: int, state: State) -> State | None:
        self._steps += 1
        self._at = at
        statement = self.body[at]
        if statement.kind == "each":
            self._pending.append(at)
            self._record(at, state)
            return state
        self._record_all(at, self._with_loops(statement, at, state))
        env = self._env(state)
        state = self._changed(at, state, env)
        for target, name, default in self.outline.reads.get(at, ()):
            key = self.effects.key(target)
            before = state.holds.get(key, ())
            state = self._hold(key, Held("read", key, name, env, at, default, before), state) if key else state
        if statement.kind == "return":
            if not self._later:
                self.run.returns.append((at, state))
            return None
        if statement.kind != "do":
            state = self._lost(state, self._escape(statement.value))
            state = self._shared_change(statement, state)
            state = self._assign(statement, at, env, state)
        for frame in self._raised:
            frame.append(state)
        return state

    def _env(self, state: State) -> Env:
        return self.env.within(state, self._at)

    def _record(self, at: int, state: State) -> None:
        self._record_all(at, [state])

    def _record_all(self, at: int, states: Iterable[State]) -> None:
        known = self.run.states[at]
        for state in states:
            if len(known) < MAX_STATES:
                known.append(state)
            else:
                met = joined_states([known[-1], state])
                known[-1] = met.along((*met.path, Turn())) if met is not None else state
                self.run.cut = True

    def _with_loops(self, statement: Statement, at: int, state: State) -> list[State]:
        """The states of a statement with comprehensions: one for each element, where it calls anything."""
        if not self._pending:
            return [state]
        found = list(comprehensions(statement.value))
        states = [state]
        for entry in found if self.func.calls[at] else ():
            states = [inner for outer in states for inner in self._elements(entry, outer)]
        done = {loop for entry in found for loop in entry.loops}
        self._pending = [loop for loop in self._pending if loop not in done] if found else self._pending
        if not found:  # a condition of a comprehension: what its loops bind is not known yet
            for loop in self._pending:
                states = [self._element(self.body[loop], loop, entry) for entry in states]
        return states or [replace(state, live=False)]

    def _elements(self, entry: Comprehension, state: State) -> list[State]:
        states = [state]
        for loop in entry.loops:
            states = [inner for outer in states for inner in self._each_of(loop, outer)]
        return [kept for one in states if (kept := self._passing(entry, one)) is not None]

    def _each_of(self, loop: int, state: State) -> list[State]:
        each = self.body[loop]
        known = self.whole and each.value is not None
        items = self.judge.rounds(each.value, self._env(state)) if known and each.value is not None else None
        if items is None or len(items) > MAX_ROUNDS:
            return [self._element(each, loop, state)]
        return [self._bind(each.target, Held("value", "", item.expr, item.env, loop), state) for item in items]

    def _passing(self, entry: Comprehension, state: State) -> State | None:
        found = [self._truth(test, state) for test in entry.tests]
        if False in found:
            return None
        return state.on(Turn()) if None in found else state

    # --- binding -----------------------------------------------------------------------------------------

    def _assign(self, statement: Statement, at: int, env: Env, state: State) -> State:
        target, value = statement.target, statement.value
        if statement.kind == "let" and value is None:
            return self._bind(target, Held("made", "", None, env, at), state)
        if statement.kind == "let" and statement.type.endswith("&"):
            return self._refer(target, value, at, env, state)
        if isinstance(value, Opaque):
            return self._bind(target, Held("lost", "", None, env, at), state)
        state = self._placed(value, state)
        return self._bind(target, Held("value", "", value, env, at), state)

    def _placed(self, value: Expr | None, state: State) -> State:
        """A text of C++ that has no value yet, in the braces of an object: whoever makes that may write it."""
        if self.python or not isinstance(value, Items):
            return state
        keys = {self.effects.key(expr) for expr in bare_names(value)}
        empty = {
            key for key in keys if all(held.how == "made" for held in state.holds.get(key, ())) and key in state.holds
        }
        return self._lost(state, empty)

    def _shared_change(self, statement: Statement, state: State) -> State:
        """`b += [x]` in Python changes a list for all who have it, and makes a new text."""
        key = self.effects.key(statement.target)
        if not (self.python and key and statement.type.endswith("=")):
            return state
        before = self._known(key, state, None)
        if all(held.how == "value" and is_plain(held.expr) for held in before):
            return state
        alike = self.sharing.alike(key, state)
        others = (alike | self.sharing.holding(alike, state) | self.sharing.roots({key})) - {key}
        handed = {name: (Held("handed", name, before=state.holds[name]),) for name in others if name in state.holds}
        return state.having(handed)

    def _refer(self, target: Expr | None, value: Expr | None, at: int, env: Env, state: State) -> State:
        """`auto & x = y;` is another name of what it refers to: neither is followed once one of them changes."""
        self.sharing.refer(self.effects.key(target), self.effects.root(value))
        return self._bind(target, Held("value", "", value, env, at), state)

    def _bind(self, target: Expr | None, held: Held, state: State) -> State:
        """Give a variable, a field, an element or several variables what a statement gives them."""
        if isinstance(target, Items):
            return self._unpack(target, held, state)
        key = self.effects.key(target)
        if key:
            held.name = key
            state = self._hold(key, held, self._parts_lost(key, state))
            return self._after_rebinding(key, state)
        root = self.effects.root(target)
        if not root:
            return state
        if isinstance(target, Op) and target.op == "[]" and self.effects.key(target.operands[0]) == root:
            before = self._known(root, state, held.env)
            stored = Held("stored", root, target.operands[1], held.env, held.at, held.expr, before)
            new = stored if held.how == "value" else Held("lost", root, before=before)
            return self._in_place(root, new, state)
        return self._in_place(root, Held("lost", root, before=state.holds.get(root, ())), state)

    def _after_rebinding(self, key: str, state: State) -> State:
        """In C++ a reference that is assigned writes through, and references to what is assigned see it."""
        if self.python:
            return state
        touched = self.sharing.roots({key}) | {name for name in self.sharing.parts(key) if name in state.holds}
        return self._lost(state, touched) if touched else state

    def _parts_lost(self, key: str, state: State) -> State:
        dotted = f"{key}."
        parts = {part: (Held("lost", part),) for part in state.holds if part.startswith(dotted)}
        return state.having(parts)

    def _unpack(self, target: Items, held: Held, state: State) -> State:
        """`a, b = value`: each gets its part, all of them at once."""
        value = held.expr
        env = held.env
        for index, item in enumerate(target.items):
            if held.how == "value" and isinstance(value, Items) and len(value.items) == len(target.items):
                part = Held("value", "", value.items[index], env, held.at)
            elif held.how == "value" and value is not None:
                part = Held("value", "", Op("[]", (value, Number(index))), env, held.at)
            else:
                part = Held("lost", "", None, env, held.at)
            state = self._bind(item, part, state)
        return state

    def _is_open(self, key: str) -> bool:
        """Whether others than the function have a variable: a member, or one outside of functions."""
        return key.startswith(".") or key.split(".")[0] not in self.effects.own

    def _hold(self, key: str, held: Held, state: State) -> State:
        if key in self._escaped:
            held = self._seen_by_others(key, held)
        if held.length >= 8:
            self.judge.settle(held)
        return state.having({key: (held,)})

    def _seen_by_others(self, key: str, held: Held) -> Held:
        """What a variable holds that a lambda or a pointer may change any time."""
        if not self._is_open(key):
            return Held("lost", key, before=(held,))
        self.run.shown[key].append(held)
        return Held("shared", key)

    def _escape(self, value: Expr | None) -> set[str]:
        """`p = &x`: from here on `x` may change through `p`."""
        address = not self.python and isinstance(value, Op) and value.op == "&" and len(value.operands) == 1
        key = self.effects.key(value.operands[0]) if address and isinstance(value, Op) else ""
        if key not in self.effects.own:
            return set()
        self._escaped.add(key)
        return {key}

    # --- effects of calls --------------------------------------------------------------------------------

    def _changed(self, at: int, state: State, env: Env) -> State:
        for effect in self.effects.of(at):
            state = self._apply(effect, at, env, state)
        calls = self.func.calls[at]
        waits = any(self._waits(call) for call in calls)
        own = [call for call in calls if self.judge.is_own(call, env)]
        if waits or any(self.judge.reaches_object(call, env) for call in own):
            state = self._given_again([key for key in state.holds if key.startswith(".")], state)
            state = replace(state, called=True)
        if waits or own:
            outside = [key for key in state.holds if self._is_open(key) and not key.startswith(".")]
            state = self._given_again(outside, state)
        return state

    def _apply(self, effect: Effect, at: int, env: Env, state: State) -> State:
        before = self._known(effect.key, state, env)
        if effect.kind == "handed" and all(self._keeps_its_text(held) for held in before):
            return state
        how = effect.kind
        name = effect.name if how == "out" else effect.key
        return self._in_place(effect.key, Held(how, name, effect.call, env, at, before=before), state)

    def _keeps_its_text(self, held: Held) -> bool:
        """Whether nobody who gets a value can change it: texts and numbers of Python, literals of C++."""
        if held.how != "value" or not is_plain(held.expr):
            return False
        written = self.body[held.at].type if 0 <= held.at < len(self.body) else ""
        return self.python or (isinstance(held.expr, Text) and (written == "auto" or "*" in written))

    def _in_place(self, key: str, held: Held, state: State) -> State:
        """Change what a variable consists of, for all names of the same thing."""
        alike, others = {key}, set()
        if self.python:
            alike = self.sharing.alike(key, state)
            others = self.sharing.holding(alike, state) - alike
        else:
            others = set(self.sharing.parts(key))
        others |= self.sharing.roots({key})
        others = {name for name in others - alike if name in state.holds}
        if self._escaped & alike:
            held = self._seen_by_others(key, held)
        if held.length >= 8:
            self.judge.settle(held)
        ways = (held,)
        return self._lost(state, others).having(dict.fromkeys(alike, ways))

    def _waits(self, call: Call) -> bool:
        callee = call.callee
        last = callee.name if isinstance(callee, Member) else callee.id if isinstance(callee, Name) else ""
        return last.rsplit("::", 1)[-1] in self.effects.calls.waiting

    def _given_again(self, keys: Iterable[str], state: State) -> State:
        """A function of the tree may assign members and variables outside of functions."""
        again = tuple(keys)
        for key in again:
            known = self.run.shown[key]
            known += [held for held in state.holds[key] if held.how not in {"given", "shared"} and held not in known]
        return state.having({key: (Held("shared", key),) for key in again})

    def _known(self, key: str, state: State, env: Env | None) -> tuple[Held, ...]:
        """What a variable holds, which a function may have not given anything yet."""
        how: How = "shared" if state.called and key.startswith(".") and key.count(".") == 1 else "given"
        return state.holds.get(key) or (Held(how, key, env=env),)


def _behind(step: Branch | Switch, before: State, after: State | None) -> State | None:
    """The state behind a branch: the sides that it still came through are those that others left."""
    count = len(before.path)
    if after is None or len(after.path) <= count:
        return after
    thrown = any(isinstance(entry, Leave) and entry.how == "throw" for block in blocks(step) for entry in block[-1:])
    past = [turn.past("throw" if thrown else "return") for turn in after.path[count:]]
    return after.along((*before.path, *past))


def _question(subject: Expr, case: Case) -> Expr | None:
    """What a case of a switch asks, as a condition of its own; None for the default, which asks nothing."""
    if subject == Constant("true"):
        return case.tests[0]
    asked = [Op("==", (subject, test)) for test in case.tests]
    return asked[0] if len(asked) == 1 else Op("||", tuple(asked)) if asked else None


def comprehensions(expr: Expr | None) -> Iterator[Comprehension]:
    """Yield the comprehensions in an expression, outer ones first."""
    if expr is None:
        return
    if isinstance(expr, Comprehension):
        yield expr
        yield from comprehensions(expr.element)
        return
    for part in children(expr):
        yield from comprehensions(part)


def _raises(expr: Expr | None) -> bool:
    """Tell whether evaluating an expression may raise: calls, subscripts, divisions."""
    if expr is None:
        return False
    if isinstance(expr, Call | Comprehension | Opaque) or (isinstance(expr, Op) and expr.op in {"[]", "/", "//", "%"}):
        return True
    return any(_raises(part) for part in children(expr))
