"""Python statements: assignments, branches, loops and what else a body is made of.

`if`, `else`, loops, `except` and `case` are one deeper than what encloses them; `try`, its `else` and
`finally`, and `with` are not. An assignment is `set`, with its annotation as type; an annotation without a
value is `let`.
"""

from __future__ import annotations

from collections.abc import Mapping

from tree_sitter import Node

from ecm_parsers.source.expr import Expr, Items, Member, Name, Op
from ecm_parsers.source.facts import Constant, Field
from ecm_parsers.source.python_expr import parts, salvage
from ecm_parsers.source.python_scan import Scan, StatementHandler

_THIS = Name("this")
_DISPLAYS = ("tuple", "list", "expression_list")
_CLAUSES = frozenset(("elif_clause", "else_clause"))


def _expression(scan: Scan, node: Node) -> None:
    for child in node.children:
        kind = child.type
        if kind == "assignment":
            _assignment(scan, child)
        elif kind == "augmented_assignment":
            _augmented(scan, child)
        elif kind != "string":
            scan.do(child)


def _assignment(scan: Scan, node: Node) -> None:
    target, type_, value = _sides(scan, node)
    outer: list[Node] = []
    # `a = b = 1` is nested to the right.
    while value is not None and value.type == "assignment":
        outer.append(target)
        target, type_, value = _sides(scan, value)
    bound = _bind(scan, target, type_, value)
    while outer:
        target = outer.pop()
        left = scan.expr(target)
        _record(scan, target, left, bound)
        bound = left


def _sides(scan: Scan, node: Node) -> tuple[Node, str, Node | None]:
    """Target, annotation and value of an assignment."""
    children = node.children
    if len(children) == 3 and children[1].type == "=":
        return children[0], "", children[2]
    return children[0], scan.text(node.child_by_field_name("type")), node.child_by_field_name("right")


def _bind(scan: Scan, target: Node, type_: str, value: Node | None) -> Expr:
    """Emit an assignment; the result is what an outer target of its chain is bound to."""
    left = scan.expr(target)
    bound = scan.expr(value) if value is not None else None
    if value is not None and _pairwise(target, value, left, bound):
        for one, item in _pairs(left, bound):
            _record(scan, target, one, item, type_)
        return left
    _record(scan, target, left, bound, type_)
    return left


def _pairs(left: Expr, right: Expr | None) -> list[tuple[Expr, Expr]]:
    if isinstance(left, Items) and isinstance(right, Items) and len(left.items) == len(right.items):
        return list(zip(left.items, right.items, strict=True))
    return []


def _pairwise(target: Node, value: Node, left: Expr, right: Expr | None) -> bool:
    """Whether each item is bound to the item of the same place: two displays of one length without a star."""
    if value.type not in _DISPLAYS or not _pairs(left, right):
        return False
    starred = ("list_splat", "list_splat_pattern")
    return not any(child.type in starred for side in (target, value) for child in side.named_children)


def _record(scan: Scan, node: Node, left: Expr, value: Expr | None, type_: str = "") -> None:
    """Emit one binding as statement, constant and field, as its place demands."""
    frame = scan.frame
    if frame.place == "class" and isinstance(left, Name):
        _class_attribute(scan, node, left, value, type_)
        return
    scan.emit("let" if value is None else "set", node, value, left, type_)
    if frame.place == "module" and isinstance(left, Name) and value is not None:
        scan.constants.append(Constant(left.id, "", value, node.start_point[0] + 1, type_))
    if type_ and frame.fields is not None and isinstance(left, Member) and left.base == _THIS:
        frame.fields.append(Field(left.name, type_, node.start_point[0] + 1, value))


def _class_attribute(scan: Scan, node: Node, name: Name, value: Expr | None, type_: str) -> None:
    frame = scan.frame
    line = node.start_point[0] + 1
    if frame.fields is not None:
        frame.fields.append(Field(name.id, type_, line, value))
    if value is None:
        return
    scan.constants.append(Constant(name.id, frame.scope, value, line, type_))
    if frame.owner is not None and b"(" in scan.raw(node.parent or node):
        scan.emit("set", node, value, Member(frame.owner, name.id), type_)


def _augmented(scan: Scan, node: Node) -> None:
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    operator = node.child_by_field_name("operator")
    if left is None or right is None or operator is None:
        return
    target = scan.expr(left)
    scan.emit("set", node, Op(operator.type[:-1], (target, scan.expr(right))), target)


def _returned(scan: Scan, node: Node) -> None:
    for child in parts(node):
        scan.emit("return", node, scan.expr(child))


def _calls(scan: Scan, node: Node) -> None:
    for child in parts(node):
        scan.do(child)


def _branch(scan: Scan, node: Node) -> None:
    """A condition with its block and alternatives."""
    children = parts(node)
    without = _left_out(scan, children)
    for child in children:
        kind = child.type
        if kind == "block":
            scan.block(child, 1)
        elif kind in _CLAUSES:
            if without is not None and without.op == "!=":
                scan.emit("do", child, Op("==", without.operands))
            _clause(scan, child)
        elif without is None:
            scan.do(child)
        elif without.op == "==":
            scan.emit("do", child, without)


def _left_out(scan: Scan, children: list[Node]) -> Op | None:
    """A test of a name for None, where one block runs for None alone: `if a is None:`, `if a is not None: .. else:`."""
    condition, clauses = children[0], [child for child in children if child.type in _CLAUSES]
    if condition.type != "comparison_operator" or not scan.raw(condition).endswith(b"None"):
        return None
    value = scan.expr(condition)
    if not isinstance(value, Op) or not isinstance(value.operands[0], Name):
        return None
    wanted = {"==": [], "!=": ["else_clause"]}.get(value.op)
    return value if [child.type for child in clauses] == wanted else None


def _clause(scan: Scan, node: Node) -> None:
    """An alternative: its condition runs only when what stands before it did not apply."""
    scan.frame.depth += 1
    for child in parts(node):
        if child.type == "block":
            scan.block(child)
        elif child.type == "if_clause":
            _calls(scan, child)
        elif child.type != "case_pattern":
            scan.do(child)
    scan.frame.depth -= 1


def _match(scan: Scan, node: Node) -> None:
    for child in parts(node):
        if child.type == "block":
            scan.block(child)
        else:
            scan.do(child)


def _try(scan: Scan, node: Node) -> None:
    for child in parts(node):
        if child.type == "block":
            scan.block(child)
            continue
        deeper = int(child.type.startswith("except"))
        for part in child.named_children:
            if part.type == "block":
                scan.block(part, deeper)


def _for(scan: Scan, node: Node) -> None:
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    if left is not None and right is not None:
        value = scan.expr(right)
        scan.emit("each", node, value, scan.expr(left))
    for child in parts(node):
        if child.type == "block":
            scan.block(child, 1)
        elif child.type == "else_clause":
            _clause(scan, child)


def _with(scan: Scan, node: Node) -> None:
    for child in parts(node):
        if child.type == "block":
            scan.block(child)
        elif child.type == "with_clause":
            for item in parts(child):
                _with_item(scan, item)


def _with_item(scan: Scan, node: Node) -> None:
    for child in parts(node):
        halves = parts(child) if child.type == "as_pattern" else []
        if len(halves) == 2:
            targets = [scan.expr(target) for target in parts(halves[1])]
            scan.emit("let", node, scan.expr(halves[0]), targets[0] if targets else None)
        else:
            scan.do(child)


def _broken(scan: Scan, node: Node) -> None:
    """Read on inside what could not be parsed: whole statements and calls."""
    scan.block(node)
    salvage(scan, node)


STATEMENTS: Mapping[str, StatementHandler] = {
    "ERROR": _broken,
    "assert_statement": _calls,
    "block": lambda scan, node: scan.block(node, 1),
    "case_clause": _clause,
    "delete_statement": _calls,
    "elif_clause": _clause,
    "else_clause": _clause,
    "exec_statement": _calls,
    "expression_statement": _expression,
    "for_statement": _for,
    "if_statement": _branch,
    "match_statement": _match,
    "print_statement": _calls,
    "raise_statement": _calls,
    "return_statement": _returned,
    "try_statement": _try,
    "while_statement": _branch,
    "with_statement": _with,
}
