"""What the calls of a statement do to variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Text
from ecm_parsers.source.flow import Block, statements

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effect import Effect
from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.giving import Giving
from ecm_extract.infer.held import Held, How, State, all_ways
from ecm_extract.infer.memory import MAX_LENGTH, Memory
from ecm_extract.infer.places import owners
from ecm_extract.infer.run import Frame
from ecm_extract.link.code.walk import given_to, last_of

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Env

_STEADY: Final = frozenset({"handed", "reached", "lost", "shared"})
"""What becomes of a variable that no further call makes anything else of."""


class Calling:
    """Applies the effects of calls."""

    def __init__(self, frame: Frame, memory: Memory, giving: Giving) -> None:
        self.frame = frame
        self.memory = memory
        self.giving = giving

    def after(self, at: int, state: State, env: Env, skipped: Sequence[Call] = ()) -> State:
        """Return the state after the calls of a statement, without some that do not run."""
        calls, effects = _without(self.frame.env.func.calls[at], skipped), self.frame.effects.of(at)
        if not calls and not effects:
            return state
        for effect in effects:
            if not any(effect.call is each for each in skipped):
                state = self._apply(effect, at, env, state)
                state = self.giving.written(_receiver(effect.call), state)
        state = self._by_bound_methods(calls, state)
        waits = at in self.frame.outline.waiting
        own = _without(self.frame.judge.own.of(env), skipped)
        state = self.giving.used(state) if waits or own else state
        state = self._methods(at, calls, [] if waits else own, env, state)
        state = self._inner(at, calls, env, state)
        state = self._unfollowed(calls, env, state)
        if waits:
            state = self._anything(self.memory.lost(state, self._followed(state)))
        state = state.having(self.frame.judge.lasting.changed(env, state))
        state = state.having(self.frame.judge.lent.changed(env, state))
        if waits or own:
            state = self.memory.given_again([key for key in state.holds if self._may_be_changed(key)], state)
        return state

    def any_times(self, at: int, state: State, skipped: Sequence[Call] = ()) -> State:
        """Return the state in which nobody knows what calls of a statement change that run any number of times."""
        after = self.after(at, state, self.frame.place(state), skipped)
        apart = after.holds.apart(state.holds)
        changed = [key for key in apart if after.holds.get(key) is not state.holds.get(key)]
        lost = [key for key in changed if any(held.how not in _STEADY for held in all_ways(after.holds.get(key, ())))]
        return self.memory.lost(after, lost)

    def _by_bound_methods(self, calls: Sequence[Call], state: State) -> State:
        """The state after `put = names.append; put("x")`: nobody knows what such a method makes of its object.

        So it is where `map` and the like call it.
        """
        calling = self.frame.effects.calls.calling
        for call in calls if self.frame.python else ():
            for each in (call.callee, *(given_to(call) if last_of(call.callee) in calling else ())):
                ways = all_ways(state.holds.get(self.frame.effects.key(each), ()))
                bound = [method.base for held in ways if held.how == "value" for method in _methods_in(held.expr)]
                for root in filter(None, map(self.frame.effects.root, bound)):
                    state = self.memory.in_place(root, Held("lost", root, before=state.holds.get(root, ())), state)
        return state

    def undone(self, at: int, before: State, state: State) -> State:
        """The state in which calls of a statement find the variables that outlive them."""
        keys = self.frame.judge.lasting.keys(self.frame.env.func, at)
        return state.having({key: self.memory.known(key, before, None) for key in keys})

    def _may_be_changed(self, key: str) -> bool:
        """Whether functions that are called may change what is not the function's own: members that others write to."""
        return self.memory.is_open(key) and not self.frame.judge.is_followed(key, self.frame.env)

    def _methods(self, at: int, calls: Sequence[Call], own: Sequence[Call], env: Env, state: State) -> State:
        """The state after methods of the object at hand, or of objects that the function made."""
        on = [(call, self._object(call, env)) for call in own]
        for key in dict.fromkeys(key for _, key in on if key is not None):
            state = self._on_object(key, [call for call, each in on if each == key], at, env, state)
        state = self._through_objects(at, calls, {key for _, key in on if key}, state)
        both = (self._of_receiver(call, at) for call, key in on if key == "")
        return self.memory.lost(state, {name for key in both if key for name in self.memory.names(key, state)})

    def _through_objects(self, at: int, calls: Sequence[Call], followed: set[str], state: State) -> State:
        """The state after methods of objects of Python, which may change what those have: `x.rows = b; x.go()`.

        What methods that are followed make of the fields of their object is known.
        """
        for call in calls if self.frame.python else ():
            key = self.frame.effects.key(_receiver(call))
            for root in self._objects_of(call) - followed if self._may_change_part(call, at) else ():
                how: How = "handed" if key else "reached"
                before = self.memory.known(root, state, None)
                state = self.memory.in_place(root, Held(how, root, before=before), state)
            own = self.frame.judge.own.is_own(call, self.frame.env.func, at)
            known = bool(key) and (state.holds.has_fields if own else bool(state.holds.within(key)))
            if known and not self._is_left(call, at):
                kept = {each: state.holds[each] for each in state.holds.within(key)} if key in followed else {}
                state = self.memory.sharers_reached({key}, state).having(kept)
        return state

    def _objects_of(self, call: Call) -> set[str]:
        """The variables of Python that hold the object that a method is called on: `a`, `a[0]`, `(a or b)`."""
        receiver, effects = _receiver(call), self.frame.effects
        root = effects.key(receiver) or effects.root(receiver)
        if root or receiver is None:
            return {root} - {""}
        return {effects.key(each) for each in shared_names(receiver, self.frame.body)} - {""}

    def changed_later(self, block: Block) -> set[str]:
        """Return the variables of Python whose objects methods change that steps call, which run any time later."""
        calls = ((call, at) for at in statements(block) for call in self.frame.env.func.calls[at])
        changing = (call for call, at in calls if self.frame.python and self._may_change_part(call, at))
        return {root for call in changing for root in self._objects_of(call)}

    def _may_change_part(self, call: Call, at: int) -> bool:
        """Whether a method that is not followed, be it of an element of something, may change its object."""
        judge, func = self.frame.judge, self.frame.env.func
        named = call.callee.name if isinstance(call.callee, Member) else ""
        known = self._is_left(call, at)
        return not known and judge.own.is_own(call, func, at) and not judge.methods.all_leave(named, func)

    def _is_left(self, call: Call, at: int) -> bool:
        """Whether a method changes nothing of the object that it is called on."""
        target = self.frame.judge.target(call, self.frame.env.func, at)
        return target is not None and self.frame.judge.parameters.leaves_object(target)

    def _of_receiver(self, call: Call, at: int) -> str:
        """The variable on which a method is called that gets the object at hand, too, and may change its own."""
        key = self.frame.effects.key(_receiver(call))
        if key not in self.frame.effects.own:
            return ""
        target = self.frame.judge.target(call, self.frame.env.func, at)
        return "" if target is not None and self.frame.judge.parameters.leaves_object(target) else key

    def before_rounds(self, block: Block, state: State) -> tuple[State, set[str]]:
        """Return the state before any round of a loop, and what methods that it calls change of objects."""
        changed: set[str] = set()
        for at in statements(block):
            env = self.frame.env.within(state, at)
            for call in self.frame.judge.own.of(env):
                key = self._object(call, env)
                members = self.frame.judge.methods.changed(call, env) if key is not None and self.frame.whole else None
                if members is not None:
                    changed.update(members)
                elif key:
                    changed.add(key)
                elif key is not None:
                    state = self._anything(state)
        return state, changed

    def _object(self, call: Call, env: Env) -> str | None:
        return self.frame.judge.methods.called_on(call, env) if self.frame.whole else self._at_hand(call, env)

    def _inner(self, at: int, calls: Sequence[Call], env: Env, state: State) -> State:
        """The state after functions that are declared within the one at hand and change its variables."""
        lasting = self.frame.judge.lasting.keys(self.frame.env.func, at)
        inner = ((call, self.frame.outline.changed_by_inner(call) - lasting) for call in calls)
        changing = [(call, keys) for call, keys in inner if keys]
        if len(changing) > 1 or not self.frame.whole:
            return self.memory.lost(state, {key for _, keys in changing for key in keys})
        for call, keys in changing:
            after = {key: self._after(key, key, call, at, env, state) for key in keys}
            for key, held in after.items():
                state = state.having({key: (held,)}) if self.frame.python else self.memory.in_place(key, held, state)
        return state

    def _unfollowed(self, calls: Sequence[Call], env: Env, state: State) -> State:
        """The state after functions that are declared here, and change members by themselves or by methods."""
        outline = self.frame.outline
        for func in (func for call in calls for func in outline.run_by(call)):
            changed = {key for key in outline.changed_inside(func) if self.memory.is_open(key)}
            known = self.frame.judge.methods.changed_by(func, env)
            state = self._anything(state) if known is None or known - changed else state
            changed |= {key for key in known or () if owners(key)}  # their members may be as made
            state = self.memory.lost(state, changed)
            for key in changed:
                state = self.memory.of_any_field(key, state)
        return state

    def _at_hand(self, call: Call, env: Env) -> str | None:
        return "" if self.frame.judge.own.reaches_object(call, env) else None

    def _on_object(self, key: str, calls: Sequence[Call], at: int, env: Env, state: State) -> State:
        """The state after calls on one object, by its key; the object at hand has none."""
        known = [self.frame.judge.methods.changed(call, env) if self.frame.whole else None for call in calls]
        changing = [(call, members) for call, members in zip(calls, known, strict=True) if members != {}]
        if len(changing) > 1 or None in known:
            return self.memory.object_lost(key, state) if key else self._anything(state)
        if not key:
            self.memory.show(state.holds.within(""), state)
        for call, members in changing:
            given, fields = members or {}, self._fields_of(members or {}, state)
            held = {name: self._after(name, there, call, at, env, state) for name, there in {**fields, **given}.items()}
            aliases = self._aliases(fields, given, state)
            state = self.memory.sharers_reached({*given, *fields}, state)
            state = state.having({name: (Held("lost", name),) for name in sorted(aliases)})
            state = state.having({name: (held[name],) for name in fields})
            for member in given:
                state = self.memory.in_part(member, held[member], state)
        return state

    def _fields_of(self, members: Mapping[str, str], state: State) -> Mapping[str, str]:
        """What is known of fields of what a method changes, each with its name in the method."""
        found: dict[str, str] = {}
        within = dict.fromkeys(key for member in members for key in state.holds.within(member))
        for key in (key for key in within if key not in members):
            whole = max((member for member in members if key.startswith(f"{member}.")), key=len)
            found[key] = members[whole] + key.removeprefix(whole)
        return found

    def _aliases(self, fields: Mapping[str, str], members: Mapping[str, str], state: State) -> set[str]:
        """Other names of such fields, by other names of what they lie in."""
        names = {member: self.memory.names(member, state) for member in members} if fields else {}
        same = (
            f"{name}{key.removeprefix(member)}"
            for key in fields
            for member, others in names.items()
            if key.startswith(f"{member}.")
            for name in others
        )
        return {key for key in same if key in state.holds and key not in fields}

    def _followed(self, state: State) -> list[str]:
        """The objects that the function made and called methods of."""
        after = [key for key, ways in state.holds.items() if any(held.how == "after" for held in all_ways(ways))]
        return [key.partition(".")[0] for key in after if not key.startswith(".")]

    def _after(self, key: str, name: str, call: Call, at: int, env: Env, state: State) -> Held:
        held = Held("after", name, call, env, at, before=self.memory.known(key, state, env))
        if held.length >= MAX_LENGTH:
            self.frame.judge.settle(held)
        return held

    def _anything(self, state: State) -> State:
        """The state after functions that may assign members as they like."""
        judge, env = self.frame.judge, self.frame.env
        members = state.holds.within("")
        again = [key for key in members if not judge.is_fixed(key, env)]
        state = self.memory.sharers_reached(set(members), state)
        return replace(self.memory.given_again(again, state), called=True)

    def _apply(self, effect: Effect, at: int, env: Env, state: State) -> State:
        if effect.kind == "swapped":
            then = env.state or state
            state = self.memory.exchanged(effect.key, self.memory.known(effect.name, then, env), state)
            return self.memory.with_fields(effect.key, effect.name, then, state)
        if effect.kind == "found":
            return self.memory.in_place(effect.key, Held("value", effect.key, effect.call, env), state)
        before = self.memory.known(effect.key, state, env)
        if effect.kind == "handed" and all(self._keeps_its_text(held) for held in all_ways(before)):
            return state
        how = effect.kind
        name = effect.name if how == "out" else effect.key
        after = self.memory.in_place(effect.key, Held(how, name, effect.call, env, at, before=before), state)
        if self.frame.python:
            return self._fields_out(effect, at, env, state, after) if how == "out" else after
        return after if how == "changed" else self._parts(effect, how, name, at, env, after)

    def _fields_out(self, effect: Effect, at: int, env: Env, before: State, state: State) -> State:
        """The state in which fields of an object of Python are what the function leaves them with that it got."""
        names = self.memory.names(effect.key, before)
        for part in [part for part in before.holds if part.startswith(f"{effect.key}.")]:
            rest = part.removeprefix(effect.key)
            held = Held("out", effect.name + rest, effect.call, env, at, before=before.holds[part])
            state = state.having({name + rest: (held,) for name in names})
        return state

    def _parts(self, effect: Effect, how: How, name: str, at: int, env: Env, state: State) -> State:
        """The state in which what an object of C++ was handed to has done the same to its fields."""
        for part in state.holds.within(effect.key):
            own = name + part.removeprefix(effect.key)
            held = Held(how, own, effect.call, env, at, before=state.holds[part])
            state = self.memory.hold(part, held, state)
        return state

    def _keeps_its_text(self, held: Held) -> bool:
        """Whether nobody who gets a value can change it: texts and numbers of Python, literals of C++."""
        if held.how == "given":
            return self.memory.sharing.is_constant(held.name)
        if held.how != "value" or not is_plain(held.expr):
            return False
        written = self.frame.body[held.at].type if 0 <= held.at < len(self.frame.body) else ""
        return self.frame.python or (isinstance(held.expr, Text) and (written == "auto" or "*" in written))


def _without(calls: Sequence[Call], skipped: Sequence[Call]) -> Sequence[Call]:
    return [call for call in calls if not any(call is each for each in skipped)] if skipped else calls


def _receiver(call: Call) -> Expr | None:
    """What a method is called on; None of a function."""
    return call.callee.base if isinstance(call.callee, Member) else None


def _methods_in(value: Expr | None) -> Iterator[Member]:
    """The methods of objects that calling a value of Python may call: its own, or what a partial is given."""
    for each in given_to(value) if isinstance(value, Call) else (value,):
        if isinstance(each, Member):
            yield each
