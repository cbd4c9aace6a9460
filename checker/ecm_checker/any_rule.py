"""What every rule of check, lint and observe is: its metadata, and how it makes a finding."""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType
from typing import Final

import msgspec

from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Dimension, Edit, Entity, Finding, Severity, Who, fingerprint

_WORST_WITHOUT_PROOF: Final[Severity] = "warning"


class Said(msgspec.Struct, frozen=True, kw_only=True):
    """What a finding says; what is empty or None is as the rule has it.

    Attributes:
        text: what is so, naming both sides.
        entity: what it is about.
        owners: packages, or modules and nodes, whose it is; with the entity they make the fingerprint.
        subjects: whom it concerns.
        evidence: the causing line first.
        certainty: what is not proved is at most a warning.
        severity, consequence, resolution, who: where they are not those of the rule.
        edit: what surely mends it.
    """

    text: str
    entity: Entity
    owners: tuple[str, ...]
    subjects: tuple[str, ...]
    evidence: Iterable[Evidence] = ()
    certainty: Certainty = "proved"
    severity: Severity | None = None
    consequence: str = ""
    resolution: str = ""
    who: Who | None = None
    edit: Edit | None = None


class AnyRule(msgspec.Struct, frozen=True, kw_only=True):
    """What a rule file declares.

    Attributes:
        id: `SIG001`; the name of its file in lower case.
        name: for people, snake case.
        dimension: of the contract.
        severity: of a finding that is proved.
        who: what breaks.
        consequence: what the robot does when it is ignored.
        resolution: what to do.
    """

    id: str
    name: str
    dimension: Dimension
    severity: Severity
    who: Who
    consequence: str
    resolution: str

    def found(self, said: Said) -> Finding:
        """A finding of this rule."""
        what = " ".join(said.text.split())  # a parser's own words may go over several lines
        after = said.consequence or self.consequence
        level = said.severity or self.severity
        return Finding(
            rule=self.id,
            name=self.name,
            dimension=self.dimension,
            severity=_WORST_WITHOUT_PROOF if level == "error" and said.certainty != "proved" else level,
            message=f"{what}: {after}" if after else what,
            resolution=said.resolution or self.resolution,
            subjects=said.subjects,
            evidence=tuple(said.evidence),
            fingerprint=fingerprint(self.id, said.entity, said.owners),
            who=said.who or self.who,
            certainty=said.certainty,
            about=said.entity,
            edit=said.edit,
        )


def rule_files(folder: ModuleType) -> tuple[ModuleType, ...]:
    """Every file of a folder of rules, by name. Each holds `RULE`, and `check` or `tell`."""
    names = sorted(found.name for found in iter_modules(folder.__path__))
    return tuple(import_module(f"{folder.__name__}.{name}") for name in names)
