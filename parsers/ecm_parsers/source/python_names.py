"""Names that a Python file uses and nothing in it binds, whatever the scope."""

from __future__ import annotations

import builtins
from collections.abc import Iterator

from tree_sitter import Node

from ecm_parsers.source.python import syntax_tree

MAX_NODES = 300_000
_OF_PYTHON_2 = (
    "apply basestring buffer cmp coerce execfile file intern long raw_input reduce reload unichr unicode xrange"
)
_OF_MODULES = "__file__ __builtins__ __path__ __module__ __qualname__ __class__ __annotations__ _ WindowsError"
BUILT_IN = frozenset({*dir(builtins), *_OF_PYTHON_2.split(), *_OF_MODULES.split()})
"""Names that Python 2 or 3 gives every module."""

_OPEN_NODES = frozenset({"wildcard_import", "exec_statement"})
OPEN_NAMES = frozenset({"exec", "execfile", "globals", "locals", "vars", "NameError"})
"""With these, names may come from where no statement binds them."""

_PATTERNS = frozenset(
    {
        "pattern_list",
        "tuple_pattern",
        "list_pattern",
        "list_splat_pattern",
        "dictionary_splat_pattern",
        "as_pattern_target",
        "parameters",
        "lambda_parameters",
        "import_statement",
        "import_from_statement",
        "future_import_statement",
        "global_statement",
        "nonlocal_statement",
        "delete_statement",
        "case_pattern",
        "type_parameter",
        "type_alias_statement",
    }
)
"""All names below are bound; a default in one of them is taken for bound too."""

_BLOCKS = frozenset({"block", "module"})
_LEAVES = frozenset({"raise_statement", "return_statement", "continue_statement", "break_statement"})
_OFF = frozenset({b"False", b"0", b"None"})
_BOUND_FIELDS = {
    "assignment": "left",
    "for_statement": "left",
    "for_in_clause": "left",
    "named_expression": "name",
    "function_definition": "name",
    "class_definition": "name",
}
_NOT_NAMES = {
    "attribute": "attribute",
    "keyword_argument": "name",
    "aliased_import": "name",
    "import_from_statement": "module_name",
}


def loose_names(data: bytes) -> list[tuple[str, int]]:
    """Return (name, line) of the first use of each name that no statement of a file binds and Python does not have.

    Nothing is returned for files that do not parse, and for those that may bind names while they run.
    """
    root = syntax_tree(data)
    if root is None or root.has_error or root.descendant_count > MAX_NODES or _is_indented(data, root):
        return []
    bound: set[str] = set()
    used: dict[str, int] = {}
    for node, binds in _names(root):
        if node.type in _OPEN_NODES:
            return []
        name = (node.text or b"").decode("utf-8", "replace")
        if binds:
            bound.add(name)
        else:
            used.setdefault(name, node.start_point[0] + 1)
    if not OPEN_NAMES.isdisjoint(used):
        return []
    found = [(name, line) for name, line in used.items() if name not in bound | BUILT_IN]
    return found + [("self", node.start_point[0] + 1) for node in _without_self(root)][:1]


def _is_indented(data: bytes, root: Node) -> bool:
    """Whether a statement of the module stands indented, which Python refuses and the grammar does not."""
    statements = (node for node in root.named_children if node.type != "comment")
    before = (data[: node.start_byte].rpartition(b"\n")[2] for node in statements)
    return any(text and not text.strip(b" \t") for text in before)


def _without_self(root: Node) -> Iterator[Node]:
    """Uses of `self` in methods that take no argument at all."""
    pending = [(root, False)]
    while pending:
        node, alone = pending.pop()
        if node.type == "function_definition":
            parameters = node.child_by_field_name("parameters")
            in_class = node.parent is not None and node.parent.parent is not None
            method = in_class and node.parent.parent.type == "class_definition"  # type: ignore[union-attr]
            alone = bool(method and parameters is not None and parameters.named_child_count == 0)
        elif node.type in {"lambda", "class_definition"}:
            alone = False
        if node.type == "identifier" and alone and node.text == b"self":
            yield node
        pending += [(child, alone) for child in reversed(node.named_children)]


def _names(root: Node) -> Iterator[tuple[Node, bool]]:
    """Every identifier that stands for a name, and whether it is bound there; and what makes a file open.

    What stands behind a `raise` or a `return` of its block, or below `if False`, binds, as Python has it, and uses
    nothing.
    """
    pending = [(root, False, False)]
    while pending:
        node, binds, dead = pending.pop()
        if node.type == "identifier" or node.type in _OPEN_NODES:
            if binds or not dead or node.type in _OPEN_NODES:
                yield node, binds
            continue
        passed = _never_passed(node)
        field = _BOUND_FIELDS.get(node.type)
        left = node.child_by_field_name(field) if field else None
        skipped = node.child_by_field_name(_NOT_NAMES[node.type]) if node.type in _NOT_NAMES else None
        inside = node.type in _PATTERNS or (binds and node.type not in {"attribute", "subscript", "call"})
        caught = node.named_children[1:] if node.type == "except_clause" else ()  # `except Error, e` of Python 2
        for child in reversed(node.named_children):
            if child != skipped:
                late = child.type == "identifier" and child in caught
                behind = (passed is not None and child.start_byte > passed) or _is_off(node, child)
                pending.append((child, inside or child == left or late, dead or behind))


def _is_off(node: Node, child: Node) -> bool:
    """Whether a child is the body of an `if False` or `if 0`."""
    if node.type != "if_statement" or child != node.child_by_field_name("consequence"):
        return False
    condition = node.child_by_field_name("condition")
    return condition is not None and condition.text in _OFF


def _never_passed(block: Node) -> int | None:
    """Where the first statement of a block stands that nothing passes."""
    if block.type not in _BLOCKS:
        return None
    return next((child.start_byte for child in block.named_children if child.type in _LEAVES), None)
