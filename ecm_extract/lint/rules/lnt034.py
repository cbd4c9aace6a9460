"""LNT034: a rospy publisher is made without the size of its queue."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.source.expr import Call, Text

from ecm_extract.link.code.full_names import full_name
from ecm_extract.link.code.units import File
from ecm_extract.link.code.walk import dotted, expressions
from ecm_extract.lint.rule import LintRule
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
    """Report publishers without queue_size, whether or not their topic can be told."""
    if workspace.provides("rospy", f"<{_SINCE}"):
        return
    old = {package.name for package in workspace.packages if package.root.rosbuild}  # their rospy has no queue_size
    for file in workspace.linker.program.files:
        if (
            file.package not in old
            and file.language == "python"
            and any(name.startswith("rospy") for name in file.imported.values())
        ):
            yield from _of(file)


def _of(file: File) -> Iterator[Finding]:
    for function in file.facts.functions:
        for statement in function.body:
            for expr, line in expressions(statement):
                if isinstance(expr, Call) and _is_publisher(expr, file) and not _is_sized(expr):
                    first = expr.args[0] if expr.args else None
                    name = first.value if isinstance(first, Text) else "a topic"
                    text = f"the publisher of {name} has no queue_size"
                    entity = Entity("topic", name, f"{function.scope}::{function.name}")
                    yield RULE.finding(text, entity, file.package, [Evidence(file.path, line)])


def _is_publisher(call: Call, file: File) -> bool:
    full = full_name(dotted(call.callee) or "", file.imported)
    return full == "rospy.Publisher" and len(call.args) + len(call.keywords) > 1


def _is_sized(call: Call) -> bool:
    """Arguments that are spread may hold it."""
    return len(call.args) > _POSITION or bool({"queue_size", ""} & {name for name, _ in call.keywords})
