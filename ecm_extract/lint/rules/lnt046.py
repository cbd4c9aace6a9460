"""LNT046: a node reads a parameter by an absolute name, so that neither its name nor its namespace reaches it."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT046",
    name="parameter_absolute",
    dimension="signature",
    severity="info",
    who="config",
    consequence="what is set for the node is not read, and two instances share one value",
    resolution="read it from a private NodeHandle, or by ~name in Python",
)
_SHARED = frozenset({"/use_sim_time", "/robot_description", "/robot_description_semantic", "/rosdistro", "/rosversion"})
_SHARED_PREFIXES = ("/robot_description", "/run_id", "/roslaunch")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report parameters of ROS 1 programs that are written with a leading slash, each line once."""
    seen = set()
    for entry in workspace.linked:
        package = workspace.by_name.get(entry.module.package)
        if package is None or package.ros != 1:
            continue
        for interface in entry.interfaces:
            place = interface.evidence[0]
            name = interface.raw_name
            absolute = interface.role == "parameter" and name.startswith("/") and interface.confidence != "pattern"
            if absolute and name not in _SHARED and not name.startswith(_SHARED_PREFIXES) and place not in seen:
                seen.add(place)
                text = f"{entry.module.name} reads {name}, which is absolute"
                yield RULE.finding(text, Entity("parameter", name), entry.module.package, interface.evidence[:2])
