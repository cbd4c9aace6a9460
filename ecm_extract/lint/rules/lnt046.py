"""LNT046: a node reads a parameter by an absolute name, so that neither its name nor its namespace reaches it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity
from ecm_checker.hub.running import RunningEndpoint, RunningModule

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
    others = _names_of_others(names)
    for module in workspace.index.modules:
        absolute = [each for each in module.endpoints if _is_absolute(each)]
        for space, items in (_by_space(absolute) if workspace.ros_of(module.package) == 1 else {}).items():
            started = names.get((module.package, module.name), {space})
            missed = len(items) > 1 and _is_own(space, module) and space not in {*started, *others}
            yield _finding(module, items, "warning" if missed else "info")


def _by_space(items: Iterable[RunningEndpoint]) -> Mapping[str, list[RunningEndpoint]]:
    found: dict[str, list[RunningEndpoint]] = defaultdict(list)
    for item in items:
        found[_space(item.raw_name)].append(item)
    return found


def _finding(module: RunningModule, items: list[RunningEndpoint], level: Severity) -> Finding:
    name = items[0].raw_name
    more = f" and {len(items) - 1} more" if len(items) > 1 else ""
    text = f"{module.name} reads {name}{more}, which is absolute"
    evidence = [Evidence(item.path, item.line) for item in items]
    return RULE.finding(text, Entity("parameter", name, owner=module.name), module.package, evidence, severity=level)


def _started(workspace: Workspace) -> dict[tuple[str, str], set[str]]:
    """Names by which launch files start each module."""
    found: dict[tuple[str, str], set[str]] = {}
    for system in workspace.systems:
        for node in system.nodes:
            for module in node.modules:
                key = (module.package, module.name)
                found.setdefault(key, set()).add(node.name.rpartition("/")[2])
    return found


def _names_of_others(started: Mapping[tuple[str, str], Iterable[str]]) -> frozenset[str]:
    """Names by which launch files start anything: what lies below one is of that node, and read on purpose."""
    return frozenset(name for names in started.values() for name in names)


def _is_absolute(item: RunningEndpoint) -> bool:
    name = item.raw_name
    own = item.row.value and name.startswith("/") and "{" not in name
    return own and name not in _SHARED and not name.startswith(_SHARED_PREFIXES)


def _space(name: str) -> str:
    """The namespace that a name begins with; empty where it has none."""
    return name.split("/")[1] if name.count("/") > 1 else ""


def _is_own(space: str, module: RunningModule) -> bool:
    """Tell whether a namespace is called as the program or its node is, or as its package."""
    wanted = _plain(space)
    if not wanted:
        return False
    names = [_plain(name) for name in (module.name, module.node or "") if name]
    return wanted == _plain(module.package) or any(wanted in name or name in wanted for name in names)


def _plain(name: str) -> str:
    return name.rpartition("/")[2].replace("_", "").lower()
