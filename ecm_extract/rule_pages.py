"""The pages of the rules, of check, lint and observe alike."""

from __future__ import annotations

import sys
from pathlib import Path

from ecm_checker.catalogue import catalogue as checker_rules
from ecm_checker.rule import Rule

from ecm_extract.errors import InputError
from ecm_extract.lint.catalogue import catalogue as lint_rules
from ecm_extract.lint.rule import LintRule
from ecm_extract.observe.catalogue import catalogue as observe_rules
from ecm_extract.uses.findings import RULE as BREAK

_INSTALLED = Path(sys.prefix) / "share" / "ecm-extract" / "rules"
_BESIDE = Path(__file__).parent.parent / "docs" / "rules"


def every_rule() -> list[Rule | LintRule]:
    """Return every rule, by id."""
    found: list[Rule | LintRule] = [entry.rule for entry in checker_rules()]
    found += [entry.rule for entry in lint_rules()]
    found += [entry.rule for entry in observe_rules()]
    return sorted(found, key=lambda rule: rule.id)


def page_of(rule: str) -> str:
    """Return the page of a rule as Markdown.

    Raises:
        InputError: there is no such rule.
    """
    if rule not in {BREAK, *(entry.id for entry in every_rule())}:
        message = f"there is no rule {rule}"
        raise InputError(message, "`ecm-extract rules` lists them")
    pages = (folder / f"{rule}.md" for folder in (_BESIDE, _INSTALLED))
    page = next((path for path in pages if path.is_file()), None)
    if page is None:
        message = f"the page of {rule} is not installed"
        raise InputError(message, "it stands in docs/rules of the sources")
    return page.read_text("utf-8")
