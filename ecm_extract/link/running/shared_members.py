"""Members of Python that may be, or consist of, the same objects, since some method of the class makes them so.

`self.rows = [self.kept]` in one method: who changes `self.rows[0]` in another one changes `self.kept`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Expr, Member, Name

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.places import target_of
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound, Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.infer.outline import Outline
    from ecm_extract.link.folding.fold import Folder

Named = dict[str, set[str]]
"""Variable -> the members that it may be, or consist of, and the parameters, by key."""
_PLAIN_TYPES: Final = frozenset({"str", "int", "float", "bool", "bytes"})
MAX_HANDED: Final = 4
"""Functions that hand a parameter on, each to the next, of which is asked what they were passed."""
_NONE: Final[Mapping[str, Set[str]]] = {}


class SharedMembers:
    """Finds them; each class is looked through once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[Cls, Mapping[str, Set[str]]] = {}
        self._calls: dict[str, list[tuple[Invocation, Env]]] = defaultdict(list)

    def of(self, func: Func) -> Mapping[str, Set[str]]:
        """Return, for members of the object at hand, the others that each may be or consist of, by key."""
        cls = self.folder.nesting.object_of(func) if func.file.language == "python" else None
        if cls is None:
            return _NONE
        if cls not in self._known:
            self._known[cls] = _NONE  # who asks in a circle
            self._known[cls] = self._found(cls)
        return self._known[cls]

    def _found(self, cls: Cls) -> Mapping[str, Set[str]]:
        return _between_members(self.named(cls)[1].values())

    def named(self, cls: Cls) -> tuple[Sequence[Outline], Mapping[Func, Named]]:
        """Return the methods of a class, with what the variables of each may be or consist of."""
        program = self.folder.program
        lineage = (*program.ancestry(cls), *program.derived(cls))
        methods = [method for entry in lineage for method in entry.methods]
        outlines = [
            self.folder.flow.outline(each)
            for method in methods
            for each in (method, *self.folder.nesting.inner(method))
        ]
        named: dict[Func, Named] = {outline.func: defaultdict(set) for outline in outlines}
        while sum(self._noted(outline, named) for outline in outlines):
            pass
        return outlines, named

    def _noted(self, outline: Outline, named: Mapping[Func, Named]) -> bool:
        """Note what a method gives its variables, members and what it calls; tells whether any of that is new."""
        own = named[outline.func]
        more = [(key, self.meant(value, outline, own)) for key, value in _given(outline)]
        new = [(own, key, keys - own[key]) for key, keys in more if keys - own[key]]
        for call in (call for group in outline.func.calls for call in group):
            callee = self.folder.flow.target(call, outline.func, 0) if is_own_member(call.callee) else None
            if callee is None or callee not in named:
                continue
            for param, arg in zip(callee.fact.params, call.args, strict=False):
                keys = {key for key in self.meant(arg, outline, own) if key.startswith(".")}
                new += [(named[callee], param.name, keys - named[callee][param.name])]
        for there, key, keys in new:
            there[key] |= keys
        return any(keys for _, _, keys in new)

    def meant(self, value: Expr | None, outline: Outline, own: Named) -> set[str]:
        """Return the members, and the parameters, that a value may be or consist of."""
        keys = {outline.effects.key(each) or outline.effects.root(each) for each in shared_names(value)} - {""}
        given = (key for key in keys if key in outline.func.given and not self._is_plain(key, outline.func, MAX_HANDED))
        meant = {*given, *(key for key in keys if key.startswith("."))}
        return meant.union(*(own.get(key, ()) for key in keys))

    def _is_plain(self, name: str, func: Func, handed: int) -> bool:
        """Whether a parameter is a text or a number, which nobody can change: by its type, or by all that is passed."""
        if _by_type(func, name) or not handed:
            return bool(handed)
        calls = self._making(func) if func.is_constructor else self.folder.states.callers.all(func)
        passed = [bind(func, call, place).get(name) for call, place in calls]
        return bool(passed) and all(each is not None and self._is_plain_value(each, handed) for each in passed)

    def _making(self, maker: Func) -> Iterator[tuple[Invocation, Env]]:
        """The calls that may run a constructor: of its class, of classes that derive from it, and of `__init__`."""
        cls, program = maker.cls, self.folder.program
        derived = program.derived(cls) if cls is not None else ()
        names = {entry.fact.name for entry in (cls, *derived) if entry is not None}
        for call, place in self._by_name(names):
            yield call, place
        for call, place in self._by_name({maker.fact.name}):
            if call.func.cls in derived:
                yield call, place

    def _by_name(self, names: Set[str]) -> Iterator[tuple[Invocation, Env]]:
        if not self._calls:
            for func in self.folder.program.every_function():
                for at, group in enumerate(func.calls if func.file.language == "python" else ()):
                    for call in group:
                        found = invocation_of(call, Env(func, at))
                        self._calls[found.last].append((found, Env(func, at)))
        yield from (each for name in names for each in self._calls.get(name, ()))

    def _is_plain_value(self, passed: Bound, handed: int) -> bool:
        expr, func = passed.expr, passed.env.func
        if isinstance(expr, Name) and expr.id in func.given:
            bound = self.folder.flow.outline(func).changes.get(expr.id, 0) > 0
            return not bound and self._is_plain(expr.id, func, handed - 1)
        return is_plain(expr)


def _by_type(func: Func, name: str) -> bool:
    written = next((each.type for each in func.fact.params if each.name == name), "")
    return written in _PLAIN_TYPES


def _given(outline: Outline) -> Iterator[tuple[str, Expr | None]]:
    """Yield the variables and members of a method with what they are given, or what is put into them."""
    for statement in outline.func.fact.body:
        if statement.kind != "do":
            yield from ((key, statement.value) for key in outline.bound_keys(target_of(statement)) if key)
    for call in (call for group in outline.func.calls for call in group):
        key = outline.effects.root(call.callee.base) if isinstance(call.callee, Member) else ""
        if key and not (isinstance(call.callee, Member) and call.callee.name in outline.effects.calls.reading):
            yield from ((key, value) for value in (*call.args, *(value for _, value in call.keywords)))


def _between_members(named: Iterable[Named]) -> Mapping[str, Set[str]]:
    """Member -> the others that it shares objects with: what it is given, and what is given the same parameter."""
    found: dict[str, set[str]] = defaultdict(set)
    for own in named:
        for key, keys in own.items():
            member = _member(key)
            if member:
                found[member] |= {other for each in keys if (other := _member(each)) and other != member}
                alike = {_member(other) for other, others in own.items() if _params(keys) & _params(others)}
                found[member] |= alike - {"", member}
    return {member: frozenset(others) for member, others in found.items() if others}


def _member(key: str) -> str:
    """The member that a key is, or lies in."""
    return f".{key.split('.')[1]}" if key.startswith(".") else ""


def _params(keys: Set[str]) -> set[str]:
    return {key for key in keys if not key.startswith(".")}
