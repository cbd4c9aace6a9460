"""Classes, methods, functions, members and constants of public C++ headers."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final

from ecm_checker.hub.provision import ALIAS, Provision
from ecm_parsers.source.expr import Constant as Literal
from ecm_parsers.source.expr import Number, Text
from ecm_parsers.source.facts import Alias, Class, Constant, Field, Function, SourceFile

from ecm_extract.entities.public_files import HIDDEN, public_headers
from ecm_extract.entities.signatures import form_of, normal_type, template_names, written_type
from ecm_extract.link.code.spelling import plain, template_arguments
from ecm_extract.read.facts import PackageFacts

_MACRO = re.compile(r"[A-Z][A-Z0-9]*(?:_[A-Z0-9]+){2,}")
"""`SMART_PTR_DEFINITIONS(Name)` looks like a member of that type."""
MARKED: Final = "marked deprecated"
_WORDS = frozenset({"explicit", "virtual", "inline", "static", "friend", "constexpr"})
"""What is left of a declaration behind a macro that was misread."""
_VIRTUAL = frozenset({"virtual", "pure", "override"})
"""A class with such a method is made to be derived from: its protected members are for those who do."""
_CLOSED = frozenset({"private", "anonymous", "deleted"})
_ELSEWHERE: Final = "elsewhere"


def cpp_entities(facts: PackageFacts) -> Iterator[Provision]:
    """Yield the public symbols of the headers of a package."""
    sources = ((path, facts.sources.get(path)) for path in public_headers(facts))
    headers = [_Header(facts.name, path, source) for path, source in sources if source is not None]
    classes = {name for header in headers for name in header.classes}
    for header in headers:
        yield from header.entities()
    for header, alias in _aliases_of_classes(headers, classes):
        yield from header.alias(alias)


def _aliases_of_classes(headers: Sequence[_Header], classes: set[str]) -> Iterator[tuple[_Header, Alias]]:
    """Yield what stands for a class or an enumeration, by way of other aliases too (`using Box = BoxBase<T>`)."""
    enumerations = {entry.scope for header in headers for entry in header.source.constants}
    known = classes | enumerations
    pending = [(header, alias) for header in headers for alias in header.source.aliases if not alias.local]
    while pending:
        found = [(header, alias) for header, alias in pending if not known.isdisjoint(_targets(alias))]
        yield from ((header, alias) for header, alias in found if _alias_name(alias) not in known)
        known |= {_alias_name(alias) for _, alias in found}
        pending = [entry for entry in pending if entry not in found] if found else []


def _targets(alias: Alias) -> Iterator[str]:
    """What the target may be called in full: as written, or in one of the scopes around the alias."""
    target = plain(alias.target)
    parts = alias.scope.split("::") if alias.scope else []
    yield from ("::".join([*parts[:count], target]) for count in range(len(parts), -1, -1))


def _alias_name(alias: Alias) -> str:
    return f"{alias.scope}::{alias.name}".lstrip(":")


class _Header:
    """One header with what is needed to name its symbols."""

    def __init__(self, package: str, path: str, source: SourceFile) -> None:
        self.package = package
        self.path = path
        self.source = source
        self.closed = {qualified(entry) for entry in source.classes if not _CLOSED.isdisjoint(entry.traits)}
        self.classes = {qualified(entry) for entry in source.classes if entry.name}
        self.templates = {qualified(entry): entry.template for entry in source.classes if entry.template}
        self.derived = {entry.scope for entry in source.functions if not _VIRTUAL.isdisjoint(entry.traits)}
        self.bodies = {f"{entry.scope}::{entry.name}".lstrip(":") for entry in source.functions}

    def entities(self) -> Iterator[Provision]:
        """Yield its symbols."""
        for entry in self.source.classes:
            if entry.name and self._is_open(qualified(entry), entry.traits):
                yield from self._class(entry)
        yield from self._functions()
        for constant in self.source.constants:
            if self._is_open(f"{constant.scope}::{constant.name}", constant.traits):
                yield from self._constant(constant)

    def _is_open(self, name: str, traits: Iterable[str]) -> bool:
        parts = name.split("::")
        enclosing = {"::".join(parts[:count]) for count in range(1, len(parts) + 1)}
        return (
            _CLOSED.isdisjoint(traits)
            and HIDDEN.isdisjoint(parts)
            and self.closed.isdisjoint(enclosing)
            and not any(part.startswith("_") for part in parts)
        )

    def _class(self, entry: Class) -> Iterator[Provision]:
        name = qualified(entry)
        yield Provision(
            kind="class",
            package=self.package,
            owner="",
            name=name,
            bases=tuple(plain(base) for base in entry.bases),
            given=_given(entry.bases, template_names(self._parameters(name))),
            deprecated=MARKED if "deprecated" in entry.traits else None,
            path=self.path,
            line=entry.line,
        )
        for field in (*entry.fields, *self._hidden_fields(entry)):
            hidden = not {"private", "static"}.isdisjoint(field.traits) or field.name.startswith("_")
            hidden = hidden or ("protected" in field.traits and name not in self.derived)
            if not hidden and not _MACRO.fullmatch(field.type) and field.name not in _WORDS:
                yield Provision(
                    kind="member",
                    package=self.package,
                    owner=name,
                    name=field.name,
                    type=written_type(field.type, template_names(self._parameters(name))),
                    deprecated=MARKED if "deprecated" in field.traits else None,
                    path=self.path,
                    line=field.line,
                )

    def _hidden_fields(self, entry: Class) -> Iterator[Field]:
        """Fields of bases whose own name is private (`_Point`): users see them in the class alone."""
        names = {plain(base) for base in entry.bases}
        for base in self.source.classes:
            if (
                base.name.startswith("_")
                and base.scope == entry.scope
                and not names.isdisjoint({base.name, qualified(base)})
            ):
                yield from base.fields

    def _parameters(self, cls: str) -> tuple[str, ...]:
        """The template parameters that a class sees: those of the classes around it and its own."""
        parts = cls.split("::")
        around = ("::".join(parts[:count]) for count in range(1, len(parts) + 1))
        return tuple(name for scope in around for name in self.templates.get(scope, ()))

    def alias(self, alias: Alias) -> Iterator[Provision]:
        """Yield the other name of a class: whoever uses `using A = B<T>` has a class A with all that B has."""
        name = _alias_name(alias)
        if self._is_open(name, ()):
            yield Provision(
                kind="class",
                package=self.package,
                owner="",
                name=name,
                type=ALIAS,
                bases=(plain(alias.target),),
                given=_given((alias.target,), template_names(alias.template)),
                deprecated=MARKED if alias.deprecated else None,
                path=self.path,
                line=alias.line,
            )

    def _functions(self) -> Iterator[Provision]:
        groups: dict[tuple[str, str], list[Function]] = defaultdict(list)
        for entry in self.source.functions:
            local = entry.scope in self.bodies and entry.scope not in self.classes
            if entry.name.startswith(("~", "operator")) or local or "<" in entry.name or not entry.name:
                continue
            if _ELSEWHERE in entry.traits:
                continue  # its declaration is what users see, with the defaults of its parameters
            if not entry.returns and _MACRO.fullmatch(entry.name):
                continue
            if self._is_open(f"{entry.scope}::{entry.name}".lstrip(":"), entry.traits):
                groups[entry.scope, entry.name].append(entry)
        for (scope, name), functions in groups.items():
            yield self._function(scope, name, functions)

    def _function(self, scope: str, name: str, functions: list[Function]) -> Provision:
        listed = [form_of(each, templates=template_names(self._parameters(scope), each.template)) for each in functions]
        forms = {(form.types, form.returns): form for form in reversed(listed)}
        is_method = scope in self.classes
        outdated = all(form.deprecated for form in forms.values())
        return Provision(
            kind="method" if is_method else "function",
            package=self.package,
            owner=scope if is_method else "",
            name=name if is_method else f"{scope}::{name}".lstrip(":"),
            forms=tuple(sorted(forms.values(), key=lambda form: (form.types, form.returns))),
            deprecated=MARKED if outdated else None,
            path=self.path,
            line=functions[0].line,
        )

    def _constant(self, entry: Constant) -> Iterator[Provision]:
        guard = "define" in entry.traits and (
            entry.value is None or entry.name.endswith(("_H", "_HPP", "_H_", "_HPP_"))
        )
        if guard:
            return
        value = entry.value.value if isinstance(entry.value, Number | Text) else None
        if isinstance(entry.value, Literal):
            value = {"true": True, "false": False}.get(entry.value.name)
        yield Provision(
            kind="constant",
            package=self.package,
            owner=entry.scope,
            name=entry.name,
            type=normal_type(entry.type) or None,
            default=value,
            path=self.path,
            line=entry.line,
        )


def _given(bases: Sequence[str], templates: Mapping[str, str]) -> tuple[tuple[str, ...], ...]:
    """Return the template arguments of each base; nothing where none has any."""
    found = tuple(tuple(written_type(each, templates) for each in template_arguments(base)) for base in bases)
    return found if any(found) else ()


def qualified(entry: Class) -> str:
    """Return the name of a class with its namespaces."""
    return f"{entry.scope}::{entry.name}" if entry.scope else entry.name
