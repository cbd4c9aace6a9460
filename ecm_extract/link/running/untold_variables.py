"""Variables that are given nothing but what is untold (see `untold`), whoever gives it."""

from __future__ import annotations

from collections.abc import Iterator, Set
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Member, Op, Table

from ecm_extract.infer.effect import Kind
from ecm_extract.infer.places import target_of
from ecm_extract.link.code.numbers import kind_of_type
from ecm_extract.link.code.spelling import by_value, pointee, template_arguments
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import given_to
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder
    from ecm_extract.link.running.untold import Untold


_KEPT: Final[Set[Kind]] = frozenset({"handed", "reached"})
"""What calls do to variables of Python that mean the same after it."""
_EMPTY: Final = (Items(()), Table(()))


class Variable(NamedTuple):
    """A variable of a function, or a member of the objects of a class, by its key (see `places`).

    `of_parts` asks for what it consists of: one that begins empty, and is filled with what is untold, is told itself.
    """

    owner: Func | Cls
    key: str
    of_parts: bool


class UntoldVariables:
    """Looks at all statements that give a variable something."""

    def __init__(self, folder: Folder, untold: Untold) -> None:
        self.folder = folder
        self.untold = untold

    def is_untold(self, variable: Variable) -> bool:
        """Tell whether a variable is given something, and nothing that is told."""
        owner = variable.owner
        whole = self._of_member(variable, owner) if isinstance(owner, Cls) else self._of_local(variable, owner)
        given = list(whole)
        return bool(given) and all(given)

    def is_given(self, key: str, func: Func) -> bool:
        """Tell whether a function gives a variable anything, or lets functions of the tree do so."""
        outline = self.folder.flow.outline(func)
        if key not in outline.changes or func.file.language != "python":
            return key in outline.changes
        calls = (call for at in range(len(func.fact.body)) for call in self._calls(key, func, at, _KEPT))
        return key in outline.given or any(calls)

    def _of_local(self, variable: Variable, func: Func) -> Iterator[bool]:
        key = variable.key
        parameter = next((each for each in func.fact.params if each.name == key), None)
        if parameter is not None:
            from_outside = self._is_of_library(parameter.type, func) or self._is_argument(key, func)
            yield parameter.default is None and from_outside
        yield from self._given(variable, func)

    def _of_member(self, variable: Variable, cls: Cls) -> Iterator[bool]:
        program, name = self.folder.program, variable.key[1:]
        for owner in dict.fromkeys((*program.ancestry(cls), *program.derived(cls))):
            default = owner.fields[name].default if name in owner.fields else None
            if default is not None and not (variable.of_parts and default in _EMPTY):
                yield False
            for method in self.folder.scope.changing(name, owner):
                yield from self._given(variable, method)

    def _is_of_library(self, written: str, func: Func) -> bool:
        """Whether a type of C++ is a reference or pointer to an object of a class that the tree does not have."""
        kind = pointee(written)
        if by_value(written) or "::" not in kind or kind_of_type(kind) or template_arguments(kind):
            return False
        return self.folder.objects.class_written(written, Env(func)) is None

    def _is_argument(self, name: str, func: Func) -> bool:
        """Whether all calls give a parameter something untold; templates make objects where no call is written."""
        known = self.folder.states.callers
        callers = list(known.making_by(func) if func.is_constructor else known.all(func))
        given = (bind(func, call, place).get(name) for call, place in callers)
        told = (each is None or not self.untold.has(each.expr, each.env.func, each.env.at) for each in given)
        return not any(told) and (bool(callers) or not func.is_constructor)

    def _given(self, variable: Variable, func: Func) -> Iterator[bool]:
        """Yield whether it is untold for each thing that a function gives a variable."""
        outline, key = self.folder.flow.outline(func), variable.key
        if key in outline.escaped:
            yield False
        for at in range(len(func.fact.body)):
            if key in outline.changed_by(at):
                if not (variable.of_parts and func.fact.body[at].value in _EMPTY):
                    yield from self._assigned(key, func, at)
                yield from (each for each in self._filled(key, func, at) if variable.of_parts or not each)

    def _assigned(self, key: str, func: Func, at: int) -> Iterator[bool]:
        """The values that a statement gives a variable; functions of libraries give it what they like."""
        statement, outline = func.fact.body[at], self.folder.flow.outline(func)
        target, value = target_of(statement), statement.value
        if outline.reads.get(at):
            yield False
        if statement.kind == "each" and value is not None:
            yield self.untold.has_within(value, func, at)
        elif statement.kind != "do" and value is not None and self._is_whole(target, key, func):
            yield self.untold.has(value, func, at)
        kept: Set[Kind] = _KEPT if func.file.language == "python" else frozenset()
        for call in self._calls(key, func, at, kept):
            if not self._is_on(call, key, func):
                yield self.folder.flow.target(call, func, at) is None

    def _filled(self, key: str, func: Func, at: int) -> Iterator[bool]:
        """The elements that a variable gets, and their places: of tables it matters what they are asked for."""
        statement, effects = func.fact.body[at], self.folder.flow.effects(func)
        target, value = target_of(statement), statement.value
        if statement.kind != "do" and value is not None and effects.root(target) == key and not effects.key(target):
            place = target.operands[1:] if isinstance(target, Op) else ()
            yield self._any((*place, value), func, at)
        for call in self._calls(key, func, at):
            others = tuple(each for each in given_to(call) if effects.key(each) != key)
            if self._is_on(call, key, func) and (others or self.folder.flow.target(call, func, at) is not None):
                yield self.folder.flow.target(call, func, at) is None and self._any(others, func, at)

    def _is_whole(self, target: Expr | None, key: str, func: Func) -> bool:
        return self.folder.flow.effects(func).key(target) == key or isinstance(target, Items)

    def _calls(self, key: str, func: Func, at: int, kept: Set[Kind] = frozenset()) -> Iterator[Call]:
        """The calls of a statement that may change a variable, by kinds of effects but some."""
        effects = self.folder.flow.effects(func).of(at)
        return (effect.call for effect in effects if effect.key == key and effect.kind not in kept)

    def _is_on(self, call: Call, key: str, func: Func) -> bool:
        return isinstance(call.callee, Member) and self.folder.flow.effects(func).root(call.callee.base) == key

    def _any(self, exprs: tuple[Expr, ...], func: Func, at: int) -> bool:
        return any(self.untold.has(each, func, at) for each in exprs)
