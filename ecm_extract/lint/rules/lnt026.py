"""LNT026: a node that a launch file puts into a namespace uses a global name, which the namespace does not reach."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace, evidence_of
from ecm_extract.system.node_model import Endpoint, SystemNode

RULE = LintRule(
    id="LNT026",
    name="global_name_in_namespace",
    dimension="signature",
    severity="info",
    who="graph",
    consequence="two of these robots on one network share the topic, and each acts on the other's data",
    resolution="use a relative name, and remap it where it must be global",
)
_SHARED = ("/tf", "/tf_static", "/clock", "/rosout", "/diagnostics", "/parameter_events", "/map", "/initialpose")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report a source line once, however many instances have it."""
    seen = set()
    for system in workspace.systems:
        for node in system.nodes:
            for entry in node.endpoints if _is_inside(node) else ():
                if entry.place not in seen and _is_global(entry, node):
                    seen.add(entry.place)
                    text = (
                        f"{node.name} uses {entry.name}, which its namespace {node.instance.namespace} does not reach"
                    )
                    package = workspace.package_of(entry.place.path)
                    yield RULE.finding(text, Entity("topic", entry.name), package, [evidence_of(entry.place)])


def _is_inside(node: SystemNode) -> bool:
    namespace = node.instance.namespace
    return bool(node.modules) and namespace != "/" and "{" not in namespace


def _is_global(entry: Endpoint, node: SystemNode) -> bool:
    own = entry.before.startswith(f"{node.instance.namespace}/")
    return entry.known and not own and entry.remap is None and not entry.parameters and entry.before not in _SHARED
