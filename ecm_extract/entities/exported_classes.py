"""Classes that the sources of a package hand to a loader by a macro, with the base class where that is known."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import Final

import msgspec
from ecm_checker.hub.provision import Provision
from ecm_checker.match.class_names import joined, named_in, parts_of
from ecm_parsers.source.facts import Macro

from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped_as

KIND: Final = "exported_class"
_WORDS: Final = ("EXPORT", "REGISTER")
"""In the names of macros that wrap those of a library: any argument of them may be a class."""


class _Form(msgspec.Struct, frozen=True, rename={"place": "class"}):
    """Which arguments of a macro are the class and its base, and how many it takes."""

    place: int
    base: int
    count: int


def aliases_of(packages: Sequence[PackageFacts]) -> frozenset[str]:
    """Return the names of packages that stand for other types: a base class that is written so may be any."""
    sources = (source for facts in packages for source in facts.sources.values())
    return frozenset(alias.name for source in sources for alias in source.aliases)


def exported_classes(facts: PackageFacts, aliases: frozenset[str]) -> Iterator[Provision]:
    """Yield the classes that macros of a package export, each for each base by the first line that names it."""
    found: dict[tuple[str, str | None], Provision] = {}
    for path, source in facts.sources.items():
        for macro in source.macros:
            for name, base in _of_macro(macro, aliases):
                row = Provision(kind=KIND, package=facts.name, owner="", name=name, path=path, line=macro.line)
                found.setdefault((name, base), msgspec.structs.replace(row, type=base, facet=base or ""))
    yield from found.values()


def _of_macro(macro: Macro, aliases: frozenset[str]) -> Iterator[tuple[str, str | None]]:
    """Names of classes, and the base that the macro names where its arguments are known."""
    form = _forms().get(macro.name)
    if form is not None and len(macro.args) == form.count:
        base = joined(macro.args[form.base])
        known = None if parts_of(base) & aliases else base
        yield from ((name, known) for name in named_in(macro.args[form.place]))
    elif any(word in macro.name for word in _WORDS):
        yield from ((name, None) for argument in macro.args for name in named_in(argument))


@cache
def _forms() -> Mapping[str, _Form]:
    return shipped_as("entities/export_macros.toml", dict[str, _Form])
