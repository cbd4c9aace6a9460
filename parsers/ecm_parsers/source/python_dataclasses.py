"""Constructors that Python writes itself: of data classes, named tuples and the like.

Source: docs.python.org, "dataclasses": `__init__` takes the annotated fields in their order, those of bases first, and
calls `__post_init__` in the end.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cache
from importlib.resources import files
from typing import NamedTuple

import msgspec

from ecm_parsers.source.expr import THIS, Call, Constant, Expr, Lambda, Member, Name, Op, Opaque
from ecm_parsers.source.facts import Class, Field, Function, Import, Parameter, Statement

_AFTER = "__post_init__"
_PSEUDO = "dataclasses.InitVar"


class _Table(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    decorators: frozenset[str]
    bases: frozenset[str]
    plain: frozenset[str]
    apart: frozenset[str]
    makers: frozenset[str]
    first: frozenset[str]
    factories: tuple[str, ...]
    tuples: frozenset[str]
    fixed: frozenset[str]
    fixing: str


class Imported(NamedTuple):
    """What the names of a file mean by its imports."""

    targets: Mapping[str, str]

    @classmethod
    def of(cls, imports: Iterable[Import]) -> Imported:
        """Return what import statements bring, by the names that a file has for it."""
        return cls({each.alias or each.name or each.module: _target(each) for each in imports})

    def full(self, written: str) -> str:
        """Return the full name of a dotted text, without arguments: `dc.field(...)` is `dataclasses.field`."""
        name = written.partition("[")[0].partition("(")[0].strip()
        first, dot, rest = name.partition(".")
        return f"{self.targets.get(first, first)}{dot}{rest}"


class _Taken(NamedTuple):
    """A field that the constructor sets; `is_given`: from a parameter of its name."""

    field: Field
    default: Expr | None
    is_given: bool


class DeclaredField(NamedTuple):
    """A field as `dataclasses.fields` lists it; without a default where it has none, or makes one each time."""

    name: str
    default: Expr | None


@cache
def _table() -> _Table:
    text = files("ecm_parsers").joinpath("source", "python_dataclasses.toml").read_text(encoding="utf-8")
    return msgspec.convert(tomllib.loads(text), _Table)


def fills(decorator: str) -> bool:
    """Tell whether a decorator, by its full name, writes the constructor of a class."""
    return decorator in _table().decorators


def tuple_makers() -> frozenset[str]:
    """Return the full names of functions that make a class of named tuples."""
    return _table().tuples


def is_unchangeable(cls: Class, imports: Iterable[Import]) -> bool:
    """Tell whether nobody can give a field of an object of a class anything once it is made."""
    table, imported = _table(), Imported.of(imports)
    says = (imported.full(each) for each in (*cls.bases, *map(spelled, cls.decorators)))
    keywords = (pair for each in cls.decorators if isinstance(each, Call) for pair in each.keywords)
    return not table.fixed.isdisjoint(says) or (table.fixing, Constant("true")) in keywords


def has_no_fields(base: str, imports: Iterable[Import]) -> bool:
    """Tell whether a base of a class, as written, is one of the library that gives objects nothing of their own."""
    return Imported.of(imports).full(base) in _table().plain


def has_written_fields(cls: Class, imports: Iterable[Import]) -> bool | None:
    """Tell whether a class says by a decorator or a base of a library that its annotations are fields of its objects.

    None where a decorator that nobody knows may have written anything.
    """
    table, imported = _table(), Imported.of(imports)
    decorators = [imported.full(spelled(each)) for each in cls.decorators]
    if not table.decorators.issuperset(decorators):
        return None
    return bool(decorators) or any(imported.full(base) in table.bases for base in cls.bases)


def is_known_base(base: str, imports: Iterable[Import]) -> bool:
    """Tell whether a base of a class, as written, is one of a library that has no fields."""
    table, full = _table(), Imported.of(imports).full(base)
    return full in table.plain or full in table.bases


def declared_fields(cls: Class, imports: Iterable[Import]) -> Sequence[DeclaredField] | None:
    """Return the fields that the annotations of a class make, in their order; None where they are not all known."""
    imported = Imported.of(imports)
    if _PSEUDO in (imported.full(each.type) for each in cls.fields):
        return None
    listed = (each for each in cls.fields if each.type and imported.full(each.type) not in _table().apart)
    return [DeclaredField(each.name, _declared_default(each.default, imported)) for each in listed]


def _declared_default(default: Expr | None, imported: Imported) -> Expr | None:
    """The default of a field, which what makes it is given by its name or, where that takes it so, first."""
    made = _making(default, imported)
    if made is None:
        return default
    named = dict(made.keywords).get("default")
    takes_first = imported.full(spelled(made)) in _table().first
    first = made.args[0] if made.args and takes_first and made.args[0] != Opaque("...") else None
    return named or first


def generated_init(cls: Class, inside: str, methods: Sequence[str], imported: Imported) -> Function | None:
    """Return the constructor that a class is given by a decorator or a base; None where it is given none.

    Args:
        cls: the class.
        inside: the scope of its methods.
        methods: the names of those that it has itself.
        imported: what the names of its file mean.
    """
    table = _table()
    decorated = any(fills(imported.full(spelled(each))) for each in cls.decorators)
    bases = [imported.full(base) for base in cls.bases]
    if "__init__" in methods or not (decorated or not table.bases.isdisjoint(bases)):
        return None
    taken = list(_taken(cls.fields, imported))
    derived = not table.plain.union(table.bases).issuperset(bases)
    body = [*_of_bases(cls.line)] if derived else []
    body += [_set(each, derived) for each in taken]
    if _AFTER in methods:
        body.append(Statement("do", cls.line, Call(Member(THIS, _AFTER), (), line=cls.line)))
    params = [Parameter(each.field.name, each.field.type, each.default) for each in taken if each.is_given]
    every = [Parameter("*values"), Parameter("**named")]
    return Function("__init__", inside, tuple(every if derived else params), "", cls.line, cls.line, tuple(body))


def _taken(fields: Sequence[Field], imported: Imported) -> Iterator[_Taken]:
    for field in fields:
        made = _making(field.default, imported)
        if imported.full(field.type) in _table().apart or not (field.type or made):
            continue
        if made is None:
            yield _Taken(field, field.default, is_given=True)
        else:
            said = dict(made.keywords)
            yield _Taken(field, _default(made, said, imported), said.get("init") != Constant("false"))


def _making(default: Expr | None, imported: Imported) -> Call | None:
    """The call that says how a field is made, where one does."""
    is_one = isinstance(default, Call) and imported.full(spelled(default)) in _table().makers
    return default if isinstance(default, Call) and is_one else None


def _default(made: Call, said: Mapping[str, Expr], imported: Imported) -> Expr | None:
    stated = _declared_default(made, imported)
    if stated is not None:
        return stated
    factory = next((said[name] for name in _table().factories if name in said), None)
    if isinstance(factory, Lambda):
        return factory.body or Opaque("factory")
    return Call(factory, (), line=made.line) if factory is not None else None


def _set(taken: _Taken, derived: bool) -> Statement:
    """What a field is given; which of the arguments of a derived class that is cannot be told here."""
    given: Expr | None = Name(taken.field.name) if taken.is_given else taken.default
    value = Opaque("values") if derived and taken.is_given else given
    return Statement("set", taken.field.line, value, Member(THIS, taken.field.name))


def _of_bases(line: int) -> Iterator[Statement]:
    callee = Member(Call(Name("super"), (), line=line), "__init__")
    everything = (Op("*", (Name("values"),)),)
    yield Statement("do", line, Call(callee, everything, (("**", Name("named")),), line=line, keyword_lines=(line,)))


def spelled(expr: Expr) -> str:
    """Return what is named, or called, as a dotted text; empty for anything else."""
    if isinstance(expr, Call):
        return spelled(expr.callee)
    if isinstance(expr, Member):
        base = spelled(expr.base)
        return f"{base}.{expr.name}" if base else ""
    return expr.id if isinstance(expr, Name) else ""


def _target(entry: Import) -> str:
    return f"{entry.module}.{entry.name}" if entry.name else entry.module
