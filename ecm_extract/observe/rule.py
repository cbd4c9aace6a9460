"""A rule of observation: the metadata that every rule has, and how it makes a finding about modules and nodes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding, Severity

from ecm_extract.lint.rule import LintRule
from ecm_extract.observe.expected import Expected
from ecm_extract.observe.watch import Watch


class ObserveRule(LintRule, frozen=True, kw_only=True):
    """What a rule file declares; see `LintRule`."""

    def seen(
        self,
        text: str,
        entity: Entity,
        subjects: Iterable[str],
        evidence: Iterable[Evidence] = (),
        *,
        certainty: Certainty = "proved",
        severity: Severity | None = None,
    ) -> Finding:
        """A finding of this rule.

        Args:
            text: what is so, naming both sides.
            entity: what it is about.
            subjects: modules and nodes concerned, modules by their id.
            evidence: lines of the contract.
            certainty: what is not proved is at most a warning.
            severity: where it differs from that of the rule.
        """
        names = tuple(dict.fromkeys(subjects))
        found = self.finding(text, entity, " ".join(names), evidence, certainty=certainty, severity=severity)
        return msgspec.structs.replace(found, subjects=names)


Check = Callable[[Watch], Iterator[Finding]]


class Entry(msgspec.Struct, frozen=True):
    """A rule of the catalogue with the function that checks it."""

    rule: ObserveRule
    check: Check


def line_of(expected: Expected) -> tuple[Evidence, ...]:
    """Where the contract read what it promises."""
    return expected.interface.evidence[:1]
