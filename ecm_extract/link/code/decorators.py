"""Decorators of functions: what is known of them by their names.

Sources: docs.python.org ("Built-in Functions", functools, abc, contextlib, typing), en.cppreference.com (attributes).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from ecm_parsers.source.facts import Function

from ecm_extract.link.code.spelling import last_name
from ecm_extract.shipped import shipped_names

_TABLE: Final = "link/code/decorators.toml"


def names_of(decorators: Iterable[str]) -> frozenset[str]:
    """Return the last names of decorators, without what they are given: `app.command(name)` is `command`."""
    return frozenset([last_name(each.partition("(")[0].strip()) for each in decorators])


def are_known(function: Function) -> bool:
    """Tell whether no decorator registers a function anywhere, or may give back something else than it does."""
    return names_of(function.decorators) <= shipped_names(_TABLE, "known")


def runs_at_once(function: Function) -> bool:
    """Tell whether a call of a decorated function runs its body with nothing around it."""
    return names_of(function.decorators) <= shipped_names(_TABLE, "bare")
