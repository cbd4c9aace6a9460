"""The output of a module has another type than the input that it is supplied to."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.handover import handovers
from ecm_checker.rule import Rule

RULE = Rule(
    id="SIG008",
    name="schema_type_mismatch",
    dimension="signature",
    severity="error",
    who="wire",
    part_of=("SigMatch", "InputSat"),
    tier="schema",
    consequence="the module refuses the value, or misreads it",
    resolution="convert it before it is handed over, or use one type on both sides",
)


def check(case: Case) -> Iterator[Finding]:
    """Types of fields that one module hands over to the next."""
    for modules, given, taken in handovers(case):
        if given.type is None or taken.type is None or given.type == taken.type:
            continue
        text = f"{given.name} is {given.type}, {modules[-1].id} takes {taken.name} as {taken.type}"
        evidence = [
            line for each in modules for line in each.evidence("signature.output_schema", "signature.input_schema")
        ]
        yield RULE.finding(text, Entity("field", given.name, taken.name), modules, evidence)
