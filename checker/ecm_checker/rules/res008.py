"""A chain of modules may take longer than the robot's latency budget."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule
from ecm_checker.units import number
from ecm_checker.view import View

RULE = Rule(
    id="RES008",
    name="latency_budget_exceeded",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("GlobalSafe",),
    consequence="the task runs out of time although no single module does",
    resolution="shorten timeouts, drop a module from the chain, or raise the budget",
)


def check(case: Case) -> Iterator[Finding]:
    """Sum of timeouts along a chain against the budget."""
    robot = case.profiles.embodiment
    if robot is None or robot.latency_budget_ms is None or not case.ordered:
        return
    known = [(module, _timeout(module)) for module in case.modules]
    silent = [module for module, timeout in known if timeout is None]
    total = sum(timeout or 0.0 for _, timeout in known)
    evidence = [line for module in case.modules for line in module.evidence("signature.timeout_ms")]
    if total > robot.latency_budget_ms:
        text = f"the chain may take {total:g} ms, the budget is {robot.latency_budget_ms:g} ms"
        yield RULE.finding(text, Entity("latency", "chain"), case.modules, evidence)
    elif silent:
        text = f"no timeout is declared by {', '.join(each.id for each in silent)}"
        entity = Entity("undeclared", "signature.timeout_ms")
        yield RULE.finding(text, entity, silent, evidence, certainty="unknown")


def _timeout(module: View) -> float | None:
    value = module.contract.signature.timeout_ms
    return number(value.value) if value is not None else None
