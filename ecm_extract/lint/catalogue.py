"""All lint rules, found by looking into the folder of their files."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pkgutil import iter_modules

from ecm_extract.lint import rules
from ecm_extract.lint.rule import Entry


@cache
def catalogue() -> tuple[Entry, ...]:
    """Return every rule, by id."""
    names = sorted(module.name for module in iter_modules(rules.__path__))
    modules = [import_module(f"{rules.__name__}.{name}") for name in names]
    told = ((module.RULE, getattr(module, "check", None), getattr(module, "tell", None)) for module in modules)
    return tuple(Entry(rule, check, tell) for rule, check, tell in told)
