"""Which class offers a member: its own, else the nearest base class in the tree."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import chain, repeat

from ecm_checker.hub.provision import ALIAS, Key, Provision
from ecm_checker.match.arguments import for_arguments, written_for

MAX_DEPTH = 20


class Bases:
    """Class hierarchy of one side, looked up by qualified name."""

    def __init__(self, entities: Mapping[Key, Provision]) -> None:
        self._classes: dict[str, list[Provision]] = defaultdict(list)
        self._members: dict[tuple[bool, str, str], Provision] = {}
        for entity in entities.values():
            row = entity.row
            if row.is_class:
                self._classes[entity.name].append(entity)
            elif row.inherited:
                self._members[row.called, entity.owner, entity.name] = entity

    def named(self, name: str) -> Sequence[Provision]:
        """Return the classes of a qualified name."""
        return self._classes.get(name, ())

    def meant(self, name: str, scope: str) -> str | None:
        """Return the class that a name means in a scope, or the only one that is called so behind a `using`."""
        known = self.resolve(name, scope)
        if known is not None:
            return known
        named = self._by_last.get(name, frozenset())
        return next(iter(named)) if len(named) == 1 else None

    @cached_property
    def _by_last(self) -> Mapping[str, frozenset[str]]:
        found: dict[str, set[str]] = defaultdict(set)
        for name in self._classes:
            found[name.rpartition("::")[2]].add(name)
        return {last: frozenset(names) for last, names in found.items()}

    def member(self, cls: str, called: bool, name: str) -> Provision | None:
        """Return what a class itself has under a name, a method where it is called."""
        return self._members.get((called, cls, name))

    def provider(self, cls: str, called: bool, name: str) -> Provision | None:
        """Return the member that a class inherits under a name, from its base classes only, as it is for the class."""
        for base, given in self._lineage(cls)[1:]:
            found = self._members.get((called, base, name))
            if found is not None:
                return for_arguments(found, given)
        return None

    def offers(self, cls: str, below: str, name: str) -> bool:
        """Whether a class or one between it and a base of it has a method."""
        ancestry = self.ancestry(cls)
        own = ancestry[: ancestry.index(below)] if below in ancestry else ancestry
        return any((True, owner, name) in self._members for owner in own)

    def constructor(self, cls: str) -> Provision | None:
        """Return the constructor of the class that an alias stands for; None of a class, which has its own."""
        given = dict(self._lineage(cls))
        for target in self.stands_for(cls):
            found = self._members.get((True, target, target.rpartition("::")[2]))
            if found is not None:
                return for_arguments(found, given.get(target, ()))
        return None

    def stands_for(self, alias: str) -> Sequence[str]:
        """Return what an alias stands for, through further aliases; those of two trees may stand for each other."""
        seen = [alias]
        for name in seen:
            targets = [self.resolve(each.bases[0], name) for each in self._classes.get(name, ()) if each.type == ALIAS]
            seen += [target for target in dict.fromkeys(targets) if target is not None and target not in seen]
        return seen[1:]

    def handing_on(self, init: Provision) -> Sequence[str]:
        """Return Python classes of its package that hand what they do not know (`**kwargs`) to an `__init__`."""
        return self._heirs.get((init.package, init.owner.rpartition(".")[2]), ())

    @cached_property
    def _heirs(self) -> Mapping[tuple[str, str], Sequence[str]]:
        """Classes whose `__init__` takes any keyword, by package and own name of their bases."""
        found: dict[tuple[str, str], list[str]] = defaultdict(list)
        for name, group in self._classes.items():
            made = self._members.get((True, name, "__init__"))
            if made is not None and any(each.startswith("**") for form in made.forms for each in form.names):
                for entity in group:
                    for base in entity.bases:
                        found[entity.package, base.rpartition(".")[2]].append(name)
        return found

    def ancestry(self, cls: str) -> list[str]:
        """Return a class and its bases in the tree, nearest first."""
        return [name for name, _ in self._lineage(cls)]

    def _lineage(self, cls: str) -> list[tuple[str, Sequence[str]]]:
        """Return a class and its bases in the tree with the template arguments that it has them by, nearest first."""
        ordered: list[tuple[str, Sequence[str]]] = [(cls, ())]
        known = {cls}
        for name, given in ordered:
            if len(ordered) > MAX_DEPTH:
                break
            for entity in self._classes.get(name, ()):
                for base, arguments in zip(entity.bases, chain(entity.given, repeat(())), strict=False):
                    found = self.resolve(base, name)
                    if found is not None and found not in known:
                        known.add(found)
                        ordered.append((found, [written_for(each, given) for each in arguments]))
        return ordered

    def is_open(self, cls: str) -> bool:
        """Whether a class or a base of it in the tree may have more than its body tells."""
        return any(entity.open for name in self.ancestry(cls) for entity in self._classes.get(name, ()))

    def resolve(self, base: str, scope: str) -> str | None:
        """Return the qualified name that a base as written means inside a scope."""
        parts = scope.split("::")[:-1]
        for count in range(len(parts), -1, -1):
            name = "::".join([*parts[:count], base])
            if name in self._classes:
                return name
        return None
