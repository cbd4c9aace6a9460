"""What is raised and handled in Python, by type."""

from __future__ import annotations

from tree_sitter import Node

from ecm_parsers.source.expr import Op
from ecm_parsers.source.flow import Branch, Leave
from ecm_parsers.source.python_scan import Scan, parts


def raised(scan: Scan, node: Node) -> None:
    """Read `raise`, with what is raised: a statement of its own, just before the function is left."""
    value = next(iter(parts(node)), None)
    for cause in [*parts(node)][1:]:
        scan.do(cause)
    if value is not None:
        scan.emit("do", node, scan.expr(value))
    made = value.child_by_field_name("function") if value is not None and value.type == "call" else value
    scan.frame.flow.add(Leave("throw", scan.text(made) if made is not None else ""))


def asserted(scan: Scan, node: Node) -> None:
    """`assert test` raises unless the test holds."""
    read = [scan.done(child) for child in parts(node)]
    for test in read[:1]:
        scan.frame.flow.add(Branch(Op("!", (test,)), (Leave("throw", "AssertionError"),)))


def types_caught(scan: Scan, node: Node) -> tuple[str, ...]:
    """Return the types that a handler is for; none where it is for all."""
    asked = next((part for part in node.named_children if part.type not in {"block", "comment"}), None)
    if asked is not None and asked.type == "as_pattern":
        asked = next(iter(parts(asked)), None)
    if asked is None:
        return ()
    return tuple([scan.text(part) for part in (parts(asked) if asked.type == "tuple" else (asked,))])


def name_caught(scan: Scan, node: Node) -> str:
    """Return the variable that a handler has the exception in: `except ValueError as error:`."""
    asked = next((part for part in node.named_children if part.type == "as_pattern"), None)
    target = asked.child_by_field_name("alias") if asked is not None else None
    return scan.text(target) if target is not None else ""
