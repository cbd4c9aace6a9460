"""Python expressions of declarative files (`setup.py`, `.cfg`) folded to values, never executed.

Works on a tree-sitter tree, so Python 2 text is read as well.
"""

from __future__ import annotations

import math
import posixpath
import re
from collections.abc import Callable, Iterator
from typing import NamedTuple

import tree_sitter_python
from tree_sitter import Language, Node, Parser

from ecm_parsers.python_builtins import called, compared, element
from ecm_parsers.python_paths import of_path
from ecm_parsers.python_values import (
    MAX_TEXT,
    Data,
    Names,
    PyCall,
    Table,
    Unknown,
    Value,
    format_text,
    operate,
    shown,
    truth,
)
from ecm_parsers.result import Diagnostic

MAX_BYTES = 1_000_000
MAX_DEPTH = 60
MAX_NODES = 100_000
MAX_STATEMENTS = 4_000
MAX_SHOWN = 2_000
_LANGUAGE = Language(tree_sitter_python.language())
_PERHAPS = frozenset(
    {"function_definition", "lambda", "class_definition", "for_statement", "while_statement", "except_clause"}
)
"""What is taken any number of times, or has variables of its own."""
_PI = frozenset({"pi", "math.pi", "numpy.pi", "np.pi"})
"""docs.python.org and numpy.org: constants of `math` and `numpy`, as files import them."""
_ESCAPES = {"\\\n": "", "\\n": "\n", "\\t": "\t", "\\\\": "\\", "\\'": "'", '\\"': '"', "\\r": "\r"}
_ESCAPE = re.compile(r"\\.", re.DOTALL)


def parse_python(text: str) -> Node:
    """Return the root of the syntax tree of Python text."""
    return Parser(_LANGUAGE).parse(text.encode("utf-8", "replace")).root_node


class Reached(NamedTuple):
    """A node that is reached; `certain` where no branch that is not decided is around it."""

    node: Node
    certain: bool


def statements(root: Reached, wanted: frozenset[str], names: Names, diagnostics: list[Diagnostic]) -> Iterator[Reached]:
    """Yield the nodes of the wanted kinds in the order of the text, within bounds, without recursion.

    A branch that `names` decides, as they are when it is reached, is followed on the side that is taken only.
    """
    stack = [root]
    found = 0
    for _ in range(MAX_NODES):
        if not stack or found == MAX_STATEMENTS:
            break
        here = stack.pop()
        if here.node.type in wanted:
            found += 1
            yield here
        stack.extend(reversed(_below(here, names)))
    if stack:
        message = "The file has too many statements; the rest is not read. Split it."
        diagnostics.append(Diagnostic("error", "python-too-long", line_of(stack[-1].node), message))


def _below(here: Reached, names: Names) -> list[Reached]:
    """What is reached below a node: of a branch the sides that may be taken."""
    if here.node.type != "if_statement":
        certain = here.certain and here.node.type not in _PERHAPS
        return [Reached(child, certain) for child in here.node.named_children]
    sides = [here.node, *here.node.children_by_field_name("alternative")]
    for at, side in enumerate(sides):
        condition = side.child_by_field_name("condition")
        holds = truth(fold(condition, names)) if condition is not None else True
        if holds is None:
            within = [child for each in sides[at:] for child in each.named_children if child not in sides]
            return [Reached(child, False) for child in within]
        if holds:
            return [Reached(child, here.certain) for child in side.named_children if child.type == "block"]
    return []


def line_of(node: Node) -> int:
    """Return the 1-based line where a node starts."""
    return node.start_point[0] + 1


def text_of(node: Node) -> str:
    """Return the source text of a node."""
    return node.text.decode("utf-8", "replace") if node.text else ""


def fold(node: Node | None, names: Names, depth: int = 0) -> Value:
    """Return the value of an expression, with the given names known."""
    if node is None:
        return Value(None, 0)
    line = line_of(node)
    folder = _FOLDERS.get(node.type)
    if folder is None or depth > MAX_DEPTH:
        return Value(_unknown(node), line)
    return Value(folder(node, names, depth + 1), line)


def _unknown(node: Node) -> Unknown:
    """Keep the text of a node; long text is not even copied, since nodes nest."""
    is_short = node.end_byte - node.start_byte <= MAX_SHOWN
    return Unknown(text_of(node)[:80] if is_short else "...")


def _string(node: Node, names: Names, depth: int) -> Data:
    """Fold a literal; the holes of an f-string are filled or kept as `{expression}`."""
    start = text_of(node.children[0]).lower() if node.children else ""
    parts: list[str] = []
    for child in node.named_children:
        if child.type == "interpolation":
            parts.append(shown(fold(child.child_by_field_name("expression"), names, depth)))
        elif child.type == "string_content":
            raw = text_of(child)
            parts.append(raw if "r" in start else _ESCAPE.sub(_unescape, raw))
    return "".join(parts)[:MAX_TEXT]


def _unescape(match: re.Match[str]) -> str:
    return _ESCAPES.get(match[0], match[0])


def _joined(node: Node, names: Names, depth: int) -> Data:
    """Fold adjacent literals."""
    return "".join(shown(fold(child, names, depth)) for child in node.named_children)[:MAX_TEXT]


def _number(node: Node, _names: Names, _depth: int) -> Data:
    text = text_of(node).rstrip("lL").replace("_", "")
    if len(text) > 40:
        return _unknown(node)
    try:
        return float(text) if node.type == "float" else int(text, 0)
    except ValueError:
        # Python 2 writes octal numbers as `017`.
        return int(text, 8) if re.fullmatch("0[0-7]+", text) else _unknown(node)


def _constant(node: Node, _names: Names, _depth: int) -> Data:
    return {"true": True, "false": False}.get(node.type)


def _items(node: Node, names: Names, depth: int) -> Data:
    found: list[Value] = []
    for child in node.named_children:
        if child.type == "list_splat":
            spread = fold(child.named_children[0], names, depth).data if child.named_children else None
            found.extend(spread if isinstance(spread, tuple) else [Value(_unknown(child), line_of(child))])
        elif child.type != "comment":
            found.append(fold(child, names, depth))
    return tuple(found)


def _table(node: Node, names: Names, depth: int) -> Data:
    pairs = [child for child in node.named_children if child.type == "pair"]
    return Table(
        tuple(
            (
                fold(pair.child_by_field_name("key"), names, depth),
                fold(pair.child_by_field_name("value"), names, depth),
            )
            for pair in pairs
        )
    )


def _name(node: Node, names: Names, _depth: int) -> Data:
    """Fold an identifier, or an attribute as it is written: `pi`, `math.pi`."""
    name = callee_name(node)
    if name in names:
        return names[name].data
    return math.pi if name in _PI else _unknown(node)


def _inner(node: Node, names: Names, depth: int) -> Data:
    inner = [child for child in node.named_children if child.type != "comment"]
    return fold(inner[0], names, depth).data if inner else _unknown(node)


def _signed(node: Node, names: Names, depth: int) -> Data:
    data = fold(node.child_by_field_name("argument"), names, depth).data
    sign = node.children[0].type
    return (-data if sign == "-" else +data) if sign in "+-" and isinstance(data, int | float) else _unknown(node)


def _binary(node: Node, names: Names, depth: int) -> Data:
    left = fold(node.child_by_field_name("left"), names, depth)
    right = fold(node.child_by_field_name("right"), names, depth)
    operator = node.child_by_field_name("operator")
    result = operate(text_of(operator) if operator else "", left, right)
    return _unknown(node) if result is None else result


def _subscript(node: Node, names: Names, depth: int) -> Data:
    keys = node.children_by_field_name("subscript")
    key = fold(keys[0], names, depth) if len(keys) == 1 else None
    found = element(fold(node.child_by_field_name("value"), names, depth), key) if key is not None else None
    return _unknown(node) if found is None else found.data


def _compared(node: Node, names: Names, depth: int) -> Data:
    operators = node.children_by_field_name("operators")
    operands = [fold(child, names, depth) for child in node.named_children]
    single = len(operators) == 1 and len(operands) == 2
    holds = compared(text_of(operators[0]), operands[0], operands[1]) if single else None
    return _unknown(node) if holds is None else holds


def _negated(node: Node, names: Names, depth: int) -> Data:
    holds = truth(fold(node.child_by_field_name("argument"), names, depth))
    return _unknown(node) if holds is None else not holds


def _either(node: Node, names: Names, depth: int) -> Data:
    """`a and b`, `a or b`: the one that decides."""
    left = fold(node.child_by_field_name("left"), names, depth)
    operator, holds = node.child_by_field_name("operator"), truth(left)
    if holds is None or operator is None:
        return _unknown(node)
    goes_on = holds == (operator.type == "and")
    return fold(node.child_by_field_name("right"), names, depth).data if goes_on else left.data


def _choice(node: Node, names: Names, depth: int) -> Data:
    """`a if test else b`."""
    one, test, other = node.named_children
    holds = truth(fold(test, names, depth))
    return _unknown(node) if holds is None else fold(one if holds else other, names, depth).data


def _call(node: Node, names: Names, depth: int) -> Data:
    """Fold a call that makes text, a list of patterns or a dict; keep other calls."""
    call = read_call(node, names, depth)
    function = call.name.rpartition(".")[2]
    if function == "join" and "path" in call.name.split("."):
        return posixpath.join(*(shown(value) for value in call.args))[:MAX_TEXT] if call.args else ""
    if function == "glob" and call.args:
        return (Value(shown(call.args[0]), line_of(node)),)
    if function == "dict" and not call.args:
        return Table(tuple((Value(key, value.line), value) for key, value in call.keywords))
    if function == "str" and len(call.args) == 1:
        return shown(call.args[0])
    made = called(call, names)
    if made is None:
        made = of_path(call, names, line_of(node))
    return _text_method(node, call, function, names, depth) if made is None else made


def _text_method(node: Node, call: PyCall, function: str, names: Names, depth: int) -> Data:
    """Fold `"...".format(...)` and `"/".join([...])`."""
    callee = node.child_by_field_name("function")
    owner = callee.child_by_field_name("object") if callee is not None else None
    if owner is None or function not in {"format", "join"}:
        return call
    text = fold(owner, names, depth).data
    if not isinstance(text, str):
        return call
    if function == "join":
        items = call.args[0].data if call.args else ()
        return text.join(map(shown, items))[:MAX_TEXT] if isinstance(items, tuple) else call
    return format_text(text, call)


def read_call(node: Node, names: Names, depth: int = 0) -> PyCall:
    """Return a call with folded arguments."""
    function = node.child_by_field_name("function")
    arguments = node.child_by_field_name("arguments")
    args: list[Value] = []
    keywords: list[tuple[str, Value]] = []
    for child in arguments.named_children if arguments is not None else []:
        if child.type == "keyword_argument":
            key = child.child_by_field_name("name")
            value = fold(child.child_by_field_name("value"), names, depth)
            keywords.append((text_of(key) if key is not None else "", value))
        elif child.type == "dictionary_splat":
            keywords.append(("**", fold(child.named_children[0], names, depth)))
        elif child.type != "comment":
            args.append(fold(child, names, depth))
    return PyCall(callee_name(function), tuple(args), tuple(keywords))


def callee_name(function: Node | None) -> str:
    """Return the dotted name of what is called; of a long expression only its last name."""
    if function is not None and function.end_byte - function.start_byte > MAX_SHOWN:
        function = function.child_by_field_name("attribute")
    return re.sub(r"\s+", "", text_of(function)[-200:]) if function is not None else ""


_FOLDERS: dict[str, Callable[[Node, Names, int], Data]] = {
    "string": _string,
    "concatenated_string": _joined,
    "integer": _number,
    "float": _number,
    "true": _constant,
    "false": _constant,
    "none": _constant,
    "list": _items,
    "tuple": _items,
    "set": _items,
    "dictionary": _table,
    "identifier": _name,
    "attribute": _name,
    "parenthesized_expression": _inner,
    "unary_operator": _signed,
    "binary_operator": _binary,
    "call": _call,
    "subscript": _subscript,
    "comparison_operator": _compared,
    "not_operator": _negated,
    "boolean_operator": _either,
    "conditional_expression": _choice,
}
