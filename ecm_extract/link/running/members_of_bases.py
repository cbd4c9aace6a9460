"""Members of C++ of one name that an object has by several classes: each gets a name of its own before anything is run.

Source: [class.member.lookup] of the C++ standard: a name means the member of the nearest class, as the methods of a
class, the type of an object and a name that is written with its class (`A::topic`) tell. That of the class which
derives from the others keeps its name; `topic` of its base `A` is `topic@A` wherever it is meant. A member that all
objects have in common ([class.static]) is the variable `A::topic`, by whatever object it is written.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Set
from functools import cached_property
from typing import Any, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Opaque
from ecm_parsers.source.facts import OVERLAID, Statement
from ecm_parsers.source.rewriting import rewritten
from msgspec.structs import replace

from ecm_extract.infer.library_calls import calls_of
from ecm_extract.infer.places import own_names
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.code.walk import expressions, last_of
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.objects import Objects
from ecm_extract.link.running.scope import Scope

_MARK: Final = "::"
_Renamed = Mapping[Cls, Mapping[str, str]]
"""What members are called instead, by their class and their name."""


def settle_members_of_bases(program: Program) -> None:
    """Give members that others hide names of their own, in all classes and functions of a tree."""
    renamed = _renamed(program)
    members = _Members(Objects(program, Scope(program)), renamed)
    functions = [(func, members.read(func)) for func in members.functions()]
    fields = [(cls, members.fields(cls)) for cls in renamed]
    for func, fact in functions:
        func.read_as(fact)
    for cls, found in fields:
        cls.fact = replace(cls.fact, fields=found)
        cls.fields = {field.name: field for field in found}


def _renamed(program: Program) -> _Renamed:
    found: dict[Cls, dict[str, str]] = defaultdict(dict)
    for cls in (cls for group in program.classes.values() for cls in group if cls.file.language == "cpp"):
        seen: set[str] = set()
        for entry in program.ancestry(cls):
            for name in _own(entry) & seen:
                found[entry][name] = f"{name}@{entry.qualified.replace(_MARK, '@')}"
            seen |= _own(entry)
    return found


def _own(cls: Cls) -> Set[str]:
    return {name for name, field in cls.fields.items() if "static" not in field.traits}


class _Members:
    """Tells which members are meant."""

    def __init__(self, objects: Objects, renamed: _Renamed) -> None:
        self.objects = objects
        self.program = objects.program
        self.renamed = renamed
        self._own_names: dict[Func, Set[str]] = {}

    def own_names(self, func: Func) -> Set[str]:
        """Return the names that belong to a function; each is asked about once."""
        known = self._own_names.get(func)
        if known is None:
            known = self._own_names[func] = own_names(func.fact, python=False)
        return known

    def functions(self) -> Iterator[Func]:
        """Yield the functions that name a member which is called otherwise, or write one with its class."""
        names = {name for each in self.renamed.values() for name in each} | self._written | set(self._overlaid())
        for file in (file for file in self.program.files if file.language == "cpp"):
            lines = set(self._lines(file))
            for func in self.program.functions_in(file):
                written = any(func.fact.line <= line <= func.fact.end_line for line in lines)
                if written or (names and not names.isdisjoint(_named(func))):
                    yield func

    def _overlaid(self) -> Iterator[str]:
        for cls in (cls for group in self.program.classes.values() for cls in group):
            yield from (name for name, field in cls.fields.items() if OVERLAID in field.traits)

    @cached_property
    def _written(self) -> Set[str]:
        """The last names of members that a function changes by an object, or that one has by the name of a class."""
        funcs = [func for func in self.program.every_function() if func.file.language == "cpp"]
        changed = {name for func in funcs for name in _changed_by_others(func)}
        named = {name for file in self.program.files if file.language == "cpp" for name in _named_by_class(file)}
        return (changed | named) & self.program.constants.keys()

    def variable(self, name: str, cls: Cls) -> Name | None:
        """Return the variable that a member is which all objects of a class have in common; None of other members."""
        traits = cls.fields[name].traits
        if name not in self._written or "static" not in traits or cls.fact.template or "const" in traits:
            return None
        written = f"{cls.qualified}{_MARK}{name}"
        return Name(written) if self.program.constant_named(written, cls.file) is not None else None

    def _lines(self, file: File) -> Iterator[int]:
        """Where a file writes what may be a member of a class with that class."""
        for mention in file.facts.mentions:
            owner, _, name = mention.name.rpartition(_MARK)
            classes = self.program.classes.get(owner.rpartition(_MARK)[2], ()) if mention.arguments < 0 else ()
            if any(name in each.fields for cls in classes for each in self.program.ancestry(cls)):
                yield mention.line

    def read(self, func: Func) -> Any:
        """Return a function with its members as they are called."""
        return rewritten(func.fact, _Read(self, func, self.objects.scope.nesting.object_of(func)).meant)

    def fields(self, cls: Cls) -> Any:
        """Return the fields of a class as they are called."""
        fields = rewritten(cls.fact.fields, _Read(self, None, cls).meant)
        return tuple([replace(field, name=self.renamed[cls].get(field.name, field.name)) for field in fields])

    def owner(self, name: str, cls: Cls | None) -> Cls | None:
        """Return the class whose member a name of an object means; None of other names."""
        lineage = self.program.ancestry(cls) if cls is not None else ()
        return next((each for each in lineage if name in each.fields), None)

    def is_once(self, cls: Cls) -> bool:
        """Whether no object may have two parts by a class, of which the one by another class is meant."""
        bases = (self.program.bases(each) for each in self.program.derived(cls))
        return all(sum(cls in self.program.ancestry(base) for base in each) <= 1 for each in bases)


class _Read:
    """What names mean in one function, or in what a class begins its members with."""

    def __init__(self, members: _Members, func: Func | None, cls: Cls | None) -> None:
        self.members = members
        self.func = func
        self.cls = cls

    def meant(self, part: Any) -> Any:
        """Return what stands for a part of facts; None of what stays. What is pointed to by its class is no member."""
        if isinstance(part, Op) and part.op == "&" and isinstance(part.operands[0], Name):
            return part if _MARK in part.operands[0].id else None
        if isinstance(part, Call) and isinstance(part.callee, Name) and _MARK in part.callee.id:
            args, keywords = rewritten((part.args, part.keywords), self.meant)
            return replace(part, args=args, keywords=keywords)
        if isinstance(part, Statement) and part.kind == "init" and isinstance(part.target, Name):
            named = self._called(part.target.id, self.cls if self.func is None else self.func.cls)
            return replace(part, target=Name(named), value=rewritten(part.value, self.meant))
        return self._read(part) if isinstance(part, Name | Member) else None

    def _read(self, part: Name | Member) -> Expr | None:
        written = part.name if isinstance(part, Member) else part.id
        named, _, name = written.rpartition(_MARK)
        base = part.base if isinstance(part, Member) else THIS
        cls = self._class_named(named) if named else self._class_of(part)
        owner = self.members.owner(name, cls)
        if owner is None or name not in _own(owner):
            return self.members.variable(name, owner) if owner is not None else None
        if OVERLAID in owner.fields[name].traits:
            return Opaque(name)
        if named and owner is not cls and not self.members.is_once(owner):
            return None
        called = self._called(name, owner)
        return Member(rewritten(base, self.meant), called) if named or called != name else None

    def _called(self, name: str, owner: Cls | None) -> str:
        """What a member of a class is called."""
        found = self.members.renamed.get(owner) if owner is not None else None
        return found.get(name, name) if found is not None else name

    def _class_named(self, written: str) -> Cls | None:
        if self.func is not None:
            return self.members.program.class_named(written, self.func.file, self.func.scope)
        cls = self.cls
        return self.members.program.class_named(written, cls.file, cls.qualified) if cls is not None else None

    def _class_of(self, part: Name | Member) -> Cls | None:
        """The class of the object whose member is named."""
        if isinstance(part, Name):
            return self.cls if not self._is_local(part.id) else None
        if part.base == THIS or self.func is None:
            return self.cls if part.base == THIS else None
        return self.members.objects.class_of(part.base, Env(self.func, len(self.func.fact.body), this=self.cls))

    def _is_local(self, name: str) -> bool:
        around = self.members.objects.scope.nesting.around
        held = (self.func, *around(self.func)) if self.func is not None else ()
        return any(name in self.members.own_names(func) for func in held)


def _named_by_class(file: File) -> Iterator[str]:
    """The last names of what a file writes with a class, but for where it defines that."""
    defined = {(each.name, each.line) for each in file.facts.constants}
    for mention in (each for each in file.facts.mentions if each.arguments < 0):
        name = last_name(mention.name)
        if (name, mention.line) not in defined:
            yield name


def _changed_by_others(func: Func) -> Iterator[str]:
    """The last names of what a function gives something, or calls a method of, by an object or the name of a class."""
    callees = [call.callee for group in func.calls for call in group if isinstance(call.callee, Member)]
    bare = (callee.base for callee in callees if callee.name in calls_of("cpp").changing)
    yield from (changed.id for changed in bare if isinstance(changed, Name))
    called = (callee.base for callee in callees)
    for changed in (*(entry.target for entry in func.fact.body if entry.kind == "set"), *called):
        if (isinstance(changed, Member) and changed.base != THIS) or (
            isinstance(changed, Name) and _MARK in changed.id
        ):
            yield last_of(changed)


def _named(func: Func) -> Iterable[str]:
    """The last names of all names and members of a function."""
    return {last_of(part) for entry in func.fact.body for part, _ in expressions(entry)}
