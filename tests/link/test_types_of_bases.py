"""Types that class templates write, as they are in classes that derive from them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, cast

from ecm_extract.link.running.base_types import BaseTypes


@dataclass(eq=False)
class _Fact:
    template: tuple[str, ...]
    bases: tuple[str, ...]
    scope: str = ""


@dataclass(eq=False)
class _Class:
    fact: _Fact
    qualified: str
    file: str = "a.hpp"


@dataclass
class _Program:
    classes: dict[str, _Class] = field(default_factory=dict)

    def add(self, name: str, template: str, *bases: str) -> _Class:
        """Make a class template."""
        self.classes[name] = _Class(_Fact(tuple(template), bases), name)
        return self.classes[name]

    def class_named(self, name: str, *_where: str) -> _Class | None:
        """The class of a name."""
        return self.classes.get(name)

    def ancestry(self, cls: _Class) -> list[_Class]:
        """A class and its bases, each once."""
        found = [cls]
        for entry in found:
            named = (self.classes[base.split("<")[0]] for base in entry.fact.bases)
            found.extend(base for base in named if base not in found)
        return found


def test_templates_that_derive_from_each_other_are_followed_once() -> None:
    """Specializations that one name is taken for may form a circle, which has an end when it is compiled."""
    program = _Program()
    store = program.add("Store", "T")
    outer = program.add("Outer", "A", "Inner<A>")
    program.add("Inner", "B", "Outer<B>", "Store<B>")
    assert BaseTypes(cast("Any", program)).within("T", cast("Any", store), cast("Any", outer)) == "A"
