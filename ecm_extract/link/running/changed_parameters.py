"""Parameters of which a function may change what they consist of, and whether its body shows what it does."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Constant, Expr, Member, Op

from ecm_extract.infer.bare_names import bare_names
from ecm_extract.infer.effect import Effect
from ecm_extract.infer.effects import Effects, is_within
from ecm_extract.infer.library_calls import calls_of
from ecm_extract.infer.other_names import changed_as_others
from ecm_extract.infer.pointing import is_address
from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.overloads import score
from ecm_extract.link.code.spelling import by_value, may_be_written
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.env import Env, invocation_of
from ecm_extract.link.running.left_by_makers import LeftByMakers

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


MAX_FIELDS: Final = 16
"""Fields of an object that are told apart; who changes more changes the object."""


class ChangedParameters:
    """Tells it; each parameter is asked about once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._changing: dict[tuple[Func, str], bool] = {}
        self._hidden: dict[tuple[Func, str], bool] = {}
        self._fields: dict[tuple[Func, str], Set[str] | None] = {}
        self.makers = LeftByMakers(folder)

    def is_left(self, call: Call, arg: Expr, func: Func, at: int) -> bool:
        """Tell whether the class of Python that a call makes an object of leaves an argument alone and keeps it not."""
        return self.makers.is_left(call, arg, func, at)

    def may(self, func: Func, name: str) -> bool:
        """Tell whether a function may change what its parameter consists of; in C++ the fields of that."""
        if func.file.language == "cpp":
            return any(each.startswith(f"{name}.") for each in self.folder.flow.outline(func).changes)
        key = (func, name)
        known = self._changing.get(key)
        if known is None:
            self._changing[key] = True  # who asks in a circle is told that it may
            by_name = self.folder.flow.effects(func).may_change(name)
            known = self._changing[key] = by_name or self.is_hidden(func, name)
        return known

    def gives(self, func: Func, name: str) -> bool:
        """Tell whether a function of C++ may give what its pointer leads to something else.

        `*p = x` is written as `p = x` in its facts.
        """
        effects = self.folder.flow.effects(func)
        sets = (each for each in func.fact.body if each.kind == "set" and effects.key(each.target) == name)
        given = any(not _is_place(each.value, name, effects) for each in sets)
        return given or any(each.kind not in {"handed", "reached"} for each in self._on(func, name))

    def hands(self, func: Func, name: str) -> bool:
        """Tell whether a function of C++ hands its pointer to somebody who is not seen."""
        return any(self._on(func, name))

    def _on(self, func: Func, name: str) -> Iterator[Effect]:
        """What calls in a function do to a parameter."""
        effects = self.folder.flow.effects(func)
        done = (each for at in range(len(func.fact.body)) for each in effects.of(at))
        return (each for each in done if each.key == name)

    def rivals(self, call: Call, func: Func, at: int) -> Sequence[Func]:
        """Return the functions of C++ that a call in a statement may mean as well as the one that it is held to."""
        env = Env(func, at, this=func.cls)
        invocation = invocation_of(call, env)
        first, *others = self.folder.objects.callees(invocation, env) or (None,)
        alike = [each for each in others if first is not None and score(invocation, each) == score(invocation, first)]
        return [*alike, *self._overriding(call, env)]

    def _overriding(self, call: Call, env: Env) -> Iterator[Func]:
        """The methods that run in place of one which a call names by a pointer or reference to a base."""
        method = call.callee
        cls = self.folder.objects.class_of(method.base, env) if isinstance(method, Member) else None
        if not isinstance(method, Member) or cls is None or by_value(self.folder.objects.type_of(method.base, env)):
            return
        for derived in self.folder.program.derived(cls):
            named = (each for each in derived.methods if each.fact.name == method.name)
            yield from (each for each in named if len(each.fact.params) >= len(call.args))

    def may_by(self, call: Call, func: Func, at: int) -> bool:
        """Tell whether a call in a statement of a function, of one of the tree, may change its first argument."""
        target = self.folder.flow.target(call, func, at)
        if target is None:
            return False
        own = (
            isinstance(call.callee, Member) and target.holder is not None and self.changes_object(call.callee, func, at)
        )
        return own or any(self.may(target, entry.name) for entry in target.fact.params[:1])

    def changes_object(self, method: Member, func: Func, at: int) -> bool:
        """Tell whether a method that a statement of a function of Python hands on may change what it is a method of."""
        if method.name in calls_of("python").changing:
            return True
        target = self.folder.flow.target(Call(method, ()), func, at)
        if target is None or target.cls is None:
            return not self.folder.methods.all_leave(method.name, func)
        return not self.folder.methods.leaves(target, target.cls)

    def changes_by_class(self, method: Member, func: Func) -> bool:
        """Tell whether a method that Python calls by its class may change the object that it gets: `Base.reset(x)`."""
        program = self.folder.program
        cls = program.class_named(dotted_name(method.base), func.file, func.fact.scope)
        methods = [each for entry in program.ancestry(cls) for each in entry.methods] if cls is not None else []
        named = (each for each in methods if each.fact.name == method.name)
        return cls is not None and any(not self.folder.methods.leaves(each, cls) for each in named)

    def leaves_object(self, method: Func) -> bool:
        """Tell whether a method changes no member of its object, and calls no other one that might."""
        if "const" in method.fact.traits:
            return True
        own = self.folder.flow.own.is_own
        calls = any(own(call, method, at) for at, group in enumerate(method.calls) for call in group)
        return not calls and not any(key.startswith(".") for key in self.folder.flow.outline(method).changes)

    def fields(self, func: Func, name: str) -> Set[str] | None:
        """Return the fields of a parameter that a function changes, by key; None where it may do anything to it."""
        key = (func, name)
        if key not in self._fields:
            self._fields[key] = None  # who asks in a circle
            self._fields[key] = self._fields_of(func, name)
        return self._fields[key]

    def _fields_of(self, func: Func, name: str) -> Set[str] | None:
        outline = self.folder.flow.outline(func)
        changed = frozenset(key for key in outline.changes if is_within(key, name))
        given = any(outline.effects.key(arg) == name for group in func.calls for call in group for arg in call.args)
        shown = "reference" in func.fact.traits or name in outline.exposed or name in changed
        others = any(param.name != name and may_be_written(param.type) for param in func.params)  # of the same object
        if given or shown or others or len(changed) > MAX_FIELDS or not self.folder.lent.is_one(func):
            return None
        return None if self.is_hidden(func, name) else changed

    def is_hidden(self, func: Func, name: str) -> bool:
        """Tell whether it does, or may, by a method, by another name, or in a function within it."""
        key = (func, name)
        known = self._hidden.get(key)
        if known is None:
            self._hidden[key] = True  # who asks in a circle
            found = self._by_methods(func, name) or self._is_put_away(func, name) or self._inside(func, name)
            known = self._hidden[key] = found or name in changed_as_others(self.folder.flow.outline(func), name)
        return known

    def _by_methods(self, func: Func, name: str) -> bool:
        """Whether a method of it, or of a part of it, may change its object."""
        effects = self.folder.flow.effects(func)
        called = {callee.name for _, callee in _methods(func) if is_within(effects.root(callee.base), name)}
        return not all(self.folder.methods.all_leave(each, func) for each in called)

    def _is_put_away(self, func: Func, name: str) -> bool:
        """Whether it is put into something, by a method of that, which may be changed through it."""
        effects = self.folder.flow.effects(func)
        puts = (call for call, callee in _methods(func) if callee.name in effects.calls.changing)
        given = (each for call in puts for arg in call.args for each in bare_names(arg))
        return any(effects.key(each) == name for each in given)

    def _inside(self, func: Func, name: str) -> bool:
        """Whether a function within it may change it."""
        inner = (each for each in self.folder.nesting.inner(func) if name not in self.folder.flow.effects(each).own)
        return any(
            name in self.folder.shifting.names(each) and (self.may(each, name) or self._is_bound(each, name))
            for each in inner
        )

    def _is_bound(self, func: Func, name: str) -> bool:
        return any(is_within(key, name) for key in self.folder.flow.outline(func).changes)


def _is_place(value: Expr | None, name: str, effects: Effects) -> bool:
    """Whether a value is another place to point to: an address, none, or a step from where a pointer leads."""
    moved = isinstance(value, Op | Member) and effects.root(value) == name
    step = isinstance(value, Op) and value.op in {"+", "-"} and effects.key(value.operands[0]) == name
    return moved or step or is_address(value) or value == Constant("null")


def _methods(func: Func) -> Iterator[tuple[Call, Member]]:
    for group in func.calls:
        for call in group:
            if isinstance(call.callee, Member):
                yield call, call.callee
