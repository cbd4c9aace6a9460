"""Lists, tables and objects of Python that others keep, and change, by names of their own: `self.rows = p.rows`.

Whoever changes `self.rows[0]` then changes `p.rows`. A name stands for a variable of a module, a member of the objects
of a class, or what functions of that name give; of whose object a member is need not be known.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from ecm_parsers.source.expr import Call, Comprehension, Expr, Items, Member, Name, Op, Table
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effect import Effect
from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.outline import Outline
from ecm_extract.infer.places import target_of
from ecm_extract.infer.unpacking import taken
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.texts import makes_text
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import calls_in, expressions, given_to, last_of, names_in
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class _Place(NamedTuple):
    """A name that something is kept by.

    Attributes:
        name: the variable, member or function. owner: the function of a variable, the class of a member; None for any.
    """

    name: str
    owner: Func | Cls | None = None


class Keeping(NamedTuple):
    """A function that lets something be kept by a name.

    Attributes:
        func: the function. key: how it names what is kept. within: whether that is only put into what the name means.
        as_it_is: whether it is all that the name means.
    """

    func: Func
    key: str
    within: bool = False
    as_it_is: bool = False


class _Given(NamedTuple):
    """What a name is given, or what is put `within` what it means; of a loop it is an `element` of the value."""

    place: _Place
    value: Expr
    within: bool
    element: bool = False


class _Change(NamedTuple):
    """A name by which something is changed: what it means itself, or, `deep`, what is in that.

    A `member` of some object, as `x.name`, is no variable of a function that is called alike.
    """

    place: _Place
    deep: bool
    member: bool = False


class KeptParts:
    """Follows them through all functions of the tree; built on the first question."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._of_comprehensions: dict[Func, Set[str]] = {}

    def of(self, name: str) -> Sequence[Keeping]:
        """Return the functions that let what a name stands for be changed by another one."""
        return self._kept.get(name, ())

    def all(self) -> Iterator[Keeping]:
        """Yield all of them."""
        return (keeping for found in self._kept.values() for keeping in found)

    @cached_property
    def _kept(self) -> Mapping[str, Sequence[Keeping]]:
        found: dict[str, list[Keeping]] = defaultdict(list)
        for change in self._changed:
            for keeping in self._flows.get(change.place, ()):
                if change.deep or not keeping.within:
                    found[keeping.key.rpartition(".")[2]].append(keeping)
        return found

    @cached_property
    def _changed(self) -> Set[_Change]:
        """The names by which somebody changes what they stand for, be it by a further name of that."""
        alike = defaultdict[str, set[_Place]](set)
        for place in self._flows:
            alike[place.name].add(place)
        found = set[_Change]()
        pending = [change for outline in self._outlines for change in self._changed_in(outline)]
        while pending:
            change = pending.pop()
            if change not in found:
                place, deep = change.place, change.deep
                near = alike[place.name] if place.owner is None else {place, _Place(place.name)}
                near = {each for each in near if not (change.member and isinstance(each.owner, Func))}
                found |= {change, *(_Change(each, deep) for each in near)}
                flows = [
                    keeping for each in near for keeping in self._flows.get(each, ()) if deep or not keeping.within
                ]
                pending += [self._change(each.key, each.func, deep or not each.as_it_is) for each in flows]
        return found

    @cached_property
    def _flows(self) -> Mapping[_Place, Sequence[Keeping]]:
        """Name -> what is kept by it."""
        found: dict[_Place, list[Keeping]] = defaultdict(list)
        for outline in self._outlines:
            effects, body = outline.effects, outline.func.fact.body
            for place, value, within, element in self._given(outline):
                keys = {effects.key(each) or effects.root(each) for each in shared_names(value, body)}
                keys |= {last_of(call.callee) for call in calls_in(value)} if isinstance(value, Call) else set()
                whole = isinstance(value, Name | Member | Call) and not element
                found[place] += [Keeping(outline.func, key, within, whole) for key in sorted(keys - {""})]
        return found

    @cached_property
    def _outlines(self) -> Sequence[Outline]:
        functions = self.folder.changed_outside.functions
        return [self.folder.flow.outline(func) for func in functions if func.file.language == "python"]

    def _place(self, key: str, func: Func) -> _Place:
        """What a key of a function stands for."""
        first, dot, _ = key.partition(".")
        name = key.rpartition(".")[2]
        if not dot:
            own = name in self.folder.flow.effects(func).own
            own = name in self._comprehended(func) if func.fact.name == "<module>" else own
            return _Place(name, func if own else None)
        return _Place(name, self._root(func) if not first and key.count(".") == 1 else None)

    def _comprehended(self, func: Func) -> Set[str]:
        if func not in self._of_comprehensions:
            self._of_comprehensions[func] = _comprehended(func)
        return self._of_comprehensions[func]

    def _root(self, func: Func) -> Cls | None:
        """The class that the classes of an object at hand have in common."""
        cls = self.folder.nesting.object_of(func)
        return self.folder.program.ancestry(cls)[-1] if cls is not None else None

    def _changed_in(self, outline: Outline) -> Iterator[_Change]:
        """Yield what the body of a function changes, or changes a part of; what others get is not looked into here."""
        func, effects = outline.func, outline.effects
        for at, entry in enumerate(func.fact.body):
            for effect in (each for each in effects.of(at) if not self._is_handed(each, func, at)):
                yield from self._ways_to(effect.key, func, deep=effect.kind != "changed")
            element = isinstance(entry.target, Op) and entry.target.op == "[]"
            grown = entry.type.endswith("=") and not _is_text(entry)
            if element or grown:
                target = entry.target.operands[0] if isinstance(entry.target, Op) else entry.target
                key = effects.key(target)
                yield from self._ways_to(key or effects.root(target), func, deep=not key)

    def _is_handed(self, effect: Effect, func: Func, at: int) -> bool:
        """Whether somebody who is not seen gets a variable, or an element of it."""
        is_part = effect.kind == "reached" and self.folder.flow.target(effect.call, func, at) is None
        return effect.kind == "handed" or is_part

    def _ways_to(self, key: str, func: Func, deep: bool) -> Iterator[_Change]:
        """Yield what a key stands for, and what it lies in: `t.rows.x`, `t.rows`, `t`."""
        while key:
            yield self._change(key, func, deep)
            key, deep = key.rpartition(".")[0], True

    def _change(self, key: str, func: Func, deep: bool) -> _Change:
        return _Change(self._place(key, func), deep, "." in key)

    def _given(self, outline: Outline) -> Iterator[_Given]:
        """Yield the names by which a function keeps something, or hands it to others, with what it is."""
        func = outline.func
        for entry in func.fact.body:
            value, held = entry.value, isinstance(entry.value, Items | Table | Comprehension)
            if value is None or is_plain(value):
                continue
            if entry.kind == "return" or entry.type.startswith("yield"):
                yield _Given(_Place(func.fact.name), value, held)
            elif entry.kind != "do":
                target = self._unplain(entry, outline) if entry.kind == "each" else target_of(entry)
                keys = (key for key in outline.bound_keys(target) if key)
                within = held or isinstance(entry.target, Op) or entry.type.endswith("=")
                looped = entry.kind == "each"
                yield from (_Given(self._place(key, func), value, within, looped) for key in keys)
        for at, calls in enumerate(func.calls):
            yield from (each for call in calls for each in self._handed(call, at, outline))
        yield from self._by_classes(func) if func.fact.name == "<module>" else ()
        for param in func.fact.params:
            if param.default is not None and not is_plain(param.default):
                yield _Given(_Place(param.name, func), param.default, isinstance(param.default, Items | Table))

    def _by_classes(self, func: Func) -> Iterator[_Given]:
        """Yield the attributes by which the classes of a module keep something that has another name, too."""
        for each in func.file.facts.constants:
            if each.scope and isinstance(each.value, Name | Member | Items | Table):
                place = self._place(f"{last_name(each.scope)}.{each.name}", func)
                yield _Given(place, each.value, isinstance(each.value, Items | Table))

    def _unplain(self, loop: Statement, outline: Outline) -> Expr | None:
        """What a loop binds but texts and numbers that are written out: nobody can change these."""
        target, value = loop.target, loop.value
        if isinstance(value, Name) and value.id not in outline.effects.own:
            found = self.folder.scope.constant(value.id, Env(outline.func))
            value = found[0].value or value if found is not None else value
        rows = value.items if isinstance(value, Items) else () if value is None else (value,)
        if not isinstance(target, Items):
            return Items(()) if isinstance(value, Items) and all(_is_fixed(row) for row in rows) else target
        columns = zip(*(taken(target.items, row) for row in rows), strict=True)
        return Items(
            tuple([column[0].target for column in columns if not all(_is_fixed(each.part) for each in column)])
        )

    def _handed(self, call: Call, at: int, outline: Outline) -> Iterator[_Given]:
        """Yield the parameters that a call gives something, or the list or table that it puts something into."""
        given = [each for each in given_to(call) if not is_plain(each)]
        if not given:
            return
        func = outline.func
        env = Env(func, at, this=func.cls)
        callee = self.folder.flow.target(call, func, at) or self.folder.methods.parameters.makers.of(call, env)
        if callee is not None:
            names = [param.name for param in callee.fact.params]
            for name, arg in (*zip(names, call.args, strict=False), *call.keywords):
                yield _Given(_Place(name, callee), arg, isinstance(arg, Items | Table))
        puts = isinstance(call.callee, Member) and call.callee.name in outline.effects.calls.changing
        key = outline.effects.root(call.callee.base) if puts and isinstance(call.callee, Member) else ""
        yield from (_Given(self._place(key, func), value, True) for value in given if key)


def _comprehended(func: Func) -> Set[str]:
    """The variables of comprehensions in the body of a module that are nothing else there: nobody asks it for them."""
    parts = (expr for statement in func.fact.body for expr, _ in expressions(statement))
    loops = {at for expr in parts if isinstance(expr, Comprehension) for at in expr.loops}
    bound = [(at in loops, set(names_in(each.target))) for at, each in enumerate(func.fact.body)]
    inside = (names for is_loop, names in bound if is_loop)
    return set[str]().union(*inside).difference(*(names for is_loop, names in bound if not is_loop))


def _is_fixed(element: Expr) -> bool:
    """Whether an element of a list is a text or a number, and not all elements of another one: `*names`."""
    return is_plain(element) and not (isinstance(element, Op) and len(element.operands) == 1 and element.op == "*")


def _is_text(entry: Statement) -> bool:
    """Whether a statement adds a text or a number to something, which is a new one then."""
    return is_plain(entry.value) or makes_text(entry.value)
