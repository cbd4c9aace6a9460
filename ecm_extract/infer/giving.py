"""Variables of C++ that others have a way to: a reference, or a pointer, which an object or a container keeps.

`std::vector<Topic *> all{&one};` or `Writer writer(one);`: from here on whoever is called, and what is written through
what is no variable itself, may change `one`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.held import State, all_ways
from ecm_extract.infer.memory import Memory
from ecm_extract.infer.pointing import is_address, makes_pointer
from ecm_extract.infer.run import Frame
from ecm_extract.link.code.containers import is_container, makes_tuple
from ecm_extract.link.code.spelling import by_value, last_name, pointee

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Env

_REFERRING: Final = frozenset({"std::ref", "boost::ref"})
_RAW: Final = "get"
"""Method of smart pointers that gives the pointer itself."""


class WaysGiven(NamedTuple):
    """The ways that a statement gives, whatever the state is in which it runs.

    Attributes:
        kept: variables, or their addresses, that something keeps. copied: what may be a pointer that is copied.
        sees: whether what it makes has a way to something that the function changes later.
    """

    kept: tuple[Expr, ...]
    copied: Expr | None
    sees: bool


class Giving:
    """Notes such variables, and what becomes of them."""

    def __init__(self, frame: Frame, memory: Memory) -> None:
        self.frame = frame
        self.memory = memory
        self.given: set[str] = set()
        self.pointers: set[str] = set()

    def note(self, statement: Statement, at: int, env: Env, state: State) -> bool:
        """Note the variables to which a statement gives others a way.

        Returns:
            Whether what it makes has a way to something that the function changes later.
        """
        if self.frame.python:
            return False
        known = self.frame.outline.ways_given
        if at not in known:
            seen = statement.kind == "let" and any(self._is_changed_behind(arg, at) for arg in self._seen(at, env))
            known[at] = WaysGiven(tuple(self._kept(statement, at, env)), _copied(statement), seen)
        given = known[at]
        for arg in given.kept:
            self._note(arg, state)
        if given.copied is not None and self._is_pointer(self.frame.effects.key(given.copied), state):
            self._note(given.copied, state)
        return given.sees

    def _seen(self, at: int, env: Env) -> Iterator[Expr]:
        """Yield the arguments of the calls of a statement that what they make only reads later."""
        for call in self.frame.env.func.calls[at]:
            if self._gives_variables(call):
                found = self.frame.judge.kept_arguments(call, env)
                yield from (call.args[kept.at] for kept in found if not kept.changes)

    def _is_changed_behind(self, arg: Expr, at: int) -> bool:
        """Whether a statement behind one changes a variable, or a field of it."""
        root, outline = self.frame.effects.root(arg), self.frame.outline
        later = (key for each in range(at + 1, len(self.frame.body)) for key in outline.changed_by(each))
        return bool(root) and any(key == root or key.startswith(f"{root}.") for key in later)

    def _note(self, arg: Expr, state: State) -> None:
        effects = self.frame.effects
        meant = arg.operands[0] if is_address(arg) and isinstance(arg, Op) else arg
        root = effects.root(meant)
        if root.partition(".")[0] not in effects.own:
            return
        if meant is arg and self._is_pointer(root, state):
            self.pointers |= self.memory.sharing.names_of(root)
        else:
            self.given |= self.memory.sharing.names_of(root)

    def _is_pointer(self, key: str, state: State) -> bool:
        written = self.frame.env.func.written_types.get(key, "")
        if written.endswith("*") or pointee(written) != written.removeprefix("const ").rstrip("& "):
            return True
        return any(map(makes_pointer, all_ways(state.holds.get(key, ()))))

    # --- who keeps a way -------------------------------------------------------------------------------------

    def _kept(self, statement: Statement, at: int, env: Env) -> Iterator[Expr]:
        """Yield the variables, or their addresses, that calls of a statement keep."""
        value = statement.value
        for call in self.frame.env.func.calls[at]:
            yield from self._kept_by(call, env)
        if isinstance(value, Items):
            yield from self._ways(value)

    def _kept_by(self, call: Call, env: Env) -> Iterator[Expr]:
        callee = call.callee
        if isinstance(callee, Member):
            if callee.name == _RAW and not call.args:
                yield callee.base
            if callee.name in self.frame.effects.calls.changing:
                kept = self.frame.judge.kept_arguments(call, env)
                yield from (way for each in kept for way in self._ways(call.args[each.at]))
                return
        path = callee.id if isinstance(callee, Name) else ""
        if path in _REFERRING:
            yield from call.args
        elif path and (makes_tuple(call) or is_container(path)):
            yield from (way for arg in call.args for way in self._ways(arg))
        elif self._gives_variables(call):
            yield from (call.args[kept.at] for kept in self.frame.judge.kept_arguments(call, env) if kept.changes)

    def _gives_variables(self, call: Call) -> bool:
        """Whether any argument is a variable of the function, or the address of one."""
        args = (arg.operands[0] if is_address(arg) and isinstance(arg, Op) else arg for arg in call.args)
        return any(isinstance(arg, Name) and arg.id in self.frame.effects.own for arg in args)

    def _ways(self, expr: Expr) -> Iterator[Expr]:
        """Yield the addresses and the variables, which may be pointers, that an expression puts somewhere."""
        if isinstance(expr, Items):
            for item in expr.items:
                yield from self._ways(item)
        elif is_address(expr) or isinstance(expr, Name):
            yield expr

    # --- what becomes of them --------------------------------------------------------------------------------

    def used(self, state: State) -> State:
        """Return the state after somebody may have used any such way."""
        if not self.given and not self.pointers:
            return state
        return self.memory.lost(self._without_parts(self.pointers, "", state), self.given)

    def written(self, target: Expr | None, state: State) -> State:
        """Return the state after something was written to a place that may be one of them."""
        if not (self.given or self.pointers) or self._is_itself(target):
            return state
        suffix = f".{target.name}" if isinstance(target, Member) else ""
        own = self.memory.sharing.names_of(self.frame.effects.key(target).rpartition(".")[0])
        if not suffix:
            return self.used(state)
        state = self._without_parts(self.pointers - own, suffix, state)
        fields = {name + suffix for name in self.given - own}
        return self.memory.lost(state, fields)

    def _is_itself(self, target: Expr | None) -> bool:
        """Whether what is written to is a variable that is an object itself, or a field of one."""
        base = target.base if isinstance(target, Member) else target
        written = self.frame.env.func.written_types.get(base.id, "") if isinstance(base, Name) else ""
        return by_value(written) and pointee(last_name(written)) == last_name(written)

    def _without_parts(self, pointers: set[str], suffix: str, state: State) -> State:
        """The state in which nobody knows the fields of what pointers point to, those that a suffix ends if any."""
        parts = (key for pointer in pointers for key in state.holds.within(pointer))
        return self.memory.lost(state, [key for key in parts if key.endswith(suffix)])


def _copied(statement: Statement) -> Expr | None:
    """What a statement gives something else as it is."""
    value = statement.value
    return value if statement.kind in {"set", "init"} and isinstance(value, Name | Member) else None
