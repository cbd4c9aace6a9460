"""Variables of the body of a class of Python: its attributes, by their names alone as long as the body goes on."""

from __future__ import annotations

from tree_sitter import Node

from ecm_parsers.source.expr import Expr, Member, Name
from ecm_parsers.source.facts import Constant, Field
from ecm_parsers.source.python_scan import Scan


def named_by(scan: Scan, target: Expr | None) -> str:
    """Return the attribute that an assignment in the body of a class gives a value; empty of others."""
    frame = scan.frame
    if frame.place != "class" or not isinstance(target, Name | Member):
        return ""
    if isinstance(target, Name):
        return target.id
    return target.name if target.base == frame.owner else ""


def class_attribute(scan: Scan, node: Node, field: Field) -> None:
    """Note an attribute: a constant, and a statement where it is called for, or given under a condition."""
    frame, value = scan.frame, field.default
    if frame.fields is not None:
        frame.fields.append(field)
    if value is None or frame.owner is None:
        return
    own = Member(frame.owner, field.name)
    scan.names_again(field.name, own)
    scan.constants.append(Constant(field.name, frame.scope, value, field.line, field.type))
    if frame.depth > frame.begun or b"(" in scan.raw(node.parent or node):
        scan.emit("set", node, value, own, field.type)


def given_before(scan: Scan, target: Expr) -> Expr | None:
    """Return what the body of a class gave its variable before; None of other targets."""
    own = named_by(scan, target)
    return next((field.default for field in reversed(scan.frame.fields or []) if field.name == own), None)
