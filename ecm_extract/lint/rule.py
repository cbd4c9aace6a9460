"""A lint rule: whether it is stable, and how it makes a finding about a package."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Literal

import msgspec
from ecm_checker.any_rule import AnyRule, Said
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Edit, Entity, Finding, Severity

if TYPE_CHECKING:
    from ecm_extract.lint.known import Known
    from ecm_extract.lint.workspace import Workspace


Tier = Literal["stable", "preview"]
"""Whether enough of what a rule says was judged, and found true and wanted: benchmarks/lint_precision.py."""


class LintRule(AnyRule, frozen=True, kw_only=True):
    """What a rule file of lint declares beside what every rule does; a preview rule runs with `--preview` only.

    Attributes:
        of_one_tree: it compares packages that one repository holds or one workspace builds; those that are known by
            their documents are of neither, so that it is not asked of them.
        of_sources: what it tells of packages whose sources it has, and not of those that documents tell of; in words.
    """

    tier: Tier = "preview"
    of_one_tree: bool = False
    of_sources: str = ""

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
        edit: Edit | None = None,
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
            edit: what surely mends it.
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
            edit=edit,
        )
        return self.found(said)


Check = Callable[["Workspace"], Iterator[Finding]]
Tell = Callable[["Known"], Iterator[Finding]]
"""A rule that asks whether the other side is there, of what packages provide and require alone."""


class Entry(msgspec.Struct, frozen=True):
    """A rule of the catalogue with the function that checks it."""

    rule: LintRule
    check: Check | None
    tell: Tell | None = None

    def findings(self, workspace: Workspace) -> Iterator[Finding]:
        """Yield what the rule says of a workspace."""
        if self.tell is not None:
            yield from self.tell(workspace.known)
        if self.check is not None:
            yield from self.check(workspace)
