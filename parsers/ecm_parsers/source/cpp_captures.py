"""What lambdas of C++ capture by a value of their own: `[pub = create(node)](const M & m) { pub->publish(m); }`.

A copy of a variable is one where the variable is assigned behind the lambda: `[name]` has what it was before.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from typing import TYPE_CHECKING, Any, NamedTuple

import msgspec

from ecm_parsers.source.expr import Name
from ecm_parsers.source.facts import Function

if TYPE_CHECKING:
    from tree_sitter import Node


_FUNCTIONS = frozenset({"function_definition", "lambda_expression"})
_DECLARING = frozenset({"reference_declarator", "pointer_declarator", "structured_binding_declarator"})
_ASSIGNED = {"assignment_expression": "left", "update_expression": "argument"}


class Capture(NamedTuple):
    """A capture with its name, the expression that is evaluated when the lambda is made, and if it refers to that."""

    name: str
    value: Node
    shares: bool


def initial_captures(node: Node) -> list[Capture]:
    """Return the captures of a lambda expression that have a value of their own."""
    listed = node.child_by_field_name("captures")
    entries = listed.named_children if listed is not None else []
    return [found for entry in entries for found in (*_initial(entry), *_copied(entry, node))]


def _copied(entry: Node, made: Node) -> Iterator[Capture]:
    """A variable that is captured by copy, and assigned behind the lambda in the body around it."""
    before = entry.prev_sibling
    if entry.type == "identifier" and (before is None or before.type != "&"):
        named = [entry]
    elif entry.type == "lambda_default_capture" and entry.text == b"=":
        named = _used(made)
    else:
        return
    assigned = _assigned_behind(made)
    found = {each.text: each for each in reversed(named) if each.text in assigned}
    yield from (Capture((name or b"").decode(errors="replace"), each, False) for name, each in found.items())


def _used(made: Node) -> list[Node]:
    """The variables of the function around a lambda that its body names, without those that it captures by name."""
    listed, body = made.child_by_field_name("captures"), made.child_by_field_name("body")
    own = {name.text for entry in (listed.named_children if listed is not None else ()) for name in _named(entry)}
    around = _function_around(made)
    if body is None or around is None:
        return []
    local = {name.text for name in _named(around) if _is_declared(name)}
    return [name for name in _named(body) if name.text in local and name.text not in own]


def _is_declared(name: Node) -> bool:
    """Whether an identifier is what a declaration gives its name to."""
    parent = name.parent
    return parent is not None and (parent.type in _DECLARING or parent.child_by_field_name("declarator") == name)


def _named(node: Node) -> Iterator[Node]:
    """The identifiers within a node."""
    if node.type == "identifier":
        yield node
    for child in node.named_children:
        yield from _named(child)


def _function_around(made: Node) -> Node | None:
    node = made.parent
    while node is not None and node.type not in _FUNCTIONS:
        node = node.parent
    return node


def _assigned_behind(made: Node) -> Set[bytes]:
    around = _function_around(made)
    found: set[bytes] = set()
    pending = [around] if around is not None else []
    while pending:
        node = pending.pop()
        if node.end_byte <= made.end_byte or node == made:
            continue
        pending += node.named_children
        target = node.child_by_field_name(_ASSIGNED[node.type]) if node.type in _ASSIGNED else None
        if target is not None and target.type == "identifier" and target.text is not None:
            found.add(target.text)
    return found


def _initial(entry: Node) -> Iterator[Capture]:
    left, right = entry.child_by_field_name("left"), entry.child_by_field_name("right")
    if left is not None and right is not None:
        yield Capture((left.text or b"").decode(errors="replace"), right, entry.children[0].type == "&")


def capturing(functions: Sequence[Function], held: Mapping[str, str]) -> Sequence[Function]:
    """Return a lambda, and those within it, that call what it captures as the function around it does.

    Args:
        functions: the lambda and those within it.
        held: the names of its captures -> those of the variables that hold them; what hides one is left alone.
    """
    hidden = {name for function in functions for name in _declared(function)}
    names = {name: variable for name, variable in held.items() if name not in hidden}
    return [_renamed(function, names) for function in functions] if names else functions


def _declared(function: Function) -> Iterator[str]:
    yield from (parameter.name for parameter in function.params)
    for statement in function.body:
        if statement.kind in {"let", "each"} and isinstance(statement.target, Name):
            yield statement.target.id


def _renamed(part: Any, names: Mapping[str, str]) -> Any:
    """The same facts with other names of variables."""
    if isinstance(part, Name):
        return Name(names[part.id]) if part.id in names else part
    if isinstance(part, tuple):
        return tuple([_renamed(each, names) for each in part])
    if not isinstance(part, msgspec.Struct):
        return part
    given = [(each, getattr(part, each)) for each in part.__struct_fields__]
    return msgspec.structs.replace(part, **{each: _renamed(value, names) for each, value in given})
