"""Lambdas of Python.

One that gets a name, is kept in a member, is returned, or is handed to a function or to a method of the same object,
and calls something, is read as a function of its own, as a `def` at its place would be. What others call is part of
the body around them, to be run later.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final

from tree_sitter import Node

from ecm_parsers.source.expr import Expr, Lambda
from ecm_parsers.source.facts import Function, Parameter, Statement
from ecm_parsers.source.flow import Later
from ecm_parsers.source.python_parameters import parameters
from ecm_parsers.source.python_scan import ExprHandler, Frame, Scan, parts

_BUILT_IN: Final = frozenset({"filter", "iter", "map", "max", "min", "sorted"})
"""Functions of Python that call what they are given at once, or for each element (docs.python.org: functions)."""


def _lambda(scan: Scan, node: Node) -> Expr:
    body = node.child_by_field_name("body")
    if body is None:
        return Lambda(())
    name = _name(scan, node)
    if name and _calls(body):
        params = parameters(scan, node.child_by_field_name("parameters"))
        return as_function(scan, node, name, params, lambda: scan.expr(body))
    scan.frame.lambdas += 1
    scan.frame.flow.begin()
    value = scan.done(body)
    names = _names(scan, node)
    plain = tuple([each.partition("=")[0].strip() for each in names])
    scan.frame.flow.add(Later(scan.frame.flow.end(), plain))
    scan.frame.lambdas -= 1
    return Lambda(("",) * len(names), names, value)


def _name(scan: Scan, node: Node) -> str:
    """What a function is called that a lambda is read as; empty for one that is handed to somebody else."""
    parent = node.parent
    if parent is None or scan.frame.lambdas or scan.frame.place == "class":
        return ""
    target = parent.child_by_field_name("left") if parent.type == "assignment" else None
    if target is not None and target.type == "identifier":
        return scan.text(target)
    kept = target is not None and target.type == "attribute"
    if kept or parent.type == "return_statement":
        return _by_place(node)
    return name_of_handed(scan, node)


def _by_place(node: Node) -> str:
    row, column = node.start_point
    return f"<lambda {row + 1}:{column + 1}>"


def name_of_handed(scan: Scan, node: Node) -> str:
    """Return what a function is called that a function or a method of the same object gets; empty for any other."""
    own = node.parent is not None and not scan.frame.lambdas and _is_handed(scan, node.parent)
    return _by_place(node) if own else ""


def _is_handed(scan: Scan, parent: Node) -> bool:
    """Whether a lambda in a function is an argument of a function, or of a method of the object at hand."""
    if scan.frame.place != "function":
        return False
    listed = parent.parent if parent.type == "keyword_argument" else parent
    call = listed.parent if listed is not None and listed.type == "argument_list" else None
    callee = call.child_by_field_name("function") if call is not None else None
    if callee is None or callee.type == "identifier":
        return callee is not None and scan.text(callee) not in _BUILT_IN
    own = callee.child_by_field_name("object") if callee.type == "attribute" else None
    return own is not None and scan.text(own) == "self"


def _calls(node: Node) -> bool:
    pending = [node]
    while pending:
        each = pending.pop()
        if each.type == "call":
            return True
        pending += each.named_children
    return False


def as_function(scan: Scan, node: Node, name: str, params: tuple[Parameter, ...], read: Callable[[], Expr]) -> Lambda:
    """Return a lambda that is read as a function of its own; `read` gives its value, in its place."""
    outer = scan.frame
    statements: list[Statement] = []
    hidden = any(param.name.encode() in outer.names for param in params)
    scope = f"{outer.scope}::{name}" if outer.scope else name
    scan.frame = frame = Frame("function", scope, statements, {} if hidden else outer.names)
    frame.bases = outer.bases
    value = read()
    scan.emit("return", node, value)
    scan.frame = outer
    line, end = node.start_point[0] + 1, node.end_point[0] + 1
    flow = frame.flow.flow()
    scan.functions.append(
        Function(name, outer.scope, params, "", line, end, tuple(statements), traits=("lambda",), flow=flow)
    )
    alone = len(statements) == 1  # loops of comprehensions are statements of the function, nobody else has them
    names = tuple([param.name for param in params])
    return Lambda(("",) * len(names), names, value if alone else None, name)


def _names(scan: Scan, node: Node) -> tuple[str, ...]:
    written = node.child_by_field_name("parameters")
    return tuple([scan.text(child) for child in parts(written)]) if written is not None else ()


LAMBDAS: Mapping[str, ExprHandler] = {"lambda": _lambda}
