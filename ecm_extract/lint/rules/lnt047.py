"""LNT047: a hardware component answers a mode switch for interfaces that are not its own.

Source: control.ros.org, "Writing a Hardware Component"; until ros2_control 4.31 and 5.1 every component is handed the
interfaces of all components.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.requires.cpp_switches import SWITCH, switches_by_type

RULE = LintRule(
    id="LNT047",
    name="mode_switch_of_others",
    dimension="resources",
    severity="warning",
    who="safety",
    consequence="with two robots in one controller manager, a switch of the one stops or refuses the other",
    resolution="compare the whole name `joint/interface` with the interfaces that the component exports",
)
_SCOPED: Final = (">=4.31,<5", ">=5.1")
"""Versions whose resource manager hands each component its own interfaces only (ros2_control changelog)."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report mode switches that take names apart at the slash and never look at the component's own names."""
    if any(workspace.provides("hardware_interface", versions) for versions in _SCOPED):
        return
    for func in switches_by_type(workspace.linker.program):
        if func.file.package in workspace.by_name:
            owner = func.fact.scope
            text = f"{owner}::{SWITCH} looks at the types of the interfaces alone"
            evidence = [Evidence(func.file.path, func.fact.line)]
            entity = Entity("method", f"{owner}::{SWITCH}")
            yield RULE.finding(text, entity, func.file.package, evidence, certainty="likely")
