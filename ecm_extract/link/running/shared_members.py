"""Members of Python that may be, or consist of, the same objects, since some method of the class makes them so.

`self.rows = [self.kept]` in one method: who changes `self.rows[0]` in another one changes `self.kept`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence, Set
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Expr, Member, Name, Number, Text

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.places import target_of
from ecm_extract.infer.reading_calls import leaves_arguments
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import given_to

if TYPE_CHECKING:
    from ecm_extract.infer.outline import Outline
    from ecm_extract.link.folding.fold import Folder

Named = dict[str, set[str]]
"""Variable -> the members that it may be, or consist of, by key."""
_PLAIN_TYPES: Final = frozenset({"str", "int", "float", "bool", "bytes"})
_NONE: Final[Mapping[str, Set[str]]] = {}


class _Flows(NamedTuple):
    """What flows into a variable of a method.

    Attributes:
        into: the method. key: the variable. names: the variables that its value names, of the method that gives it.
    """

    into: Func
    key: str
    names: Set[str]


class SharedMembers:
    """Finds them; each class is looked through once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[Cls, Mapping[str, Set[str]]] = {}
        self._named: dict[Cls, tuple[Sequence[Outline], Mapping[Func, Named]]] = {}

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
        outlines, named = self.named(cls)
        plain = _plain_members(outlines)
        found = _between_members(named.values())
        return {key: others - plain for key, others in found.items() if key not in plain and others - plain}

    def named(self, cls: Cls) -> tuple[Sequence[Outline], Mapping[Func, Named]]:
        """Return the methods of a class, with what the variables of each may be or consist of."""
        if cls not in self._named:
            self._named[cls] = self._flown(cls)
        return self._named[cls]

    def _flown(self, cls: Cls) -> tuple[Sequence[Outline], Mapping[Func, Named]]:
        methods = [method for entry in self.folder.program.related(cls) for method in entry.methods]
        outlines = [
            self.folder.flow.outline(each)
            for method in methods
            for each in (method, *self.folder.nesting.inner(method))
        ]
        named: dict[Func, Named] = {outline.func: defaultdict(set) for outline in outlines}
        flows = {outline.func: [*_within(outline), *self._handed(outline, named)] for outline in outlines}
        grows = True
        while grows:
            grows = sum(_noted(each, named[func], named) for func, found in flows.items() for each in found) > 0
        return outlines, named

    def _handed(self, outline: Outline, methods: Collection[Func]) -> Iterator[_Flows]:
        """Yield what a method hands to others of the object at hand."""
        for call in (call for group in outline.func.calls for call in group):
            callee = self.folder.flow.target(call, outline.func, 0) if is_own_member(call.callee) else None
            if callee is not None and callee in methods:
                for param, arg in zip(callee.fact.params, call.args, strict=False):
                    yield _Flows(callee, param.name, _names(arg, outline))

    def meant(self, value: Expr | None, outline: Outline, own: Named) -> set[str]:
        """Return the members that a value may be or consist of."""
        return _members_of(_names(value, outline), own)


def _within(outline: Outline) -> Iterator[_Flows]:
    """Yield what a method gives its variables and members."""
    return (_Flows(outline.func, key, _names(value, outline)) for key, value in _given(outline))


def _names(value: Expr | None, outline: Outline) -> Set[str]:
    """The variables that a value names, by key."""
    named = {
        outline.effects.key(each) or outline.effects.root(each) for each in shared_names(value, outline.func.fact.body)
    }
    return frozenset(named - {""})


def _members_of(names: Set[str], own: Named) -> set[str]:
    """The members that variables of a method may be or consist of."""
    return {name for name in names if name.startswith(".")}.union(*(own.get(name, ()) for name in names))


def _noted(each: _Flows, own: Named, named: Mapping[Func, Named]) -> bool:
    """Note what flows into a variable; tells whether any of that is new."""
    known = named[each.into][each.key]
    new = _members_of(each.names, own) - known
    known |= new
    return bool(new)


def _plain_members(outlines: Sequence[Outline]) -> Set[str]:
    """The members that are texts or numbers, which nobody can change: by all that methods give them."""
    given: dict[str, list[bool]] = defaultdict(list)
    for outline in outlines:
        for key, value in _given(outline):
            given[key].append(is_plain(value) or _is_declared_plain(value, outline.func))
    return frozenset(key for key, values in given.items() if key.startswith(".") and all(values))


def _is_declared_plain(value: Expr | None, func: Func) -> bool:
    """Whether a value is a parameter that is declared as a text or a number, or is one if nothing is passed."""
    name = value.id if isinstance(value, Name) else ""
    declared = next((each for each in func.fact.params if each.name == name), None)
    return declared is not None and (declared.type in _PLAIN_TYPES or isinstance(declared.default, Text | Number))


def _given(outline: Outline) -> Iterator[tuple[str, Expr | None]]:
    """Yield the variables and members of a method with what they are given, or what is put into them."""
    for statement in outline.func.fact.body:
        if statement.kind != "do":
            yield from ((key, statement.value) for key in outline.bound_keys(target_of(statement)) if key)
    for call in (call for group in outline.func.calls for call in group):
        key = outline.effects.root(call.callee.base) if isinstance(call.callee, Member) else ""
        if key and not leaves_arguments(call.callee, outline.func):
            yield from ((key, value) for value in given_to(call))


def _between_members(named: Iterable[Named]) -> Mapping[str, Set[str]]:
    """Member -> the others that it shares objects with: what it is given."""
    found: dict[str, set[str]] = defaultdict(set)
    for own in named:
        for key, keys in own.items():
            member = _member(key)
            if member:
                found[member] |= {other for each in keys if (other := _member(each)) and other != member}
    return {member: frozenset(others) for member, others in found.items() if others}


def _member(key: str) -> str:
    """The member that a key is, or lies in."""
    return f".{key.split('.')[1]}" if key.startswith(".") else ""
