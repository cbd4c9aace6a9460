"""Classes that a table or list of the tree keeps, and the functions that make objects of what is there.

`@register` or `@part("arm")` in front of a class hands it to a function that keeps it, `KINDS = {"arm": Arm}` begins
with it: whoever reads that has the class, as if it had named it. Who reads one entry has what is kept under that key.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op, Table, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.code.walk import children, last_of
from ecm_extract.link.index.program import Program

MAX_HANDING_ON = 3
"""Functions that a class is handed on through until one keeps it."""


class Place(NamedTuple):
    """A variable of a module, or an attribute of a class, that functions fill."""

    file: File
    scope: str
    name: str


class Kept(NamedTuple):
    """A class in a place; `key` is what it is kept under, None where that is not known or there is none."""

    cls: Cls
    place: Place
    key: str | None


class _Given(NamedTuple):
    """A function that gets a class: by which of its parameters, and the texts that others hold."""

    func: Func
    parameter: str
    texts: Mapping[str, str]


class Registered:
    """The classes of a program that decorators keep; the readers of what keeps them are found once."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._readers: dict[Cls, list[Func]] = defaultdict(list)
        self._read: dict[Func, list[Cls]] = defaultdict(list)
        self._keepers: set[Func] = set()
        kept = [*self._begun(), *(each for cls in _decorated(program) for each in self._kept(cls))]
        names = {each.place.name for each in kept}
        for func in (func for group in program.functions.values() for func in group) if names else ():
            self._note(func, names, kept)

    def readers(self, cls: Cls) -> Sequence[Func]:
        """Return the functions that read what a class is kept in."""
        return self._readers.get(cls, ())

    def read_by(self, func: Func) -> Sequence[Cls]:
        """Return the classes that a function can make because it reads what they are kept in."""
        return self._read.get(func, ())

    def _note(self, func: Func, names: set[str], kept: Sequence[Kept]) -> None:
        if func.file.language != "python" or func in self._keepers:
            return
        read = [(each, key) for each, key in _reads(func) if last_of(each) in names]
        for expr, key in read:
            place = self._place(expr, func)
            for entry in kept:
                if entry.place == place and (key is None or entry.key in {None, key}):
                    self._readers[entry.cls].append(func)
                    self._read[func].append(entry.cls)

    def _begun(self) -> Iterator[Kept]:
        """The classes that variables of modules and attributes of classes begin with."""
        for file in (each for each in self.program.files if each.language == "python"):
            for constant in file.facts.constants:
                for key, value in _entries(constant.value):
                    cls = self.program.class_named(dotted_name(value), file, constant.scope)
                    if cls is not None:
                        yield Kept(cls, Place(file, constant.scope, constant.name), key)

    def _kept(self, cls: Cls) -> Iterator[Kept]:
        for decorator in cls.fact.decorators:
            for given in self._decorating(decorator, cls):
                yield from self._kept_by(given, cls, MAX_HANDING_ON)

    def _decorating(self, decorator: Expr, cls: Cls) -> Iterator[_Given]:
        """The functions that a class is handed to: the decorator, or the function within that makes one."""
        called = decorator if isinstance(decorator, Call) else None
        for func in self._meant(called.callee if called is not None else decorator, cls.file, cls.fact.scope):
            if called is None:
                yield from _taking(func, {})
            else:
                texts = _texts(func, called)
                yield from (given for each in self._within(func) for given in _taking(each, texts))

    def _within(self, func: Func) -> Iterator[Func]:
        own = self.program.functions_in(func.file)
        return (each for each in own if each.fact.scope == func.scope and each.fact.name != func.fact.name)

    def _meant(self, callee: Expr, file: File, scope: str) -> Iterator[Func]:
        written = dotted_name(callee)
        owner, _, name = written.rpartition(".")
        yield from self.program.functions_named(written, file, scope) if written else ()
        cls = self.program.class_named(owner, file, scope) if owner else None
        for entry in self.program.ancestry(cls) if cls is not None else ():
            yield from (method for method in entry.methods if method.fact.name == name)

    def _kept_by(self, given: _Given, cls: Cls, hops: int) -> Iterator[Kept]:
        for statement in given.func.fact.body:
            for kept, key in _keeping(statement, given.parameter):
                place = self._place(kept, given.func)
                if place is not None:
                    self._keepers.add(given.func)
                    yield Kept(cls, place, _key(key, given, cls))
            yield from self._handed_on(statement, given, cls, hops - 1) if hops else ()

    def _handed_on(self, statement: Statement, given: _Given, cls: Cls, hops: int) -> Iterator[Kept]:
        value = statement.value
        if not isinstance(value, Call) or Name(given.parameter) not in value.args:
            return
        callee = _through_own_class(value.callee, given.func)
        for func in self._meant(callee, given.func.file, given.func.scope):
            at = value.args.index(Name(given.parameter))
            if at < len(func.fact.params):
                yield from self._kept_by(_Given(func, func.fact.params[at].name, {}), cls, hops)

    def _place(self, expr: Expr, func: Func) -> Place | None:
        """The variable of a module or attribute of a class that an expression means in a function."""
        written = dotted_name(_through_own_class(expr, func))
        found = self.program.constant_named(written, func.file, func.scope) if written else None
        if found is not None:
            return Place(found.file, found.constant.scope, found.constant.name)
        owner, _, name = written.rpartition(".")
        cls = self.program.class_named(owner, func.file, func.scope) if owner else None
        holders = (entry for entry in self.program.ancestry(cls) if name in entry.fields) if cls is not None else ()
        return next((Place(entry.file, entry.qualified, name) for entry in holders), None)


def _decorated(program: Program) -> Iterator[Cls]:
    return (cls for group in program.classes.values() for cls in group if cls.fact.decorators)


def _taking(func: Func, texts: Mapping[str, str]) -> Iterator[_Given]:
    if func.fact.params:
        yield _Given(func, func.fact.params[0].name, texts)


def _texts(func: Func, call: Call) -> Mapping[str, str]:
    """The texts that a call passes, by the parameters that hold them."""
    passed = [*zip((entry.name for entry in func.fact.params), call.args, strict=False), *call.keywords]
    return {name: arg.value for name, arg in passed if isinstance(arg, Text)}


def _keeping(statement: Statement, parameter: str) -> Iterator[tuple[Expr, Expr | None]]:
    """What a statement puts the value of a parameter into, with the key: `KNOWN[key] = it`, `KNOWN.append(it)`."""
    target, value = statement.target, statement.value
    if statement.kind == "set" and isinstance(target, Op) and target.op == "[]" and _is_within(value, parameter):
        yield target.operands[0], target.operands[1]
    if (
        isinstance(value, Call)
        and isinstance(value.callee, Member)
        and any(_is_within(each, parameter) for each in value.args)
    ):
        yield value.callee.base, value.args[0] if len(value.args) > 1 else None


def _is_within(value: Expr | None, parameter: str) -> bool:
    """Whether a value is a parameter, or a tuple or list with it: `KNOWN[key] = (it, options)`."""
    return value == Name(parameter) or (isinstance(value, Items) and Name(parameter) in value.items)


def _entries(value: Expr | None) -> Iterator[tuple[str | None, Expr]]:
    """Yield the names that a table or a list consists of, in tuples too, each with the text of its key."""
    for key, each in value.entries if isinstance(value, Table) else ():
        yield from ((key.value if isinstance(key, Text) else None, part) for _, part in _entries(Items((each,))))
    for each in value.items if isinstance(value, Items) else ():
        if isinstance(each, Name | Member):
            yield None, each
        yield from _entries(each) if isinstance(each, Items) else ()


def _key(key: Expr | None, given: _Given, cls: Cls) -> str | None:
    if isinstance(key, Text):
        return key.value
    if isinstance(key, Name):
        return given.texts.get(key.id)
    return cls.fact.name if key == Member(Name(given.parameter), "__name__") else None


def _reads(func: Func) -> Iterator[tuple[Expr, str | None]]:
    """The variables and attributes that a function reads, each with the key of the entry that it takes of it."""
    pending: list[Expr] = [entry.value for entry in func.fact.body if entry.value is not None]
    while pending:
        expr = pending.pop()
        whole, key = _taken(expr)
        if whole is not None:
            yield whole, key.value if isinstance(key, Text) else None
            pending += [] if key is None else [key]
        elif isinstance(expr, Name | Member):
            yield expr, None
        pending += _parts(expr, whole)


def _taken(expr: Expr) -> tuple[Expr | None, Expr | None]:
    """The table and the key of `KNOWN[key]` and `KNOWN.get(key)`."""
    if isinstance(expr, Op) and expr.op == "[]" and len(expr.operands) == 2:
        return expr.operands[0], expr.operands[1]
    if isinstance(expr, Call) and isinstance(expr.callee, Member) and expr.callee.name in {"get", "pop"} and expr.args:
        return expr.callee.base, expr.args[0]
    return None, None


def _parts(expr: Expr, whole: Expr | None) -> Iterable[Expr]:
    if whole is None:
        return children(expr)
    return children(whole) if isinstance(whole, Member | Op | Call) else ()


def _through_own_class(expr: Expr, func: Func) -> Expr:
    """`cls.known` and `self.known` by the name of the class."""
    if is_own_member(expr) and func.cls is not None:
        return Member(Name(func.cls.qualified.replace("::", ".")), expr.name)
    return expr
