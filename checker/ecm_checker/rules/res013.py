"""A hardware component answers a switch of controllers for the interfaces of joints that are not its own.

Source: ros2_control changelog: since 4.31 and 5.1 the resource manager hands each component its own interfaces only.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.requirement import Requirement
from ecm_checker.launch_names import required
from ecm_checker.package_said import package_said
from ecm_checker.rule import Rule
from ecm_checker.versions import in_range

RULE = Rule(
    id="RES013",
    name="switch_of_other_joints",
    dimension="resources",
    severity="warning",
    who="safety",
    part_of=("ResJointSat",),
    consequence="with two robots in one controller manager, a switch of the one stops or refuses the other",
    resolution="compare the whole name `joint/interface` with the interfaces that the component exports",
)
_FRAMEWORK: Final = "hardware_interface"
_SCOPED: Final = (">=4.31,<5", ">=5.1")


def check(case: Case) -> Iterator[Finding]:
    """Components that answer for any joint, below a framework that hands them the interfaces of all."""
    held = case.packages.version(_FRAMEWORK) if case.packages is not None else None
    if case.packages is None or any(in_range(held or "", versions) for versions in _SCOPED):
        return
    for package, wanted in required(case.packages, "answers_switch"):
        yield _finding(package, wanted)


def _finding(package: str, wanted: Requirement) -> Finding:
    said = package_said(
        text=f"{wanted.scope}::prepare_command_mode_switch looks at the types of the interfaces alone",
        entity=Entity("class", wanted.scope),
        packages=(package,),
        evidence=wanted.evidence,
    )
    return RULE.found(said)
