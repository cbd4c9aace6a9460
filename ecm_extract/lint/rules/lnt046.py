"""LNT046: a node reads a parameter by an absolute name, so that neither its name nor its namespace reaches it."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Interface
from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.link.linker import LinkedModule
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
    """Report parameters of ROS 1 programs that are written with a leading slash, once for a program and namespace.

    It is a warning where a program reads several below the name of a node that it takes itself to be, and a launch
    file starts it by another name.
    """
    names = _started(workspace)
    for entry in workspace.linked:
        package = workspace.by_name.get(entry.module.package)
        absolute = [item for item in entry.interfaces if _is_absolute(item)] if package and package.ros == 1 else []
        spaces: dict[str, list[Interface]] = {}
        for item in absolute:
            spaces.setdefault(_space(item.raw_name), []).append(item)
        for space, items in spaces.items():
            started = names.get((entry.module.package, entry.module.name), {space})
            missed = len(items) > 1 and _is_own(space, entry) and space not in started
            yield _finding(entry, items, "warning" if missed else "info")


def _finding(entry: LinkedModule, items: list[Interface], level: Severity) -> Finding:
    name = items[0].raw_name
    more = f" and {len(items) - 1} more" if len(items) > 1 else ""
    text = f"{entry.module.name} reads {name}{more}, which is absolute"
    evidence = [item.evidence[0] for item in items]
    return RULE.finding(
        text, Entity("parameter", name, owner=entry.module.name), entry.module.package, evidence, severity=level
    )


def _started(workspace: Workspace) -> dict[tuple[str, str], set[str]]:
    """Names by which launch files start each module."""
    found: dict[tuple[str, str], set[str]] = {}
    for system in workspace.systems:
        for node in system.nodes:
            for module in node.modules:
                key = (module.package, module.name)
                found.setdefault(key, set()).add(node.name.rpartition("/")[2])
    return found


def _is_absolute(interface: Interface) -> bool:
    name = interface.raw_name
    own = interface.row.value and name.startswith("/") and interface.confidence != "pattern"
    return own and name not in _SHARED and not name.startswith(_SHARED_PREFIXES)


def _space(name: str) -> str:
    """The namespace that a name begins with; empty where it has none."""
    return name.split("/")[1] if name.count("/") > 1 else ""


def _is_own(space: str, entry: LinkedModule) -> bool:
    """Tell whether a namespace is called as the program or its node is, or as its package."""
    wanted = _plain(space)
    if not wanted:
        return False
    names = [_plain(name) for name in (entry.module.name, entry.node or "") if name]
    return wanted == _plain(entry.module.package) or any(wanted in name or name in wanted for name in names)


def _plain(name: str) -> str:
    return name.rpartition("/")[2].replace("_", "").lower()
