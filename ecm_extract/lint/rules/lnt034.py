"""LNT034: a rospy publisher is made without the size of its queue."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity
from ecm_parsers.source.expr import Call, Text

from ecm_extract.link.code.full_names import full_name
from ecm_extract.link.code.units import File
from ecm_extract.link.code.walk import dotted, expressions
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.started import is_left_aside, programs_started
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT034",
    name="publisher_queue_unset",
    dimension="behavior",
    severity="warning",
    who="qos",
    consequence="publishing waits for the slowest subscriber, and rospy warns at each start",
    resolution="give queue_size, 1 for commands and the latest state, more for what must not be lost",
    tier="stable",
)
_SINCE = "1.11.1"
"""rospy that warns; queue_size came with 1.11.0 (ros_comm changelog)."""
_POSITION = 6
"""Of queue_size among the arguments of rospy.Publisher."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report publishers without queue_size, whether or not their topic can be told.

    In a script that nothing of the tree starts, installs or imports, as it does others beside it, it is an info.
    """
    if workspace.provides("rospy", f"<{_SINCE}"):
        return
    started = programs_started(workspace)
    for file in workspace.linker.program.files:
        found = list(_unsized(file)) if _has_sizes(file, workspace) else []
        if found:
            level: Severity | None = "info" if is_left_aside(file.path, file.package, started, workspace) else None
            yield from (_finding(name, scope, Evidence(file.path, line), file, level) for name, scope, line in found)


def _has_sizes(file: File, workspace: Workspace) -> bool:
    """Tell whether a file uses a rospy that asks for queue_size; that of a rosbuild package has none."""
    package = workspace.by_name.get(file.package)
    is_old = package is not None and package.root.rosbuild
    return not is_old and file.language == "python" and any(name.startswith("rospy") for name in file.imported.values())


class _Unsized(NamedTuple):
    """A publisher without queue_size: its topic, and where."""

    topic: str
    scope: str
    line: int


def _unsized(file: File) -> Iterator[_Unsized]:
    for function in file.facts.functions:
        for statement in function.body:
            for expr, line in expressions(statement):
                if isinstance(expr, Call) and _is_publisher(expr, file) and not _is_sized(expr):
                    first = expr.args[0] if expr.args else None
                    name = first.value if isinstance(first, Text) else "a topic"
                    yield _Unsized(name, f"{function.scope}::{function.name}", line)


def _finding(name: str, scope: str, place: Evidence, file: File, level: Severity | None) -> Finding:
    text = f"the publisher of {name} has no queue_size"
    return RULE.finding(text, Entity("topic", name, scope), file.package, [place], severity=level)


def _is_publisher(call: Call, file: File) -> bool:
    full = full_name(dotted(call.callee) or "", file.imported)
    return full == "rospy.Publisher" and len(call.args) + len(call.keywords) > 1


def _is_sized(call: Call) -> bool:
    """Arguments that are spread may hold it."""
    return len(call.args) > _POSITION or bool({"queue_size", ""} & {name for name, _ in call.keywords})
