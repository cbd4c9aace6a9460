"""Parameters of functions and lambdas of Python."""

from __future__ import annotations

from tree_sitter import Node

from ecm_parsers.source.facts import Parameter
from ecm_parsers.source.python_scan import Scan, parts

_SEPARATORS = frozenset(("keyword_separator", "positional_separator"))


def parameters(scan: Scan, node: Node | None) -> tuple[Parameter, ...]:
    """Return the parameters of a list of them, in its order."""
    if node is None:
        return ()
    return tuple([_parameter(scan, child) for child in parts(node) if child.type not in _SEPARATORS])


def _parameter(scan: Scan, node: Node) -> Parameter:
    kind = node.type
    if kind == "typed_parameter":
        return Parameter(scan.text(node.children[0]), scan.text(node.child_by_field_name("type")))
    if kind not in ("default_parameter", "typed_default_parameter"):
        return Parameter(scan.text(node))
    default = node.child_by_field_name("value")
    return Parameter(
        scan.text(node.child_by_field_name("name")),
        scan.text(node.child_by_field_name("type")),
        scan.expr(default) if default is not None else None,
    )
