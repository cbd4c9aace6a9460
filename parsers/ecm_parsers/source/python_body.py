"""Python statements: assignments, branches, loops and what else a body is made of.

`if`, `else`, loops, `except` and `case` are one deeper than what encloses them; `try`, its `else` and
`finally`, and `with` are not. An assignment is `set`, with its annotation as type; an annotation without a
value is `let`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final, Literal

from tree_sitter import Node

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name, Op
from ecm_parsers.source.facts import Constant, Field
from ecm_parsers.source.flow import Attempt, Block, Branch, Case, Handler, Leave, Loop, Switch
from ecm_parsers.source.python_class_body import class_attribute, given_before, named_by
from ecm_parsers.source.python_contexts import entered
from ecm_parsers.source.python_expr import salvage
from ecm_parsers.source.python_fields import RUN, given_by, gives_field, of_any_class
from ecm_parsers.source.python_literal import NULL, TRUE
from ecm_parsers.source.python_named_tuples import made_class
from ecm_parsers.source.python_partials import value_for
from ecm_parsers.source.python_raising import asserted, name_caught, raised, types_caught
from ecm_parsers.source.python_scan import Scan, StatementHandler, parts
from ecm_parsers.source.python_type_calls import type_assigned

_DISPLAYS = ("tuple", "list", "expression_list")
_LITERALS = frozenset(("string", "concatenated_string", "integer", "float", "true", "false", "none"))


_ASKED: Final = frozenset({"attribute", "subscript"})
"""Expressions that raise where there is no such thing, for which people ask for them: `try: table["x"]`."""
_DIVIDING: Final = frozenset({"/", "//", "%"})
"""Operators that raise for zero."""


def _expression(scan: Scan, node: Node) -> None:
    for child in node.children:
        kind = child.type
        if kind == "assignment":
            _assignment(scan, child)
        elif kind == "augmented_assignment":
            _augmented(scan, child)
        elif kind in _ASKED or any(each.type in _DIVIDING for each in child.children):
            scan.emit("do", child, scan.expr(child))
        elif kind != "string" and not _field(scan, child):
            scan.do(child)


def _field(scan: Scan, node: Node) -> bool:
    """A call that gives an object a field, which is told as the assignment that it is."""
    named = node.type == "call" and gives_field(scan.text(node.children[0]))
    given = given_by(scan.expr(node)) if named else None
    if given is not None:
        scan.emit("set", node, given.value or scan.opaque(node), given.target, "" if given.value else "del")
    return given is not None


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
    bound = value_for(scan, left, value)
    if value is not None and _pairwise(scan, target, value, left, bound):
        for one, item in _pairs(left, bound):
            _record(scan, target, one, item, type_)
        return left
    _record(scan, target, left, bound, type_)
    return left


def _pairs(left: Expr, right: Expr | None) -> list[tuple[Expr, Expr]]:
    if isinstance(left, Items) and isinstance(right, Items) and len(left.items) == len(right.items):
        return list(zip(left.items, right.items, strict=True))
    return []


def _pairwise(scan: Scan, target: Node, value: Node, left: Expr, right: Expr | None) -> bool:
    """Whether each item is bound to the item of the same place, one after the other: displays without a star."""
    if value.type not in _DISPLAYS or not _pairs(left, right):
        return False
    starred = ("list_splat", "list_splat_pattern")
    if any(child.type in starred for side in (target, value) for child in side.named_children):
        return False
    return not _words(scan, target) & _words(scan, value)  # `a, b = b, a` binds both at once


def _words(scan: Scan, node: Node) -> set[bytes]:
    """The identifiers in an expression."""
    if node.type == "identifier":
        return {scan.raw(node)}
    return {word for child in node.named_children for word in _words(scan, child)}


def _record(scan: Scan, node: Node, left: Expr, value: Expr | None, type_: str = "") -> None:
    """Emit one binding as statement, constant and field, as its place demands."""
    frame = scan.frame
    own = named_by(scan, left)
    if own:
        class_attribute(scan, node, Field(own, type_, node.start_point[0] + 1, value))
        return
    scan.emit("let" if value is None else "set", node, value, of_any_class(left), type_)
    if frame.place == "module" and isinstance(left, Name) and value is not None:
        scan.constants.append(Constant(left.id, "", value, node.start_point[0] + 1, type_))
        made_class(scan, left.id, value, node.start_point[0] + 1)
    if type_ and frame.fields is not None and isinstance(left, Member) and left.base == THIS:
        frame.fields.append(Field(left.name, type_, node.start_point[0] + 1, value))


def _augmented(scan: Scan, node: Node) -> None:
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    operator = node.child_by_field_name("operator")
    if left is None or right is None or operator is None:
        return
    target = scan.expr(left)
    before = given_before(scan, target)
    if before is not None:
        _record(scan, left, target, Op(operator.type[:-1], (before, scan.expr(right))))
        return
    scan.emit("set", node, Op(operator.type[:-1], (target, scan.expr(right))), target, operator.type)


def _returned(scan: Scan, node: Node) -> None:
    values = parts(node)
    for child in values:
        scan.emit("return", node, scan.expr(child))
    if not values:
        scan.frame.flow.add(Leave("return"))


def _left(how: Literal["break", "continue"]) -> StatementHandler:
    def handler(scan: Scan, node: Node) -> None:
        scan.frame.flow.add(Leave(how))

    return handler


def _calls(scan: Scan, node: Node) -> None:
    for child in parts(node):
        scan.do(child)


def _deleted(scan: Scan, node: Node) -> None:
    """What is deleted, or what an element is deleted of, is not what it was."""
    for child in parts(node):
        for target in parts(child) if child.type == "expression_list" else (child,):
            scan.emit("set", node, scan.opaque(target), scan.expr(target), "del")
            scan.do(target)


def _shared(scan: Scan, node: Node) -> None:
    """`global` and `nonlocal`: what the function assigns is not its own."""
    for child in parts(node):
        name = scan.text(child)
        scan.frame.shared.append(name)
        if node.type == "global_statement":
            scan.frame.globals.append(Constant(name, "", scan.opaque(child), node.start_point[0] + 1))


def _tested(scan: Scan, node: Node | None) -> Expr:
    """A condition; what it calls is a step before the branch."""
    return NULL if node is None else scan.done(node)


def _if(scan: Scan, node: Node) -> None:
    """A condition with its block; with alternatives it is a choice among conditions, of which the first one holds."""
    test = _tested(scan, node.child_by_field_name("condition"))
    then = scan.inner(node.child_by_field_name("consequence"), 1)
    cases = [
        Case((test,), then),
        *[_alternative(scan, clause) for clause in node.children_by_field_name("alternative")],
    ]
    if len(cases) == 1 or (len(cases) == 2 and not cases[1].tests):
        scan.frame.flow.add(Branch(test, then, cases[1].body if len(cases) == 2 else ()))
    else:
        scan.frame.flow.add(Switch(TRUE, tuple(cases), False))


def _alternative(scan: Scan, clause: Node) -> Case:
    """`elif` or `else`; its condition is asked only when what stands before it did not apply."""
    scan.frame.depth += 1
    if clause.type == "elif_clause":
        test = _tested(scan, clause.child_by_field_name("condition"))
        case = Case((test,), scan.inner(clause.child_by_field_name("consequence")))
    else:
        case = Case((), scan.inner(clause.child_by_field_name("body")))
    scan.frame.depth -= 1
    return case


def _while(scan: Scan, node: Node) -> None:
    test = _tested(scan, node.child_by_field_name("condition"))
    body = scan.inner(node.child_by_field_name("body"), 1)
    scan.frame.flow.add(Loop(-1, test, body, other=_otherwise(scan, node)))


def _otherwise(scan: Scan, node: Node) -> Block:
    """The `else` of a loop."""
    clause = next((child for child in parts(node) if child.type == "else_clause"), None)
    return scan.inner(clause.child_by_field_name("body"), 1) if clause is not None else ()


def _match(scan: Scan, node: Node) -> None:
    subject = _tested(scan, node.child_by_field_name("subject"))
    clauses = [clause for clause in parts(node.child_by_field_name("body") or node) if clause.type == "case_clause"]
    cases = [_case(scan, clause) for clause in clauses]
    scan.frame.flow.add(Switch(subject, tuple(cases), False))


def _case(scan: Scan, clause: Node) -> Case:
    """A case; a pattern that is no value may mean anything, a guard is no more than possible."""
    patterns = [part for part in parts(clause) if part.type == "case_pattern"]
    guard = clause.child_by_field_name("guard")
    if guard is not None:
        scan.frame.depth += 1
        _calls(scan, guard)
        scan.frame.depth -= 1
    tests = tuple([test for pattern in patterns for test in _patterns(scan, pattern)])
    if guard is None and [scan.text(pattern) for pattern in patterns] == ["_"]:
        tests = ()
    elif guard is not None:
        tests = (scan.opaque(guard),)
    return Case(tests, scan.inner(clause.child_by_field_name("consequence"), 1))


def _patterns(scan: Scan, node: Node) -> Iterator[Expr]:
    """What a pattern asks for: the sides of `|` each."""
    inner = parts(node)
    only = inner[0] if len(inner) == 1 else node
    for side in parts(only) if only.type == "union_pattern" else (only,):
        yield _pattern(scan, side)


def _pattern(scan: Scan, node: Node) -> Expr:
    """Literals and dotted names are values; a name alone is bound by what it meets."""
    dotted: list[str] = scan.text(node).split(".") if node.type == "dotted_name" else []
    if len(dotted) > 1:
        value: Expr = Name(dotted[0])
        for name in dotted[1:]:
            value = Member(value, name)
        return value
    return scan.expr(node) if node.type in _LITERALS else scan.opaque(node)


def _try(scan: Scan, node: Node) -> None:
    handlers: list[Handler] = []
    body: Block = ()
    other: Block = ()
    final: Block = ()
    for child in parts(node):
        if child.type == "block":
            scan.frame.attempts += 1
            body = scan.inner(child)
            scan.frame.attempts -= 1
        elif child.type.startswith("except"):
            handlers.append(Handler(types_caught(scan, child), _inner(scan, child, 1), name_caught(scan, child)))
        elif child.type == "else_clause":
            other = _inner(scan, child, 0)
        else:
            final = _inner(scan, child, 0)
    scan.frame.flow.add(Attempt(body, tuple(handlers), other, final))


def _inner(scan: Scan, node: Node, deeper: int) -> Block:
    block = next((part for part in node.named_children if part.type == "block"), None)
    return scan.inner(block, deeper)


def _for(scan: Scan, node: Node) -> None:
    left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
    each = -1
    scan.frame.flow.begin()
    if left is not None and right is not None:
        value = scan.expr(right)
        scan.emit("each", node, value, scan.expr(left))
        each = len(scan.frame.body) - 1
    before = scan.frame.flow.end()
    for step in before[:-1]:
        scan.frame.flow.add(step)
    body = scan.inner(node.child_by_field_name("body"), 1)
    scan.frame.flow.add(Loop(each, None, body, other=_otherwise(scan, node)))


def _executed(scan: Scan, node: Node) -> None:
    """The statement of Python 2 that runs a text."""
    _calls(scan, node)
    scan.emit("set", node, Call(Name("exec"), (scan.opaque(node),), line=node.start_point[0] + 1), RUN)


def _broken(scan: Scan, node: Node) -> None:
    """Read on inside what could not be parsed: whole statements and calls."""
    scan.block(node)
    salvage(scan, node)


STATEMENTS: Mapping[str, StatementHandler] = {
    "ERROR": _broken,
    "assert_statement": asserted,
    "block": lambda scan, node: scan.block(node, 1),
    "break_statement": _left("break"),
    "continue_statement": _left("continue"),
    "delete_statement": _deleted,
    "exec_statement": _executed,
    "expression_statement": _expression,
    "for_statement": _for,
    "global_statement": _shared,
    "if_statement": _if,
    "match_statement": _match,
    "nonlocal_statement": _shared,
    "print_statement": _calls,
    "raise_statement": raised,
    "return_statement": _returned,
    "try_statement": _try,
    "type_alias_statement": type_assigned,
    "while_statement": _while,
    "with_statement": entered,
}
