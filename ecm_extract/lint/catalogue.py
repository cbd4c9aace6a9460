"""All lint rules, found by looking into the folder of their files."""

from __future__ import annotations

from functools import cache

from ecm_checker.any_rule import rule_files

from ecm_extract.lint import rules
from ecm_extract.lint.rule import Entry


@cache
def catalogue() -> tuple[Entry, ...]:
    """Return every rule, by id."""
    files = rule_files(rules)
    return tuple(Entry(file.RULE, getattr(file, "check", None), getattr(file, "tell", None)) for file in files)
