"""Lists, tables and objects of Python that others keep, and change, by names of their own: `self.rows = p.rows`.

Whoever changes `self.rows[0]` then changes `p.rows`. A name stands for a variable of a module, a member of the objects
of a class, or what functions of that name give; of whose object a member is need not be known.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Member
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.outline import Outline
from ecm_extract.infer.places import target_of
from ecm_extract.link.code.texts import makes_text
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import calls_in, given_to, last_of
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
    """A function that lets something be kept by a name by which somebody changes it; `key` is how it names it."""

    func: Func
    key: str


class KeptParts:
    """Follows them through all functions of the tree; built on the first question."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def of(self, name: str) -> Sequence[Keeping]:
        """Return the functions that let what a name stands for be changed by another one."""
        return self._kept.get(name, ())

    def all(self) -> Iterator[Keeping]:
        """Yield all of them."""
        return (keeping for found in self._kept.values() for keeping in found)

    @cached_property
    def _kept(self) -> Mapping[str, Sequence[Keeping]]:
        found: dict[str, list[Keeping]] = defaultdict(list)
        for place in self._changed:
            for keeping in self._flows.get(place, ()):
                found[keeping.key.rpartition(".")[2]].append(keeping)
        return found

    @cached_property
    def _changed(self) -> Set[_Place]:
        """The names by which somebody changes what they stand for, be it by a further name of that."""
        members = defaultdict[str, set[_Place]](set)
        for place in self._flows:
            members[place.name].add(place)
        found = set[_Place]()
        pending = [place for outline in self._outlines for place in self._changed_in(outline)]
        while pending:
            place = pending.pop()
            if place not in found:
                found.add(place)
                alike = members[place.name] if place.owner is None else {place, _Place(place.name)}
                found |= alike
                flows = (keeping for each in alike for keeping in self._flows.get(each, ()))
                pending += [self._place(keeping.key, self.folder.flow.outline(keeping.func)) for keeping in flows]
        return found

    @cached_property
    def _flows(self) -> Mapping[_Place, Sequence[Keeping]]:
        """Name -> what is kept by it."""
        found: dict[_Place, list[Keeping]] = defaultdict(list)
        for outline in self._outlines:
            for place, value in self._given(outline):
                keys = {
                    outline.effects.key(each) or outline.effects.root(each)
                    for each in shared_names(value, outline.func.fact.body)
                }
                keys |= {last_of(call.callee) for call in calls_in(value)} if isinstance(value, Call) else set()
                found[place] += [Keeping(outline.func, key) for key in sorted(keys - {""})]
        return found

    @cached_property
    def _outlines(self) -> Sequence[Outline]:
        functions = self.folder.changed_outside.functions
        return [self.folder.flow.outline(func) for func in functions if func.file.language == "python"]

    def _place(self, key: str, outline: Outline) -> _Place:
        """What a key of a function stands for."""
        first, dot, _ = key.partition(".")
        name = key.rpartition(".")[2]
        if not dot:
            return _Place(name, outline.func if name in outline.effects.own and not outline.is_module else None)
        return _Place(name, self._root(outline.func) if not first and key.count(".") == 1 else None)

    def _root(self, func: Func) -> Cls | None:
        """The class that the classes of an object at hand have in common."""
        cls = self.folder.nesting.object_of(func)
        return self.folder.program.ancestry(cls)[-1] if cls is not None else None

    def _changed_in(self, outline: Outline) -> Iterator[_Place]:
        """Yield what the body of a function changes a part of."""
        body = outline.func.fact.body
        grown = {outline.effects.key(each.target) for each in body if each.type.endswith("=") and _is_text(each)}
        for key in outline.altered - grown:
            yield from (self._place(part, outline) for part in _ways_to(key))

    def _given(self, outline: Outline) -> Iterator[tuple[_Place, Expr]]:
        """Yield the names by which a function keeps something, or hands it to others, with what it is."""
        func = outline.func
        for entry in func.fact.body:
            if entry.kind == "return" or entry.type.startswith("yield"):
                yield from [(_Place(func.fact.name), entry.value)] if entry.value is not None else ()
            elif entry.kind != "do" and entry.value is not None and not is_plain(entry.value):
                keys = (key for key in outline.bound_keys(target_of(entry)) if key)
                yield from ((self._place(key, outline), entry.value) for key in keys)
        for at, calls in enumerate(func.calls):
            yield from (each for call in calls for each in self._handed(call, at, outline))
        for param in func.fact.params:
            if param.default is not None and not is_plain(param.default):
                yield _Place(param.name, func), param.default

    def _handed(self, call: Call, at: int, outline: Outline) -> Iterator[tuple[_Place, Expr]]:
        """Yield the parameters that a call gives something, or the list or table that it puts something into."""
        given = [each for each in given_to(call) if not is_plain(each)]
        if not given:
            return
        env = Env(outline.func, at, this=outline.func.cls)
        callee = self.folder.flow.target(call, outline.func, at) or self.folder.methods.parameters.makers.of(call, env)
        if callee is not None:
            names = [param.name for param in callee.fact.params]
            yield from ((_Place(name, callee), arg) for name, arg in zip(names, call.args, strict=False))
            yield from ((_Place(name, callee), value) for name, value in call.keywords)
        puts = isinstance(call.callee, Member) and call.callee.name in outline.effects.calls.changing
        key = outline.effects.root(call.callee.base) if puts and isinstance(call.callee, Member) else ""
        yield from ((self._place(key, outline), value) for value in given if key)


def _is_text(entry: Statement) -> bool:
    """Whether a statement adds a text or a number to something, which is a new one then."""
    return is_plain(entry.value) or makes_text(entry.value)


def _ways_to(key: str) -> Iterator[str]:
    """Yield a key, and what it lies in: `t.rows.x`, `t.rows`, `t`."""
    while key:
        yield key
        key = key.rpartition(".")[0]
