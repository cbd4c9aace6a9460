"""The catalogue: every file in `rules/`, found by looking. A rule file holds `RULE` and `check`."""

from __future__ import annotations

from functools import cache

from ecm_checker import rules
from ecm_checker.any_rule import rule_files
from ecm_checker.rule import Entry


@cache
def catalogue() -> tuple[Entry, ...]:
    """All rules, by id."""
    return tuple(Entry(file.RULE, file.check) for file in rule_files(rules))
