"""Which variables a statement changes beside the one that it binds: calls on them, and calls that get them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from itertools import chain
from typing import TYPE_CHECKING, Final

import msgspec
from ecm_parsers.source.expr import (
    THIS,
    Call,
    Constant,
    Expr,
    Items,
    Lambda,
    Member,
    Name,
    Number,
    Op,
    Table,
    Template,
    Text,
)
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.bare_names import bare_names, shared_names
from ecm_extract.infer.by_class import by_class
from ecm_extract.infer.by_reference import by_reference
from ecm_extract.infer.chosen_effects import by_method_pointer, given_to_chosen, on_chosen
from ecm_extract.infer.effect import Effect, Kind
from ecm_extract.infer.finding import found
from ecm_extract.infer.handed_functions import HandedFunctions
from ecm_extract.infer.led_into import led_into
from ecm_extract.infer.library_calls import calls_of
from ecm_extract.infer.parameter_names import name_at, name_for
from ecm_extract.infer.places import ALL_FIELDS, key_of, root_of, whole_of
from ecm_extract.infer.reading_calls import leaves_arguments
from ecm_extract.infer.swapping import swapped, swaps
from ecm_extract.infer.targets import Targets
from ecm_extract.infer.unpacking import unstarred
from ecm_extract.link.code.containers import ELEMENT_METHODS
from ecm_extract.link.code.spelling import is_constant_value, last_name
from ecm_extract.link.code.walk import given_to, last_of

if TYPE_CHECKING:
    from ecm_extract.link.code.units import Func

_SETATTR: Final = Name("setattr")


class Effects:
    """The effects of the statements of one function.

    Args:
        func: the function. own: its names. targets: who resolves calls.

    Attributes:
        base: the key of what an object of C++ has of its first base; empty for none.
    """

    def __init__(self, func: Func, own: Set[str], targets: Targets) -> None:
        self.func = func
        self.own = own
        self.targets = targets
        self.python = func.file.language == "python"
        self.member = func.cls is not None and not self.python
        self.calls = calls_of(func.file.language)
        bases = func.cls.fact.bases if self.member and func.cls is not None else ()
        self.base = f".{last_name(bases[0])}" if bases else ""
        self._functions = HandedFunctions(self)
        self._known: dict[int, tuple[Effect, ...]] = {}
        self._members: dict[str, bool] = {}
        self._of_library: dict[str, bool] = {}

    def key(self, expr: Expr | None) -> str:
        """Return the key of the variable that an expression is, empty for none."""
        meant = expr if isinstance(expr, Name) else self.reached(expr)
        return key_of(meant, self.own, self.is_member)

    def reached(self, expr: Expr | None) -> Expr | None:
        """Return what is reached by it: `box.topic` for `box.inner()`, `box.topic.name` for `box.inner().name`."""
        if not isinstance(expr, Call | Member):
            return expr
        if isinstance(expr, Call):
            shown = self.targets.shown_part(expr, self.func)
            return self.reached(shown) if shown is not None else expr
        if not isinstance(expr.base, Call | Member):
            return expr
        part = self.reached(expr.base)
        return expr if part is None or part is expr.base else Member(part, expr.name)

    def root(self, expr: Expr | None) -> str:
        """Return the key of the variable that an expression reaches into, empty for none.

        In C++ `box.table` of `box.all()["a"]`, where the method gives a reference to that.
        """
        if self.python:
            return root_of(expr, self.own, self.is_member)
        while expr is not None:
            if key := self.key(expr):
                return key
            expr = whole_of(expr)
        return ""

    def may_change(self, name: str) -> bool:
        """Tell whether the function may change what its parameter consists of, or give it to somebody who may."""
        for at, statement in enumerate(self.func.fact.body):
            if any(is_within(effect.key, name) for effect in self.of(at)):
                return True
            keys = [(self.key(target), self.root(target)) for target in _each(statement.target)]
            within = any(key != name and is_within(root, name) for key, root in keys)
            grown = (name, name) in keys and statement.type.endswith("=")
            own = self.func.is_constructor and self.key(statement.target).startswith(".")  # which has it from then on
            kept = statement.kind in {"set", "return"} and self.key(statement.value) == name and not own
            if within or grown or kept:
                return True
        return False

    def is_member(self, name: str) -> bool:
        """Tell whether a name that the function does not declare is a member of its object."""
        if not self.member:
            return False
        known = self._members.get(name)
        if known is None:
            known = self._members[name] = not self.targets.is_outside(name, self.func)
        return known

    def of(self, at: int) -> tuple[Effect, ...]:
        """Return what the calls of a statement change, inner calls first."""
        known = self._known.get(at)
        if known is None:
            self._known[at] = ()  # who asks in a circle
            statement = self.func.fact.body[at]
            groups = (found(call, at, self) or self._of_call(call, at, statement) for call in self.func.calls[at])
            known = self._known[at] = (
                *chain.from_iterable(groups),
                *self._taken(statement),
                *given_to_chosen(statement.target, self),
            )
        return known

    def _taken(self, statement: Statement) -> Iterator[Effect]:
        """What a statement of Python may change since a call gives it a part of that: `next(iter([row]))[0] = 1`."""
        for target in _each(statement.target) if self.python else ():
            call = target
            while isinstance(call, Op | Member):
                call = call.operands[0] if isinstance(call, Op) else call.base
            if isinstance(call, Call) and call is not target:
                own = self.own if isinstance(call.callee, Name) and call.callee.id in self.own else ()
                yield from (Effect("handed", key, call) for key in sorted(own))  # what a function within it gives
                yield from (
                    Effect("handed", key, call)
                    for each in shared_names(call, self.func.fact.body)
                    if (key := self.key(each))
                )

    def _of_call(self, call: Call, at: int, statement: Statement) -> Iterator[Effect]:
        call = self._on_first(call)
        callee = call.callee
        if swaps(call, self):
            yield from swapped(call, self)
            return
        if self.python and callee == _SETATTR and call.args:
            yield Effect("lost", self.key(Member(call.args[0], ALL_FIELDS)), call)
        yield from self._set(call)
        if isinstance(callee, Member):
            yield from self._on_receiver(call, callee, at)
        yield from by_method_pointer(call, self)
        yield from by_class(call, self)
        path = callee.name if isinstance(callee, Member) else callee.id if isinstance(callee, Name) else ""
        last = path.rsplit("::", 1)[-1]
        passed = [(index, arg) for index, arg in enumerate(call.args) if self._passes(arg)]
        named = [(name, arg) for name, arg in call.keywords if self._passes(arg)]
        changing = isinstance(callee, Member) and last in self.calls.changing
        library = last in self.calls.reading and isinstance(callee, Name) and callee.id != last  # `std::move`
        yield from self._functions.given(call, last, at)
        within = self._put_into(call)
        led = tuple(led_into(call, self.calls.giving, self.func.fact.body)) if self.python else ()
        if not (passed or named or within or led) or library or changing:
            return
        target = self.targets.target(call, self.func, at)
        copies = isinstance(callee, Member) and last in self.calls.fluent
        if target is None and (copies or leaves_arguments(callee, self.func)):
            return
        own = isinstance(callee, Name) and callee.id in self.own  # a variable that holds a function is no library's
        if target is None and not own and self.targets.keeps(path):
            return
        params = target.fact.params if target is not None else ()
        for index, arg in passed:
            yield from self._given(call, arg, target, name_at(index, params), at)
        for name, arg in named:
            yield from self._given(call, arg, target, name_for(name, params), at)
        yield from self._by_rivals(call, passed, at)
        yield from (Effect("handed", key, call) for key in within)
        if led and (target is None or any(self.targets.parameters.may(target, entry.name) for entry in params)):
            yield from (Effect("reached", key, call) for each in led if (key := self.key(each)))

    def _by_rivals(self, call: Call, passed: Sequence[tuple[int, Expr]], at: int) -> Iterator[Effect]:
        """What other functions of C++ change that a call may mean as well."""
        for rival in self.targets.parameters.rivals(call, self.func, at) if not self.python else ():
            params = rival.fact.params
            taken = ((arg, params[index].name) for index, arg in passed if index < len(params))
            given = (each for arg, name in taken for each in self._given(call, arg, rival, name, at))
            yield from (Effect("lost", each.key, call) for each in given)

    def _on_first(self, call: Call) -> Call:
        """`list.append(rows, x)` of Python as `rows.append(x)`; any other call as it is."""
        callee = call.callee
        of_type = isinstance(callee, Member) and isinstance(callee.base, Name) and callee.base.id in self.calls.built_in
        if not (of_type and isinstance(callee, Member) and call.args and self.is_of_class(callee)):
            return call
        return msgspec.structs.replace(call, callee=Member(call.args[0], callee.name), args=call.args[1:])

    def is_of_class(self, method: Member) -> bool:
        """Tell whether a method of Python is none of an object that the function has, but a function of a class."""
        root = self.root(method.base)
        return self.python and bool(root) and not root.startswith(".") and root.partition(".")[0] not in self.own

    def _put_into(self, call: Call) -> list[str]:
        """The variables of Python that a call gets in a list or table, or as one of several: `work([a], b or c)`."""
        args = given_to(call) if self.python else ()
        made = (arg for arg in args if isinstance(arg, Items | Table | Op))
        return [key for arg in made for expr in bare_names(arg) if (key := self.key(expr))]

    def _on_receiver(self, call: Call, callee: Member, at: int) -> Iterator[Effect]:
        if callee.name not in self.calls.changing:
            if self._changes_object(call, at):
                yield from [Effect("reached", self.root(callee.base), call)] if is_element(callee.base) else ()
                yield from on_chosen(call, callee, self)
            return
        key = self.key(callee.base)
        reset = callee.name == "str" and not call.args
        if key and not reset:
            yield Effect("changed", key, call)
        elif not key and (root := self.root(callee.base)):
            yield Effect("lost", root, call)

    def _changes_object(self, call: Call, at: int) -> bool:
        """Whether a call of C++ is one of a method of the tree that may change its object."""
        target = self.targets.target(call, self.func, at) if not self.python else None
        return target is not None and target.cls is not None and not self.targets.parameters.leaves_object(target)

    def _set(self, call: Call) -> Iterator[Effect]:
        """What a setter changes that gives back its object: a variable, or the object at hand as what its base is."""
        expr: Expr = call
        while isinstance(expr, Call) and isinstance(expr.callee, Member) and expr.callee.name in self.calls.fluent:
            expr = expr.callee.base
        if isinstance(expr, Call) and isinstance(expr.callee, Name) and expr.callee.id in self.calls.fluent:
            expr = THIS
        elif expr is call:
            return
        key = self.base if expr == THIS else self.key(expr)
        if root := key or self.root(expr):
            yield Effect("changed" if key else "lost", root, call)

    def _passes(self, arg: Expr) -> bool:
        """Whether an argument is a variable, or leads into one."""
        if isinstance(arg, Name | Member):
            return arg != THIS
        if isinstance(arg, Op) and arg.op in {"&", "[]"}:
            return bool(self.root(arg.operands[0]))
        if is_element(arg) and not self.python:
            return bool(self.root(arg))
        return self.iterates(arg) or (isinstance(arg, Call) and bool(self.key(arg)))

    def iterates(self, arg: Expr) -> bool:
        """Tell whether an argument is an iterator that a method of a container gives."""
        return isinstance(arg, Call) and isinstance(arg.callee, Member) and arg.callee.name in self.calls.iterators

    def _given(self, call: Call, arg: Expr, target: Func | None, name: str, at: int) -> Iterator[Effect]:
        key, last = self.key(arg), last_of(call.callee)
        root = key or self.root(arg)
        if not root or self.is_of_library(root):
            return
        if self.python and target is None and self.targets.parameters.is_left(call, arg, self.func, at):
            return
        if target is None:
            made = isinstance(call.callee, Name) and last[:1].isupper()
            outside = made or (self.python and root.startswith("."))
            written = last in self.calls.writing
            if written or self.iterates(arg) or (isinstance(arg, Op) and arg.op == "&"):
                yield Effect("lost", root, call)
            elif self.python or not (outside or self._is_constant(root)):
                yield Effect("handed" if key else _within(arg), root, call)
        elif self.python:
            if "generator" in target.fact.traits and not target.fact.decorators:
                yield Effect("lost", root, call)  # it runs when somebody asks it for something
            elif self.targets.parameters.may(target, name.lstrip("*")):
                yield Effect("out" if key and name[:1] != "*" else _within(arg), root, call, name)
        else:
            yield from by_reference(call, arg, target, name, self)

    def is_of_library(self, key: str) -> bool:
        """Tell whether a variable of Python is what a module outside of the tree has: a class, an enumerator."""
        first = key.partition(".")[0] if self.python else ""
        if first not in self.func.file.imported:
            return False
        if first not in self._of_library:
            self._of_library[first] = self.targets.is_of_library(first, self.func)
        return self._of_library[first]

    def _is_constant(self, key: str) -> bool:
        """Whether a variable of C++ is declared so that nobody can change it."""
        written = self.func.written_types.get(key, "")
        return "const" in written.split() or written.split()[:1] == ["constexpr"] or self.is_constant_value(key)

    def is_constant_value(self, key: str) -> bool:
        """Whether a variable of C++, one of a loop too, is declared as a constant that is no pointer."""
        each = (entry.type for entry in self.func.fact.body if entry.kind == "each" and entry.target == Name(key))
        return not self.python and is_constant_value(self.func.written_types.get(key) or next(each, ""))


def is_element(expr: Expr) -> bool:
    """Whether an object of C++ is one of several, or lies in one: `rows[0]`, `rows.back().part`."""
    while isinstance(expr, Member):
        expr = expr.base
    callee = expr.callee if isinstance(expr, Call) else None
    return (isinstance(callee, Member) and callee.name in ELEMENT_METHODS) or (isinstance(expr, Op) and expr.op == "[]")


def _each(target: Expr | None) -> Iterator[Expr | None]:
    """The variables that an assignment gives something: each of `a[0], b[0] = pair`."""
    if not isinstance(target, Items):
        yield target
        return
    for item in target.items:
        yield from _each(unstarred(item))


def _within(arg: Expr) -> Kind:
    """What becomes of a variable of Python of which somebody gets a part: who has an element puts no other in place."""
    return "reached" if isinstance(arg, Op) and arg.op == "[]" else "lost"


def is_within(key: str, name: str) -> bool:
    """Tell whether a variable is one of a name, or a field of that, at any depth."""
    return key == name or key.startswith(f"{name}.")


def is_plain(expr: Expr | None) -> bool:
    """Tell whether an expression is a value that nobody can change in place: a text, a number, a function."""
    if isinstance(expr, Text | Number | Constant | Template | Lambda):
        return True
    return isinstance(expr, Op) and expr.op in {"%", "-", "*", "/", "//", "==", "!=", "<", ">", "!", "format"}
