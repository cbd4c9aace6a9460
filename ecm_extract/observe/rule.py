"""A rule of observation: how it makes a finding about modules and nodes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

import msgspec
from ecm_checker.any_rule import AnyRule, Said
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding, Severity

from ecm_extract.observe.expected import Expected
from ecm_extract.observe.watch import Watch


class ObserveRule(AnyRule, frozen=True, kw_only=True):
    """What a rule file of observation declares: what every rule does."""

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
        said = Said(
            text=text,
            entity=entity,
            owners=(" ".join(names),),
            subjects=names,
            evidence=evidence,
            certainty=certainty,
            severity=severity,
        )
        return self.found(said)


Check = Callable[[Watch], Iterator[Finding]]


class Entry(msgspec.Struct, frozen=True):
    """A rule of the catalogue with the function that checks it."""

    rule: ObserveRule
    check: Check


def line_of(expected: Expected) -> tuple[Evidence, ...]:
    """Where the contract read what it promises."""
    return expected.interface.evidence[:1]
