"""Which variables are names, or parts, of the same thing, so that changing one changes the others."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Set
from typing import NamedTuple

from ecm_parsers.source.facts import Statement

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.infer.consisting import Consisting
from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.held import State, all_ways
from ecm_extract.infer.outline import Outline
from ecm_extract.infer.places import wholes
from ecm_extract.link.code.spelling import by_value


class Meant(NamedTuple):
    """All names of a variable, and the variables that change with it."""

    names: set[str]
    touched: set[str]


class Sharing:
    """The variables of one function that share what they hold, by key (see `places`)."""

    def __init__(self, outline: Outline) -> None:
        self.outline = outline
        self.effects = outline.effects
        self._roots: dict[str, Set[str]] = {}
        self._same: dict[str, str] = {}
        self._constants: dict[str, bool] = {}
        self.consisting = Consisting(outline.effects)

    def refer(self, key: str, root: str, whole: str = "") -> None:
        """Note that a variable is a reference into another, `whole`: to all of that."""
        if key and root:
            self._roots[key] = frozenset((root,))
            self._same.pop(key, None)
        if key and whole and not self.outline.python and self.outline.is_one(key) and self._is_one_place(whole):
            self._same[key] = whole

    def _is_one_place(self, key: str) -> bool:
        """Whether a variable, or a field of one, means the same throughout: nothing on the way to it is bound anew."""
        first, *fields = key.split(".")
        way = (".".join((first, *fields[:count])) for count in range(len(fields)))
        member = not first  # the object at hand is one throughout
        own = by_value(self.outline.func.written_types.get(first, "*"))  # as an object is that no pointer leads to
        fixed = (self.outline.changes.get(each, 0) <= 1 or (own and each == first) for each in way)
        return (member or self.outline.is_one(first)) and all(fixed)

    def names_of(self, key: str) -> set[str]:
        """Return all names of the variable of C++ that a name means."""
        first = key
        while first in self._same and self._same[first] != key:
            first = self._same[first]
        names = {first, key}
        while more := {name for name, other in self._same.items() if other in names and name not in names}:
            names |= more
        return names

    def meant(self, key: str, state: State) -> Meant:
        """Return what a variable of C++ is called, a field by all names of its object."""
        names, touched = self.names_of(key), set[str]()
        for whole in (key, *wholes(key)):
            same = self.names_of(whole)
            touched |= self.touched(same, state)
            names |= {name + key.removeprefix(whole) for name in same}
        return Meant(names, touched)

    def touched(self, names: Set[str], state: State) -> set[str]:
        """Return what else changes with a variable of C++, by its names: what they lie in, and references into them."""
        found: set[str] = set()
        pending = list(names)
        while pending:
            name = pending.pop()
            near = self.roots((name,)) | {part for part in self.parts(name) if part in state.holds}
            pending += near - found - names
            found |= near - names
        return found

    def enter(self, each: Statement) -> None:
        """Note that the variable of a loop is a part of what the loop is over."""
        if self.outline.python:
            over = {self.effects.key(part) for part in shared_names(each.value, self.outline.func.fact.body)} - {""}
            self._roots.update(dict.fromkeys(self.outline.bound_keys(each.target), over))
            return
        writes = each.type.endswith("&") and "const" not in each.type.split()
        for key in self.outline.bound_keys(each.target) if writes else ():
            self.refer(key, self.effects.root(each.value))

    def roots(self, keys: Iterable[str]) -> set[str]:
        """Return what variables are references to, or parts of, and what those are."""
        found: set[str] = set()
        pending = list(keys)
        while pending:
            more = self._roots.get(pending.pop(), frozenset()) - found
            found |= more
            pending += more
        return found

    def with_shared(self, keys: Set[str]) -> Set[str]:
        """Return variables with what changes when they do, as far as the declarations before tell."""
        roots = self.roots(keys)
        if self.outline.python:
            return keys | roots
        roots |= {self._meant_by(whole, key) for key in keys for whole in wholes(key) if whole in self._roots}
        return keys | roots | {part for key in keys | roots for part in self.parts(key)}

    def _meant_by(self, reference: str, key: str) -> str:
        """What a field of a reference is: `conf_.t` of `q.t` with `auto & q = conf_`, else all that it is in."""
        (root,) = self._roots[reference]
        return root + key.removeprefix(reference) if self._same.get(reference) == root else root

    def parts(self, key: str) -> set[str]:
        """Return the references to a variable, and its parts."""
        return {name for name, roots in self._roots.items() if key in roots}

    def alike(self, key: str, state: State) -> set[str]:
        """Return all names of the object that a name of Python is bound to."""
        alike: set[str] = set()
        more = {key}
        copies = self._copies(state)
        while more - alike:
            new = more - alike
            alike |= new
            more = {name for one in new if one in state.holds for name in state.holds.alike(state.holds[one])}
            more |= {name for name, other in copies.items() if other in new}
            more |= {copies[name] for name in new if name in copies}
        return alike

    def _copies(self, state: State) -> Mapping[str, str]:
        """Names with those that they are surely bound to the same object as: `b = a`, and neither was bound anew."""
        bound = {name: self._bound_as(name, state) for name in state.holds.copies()}
        return {name: other for name, other in bound.items() if other}

    def _bound_as(self, key: str, state: State) -> str:
        """The name that a copy was bound as, if that still holds the same; empty for none."""
        held = state.holds[key][0]
        meant = self.effects.key(held.expr)
        then = held.env.state if held.env is not None else None
        return meant if then is not None and then.holds.get(meant) is state.holds.get(meant) else ""

    def holding(self, keys: Set[str], state: State) -> set[str]:
        """Return variables that may be, or consist of, what some names mean, or what that consists of."""
        return self._with_holders(keys, self.consisting.named(keys, state), state)

    def reached(self, keys: Set[str], state: State) -> set[str]:
        """Return variables that may be, or consist of, what somebody may change who has what some names mean."""
        return self._with_holders(keys, self.consisting.reached(keys, state), state)

    def _with_holders(self, keys: Set[str], found: set[str], state: State) -> set[str]:
        changing = {name for name in found if name in keys or not self._is_plain(name, state)}
        return found | self.consisting.naming(changing, state)

    def _is_plain(self, name: str, state: State) -> bool:
        ways = all_ways(state.holds.get(name, ()))
        return all(held.how == "value" and is_plain(held.expr) for held in ways) if ways else self.is_constant(name)

    def is_constant(self, name: str) -> bool:
        """Tell whether a name that a function of Python does not give anything is a text or a number of its module."""
        known = self._constants.get(name)
        if known is None:
            file, python = self.outline.func.file, self.outline.python
            given = [each.value for each in file.facts.constants if each.name == name and not each.scope]
            own = name in self.effects.own or name in file.imported or not python
            known = self._constants[name] = bool(given) and not own and all(map(is_plain, given))
        return known
