"""The pages of the rules, of check, lint and observe alike."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

from ecm_checker.any_rule import AnyRule
from ecm_checker.catalogue import catalogue as checker_rules

from ecm_extract.diff.break_findings import NAME as BREAK_NAME
from ecm_extract.diff.break_findings import RULE as BREAK
from ecm_extract.errors import InputError
from ecm_extract.lint.catalogue import catalogue as lint_rules
from ecm_extract.observe.catalogue import catalogue as observe_rules
from ecm_extract.rule_ids import rule_named

_INSTALLED = Path(sys.prefix) / "share" / "ecm-extract" / "rules"
_BESIDE = Path(__file__).parent.parent / "docs" / "rules"


def every_rule() -> list[AnyRule]:
    """Return every rule of check, lint and observe, by id."""
    found: list[AnyRule] = [entry.rule for entry in checker_rules()]
    found += [entry.rule for entry in lint_rules()]
    found += [entry.rule for entry in observe_rules()]
    return sorted(found, key=lambda rule: rule.id)


def rule_names() -> Mapping[str, str]:
    """Return the name of every rule by its id, that of diff too."""
    return {BREAK: BREAK_NAME, **{rule.id: rule.name for rule in every_rule()}}


def lint_rule_ids() -> frozenset[str]:
    """Return the rules whose findings lint may show; those of diff come with `--base`."""
    return frozenset({BREAK, *(entry.rule.id for entry in lint_rules())})


def page_of(name: str) -> str:
    """Return the page of a rule as Markdown.

    Args:
        name: its id, in any case.

    Raises:
        InputError: there is no such rule.
    """
    rule = rule_named(name, rule_names())
    pages = (folder / f"{rule}.md" for folder in (_BESIDE, _INSTALLED))
    page = next((path for path in pages if path.is_file()), None)
    if page is None:
        message = f"the page of {rule} is not installed"
        raise InputError(message, "it stands in docs/rules of the sources")
    return page.read_text("utf-8")
