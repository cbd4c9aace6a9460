"""Decorators of functions: what is known of them by their full names.

Sources: docs.python.org ("Built-in Functions", functools, abc, contextlib, typing, warnings), typing-extensions,
[dcl.attr] of the C++ standard.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_extract.link.code.full_names import full_name
from ecm_extract.link.code.units import Func
from ecm_extract.shipped import shipped_names

_TABLE: Final = "link/code/decorators.toml"
_OF_PROPERTIES: Final = frozenset({"setter", "getter", "deleter"})


def are_known(func: Func) -> bool:
    """Tell whether no decorator registers a function anywhere, or may give back something else than it does."""
    return shipped_names(_TABLE, "known").issuperset(_names(func))


def runs_at_once(func: Func) -> bool:
    """Tell whether a call of a decorated function runs its body with nothing around it."""
    return shipped_names(_TABLE, "bare").issuperset(_names(func))


def is_of_class(func: Func) -> bool:
    """Tell whether a method is given the class in the place of an object."""
    return "classmethod" in _names(func)


def is_property(func: Func) -> bool:
    """Tell whether a function is run by reading an attribute of that name, and by nothing else."""
    names = set(_names(func))
    properties = names & shipped_names(_TABLE, "properties")
    return len(properties) == 1 and shipped_names(_TABLE, "plain").issuperset(names - properties)


def sets_property(func: Func) -> bool:
    """Tell whether a function is run where somebody gives an attribute of its name something, or deletes it."""
    changing = {f"{func.fact.name}.setter", f"{func.fact.name}.deleter"}
    return not changing.isdisjoint(func.fact.decorators)


def is_kept_property(func: Func) -> bool:
    """Tell whether an attribute keeps what its function gave when it was read first."""
    return not shipped_names(_TABLE, "kept").isdisjoint(_names(func))


def is_overload(func: Func) -> bool:
    """Tell whether a function only says which types another one takes."""
    return not shipped_names(_TABLE, "overload").isdisjoint(_names(func))


def _names(func: Func) -> Iterator[str]:
    """The full names of decorators, without what they are given; `speed.setter` of a property `speed` is `property`."""
    for decorator in func.fact.decorators:
        written = decorator.partition("(")[0].strip()
        head, _, rest = written.partition(".")
        is_property = head == func.fact.name and rest in _OF_PROPERTIES
        yield "property" if is_property else full_name(written, func.file.imported) or written
