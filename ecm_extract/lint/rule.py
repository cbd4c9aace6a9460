"""A lint rule: what it is called, how bad it is, and how it makes a finding."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Final, Literal

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Dimension, Edit, Entity, Finding, Severity, Who, fingerprint

if TYPE_CHECKING:
    from ecm_extract.lint.known import Known
    from ecm_extract.lint.workspace import Workspace


_WORST_WITHOUT_PROOF: Final[Severity] = "warning"

Tier = Literal["stable", "preview"]
"""Whether enough of what a rule says was judged, and found true and wanted: benchmarks/lint_precision.py."""


class LintRule(msgspec.Struct, frozen=True, kw_only=True):
    """What a rule file declares.

    Attributes:
        id: `LNT001`; the name of its file in lower case.
        name: for people, snake case.
        dimension: of the contract. severity: of a finding that is proved. who: what breaks.
        consequence: what the robot does when it is ignored.
        resolution: what to do.
        tier: a preview rule runs with `--preview` only.
    """

    id: str
    name: str
    dimension: Dimension
    severity: Severity
    who: Who
    consequence: str
    resolution: str
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
        level = severity or self.severity
        what = " ".join(text.split())  # a parser's own words may go over several lines
        after = consequence or self.consequence
        return Finding(
            rule=self.id,
            name=self.name,
            dimension=self.dimension,
            severity=_WORST_WITHOUT_PROOF if level == "error" and certainty != "proved" else level,
            message=f"{what}: {after}" if after else what,
            resolution=resolution or self.resolution,
            subjects=(package,),
            evidence=tuple(evidence),
            fingerprint=fingerprint(self.id, entity, (package,)),
            who=self.who,
            certainty=certainty,
            about=entity,
            edit=edit,
        )


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
