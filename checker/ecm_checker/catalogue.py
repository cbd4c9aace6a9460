"""The catalogue: every file in `rules/`, found by looking. A rule file holds `RULE` and `check`."""

from __future__ import annotations

import pkgutil
from functools import cache
from importlib import import_module

from ecm_checker import rules
from ecm_checker.rule import Entry


@cache
def catalogue() -> tuple[Entry, ...]:
    """All rules, by id."""
    names = sorted(found.name for found in pkgutil.iter_modules(rules.__path__))
    modules = (import_module(f"{rules.__name__}.{name}") for name in names)
    return tuple(Entry(module.RULE, module.check) for module in modules)
