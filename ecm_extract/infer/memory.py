"""What the variables of one run hold: how that changes, and who shares it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import THIS, Call, Items, Op, Table
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Block, statements

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.held import Held, How, State, all_ways
from ecm_extract.infer.places import ALL_FIELDS, owners, wholes
from ecm_extract.infer.pointing import is_address, refers
from ecm_extract.infer.run import Frame
from ecm_extract.infer.sharing import Sharing

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Env

MAX_LENGTH = 8
"""Changes of one variable after which it is evaluated, so that later ones need no deep recursion."""


class Memory:
    """Changes what variables hold, by key (see `places`), for all names of the same thing.

    Attributes:
        escaped: variables that others than the statements of the function may change any time.
        sharing: which of them share what they hold.
    """

    def __init__(self, frame: Frame) -> None:
        self.frame = frame
        self.escaped: set[str] = set(frame.outline.escaped)
        self.sharing = Sharing(frame.outline)
        for key in self.escaped:
            if self.is_open(key):
                frame.run.shown[key].append(Held("lost", key))

    def is_open(self, key: str) -> bool:
        """Whether others than the function have a variable: a member, or one outside of functions."""
        return key.startswith(".") or key.split(".")[0] not in self.frame.effects.own

    def known(self, key: str, state: State, env: Env | None) -> tuple[Held, ...]:
        """What a variable holds, which a function may have not given anything yet."""
        how: How = "shared" if state.called and key.startswith(".") and key.count(".") == 1 else "given"
        return state.holds.get(key) or (Held(how, key, env=env),)

    def hold(self, key: str, held: Held, state: State) -> State:
        """Give a variable something to hold."""
        if self._has_escaped(key):
            held = self._seen_by_others(key, held)
        if held.length >= MAX_LENGTH:
            self.frame.judge.settle(held)
        return self.of_any_field(key, state).having({key: (held,)})

    def _has_escaped(self, key: str) -> bool:
        """Whether others may change a variable any time, or in C++ an object of the function that it lies in."""
        return key in self.escaped or (not self.frame.python and not self.escaped.isdisjoint(wholes(key)))

    def of_any_field(self, key: str, state: State) -> State:
        """The state after somebody changed the table of the fields of an object of Python: nobody knows any of them."""
        if not key.endswith(f".{ALL_FIELDS}"):
            return state
        owner = key.removesuffix(f".{ALL_FIELDS}")
        if not owner:
            return self.lost(state, state.holds.within(""))
        return self.lost(state, self.names(owner, state))

    def _seen_by_others(self, key: str, held: Held) -> Held:
        """What a variable holds that a lambda, a pointer or the end of an object may change any time."""
        if key in self.frame.outline.unfollowed:
            return Held("lost", key, before=(held,))
        if not self.is_open(key):
            if self.frame.python and key not in self.frame.outline.bound_inside:
                return Held("handed", key, before=(held,))
            return Held("shared" if self.frame.outline.is_module else "lost", key, before=(held,))
        self.frame.run.shown[key].append(held)
        return Held("shared", key)

    def tell(self, names: Iterable[str], held: Held) -> None:
        """Show others what variables of theirs hold that a lambda of C++ changes by another name of them."""
        for name in names if not self.frame.python else ():
            if name in self.escaped and self.is_open(name):
                self.frame.run.shown[name].append(held)

    def lost(self, state: State, keys: Iterable[str]) -> State:
        """The state in which nobody knows what some variables hold; what they were made as is kept."""
        lost = {key: (Held("lost", key, before=state.holds.get(key, ())),) for key in keys if key}
        if not lost:
            return state
        parts = (part for key in lost for part in state.holds.within(key))
        return state.having(lost | {part: (Held("lost", part),) for part in parts})

    def object_lost(self, key: str, state: State) -> State:
        """The state in which nobody knows an object of a variable, nor what of Python has it as an element."""
        if not self.frame.python:
            return self.lost(state, self.names(key, state))
        return self.in_place(key, Held("lost", key, before=state.holds.get(key, ())), state)

    def parts_lost(self, key: str, state: State) -> State:
        """Return the state in which nobody knows the fields of a variable."""
        return state.having({part: (Held("lost", part),) for part in state.holds.within(key)})

    def parts_begun(self, key: str, state: State) -> State:
        """Return the state in which a variable of C++ was declared, and so has no field of another one of its name."""
        return state.without(state.holds.within(key))

    def again(self, key: str, before: State, state: State) -> State:
        """Return the state behind a block that hid a variable by another one: it holds what it held before."""
        if key not in before.holds:  # a parameter as it was given, or one of the object or of a namespace
            return state.without({key, *state.holds.within(key)})
        known = {part: before.holds[part] for part in (key, *before.holds.within(key))}
        return state.without(state.holds.within(key)).having(known)

    def in_place(self, key: str, held: Held, state: State) -> State:
        """Change what a variable consists of, for all names of the same thing."""
        if self.frame.python:
            alike = self.sharing.alike(key, state)
            others = self.sharing.reached(alike | self._had_from(key, state), state) | self.sharing.roots({key})
        else:
            alike, others = self.sharing.meant(key, state)
        others = {name for name in others - alike if name in state.holds or self._may_hold(name)}
        self.tell(alike - {key}, held)
        self.tell(others, Held("lost", key))
        if self.escaped & alike:
            held = self._seen_by_others(key, held)
        if held.length >= MAX_LENGTH:
            self.frame.judge.settle(held)
        ways = (held,)
        state = self.of_any_field(key, state)
        if held.how == "lost":
            for name in alike:
                state = self.parts_lost(name, state)
        elements = self._elements_reached(alike, others, state) if self.frame.python else {}
        return self.reached(others, state, alike).having(elements).having(dict.fromkeys(alike, ways))

    def _may_hold(self, name: str) -> bool:
        """Whether a variable of Python holds something that the function did not give it: so do fields of objects."""
        return self.frame.python and (self.is_open(name) or "." in name)

    def _had_from(self, key: str, state: State) -> set[str]:
        """What a field that the function gave nothing may be a part of: what its object is made of."""
        within = [] if key in state.holds else [whole for whole in (*wholes(key), *owners(key)) if whole in state.holds]
        found = self.sharing.consisting.named(within[-1:], state) - set(within)
        return found | (self._followed_by_nobody(state) if self._has_own(found.union(within[-1:]), state) else set())

    def _has_own(self, keys: Iterable[str], state: State) -> bool:
        """Whether any of some variables is made with the object at hand."""
        made = (held.expr for key in keys for held in all_ways(state.holds.get(key, ())))
        return any(each == THIS for expr in made for each in shared_names(expr, self.frame.body))

    def _followed_by_nobody(self, state: State) -> set[str]:
        """The members that others change who have the object at hand."""
        return {key for key in state.holds.within("") if not self.frame.judge.is_followed(key, self.frame.env)}

    def names(self, key: str, state: State) -> set[str]:
        """Return all names of what a name means."""
        return self.sharing.alike(key, state) if self.frame.python else self.sharing.names_of(key)

    def in_part(self, key: str, held: Held, state: State) -> State:
        """Give a field of an object something to hold, for all names of the object; a member of the own one has one.

        What may be the same object, or an element that is, has a field that nobody knows.
        """
        keys, perhaps, lists = {key}, set[str](), set[str]()
        for whole in (*wholes(key), *owners(key)):
            names, part = self.names(whole, state), key.removeprefix(whole)
            keys |= {name + part for name in names}
            if self.frame.python:
                perhaps |= {name + part for name in self.sharing.holding(names, state)}
                roots = self.sharing.roots(names)
                lists |= {*self._taken_from(names | roots, state), *(name for name in roots if name in state.holds)}
        unknown = {name: (Held("lost", name),) for name in perhaps - keys}
        within = {name: _elements_of(name, state.holds[name]) for name in lists - keys}
        return state.having(within).having(unknown).having(dict.fromkeys(keys, (held,)))

    def _taken_from(self, names: Iterable[str], state: State) -> set[str]:
        """The variables of Python that some others were taken out of: `row = rows[0]`, `for row in rows`."""
        found, pending = set[str](), list(names)
        while pending:
            ways = all_ways(state.holds.get(pending.pop(), ()))
            parts = [held.expr for held in ways if held.how != "value" or isinstance(held.expr, Op | Call)]
            near = {self.frame.effects.key(expr) for part in parts for expr in shared_names(part, self.frame.body)}
            more = {name for name in near if name in state.holds} - found
            found |= more
            pending += more
        return found

    def exchanged(self, key: str, ways: tuple[Held, ...], state: State) -> State:
        """Give a variable of C++ what another one held; who may be changed any time is not known any more."""
        alike = self.sharing.names_of(key)
        others = {name for name in self.sharing.touched(alike, state) if name in state.holds}
        if self.escaped & alike or any(self.is_open(name) for name in alike):
            return self.lost(state, others | alike)
        state = self.lost(self.parts_lost(key, state), others)
        return state.having(dict.fromkeys(alike, ways))

    def with_fields_of_others(self, key: str, before: State, state: State) -> State:
        """The state in which a reference of C++ has the fields of the object that it is another name of."""
        for other in self.sharing.names_of(key) - {key}:
            state = self.with_fields(key, other, before, state)
        return state

    def with_fields(self, key: str, other: str, before: State, state: State) -> State:
        """The state in which a variable of C++ has the fields that another one had before it."""
        fields = {key + part.removeprefix(other): before.holds[part] for part in before.holds.within(other)}
        return state.having(
            {
                f"{name}{part.removeprefix(key)}": ways
                for part, ways in fields.items()
                for name in self.sharing.names_of(key)
            }
        )

    def reached(self, keys: Set[str], state: State, changed: Set[str] = frozenset()) -> State:
        """The state after somebody changed what variables mean or hold: a text of Python stays what it is.

        Args:
            keys: the variables.
            state: the state before.
            changed: other variables of which somebody changed what they consist of.
        """
        if not self.frame.python:
            return self.lost(state, keys)
        fixed = self._fixed(keys, keys | changed, state)
        handed = {key: self._handed(key, state) for key in fixed}
        return self.lost(state, keys).having(handed)

    def _handed(self, key: str, state: State) -> tuple[Held, ...]:
        """What a variable holds that somebody may have changed once more."""
        ways = self.known(key, state, None)
        return ways if all(held.how == "handed" for held in ways) else (Held("handed", key, before=ways),)

    def sharers_reached(self, keys: Set[str], state: State) -> State:
        """The state after somebody changed what variables consist of: others of Python may be that, or have it, too."""
        if not self.frame.python:
            return state
        alike = {name for key in keys for name in self.sharing.alike(key, state)}
        return self.reached((self.sharing.consisting.reached(keys, state) | alike) - keys, state, keys)

    def _fixed(self, keys: Set[str], changed: Set[str], state: State) -> list[str]:
        """Those of some variables of Python which nobody else gives anything, so that a text of theirs stays."""
        inside = self.frame.outline.bound_inside
        return [key for key in keys if key not in inside and self._is_bound_here(key, changed, state)]

    def _is_bound_here(self, key: str, changed: Set[str], state: State) -> bool:
        """Whether a name is none of a field of what somebody has, who may give that something else."""
        if "." not in key[1:]:
            return True
        return key in state.holds and not any(whole in changed for whole in (*wholes(key), *owners(key)))

    def _elements_reached(self, changed: Set[str], keys: Set[str], state: State) -> Mapping[str, tuple[Held, ...]]:
        """What lists of Python hold that were written out, after somebody changed what one of their elements means.

        They have the elements that they had, unless they are a part of what was changed.
        """
        written = [key for key in self._fixed(keys, changed, state) if _is_written_out(state.holds.get(key, ()))]
        within = self.sharing.consisting.reached(changed, state) if written else ()
        return {key: _elements_of(key, state.holds[key]) for key in written if key not in within}

    def show(self, keys: Iterable[str], state: State) -> None:
        """Note what variables hold while other functions run."""
        for key in keys:
            known = self.frame.run.shown[key]
            ways = state.holds.get(key, ())
            known += [held for held in ways if held.how not in {"given", "shared"} and held not in known]

    def given_again(self, keys: Iterable[str], state: State) -> State:
        """A function of the tree may assign members and variables outside of functions."""
        again = tuple([key for key in keys if key not in self.frame.outline.unfollowed])  # nobody knows those
        self.show(again, state)
        return state.having({key: (Held("shared", key),) for key in again})

    def changed_in(self, block: Block) -> set[str]:
        """The variables that steps change."""
        for at in statements(block):
            self._refer(self.frame.body[at])
        found: set[str] = set()
        for at in statements(block):
            found |= self._changed_by(at) | self.frame.judge.lasting.keys(self.frame.env.func, at)
            found |= self.frame.judge.lent.keys(self.frame.env, at)
        return found

    def _refer(self, let: Statement) -> None:
        """Note a reference of C++, a pointer, or a variable of a loop, declared among steps which may run again."""
        if let.kind == "each":
            self.sharing.enter(let)
        elif refers(let) and not self.frame.python:
            effects, value = self.frame.effects, let.value
            whole = effects.key(value) if not is_address(value) else ""
            self.sharing.refer(effects.key(let.target), effects.root(value), whole)

    def _changed_by(self, at: int) -> Set[str]:
        found = self.frame.outline.changed_by(at)
        if self.frame.body[at].kind == "each":  # a loop binds its variable, and changes nothing of what it is over
            return found
        return self.sharing.with_shared(found)

    def declared_in(self, block: Block) -> set[str]:
        """The variables that steps declare for themselves."""
        declaring = (self.frame.body[at] for at in statements(block))
        lets = [entry for entry in declaring if entry.kind == "let" or (entry.kind == "each" and not self.frame.python)]
        return {key for entry in lets for key in self.frame.outline.bound_keys(entry.target)} - {""}


def _is_written_out(ways: tuple[Held, ...]) -> bool:
    """Whether a variable surely holds a list, or a table, that is written out, or such a one after its own methods."""
    return bool(ways) and all(held.how == "reached" or _is_own_list(held) for held in all_ways(ways))


def _is_own_list(held: Held) -> bool:
    if held.how in {"changed", "stored"}:
        return _is_written_out(held.before)
    return held.how == "value" and isinstance(held.expr, Items | Table)


def _elements_of(key: str, ways: tuple[Held, ...]) -> tuple[Held, ...]:
    """What is left of a list whose elements somebody may have changed."""
    return ways if all(held.how == "reached" for held in ways) else (Held("reached", key, before=ways),)
