"""What statements give to variables, fields, elements: `x = y`, `a, b = pair`, `x[0] = y`, `auto & x = y`."""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import MOVED, Call, Expr, Items, Member, Name, Number, Op, Opaque, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.bare_names import bare_names, shared_names
from ecm_extract.infer.effects import is_element, is_plain
from ecm_extract.infer.handing_out import handed_out
from ecm_extract.infer.held import Held, State, all_ways
from ecm_extract.infer.memory import Memory
from ecm_extract.infer.places import ALL_FIELDS, target_of
from ecm_extract.infer.pointing import is_address, makes_pointer
from ecm_extract.infer.run import Frame
from ecm_extract.infer.written_values import addressed_in, arguments, braces, of_maker, referred
from ecm_extract.link.code.numbers import NUMBERS
from ecm_extract.link.code.pointed import pointed
from ecm_extract.link.code.spelling import by_value, last_name, plain
from ecm_extract.link.code.walk import children, names_in

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Bound, Env

MAX_MOVED: Final = 4
"""Statements behind one that moves from variables, in which they are left without a value."""
_TIE: Final = "tie"
"""en.cppreference.com, std::tie: references to what it is given."""


class Assigning:
    """Binds what statements assign."""

    def __init__(self, frame: Frame, memory: Memory) -> None:
        self.frame = frame
        self.memory = memory

    def assign(self, statement: Statement, at: int, env: Env, state: State) -> State:
        """Return the state after a statement has given its target a value."""
        target, value = self._field_named(target_of(statement), env), statement.value
        if statement.kind == "let":
            state = self._declared(target, state)
        if statement.kind == "let" and value is None:
            return self.bind(target, Held("made", "", None, env, at), state)
        if statement.kind == "let" and (statement.type.endswith("&") or "reference_wrapper<" in statement.type):
            return self._refer(target, value, at, env, state)
        if value == MOVED and self._is_copied(target):
            return state
        own_way = not self.frame.python and statement.kind == "set" and self.frame.judge.assigns_own_way(target, env)
        if isinstance(value, Opaque) or own_way:
            return self.bind(target, Held("lost", "", None, env, at), state)
        state = self._placed(value, state)
        self._refer_through(target, value, env)
        self._refer_by_pointer(statement, at, state)
        state = self.bind(target, Held("value", "", value, env, at), state)
        return self._from_before(statement, state) if statement.kept else state

    def _field_named(self, target: Expr | None, env: Env) -> Expr | None:
        """The field of Python that `setattr(a, name, x)` gives something, where a run tells its name; else as it is."""
        table = target.operands[0] if isinstance(target, Op) and target.op == "[]" else None
        if not isinstance(target, Op) or not isinstance(table, Member) or table.name != ALL_FIELDS:
            return target
        name = self.frame.judge.text(target.operands[1], env) if self.frame.whole else None
        return Member(table.base, name) if name is not None and name.isidentifier() else target

    def _declared(self, target: Expr | None, state: State) -> State:
        """The state in which C++ has new variables, whatever others of their names held."""
        for key in self.frame.outline.bound_keys(target) if not self.frame.python else ():
            state = self.memory.parts_begun(key, state)
        return state

    def _is_copied(self, target: Expr | None) -> bool:
        """Whether who moves from a variable of C++ only copies it: a number, a pointer, a constant."""
        written = self.frame.env.func.written_types.get(self.frame.effects.key(target), "")
        return written.endswith("*") or "const" in written.split() or plain(written) in NUMBERS

    def _from_before(self, let: Statement, state: State) -> State:
        """A variable that is kept between calls: what it begins with, or what a call before has left it with.

        What it begins with is of the first call, and of the first round of a loop.
        """
        key = self.frame.effects.key(let.target)
        entered = self.frame.judge.lasting.entered(key, self.frame.env)
        if entered is not None:
            return state.having({key: entered})
        given_out = "reference" in self.frame.env.func.fact.traits
        begun = any(name in self.frame.effects.own for name in names_in(let.value))
        is_same = self.frame.outline.changes.get(key, 0) <= 1 and not begun
        if not given_out and (is_same or (self._runs_once() and not let.depth)):
            return state
        return state.having({key: (*state.holds[key], Held("lost", key))})

    def _runs_once(self) -> bool:
        return self.frame.judge.runs_once(self.frame.env.func)

    def _placed(self, value: Expr | None, state: State) -> State:
        """A text of C++ that has no value yet, in the braces of an object: whoever makes that may write it."""
        if self.frame.python:
            return state
        keys = {self.frame.effects.key(expr) for each in braces(value) for expr in bare_names(each)}
        empty = {key for key in keys if key in state.holds and all(map(_is_empty, all_ways(state.holds[key])))}
        return self.memory.lost(state, empty)

    def shared_change(self, statement: Statement, state: State) -> State:
        """`b += [x]` in Python changes a list for all who have it, and makes a new text."""
        key = self.frame.effects.key(statement.target)
        if not (self.frame.python and key and statement.type.endswith("=")):
            return state
        before = self.memory.known(key, state, None)
        if all(held.how == "value" and is_plain(held.expr) for held in all_ways(before)):
            return state
        alike = self.memory.sharing.alike(key, state)
        others = (alike | self.memory.sharing.holding(alike, state) | self.memory.sharing.roots({key})) - {key}
        handed = {name: (Held("handed", name, before=state.holds[name]),) for name in others if name in state.holds}
        return state.having(handed)

    def _refer(self, target: Expr | None, value: Expr | None, at: int, env: Env, state: State) -> State:
        """`auto & x = y;` is another name of what it refers to, or of a part of it, which that leaves as it is."""
        if isinstance(target, Items):
            return self._refer_to_parts(target, value, at, env, state)
        key = self.frame.effects.key(target)
        self.memory.sharing.refer(key, self.frame.effects.root(value), self.frame.effects.key(value))
        if key in self.memory.escaped:  # who changes it any time changes what it refers to
            self.memory.escaped.add(self.frame.effects.root(value))
            state = self.memory.lost(state, {self.frame.effects.root(value)})
        held = Held("lost" if self._changes_behind(value, at) else "value", key, value, env, at)
        after = self.memory.hold(key, held, self.memory.parts_lost(key, state))
        return after if self.frame.python else self.memory.with_fields_of_others(key, state, after)

    def _changes_behind(self, value: Expr | None, at: int) -> bool:
        """Whether a function gives a reference, perhaps to a variable that it gets and that is changed somewhere."""
        if not isinstance(value, Call) or self.frame.python:
            return False
        changes, key = self.frame.outline.changes, self.frame.effects.key
        changed = any(isinstance(arg, Name) and changes.get(key(arg), 0) > 1 for arg in value.args)
        target = self.frame.effects.targets.target(value, self.frame.env.func, at) if changed else None
        return target is not None and not {"reference", "lending"}.isdisjoint(target.fact.traits)

    def _refer_to_parts(self, target: Items, value: Expr | None, at: int, env: Env, state: State) -> State:
        """`auto & [a, b] = pair;`: each is another name of a part of it."""
        for item in target.items:
            self.memory.sharing.refer(self.frame.effects.key(item), self.frame.effects.root(value))
        return self._named(target, Held("value", "", value, env, at), state)

    def _refer_through(self, target: Expr | None, value: Expr | None, env: Env) -> None:
        """`auto it = table.find(key);`: who writes to `it->second` changes the table, and the other way round.

        So does who writes to a field of what an element points to: `auto part = parts[0]; part->name = "b";`.
        """
        key, effects = self.frame.effects.key(target), self.frame.effects
        parts = [part for part in self.frame.outline.changes if part.startswith(f"{key}.")] if key else []
        root = effects.root(value) if parts and not self.frame.python else ""
        callee = value.callee if isinstance(value, Call) else None
        found = isinstance(callee, Member) and callee.name in effects.calls.iterators | effects.calls.searching
        if root and value and (found or (is_element(value) and self.frame.judge.may_point(value, env))):
            for part in parts:
                self.memory.sharing.refer(part, root)

    def _refer_by_pointer(self, let: Statement, at: int, state: State) -> None:
        """`auto b = a;` of a pointer: what one points to, the other does, of raw ones whoever made the object."""
        key, other = self.frame.effects.key(let.target), self.frame.effects.key(let.value)
        if self.frame.python or let.kind not in {"let", "set"} or not key or not other or isinstance(let.value, Op):
            return
        written = self.frame.env.func.written_types
        raw = written.get(key, "").endswith("*") or written.get(other, "").endswith("*")
        made = let.kind == "let" and all(map(makes_pointer, state.holds.get(other) or (Held("lost", other),)))
        once = all(self.frame.outline.changes.get(each, 0) <= 1 for each in (key, other))
        if once and (made or raw):
            self.memory.sharing.refer(key, other, other)
        elif raw or (self._points(other) and not self._is_moved(let, at)):
            self.memory.sharing.refer(key, other)

    def _points(self, key: str) -> bool:
        """Whether a variable of C++ is a pointer, by its type or by what it is made with."""
        func = self.frame.env.func
        written = func.written_types.get(key, "")
        made = (entry.value for entry in func.fact.body if entry.kind == "let" and entry.target == Name(key))
        points = plain(written) not in {"", "auto"} and not by_value(written) and not written.endswith("&")
        return points or any(is_address(value) or (value is not None and pointed(value) != "") for value in made)

    def _is_moved(self, let: Statement, at: int) -> bool:
        """Whether a statement moves from what it gives, which has nothing in common with that from then on."""
        behind = self.frame.env.func.fact.body[at + 1 : at + 1 + MAX_MOVED]
        return any(entry.target == let.value and entry.value == MOVED for entry in behind)

    def bind(self, target: Expr | None, held: Held, state: State) -> State:
        """Give a variable, a field, an element or several variables what a statement gives them."""
        if isinstance(target, Items):
            return self._unpack(target, held, state)
        key = self.frame.effects.key(target)
        if key:
            held = Held("lost", key) if self._is_set_by_method(key) else held
            held.name = key
            state = self.memory.hold(key, held, self.memory.parts_lost(key, state))
            return self._after_rebinding(key, state)
        root = self.frame.effects.root(target)
        if not root:
            return self._one_of_several(target, held, state)
        if isinstance(target, Op) and target.op == "[]" and self.frame.effects.key(target.operands[0]) == root:
            before = self.memory.known(root, state, held.env)
            stored = Held("stored", root, target.operands[1], held.env, held.at, held.expr, before)
            new = stored if held.how == "value" else Held("lost", root, before=before)
            return self.memory.in_place(root, new, self.memory.parts_lost(root, state))
        return self.memory.in_place(root, Held("lost", root, before=state.holds.get(root, ())), state)

    def _named(self, target: Expr | None, held: Held, state: State) -> State:
        """Give new variables what they stand for; in C++ none of them writes to what another one refers to."""
        if isinstance(target, Items):
            for each in handed_out(target, held, of_maker(held.expr, self.frame.python)):
                state = self._named(each.target, each.held, state)
            return state
        key = self.frame.effects.key(target)
        if not key or self.frame.python:
            return self.bind(target, held, state)
        held.name = key
        return self.memory.hold(key, held, self.memory.parts_lost(key, state))

    def _is_set_by_method(self, key: str) -> bool:
        """Whether a field of Python is a property, whose method makes what it likes of what it gets."""
        owner = self.frame.env.func if key.startswith(".") else None
        return self.frame.python and "." in key and self.frame.effects.targets.has_setter(key.rpartition(".")[2], owner)

    def _one_of_several(self, target: Expr | None, held: Held, state: State) -> State:
        """`std::tie(a, b) = value` gives each its part; `(test ? a : b) = value` gives one or the other something."""
        if isinstance(target, Call) and isinstance(target.callee, Name) and last_name(target.callee.id) == _TIE:
            return self._unpack(Items(target.args), held, state)
        if self.frame.python:
            for key in {self.frame.effects.key(part) for part in shared_names(target, self.frame.body)} - {""}:
                state = self.memory.in_place(key, Held("lost", key, before=state.holds.get(key, ())), state)
            return state
        within = children(target) if isinstance(target, Call | Op) else ()
        return self.memory.lost(state, {self.frame.effects.root(part) for part in within} - {""})

    def _after_rebinding(self, key: str, state: State) -> State:
        """In C++ a reference that is assigned writes through, and references to what is assigned see it.

        A field of Python is one of all names of its object.
        """
        if self.frame.python:
            return self.memory.in_part(key, state.holds[key][0], state) if "." in key else state
        same, touched = self.memory.sharing.meant(key, state)
        self.memory.tell(same - {key}, state.holds[key][0])
        self.memory.tell(touched, Held("lost", key))
        return self.memory.lost(state, touched).having(dict.fromkeys(same, state.holds[key]))

    def _unpack(self, target: Items, held: Held, state: State) -> State:
        """`a, b = value`: each gets its part, all of them at once."""
        value = of_maker(held.expr, self.frame.python)
        for each in handed_out(target, held, value):
            state = self.bind(each.target, each.held, state)
        return state

    def escape(self, statement: Statement) -> Set[str]:
        """`p = &x`, `p = &x[0]`: from here on `x`, and what it refers to or is a part of, may change through `p`.

        So may what `p = x.begin()` points into, where the function writes through `p`.
        """
        found: set[str] = set()
        for key in self._pointed(statement) if not self.frame.python else ():
            found |= self.memory.sharing.with_shared(self.memory.sharing.names_of(key))
        self.memory.escaped |= found
        return found

    def _pointed(self, statement: Statement) -> Set[str]:
        value, effects = statement.value, self.frame.effects
        lent = {effects.key(each) for each in referred(value)} & effects.own
        if lent:
            return lent
        addressed = {key for given in addressed_in(value) if (key := self._addressed_in(given))}
        if addressed or is_address(value):
            return addressed
        pointer, outline = effects.key(statement.target), self.frame.outline
        pointed = set(self._iterated(value)) & effects.own if isinstance(value, Op | Call) else set()
        if statement.type.endswith("*") and isinstance(value, Call) and self._gives_way(value):
            pointed.add(effects.root(value))
        if not pointed or any(each.startswith(f"{pointer}.") for each in outline.changes):
            return set()
        return pointed if self._writes_through(pointer) else set()

    def _addressed_in(self, given: Expr) -> str:
        """The variable of the function that a pointer leads into, be it to an element of it; empty for others."""
        key = self.frame.effects.key(given)
        if key:
            return key if key.partition(".")[0] in self.frame.effects.own else ""
        return self.frame.effects.root(given) if is_element(given) else ""

    def _gives_way(self, call: Call) -> bool:
        """Whether a method of an object of the function gives a pointer, or a reference, to what may be changed."""
        target = self.frame.judge.target(call, self.frame.env.func, len(self.frame.body))
        return target is not None and "reference" in target.fact.traits and bool(self.frame.effects.root(call))

    def _writes_through(self, pointer: str) -> bool:
        """Whether the body changes what a variable points to; `*p = x` is written as `p = x` in its facts."""
        if pointer in self.frame.outline.written_through:
            return True
        sets = (entry for entry in self.frame.env.func.fact.body if entry.kind == "set")
        own = (entry for entry in sets if self.frame.effects.key(entry.target) == pointer)
        return any(not self._moves(entry.value, pointer) for entry in own)

    def _moves(self, value: Expr | None, pointer: str) -> bool:
        """Whether a value is another place to point to: a step from this one, or what a call makes of one."""
        if isinstance(value, Op) and value.op in {"+", "-"}:
            first, *rest = value.operands
            return self.frame.effects.key(first) == pointer and not any(isinstance(each, Text) for each in rest)
        return any(self._iterated(value)) or any(self.frame.effects.key(each) == pointer for each in arguments(value))

    def _iterated(self, value: Expr | None) -> Iterator[str]:
        """Yield the variables into which parts of a value point: `&x[0]`, `x.begin() + 1`, `find(x.begin(), y)`."""
        effects = self.frame.effects
        if is_address(value) and isinstance(value, Op):
            yield effects.root(value.operands[0])
        elif isinstance(value, Op) and value.op in {"+", "-"}:
            for operand in value.operands:
                yield from self._iterated(operand)
        elif isinstance(value, Call):
            callee = value.callee
            if isinstance(callee, Member) and callee.name in effects.calls.iterators | effects.calls.searching:
                yield effects.root(callee.base)
            for arg in value.args:
                yield from self._iterated(arg)

    def enter(self, each: Statement, state: State) -> None:
        """Note that the variable of a loop is a part of what the loop is over, or points to one."""
        self.memory.sharing.enter(each)
        if each.value is not None and not self.frame.python:
            self._refer_through(each.target, Op("[]", (each.value, Number(0))), self.frame.place(state))

    def element(self, each: Statement, at: int, state: State) -> State:
        """Return the state in which a loop has bound its variable to any element."""
        state = self._declared(each.target, state)
        return self._named(each.target, Held("each", "", each.value, self.frame.place(state), at), state)

    def known_element(self, each: Statement, item: Bound, at: int, state: State) -> State:
        """Return the state in which a loop has bound its variable to an element that is known."""
        state = self._declared(each.target, state)
        own = item.env.func is self.frame.env.func  # the place of a statement means something in its function only
        return self._named(each.target, Held("value", "", item.expr, item.env, at if own else -1), state)


def _is_empty(held: Held) -> bool:
    """Tell whether a variable was declared without a value, or with empty braces."""
    return held.how == "made" or (held.how == "value" and isinstance(held.expr, Call) and not held.expr.args)
