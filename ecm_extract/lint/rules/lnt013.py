"""LNT013: two active controllers claim one command interface, or one claims an interface that no hardware offers."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.controllers import Controller
from ecm_extract.system.system import System

RULE = LintRule(
    id="LNT013",
    name="claim_conflict",
    dimension="resources",
    severity="error",
    who="safety",
    consequence="the controller manager refuses to activate the controller, and the joint is not driven",
    resolution="start one of them inactive, or correct joints and interfaces",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report conflicts of controllers that are started for sure."""
    seen = set()
    for system in workspace.systems:
        active = [each for each in system.controllers if each.active and each.claims and not each.conditional]
        for finding in (*_doubled(active, workspace), *_unoffered(active, system, workspace)):
            if finding.fingerprint not in seen:
                seen.add(finding.fingerprint)
                yield finding


def _doubled(active: list[Controller], workspace: Workspace) -> Iterator[Finding]:
    """One finding for two controllers, whatever they share."""
    owners: dict[tuple[str, str], Controller] = {}
    for controller in active:
        shared: dict[str, tuple[Controller, list[str]]] = {}
        for claim in controller.claims or ():
            first = owners.setdefault((controller.namespace, claim), controller)
            if first is not controller and "{" not in claim:
                shared.setdefault(first.name, (first, []))[1].append(claim)
        for first, claims in shared.values():
            text = f"{first.name} and {controller.name} both claim {', '.join(claims)}"
            evidence = [evidence_of(controller.place), evidence_of(first.place)]
            package = workspace.package_of(controller.place.path)
            yield RULE.finding(text, Entity("claim", claims[0], f"{first.name} {controller.name}"), package, evidence)


def _unoffered(active: list[Controller], system: System, workspace: Workspace) -> Iterator[Finding]:
    """A claim of another controller's reference interface starts with that controller's name."""
    parts = [part for robot in system.robots for hardware in robot.hardware for part in hardware.parts]
    offered = {name for part in parts for name in part.interfaces()}
    chained = {controller.name for controller in system.controllers}
    if not offered or any("{" in name for name in offered) or any(robot.problems for robot in system.robots):
        return
    for controller in active:
        for claim in controller.claims or ():
            if "{" not in claim and claim not in offered and claim.partition("/")[0] not in chained:
                text = f"{controller.name} claims {claim}, which no hardware of {system.robots[0].path} offers"
                evidence = [evidence_of(controller.place)]
                package = workspace.package_of(controller.place.path)
                entity = Entity("claim", claim, controller.name)
                yield RULE.finding(text, entity, package, evidence, certainty="likely")
