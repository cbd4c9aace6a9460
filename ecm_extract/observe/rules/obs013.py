"""A running module has a precondition that does not hold."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding
from ecm_checker.predicates import Predicate

from ecm_extract.observe.conditions import Verdict, holds
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Running, Watch

RULE = ObserveRule(
    id="OBS013",
    name="precondition_false",
    dimension="behavior",
    severity="error",
    who="graph",
    consequence="the module waits for ever, or works on what is not there",
    resolution="start what it waits for first, or bring it into the state that it needs",
)


def check(watch: Watch) -> Iterator[Finding]:
    """Preconditions of the modules of running nodes that what was seen can settle."""
    for running in watch.running:
        for wanted in running.module.preconditions or ():
            verdict = holds(watch, running.node, wanted)
            if verdict is not None and not verdict.true:
                yield _finding(running, wanted, verdict)


def _finding(running: Running, wanted: Predicate, verdict: Verdict) -> Finding:
    text = f"{running.node} needs {wanted.text}: {verdict.reason}"
    subjects = (running.module.id, running.node)
    evidence = running.module.evidence("behavior.preconditions")[:1]
    return RULE.seen(text, Entity("precondition", wanted.text), subjects, evidence)
