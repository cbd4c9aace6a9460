"""The release gate manager: Submit, Validate, Classify, Promote; a verdict of six gates (`ecm-extract/verdict/1`).

Paper, section "Release Gating and Runtime Validation". A verdict holds all that it stands on: judged again, it is
the same.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal

import msgspec
from ecm_checker.freeze import content_hash
from ecm_checker.release import ACTIONS, Action, CompatibilityClass
from ecm_checker.versions import Bump
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.channels import Gate, Table
from ecm_extract.registry.demands import DEMANDS, Answer
from ecm_extract.registry.matter import Inputs, Matter

State = Literal["passed", "refused", "waived"]


class Waiver(msgspec.Struct, frozen=True):
    """Somebody answers for a gate of a release that goes to a channel, until a time."""

    gate: str
    name: str
    reason: str
    ends: str


class GateVerdict(msgspec.Struct, frozen=True):
    """What a gate says.

    Attributes:
        level: of the channel. reasons: of each demand. evidence: digests of what it stands on.
        waiver: who answers for it, where it is waived.
    """

    gate: str
    level: str
    state: State
    reasons: tuple[str, ...]
    evidence: tuple[str, ...] = ()
    waiver: Waiver | None = None


class Verdict(msgspec.Struct, frozen=True, kw_only=True):
    """What the gates say of a release.

    Attributes:
        release: `package@version`.
        compatibility_class, action: what changed, and what that asks for. required, declared: steps of the version.
        gates: in the order of the table; all must be passed or waived.
        inputs, waivers, table: what it stands on. checker: content hash of the rules.
    """

    schema: Literal["ecm-extract/verdict/1"] = "ecm-extract/verdict/1"
    release: str
    compatibility_class: CompatibilityClass
    action: Action
    required: Bump
    declared: Bump | None
    gates: tuple[GateVerdict, ...]
    inputs: Inputs
    waivers: tuple[Waiver, ...]
    table: Table
    checker: str

    @property
    def passed(self) -> bool:
        """Whether the release may go."""
        return all(each.state != "refused" for each in self.gates)


def judge(session: Session, inputs: Inputs, waivers: Sequence[Waiver], table: Table) -> Verdict:
    """Validate and classify a release that was submitted to a channel.

    Raises:
        InputError: the table names a demand that there is not.
    """
    matter = Matter(session, inputs)
    return Verdict(
        release=f"{matter.package.name}@{matter.package.version}",
        compatibility_class=matter.compatibility_class,
        action=ACTIONS[matter.compatibility_class],
        required=matter.required,
        declared=matter.declared,
        gates=tuple(_gates(matter, waivers, table)),
        inputs=inputs,
        waivers=tuple(waivers),
        table=table,
        checker=content_hash(),
    )


def judged_again(session: Session, verdict: Verdict) -> Verdict:
    """Judge once more what a verdict stands on."""
    return judge(session, verdict.inputs, verdict.waivers, verdict.table)


def _gates(matter: Matter, waivers: Sequence[Waiver], table: Table) -> Iterator[GateVerdict]:
    valid = {each.gate: each for each in waivers if each.ends > matter.inputs.at}
    for name, gate in table.gates.items():
        answers = [_answer(demand, matter) for demand in table.demands(name, matter.inputs.channel)]
        yield _verdict(name, _level(gate, matter, table), answers, valid.get(name))


def _level(gate: Gate, matter: Matter, table: Table) -> str:
    return table.channels[matter.inputs.channel][gate.column]


def _verdict(name: str, level: str, answers: Sequence[Answer], waiver: Waiver | None) -> GateVerdict:
    refused = [each for each in answers if not each.met]
    state: State = "passed" if not refused else "waived" if waiver is not None else "refused"
    reasons = tuple(each.reason for each in refused or answers)
    evidence = tuple(dict.fromkeys(digest for each in answers for digest in each.evidence))
    return GateVerdict(name, level, state, reasons, evidence, waiver if state == "waived" else None)


def _answer(demand: str, matter: Matter) -> Answer:
    found = DEMANDS.get(demand)
    if found is None:
        message = f"the table of gates names the demand {demand}, which there is not"
        raise InputError(message, f"demands: {', '.join(DEMANDS)}")
    return found(matter)
