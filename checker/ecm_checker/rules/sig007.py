"""Data is given in one unit and taken in another."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.handover import handovers
from ecm_checker.rule import Rule
from ecm_checker.terms import Field
from ecm_checker.units import unit

RULE = Rule(
    id="SIG007",
    name="unit_mismatch",
    dimension="signature",
    severity="error",
    who="safety",
    part_of=("SigMatch", "InputSat"),
    consequence="the robot takes the number for another quantity and moves by the wrong amount",
    resolution="convert it, or declare and use the units of REP 103 on both sides",
)


def check(case: Case) -> Iterator[Finding]:
    """Units of what one module hands over to the next, and of what a caller brings."""
    for modules, given, taken in handovers(case):
        if taken.unit is None or _same(given.unit, taken.unit):
            continue
        text = f"{given.name} is given in {given.unit or 'no declared unit'}, {modules[-1].id} takes {taken.unit}"
        evidence = [
            line for each in modules for line in each.evidence("signature.output_schema", "signature.input_schema")
        ]
        yield RULE.finding(
            text,
            Entity("unit", _key(given), _key(taken)),
            modules,
            evidence,
            certainty="proved" if given.unit is not None else "unknown",
        )


def _same(one: str | None, two: str) -> bool:
    if one is None or one == two:
        return one is not None
    first, second = unit(one), unit(two)
    return first is not None and first == second


def _key(field: Field) -> str:
    return f"{field.name} {field.unit or ''}"
