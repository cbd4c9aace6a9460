"""What `with` of Python enters: as it may handle what is raised in its block, that is an attempt."""

from __future__ import annotations

from typing import Final

from tree_sitter import Node

from ecm_parsers.source.expr import Call, Expr, Member, Name
from ecm_parsers.source.flow import Attempt, Handler
from ecm_parsers.source.python_scan import Scan, parts

_SUPPRESSING: Final = "suppress"
"""docs.python.org, contextlib."""


def entered(scan: Scan, node: Node) -> None:
    """Read `with`: what it enters one after the other, then its block, of which the last one handles first."""
    handlers: list[Handler] = []
    for child in parts(node):
        if child.type == "with_clause":
            handlers += [handler for item in parts(child) for handler in _item(scan, item)]
        elif child.type == "block" and handlers:
            scan.frame.flow.add(Attempt(scan.inner(child), tuple(reversed(handlers))))
        elif child.type == "block":
            scan.block(child)


def _item(scan: Scan, node: Node) -> list[Handler]:
    found: list[Handler] = []
    for child in parts(node):
        halves = parts(child) if child.type == "as_pattern" else []
        if len(halves) == 2:
            targets = [scan.expr(target) for target in parts(halves[1])]
            context = scan.expr(halves[0])
            scan.emit("let", node, context, targets[0] if targets else None)
        else:
            context = scan.expr(child)
            scan.do(child)
        found += _handler(scan, halves[0] if len(halves) == 2 else child, context)
    return found


def _handler(scan: Scan, node: Node, context: Expr) -> list[Handler]:
    """What handles exceptions for a context: `suppress(KeyError)` by its types, others as their class says."""
    called, given = node.child_by_field_name("function"), node.child_by_field_name("arguments")
    if called is not None and given is not None and scan.text(called).rpartition(".")[2] == _SUPPRESSING:
        return [Handler(tuple([scan.text(part) for part in parts(given)]), ())]
    return [Handler((), (), context=context)] if isinstance(context, Call | Name | Member) else []
