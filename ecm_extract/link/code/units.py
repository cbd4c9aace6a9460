"""Files, functions and classes of a program, with what is asked of each again and again."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field
from math import inf
from typing import Final, TypeGuard

from ecm_parsers.source.expr import Call, Expr, Name, Table
from ecm_parsers.source.facts import Class, Field, Function, Parameter, SourceFile, Statement

from ecm_extract.link.code.callables import Callables, held_callables, seen_callables
from ecm_extract.link.code.deduced import deduced_type
from ecm_extract.link.code.spelling import is_node_interface
from ecm_extract.link.code.templates import alike, unified
from ecm_extract.link.code.walk import calls_in

IMPLIED: Final = "implied"
"""Trait of a constructor that a class of Python does without: it gives objects what their class has."""


def _nothing(name: str, scope: str) -> Set[str]:
    return frozenset()


@dataclass(slots=True, eq=False, repr=False)
class File:
    """One source file: its path, the package it belongs to, its facts, where its targets look for headers.

    `targets` are the names of those that compile it, `all_targets` whether no others do; `is_built` is False of a
    source that none does, as far as the build is known. `inner_classes` are those of Python that stand in other
    classes, as `Outer::Inner`, `variables` those of other modules whose methods it calls, as it writes them. `returned`
    gives what the functions return that a name means in a scope.
    """

    path: str
    package: str
    ros: int | None
    facts: SourceFile
    imported: dict[str, str] = field(default_factory=dict)
    inner_classes: frozenset[str] = frozenset()
    variables: frozenset[str] = frozenset()
    include_folders: tuple[str, ...] = ()
    is_built: bool = True
    targets: tuple[str, ...] = ()
    all_targets: bool = False
    returned: Callable[[str, str], Set[str]] = _nothing
    _callables: Mapping[str, Expr] | None = None

    @property
    def callables(self) -> Mapping[str, Expr]:
        """What variables of a module of Python hold that can be called, as long as no function changes them."""
        if self._callables is None:
            shared = {name for function in self.facts.functions for name in function.shared}
            body = next((each for each in self.facts.functions if each.name == "<module>"), None)
            held = held_callables(body, self.imported) if body is not None else {}
            kept = {name: each for name, each in held.items() if name not in shared and not isinstance(each, Table)}
            self._callables = kept
        return self._callables

    @property
    def language(self) -> str:
        """`cpp` or `python`."""
        return self.facts.language


@dataclass(slots=True, eq=False, repr=False)
class Func:
    """A function with the file it stands in, for a method its class, and all functions of its name.

    `is_wrapped`: whether it may get something else than what a call of it writes (`link.index.wrapped`).
    """

    fact: Function
    file: File
    cls: Cls | None = None
    namesakes: Sequence[Func] = ()
    is_wrapped: bool = False
    _params: tuple[Parameter, ...] | None = None
    _arity: tuple[int, float] | None = None
    _calls: tuple[Sequence[Call], ...] | None = None
    _defaults: tuple[tuple[str, Expr], ...] | None = None
    _written_types: Mapping[str, str] | None = None
    _variously_typed: frozenset[str] | None = None
    _callables: Callables | None = None
    _specialized: tuple[str, ...] | None = None
    _general: tuple[Func, ...] | None = None

    def read_as(self, fact: Function) -> None:
        """Have other facts from now on, and forget what was asked of those before."""
        self.fact = fact
        self._params = self._arity = self._calls = self._defaults = self._written_types = self._callables = None
        self._variously_typed = None

    def siblings(self) -> Iterator[Func]:
        """The declarations and definitions of that name in its class or namespace, itself included."""
        if self.cls is not None:
            yield from (other for other in self.cls.methods if other.fact.name == self.fact.name)
            return
        for other in self.namesakes:
            if other.cls is None and other.fact.scope == self.fact.scope and other.file.package == self.file.package:
                yield other

    @property
    def own_template(self) -> Sequence[str]:
        """Its template parameters without those of its class, which a definition outside of that repeats."""
        of_class = self.cls.fact.template if self.cls is not None else ()
        return [name for name in self.fact.template if name not in of_class]

    @property
    def specialized(self) -> tuple[str, ...]:
        """The arguments for which it specializes a template; empty of what is no specialization."""
        if self.fact.specializes is None or self.fact.specializes:
            return self.fact.specializes or ()
        if self._specialized is None:
            primary = next((each for each in self.siblings() if _has_same_form(each, self)), None)
            self._specialized = _arguments(primary, self) if primary is not None else ()
        return self._specialized

    @property
    def general(self) -> Func | None:
        """The template that it specializes, or it is itself of which another one is a specialization; else None."""
        if self.file.language != "cpp" or (self.fact.specializes is None and not self.fact.template):
            return None
        if self._general is None:
            self._general = tuple(self._templates())
        return next(iter(self._general), None)

    def _templates(self) -> Iterator[Func]:
        if self.fact.specializes is not None:
            yield from (each for each in self.siblings() if _has_same_form(each, self))
        elif any(each.fact.specializes is not None and _has_same_form(self, each) for each in self.siblings()):
            yield self

    def takes(self, types: Sequence[str]) -> bool:
        """Tell whether template arguments mean it, and not a specialization for them, or for others."""
        own = self.specialized
        if own and alike(types, own):
            return True
        if not own and not self.fact.template:
            return True
        others = list(self.siblings())
        if own and any(_has_same_form(other, self) and "declaration" not in other.fact.traits for other in others):
            return False
        return not any(other.specialized and alike(types, other.specialized) for other in others)

    @property
    def params(self) -> tuple[Parameter, ...]:
        """Its parameters as callers are read: several node interfaces in front are the one node they stand for."""
        if self._params is None:
            self._params = _one_node(self.fact.params)
        return self._params

    @property
    def given(self) -> frozenset[str]:
        """The names of its parameters, in its body."""
        return frozenset(parameter.name.lstrip("*") for parameter in self.fact.params)

    @property
    def written_types(self) -> Mapping[str, str]:
        """The types of its parameters and variables as written; of several declarations of a name the first."""
        if self._written_types is None:
            lets = [(each.target, deduced_type(each.type, each.value)) for each in self.fact.body if each.kind == "let"]
            found = {target.id: written for target, written in reversed(lets) if isinstance(target, Name)}
            given = {entry.name: entry.type for entry in reversed(self.fact.params) if entry.type}
            self._written_types = {**found, **given}
        return self._written_types

    @property
    def variously_typed(self) -> frozenset[str]:
        """The variables of which blocks declare several of a name, of several types."""
        if self._variously_typed is None:
            lets = {
                (each.target.id, each.type) for each in self.fact.body if each.kind == "let" and _is_name(each.target)
            }
            counts = Counter(name for name, _ in lets)
            self._variously_typed = frozenset(name for name, count in counts.items() if count > 1)
        return self._variously_typed

    @property
    def calls(self) -> tuple[Sequence[Call], ...]:
        """The calls of each statement of its body, inner ones first: in its value, and in what it changes."""
        if self._calls is None:
            self._calls = tuple([_calls_of(entry) for entry in self.fact.body])
        return self._calls

    def meant(self, call: Call) -> Call:
        """What a call of it calls, and with what: of a name of Python that holds something that can be called that."""
        return call if self.file.language != "python" else self.callables.meant(call)

    @property
    def callables(self) -> Callables:
        """What names of Python stand for that it calls."""
        if self._callables is None:
            held = seen_callables(self.fact, self.file.facts.functions, self.file.callables, self.file.imported)
            self._callables = Callables(held, self.cls.callables if self.cls is not None else {}, self.file.imported)
        return self._callables

    @property
    def arity(self) -> tuple[int, float]:
        """The fewest and the most arguments that a call of it has; defaults may stand at another declaration."""
        if self._arity is None:
            alike = (other for other in self.siblings() if len(other.fact.params) == len(self.fact.params))
            least = min([_required(self.params), *(_required(other.params) for other in alike)])
            self._arity = (0, inf) if takes_any(self.params[-1:]) else (least, _most(self.params))
        return self._arity

    @property
    def defaults(self) -> tuple[tuple[str, Expr], ...]:
        """The defaults of its parameters by name; those of a method in C++ stand at its declaration."""
        if self._defaults is None:
            alike = [other.params for other in (self, *self.siblings()) if len(other.params) == len(self.params)]
            pairs = [pair for params in alike for pair in zip(self.params, params, strict=True)]
            self._defaults = tuple([(own.name, one.default) for own, one in pairs if one.default is not None])
        return self._defaults

    @property
    def holder(self) -> Cls | None:
        """The class whose objects have what it declares; None for functions and for methods that need no object."""
        return None if self.cls is None or self.fact.name in self.cls.statics else self.cls

    @property
    def scope(self) -> str:
        """The scope in which the names of its body stand."""
        outer = self.cls.qualified if self.cls is not None else self.fact.scope
        return f"{outer}::{self.fact.name}" if outer else self.fact.name

    @property
    def inner_scope(self) -> str:
        """The scope of the functions that its body declares, as the file writes it."""
        return f"{self.fact.scope}::{self.fact.name}" if self.fact.scope else self.fact.name

    @property
    def is_implied(self) -> bool:
        """Whether it is a constructor that its class does without, which no call of a base means."""
        return IMPLIED in self.fact.traits

    @property
    def is_constructor(self) -> bool:
        """Whether calling it makes an object of its class."""
        return self.cls is not None and self.fact.name in {self.cls.fact.name, "__init__"}


@dataclass(slots=True, eq=False, repr=False)
class Cls:
    """A class with its file and all definitions of its methods; `statics` are names of those that need no object.

    `callables` is what members of its objects hold that can be called, by their names.
    """

    fact: Class
    file: File
    methods: list[Func] = field(default_factory=list)
    fields: dict[str, Field] = field(default_factory=dict)
    statics: set[str] = field(default_factory=set)
    callables: dict[str, Expr] = field(default_factory=dict)

    @property
    def qualified(self) -> str:
        """Name with its namespaces."""
        return f"{self.fact.scope}::{self.fact.name}" if self.fact.scope else self.fact.name

    @property
    def called(self) -> list[Func]:
        """The methods that calls can mean; an implied constructor is none that is called by its name."""
        return [func for func in self.methods if not func.is_implied]

    @property
    def constructors(self) -> list[Func]:
        """Those that can be called."""
        return [func for func in self.methods if func.is_constructor and "deleted" not in func.fact.traits]

    @property
    def filled(self) -> list[str]:
        """The fields in the order in which braces fill them; those of the class itself are none."""
        return [field.name for field in self.fact.fields if "static" not in field.traits]


def _is_name(expr: Expr | None) -> TypeGuard[Name]:
    return isinstance(expr, Name)


def _has_same_form(template: Func, func: Func) -> bool:
    """Whether a function is a template with as many parameters as one that specializes it."""
    return bool(template.fact.template) and len(template.fact.params) == len(func.fact.params)


def _arguments(template: Func, func: Func) -> tuple[str, ...]:
    """What the parameters of a template are in the signature of a specialization; empty for what that does not show."""
    pairs = [(template.fact.returns, func.fact.returns)]
    pairs += [(one.type, other.type) for one, other in zip(template.fact.params, func.fact.params, strict=True)]
    found: dict[str, str] = {}
    for pattern, written in pairs:
        found = {**unified(pattern, written, template.fact.template), **found}
    return tuple([found.get(name, "") for name in template.fact.template])


def _one_node(params: tuple[Parameter, ...]) -> tuple[Parameter, ...]:
    if len(params) < 2 or not is_node_interface(params[0].type) or not is_node_interface(params[1].type):
        return params
    rest = next((at for at, entry in enumerate(params) if not is_node_interface(entry.type)), len(params))
    return (Parameter("node"), *params[rest:])


def _calls_of(entry: Statement) -> Sequence[Call]:
    changed = calls_in(entry.target) if entry.kind == "set" else ()
    return [*calls_in(entry.value), *changed] if changed else calls_in(entry.value)


def _required(params: Iterable[Parameter]) -> int:
    return sum([parameter.default is None for parameter in params])


def takes_any(params: Iterable[Parameter]) -> bool:
    """Tell whether one of the parameters takes as many arguments as there are, or none."""
    return any(parameter.name.startswith("*") or "..." in parameter.type for parameter in params)


def _most(params: Sequence[Parameter]) -> float:
    return inf if any(parameter.name.startswith("*") for parameter in params) else len(params)
