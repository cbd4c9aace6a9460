"""A required input is not supplied."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.handover import called_with, supplied
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="SIG009",
    name="input_missing",
    dimension="signature",
    severity="error",
    who="wire",
    part_of=("InputSat",),
    consequence="the call is refused, or the module works with a default that nobody chose",
    resolution="supply the input in the call",
)


def check(case: Case) -> Iterator[Finding]:
    """Required inputs of a called module that its caller does not bring."""
    if case.call is None:
        return
    for module in case.modules:
        evidence = module.evidence("signature.input_schema")
        if module.inputs is None:
            text = f"the inputs of {module.id} are undeclared"
            yield RULE.finding(text, Entity("input", ""), (module,), evidence, certainty="unknown")
        for name in _missing(case, module):
            text = f"{case.call.caller} does not supply {name!r} to {module.id}"
            yield RULE.finding(text, Entity("input", name), (module,), evidence)


def _missing(case: Case, module: View) -> list[str]:
    inputs = module.inputs or ()
    given = {taken.name for _, taken in supplied(called_with(case.call), inputs)}
    return [field.name for field in inputs if not field.optional and field.name not in given]
