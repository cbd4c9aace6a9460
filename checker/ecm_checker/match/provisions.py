"""Provisions of any number of packages, found by what a requirement says of them."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Final

import msgspec

from ecm_checker.hub.kinds import Kind, kinds, kinds_that
from ecm_checker.hub.provision import HOLE, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.generated import headers, python_names, section_owners
from ecm_checker.match.hierarchy import Bases
from ecm_checker.match.names import NAMES, Site
from ecm_checker.match.ways import Ways, field_types

_PARTS: Final = re.compile(r"[/.:~]+")
OPEN: Final = "*"
"""Key of names whose last part is computed."""


class Sought(msgspec.Struct, frozen=True):
    """By what requirements are looked for.

    Attributes:
        kind: that they may mean.
        key: of the name; `OPEN` where its last part is computed.
        name: in which something is computed; empty for others.
    """

    kind: str
    key: str
    name: str = ""


class Provisions:
    """An index over what is provided.

    Attributes:
        bound: dotted names that Python modules offer without declaring them.
        bases: the class hierarchy of all classes of the side.
    """

    def __init__(
        self, entities: Iterable[Provision], bound: frozenset[str] = frozenset(), whole: Provisions | None = None
    ) -> None:
        """Index provisions; `whole` is the side that they are a part of, which knows its classes and folders."""
        self._entities = tuple(entities)
        self._whole = whole
        self.bound: frozenset[str] = whole.bound if whole is not None else bound

    @cached_property
    def _by_key(self) -> Mapping[tuple[str, str], Sequence[Provision]]:
        """Made when something is looked for: where nothing changed nothing is."""
        found: dict[tuple[str, str], list[Provision]] = defaultdict(list)
        for entity in self._entities:
            for key in dict.fromkeys((*_keys(entity), *self._heirs(entity))):
                found[entity.kind, key].append(entity)
        return found

    def _heirs(self, entity: Provision) -> Iterator[str]:
        """Classes that hand their arguments on to an `__init__` are called in its place."""
        if entity.name == "__init__":
            yield from (f"{last_part(name)}()" for name in self.bases.handing_on(entity))

    @cached_property
    def bases(self) -> Bases:
        """The class hierarchy of the whole side."""
        return self._whole.bases if self._whole is not None else Bases({each.key: each for each in self._entities})

    @cached_property
    def ways(self) -> Ways:
        """The ways to objects that the whole side declares."""
        if self._whole is not None:
            return self._whole.ways
        functions = {each.name: each for each in self._entities if _is_function(each) and not each.is_python}
        return Ways(self.bases, functions, field_types(self._entities))

    @cached_property
    def folders(self) -> Mapping[str, frozenset[str]]:
        """Packages by what stands first in the includes of their headers."""
        if self._whole is not None:
            return self._whole.folders
        found: dict[str, set[str]] = defaultdict(set)
        for entity in self._entities:
            if entity.row.included and "/" in entity.name:
                found[entity.name.partition("/")[0]].add(entity.package)
            elif entity.row.generated:  # its header is generated below the name of its package
                found[entity.package].add(entity.package)
        return {folder: frozenset(packages) for folder, packages in found.items()}

    @cached_property
    def interface_packages(self) -> frozenset[str]:
        """Packages that generate headers and modules of interface files."""
        return frozenset(each.package for each in self._entities if each.row.generated)

    def sought(self) -> Iterator[Sought]:
        """Yield by what the requirements are found that may mean what is here."""
        for (kind, key), entities in self._by_key.items():
            if key != OPEN:
                yield Sought(kind, key)
            else:
                yield from (Sought(kind, key, name) for name in dict.fromkeys(each.name for each in entities))

    def of(self, kind: str, key: str) -> Iterator[Provision]:
        """Yield the provisions of a kind that a key finds, those whose names are computed last."""
        yield from self._by_key.get((kind, key), ())
        if key != OPEN:
            yield from self._by_key.get((kind, OPEN), ())

    def of_kind(self, kind: str) -> Iterator[Provision]:
        """Yield all provisions of a kind."""
        return (each for each in self._entities if each.kind == kind)

    def that(self, holds: Callable[[Kind], bool]) -> Iterator[Provision]:
        """Yield all provisions of the kinds of which something holds."""
        return (each for kind in kinds_that(holds) for each in self.of_kind(kind))

    def owners(self, package: str | None, name: str) -> list[Provision]:
        """Return the provisions of a package, of any kind, that have a name themselves."""
        named = (each for kind in kinds() for each in self._by_key.get((kind, name), ()))
        return [each for each in named if each.package == package and each.name == name]

    def named(self, requirement: Requirement, consumer: Consumer) -> list[Provision]:
        """Return what a requirement of a consumer may mean, each once."""
        row = requirement.row
        names = NAMES[row.names]
        keys = tuple(names.keys(requirement))
        found = {each.key: each for kind in row.of for key in keys for each in self.of(kind, key)}
        if not found:  # of most requirements nothing is called so
            return []
        site = Site(requirement, consumer, self.folders, self.bound, self.bases, self.ways)
        return [each for each in found.values() if row.facet in {"", each.facet} and names.meant(site, each)]


def _is_function(entity: Provision) -> bool:
    return entity.row.called and not entity.row.part


def last_part(name: str) -> str:
    """Return the last part of a name of any kind."""
    return _PARTS.split(name)[-1]


def _keys(entity: Provision) -> Iterator[str]:
    """What a provision is found by: its name, the last part of it, and names that are made of it."""
    if not entity.name:  # an unnamed member or operator is none that somebody could ask for
        return
    last = last_part(entity.name)
    yield entity.name
    yield OPEN if HOLE in last or not last else last
    more = _MORE.get(entity.row.keys)
    if more is not None:
        yield from more(entity)


def _of_message(entity: Provision) -> Iterator[str]:
    yield from headers(entity.name)
    yield from python_names(entity.name)
    yield from section_owners(entity.name, "")


def _of_constant(entity: Provision) -> Iterator[str]:
    if "/" not in entity.owner:
        yield f"{entity.owner}.{entity.name}"
    else:
        yield from (f"{owner}.{last_part(entity.name)}" for owner in section_owners(entity.owner, entity.facet))


def _of_argument(entity: Provision) -> Iterator[str]:
    yield f"{entity.owner}?"


def _of_method(entity: Provision) -> Iterator[str]:
    if entity.name == "__init__":
        yield f"{last_part(entity.owner)}()"


def _of_plugin(entity: Provision) -> Iterator[str]:
    yield entity.name.replace("::", "/")


_MORE: Final[Mapping[str, Callable[[Provision], Iterator[str]]]] = {
    "interface": _of_message,
    "section": _of_constant,
    "asked": _of_argument,
    "constructor": _of_method,
    "slashes": _of_plugin,
}
