"""Python expressions in the vocabulary of `expr.py`.

Choices beyond it: `and`, `or`, `not`, `is`, `is not` and `<>` are written as C++ writes them; a comprehension
is a `Comprehension` after an `each` statement for each of its loops; a formatted part of an f-string is
`Op("format", (value, Text(spec)))`; a slice is `Op(":", (start, stop, ...))`; the keyword of `**spread` is
`**`, and `*spread` is `Op("*", (value,))`. In a class that derives from `Base`, `Base.method(self, x)` is
`super("Base").method(x)`.
"""

from __future__ import annotations

from collections.abc import Mapping

from tree_sitter import Node

from ecm_parsers.source.expr import (
    REST,
    THIS,
    Call,
    Comprehension,
    Expr,
    Items,
    Member,
    Name,
    Number,
    Op,
    Table,
    Text,
)
from ecm_parsers.source.python_choices import may_not_happen
from ecm_parsers.source.python_fields import field_of, table_of
from ecm_parsers.source.python_later_calls import later_call
from ecm_parsers.source.python_literal import (
    FALSE,
    NULL,
    TRUE,
    joined,
    negated,
    number_value,
)
from ecm_parsers.source.python_scan import EXTRAS, MAX_DOTTED_LENGTH, SKIPPED, ExprHandler, Scan, parts
from ecm_parsers.source.python_strings import string

_OPERATORS: Mapping[str, str] = {"and": "&&", "or": "||", "is": "==", "is not": "!=", "<>": "!=", "not": "!"}


def _attribute(scan: Scan, node: Node) -> Expr:
    start, end = node.start_byte, node.end_byte
    if end - start <= MAX_DOTTED_LENGTH:
        raw = scan.data[start:end]
        if raw.replace(b".", b"").decode("utf-8", "replace").isidentifier():
            return scan.name(raw)
    base, name = node.child_by_field_name("object"), node.child_by_field_name("attribute")
    if base is None or name is None:
        return scan.opaque(node)
    return Member(scan.expr(base), scan.noted(scan.text(name)))


def _call(scan: Scan, node: Node) -> Expr:
    children = node.children
    function, arguments = children[0], children[-1]
    scan.calls += 1
    expr = scan.expr
    callee = expr(function)
    line = function.end_point[0] + 1
    if arguments.type != "argument_list":
        return Call(callee, (scan.expr(arguments),), line=line)
    args: list[Expr] = []
    keywords: list[tuple[str, Expr]] = []
    lines: list[int] = []
    for child in arguments.named_children:
        kind = child.type
        if kind == "keyword_argument":
            named = child.children
            keywords.append((scan.text(named[0]), expr(named[-1])))
            lines.append(child.start_point[0] + 1)
        elif kind == "dictionary_splat":
            keywords.append(("**", expr(child)))
            lines.append(child.start_point[0] + 1)
        elif kind == "ERROR":
            salvage(scan, child)
        elif kind not in EXTRAS:
            args.append(expr(child))
    if args[:1] == [THIS] and _is_of_base(scan, function):
        base = Call(Name("super"), (Text(scan.text(function.child_by_field_name("object"))),), line=line)
        callee, args = Member(base, scan.text(function.child_by_field_name("attribute"))), args[1:]
    made = later_call(scan, node, Call(callee, tuple(args), tuple(keywords), (), line, tuple(lines)))
    return table_of(made) if isinstance(made, Call) else made


def _is_of_base(scan: Scan, function: Node) -> bool:
    """Whether a call by the name of a class is that of a method of a base; how objects begin is told by that name."""
    if function.type != "attribute" or not scan.frame.bases:
        return False
    base, name = function.child_by_field_name("object"), function.child_by_field_name("attribute")
    return scan.text(name) != "__init__" and scan.text(base) in scan.frame.bases


def salvage(scan: Scan, node: Node) -> None:
    """Emit the calls in a node that could not be parsed as a whole."""
    for child in node.named_children:
        if child.type in scan.expressions:
            scan.do(child)


def _concatenated(scan: Scan, node: Node) -> Expr:
    return joined([scan.expr(child) for child in parts(node)])


def _number(scan: Scan, node: Node) -> Expr:
    value = number_value(scan.raw(node))
    return scan.opaque(node) if value is None else Number(value)


def _items(scan: Scan, node: Node) -> Expr:
    return Items(tuple([scan.expr(child) for child in parts(node)]))


def _set_of(elements: Expr) -> Expr:
    """`{a, b}` is `set([a, b])`: a list without an order."""
    return Call(Name("set"), (elements,))


def _table(scan: Scan, node: Node) -> Expr:
    entries: list[tuple[Expr, Expr]] = []
    for child in parts(node):
        if child.type == "pair":
            entries.append(_pair(scan, child))
        else:
            entries.append((NULL, scan.expr(child)))
    return Table(tuple(entries))


def _pair(scan: Scan, node: Node) -> tuple[Expr, Expr]:
    children = node.children
    return scan.expr(children[0]), scan.expr(children[-1])


def _pair_table(scan: Scan, node: Node) -> Expr:
    return Table((_pair(scan, node),))


def _subscript(scan: Scan, node: Node) -> Expr:
    base, *indices = parts(node)
    index = [scan.expr(child) for child in indices]
    return field_of(scan.expr(base), index[0] if len(index) == 1 else Items(tuple(index)))


def _slice(scan: Scan, node: Node) -> Expr:
    bounds: list[Expr] = [NULL]
    for child in node.children:
        if child.type == ":":
            bounds.append(NULL)
        elif child.is_named and child.type not in SKIPPED:
            bounds[-1] = scan.expr(child)
    return Op(":", tuple(bounds))


def _binary(scan: Scan, node: Node) -> Expr:
    operands: list[Expr] = []
    operators: list[str] = []
    for child in node.children:
        kind = child.type
        if not child.is_named:
            operators.append(_OPERATORS.get(kind, kind))
        elif kind not in SKIPPED:
            operands.append(scan.expr(child))
    return Op(" ".join(operators), tuple(operands))


def _unary(scan: Scan, node: Node) -> Expr:
    kind = node.children[0].type
    operator = _OPERATORS.get(kind, kind)
    operand = _inner(scan, node)
    return negated(operand) if operator == "-" else Op(operator, (operand,))


def _conditional(scan: Scan, node: Node) -> Expr:
    operands = [scan.expr(child) for child in parts(node)]
    if len(operands) != 3:
        return scan.opaque(node)
    value, test, other = operands
    return Op("?:", (test, value, other))


def _yielded(scan: Scan, node: Node) -> Expr:
    scan.frame.yields += scan.frame.lambdas == 0
    return Op("yield", (_inner(scan, node),))


def _inner(scan: Scan, node: Node) -> Expr:
    """What a wrapper that does not change the value encloses (parentheses, await, star)."""
    children = parts(node)
    if not children:
        return NULL
    if len(children) == 1:
        return scan.expr(children[0])
    return Items(tuple(scan.expr(child) for child in children))


def _spread(scan: Scan, node: Node) -> Expr:
    return Op("*", (_inner(scan, node),))


def _rest(scan: Scan, node: Node) -> Expr:
    return Op(REST, (_inner(scan, node),))


def _comprehension(scan: Scan, node: Node) -> Expr:
    body, *clauses = parts(node)
    loops: list[int] = []
    tests: list[Expr] = []
    for clause in clauses:
        if clause.type == "for_in_clause":
            loops += _loop(scan, clause)
            continue
        tests += [scan.done(condition) for condition in parts(clause)]
    return Comprehension(scan.expr(body), tuple(loops), tuple(tests))


def _loop(scan: Scan, clause: Node) -> list[int]:
    """Emit the `each` of a loop and return its index."""
    target, value = clause.child_by_field_name("left"), clause.child_by_field_name("right")
    if target is None or value is None:
        return []
    over, bound = scan.expr(value), scan.expr(target)
    scan.emit("each", clause, over, bound)
    return [len(scan.frame.body) - 1]


def _named(scan: Scan, node: Node) -> Expr:
    children = parts(node)
    if len(children) != 2:
        return scan.opaque(node)
    target = target_value = scan.expr(children[0])
    value = scan.expr(children[1])
    if may_not_happen(node):
        target_value = value = scan.opaque(node)
    scan.emit("set", node, value, target)
    return target_value


def _keyword_value(scan: Scan, node: Node) -> Expr:
    return scan.expr(node.children[-1])


EXPRESSIONS: Mapping[str, ExprHandler] = {
    "attribute": _attribute,
    "await": _inner,
    "binary_operator": _binary,
    "boolean_operator": _binary,
    "call": _call,
    "comparison_operator": _binary,
    "concatenated_string": _concatenated,
    "conditional_expression": _conditional,
    "dictionary": _table,
    "dictionary_comprehension": _comprehension,
    "dictionary_splat": _inner,
    "expression_list": _items,
    "false": lambda _scan, _node: FALSE,
    "float": _number,
    "generator_expression": _comprehension,
    "integer": _number,
    "keyword_argument": _keyword_value,
    "list": _items,
    "list_comprehension": _comprehension,
    "list_pattern": _items,
    "list_splat": _spread,
    "list_splat_pattern": _rest,
    "named_expression": _named,
    "none": lambda _scan, _node: NULL,
    "not_operator": _unary,
    "pair": _pair_table,
    "parenthesized_expression": _inner,
    "pattern_list": _items,
    "set": lambda scan, node: _set_of(_items(scan, node)),
    "set_comprehension": lambda scan, node: _set_of(_comprehension(scan, node)),
    "slice": _slice,
    "string": string,
    "subscript": _subscript,
    "true": lambda _scan, _node: TRUE,
    "tuple": _items,
    "tuple_pattern": _items,
    "unary_operator": _unary,
    "yield": _yielded,
}
