"""LNT052: a private name, with a tilde, is handed to a method of a node handle, which refuses it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.source.expr import Text

from ecm_extract.link.code.calls import Invocation
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT052",
    name="tilde_with_handle",
    dimension="signature",
    severity="error",
    who="source",
    consequence="roscpp throws InvalidNameException when it gets there, and the node dies",
    resolution='make the handle private, ros::NodeHandle nh("~"), and leave the tilde out of the name',
)
_METHODS: Final = (
    *("param", "getParam", "setParam", "hasParam", "deleteParam"),
    *("advertise", "subscribe", "advertiseService", "serviceClient"),
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report calls on objects in C++ of ROS 1 whose literal name starts with a tilde; free functions take it."""
    for method in _METHODS:
        for call in workspace.linker.sites.calls.get(method, ()):
            package = workspace.by_name.get(call.func.file.package)
            name = _literal(call)
            if package is None or package.ros != 1 or call.func.file.language != "cpp" or not name.startswith("~"):
                continue
            text = f"{method} of a node handle is called with {name}"
            evidence = [Evidence(call.func.file.path, call.line)]
            yield RULE.finding(text, Entity("name", name, method), package.name, evidence)


def _literal(call: Invocation) -> str:
    """The first argument of a call on an object, where it is a text."""
    first = call.args[0] if call.args and call.receiver is not None else None
    return first.value if isinstance(first, Text) else ""
