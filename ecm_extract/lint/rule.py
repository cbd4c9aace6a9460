"""A lint rule: whether it is stable, and how it makes a finding about a package."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Literal

import msgspec
from ecm_checker.any_rule import AnyRule, Said
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding, Severity

if TYPE_CHECKING:
    from ecm_extract.lint.workspace import Workspace


Tier = Literal["stable", "preview"]
"""Whether enough of what a rule says was judged, and found true and wanted: benchmarks/lint_precision.py."""


class LintRule(AnyRule, frozen=True, kw_only=True):
    """What a rule file of lint declares beside what every rule does; a preview rule runs with `--preview` only."""

    tier: Tier = "preview"

    def finding(
        self,
        text: str,
        entity: Entity,
        package: str,
        evidence: Iterable[Evidence],
        *,
        certainty: Certainty = "proved",
        severity: Severity | None = None,
        consequence: str = "",
        resolution: str = "",
    ) -> Finding:
        """A finding of this rule.

        Args:
            text: what is so, naming both sides.
            entity: what it is about.
            package: whose line causes it.
            evidence: the causing line first.
            certainty: what is not proved is at most a warning.
            severity: where it differs from that of the rule.
            consequence: where it differs from that of the rule, such as by what starts the launch file.
            resolution: where it is more exact than that of the rule.
        """
        said = Said(
            text=text,
            entity=entity,
            owners=(package,),
            subjects=(package,),
            evidence=evidence,
            certainty=certainty,
            severity=severity,
            consequence=consequence,
            resolution=resolution,
        )
        return self.found(said)


Check = Callable[["Workspace"], Iterator[Finding]]


class Entry(msgspec.Struct, frozen=True):
    """A rule of the catalogue with the function that checks it.

    `rename` finds `old` and `new` in a message of the rule when the one can surely be written for the other.
    """

    rule: LintRule
    check: Check
    rename: re.Pattern[str] | None = None
