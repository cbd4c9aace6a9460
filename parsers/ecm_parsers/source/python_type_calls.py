"""`type(x).name = value`: the grammar takes it for a type alias of Python 3.12, though `type` is called there."""

from __future__ import annotations

from tree_sitter import Node

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op
from ecm_parsers.source.python_scan import Scan

_TYPE = Name("type")


def type_assigned(scan: Scan, node: Node) -> None:
    """Emit what such a statement gives its target; a real alias gives nothing that runs."""
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    if left is None or right is None:
        return
    target = _target(scan, left.children[0])
    if target is not None:
        scan.emit("set", node, scan.expr(right.children[0]), target)


def _target(scan: Scan, node: Node) -> Expr | None:
    """A field or an element of what the call gives; None of an alias."""
    if node.type == "parenthesized_expression":
        return Call(_TYPE, (scan.expr(node.named_children[0]),), line=node.start_point[0] + 1)
    if node.type not in {"attribute", "subscript"}:
        return None
    whole = _target(scan, node.children[0])
    if whole is None:
        return None
    if node.type == "attribute":
        return Member(whole, scan.text(node.child_by_field_name("attribute")))
    index = node.child_by_field_name("subscript")
    return Op("[]", (whole, scan.expr(index))) if index is not None else None
