"""Members of Python that may be, or consist of, the same objects, since some method of the class makes them so.

`self.rows = [self.kept]` in one method: who changes `self.rows[0]` in another one changes `self.kept`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Expr, Member, Name, Number, Text

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.places import target_of
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Cls, Func

if TYPE_CHECKING:
    from ecm_extract.infer.outline import Outline
    from ecm_extract.link.folding.fold import Folder

Named = dict[str, set[str]]
"""Variable -> the members that it may be, or consist of, by key."""
_PLAIN_TYPES: Final = frozenset({"str", "int", "float", "bool", "bytes"})
_NONE: Final[Mapping[str, Set[str]]] = {}


class SharedMembers:
    """Finds them; each class is looked through once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._known: dict[Cls, Mapping[str, Set[str]]] = {}

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
        """Return the members that a value may be or consist of."""
        keys = {outline.effects.key(each) or outline.effects.root(each) for each in shared_names(value)} - {""}
        meant = {key for key in keys if key.startswith(".")}
        return meant.union(*(own.get(key, ()) for key in keys))


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
        if key and not (isinstance(call.callee, Member) and call.callee.name in outline.effects.calls.reading):
            yield from ((key, value) for value in (*call.args, *(value for _, value in call.keywords)))


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
